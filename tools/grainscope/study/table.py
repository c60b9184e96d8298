"""Collects runs of examples/simple_shear into tables: table.csv has a row for each run, the files in curves/ their
profiles, and columns.csv tells the unit, meaning and source of every column. The figures, the fits and the comparison
of a study are made from these alone."""
import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from grainscope.errors import InputError, warn
from grainscope.progress import progress
from grainscope.shear.measures import SteadyRun, steady_run
from grainscope.shear.output import read_run
from grainscope.shear.quantities import ALWAYS, CURVES, MEASURED, SERIES
from grainscope.study.earlier import Earlier
from grainscope.study.sources import OF_COLUMN, OF_CURVE, STUDY
from grainscope.tables import read_rows

LONGEST = 40  # points of a curve that are kept, up to twice as many
TOLERANCE = 0.1  # of the inertial number reached, over its target; runs beyond it are flagged
PARAMETERS = {
    "run": ("", "name of the run"),
    "state": ("", "ended, or not run: planned, but not among the runs of these tables"),
    "alpha": ("-", "aspect ratio c/a"),
    "mu": ("-", "coefficient of friction"),
    "I": ("-", "inertial number of the target pressure"),
    "N": ("-", "grains"),
    "seed": ("-", "of the initial places"),
    "e": ("-", "coefficient of restitution"),
    "strain": ("-", "final shear strain"),
    "steady": ("-", "strain from which averages are taken"),
    "d_eq": ("m", "diameter of the sphere of the nominal volume"),
    "flagged": ("-", f"1 where I_reached is off I by more than {100 * TOLERANCE:g} %, else 0"),
}
WORDS = ("run", "state")  # columns that hold no numbers
ENDED, NOT_RUN = "ended", "not run"
COST = {
    "steps": ("-", "time steps, without the 3000 that push the random start apart"),
    "grain_step": ("s", "core time of one grain for one step, of the attempts that ended"),
    "core_time": ("s", "core time of the attempts that ended"),
    "memory": ("B", "largest memory of a rank"),
    "bytes": ("B", "size of all files of the run"),
}
MEANS = {**SERIES, **ALWAYS, **MEASURED}


def cost_of(run):
    """Columns of COST; those of the core time are missing if `study run` did not write them."""
    costs = {
        "steps": run.parameters["steps"],
        "bytes": sum(path.stat().st_size for path in run.folder.rglob("*") if path.is_file()),
    }
    try:
        _, _, rows = read_rows(run.folder / "cost.txt")
    except InputError:
        return costs
    begin, end, _, _, cpu, memory = np.array(rows, dtype=float).T
    steps = (end - begin).sum()
    if steps > 0:
        costs |= {"core_time": cpu.sum(), "grain_step": cpu.sum() / steps / run.parameters["N"]}
    return costs | {"memory": memory.max()}


def row_of(run, steady, start):
    reached = steady["I_reached"][0]
    row = {
        "run": run.name,
        "state": ENDED,
        **{name: run.parameters[name] for name in ("alpha", "mu", "I", "N", "seed", "e", "strain", "d_eq")},
    }
    row["steady"] = run["strain"][run.steady(start)][0] if start is None else start
    row["flagged"] = int(not abs(reached / run.parameters["I"] - 1) <= TOLERANCE)
    for name, (mean, error) in steady.means.items():
        row[name], row[f"{name}_error"] = mean, error
    return row | cost_of(run)


def header():
    """Names of the columns of table.csv, with unit and meaning."""
    for name, (unit, meaning) in {**PARAMETERS, **MEANS, **COST}.items():
        yield name, unit, meaning
        if name in MEANS:
            yield f"{name}_error", unit, "its standard error"


COLUMNS = ["file", "column", "unit", "meaning", "source"]


