# SPDX-License-Identifier: GPL-2.0-or-later
"""The command grainscope-tools: its table, the Python that it finds, what it says where packages are missing, the
examples of its page, and its progress."""
import ast
from io import StringIO
import os
from pathlib import Path
import re
import shlex
import subprocess

from case import main, require
from command import asked, require_refused
from grainscope.commands import COMMANDS, DEBIAN
from grainscope.progress import Line, followed, progress
from run import wait_until

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
TOOL = SOURCE / "tools" / "grainscope-tools"
PYTHON = "/usr/bin/python3"


def scratch(name=""):
    return Path(os.environ["GRAINSCOPE_SCRATCH"]) / name


def called(*command, **changes):
    """Exit code, standard output and error of a command in a folder of its own."""
    done = subprocess.run(
        [*map(str, command)], cwd=scratch(), env={**os.environ, **changes}, capture_output=True, text=True
    )
    return done.returncode, done.stdout, done.stderr


def help_of_all(ranks):
    """Every command is listed, has a page in doc/tools.md, and describes itself."""
    code, said = asked("--help")
    require(code == 0, said)
    page = (SOURCE / "doc" / "tools.md").read_text()
    for name, command in COMMANDS.items():
        require(re.search(rf"^  {name} +{re.escape(command.summary)}$", said, re.M), f"{name} is not in: {said}")
        require(re.search(rf"^    grainscope-tools {name} ", page, re.M), f"doc/tools.md has no example of {name}")
        code, own = asked(*name.split(), "--help")
        require(code == 0 and own.startswith(f"usage: grainscope-tools {name} "), f"{name}: {own}")
    code, said = asked("study", "--help")
    require(code == 0 and "  study fit" in said and "  plot" not in said, said)


def unknown_refused(ranks):
    code, said = asked()
    require(code == 1 and said.startswith("usage: grainscope-tools COMMAND"), f"{code}: {said}")
    require_refused(["polt"], "command must be one of plot, rows,", "got 'polt'")
    require_refused(["study", "pilot", "x"], "study plot", "got 'study pilot'")
    require_refused(["plot", "x", "--nothing"], "--nothing")


def missing_input_refused(ranks):
    """Every command names the file that is not there, or what is wrong with a value."""
    none = scratch("none")
    for words, *expected in (
        (["plot", none], f"{none}: No such file"),
        (["rows", none, "--output", "a.png"], f"{none}: No such file"),
        (["render", none], f"{none}: No such file"),
        (["convert", none, "--to", "vtk"], f"{none}: No such file"),
        (["summarise", none], f"{none}/parameters.txt: No such file"),
        (["figures", none, "--output", scratch()], f"{none}/parameters.txt: No such file"),
        (["study", "plan", none], f"{none}: No such file"),
        (["study", "plan", SOURCE / "README.md"], "README.md"),
        (["study", "plan", TOOL], "grainscope-tools"),
        (["study", "run-grid", none, "--hours", "1"], f"{none}: No such file"),
        (["study", "status", none], f"{none}: No such file"),
        (["study", "export", none, "--output", scratch()], f"{none}: No such file"),
        (["study", "table", none], f"{none}/parameters.txt: No such file"),
        (["study", "table", f"{none}:half"], f"with a number, got '{none}:half'"),
        (["study", "fit", none], f"{none}/curves/correlation.csv: No such file"),
        (["study", "compare", none], f"{none}/curves/correlation.csv: No such file"),
        (["study", "plot", none], f"{none}/curves/correlation.csv: No such file"),
        (["study", "plot", none, "fig99.png"], "figure must be one of", "got 'fig99.png'"),
        (["study", "cost", none], f"{none}/curves/correlation.csv: No such file"),
        (["study", "run", none, "alpha"], "a variable must be name=value, got 'alpha'"),
        (["study", "run", scratch("new"), "alpha=1", "--binary", none], f"{none}: No such file"),
    ):
        require_refused(words, f"grainscope-tools {words[0]}", *expected)


def runs_refused(ranks):
    """What a run cannot give: averages from a strain that it does not reach, other variables than it began with."""
    out = scratch("out")
    words = ["alpha=1", "N=100", "strain=0.6", "part=0.1", "--binary", os.environ["GRAINSCOPE_BINARY"]]
    code, said, complaint = called(TOOL, "study", "run", out, *words)
    require(code == 0, said + complaint)
    late = "0 rows beyond strain 9, at least 16 are needed; the run ends at 0.6"
    for words, expected in (
        (["summarise", out, "--from", 9], late),
        (["figures", out, "--from", 9, "--output", scratch()], late),
        (["study", "table", f"{out}:9", "--output", scratch()], late),
        (["study", "run", out, "alpha=2", *words[1:]], f"{out}: alpha must stay what the run began with, 1, got 2"),
        (["rows", out / "series.txt", "--output", scratch("a.png")], "is for `plot`"),
        (["plot", out / "series.txt", "mu"], "no column 'mu'; nearest: mu_eff"),
    ):
        require_refused(words, expected)


def python_without_numpy(ranks):
    """The first Python on PATH has no packages: the system's is found, with the same answer."""
    python = scratch("python3")
    python.write_text(f'#!/bin/sh\nexec {PYTHON} -S "$@"\n')
    python.chmod(0o755)
    path = f"{scratch()}:{os.environ['PATH']}"
    require(called("python3", "-c", "import numpy", PATH=path)[0] == 1, "the Python of this test has numpy")
    words = ["study", "cost", SOURCE / "examples/study/results"]
    code, said, complaint = called(TOOL, *words, PATH=path)
    require(code == 0 and (0, said) == asked(*words), f"{code}: {complaint}")
    link = scratch("linked")
    link.symlink_to(TOOL)
    require(called(link, *words, PATH=path)[1] == said, "by a link from elsewhere")


