"""Compares a study's table with what the paper published: comparison.csv and comparison.md, a row for each published
number. A number agrees when it is within the tolerance (how well the paper's own can be read) and twice the standard
error, a bound when it holds by more than twice the error; undecided where the error is too large to tell. Nothing is
fitted to agree."""
import numpy as np

from grainscope.progress import progress
from grainscope.study.paper_values import PUBLISHED
from grainscope.study.table import largest, over_seeds, read_study, study_arguments, text, write_csv

NAMES = ["quantity", "value", "error", "published", "tolerance", "agrees", "source"]


def verdict(published, value, error):
    """yes, NO, or undecided: a bound within twice the error, a number whose doubled error is beyond its tolerance and a
    quarter of it."""
    away = value - published.value
    if not np.isfinite([value, error]).all():
        return "undecided"
    if published.relation != "=":
        beyond = away if published.relation == ">" else -away
        return "undecided" if abs(beyond) < 2 * error else "yes" if beyond > 0 else "NO"
    if abs(away) > np.hypot(published.tolerance, 2 * error):
        return "NO"
    return "undecided" if 2 * error > max(published.tolerance, 0.25 * abs(published.value)) else "yes"


def compare(runs):
    """Rows of NAMES for the published numbers that the runs can tell, and the names of the others; of several systems
    the largest counts."""
    rows, untold = [], []
    for published in progress(PUBLISHED, "published numbers"):
        found = published.measure(runs if published.all_sizes else largest(runs))
        if found is None:
            untold.append(published.quantity)
            continue
        value, error = found
        sign = "" if published.relation == "=" else f"{published.relation} "
        rows.append(
            [
                published.quantity,
                f"{value:.4g}",
                f"{error:.2g}",
                f"{sign}{published.value:g}",
                text(published.tolerance),
                verdict(published, value, error),
                published.source,
            ]
        )
    return rows, untold


def markdown(rows, untold):
    lines = ["| " + " | ".join(row) + " |" for row in [NAMES, ["---"] * len(NAMES), *rows]]
    counted = {word: sum(row[5] == word for row in rows) for word in ("yes", "NO", "undecided")}
    lines += [
        "",
        f"{counted['yes']} of {len(rows)} agree, {counted['NO']} do not, {counted['undecided']} are undecided.",
    ]
    if untold:
        lines.append(f"These runs do not tell: {'; '.join(untold)}.")
    return "\n".join(lines) + "\n"


add_arguments = study_arguments


def run(arguments):
    rows, untold = compare(over_seeds(read_study(arguments.study)))
    arguments.output.mkdir(parents=True, exist_ok=True)
    write_csv(arguments.output / "comparison.csv", NAMES, rows)
    (arguments.output / "comparison.md").write_text(markdown(rows, untold))
