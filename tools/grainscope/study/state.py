"""How far the runs of a study are, read from their folders, and how long the others will take."""

from dataclasses import dataclass
import fcntl
import os
from statistics import median

from grainscope.study.cost_model import START_STEPS, step_seconds, steps_per_strain
from grainscope.study.run import FAILED, last_row

ENDED, RUNNING, BEGUN, FAILED_RUN, WAITING = "ended", "running", "begun", "failed", "waiting"


@dataclass
class RunState:
    """`steps`: time steps of the attempts whose cost is known, `seconds`: their wall time."""

    state: str
    strain: float = 0.0
    steps: int = 0
    seconds: float = 0.0
    failure: str = ""


def locked(folder):
    """Whether an attempt writes to the folder."""
    try:
        file = (folder / "lock").open("r+")
    except OSError:
        return False
    with file:
        try:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
    return False


def last_words(path, end=4096):
    """Words of the last whole line of a long file."""
    try:
        with path.open("rb") as file:
            file.seek(max(0, file.seek(0, os.SEEK_END) - end))
            lines = file.read().decode(errors="replace").splitlines(keepends=True)
    except OSError:
        return []
    whole = [line.split() for line in lines if line.endswith("\n")]
    return whole[-1] if whole else []


def strain_of(folder):
    """The strain of the last row that the run has written."""
    row = last_row(folder / "parameters.txt")
    if not row or not row[-1].isdigit():
        return 0.0
    for tables in (folder / f"from_{row[-1]}", folder):
        words = last_words(tables / "series.txt")
        if words and words[0].isdigit():
            return float(words[1])
    return 0.0


def costs_of(folder):
    """Steps and wall time of all attempts in cost.txt."""
    try:
        lines = (folder / "cost.txt").read_text().splitlines()
    except OSError:
        return 0, 0.0
    rows = [line.split() for line in lines if not line.startswith("#")]
    return sum(int(row[1]) - int(row[0]) for row in rows), sum(float(row[3]) for row in rows)


def state_of(run, output, earlier):
    """The RunState of a planned run; `earlier` (Earlier): what ended before."""
    folder = run.folder(output)
    steps, seconds = costs_of(folder)
    if run.marker(output).exists():
        return RunState(ENDED, run.strain, steps, seconds)
    if run.name in earlier.rows:
        return RunState(ENDED, run.strain, *earlier.cost(run))
    if not folder.exists():
        return RunState(WAITING)
    strain, failure = min(strain_of(folder), run.strain), folder / FAILED
    if locked(folder):
        state = RUNNING
    elif failure.exists():
        return RunState(FAILED_RUN, strain, steps, seconds, failure.read_text().strip())
    else:
        state = BEGUN if strain else WAITING
    return RunState(state, strain, steps, seconds)


class Speed:
    """How much longer a step takes here than the cost model says: of a run itself where it was measured, else the
    median over the runs of its shape, else over all."""

    def __init__(self, runs, states):
        self.own, shapes = {}, {}
        for run in runs:
            known = states[run.name]
            if known.steps and known.seconds:
                factor = known.seconds / (known.steps * model_step(run))
                self.own[run.name] = factor
                shapes.setdefault(run.variables["alpha"], []).append(factor)
        self.shapes = {alpha: median(factors) for alpha, factors in shapes.items()}
        self.all = median(self.own.values()) if self.own else 1.0

    def factor(self, run):
        return self.own.get(run.name, self.shapes.get(run.variables["alpha"], self.all))

    def seconds_left(self, run, state):
        """Wall time until the run's end."""
        return 0.0 if state.state == ENDED else self.factor(run) * run.seconds * max(0.0, 1 - state.strain / run.strain)

    def seconds_of_part(self, run, state):
        """Wall time of the next part; the first comes after the steps that push the random start apart."""
        steps = run.value("part") * steps_per_strain(run.value("alpha"), run.value("I"))
        return self.factor(run) * model_step(run) * (steps + (0 if state.strain else START_STEPS))


def model_step(run):
    """Wall time of a step by the cost model."""
    return step_seconds(run.value("alpha"), run.value("I"), run.value("N"), run.ranks) / run.speed
