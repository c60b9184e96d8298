"""doc/images/stability_dt.png, from the csv files alone."""

import sys

import numpy as np

from dt_tools import HERE, column, rows_of

sys.path.insert(0, str(HERE.parents[1] / "tools"))
from grainscope.figures.style import (
    Line2D,
    RUN_COLOURS,
    log_scale,
    plt,
    save,
    shape_colour,
    shape_handle,
    shape_marker,
)  # noqa: E402

RULE = 0.15
EXCESS = 0.01
SHOWN = ("0.1", "0.5", "0.99")
ALPHA = r"aspect ratio $\alpha$"


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
            axis.plot(
                column(runs, "alpha"),
                np.sqrt(column(runs, "stable") * column(runs, "unstable")),
                color=colour,
                linestyle="",
                marker="o" if damping == "off" else "s",
                markersize=5,
                markerfacecolor=colour if damping == "off" else "white",
            )
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
    return crossing(
        column(found, "dt_over_hertz"),
        column(found, name) - (column(found, name)[0] if name == "mean" else 0.0),
        EXCESS,
    )


def draw_pairs(axis):
    alphas = sorted({row["alpha"] for row in rows_of("dt_pairs")}, key=float)
    for e, colour in zip(SHOWN, RUN_COLOURS):
        for speed, style in (("0.02", "-"), ("0.5", ":")):
            limits = [collision_limit(speed, alpha, e) for alpha in alphas]
            axis.plot(
                [float(alpha) for alpha in alphas], limits, style, color=colour, marker="o", markersize=4, linewidth=1.2
            )
    axis.set_ylim(0.07, 3.5)
    log_scale(axis.xaxis)
    log_scale(axis.yaxis)
    rule(axis, r"$0.15\,T_H$")
    axis.set(title="c  pairs: collisions create 1 % of the energy", xlabel=ALPHA, ylabel=r"$\Delta t/T_H$")


def draw_flows(axis):
    """Energy that the time step makes or takes, over what the shear brings in; a cross: the grains flew away."""
    for (e, damping), style in ((("0.1", "off"), "-"), (("0.1", "on"), "--")):
        for alpha in ("0.2", "1", "5"):
            found = rows_of("dt_flow", press="1e-5", alpha=alpha, e=e, damping=damping)
            kept, colour = [row for row in found if row["W_shear"] != "inf"], shape_colour(float(alpha))
            made = np.abs(column(kept, "G_dt")) + np.maximum(0, -column(kept, "D_damp"))
            axis.plot(
                column(kept, "dt_over_rayleigh"),
                made / column(kept, "W_shear"),
                style,
                color=colour,
                marker=shape_marker(float(alpha)),
                markersize=4,
                linewidth=1.2,
                markerfacecolor=colour if damping == "off" else "white",
            )
            lost = column(found, "dt_over_rayleigh")[len(kept) :][:1]
            axis.plot(lost, np.full(len(lost), 3.0), marker="x", color=colour, markersize=6, linestyle="")
    axis.axhline(EXCESS, color="0.6", linewidth=0.8, linestyle=":")
    axis.set_yscale("log")
    log_scale(axis.xaxis)
    axis.axvline(RULE, color="0.6", linewidth=4, alpha=0.6, zorder=0)
    axis.set(
        title=r"d  flows, $e = 0.1$: work of the time step", xlabel=r"$\Delta t/T_R$", ylabel="over that of the shear"
    )
    axis.legend(handles=[shape_handle(alpha) for alpha in (5.0, 1.0, 0.2)], loc="upper left", fontsize=9)


def draw():
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.2), constrained_layout=True)
    draw_limits(axes[0, 0], "1e-5", r"a  packings under $10^{-5} E$ (overlaps 0.03 to 0.08 %)")
    draw_limits(axes[0, 1], "1e-3", r"b  packings under $10^{-3} E$ (0.7 to 1.8 %)")
    draw_pairs(axes[1, 0])
    draw_flows(axes[1, 1])
    handles = [Line2D([], [], color=colour, label=f"$e = {e}$") for e, colour in zip(SHOWN, RUN_COLOURS)]
    handles += [
        Line2D([], [], color="0.3", marker="o", label="no tangential damping"),
        Line2D([], [], color="0.3", marker="s", markerfacecolor="white", linestyle="--", label="tangential damping"),
    ]
    figure.legend(handles=handles, loc="upper center", ncols=5, bbox_to_anchor=(0.5, 1.05))
    save(figure, HERE.parents[1] / "doc" / "images" / "stability_dt.png")
