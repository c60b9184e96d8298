"""Fits to a study's table: fits.csv (Eqs. 5 and 6, power laws of Figs. 4 and 6 and of the diffusion, I_c ~ mu^p), each
parameter with its standard error, and crossovers.csv (the points with P_t = P_n, Fig. 3). Their column `coverage` says
of how many of the planned runs."""
from dataclasses import asdict, fields

from grainscope.study.grid_fits import Crossover, Fitted, all_fits, crossovers, kinds
from grainscope.study.table import coverage, largest, over_seeds, read_study, study_arguments, text, write_csv


def names_of(record):
    return [field.name for field in fields(record)]


def cells(record):
    return [
        "" if value != value else int(value) if isinstance(value, bool) else text(value)
        for value in asdict(record).values()
    ]


def write_fits(study, output):
    runs = largest(over_seeds(read_study(study)))
    covered = str(coverage(study))
    output.mkdir(parents=True, exist_ok=True)
    write_csv(
        output / "fits.csv",
        [*names_of(Fitted), "coverage"],
        [[*cells(fit), covered] for fit in all_fits(runs)],
    )
    write_csv(
        output / "crossovers.csv",
        ["powers", *names_of(Crossover), "coverage"],
        [[kind, *cells(point), covered] for kind in kinds(runs) for point in crossovers(runs, kind)],
    )


add_arguments = study_arguments


def run(arguments):
    write_fits(arguments.study, arguments.output)
