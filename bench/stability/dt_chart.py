"""doc/images/stability_dt.png, from the csv files alone."""
import csv
import sys

import numpy as np

from dt_tools import HERE

sys.path.insert(0, str(HERE.parents[1] / "tools"))
from figure_style import Line2D, RUN_COLOURS, log_scale, plt, save, shape_colour, shape_handle, shape_marker  # noqa: E402

RULE = 0.15
EXCESS = 0.01
SHOWN = ("0.1", "0.5", "0.99")
ALPHA = r"aspect ratio $\alpha$"


def rows_of(name, **wanted):
    with open(HERE / f"{name}.csv") as file:
        return [row for row in csv.DictReader(file) if all(row[c] == v for c, v in wanted.items())]


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def rule(axis, label):
    axis.axhline(RULE, color="0.6", linewidth=4, alpha=0.6, zorder=0)
    axis.text(0.02, RULE * 1.06, label, transform=axis.get_yaxis_transform(), color="0.4", fontsize=9, va="bottom")


def draw_limits(axis, press, title):
    """Curves: linear theory. Markers: where the motion of a packing grows in a run."""
    for e, colour in zip(SHOWN, RUN_COLOURS):
        for damping, style in (("off", "-"), ("on", "--")):
            found = rows_of("dt_theory", press=press, e=e, damping=damping)
            axis.plot(column(found, "alpha"), column(found, "network"), style, color=colour, linewidth=1.2)
            runs = rows_of("dt_growth", press=press, e=e, damping=damping)
            axis.plot(column(runs, "alpha"), np.sqrt(column(runs, "stable") * column(runs, "unstable")), color=colour, linestyle="",
                      marker="o" if damping == "off" else "s", markersize=5, markerfacecolor=colour if damping == "off" else "white")
    axis.set_ylim(0.07, 3.5)
    log_scale(axis.xaxis)
    log_scale(axis.yaxis)
    rule(axis, r"$0.15\,T_R$")
    axis.set(title=title, xlabel=ALPHA, ylabel=r"unstable from $\Delta t/T_R$")


def crossing(steps, values, level):
    """Where values, rising with the step, pass the level; by interpolation of logarithms of the step."""
    above = np.nonzero(values > level)[0]
    if len(above) == 0 or above[0] == 0:
        return np.nan
    k = above[0]
    part = (level - values[k - 1]) / (values[k] - values[k - 1])
    return float(np.exp((1 - part) * np.log(steps[k - 1]) + part * np.log(steps[k])))


def collision_limit(speed, alpha, e, name="mean"):
    """Time step over Hertz' time at which collisions keep 1 % more energy than at the finest step."""
    found = rows_of("dt_pairs", speed=speed, alpha=alpha, e=e)
    return crossing(column(found, "dt_over_hertz"), column(found, name) - (column(found, name)[0] if name == "mean" else 0.0), EXCESS)


def draw_pairs(axis):
    alphas = sorted({row["alpha"] for row in rows_of("dt_pairs")}, key=float)
    for e, colour in zip(SHOWN, RUN_COLOURS):
        for speed, style in (("0.02", "-"), ("0.5", ":")):
            limits = [collision_limit(speed, alpha, e) for alpha in alphas]
            axis.plot([float(alpha) for alpha in alphas], limits, style, color=colour, marker="o", markersize=4, linewidth=1.2)
    axis.set_ylim(0.07, 3.5)
    log_scale(axis.xaxis)
    log_scale(axis.yaxis)
    rule(axis, r"$0.15\,T_H$")
    axis.set(title="c  pairs: 1 % of the energy created per collision", xlabel=ALPHA, ylabel=r"$\Delta t/T_H$")


def draw_flows(axis):
    """Energy that the time step makes, over what the shear brings in."""
    for press, style in (("1e-5", "-"), ("1e-3", "--")):
        for alpha in ("0.2", "1", "5"):
            found = rows_of("dt_flow", press=press, alpha=alpha, e="0.1", damping="off")
            share = np.abs(column(found, "G_dt")) / column(found, "W_shear")
            axis.plot(column(found, "dt_over_rayleigh"), share, style, color=shape_colour(float(alpha)), marker=shape_marker(float(alpha)),
                      markersize=4, linewidth=1.2)
    log_scale(axis.xaxis)
    axis.set_yscale("log")
    axis.axvline(RULE, color="0.6", linewidth=4, alpha=0.6, zorder=0)
    axis.set(title=r"d  flows, $e = 0.1$: work of the time step", xlabel=r"$\Delta t/T_R$", ylabel=r"$|G_{dt}|/W_{shear}$")
    axis.legend(handles=[shape_handle(alpha) for alpha in (5.0, 1.0, 0.2)], loc="upper left", fontsize=9)


def draw():
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.2), constrained_layout=True)
    draw_limits(axes[0, 0], "1e-5", r"a  packings under $10^{-5} E$ (overlap 0.1 %)")
    draw_limits(axes[0, 1], "1e-3", r"b  packings under $10^{-3} E$ (overlap 1 to 2 %)")
    draw_pairs(axes[1, 0])
    draw_flows(axes[1, 1])
    handles = [Line2D([], [], color=colour, label=f"$e = {e}$") for e, colour in zip(SHOWN, RUN_COLOURS)]
    handles += [Line2D([], [], color="0.3", marker="o", label="no tangential damping"),
                Line2D([], [], color="0.3", marker="s", markerfacecolor="white", linestyle="--", label="tangential damping")]
    figure.legend(handles=handles, loc="upper center", ncols=5, bbox_to_anchor=(0.5, 1.05))
    save(figure, HERE.parents[1] / "doc" / "images" / "stability_dt.png")
