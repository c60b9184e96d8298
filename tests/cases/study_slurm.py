# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of examples/study as jobs of a SLURM of this machine alone (scripts/local-slurm): a grid of four, one on two
ranks; then a run that is killed half-way and one with bad input beside a good one; then a study that is interrupted. As
root, in about two minutes."""
from contextlib import contextmanager
from dataclasses import dataclass
import json
import os
from pathlib import Path
import re
import signal
import subprocess
import sys
import tempfile
import time

from case import main, require
from grainscope.study.plan import plan
from run import TIME_LIMIT, Failure, binary, wait_until
from slurm import job, local_slurm, output_of

STUDY = Path(os.environ["GRAINSCOPE_SOURCE"]) / "examples" / "study"
SHORT = {"I": [0.1], "N": [100], "strain": 0.4, "steady": 0.2, "part": 0.1, "exceptions": []}
LONG = 10  # strain of what is to be killed half-way
FORGOTTEN = "99999"  # the number of a job that there never was


def minutes(text):
    """Of [days-]hours:minutes:seconds."""
    days, _, rest = text.rpartition("-")
    hours, whole, _ = map(int, rest.split(":"))
    return 1440 * int(days or 0) + 60 * hours + whole


def megabytes(text):
    return int(float(text[:-1]) * {"M": 1, "G": 1024}[text[-1]])


@dataclass
class Submitted:
    """A job by Snakemake's log: its number for SLURM, and what the Snakefile wants for it."""

    name: str
    number: str
    threads: int
    memory: int  # MB
    runtime: int  # minutes


