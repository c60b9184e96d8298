# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of a study by `grainscope-tools study run`, in folders of their own, and whether two of them are the same."""
import os
from pathlib import Path
import subprocess

from case import require, require_equal
from grainscope.shear.output import read_blocks, read_table
from run import TIME_LIMIT, Failure, environment, kill_session, processes_of

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
SMALL = {"N": 150, "alpha": 1, "mu": 0.4, "I": 0.1, "measure": "all", "strain": 0.6, "steady": 0.2, "part": 0.1}
ROWS = ("series.txt", "micro.txt", "displacement.txt")
TABLES = ("surface.txt", "direction.txt", "correlation.txt", "layering.txt", "memory.txt")


def folder(name):
    return Path(os.environ["GRAINSCOPE_SCRATCH"]) / name


def tool(*words, ranks=1):
    """A process of grainscope-tools in the scratch folder."""
    return subprocess.Popen(
        [*map(str, (SOURCE / "tools" / "grainscope-tools", *words))],
        env=environment(ranks),
        cwd=folder(""),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )


def start(name, ranks=1, options=(), **variables):
    values = [f"{key}={value}" for key, value in {**SMALL, **variables}.items()]
    binary = os.environ["GRAINSCOPE_BINARY"]
    return tool("study", "run", folder(name), *values, "--binary", binary, "--ranks", ranks, *options, ranks=ranks)


def run_to_end(name, ranks=1, **variables):
    """Exit status, and what was printed."""
    return end_of(start(name, ranks, **variables))


def end_of(process):
    try:
        output, _ = process.communicate(timeout=TIME_LIMIT)
    except subprocess.TimeoutExpired:
        kill_session(process.pid)
        raise Failure(f"a run did not end in {TIME_LIMIT:g} s") from None
    return process.returncode, output


def ended(name, ranks=1, **variables):
    status, output = run_to_end(name, ranks, **variables)
    require(status == 0, f"{name} ended with {status}: {output}")
    return folder(name)


def ranks_of(process):
    program = Path(os.environ["GRAINSCOPE_BINARY"]).name[:15]
    return [pid for pid, name in processes_of(process.pid) if name == program]


def attempts_of(out):
    """The steps at which the attempts began."""
    return [
        int(line.split()[-1]) for line in (out / "parameters.txt").read_text().splitlines() if not line.startswith("#")
    ]


def last_step(out):
    """The step at which the last attempt ended."""
    return int((out / "parameters.txt").read_text().split()[-2])


def same_tables(one, other, names=ROWS + TABLES):
    for name in names:
        found, expected = (
            read_blocks(out, name) if name in TABLES else read_table(out, name)[0] for out in (one, other)
        )
        require(list(found) == list(expected), f"{name}: other columns")
        for column in expected:
            require_equal(found[column], expected[column], f"{name}, {column}")
