"""Compares a study's table with what the paper published: comparison.csv and comparison.md, a row for each published
number. A number agrees when it is within the tolerance (how well the paper's own can be read) and twice the standard
error, a bound when it holds by more than twice the error; undecided where the error is too large to tell. Nothing is
fitted to agree. A number that the runs do not tell is undecided as long as planned runs are missing."""
import numpy as np

from grainscope.progress import progress
from grainscope.study.paper_values import PUBLISHED
from grainscope.study.table import coverage, largest, over_seeds, read_study, study_arguments, text, write_csv

NAMES = ["quantity", "value", "error", "published", "tolerance", "agrees", "source"]
NOT_RUN = "undecided: not run"


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


def row_of(published, found, agrees):
    value, error = ("", "") if found is None else (f"{found[0]:.4g}", f"{found[1]:.2g}")
    sign = "" if published.relation == "=" else f"{published.relation} "
    wanted = f"{sign}{published.value:g}"
    return [published.quantity, value, error, wanted, text(published.tolerance), agrees, published.source]


def compare(runs, partial=False):
    """Rows of NAMES for the published numbers that the runs can tell, and the names of the others, which are rows, too,
    where the runs are only part of a study; of several systems the largest counts."""
    rows, untold = [], []
    for published in progress(PUBLISHED, "published numbers"):
        found = published.measure(runs if published.all_sizes else largest(runs))
        if found is None and partial:
            rows.append(row_of(published, None, NOT_RUN))
        elif found is None:
            untold.append(published.quantity)
        else:
            rows.append(row_of(published, found, verdict(published, *found)))
    return rows, untold


def markdown(rows, untold, covered):
    lines = [f"**{covered}**: the other runs have not ended.", ""] if covered.partial else []
    lines += ["| " + " | ".join(row) + " |" for row in [NAMES, ["---"] * len(NAMES), *rows]]
    counted = {word: sum(row[5] == word for row in rows) for word in ("yes", "NO", "undecided", NOT_RUN)}
    not_run = f", {counted[NOT_RUN]} as their runs have not ended or are not planned" if counted[NOT_RUN] else ""
    lines += [
        "",
        f"{counted['yes']} of {len(rows)} agree, {counted['NO']} do not, "
        f"{counted['undecided'] + counted[NOT_RUN]} are undecided{not_run}.",
    ]
    if untold:
        lines.append(f"These runs do not tell: {'; '.join(untold)}.")
    return "\n".join(lines) + "\n"


def write_comparison(study, output):
    runs, covered = over_seeds(read_study(study)), coverage(study)
    rows, untold = compare(runs, covered.partial)
    output.mkdir(parents=True, exist_ok=True)
    write_csv(output / "comparison.csv", [*NAMES, "coverage"], [[*row, str(covered)] for row in rows])
    (output / "comparison.md").write_text(markdown(rows, untold, covered))


add_arguments = study_arguments


def run(arguments):
    write_comparison(arguments.study, arguments.output)
