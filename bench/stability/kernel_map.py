#!/usr/bin/python3
"""Where LIGGGHTS's superquadric routines and the ellipsoid kernel fail, and how exact they are: aspect ratio against
overlap.

With the program kernel_map its answers go to kernel_map.csv beside this file (two minutes). A chart and Markdown tables
are made of that file alone. A cell shows the worst of 4000 answers: grains at random and aligned, cold and from a step
ago.
"""
import argparse
import collections
import csv
import pathlib
import subprocess
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "tools"))
from grainscope.figures.style import plt, save  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

RESULTS, CHART = HERE / "kernel_map.csv", HERE.parent.parent / "doc" / "images" / "stability_kernel.png"
SURFACES = {"superquadric": "superquadric (LIGGGHTS)", "ellipsoid": "ellipsoid"}
ERRORS = {"point": "contact point", "normal": "normal", "overlap": "overlap"}
COUNTS = ("pairs", "failed", "not_finite", "missed", "invented", "gross")
LEAST, MOST = 1e-16, 1.0


def read():
    with RESULTS.open() as text:
        return [
            {
                name: value if name in ("posture", "given", "surface", "start") else float(value)
                for name, value in row.items()
            }
            for row in csv.DictReader(text)
        ]


def places(rows):
    """Overlaps, then distances of the centres: the columns of the map, from a touch to concentric."""
    return list(dict.fromkeys((row["given"], row["value"]) for row in rows))


def worst(rows, surface):
    """(alpha, place) -> the worst of postures and starts: largest errors, sums of counts."""
    found = collections.defaultdict(collections.Counter)
    for row in rows:
        if row["surface"] == surface:
            cell = found[row["alpha"], (row["given"], row["value"])]
            for name in COUNTS:
                cell[name] += row[name]
            for name in ERRORS:
                cell[name] = max(cell[name], row[name])
    return found


def power(x):
    return "0" if x == 0 else f"{x:g}" if x >= 0.01 else rf"$10^{{{round(np.log10(x))}}}$"


def panel(axes, cells, alphas, columns, quantity):
    values = np.array([[max(cells[alpha, place][quantity], LEAST) for place in columns] for alpha in alphas])
    image = axes.pcolormesh(values, norm=LogNorm(LEAST, MOST), cmap="YlGnBu", edgecolors="white", linewidth=0.4)
    for (row, alpha), (column, place) in ((a, c) for a in enumerate(alphas) for c in enumerate(columns)):
        cell, at = cells[alpha, place], (column + 0.5, row + 0.5)
        if cell["not_finite"]:
            axes.plot(*at, "X", color="#D55E00", markersize=6)
        elif cell["failed"]:
            axes.plot(*at, "o", color="#009E73", markersize=5)
        elif cell["gross"] or cell["missed"] or cell["invented"]:
            axes.plot(*at, "_", color="#D55E00", markersize=6, markeredgewidth=2)
    axes.axvline(sum(given == "overlap" for given, _ in columns), color="black", linewidth=1.0)
    axes.set_xticks(
        np.arange(len(columns)) + 0.5, labels=[power(value) for _, value in columns], rotation=90, fontsize=8
    )
    axes.set_yticks(np.arange(len(alphas)) + 0.5, labels=[f"{alpha:g}" for alpha in alphas], fontsize=8)
    return image


def draw(rows):
    alphas, columns = sorted({row["alpha"] for row in rows}), places(rows)
    figure, axes = plt.subplots(2, 3, figsize=(13.0, 7.0), constrained_layout=True, sharex=True, sharey=True)
    for line, (surface, title) in zip(axes, SURFACES.items()):
        cells = worst(rows, surface)
        for axis, (quantity, word) in zip(line, ERRORS.items()):
            image = panel(axis, cells, alphas, columns, quantity)
            axis.set_title(f"{title}: {word}")
        line[0].set_ylabel(r"aspect ratio $\alpha$")
    for axis in axes[1]:
        axis.set_xlabel("overlap  |  distance of the centres", fontsize=9)
    figure.colorbar(image, ax=axes, shrink=0.8, label="largest error [smallest semi-axes; normal: rad]")
    marks = (
        ("X", "#D55E00", "no number (NaN)"),
        ("_", "#D55E00", "wrong by more than 0.01, without a word"),
        ("o", "#009E73", "a defined answer, counted as a fallback"),
    )
    figure.legend(
        handles=[
            Line2D(
                [], [], linestyle="", marker=marker, color=colour, markeredgewidth=2 if marker == "_" else 1, label=word
            )
            for marker, colour, word in marks
        ],
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        ncols=3,
    )
    save(figure, CHART)


def exponent(x):
    return f"{x:.0e}".replace("e-0", "e-") if x else "-"


def tables(rows):
    """Failures by place, and errors by overlap, of all aspect ratios together."""
    print(
        "| given | value | answers | " + " | ".join(f"{surface}: NaN | fallback | wrong" for surface in SURFACES) + " |"
    )
    print("|---" * 9 + "|")
    for place in places(rows):
        line = []
        for surface in SURFACES:
            cells = [row for row in rows if row["surface"] == surface and (row["given"], row["value"]) == place]
            total = {name: sum(int(row[name]) for row in cells) for name in COUNTS}
            line += [
                total["not_finite"],
                total["failed"] - total["not_finite"],
                total["gross"] + total["missed"] + total["invented"],
            ]
        print(f"| {place[0]} | {place[1]:g} | {total['pairs']} | " + " | ".join(str(count) for count in line) + " |")
    print(
        "\n| alpha | overlap | "
        + " | ".join(f"{surface}: {word}" for surface in SURFACES for word in ERRORS.values())
        + " |"
    )
    print("|---" * 8 + "|")
    found = {surface: worst(rows, surface) for surface in SURFACES}
    for alpha in sorted({row["alpha"] for row in rows}):
        for overlap in (1e-8, 1e-4, 1e-2, 0.5):
            line = [
                exponent(found[surface][alpha, ("overlap", overlap)][name]) for surface in SURFACES for name in ERRORS
            ]
            print(f"| {alpha:g} | {overlap:g} | " + " | ".join(line) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "program",
        type=pathlib.Path,
        nargs="?",
        help="<build>/bench/kernel_map; without it, what the file holds is drawn",
    )
    parser.add_argument("--pairs", type=int, default=1000, help="of each cell, posture and start (default %(default)s)")
    arguments = parser.parse_args()
    if arguments.program:
        answers = subprocess.run(
            [str(arguments.program), str(arguments.pairs)], stdout=subprocess.PIPE, text=True, check=True
        ).stdout
        RESULTS.write_text(answers)
    rows = read()
    tables(rows)
    draw(rows)


if __name__ == "__main__":
    main()
