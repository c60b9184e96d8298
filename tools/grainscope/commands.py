"""The command grainscope-tools: its subcommands, and the Python that runs them. Works with any Python from 3.6 on, to
say what is missing."""

import argparse
import importlib
import importlib.util
import os
import subprocess
import sys
from typing import NamedTuple

from grainscope.errors import InputError

PROGRAM = "grainscope-tools"
SYSTEM_PYTHON = "/usr/bin/python3"  # the Python of Debian's packages
OLDEST = (3, 9)


class Command(NamedTuple):
    """A subcommand: its module, what it does, and the Python packages that it needs. The module has `run(arguments)`,
    and `add_arguments(parser)` for what it takes; its docstring is the description."""

    module: str
    summary: str
    needs: tuple


DRAWS = ("numpy", "matplotlib")
FITS = ("numpy", "scipy")
COMMANDS = {
    "plot": Command(
        "plot", "draws files of fix ave/time, and prints steady means with their errors", DRAWS + ("pandas",)
    ),
    "rows": Command(
        "rows", "draws profiles and maps: fix field/write, fix ave/time mode vector, fix ave/spatial", DRAWS
    ),
    "render": Command(
        "render.command", "draws pictures and films of grains, walls and force chains, by POV-Ray", DRAWS
    ),
    "convert": Command("convert", "writes dumps for ParaView or OVITO", ("numpy",)),
    "summarise": Command("shear.summarise", "prints steady means of simple-shear runs, with errors", FITS),
    "figures": Command(
        "figures.runs", "draws simple-shear runs over strain, and the paper's figures of them", DRAWS + FITS
    ),
    "study plan": Command("study.planned", "prints the runs of a study, with the cost that is expected", ("yaml",)),
    "study run": Command("study.run", "begins a run of examples/simple_shear, or goes on with it", ()),
    "study run-grid": Command("study.run_grid", "runs a study for so many hours, and goes on with it", ("yaml",)),
    "study status": Command("study.status", "tells how far a study is, and when it will have ended", ("yaml",)),
    "study table": Command("study.table", "collects runs into the tables of a study", FITS),
    "study fit": Command("study.fit", "fits laws to a study", FITS),
    "study compare": Command("study.compare", "compares a study with what the paper published", FITS),
    "study plot": Command("study.plot", "draws the paper's figures of a study", DRAWS + FITS),
    "study export": Command(
        "study.export", "writes a study as a data set: tables, provenance, figures", DRAWS + FITS + ("yaml",)
    ),
    "study cost": Command("study.cost", "prints what a study's runs cost, and what the model expects", FITS),
}
DEBIAN = {name: f"python3-{name}" for command in COMMANDS.values() for name in command.needs}


def listed(start=""):
    """The commands that begin so, one a line."""
    found = {name: command.summary for name, command in COMMANDS.items() if name.startswith(start)}
    return "\n".join(f"  {name:<14} {summary}" for name, summary in found.items())


def named(words):
    """The name of the command that the words begin with, and the words after it."""
    for length in (2, 1):
        name = " ".join(words[:length])
        if name in COMMANDS:
            return name, words[length:]
    group = words[0] if words and any(name.startswith(words[0] + " ") for name in COMMANDS) else ""
    rest = words[1:] if group else words
    usage = f"usage: {PROGRAM} COMMAND ... [option ...]\n\n{listed(group)}\n\n{PROGRAM} COMMAND --help says more."
    if not rest:
        sys.exit(usage)
    if rest[0] in ("-h", "--help"):
        print(usage)
        sys.exit()
    sys.exit(
        f"{PROGRAM}: command must be one of {', '.join(COMMANDS)}, got '{' '.join(words[:2] if group else words[:1])}'"
    )


def lacking(needs):
    return [name for name in needs if importlib.util.find_spec(name) is None]


def system_python_has(needs):
    """Whether the system's Python is new enough and has these packages."""
    code = (
        "import importlib.util, sys; "
        f"sys.exit(sys.version_info < {OLDEST} or None in map(importlib.util.find_spec, {needs}))"
    )
    try:
        return subprocess.run([SYSTEM_PYTHON, "-c", code]).returncode == 0
    except OSError:
        return False


def find_packages(name):
    """Goes on when this Python has what the command needs; else runs the command with the system's Python, if that
    has."""
    needs = COMMANDS[name].needs
    missing, old = lacking(needs), sys.version_info < OLDEST
    if not missing and not old:
        return
    if system_python_has(needs):
        sys.stdout.flush()
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
    if old:
        sys.exit(f"{PROGRAM}: Python must be {OLDEST[0]}.{OLDEST[1]} or later, got {sys.version.split()[0]}")
    debian = " ".join(DEBIAN[one] for one in missing)
    sys.exit(
        f"{PROGRAM} {name}: needs the Python package{'s' if len(missing) > 1 else ''} {', '.join(missing)}, which "
        f"neither {sys.executable} nor {SYSTEM_PYTHON} has. On Debian or Ubuntu: sudo apt-get install {debian}; "
        f"elsewhere: {sys.executable} -m pip install {' '.join(missing)}"
    )


def main(words):
    name, words = named(words)
    find_packages(name)
    module = importlib.import_module(f"grainscope.{COMMANDS[name].module}")
    parser = argparse.ArgumentParser(prog=f"{PROGRAM} {name}", description=module.__doc__)
    module.add_arguments(parser)
    try:
        module.run(parser.parse_intermixed_args(words))
    except InputError as error:
        sys.exit(f"{PROGRAM} {name}: {error}")
    except OSError as error:
        reason = f"{error.filename}: {error.strerror}" if error.filename else error
        sys.exit(f"{PROGRAM} {name}: {reason}")
    except KeyboardInterrupt:
        sys.exit(130)
