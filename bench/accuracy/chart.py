#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the figures of doc/accuracy.md and doc/compute_dissipation.md, and prints the tables of doc/accuracy.md, from
results.csv alone."""
import argparse
from collections import namedtuple
import csv
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from grainscope.figures.style import RUN_COLOURS, plt, points, save, shape_colour, shape_handle, shape_marker
import numpy as np
from matplotlib.lines import Line2D

ALPHAS = (0.33, 1.0, 1.5)
MEASURES = {"mu_eff": r"$\mu_{eff}$", "phi": r"$\phi$", "ledger_n": r"$P_n$", "ledger_t": r"$P_t$"}
COLOURS = dict(zip(MEASURES, RUN_COLOURS))
MODES = ("instantaneous", "step", "ledger")
LEAKS = ("G_k", "G_p", "G_n", "G_open", "G_dt")
MISSED = [f"{mode}_{part} - ledger_{part}" for mode in ("instantaneous", "step") for part in "nt"]
COMPARED = ((0.0, 0.4), "0.04")  # frictions, and a strain over which chaos has not yet parted the runs
Flow = namedtuple("Flow", "alpha mu I e")


class Results:
    def __init__(self, path):
        with open(path, newline="") as lines:
            self.rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        for row in self.rows:
            for name in ("alpha", "mu", "I", "e", "value", "error"):
                row[name] = float(row[name] or "nan")

    def pick(self, study, quantity, **wanted):
        return [
            row
            for row in self.rows
            if row["study"] == study
            and row["quantity"] == quantity
            and all(row[name] == value for name, value in wanted.items())
        ]

    def pair(self, study, quantity, **wanted):
        """Value and error of the only such row."""
        (row,) = self.pick(study, quantity, **wanted)
        return row["value"], row["error"]

    def flows(self, study, **wanted):
        found = dict.fromkeys(
            (row["alpha"], row["mu"], row["I"], row["e"])
            for row in self.rows
            if row["study"] == study and all(row[name] == value for name, value in wanted.items())
        )
        return [
            dict(zip(("alpha", "mu", "I", "e"), flow))
            for flow in sorted(found, key=lambda f: (-f[2], f[3], f[1], f[0]))
        ]

    def steps(self, study, **wanted):
        """Fraction of the shorter time, and the setting's name."""
        found = {
            row["setting"]
            for row in self.rows
            if row["study"] == study and all(row[name] == value for name, value in wanted.items())
        }
        return sorted(
            (0.15 if name == "default" else float(name.split()[1]), name)
            for name in found
            if name == "default" or name.startswith("fraction")
        )


def pooled(results, quantity, setting, frictions, window):
    """Mean over the flows of a paired error, and its standard error from those of the flows."""
    if quantity == "ledger_t":
        frictions = [mu for mu in frictions if mu > 0]
    rows = [
        row for mu in frictions for row in results.pick("paired", quantity, setting=setting, I=0.1, mu=mu, at=window)
    ]
    return np.mean([row["value"] for row in rows]), math.sqrt(sum(row["error"] ** 2 for row in rows)) / len(rows)


def energy_error(results, alpha, setting, inertial=0.1, mu=0.4):
    return abs(results.pair("account", "G_dt", alpha=alpha, mu=mu, I=inertial, e=0.1, setting=setting)[0])


def relative_time(results, alpha, setting):
    """Measured, and for steps that were not timed from the number of steps."""
    timed = results.pick("cost", "relative time", alpha=alpha, setting=setting)
    return timed[0]["value"] if timed else 0.15 / float(setting.split()[1])


def guide(axis, x, y, order):
    axis.plot(x, y * (np.array(x) / x[-1]) ** order, color="0.7", linewidth=0.8, zorder=0)
    axis.annotate(
        rf"$\Delta t^{order}$" if order > 1 else r"$\Delta t$",
        (x[0], y * (x[0] / x[-1]) ** order),
        color="0.5",
        fontsize=8,
        ha="right",
        va="center",
    )


def step_axis(axis, ticks):
    axis.set_xscale("log")
    axis.set_xticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    axis.set_xticks([], minor=True)
    axis.set_xlabel(r"$\Delta t / \min(T_R, T_H)$")


def floor_label(axis, value, text):
    axis.axhline(value, color="0.6", linestyle=":", linewidth=1)
    axis.annotate(
        text, (1.0, value), xycoords=("axes fraction", "data"), ha="left", va="center", fontsize=8, color="0.4"
    )


