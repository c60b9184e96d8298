# SPDX-License-Identifier: GPL-2.0-or-later
"""A study run in slices of time by `grainscope-tools study run-grid`: in which order, within which time, stopped and
killed, to the same bits, one at a time."""
import fcntl
import os
import signal

import yaml

from case import main, require, require_close
from command import require_refused
from grainscope.study.cost_model import START_STEPS, steps_per_strain
from grainscope.study.part_clock import MARGIN, PartClock
from grainscope.study.plan import plan
from grainscope.study.run_grid import Grid
from grainscope.study.state import RunState, Speed
from run import processes_of, wait_until
from shear_runs import SMALL, attempts_of, end_of, ended, folder, ranks_of, same_tables, tool

# Two runs that want each other's place: the second group's is cheaper.
STUDY = {
    **{name: SMALL[name] for name in ("measure", "strain", "steady", "part")},
    **{"alpha": [1], "mu": [0.4], "I": [0.1], "N": [SMALL["N"]]},
    "groups": [{"name": "first", "points": [{"mu": [0.4, 1]}]}, {"name": "second", "points": [{"mu": 0.1, "N": 140}]}],
    "output": "grid",
}
NAMES = [f"alpha1_mu{mu}_I0.1_N{grains}_seed15485863" for mu, grains in ((0.4, 150), (1, 150), (0.1, 140))]


def grid(*options, **changes):
    """A process of run-grid on the study with these changes."""
    folder("study.yaml").write_text(yaml.safe_dump({**STUDY, **changes}))
    return tool("study", "run-grid", "study.yaml", "--binary", os.environ["GRAINSCOPE_BINARY"], *options)


def run_of(name):
    return folder("grid") / "runs" / name


class Clock:
    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


def parts_within_time(ranks):
    """Of 100 s, parts of 20 s: a fifth one is not begun, because 80 s and 1.25 x 20 s are more."""
    clock = Clock()
    parts, said = PartClock(100.0, clock), []
    require(not parts.must_end(["left by an earlier attempt"]), "nothing has ended yet")
    for part in range(1, 5):
        clock.now += 20.0
        require(not parts.must_end([part - 1 or "left by an earlier attempt"]), f"within part {part}")
        said.append(parts.must_end([part]))
    require(said == [False, False, False, True], f"after parts: {said}")
    require(parts.must_end([4]), "it must end for good")

    clock = Clock()
    parts = PartClock(50.0, clock)
    parts.must_end([None])
    clock.now += 49.9
    require(not parts.must_end([None]), "there is time left")
    clock.now += 0.2
    require(parts.must_end([None]), "a part that is longer than all the time must be stopped")
    clock.now += 1e9
    require(not PartClock(None, clock).must_end([1]), "without hours there is no end")


def made(seconds, clock, **states):
    runs = list(plan({**STUDY, "output": str(folder("none"))}).values())
    found = Grid(runs, folder("none"), "program", 1, seconds, clock)
    found.states.update(states)
    return found


def first_that_fits(ranks):
    """Group after group; what does not fit is passed over and named; measured times take the place of the model's."""
    clock = Clock()
    whole = made(1e9, clock)
    require([run.name for run in whole.runs] == NAMES, f"order {[run.name for run in whole.runs]}")
    require(whole.next_run().name == NAMES[0], "the first of the first group")
    whole.tried.update(NAMES[:2])
    require(whole.next_run().name == NAMES[2] and not whole.too_long, "then the second group")

    model = whole.runs[0].seconds / (0.6 * steps_per_strain(1, 0.1))
    first_part = model * (0.1 * steps_per_strain(1, 0.1) + START_STEPS)
    speed = Speed(whole.runs, whole.states)
    expected = speed.seconds_of_part(whole.runs[0], RunState("waiting"))
    require_close(expected, first_part, 1e-9, "first part by the model")
    just = made(MARGIN * first_part * 0.999, clock)
    require(just.next_run().name == NAMES[2], "the smaller run fits")
    require(set(just.too_long) == set(NAMES[:2]), f"too long: {just.too_long}")
    require(made(MARGIN * first_part * 1.001, clock).next_run().name == NAMES[0], "there is time for its first part")

    # A run of this shape that took ten times as long as the model says: the others are expected to, too.
    known = {NAMES[0]: RunState("ended", 0.6, 1000, 10 * 1000 * model)}
    slow = made(MARGIN * first_part * 1.001, clock, **known)
    require(slow.next_run() is None and set(slow.too_long) == set(NAMES[1:]), f"too long: {slow.too_long}")
    require_close(slow.too_long[NAMES[1]], 10 * first_part, 1e-9, "first part by what was measured")
    left = Speed(slow.runs, slow.states).seconds_left(slow.runs[1], RunState("begun", 0.45))
    require_close(left, 10 * slow.runs[1].seconds * 0.25, 1e-9, "time left of a run at 0.45 of 0.6")


def whole_runs():
    return [ended(f"whole{k}", mu=mu, N=grains) for k, (mu, grains) in enumerate(((0.4, 150), (1, 150), (0.1, 140)))]