def all_headers():
    """COLUMNS of every column of every table."""
    for name, unit, meaning in header():
        yield "table.csv", name, unit, meaning, OF_COLUMN[name.removesuffix("_error")]
    for curve, columns in CURVES.items():
        file = f"curves/{curve}.csv"
        yield file, "run", "", "name of the run", STUDY
        yield from ((file, name, unit, meaning, OF_CURVE[curve]) for name, (unit, meaning) in columns.items())


def text(value):
    return value if isinstance(value, str) else f"{value:.10g}"


def write_csv(path, names, rows):
    with Path(path).open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(names)
        table.writerows(rows)


@dataclass
class Coverage:
    """How many of the planned runs the tables hold."""

    ended: int
    planned: int

    @property
    def partial(self):
        return self.ended < self.planned

    def __str__(self):
        return f"{'partial: ' * self.partial}{self.ended} of {self.planned} points"


def missing_rows(plan, found):
    """Rows of the planned runs of plan.csv that are not among those found."""
    for row in read_csv(plan) if plan else []:
        if row.get("run") is None:
            raise InputError(f"{plan}: must have a column 'run', has {', '.join(row)}")
        if row["run"] not in found:
            known = {name: float(row[name]) for name in PARAMETERS if name not in WORDS and row.get(name)}
            yield {"run": row["run"], "state": NOT_RUN, **known}