def draw_divergence(results, path):
    """How trajectories part: shear stress against the strain since the common start."""
    figure, axes = plt.subplots(1, 3, figsize=(11.5, 3.6), constrained_layout=True, sharey=True)
    looks = {
        "fraction 0.6": (RUN_COLOURS[1], "-"),
        "fraction 0.3": (RUN_COLOURS[5], "-"),
        "default": (RUN_COLOURS[0], "-"),
        "superquadric": (RUN_COLOURS[2], "--"),
        "nve/superquadric": (RUN_COLOURS[3], ":"),
    }
    for axis, alpha in zip(axes, ALPHAS):
        for name, (colour, line) in looks.items():
            rows = results.pick("divergence", "sigma_xy", setting=name, alpha=alpha)
            label = {"default": "0.15"}.get(name, name.replace("fraction ", ""))
            axis.plot(
                [float(row["at"]) for row in rows],
                [row["value"] or math.nan for row in rows],
                line,
                color=colour,
                linewidth=1.4,
                label=label,
            )
        axis.set_yscale("log")
        axis.set_title(rf"$\alpha = {alpha:g}$")
        axis.set_xlabel("strain since the common start")
    axes[0].set_ylabel(r"rms difference of $\sigma_{xy}$ / its mean")
    axes[2].legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)


def draw_sampling(results, path):
    figure, axis = plt.subplots(figsize=(5.6, 4), constrained_layout=True)
    for quantity, label in MEASURES.items():
        name = quantity.replace("ledger", "step")
        rows = [row for row in results.pick("sampling", name) if row["setting"] != "statistical"]
        axis.plot(
            [float(row["setting"].split()[1]) for row in rows],
            [row["value"] for row in rows],
            "o-",
            markersize=4,
            linewidth=1.2,
            color=COLOURS[quantity],
            label=label,
        )
        axis.axhline(
            results.pair("sampling", name, setting="statistical")[0],
            color=COLOURS[quantity],
            linestyle=":",
            linewidth=1,
        )
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("strain between samples")
    axis.set_ylabel("relative error of the mean over strain 6")
    axis.legend(fontsize=8)
    save(figure, path)


def draw_modes(results, path):
    """The paper's Fig. 13 with all three modes: the power dissipated against the time step."""
    figure, axes = plt.subplots(1, 2, figsize=(10.5, 4.2), constrained_layout=True)
    shift = dict(zip(ALPHAS, (0.97, 1.0, 1.03)))
    lines = dict(zip(MODES, (":", "--", "-")))
    for axis, wanted in zip(axes, ({"I": 0.01, "mu": 0.4}, {"I": 0.1, "mu": 10.0})):
        for alpha in ALPHAS:
            steps = results.steps("modes", alpha=alpha, e=0.1, **wanted)
            for mode in MODES:
                pairs = []
                for _, name in steps:
                    parts = [
                        results.pair("modes", f"{mode}_{part}", alpha=alpha, e=0.1, setting=name, **wanted)
                        for part in "nt"
                    ]
                    pairs.append(
                        (parts[0][0] + parts[1][0], math.hypot(parts[0][1], parts[1][1]) if mode == "ledger" else 0.0)
                    )
                points(
                    axis,
                    [shift[alpha] * fraction for fraction, _ in steps],
                    pairs,
                    color=shape_colour(alpha),
                    marker=shape_marker(alpha),
                    linestyle=lines[mode],
                    markersize=4,
                )
        step_axis(axis, (0.05, 0.1, 0.15, 0.3, 0.6))
        axis.set_title(rf"$I = {wanted['I']:g}$, $\mu_p = {wanted['mu']:g}$")
    axes[0].set_ylabel(r"$(P_n + P_t) / \dot\gamma P \Omega$")
    axes[1].legend(
        handles=[shape_handle(alpha) for alpha in ALPHAS]
        + [Line2D([], [], color="k", linestyle=lines[mode], label=mode) for mode in MODES],
        fontsize=8,
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
    )
    save(figure, path)


def table(title, columns, rows):
    print(f"\n{title}\n\n| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")


def percent(value, error=math.nan):
    if abs(value) < 1e-9:
        text = "0"
    elif abs(value) < 1e-3:
        text = f"{100 * value:.1g}"
    else:
        text = f"{100 * value:.2f}"
    return text if math.isnan(error) else f"{text} ± {100 * error:.1g}"


def print_times(results):
    rows = []
    for flow in results.flows("times", mu=0.4, e=0.1):
        rayleigh, hertz = (results.pair("times", name, **flow)[0] for name in ("T_R", "T_H"))
        rows.append(
            [f"{flow['alpha']:g}", f"{flow['I']:g}", f"{hertz / rayleigh:.1f}", f"{1 / (0.15 * rayleigh):,.0f}"]
        )
    table("Times", ["alpha", "I", "T_H / T_R", "default steps per unit of strain"], rows)


