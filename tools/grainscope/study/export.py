"""Writes a study as a data set to publish: table.csv with a row for each run, curves, columns.csv with unit, meaning
and source of every column, fits, comparison with the paper, provenance.json (commits, programs, machines, versions, and
of each run its seed, command and attempts), figures, README.md, CITATION.cff and .zenodo.json. All are made anew from
the runs that have ended, and say so where that is a part of the study. At most 20 MB."""
from importlib.metadata import PackageNotFoundError, version
import json
from pathlib import Path
import platform

import yaml

from grainscope.errors import InputError
from grainscope.program import TOP
from grainscope.shear.output import read_run
from grainscope.study.compare import write_comparison
from grainscope.study.earlier import earlier_of
from grainscope.study.fit import write_fits
from grainscope.study.plan import OTHERS, plan, write_plan
from grainscope.study.planned import read_config
from grainscope.study.plot import draw_all
from grainscope.study.provenance import attempts_of, source
from grainscope.study.slices import now, read_slices
from grainscope.study.table import coverage, write_tables

LIMIT = 20_000_000  # bytes
TITLE = "Simple shear of frictional spheroids: data of a study with grainscope"
SHARED = {"source": "sources", "program": "programs", "machine": "machines"}  # of attempts
PRIVATE = ("program", "output", "earlier")  # words of a configuration that concern one machine


def numbered(values, value):
    """The place of a value in a list, to which it is added when it is new."""
    if value not in values:
        values.append(value)
    return values.index(value)


def programs_of(folder):
    """The lines of a run's output that name the versions of LIGGGHTS and grainscope, each once."""
    with (folder / "screen.txt").open(errors="replace") as lines:
        return list(dict.fromkeys(line.strip() for line in lines if line.startswith("LIGGGHTS (Version")))


def versions():
    found = {"python": platform.python_version()}
    for name in ("numpy", "scipy", "matplotlib"):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = ""
    return found


def earlier_provenance(earlier):
    """Lists of what attempts share, slices and runs as they stand in the data set of earlier runs."""
    known = earlier.provenance() if earlier.rows else {}
    try:
        of_runs = {name: known["runs"][name] for name in earlier.rows}
    except KeyError as name:
        raise InputError(f"earlier: {earlier.folder / 'provenance.json'}: must name the run {name}") from None
    return {**{name: known.get(name, []) for name in (*SHARED.values(), "slices")}, "runs": of_runs}


def provenance(config, runs, output, covered, earlier):
    """Where the runs of the tables came from; what many attempts share stands in lists, and is named by its number."""
    found = earlier_provenance(earlier)
    of_runs = found["runs"]
    for run in runs:
        attempts = [
            {
                "time": attempt["time"],
                **{name: numbered(found[all_of], attempt[name]) for name, all_of in SHARED.items()},
                "ranks": attempt["ranks"],
            }
            for attempt in attempts_of(run.folder(output))
        ]
        variables = [f"{name}={value}" for name, value in run.variables.items()]
        command = ["grainscope-tools", "study", "run", run.name, *variables, "--ranks", str(run.ranks)]
        of_runs[run.name] = {"seed": run.variables["seed"], "command": " ".join(command), "attempts": attempts}
        of_runs[run.name]["programs"] = programs_of(run.folder(output))
    slices = {row["begin"]: row for row in found["slices"]}  # those of this folder may have been exported before
    for row in read_slices(output):
        begin, end = row["begin"].isoformat(), row["end"] and row["end"].isoformat()
        slices[begin] = {**row, "begin": begin, "end": end}
    return {
        "made": now().isoformat(),
        "coverage": str(covered),
        "study": {name: value for name, value in config.items() if name not in PRIVATE},
        "tools": {"source": source(), "versions": versions()},
        **{name: found[name] for name in SHARED.values()},
        "slices": sorted(slices.values(), key=lambda row: row["begin"]),
        "runs": of_runs,
    }