class Study:
    """A study in a folder of its own, with Snakemake at work on some of its runs."""

    def __init__(self, config):
        self.folder = Path(tempfile.mkdtemp(prefix="study-", dir=os.environ["GRAINSCOPE_SCRATCH"]))
        self.config = {**SHORT, "output": str(self.folder / "out"), "program": str(Path(binary()).resolve()), **config}
        (self.folder / "config.json").write_text(json.dumps(self.config))
        self.runs = plan(self.config)
        self.log = self.folder / "snakemake.log"
        self.begin()

    def begin(self, *options):
        command = [
            "snakemake",
            "--snakefile",
            STUDY / "Snakefile",
            "--configfile",
            "config.json",
            "--profile",
            STUDY / "profiles" / "slurm",
            *options,
            *(self.target(run) for run in self.runs.values()),
        ]
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        with self.log.open("w") as log:
            self.snakemake = subprocess.Popen(
                command,
                cwd=self.folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def folder_of(self, run):
        return Path(self.config["output"]) / "runs" / run.name

    def target(self, run):
        return self.folder_of(run) / f"ended_at_{run.variables['strain']}"

    def only(self):
        (run,) = self.runs.values()
        return run

    def submitted(self, name=None):
        """The jobs so far, of all runs or of one."""
        found, asked = [], {}
        for line in self.log.read_text().splitlines():
            words = line.replace(",", " ").split()
            if line == "rule run:":
                asked = {"threads": "1"}
            elif line.startswith(("    wildcards: ", "    resources: ")):
                asked.update(word.split("=", 1) for word in words[1:])
            elif line.startswith("    threads: "):
                asked["threads"] = words[1]
            elif number := re.search(r"^Submitted job .* with external jobid '(\d+)'", line):
                found.append(
                    Submitted(
                        asked["name"], number[1], int(asked["threads"]), int(asked["mem_mb"]), int(asked["runtime"])
                    )
                )
        return [one for one in found if name in (None, one.name)]

    def wait_for_restart_file(self, run):
        wait_until(
            lambda: any(self.folder_of(run).glob("*.restart")),
            f"a restart file of {run.name}; Snakemake's log: {self.log}",
        )

    def end(self):
        """Snakemake's exit code and log."""
        try:
            code = self.snakemake.wait(TIME_LIMIT)
        except subprocess.TimeoutExpired:
            end = self.log.read_text()[-2500:]
            raise Failure(f"Snakemake did not end within {TIME_LIMIT:g} s; its log ends:\n{end}")
        return code, self.log.read_text()

    def kill(self):
        if self.snakemake.poll() is None:
            os.killpg(self.snakemake.pid, signal.SIGKILL)
            self.snakemake.wait()


@contextmanager
def study(**config):
    begun = Study(config)
    try:
        yield begun
    finally:
        begun.kill()


def require_as_asked(one, state):
    """A job became `state`, and had asked for what the Snakefile wants."""
    reported = job(one.number)
    found = (
        reported["JobState"],
        reported["JobName"],
        int(reported["NumTasks"]),
        megabytes(reported["MinMemoryNode"]),
        minutes(reported["TimeLimit"]),
    )
    print(f"job {one.number}: {found}", flush=True)
    expected = state, one.name, one.threads, one.memory, one.runtime
    require(found == expected, f"job {one.number} is {found}, expected {expected}")


def require_ended(study, run):
    for path in (study.target(run), study.folder_of(run) / "grains.dump"):
        require(path.exists(), f"{path} is missing")


def begun_at(study, run):
    """The steps from which the attempts went on."""
    return [int(row.split()[-1]) for row in (study.folder_of(run) / "parameters.txt").read_text().splitlines()[1:]]


def require_went_on(study, run):
    steps = begun_at(study, run)
    require(
        len(steps) == 2 and steps[0] == 0 < steps[1], f"the attempts began at steps {steps}, expected 0 and another"
    )


def status(number):
    return output_of(STUDY / "profiles" / "slurm" / "status.py", number).strip()


def grid():
    on_two = {"where": {"alpha": 1, "mu": 0.4}, "use": {"ranks": 2}}
    with study(alpha=[0.67, 1], mu=[0.1, 0.4], exceptions=[on_two]) as four:
        wait_until(lambda: len(four.submitted()) == 4, "four jobs submitted")
        print(output_of("squeue"), flush=True)
        code, log = four.end()
        require(code == 0, f"Snakemake ended with code {code}; its log ends:\n{log[-2500:]}")
        jobs = four.submitted()
        require(sorted(one.name for one in jobs) == sorted(four.runs), f"not each run once but {jobs}")
        require(sorted(one.threads for one in jobs) == [1, 1, 1, 2], f"not one run on two ranks: {jobs}")
        for one in jobs:
            require_as_asked(one, "COMPLETED")
            require_ended(four, four.runs[one.name])
            require(status(one.number) == "success", f"status.py calls job {one.number} {status(one.number)}")
        print(output_of("scontrol", "show", "job", jobs[0].number), flush=True)
    require(status(FORGOTTEN) == "failed", f"status.py calls a forgotten job {status(FORGOTTEN)}")


def killed_and_refused():
    """Seeds: the first run is good, the second long, and a third has a restitution that the program refuses."""
    exceptions = [
        {"where": {"seed": 32452843}, "use": {"strain": LONG}},
        {"where": {"seed": 49979687}, "use": {"e": 1.5}},
    ]
    with study(alpha=[1], mu=[0.4], seed=[15485863, 32452843, 49979687], exceptions=exceptions) as three:
        good, long, bad = three.runs.values()
        three.wait_for_restart_file(long)
        first = three.submitted(long.name)[0]
        output_of("scancel", first.number)
        code, log = three.end()
        require(code == 1, f"Snakemake ended with code {code}; its log ends:\n{log[-2500:]}")

        require_as_asked(three.submitted(good.name)[0], "COMPLETED")
        require_ended(three, good)

        _, second = three.submitted(long.name)
        require_as_asked(first, "CANCELLED")
        require_as_asked(second, "COMPLETED")
        require(
            (second.runtime, second.memory) == (2 * first.runtime, 2 * first.memory),
            "the second attempt is not given twice as much",
        )
        require_ended(three, long)
        require_went_on(three, long)

        attempts = three.submitted(bad.name)
        require(len(attempts) == 2, f"bad input was tried {len(attempts)} times, expected twice")
        for one in attempts:
            require_as_asked(one, "FAILED")
            said = (Path(three.config["output"]) / "slurm-logs" / f"{bad.name}_{one.number}.txt").read_text()
            require("coefficientRestitution" in said, f"the log of job {one.number} does not give the reason: {said}")
        require(not three.target(bad).exists(), "bad input made a run that ended")
        for one in (first, *attempts):
            require(
                f"external: {one.number}," in log,
                f"Snakemake did not report job {one.number}; its log ends:\n{log[-2500:]}",
            )


def interrupted():
    """A Ctrl-C cancels the job, a Snakemake that is killed leaves it; the same command goes on with the one, and waits
    for the other."""
    with study(alpha=[1], mu=[0.4], strain=LONG) as stopped, study(alpha=[1], mu=[0.1], strain=LONG) as killed:
        for one in (stopped, killed):
            one.wait_for_restart_file(one.only())
        cancelled, left = stopped.submitted()[0], killed.submitted()[0]
        os.killpg(stopped.snakemake.pid, signal.SIGINT)
        killed.kill()
        stopped.end()
        wait_until(lambda: job(cancelled.number)["JobState"] == "CANCELLED", f"job {cancelled.number} cancelled")
        killed.begin("--unlock")
        killed.end()
        require_as_asked(left, "RUNNING")
        for one in (stopped, killed):
            one.begin()
        for one in (stopped, killed):
            code, log = one.end()
            require(code == 0, f"Snakemake ended with code {code}; its log ends:\n{log[-2500:]}")
            require_ended(one, one.only())
            require_as_asked(one.submitted()[0], "COMPLETED")
        require_went_on(stopped, stopped.only())
        require(
            begun_at(killed, killed.only()) == [0],
            f"the run was taken up at steps {begun_at(killed, killed.only())} while its job still ran",
        )


def slurm_grid(ranks):
    signal.signal(
        signal.SIGINT, signal.default_int_handler
    )  # what a shell starts in the background ignores it, and so would Snakemake
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("stopped by SIGTERM"))
    with local_slurm(Path(os.environ["GRAINSCOPE_SCRATCH"]) / "slurm"):
        for part in (grid, killed_and_refused, interrupted):
            begin = time.monotonic()
            part()
            print(f"{part.__name__}: {time.monotonic() - begin:.0f} s\n", flush=True)


main({"slurm-grid": slurm_grid})