def print_costs(results):
    rows = []
    for name in dict.fromkeys(row["setting"] for row in results.pick("cost", "relative time")):
        cells = []
        for alpha in ALPHAS:
            wanted = {"alpha": alpha, "setting": name}
            steps, lists, time = (
                results.pair("cost", quantity, **wanted)[0] for quantity in ("steps", "lists", "relative time")
            )
            cells.append(f"{time:.2f} ± {results.pair('cost', 'relative time', **wanted)[1]:.2f} ({steps / lists:.0f})")
        rows.append([name, *cells])
    table(
        "Cost: time per unit of strain over the default's (steps per neighbour list)",
        ["setting", *(f"alpha = {a:g}" for a in ALPHAS)],
        rows,
    )


def print_variants(results):
    rows = []
    names = dict.fromkeys(
        row["setting"]
        for row in results.pick("paired", "mu_eff")
        if not row["setting"].startswith(("fraction", "default"))
    )
    for name in names:
        cells = [name, ", ".join(f"{relative_time(results, alpha, name):.2f}" for alpha in ALPHAS)]
        for quantity in MEASURES:
            cells.append(percent(*pooled(results, quantity, name, *COMPARED)))
        cells.append(percent(max(abs(row["value"]) for row in results.pick("account", "residual", setting=name))))
        rows.append(cells)
    table(
        "Other settings against the default, %",
        ["setting", "time, alpha = 0.33, 1, 1.5", *MEASURES, "largest residual"],
        rows,
    )


def print_modes(results):
    rows = []
    for flow in results.flows("modes"):

        def cell(quantity):
            return percent(results.pair("modes", quantity, setting="default", **flow)[0])

        cells = [f"{flow[name]:g}" for name in ("alpha", "mu", "I", "e")]
        share = [results.pair("modes", f"ledger_{part}", setting="default", **flow)[0] for part in "nt"]
        cells += [f"{100 * share[0] / sum(share):.0f}"]
        cells += [cell(name) for name in MISSED]
        cells += [cell(name) for name in (*LEAKS, "G", "residual")]
        rows.append(cells)
    table(
        "Modes at the default step, % of D_n + D_t",
        [
            "alpha",
            "mu_p",
            "I",
            "e",
            "share of D_n",
            "instantaneous P_n",
            "P_t",
            "step P_n",
            "P_t",
            *LEAKS,
            "sum of G",
            "residual",
        ],
        rows,
    )


def print_modes_by_step(results):
    rows = []
    for flow in (
        Flow(1.0, 0.4, 0.1, 0.1),
        Flow(1.0, 0.4, 0.1, 0.9),
        Flow(1.0, 0.4, 0.01, 0.1),
        Flow(1.5, 10.0, 0.1, 0.1),
        Flow(1.5, 0.0, 0.1, 0.1),
    ):
        wanted = flow._asdict()
        for fraction, name in results.steps("modes", **wanted):
            rows.append(
                [f"{value:g}" for value in (*flow, fraction)]
                + [
                    percent(results.pair("modes", quantity, setting=name, **wanted)[0])
                    for quantity in (*MISSED, "G_k", "G_open", "G_dt")
                ]
            )
    table(
        "Modes over the step, % of D_n + D_t",
        ["alpha", "mu_p", "I", "e", "dt / T_R", "instantaneous P_n", "P_t", "step P_n", "P_t", "G_k", "G_open", "G_dt"],
        rows,
    )


def print_sampling(results):
    rows = []
    for name in dict.fromkeys(row["setting"] for row in results.pick("sampling", "mu_eff")):
        rows.append(
            [
                name,
                *(
                    percent(results.pair("sampling", quantity.replace("ledger", "step"), setting=name)[0])
                    for quantity in MEASURES
                ),
            ]
        )
    table("Sampling, % of each mean over strain 6", ["", *MEASURES], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--images", type=pathlib.Path, default=ROOT / "doc" / "images", help="folder of the figures")
    images = parser.parse_args().images
    results = Results(HERE / "results.csv")
    for draw, name in (
        (draw_divergence, "accuracy_divergence"),
        (draw_sampling, "accuracy_sampling"),
        (draw_modes, "dissipation_modes"),
    ):
        draw(results, images / f"{name}.png")
    for show in (
        print_times,
        print_costs,
        print_variants,
        print_modes,
        print_modes_by_step,
        print_sampling,
    ):
        show(results)


if __name__ == "__main__":
    main()
