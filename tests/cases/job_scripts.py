# SPDX-License-Identifier: GPL-2.0-or-later
"""The job scripts of examples/long_run: a run that is stopped at a time limit, submitted again and ends with the bits
of one that was not; a job array. Slurm's by a SLURM of this machine (as root), the others with a qsub that takes
notes."""
import os
from pathlib import Path
import re
import shutil
import subprocess

from case import main, require
from run import Failure, binary, environment, wait_until
from slurm import job, local_slurm, output_of

EXAMPLE = Path(os.environ["GRAINSCOPE_SOURCE"]) / "examples" / "long_run"
STEPS, PART = 20000, 400
SCHEDULER = {"NSLOTS": "2", "PBS_JOBID": "7", "JOB_ID": "7"}  # what PBS and SGE tell a job
WHOLE = ["mpirun", "-np", "2", "grainscope", "-in", "in.long_run", "-var", "grid", "2 1 1"]


def variables(**more):
    """The environment of a user who has the program on PATH."""
    env = {**environment(1), **more}
    env.update(OMPI_MCA_hwloc_base_binding_policy="none", PRTE_MCA_hwloc_default_binding_policy="none")
    return {**env, "PATH": f"{more.get('bin', '')}{os.pathsep}{Path(binary()).parent}{os.pathsep}{env['PATH']}"}


def folder(name):
    """A copy of the example, with a shorter run."""
    copy = Path(os.environ["GRAINSCOPE_SCRATCH"]) / name
    shutil.copytree(EXAMPLE, copy)
    deck = (copy / "in.long_run").read_text()
    for variable, value in (("steps", STEPS), ("part", PART)):
        deck, count = re.subn(rf"^(variable {variable} +index) \d+", rf"\1 {value}", deck, flags=re.M)
        require(count == 1, f"the example has no variable {variable}")
    (copy / "in.long_run").write_text(deck)
    return copy


def uninterrupted():
    copy = folder("whole")
    done = subprocess.run(WHOLE, cwd=copy, env=variables(**environment(2)), capture_output=True, text=True)
    require(done.returncode == 0, done.stdout[-2000:] + done.stderr)
    return (copy / "grains.dump").read_bytes()


def require_went_on(copy, expected):
    require((copy / "grains.dump").read_bytes() == expected, "the grains are not those of the uninterrupted run")
    require(len(list(copy.glob("flow.*.txt"))) > 1, "the run was not stopped and taken up")


def by_timer(name, *again):
    """The script run by hand, with time limits from a fifth of a second on, each twice the last, for as long as it
    submits itself again with these words."""

    def case(ranks):
        copy, programs = folder("stopped"), Path(os.environ["GRAINSCOPE_SCRATCH"]) / "bin"
        programs.mkdir()
        (programs / "qsub").write_text('#!/bin/sh\necho "$*" >> submitted\n')
        (programs / "qsub").chmod(0o755)
        jobs, limit = 0, 0.2
        while jobs == 0 or (copy / "submitted").exists():
            (copy / "submitted").unlink(missing_ok=True)
            env = variables(bin=programs, LIMIT=str(limit), **SCHEDULER, PBS_O_WORKDIR=str(copy))
            done = subprocess.run(["bash", name], cwd=copy, env=env, capture_output=True, text=True)
            require(done.returncode == 0, f"job {jobs}: {done.stdout[-2000:]}{done.stderr}")
            if (copy / "submitted").exists():
                said = (copy / "submitted").read_text()
                require(said == " ".join([*again, name]) + "\n", f"it submitted '{said}'")
            jobs, limit = jobs + 1, 2 * limit
        require(jobs > 1, "no time limit stopped the run")
        require((copy / "grains.dump").read_bytes() == uninterrupted(), "other grains than of the uninterrupted run")

    return case


def ended(copy):
    """All jobs of the folder have left the queue."""
    return lambda: not output_of("squeue", "--noheader", "--format=%i")


def stopped_by_slurm(copy):
    """Submits job.slurm and has Slurm send the signal that it sends before a time limit, once there are restart files;
    false when the run ended before."""
    number = output_of("sbatch", "--parsable", "--chdir", copy, copy / "job.slurm").strip()

    def over():
        return job(number)["JobState"] in ("COMPLETED", "FAILED")

    wait_until(lambda: (copy / "odd.restart").exists() or over(), "two restart files")
    subprocess.run(["scancel", "--batch", "--signal=TERM", number], check=False, capture_output=True)
    wait_until(over, "the end of the first job")
    require(job(number)["JobState"] == "COMPLETED", (copy / "long_run.out").read_text()[-2000:])
    wait_until(ended(copy), "the end of all jobs")
    return len(list(copy.glob("flow.*.txt"))) > 1


def slurm(ranks):
    os.environ.update(variables())
    expected = uninterrupted()
    with local_slurm(Path(os.environ["GRAINSCOPE_SCRATCH"]) / "slurm"):
        for attempt in range(100):
            copy = folder(f"stopped-{attempt}")
            if stopped_by_slurm(copy):
                break
        else:
            raise Failure("no job could be stopped")
        require_went_on(copy, expected)
        copy = folder("array")
        output_of("sbatch", "--parsable", "--chdir", copy, "--array=1-2", copy / "array.slurm")
        wait_until(ended(copy), "the end of the array")
        results = [(copy / f"seed_{n}" / "grains.dump").read_bytes() for n in (1, 2)]
        require(results[0] != results[1], "two seeds gave the same grains")


main(
    {
        "slurm": slurm,
        "pbs": by_timer("job.pbs", "-W", "depend=afterany:7"),
        "sge": by_timer("job.sge", "-hold_jid", "7"),
    }
)
