"""Runs a study for so many hours: group after group as its file lists them, in each the cheapest run first. No part of
a run is begun that would not end in time, by the speed measured so far; before that by the cost model. The same command
goes on, also after a kill, to the same bits. One at a time: a second one for the same output folder is refused. The
tables and figures of what has ended are made by Snakemake, with --config partial=1."""
import argparse
from contextlib import contextmanager
import fcntl
from pathlib import Path
import signal
import subprocess
import sys
import time

from grainscope.errors import InputError
from grainscope.program import find_program
from grainscope.study.earlier import Earlier, earlier_of
from grainscope.study.part_clock import MARGIN
from grainscope.study.plan import OTHERS, plan, write_plan
from grainscope.study.planned import read_config
from grainscope.study.program_process import SIGNALS, end_with_parent
from grainscope.study.run import FAILED, STOPPED, positive
from grainscope.study.slices import Slice
from grainscope.study.state import ENDED, RUNNING, Speed, state_of

PAUSE = 0.2  # seconds between looks at the runs


@contextmanager
def alone(output):
    """Holds the lock of the output folder; refuses where another process has it."""
    path = output / "grid.lock"
    output.mkdir(parents=True, exist_ok=True)
    with path.open("a") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise InputError(f"{output}: another study run-grid works in this folder") from None
        yield


def command_of(run, output, program, seconds):
    variables = [f"{name}={value}" for name, value in run.variables.items()]
    words = ["study", "run", run.folder(output), *variables, "--binary", program, "--ranks", run.ranks]
    return [sys.executable, *map(str, (sys.argv[0], *words, "--hours", f"{seconds / 3600:.9f}"))]


class Grid:
    """The runs of one slice of time."""

    def __init__(self, runs, output, program, jobs, seconds, clock=time.monotonic, earlier=Earlier()):
        self.runs, self.output, self.program, self.jobs, self.clock = runs, output, program, jobs, clock
        self.deadline = clock() + seconds
        self.earlier = earlier
        self.states = {run.name: self.state_now(run) for run in runs}
        self.processes = {}  # by name, of the runs that this slice has begun and that have not ended
        self.tried = set()
        self.too_long = {}  # seconds of the next part of runs that it would not fit
        self.stopping = False

    def state_now(self, run):
        return state_of(run, self.output, self.earlier)

    def stop(self, *_):
        """Ends all runs in order."""
        if not self.stopping:
            self.stopping = True
            for process in self.processes.values():
                process.terminate()

    def next_run(self):
        """The first run in the plan's order whose next part fits into the time that is left; None where there is
        none."""
        speed = Speed(self.runs, self.states)
        left = self.deadline - self.clock()
        self.too_long = {}
        for run in self.runs:
            if run.name in self.tried:
                continue
            if self.states[run.name].state == RUNNING:
                self.states[run.name] = self.state_now(run)
            state = self.states[run.name]
            if state.state in (ENDED, RUNNING):
                continue
            seconds = speed.seconds_of_part(run, state)
            if MARGIN * seconds <= left:
                return run
            self.too_long[run.name] = seconds
        return None

    def begin(self, run):
        self.tried.add(run.name)
        command = command_of(run, self.output, self.program, self.deadline - self.clock())
        self.processes[run.name] = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=end_with_parent(),
        )
        print(f"{run.name}: {'goes on' if self.states[run.name].strain else 'begins'}", flush=True)

    def collect(self):
        """Takes note of the runs that have ended."""
        for run in [run for run in self.runs if run.name in self.processes]:
            process = self.processes[run.name]
            if process.poll() is None:
                continue
            del self.processes[run.name]
            said = process.stderr.read().strip()
            if process.returncode == 0:
                run.marker(self.output).touch()
            self.states[run.name] = state = self.state_now(run)
            if process.returncode == 0:
                print(f"{run.name}: ended", flush=True)
            elif process.returncode == STOPPED or self.stopping:
                print(f"{run.name}: stopped at strain {state.strain:.2f} of {run.strain:g}", flush=True)
            else:
                said = said or f"{run.name}: exit status {process.returncode}"
                print(said.splitlines()[-1], file=sys.stderr, flush=True)

    def others_at_work(self):
        """Whether there are runs that another process has begun, as a killed one does until they have stopped."""
        return any(self.states[run.name].state == RUNNING for run in self.runs if run.name not in self.tried)

    def work(self):
        """Until nothing runs and nothing more fits."""
        while True:
            self.collect()
            while not self.stopping and len(self.processes) < self.jobs:
                run = self.next_run()
                if run is None:
                    break
                self.begin(run)
            waiting = self.others_at_work() and not self.stopping and self.clock() < self.deadline
            if not self.processes and not waiting:
                return
            time.sleep(PAUSE)


def summary(grid):
    counted = [state.state for state in grid.states.values()]
    lines = [f"{counted.count(ENDED)} of {len(counted)} runs have ended"]
    if grid.too_long and not grid.stopping:
        name = min(grid.too_long, key=grid.too_long.get)
        lines.append(
            f"no part of the {len(grid.too_long)} runs that were left fits into the time that was left; the shortest, "
            f"of {name}, takes {grid.too_long[name]:.0f} s, with its margin {MARGIN * grid.too_long[name]:.0f} s"
        )
    return lines


def add_arguments(parser):
    parser.add_argument("config", help="configuration of the study, such as examples/study/config.yaml")
    parser.add_argument("--hours", type=positive, required=True, help="wall time, after which nothing runs any more")
    parser.add_argument("--binary", help="the program (default: `program` of the configuration)")
    parser.add_argument("--jobs", type=jobs, default=1, help="runs at a time (default: 1)")


def jobs(text):
    value = positive(text)
    if value != int(value):
        raise argparse.ArgumentTypeError(f"must be a whole number above 0, got '{text}'")
    return int(value)


def run(arguments):
    config = read_config(arguments.config)
    runs = list(plan(config).values())
    settings = {**OTHERS, **config}
    output, program = Path(settings["output"]), arguments.binary or find_program(settings["program"])
    with alone(output):
        write_plan(runs, output / "plan.csv")
        grid = Grid(runs, output, program, arguments.jobs, 3600 * arguments.hours, earlier=earlier_of(config, runs))
        for number in SIGNALS:
            signal.signal(number, grid.stop)
        with Slice(output, arguments.hours, arguments.jobs):
            grid.work()
        print(*summary(grid), sep="\n")
    failed = [run.name for run in runs if (run.folder(output) / FAILED).exists()]
    if failed:
        raise InputError(f"{len(failed)} runs failed: {', '.join(failed)}; see study status")
