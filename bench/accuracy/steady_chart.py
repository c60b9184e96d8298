#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How the time step shifts steady means: the tables of doc/accuracy_data.md and their figures, from steady.csv,
onset.csv and, for energies and times, results.csv. Runs nothing.

    steady_chart.py            # prints the tables, draws the figures
    steady_chart.py --write    # and puts the tables in the place of those of the page
"""
import argparse
import csv
import math
import pathlib
import re

import numpy as np

from chart import (
    ALPHAS,
    COLOURS,
    HERE,
    ROOT,
    Line2D,
    Results,
    energy_error,
    floor_label,
    guide,
    plt,
    relative_time,
    save,
    shape_colour,
    shape_handle,
    shape_marker,
    table,
)
from steady import QUANTITIES, RESULTS, SERIES, SHARE, of_series, read_results

PAGE = ROOT / "doc" / "accuracy_data.md"
LABELS = dict(zip(QUANTITIES, (r"$\mu_{eff}$", r"$\phi$", "$Z$", r"$P_n$", r"$P_t$")))
LINES = {0.0: ":", 0.4: "-", 10.0: "--"}
POWERS = ("P_n", "P_t")
CHARTED = (0.05, 0.1, 0.15, 0.3, 0.4, 0.6)


class Mean:
    """Mean of blocks and its standard error."""

    def __init__(self, values):
        self.value = np.mean(values)
        self.error = np.std(values, ddof=1) / math.sqrt(len(values))


class FlowMeans:
    """Means of one flow at each of its steps, and the curve through each quantity against the step."""

    def __init__(self, rows, series):
        self.flow = series.flow
        self.blocks = {f: found for f in sorted(SHARE) if (found := of_series(rows, series, f))}
        self.fractions = np.array(list(self.blocks))
        self.means = {q: [Mean([row[q] for row in found]) for found in self.blocks.values()] for q in self.quantities()}
        self.curves = {q: self.curve(q) for q in self.means if len(self.fractions) > len(self.exponents(q))}

    def quantities(self):
        return [q for q in QUANTITIES if not (q == "P_t" and self.flow.mu == 0)]

    def strain(self):
        return sum(row["strain"] for found in self.blocks.values() for row in found)

    def exponents(self, quantity):
        """Powers of the step in the curve: a straight line. At high friction a parabola: springs that are cut within a
        few steps bend it. Without friction what is not dissipated is the energy error, which is of second order."""
        if self.flow.mu > 1:
            return np.array([0, 1, 2])
        return np.array([0, 2] if quantity == "P_n" and self.flow.mu == 0 else [0, 1])

    def curve(self, quantity):
        """Coefficients of the curve, their covariance, and chi^2 per degree of freedom."""
        values = np.array([mean.value for mean in self.means[quantity]])
        weights = 1 / np.array([mean.error for mean in self.means[quantity]])
        design = self.fractions[:, None] ** self.exponents(quantity) * weights[:, None]
        coefficients, *_ = np.linalg.lstsq(design, values * weights, rcond=None)
        chi = np.sum((values * weights - design @ coefficients) ** 2) / (len(values) - len(coefficients))
        return coefficients, np.linalg.inv(design.T @ design), chi

    def unit(self, quantity):
        """What a shift is relative to: the value; of powers all that is dissipated."""
        if quantity in POWERS:
            return sum(np.mean([mean.value for mean in self.means[q]]) for q in POWERS if q in self.means)
        return self.curves[quantity][0][0]

    def shift(self, quantity, fraction):
        """Relative shift of the mean at a step from that at step 0, and its error."""
        coefficients, covariance, _ = self.curves[quantity]
        powers = np.append(0.0, fraction ** self.exponents(quantity)[1:])
        value, error = powers @ coefficients, math.sqrt(powers @ covariance @ powers)
        return value / self.unit(quantity), error / self.unit(quantity)


def percent(value, error):
    digits = 2 if 100 * error >= 0.0095 else 3
    return f"{100 * value:+.{digits}f} ± {100 * error:.{digits}f}"


def pooled(flows, quantity, fraction):
    """Shift at a step over several flows, weighted by their errors."""
    found = [flow.shift(quantity, fraction) for flow in flows if quantity in flow.curves]
    weights = np.array([error**-2 for _, error in found])
    return np.sum(weights * [value for value, _ in found]) / weights.sum(), weights.sum() ** -0.5


def kinds(flows):
    """Flows that are told together."""
    for inertial, mu in ((0.1, 0.0), (0.1, 0.4), (0.1, 10.0), (0.01, 0.4), (0.01, 10.0)):
        found = [one for one in flows if (one.flow.I, one.flow.mu) == (inertial, mu)]
        if found:
            yield f"I = {inertial:g}, mu_p = {mu:g}", found


def table_of_shifts(flows):
    return (
        "Shift of each mean at 0.15 T_R, %: the curve through all steps",
        ["alpha", "mu_p", "I", "strain, all steps", *QUANTITIES, "chi^2 per degree of freedom"],
        [
            [f"{one.flow.alpha:g}", f"{one.flow.mu:g}", f"{one.flow.I:g}", f"{one.strain():,.0f}"]
            + [percent(*one.shift(q, 0.15)) if q in one.curves else "" for q in QUANTITIES]
            + [", ".join(f"{one.curves[q][2]:.1f}" for q in one.curves)]
            for one in flows
        ],
    )


def table_of_kinds(flows):
    rows = []
    for fraction in CHARTED:
        for name, found in kinds(flows):
            cells = []
            for q in QUANTITIES:
                there = [one for one in found if q in one.curves]
                cells.append(percent(*pooled(there, q, fraction)) if there else "")
            rows.append([f"{fraction:g}", name, *cells])
    return ("Shift by kind of flow, %", ["dt / T_R", "flows", *QUANTITIES], rows)


def table_of_means(flows):
    rows = []
    for one in flows:
        for number, (fraction, blocks) in enumerate(one.blocks.items()):
            cells = [f"{one.flow.alpha:g}", f"{one.flow.mu:g}", f"{one.flow.I:g}", f"{fraction:g}"]
            cells += [f"{sum(row['strain'] for row in blocks):.0f}"]
            for q in QUANTITIES:
                mean = one.means[q][number] if q in one.means else None
                cells.append(f"{mean.value:.5f} ± {mean.error:.5f}" if mean else "")
            rows.append(cells)
    return ("Means", ["alpha", "mu_p", "I", "dt / T_R", "strain", *QUANTITIES], rows)


def table_of_energy(results):
    rows = []
    for fraction, name in results.steps("account", mu=0.4, I=0.1):
        times = [relative_time(results, alpha, name) for alpha in ALPHAS]
        errors = [f"{100 * energy_error(results, alpha, name):.1g}" for alpha in ALPHAS]
        rows.append([f"{fraction:g}", f"{np.mean(times):.2f}", *errors])
    return (
        "Energy error, |G_dt| over D_n + D_t, %",
        ["dt / T_R", "time", *(f"alpha = {alpha:g}" for alpha in ALPHAS)],
        rows,
    )


def print_scatter(rows, flows):
    """Whether blocks are long enough: half the mean squared difference of one block from the next, over their variance,
    is 1 if they are independent (von Neumann 1941, doi 10.1214/aoms/1177731677), less if they are not."""
    steps, variances = [], []
    for one in flows:
        for found in one.blocks.values():
            for seed in {row["seed"] for row in found}:
                values = np.array([row["mu_eff"] for row in found if row["seed"] == seed]) / one.unit("mu_eff")
                steps.append(np.mean(np.diff(values) ** 2) / 2)
                variances.append(values.var(ddof=1))
    hours = sum(row["seconds"] for row in rows) / 3600
    print(f"\nmu_eff: ratio of von Neumann {np.sum(steps) / np.sum(variances):.2f}, of {len(steps)} runs")
    print(f"strain {sum(row['strain'] for row in rows):,.0f}; {hours:.1f} core hours")


def read_onset():
    with open(HERE / "onset.csv", newline="") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return [{name: value if name == "quantity" else float(value) for name, value in row.items()} for row in rows]


def table_of_onset(onset):
    """Differences in the first row, in the five after it and in the last four."""
    rows = []
    flows = dict.fromkeys((row["alpha"], row["mu"]) for row in onset)
    for alpha, mu in flows:
        for made_by in (0.3, 0.01):
            cells = [f"{alpha:g}", f"{mu:g}", f"{made_by:g}"]
            for quantity in ("sigma_xy", "P_n", "P_t"):
                wanted = {"alpha": alpha, "mu": mu, "made_by": made_by, "fraction": 0.3, "quantity": quantity}
                values = [row for row in onset if all(row[key] == value for key, value in wanted.items())]
                for part in (slice(0, 1), slice(1, 6), slice(6, 10)):
                    mean = np.mean([row["value"] for row in values[part]])
                    error = math.sqrt(sum(row["error"] ** 2 for row in values[part])) / len(values[part])
                    cells.append("" if quantity == "P_t" and mu == 0 else percent(mean, error))
            rows.append(cells)
    return (
        "Runs of 0.3 T_R against those of 0.01 from the same states, %, in units of T_R since the start",
        ["alpha", "mu_p", "state by"]
        + [f"{q}, {t}" for q in ("sigma_xy", "P_n", "P_t") for t in ("0-6", "6-36", "36-60")],
        rows,
    )


def draw_onset(onset, path):
    """What a run shows first when it goes on from a state that another step has made."""
    figure, axes = plt.subplots(1, 2, figsize=(10, 3.8), constrained_layout=True, sharey=True)
    for axis, made_by in zip(axes, (0.3, 0.01)):
        for alpha, mu in dict.fromkeys((row["alpha"], row["mu"]) for row in onset):
            wanted = {"alpha": alpha, "mu": mu, "made_by": made_by, "fraction": 0.3, "quantity": "sigma_xy"}
            rows = [row for row in onset if all(row[key] == value for key, value in wanted.items())]
            axis.errorbar(
                [6 * (row["row"] + 0.5) for row in rows],
                [100 * row["value"] for row in rows],
                [100 * row["error"] for row in rows],
                color=shape_colour(alpha),
                linestyle=LINES[mu],
                marker=shape_marker(alpha),
                markersize=4,
                linewidth=1.2,
            )
        axis.axhline(0, color="0.7", linewidth=0.8, zorder=0)
        axis.set_title(f"states made with {made_by:g} $T_R$", fontsize=9)
        axis.set_xlabel("$T_R$ since the start")
    axes[0].set_ylabel(r"$\sigma_{xy}$ of 0.3 against 0.01 $T_R$, %")
    axes[1].legend(handles=legend(), fontsize=8)
    save(figure, path)


def legend():
    return [shape_handle(alpha) for alpha in ALPHAS] + [
        Line2D([], [], color="k", linestyle=line, label=rf"$\mu_p$ = {mu:g}") for mu, line in LINES.items()
    ]


def draw_steps(results, flows, path):
    """Energy error, and the shift of each mean against the step, with the curve through all steps."""
    figure, axes = plt.subplots(2, 3, figsize=(12, 7), constrained_layout=True)
    energy, *others = axes.flat
    for alpha in ALPHAS:
        for inertial, line in ((0.1, "-"), (0.01, "--")):
            fractions, names = zip(*results.steps("account", alpha=alpha, mu=0.4, I=inertial))
            errors = [energy_error(results, alpha, name, inertial) for name in names]
            energy.plot(fractions, errors, line, color=shape_colour(alpha), marker=shape_marker(alpha), markersize=4)
    guide(energy, [0.01, 0.6], 0.01, 2)
    energy.set_xscale("log")
    energy.set_yscale("log")
    energy.set_xlabel(r"$\Delta t / T_R$")
    energy.set_title("energy error |G_dt|/(D_n + D_t); dashed: I = 0.01", fontsize=9)
    for axis, quantity in zip(others, QUANTITIES):
        for number, one in enumerate(flows):
            if quantity not in one.curves or one.flow.I < 0.1:
                continue
            start, unit = one.curves[quantity][0][0], one.unit(quantity)
            aside = one.fractions + 0.003 * (number - len(flows) / 2)
            axis.errorbar(
                aside,
                [100 * (mean.value - start) / unit for mean in one.means[quantity]],
                [100 * mean.error / unit for mean in one.means[quantity]],
                color=shape_colour(one.flow.alpha),
                marker=shape_marker(one.flow.alpha),
                linestyle="",
                markersize=3.5,
                linewidth=0.8,
            )
            steps = np.linspace(0, 0.6, 31)
            shifts = [100 * one.shift(quantity, step)[0] for step in steps]
            axis.plot(steps, shifts, LINES[one.flow.mu], color=shape_colour(one.flow.alpha), linewidth=1.1)
        axis.axhline(0, color="0.7", linewidth=0.8, zorder=0)
        over = "$(P_n + P_t)$" if quantity in POWERS else "its value at 0"
        axis.set_title(f"shift of {LABELS[quantity]}, % of {over}", fontsize=9)
        axis.set_xlabel(r"$\Delta t / T_R$")
    others[0].legend(handles=legend(), fontsize=7)
    save(figure, path)


def draw_cost(results, flows, path):
    """Shift against the time of a run: a point for each step and surface."""
    figure, axes = plt.subplots(1, 3, figsize=(12, 4.2), constrained_layout=True, sharey=True)
    surfaces = {"ellipsoid": ("o", 1.0), "superquadric": ("*", None)}
    for axis, (name, found) in zip(axes, kinds([one for one in flows if one.flow.I == 0.1])):
        for quantity, colour in zip(("mu_eff", "phi", "P_n", "P_t"), COLOURS.values()):
            there = [one for one in found if quantity in one.curves]
            if not there:
                continue
            for marker, factor in surfaces.values():
                factor = factor or np.mean([relative_time(results, alpha, "superquadric") for alpha in ALPHAS])
                shifts = [pooled(there, quantity, fraction) for fraction in CHARTED]
                axis.errorbar(
                    [factor * 0.15 / fraction for fraction in CHARTED],
                    [100 * abs(value) for value, _ in shifts],
                    [100 * error for _, error in shifts],
                    color=colour,
                    marker=marker,
                    linewidth=1,
                    markersize=5 if marker == "o" else 8,
                    label=LABELS[quantity] if marker == "o" else None,
                )
        for fraction, rule in ((0.1, "LIGGGHTS"), (0.14, "LAMMPS")):
            axis.axvline(0.15 / fraction, color="0.85", linewidth=3, zorder=0)
            axis.annotate(
                rule, (0.15 / fraction, 0.98), xycoords=("data", "axes fraction"), rotation=90, va="top", fontsize=7
            )
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_ylim(3e-3, 10)
        for level in (1, 0.1):
            floor_label(axis, level, f"{level:g} %")
        axis.set_title(name, fontsize=9)
        axis.set_xlabel("time per unit of strain / default")
    axes[0].set_ylabel("shift of the steady mean, %")
    axes[0].legend(
        handles=[*axes[1].get_legend_handles_labels()[0]]
        + [Line2D([], [], color="k", linestyle="", marker=m, label=n) for n, (m, _) in surfaces.items()],
        fontsize=7,
    )
    save(figure, path)


def with_tables(page, tables):
    """The page with the rows of the tables that have the same heads."""
    for title, columns, rows in tables:
        head = "| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|\n"
        before, found, after = page.partition(head)
        if not found:
            raise SystemExit(
                f"steady_chart.py: {PAGE.name} has no table '{title}', with the head {head.splitlines()[0]}"
            )
        lines = "".join("| " + " | ".join(row) + " |\n" for row in rows)
        page = before + head + lines + re.sub(r"\A(\|.*\n)*", "", after)
    return page


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--images", type=pathlib.Path, default=ROOT / "doc" / "images", help="folder of the figures")
    parser.add_argument("--write", action="store_true", help=f"put the tables into {PAGE.relative_to(ROOT)}")
    arguments = parser.parse_args()
    images = arguments.images
    results, rows, onset = Results(HERE / "results.csv"), read_results(), read_onset()
    if not rows:
        raise SystemExit(f"steady_chart.py: {RESULTS} has no rows; steady.py makes them")
    flows = [one for series in SERIES if (one := FlowMeans(rows, series)).curves]
    tables = [
        table_of_shifts(flows),
        table_of_kinds(flows),
        table_of_onset(onset),
        table_of_means(flows),
        table_of_energy(results),
    ]
    for one in tables:
        table(*one)
    print_scatter(rows, flows)
    if arguments.write:
        PAGE.write_text(with_tables(PAGE.read_text(), tables))
    draw_steps(results, flows, images / "accuracy_step.png")
    draw_cost(results, flows, images / "accuracy_cost.png")
    draw_onset(onset, images / "accuracy_onset.png")


if __name__ == "__main__":
    main()
