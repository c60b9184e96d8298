#!/usr/bin/python3
"""Compares a study's table with what the paper published: comparison.csv and comparison.md, a row for each published number. A number agrees
when it is within the tolerance (how well the paper's own can be read) and twice the standard error; a bound, when it holds within twice the
error. Whether it agrees is told, nothing is fitted to it."""
import argparse
from pathlib import Path
import sys

import numpy as np

from paper_values import PUBLISHED
from shear_output import InputError
from study_table import over_seeds, read_study, text, write_csv

NAMES = ["quantity", "value", "error", "published", "tolerance", "agrees", "source"]


def agrees(published, value, error):
    away = value - published.value
    if published.relation == "<":
        return away < 2 * error
    if published.relation == ">":
        return away > -2 * error
    return abs(away) <= np.hypot(published.tolerance, 2 * error)


def compare(runs):
    """Rows of NAMES for the published numbers that the runs can tell, and the names of the others."""
    rows, untold = [], []
    for published in PUBLISHED:
        found = published.measure(runs)
        if found is None:
            untold.append(published.quantity)
            continue
        value, error = found
        sign = "" if published.relation == "=" else f"{published.relation} "
        rows.append([published.quantity, f"{value:.4g}", f"{error:.2g}", f"{sign}{published.value:g}",
                     text(published.tolerance), "yes" if agrees(published, value, error) else "NO", published.source])
    return rows, untold


def markdown(rows, untold):
    lines = ["| " + " | ".join(row) + " |" for row in [NAMES, ["---"] * len(NAMES), *rows]]
    counted = sum(row[5] == "yes" for row in rows)
    lines += ["", f"{counted} of {len(rows)} agree."] + ([f"These runs do not tell: {'; '.join(untold)}."] if untold else [])
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study", help="folder of table.csv and curves")
    parser.add_argument("--output", default=".", type=Path, metavar="FOLDER", help="where the files go (default: here)")
    arguments = parser.parse_args()
    try:
        rows, untold = compare(over_seeds(read_study(arguments.study)))
        arguments.output.mkdir(parents=True, exist_ok=True)
        write_csv(arguments.output / "comparison.csv", NAMES, rows)
        (arguments.output / "comparison.md").write_text(markdown(rows, untold))
    except (InputError, OSError) as error:
        sys.exit(f"compare_study.py: {error}")


if __name__ == "__main__":
    main()