def citation(title, covered):
    """Text of CITATION.cff and .zenodo.json of the data set, from those of the project."""
    cff = yaml.safe_load((TOP / "CITATION.cff").read_text())
    zenodo = json.loads((TOP / ".zenodo.json").read_text())
    abstract = f"Steady means and curves of simple-shear runs of frictional spheroids, {covered}."
    cff.update(type="dataset", title=title, abstract=abstract)
    cff["message"] = "If these data helped a publication, please cite them, grainscope, the paper and LIGGGHTS."
    zenodo.update(upload_type="dataset", title=title, description=abstract)
    return yaml.safe_dump(cff, sort_keys=False, width=100), json.dumps(zenodo, indent=2) + "\n"


def readme(title, covered, files):
    lines = [f"# {title}", "", f"{covered} of the plan.", ""]
    lines += ["| file | |", "|---|---|", *(f"| `{name}` | {meaning} |" for name, meaning in files.items())]
    lines += [
        "",
        "Sources named by equation or figure are of Bilotto, Trulsson & Molinari 2025, doi 10.1103/tj41-6qqk.",
    ]
    return "\n".join([*lines, "Figures are drawn again by `grainscope-tools study plot` on this folder.", ""])


FILES = {
    "table.csv": "a row for each run: parameters, steady means with standard errors, cost",
    "curves/": "profiles of each run",
    "columns.csv": "unit, meaning and source of every column of these",
    "plan.csv": "the planned runs, in groups",
    "provenance.json": "commits, programs, machines, versions; of each run its seed, command and attempts",
    "figures/": "figures by the numbers of the paper",
    **dict.fromkeys(("fits.csv", "crossovers.csv"), "fitted parameters; points of equal losses"),
    **dict.fromkeys(("comparison.csv", "comparison.md"), "against the numbers of the paper"),
    "CITATION.cff": "how to cite the data",
    ".zenodo.json": "metadata of a deposit",
}


def size_of(folder, limit=LIMIT):
    """Bytes of all files; refuses more than the limit, and names the largest."""
    sizes = {path: path.stat().st_size for path in folder.rglob("*") if path.is_file()}
    total = sum(sizes.values())
    if total > limit:
        largest = max(sizes, key=sizes.get)
        raise InputError(
            f"{folder}: must be at most {limit / 1e6:g} MB, is {total / 1e6:.1f}; its largest file is "
            f"{largest.relative_to(folder)} of {sizes[largest] / 1e6:.1f} MB"
        )
    return total


def add_arguments(parser):
    parser.add_argument("config", help="configuration of the study, such as examples/study/config.yaml")
    parser.add_argument("--output", required=True, type=Path, metavar="FOLDER", help="where the data set goes")
    parser.add_argument("--title", default=TITLE, help="of the data set")


def run(arguments):
    config = read_config(arguments.config)
    output, target = Path(config.get("output", OTHERS["output"])), arguments.output
    planned = list(plan(config).values())
    ended = [run for run in planned if run.marker(output).exists()]
    earlier = earlier_of(config, planned).without({run.name for run in ended})
    if not ended and not earlier.rows:
        raise InputError(f"{output}: must have at least one run that has ended, has none")
    write_plan(planned, target / "plan.csv")
    runs = [(read_run(run.folder(output)), run.value("steady")) for run in ended]
    write_tables(runs, target, target / "plan.csv", earlier)
    write_fits(target, target)
    write_comparison(target, target)
    covered = coverage(target)
    text = json.dumps(provenance(config, ended, output, covered, earlier), indent=1)
    (target / "provenance.json").write_text(text + "\n")
    cff, zenodo = citation(arguments.title, covered)
    (target / "CITATION.cff").write_text(cff)
    (target / ".zenodo.json").write_text(zenodo)
    draw_all(target, target / "figures")
    files = {name: meaning for name, meaning in FILES.items() if (target / name).exists()}
    (target / "README.md").write_text(readme(arguments.title, covered, files))
    print(f"{target}: {covered}, {size_of(target) / 1e6:.2f} MB")
