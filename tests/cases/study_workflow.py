# SPDX-License-Identifier: GPL-2.0-or-later
"""The workflow of examples/study by Snakemake itself: a small grid with runs that fail; what is made of the others;
going on."""
import os
from pathlib import Path
import shutil
import subprocess

import yaml

from case import main, require
from grainscope.study.table import read_csv
from run import TIME_LIMIT, environment

SOURCE = Path(os.environ["GRAINSCOPE_SOURCE"])
# A box of 20 grains gets too flat while it is compressed; 150 are enough.
CONFIG = {"alpha": [1], "mu": [0.4, 1], "I": [0.1], "N": [20, 150], "strain": 0.5, "steady": 0.1, "part": 0.1}


def folder():
    return Path(os.environ["GRAINSCOPE_SCRATCH"])


def snakemake(*words, **changes):
    """Exit status and output of the workflow on a configuration with these changes."""
    config = {**CONFIG, "program": os.environ["GRAINSCOPE_BINARY"], **changes}
    (folder() / "study.yaml").write_text(yaml.safe_dump(config))
    command = [
        "snakemake",
        "-s",
        SOURCE / "examples/study/Snakefile",
        "--configfile",
        "study.yaml",
        "--directory",
        folder(),
        "-c2",
        "-k",
        *words,
    ]
    require(shutil.which("snakemake"), "snakemake is missing: scripts/install-packages snakemake")
    done = subprocess.run(
        [*map(str, command)],
        env=environment(1),
        cwd=folder(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=TIME_LIMIT,
    )
    return done.returncode, done.stdout


def run_folders():
    return {path.name: path for path in (folder() / "study-output/runs").iterdir()}


def failing_runs_do_not_stop_others(ranks):
    status, output = snakemake()
    require(status != 0, "two runs must fail, and the workflow with them")
    for mu in ("0.4", "1"):
        good = run_folders()[f"alpha1_mu{mu}_I0.1_N150_seed15485863"]
        require((good / "ended_at_0.5").exists(), f"the good run of mu = {mu} did not end:\n{output}")
        require(
            f"study: alpha1_mu{mu}_I0.1_N20_seed15485863 did not end" in output,
            f"the failed run is not reported:\n{output}",
        )
    require("the box becomes too small" in output, f"the reason is not given:\n{output}")
    require("--config partial=1" in output, f"the way on is not given:\n{output}")

    status, output = snakemake("--config", "partial=1")
    require(status == 0, f"the study of the runs that ended was not made:\n{output}")
    study = folder() / "study-output"
    require(
        sorted((row["run"], row["state"]) for row in read_csv(study / "table.csv"))
        == [
            (f"alpha1_mu{mu}_I0.1_N{grains}_seed15485863", state)
            for mu in ("0.4", "1")
            for grains, state in ((150, "ended"), (20, "not run"))
        ],
        "the table must hold the runs that ended, and name the others",
    )
    require(
        (study / "comparison.md").read_text().startswith("**partial: 2 of 4 points**"), "it must say that it is partial"
    )
    require(
        {"fig02.png", "fig03.png", "fig08.png", "fig14.png", "fig18.png", "memory.png"}
        <= {path.name for path in (study / "figures").iterdir()},
        "figures are missing",
    )
    for name in ("fits.csv", "crossovers.csv", "comparison.md", "cost.md", "columns.csv"):
        require((study / name).stat().st_size > 0, f"{name} is empty")

    # Figures are redrawn from the tables alone.
    shutil.rmtree(study / "runs")
    shutil.rmtree(study / "figures")
    done = subprocess.run(
        [SOURCE / "tools/grainscope-tools", "study", "plot", study, "--output", study / "figures"],
        capture_output=True,
        text=True,
    )
    require(done.returncode == 0 and (study / "figures/fig11.png").exists(), f"no figures without runs:\n{done.stderr}")


def study_goes_on(ranks):
    """A larger strain prolongs the runs; nothing runs again that has ended."""
    status, output = snakemake("study-output/table.csv", N=[150])
    require(status == 0, f"the study failed:\n{output}")
    status, output = snakemake("study-output/table.csv", N=[150])
    require("Nothing to be done" in output, f"the study has ended, but:\n{output}")
    status, output = snakemake("study-output/table.csv", N=[150], strain=0.7)
    require(status == 0, f"the longer study failed:\n{output}")
    for path in run_folders().values():
        rows = [line.split() for line in (path / "parameters.txt").read_text().splitlines()[1:]]
        require(
            len(rows) == 2 and rows[1][-1] == rows[0][-2],
            f"{path}: the second attempt did not begin where the first ended",
        )
    require(
        {row["strain"] for row in read_csv(folder() / "study-output/table.csv")} == {"0.7"},
        "the table holds the longer runs",
    )


def basic_measures(ranks):
    status, output = snakemake(N=[150], mu=[0.4], measure="basic")
    require(status == 0, f"the study failed:\n{output}")
    found = {path.name for path in (folder() / "study-output/figures").iterdir()}
    require(
        found == {f"fig{number}.png" for number in ("02", "03", "04", "07", "08", "14")}, f"figures {sorted(found)}"
    )


def bad_configuration(ranks):
    status, output = snakemake(mu=[-1])
    require(status != 0 and "study: mu must be a number of at least 0, got -1" in output, f"not refused:\n{output}")
    require(not (folder() / "study-output").exists(), "something was run")


main(
    {
        "failing-runs-do-not-stop-others": failing_runs_do_not_stop_others,
        "study-goes-on": study_goes_on,
        "basic-measures": basic_measures,
        "bad-configuration": bad_configuration,
    }
)
