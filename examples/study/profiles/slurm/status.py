#!/usr/bin/python3
"""Tells Snakemake what became of a job of SLURM: running, success or failed."""
import subprocess
import sys

PATIENCE = 60  # seconds for an answer
# All other states than these and COMPLETED are of a job that waits, runs or is about to end.
ENDED_BADLY = (
    "BOOT_FAIL",
    "CANCELLED",
    "DEADLINE",
    "FAILED",
    "NODE_FAIL",
    "OUT_OF_MEMORY",
    "PREEMPTED",
    "REVOKED",
    "TIMEOUT",
)
FORGOTTEN = "Invalid job id specified"


def answer(*command):
    """(whether it succeeded, what it printed or complained of)"""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    except (OSError, subprocess.TimeoutExpired) as error:
        return False, str(error)
    return done.returncode == 0, done.stdout if done.returncode == 0 else done.stderr


def state_of_forgotten(job):
    """The controller forgets a job some minutes after its end; a cluster with accounting keeps its state. Elsewhere it
    counts as failed: Snakemake submits the run again, which goes on from its restart files or, if it had ended, ends at
    once."""
    known, text = answer("sacct", "--allocations", "--noheader", "--parsable2", "--format=State", f"--jobs={job}")
    return text.split()[0] if known and text.split() else "FAILED"


def state(job):
    known, text = answer("scontrol", "--oneliner", "show", "job", job)
    if known:
        return dict(word.partition("=")[::2] for word in text.split())["JobState"]
    if FORGOTTEN in text:
        return state_of_forgotten(job)
    print(f"status.py: job {job}: {text.strip()}; asking again later", file=sys.stderr)
    return "UNKNOWN"  # Snakemake goes on asking, until a controller that is busy or down answers


def main():
    found = state(sys.argv[1])
    print("success" if found == "COMPLETED" else "failed" if found in ENDED_BADLY else "running")


if __name__ == "__main__":
    main()