def write_tables(runs, output, plan=None, earlier=Earlier()):
    """Writes all files for (run, start of its averages) pairs and those of `earlier` that are not among them; with the
    plan.csv of the study also a row for each planned run that is neither."""
    earlier = earlier.without({run.name for run, _ in runs})
    rows, curves = list(earlier.rows.values()), {name: earlier.curve_rows(name) for name in CURVES}
    for run, start in progress(runs, "runs"):
        steady = steady_run(run, start)
        rows.append(row_of(run, steady, start))
        for curve, columns in steady.curves.items():
            points = np.array([columns[name] for name in CURVES[curve]]).T
            thin = points[:: max(1, len(points) // LONGEST)]
            curves[curve] += [(run.name, *(f"{value:.4g}" for value in point)) for point in thin]
    for row in rows:
        if float(row["flagged"]):
            warn(
                f"{row['run']}: the inertial number is {float(row['I_reached']):.4g}, more than "
                f"{100 * TOLERANCE:g} % off its target"
            )
    rows += missing_rows(plan, {row["run"] for row in rows})
    names = [name for name, _, _ in header()]
    (output / "curves").mkdir(parents=True, exist_ok=True)
    write_csv(output / "table.csv", names, [[text(row.get(name, "")) for name in names] for row in rows])
    write_csv(output / "columns.csv", COLUMNS, all_headers())
    for curve, points in curves.items():
        write_csv(output / "curves" / f"{curve}.csv", ["run", *CURVES[curve]], points)


def read_csv(path):
    try:
        with Path(path).open(newline="") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None


def read_curves(folder):
    """Curves of each run by name, as write_tables wrote them."""
    found = {}
    for curve, names in CURVES.items():
        points = {}
        for row in read_csv(folder / f"{curve}.csv"):
            points.setdefault(row["run"], []).append([float(row[name]) for name in names])
        for run, values in points.items():
            found.setdefault(run, {})[curve] = dict(zip(names, np.array(values).T))
    return found


def steady_runs(folder):
    """The rows of table.csv, with their curves."""
    curves = read_curves(folder / "curves")
    for row in read_csv(folder / "table.csv"):
        if row.get("state") == NOT_RUN:
            continue
        values = {name: float(value) for name, value in row.items() if name not in WORDS and value}
        parameters = {name: values[name] for name in PARAMETERS if name not in WORDS} | {
            name: values[name] for name in COST if name in values
        }
        means = {name: (values[name], values[f"{name}_error"]) for name in MEANS if name in values}
        yield SteadyRun(row["run"], parameters, means, curves.get(row["run"], {}))


def read_study(folder):
    """The steady runs of a folder with table.csv and curves."""
    folder = Path(folder)
    try:
        runs = list(steady_runs(folder))
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{folder}: its tables are not as `study table` writes them: {error!r}") from None
    if not runs:
        raise InputError(f"{folder / 'table.csv'}: it holds no run")
    return runs


def coverage(folder):
    """The Coverage of a folder's tables."""
    states = [row.get("state") or ENDED for row in read_csv(Path(folder) / "table.csv")]
    return Coverage(states.count(ENDED), len(states))


def mean_curve(runs, name, column):
    """Mean over the runs of a column of a curve, at the places of the first run's."""
    over = next(iter(CURVES[name]))
    return np.mean(
        [np.interp(runs[0].curves[name][over], run.curves[name][over], run.curves[name][column]) for run in runs],
        axis=0,
    )


def mean_over(runs):
    """One run in place of several that differ in their seeds: means of the means and curves; the error from the runs'
    own, or from their spread where that is larger."""
    if len(runs) == 1:
        return runs[0]
    means = {}
    for name in runs[0].means:
        values, errors = np.array([run.means[name] for run in runs if name in run.means]).T
        means[name] = values.mean(), max(
            np.sqrt((errors**2).sum()) / len(values), values.std(ddof=1) / np.sqrt(len(values))
        )
    curves = {
        name: {column: mean_curve(runs, name, column) for column in columns}
        for name, columns in runs[0].curves.items()
        if all(name in run.curves for run in runs)
    }
    flagged = max(run.parameters.get("flagged", 0) for run in runs)
    return SteadyRun(
        f"{runs[0].name} and {len(runs) - 1} more",
        {**runs[0].parameters, "seeds": len(runs), "flagged": flagged},
        means,
        curves,
    )


def over_seeds(runs):
    """The runs with those that differ only in their seeds taken together."""
    groups = {}
    for run in runs:
        groups.setdefault(tuple(run.parameters[name] for name in ("alpha", "mu", "I", "N", "e")), []).append(run)
    return [mean_over(group) for group in groups.values()]


def largest(runs):
    """Of runs that differ only in their number of grains, the largest."""
    best = {}
    for run in runs:
        key = tuple(run.parameters[name] for name in ("alpha", "mu", "I", "e"))
        if key not in best or run.parameters["N"] > best[key].parameters["N"]:
            best[key] = run
    return list(best.values())


def study_arguments(parser):
    """Of a command that reads a study's tables and writes files."""
    parser.add_argument("study", help="folder of table.csv and curves")
    parser.add_argument("--output", default=".", type=Path, metavar="FOLDER", help="where the files go (default: here)")


def add_arguments(parser):
    parser.add_argument(
        "run",
        nargs="*",
        help="output folder of a run, or folder:strain with the strain from which averages are taken "
        "(default: 6, or 4 below I = 0.01, at most half the run)",
    )
    parser.add_argument(
        "--output", default=".", type=Path, metavar="FOLDER", help="where the tables go (default: here)"
    )
    parser.add_argument(
        "--plan", type=Path, metavar="FILE", help="plan.csv of the study: planned runs that are missing are named"
    )
    parser.add_argument(
        "--earlier", metavar="FOLDER", help="data set of the same study: planned runs that are in it are added"
    )


def folder_and_start(word):
    """Of `folder` or `folder:strain`."""
    folder, colon, start = word.partition(":")
    try:
        return folder, float(start) if colon else None
    except ValueError:
        raise InputError(f"run must be folder or folder:strain with a number, got '{word}'") from None


def run(arguments):
    if arguments.earlier and not arguments.plan:
        raise InputError("--earlier needs --plan, got none")
    planned = {row.get("run"): row for row in read_csv(arguments.plan)} if arguments.plan else {}
    earlier = Earlier(arguments.earlier, planned)
    if not arguments.run and not earlier.rows:
        raise InputError("run must be at least one folder, got none: no run of the study has ended")
    pairs = map(folder_and_start, arguments.run)
    write_tables([(read_run(folder), start) for folder, start in pairs], arguments.output, arguments.plan, earlier)
