"""Draws figures of the paper from a study's tables (those that `study table` writes); no run is needed. Of tables that
hold only some of the planned runs each picture says so."""
from grainscope.errors import InputError
from grainscope.figures.paper import FIGURES, GRID_FIGURES, sorted_runs
from grainscope.figures.style import marked
from grainscope.progress import progress
from grainscope.study.plan import figures_of
from grainscope.study.table import coverage, largest, over_seeds, read_study, study_arguments

ALL = {**FIGURES, **GRID_FIGURES}


def draw(runs, name, path):
    """Figure `name` of the steady runs; for all but the finite-size figure the largest of several systems counts."""
    path.parent.mkdir(parents=True, exist_ok=True)
    ALL[name](sorted_runs(runs if name == "fig14.png" else largest(runs)), path)


def draw_all(study, output, names=()):
    """Draws the named figures of a study, by default all that its runs can give; the paths."""
    runs, covered = over_seeds(read_study(study)), coverage(study)
    measure = "all" if all(run.measured_all for run in runs) else "basic"
    names = names or figures_of(measure)
    with marked(str(covered) if covered.partial else ""):
        for name in progress(names, "figures"):
            draw(runs, name, output / name)
    return [output / name for name in names]


def add_arguments(parser):
    study_arguments(parser)
    parser.add_argument(
        "figure", nargs="*", default=[], help=f"which: {', '.join(sorted(ALL))} (default: all that the runs can give)"
    )


def run(arguments):
    unknown = [name for name in arguments.figure if name not in ALL]
    if unknown:
        raise InputError(f"figure must be one of {', '.join(sorted(ALL))}, got '{unknown[0]}'")
    print(*draw_all(arguments.study, arguments.output, arguments.figure), sep="\n")