def without_packages(code, *words):
    """The command by a Python without packages and no other Python, after a line of code."""
    start = f"import sys; sys.path.insert(0, {str(TOOL.parent)!r}); from grainscope import commands; "
    start += f"commands.SYSTEM_PYTHON = '/no/python3'; {code}; commands.main({list(words)!r})"
    return called(PYTHON, *code.startswith("pass") * ["-S"], "-c", start)


def missing_packages_named(ranks):
    """One sentence, with what is missing and how to get it, exit code 1; what needs no packages works."""
    for name, command in COMMANDS.items():
        code, said, complaint = without_packages("pass", *name.split(), "x")
        if command.needs:
            expected = f"grainscope-tools {name}: needs the Python package"
            require(code == 1 and complaint.startswith(expected), f"{name}: {code}, {complaint}")
            require(complaint.count("\n") == 1 and not said, complaint)
            for one in command.needs:
                require(f" {one}" in complaint and f" {DEBIAN[one]}" in complaint, f"{one} is not in {complaint}")
    code, said, _ = without_packages("pass", "study", "run", "--help")
    require(code == 0 and "usage: grainscope-tools study run" in said, f"{code}: {said}")
    code, _, complaint = without_packages("sys.modules['pandas'] = None", "plot", "x")
    require(
        code == 1 and f"needs the Python package pandas, which neither {PYTHON} nor /no/python3 has" in complaint,
        f"{code}: {complaint}",
    )
    require("sudo apt-get install python3-pandas;" in complaint and "numpy" not in complaint, complaint)
    code, _, complaint = without_packages("commands.OLDEST = (4, 0)", "plot", "x")
    require(code == 1 and "Python must be 4.0 or later, got 3." in complaint, f"{code}: {complaint}")


def packages_are_installed_by_scripts(ranks):
    text = (SOURCE / "scripts" / "install-packages").read_text()
    for package in DEBIAN.values():
        require(package in text.split(), f"scripts/install-packages lacks {package}")


def syntax_of_python_3_9(ranks):
    for path in (SOURCE / "tools").rglob("*.py"):
        ast.parse(path.read_text(), feature_version=(3, 9))
    ast.parse((SOURCE / "tools" / "grainscope" / "commands.py").read_text(), feature_version=(3, 6))


def examples_of_page(ranks):
    """Each line of doc/tools.md that is a command, one after the other."""
    page = (SOURCE / "doc" / "tools.md").read_text()
    lines = [shlex.split(line, comments=True) for line in re.findall(r"^    (grainscope-tools .*)$", page, re.M)]
    require(len(lines) >= len(COMMANDS), f"only {len(lines)} examples")
    (scratch("examples")).symlink_to(SOURCE / "examples")
    for words in lines:
        if words[1:3] in (["study", "run"], ["study", "run-grid"]):
            words += ["--binary", os.environ["GRAINSCOPE_BINARY"]]
        code, said, complaint = called(TOOL, *words[1:])
        require(code == 0, f"{' '.join(words)}: {code}, {said}{complaint}")
    for name in (
        "flow.png",
        "late.png",
        "surface.png",
        "surface.gif",
        "grains.png",
        "vtk/surfaces.pvd",
        "ovito.dump",
        "pictures/series.png",
        "fits/fits.csv",
        "first-try/status.html",
        "dataset/table.csv",
    ):
        require(scratch(name).stat().st_size > 0, f"{name} is empty")


class Terminal(StringIO):
    def isatty(self):
        return True


def progress_is_said(ranks):
    """Nothing within five seconds; then which of how many and the time left, twice a second on a terminal, every 30 s
    elsewhere; the items are unchanged."""
    for out, step, expected in (
        (StringIO(), 0.4, []),
        (Terminal(), 0.4, []),
        (StringIO(), 2.0, ["runs: 4 of 10, 14 s left"]),
        (StringIO(), 20.0, ["runs: 2 of 10, 3 min 00 s left", "runs: 4 of 10, 2 min 20 s left"]),
        (Terminal(), 2.0, [f"runs: {k} of 10, {2 * (11 - k)} s left" for k in range(4, 11)]),
    ):
        now = [100.0]
        line = Line(out, lambda: now[0])
        for item in progress(range(10), "runs", line):
            now[0] += step
        require(item == 9, f"the last item is {item}")
        said = re.split(r"\r\x1b\[K|\n", out.getvalue())
        said = [text for text in said if text]
        require(said[: len(expected)] == expected and bool(said) == bool(expected), f"{step}: {said}")
    require(out.getvalue().endswith("\r\x1b[K"), "the line stays")


def run_is_followed(ranks):
    """What a run has reached is said on a terminal alone."""
    for out in (StringIO(), Terminal()):
        times = iter(range(0, 10000, 6))
        line = Line(out, lambda: next(times))
        asked_for = []
        with followed(lambda: asked_for.append(1) or "strain 1", line):
            if out.isatty():
                wait_until(lambda: len(asked_for) > 1, "the line that follows a run")
        require(("strain 1" in out.getvalue()) == out.isatty(), f"{out.getvalue()!r}")


main(
    {
        "help-of-all": help_of_all,
        "unknown-refused": unknown_refused,
        "missing-input-refused": missing_input_refused,
        "runs-refused": runs_refused,
        "python-without-numpy": python_without_numpy,
        "missing-packages-named": missing_packages_named,
        "packages-are-installed-by-scripts": packages_are_installed_by_scripts,
        "syntax-of-python-3-9": syntax_of_python_3_9,
        "examples-of-page": examples_of_page,
        "progress-is-said": progress_is_said,
        "run-is-followed": run_is_followed,
    }
)
