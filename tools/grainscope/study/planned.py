"""Prints the runs of a study's configuration, with the time and memory that the cost model expects of each."""
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


def run(arguments):
    runs = plan(read_config(arguments.config)).values()
    width = max(len(run.name) for run in runs)
    print(f"{'run':<{width}}  ranks   hours      MB")
    for run in runs:
        print(f"{run.name:<{width}}  {run.ranks:5}  {run.seconds / 3600:6.2f}  {run.memory / 1e6:6.0f}")
    hours = sum(run.ranks * run.seconds for run in runs) / 3600
    print(f"{len(runs)} runs, {hours:.1f} core-hours")
