"""Prints the runs of a study's configuration in the order in which they are run, with the time and memory that the cost
model expects of each, and the sum of each group."""
from pathlib import Path

import yaml

from grainscope.errors import InputError
from grainscope.study.plan import plan


def add_arguments(parser):
    parser.add_argument("config", help="configuration of the study, such as examples/study/config.yaml")


def read_config(path):
    try:
        config = yaml.safe_load(Path(path).read_text())
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        raise InputError(f"{path}: {' '.join(str(error).split())}") from None
    if not isinstance(config, dict):
        raise InputError(f"{path}: must be lines 'keyword: value', got {config!r:.60}")
    return config


def core_hours(runs):
    return sum(run.ranks * run.seconds for run in runs) / 3600


def run(arguments):
    runs = list(plan(read_config(arguments.config)).values())
    width = max(len(run.name) for run in runs)
    print(f"{'run':<{width}}  ranks   hours      MB  group")
    for run in runs:
        print(f"{run.name:<{width}}  {run.ranks:5}  {run.seconds / 3600:6.2f}  {run.memory / 1e6:6.0f}  {run.group}")
    for name in dict.fromkeys(run.group for run in runs):
        group = [run for run in runs if run.group == name]
        print(f"group {name}: {len(group)} runs, {core_hours(group):.1f} core-hours")
    print(f"{len(runs)} runs, {core_hours(runs):.1f} core-hours")