def cut(stop, jobs=2):
    """A slice to which stop(process) is done when the first run has written its second restart file; what it said."""
    process = grid("--hours", "100", "--jobs", str(jobs))
    wait_until(
        lambda: process.poll() is not None or (run_of(NAMES[0]) / "odd.restart").exists(), "a second restart file"
    )
    stop(process)
    return end_of(process)


def finish():
    status, output = end_of(grid("--hours", "100", "--jobs", "2"))
    require(status == 0 and "3 of 3 runs have ended" in output, f"ended with {status}: {output}")
    for name, whole in zip(NAMES, whole_runs()):
        same_tables(run_of(name), whole)
        require((run_of(name) / "grains.dump").read_bytes() == (whole / "grains.dump").read_bytes(), f"{name}: grains")
    status, output = end_of(grid("--hours", "100"))
    require(status == 0 and "begins" not in output and "goes on" not in output, f"nothing is left, but: {output}")


def stopped_slice_goes_on(ranks):
    """SIGTERM ends a slice in order, with everything that it has begun."""
    status, output = cut(lambda process: os.kill(process.pid, signal.SIGTERM))
    require(status == 0, f"the slice ended with {status}: {output}")
    finish()
    slices = (folder("grid") / "slices.csv").read_text().splitlines()[1:]
    require(len(slices) == 3 and all(row.split(",")[1] for row in slices), f"slices {slices}")


def killed_slice_goes_on(ranks):
    """SIGKILL of run-grid alone: what it has begun ends by itself, and a slice that begins at once waits for that."""
    cut(lambda process: os.kill(process.pid, signal.SIGKILL))
    finish()
    for name in NAMES:
        begins = attempts_of(run_of(name))
        require(begins == sorted(set(begins)), f"{name}: attempts began at {begins}")


def killed_slice_leaves_none(ranks):
    """No program outlives its slice by more than the time in which it stops."""
    process = grid("--hours", "100", "--jobs", "2", strain=1000, steady=0.2)
    wait_until(lambda: process.poll() is not None or len(ranks_of(process)) == 2, "two programs")
    os.kill(process.pid, signal.SIGKILL)
    end_of(process)
    wait_until(lambda: not list(processes_of(process.pid)), "the end of what a killed slice has begun")


def one_slice_at_a_time(ranks):
    folder("grid").mkdir()
    with (folder("grid") / "grid.lock").open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        status, output = end_of(grid("--hours", "100"))
    require(status == 1 and "another study run-grid works in this folder" in output, f"ended with {status}: {output}")
    require(not (folder("grid") / "runs").exists(), "something was run")


def nothing_fits(ranks):
    """The reason is given, with the times."""
    status, output = end_of(grid("--hours", "1e-9"))
    require(status == 0 and "0 of 3 runs have ended" in output, f"ended with {status}: {output}")
    require("no part of the 3 runs that were left fits" in output and NAMES[2] in output, f"it said {output}")
    require(not (folder("grid") / "runs").exists(), "something was run")


def failures_are_told(ranks):
    """A run that fails stops no other, and the status has its last lines."""
    flat = [{"name": "flat", "points": [{"alpha": 3, "N": 20}]}, {"name": "round", "points": [{"mu": 1}]}]
    status, output = end_of(grid("--hours", "100", groups=flat))
    bad = "alpha3_mu0.4_I0.1_N20_seed15485863"
    require(status == 1 and f"1 runs failed: {bad}" in output, f"ended with {status}: {output}")
    require("1 of 2 runs have ended" in output and "periodic box must be at least" in output, f"it said {output}")
    _, status = end_of(tool("study", "status", "study.yaml"))
    require("| flat | 1 | 0 | 0 | 0 | 0 | 1 |" in status and "| round | 1 | 1 | 0 | 0 | 0 | 0 |" in status, status)
    require(f"- {bad}: exit status 1: ERROR" in status and "      ERROR: pair_style" in status, status)
    page = (folder("grid") / "status.html").read_text()
    require("<h2>Failed</h2>" in page and "periodic box" in page, page)


def options_refused(ranks):
    folder("study.yaml").write_text(yaml.safe_dump(STUDY))
    words = ["study", "run-grid", folder("study.yaml")]
    require_refused([*words, "--hours", "0"], "--hours: must be a number above 0, got '0'")
    require_refused([*words, "--hours", "1", "--jobs", "1.5"], "--jobs: must be a whole number above 0, got '1.5'")
    require_refused([*words, "--hours", "1", "--jobs", "0"], "--jobs: must be a number above 0, got '0'")
    require_refused(words, "--hours")
    require_refused(["study", "run-grid", folder("none"), "--hours", "1"], "none: No such file")


main(
    {
        "parts-within-time": parts_within_time,
        "first-that-fits": first_that_fits,
        "stopped-slice-goes-on": stopped_slice_goes_on,
        "killed-slice-goes-on": killed_slice_goes_on,
        "killed-slice-leaves-none": killed_slice_leaves_none,
        "one-slice-at-a-time": one_slice_at_a_time,
        "nothing-fits": nothing_fits,
        "failures-are-told": failures_are_told,
        "options-refused": options_refused,
    }
)
