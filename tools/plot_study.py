#!/usr/bin/python3
"""Draws figures of the paper from a study's tables (those that tools/study_table.py writes); no run is needed."""
import sys

from paper_figures import FIGURES, GRID_FIGURES, sorted_runs
from shear_output import InputError
from study_plan import figures_of
from study_table import largest, over_seeds, read_study, study_parser

ALL = {**FIGURES, **GRID_FIGURES}


def draw(runs, name, path):
    """Figure `name` of the steady runs; for all but the finite-size figure the largest of several systems counts."""
    path.parent.mkdir(parents=True, exist_ok=True)
    ALL[name](sorted_runs(runs if name == "fig14.png" else largest(runs)), path)


def main():
    parser = study_parser(__doc__)
    parser.add_argument(
        "figure", nargs="*", help=f"which: {', '.join(sorted(ALL))} (default: all that the runs can give)"
    )
    arguments = parser.parse_args()
    unknown = [name for name in arguments.figure if name not in ALL]
    if unknown:
        sys.exit(f"plot_study.py: figure must be one of {', '.join(sorted(ALL))}, got '{unknown[0]}'")
    try:
        runs = over_seeds(read_study(arguments.study))
        measure = "all" if all(run.measured_all for run in runs) else "basic"
        for name in arguments.figure or figures_of(measure):
            draw(runs, name, arguments.output / name)
            print(arguments.output / name)
    except (InputError, OSError) as error:
        sys.exit(f"plot_study.py: {error}")


if __name__ == "__main__":
    main()
