"""Draws columns of files of fix ave/time (mode scalar) and fix print by the names in their headers, and prints the mean
of each over the steady part, with its error. The steady part is what --from says; without it MSER-5 (White 1997) finds
it for each column. Errors are by blocking (Flyvbjerg & Petersen 1989), the largest over the sizes of blocks of which
there are at least eight."""
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from grainscope.errors import InputError, warn
from grainscope.figures.style import RUN_COLOURS, save
from grainscope.means import mean_and_error, steady_start, text_of
from grainscope.tables import files_and_columns, no_column, read_series

MOST_PANELS = 30
ENDINGS = (".png", ".pdf", ".svg")


def add_arguments(parser):
    parser.add_argument("file", help="file of fix ave/time or fix print")
    parser.add_argument(
        "more",
        nargs="*",
        default=[],
        metavar="file or column",
        help="more files, drawn over each other, and names of columns (default: all that all files have)",
    )
    parser.add_argument(
        "--against", metavar="COLUMN", help="what the others are drawn over (default: the first column)"
    )
    parser.add_argument(
        "--from",
        dest="start",
        type=float,
        metavar="VALUE",
        help="where the steady part begins, a value of the column that the others are drawn over (default: by MSER-5)",
    )
    parser.add_argument("--output", default="plot.png", metavar="FILE", help="the picture (default: plot.png)")


def chosen(series, words, against):
    """Names of the columns to be drawn."""
    for path, columns in series.items():
        for name in (*words, against):
            if name not in columns:
                raise no_column(path, name, list(columns))
    if words:
        return words
    first, *others = series.values()
    names = [name for name in list(first)[1:] if name != against and all(name in other for other in others)]
    if not names:
        raise InputError(f"{', '.join(map(str, series))}: no column besides '{against}' that all files have")
    return names


def steady_part(path, over, values, start):
    """(mask of the rows of the steady part, what is said of it). Rows that are not finite are left out."""
    finite = np.isfinite(values)
    if start is None:
        first, found = steady_start(values[finite])
        kept = finite & (np.cumsum(finite) > first)
        return kept, "" if found else "not steady"
    kept = finite & (over >= start)
    if kept.sum() < 2:
        raise InputError(
            f"--from must leave at least two rows of {path}, got {start:g}; it has {over[0]:g} to {over[-1]:g}"
        )
    return kept, ""


def measured(series, names, against, start):
    """A row for each column of each file: mean, error, where the steady part begins and ends, its rows."""
    rows = []
    for path, columns in series.items():
        for name in names:
            kept, note = steady_part(path, columns[against], columns[name], start)
            if not kept.any():
                warn(f"{path}: no row of column '{name}' is finite")
                continue
            mean, error = mean_and_error(columns[name][kept])
            begin, end = columns[against][kept][[0, -1]]
            rows.append((path, name, mean, error, begin, end, kept.sum(), note))
    return pd.DataFrame(rows, columns=["file", "column", "mean", "error", "begin", "end", "rows", "note"])


def table(means, against):
    """The means as text."""
    shown = {
        "file": means["file"],
        "column": means["column"],
        "mean +- error": [text_of(mean, error) for mean, error in zip(means["mean"], means["error"])],
        f"from {against}": means["begin"].map("{:g}".format),
        "rows": means["rows"],
        "": means["note"],
    }
    return "\n".join(line.rstrip() for line in pd.DataFrame(shown).to_string(index=False).splitlines())


def draw(series, names, against, means, units):
    """A panel for each column, a line for each file; the steady mean dashed, or dotted where the series is
    not steady, its error as a band."""
    labels = {name: f"{name} [{units[name]}]" if name in units else name for name in (*names, against)}
    across = min(3, len(names))
    down = -(-len(names) // across)
    figure, axes = plt.subplots(
        down, across, figsize=(3.8 * across, 2.6 * down + 0.4), squeeze=False, layout="constrained"
    )
    colours = dict(zip(series, RUN_COLOURS * (1 + len(series) // len(RUN_COLOURS))))
    for axis, name in zip(axes.flat, names):
        axis.set(title=labels[name], xlabel=labels[against])
        for path, columns in series.items():
            axis.plot(columns[against], columns[name], color=colours[path], linewidth=0.8, alpha=0.6, label=str(path))
        for one in means[means["column"] == name].itertuples():
            dashes = ":" if one.note else "--"
            axis.hlines(one.mean, one.begin, one.end, color=colours[one.file], linestyle=dashes, linewidth=1.4)
            axis.fill_between(
                [one.begin, one.end], one.mean - one.error, one.mean + one.error, color=colours[one.file], alpha=0.25
            )
    for axis in axes.flat[len(names) :]:
        axis.set_axis_off()
    if len(series) > 1:
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, 0.0))
    return figure


def run(arguments):
    if Path(arguments.output).suffix not in ENDINGS:
        raise InputError(f"--output must end in {', '.join(ENDINGS)}, got '{arguments.output}'")
    files, words = files_and_columns(arguments.file, arguments.more)
    found = {path: read_series(path) for path in files}
    series = {path: columns for path, (columns, _) in found.items()}
    against = arguments.against or next(iter(series[arguments.file]))
    names = chosen(series, words, against)
    if len(names) > MOST_PANELS:
        raise InputError(f"columns must be at most {MOST_PANELS}, got {len(names)}: name some of {', '.join(names)}")
    means = measured(series, names, against, arguments.start)
    print(table(means, against))
    chosen_by = "by MSER-5 (White 1997)" if arguments.start is None else f"from {arguments.start:g} on"
    print(f"steady part: {chosen_by}; errors: one standard error, by blocking (Flyvbjerg & Petersen 1989)")
    units = {name: unit for _, units in found.values() for name, unit in units.items() if unit not in ("", "-")}
    save(draw(series, names, against, means, units), arguments.output)
    print(arguments.output)
