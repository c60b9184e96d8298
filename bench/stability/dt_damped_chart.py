"""doc/images/stability_damped.png, from the csv files alone."""

import sys

import numpy as np

from dt_tools import HERE, column, rows_of

sys.path.insert(0, str(HERE.parents[1] / "tools"))
from grainscope.figures.style import (
    Line2D,
    log_scale,
    plt,
    save,
    shape_colour,
    shape_handle,
    shape_marker,
)  # noqa: E402

ALPHAS, RULE = ("3", "1.5", "1", "0.33"), 0.15
TITLES = {"1e-5": r"a  packings under $10^{-5} E$", "1e-3": r"b  packings under $10^{-3} E$"}


def draw_limits(axis, press):
    """Curves: linear theory. Markers: where the motion of a packing grows in a run."""
    for alpha in ALPHAS:
        colour = shape_colour(float(alpha))
        found = rows_of("damped_theory", press=press, alpha=alpha)
        axis.plot(column(found, "e"), column(found, "network"), color=colour, linewidth=1.2)
        axis.plot(column(found, "e"), column(found, "bound"), ":", color=colour, linewidth=1.2)
        runs = rows_of("damped_growth", press=press, alpha=alpha)
        limits = np.sqrt(column(runs, "stable") * column(runs, "unstable"))
        axis.plot(column(runs, "e"), limits, color=colour, linestyle="", marker=shape_marker(float(alpha)))
    axis.axhline(RULE, color="0.6", linewidth=4, alpha=0.6, zorder=0)
    axis.set_ylim(0, 0.8 if press == "1e-5" else 0.4)
    axis.set(title=TITLES[press], xlabel="coefficient of restitution", ylabel=r"unstable from $\Delta t/T_R$")


def draw_flows(axis):
    """Energy that the time step makes, over what the shear brings in; filled where the program warned, a cross where
    the grains flew away."""
    for press, style in (("1e-5", "-"), ("1e-3", "--")):
        for alpha in ALPHAS:
            found, colour = rows_of("damped_flow", press=press, alpha=alpha), shape_colour(float(alpha))
            kept = [row for row in found if row["W_shear"] != "inf"]
            steps = column(kept, "dt_over_rayleigh")
            made = (np.abs(column(kept, "G_dt")) + np.maximum(0, -column(kept, "D_damp"))) / column(kept, "W_shear")
            axis.plot(steps, made, style, color=colour, linewidth=1.2)
            for x, y, warned in zip(steps, made, column(kept, "warned") > 0):
                face = colour if warned else "white"
                axis.plot(x, y, marker=shape_marker(float(alpha)), color=colour, markerfacecolor=face, markersize=5)
            lost = column(found, "dt_over_rayleigh")[len(kept) :][:1]
            axis.plot(lost, np.full(len(lost), 3.0), marker="x", color=colour, linestyle="")
    axis.axvline(RULE, color="0.6", linewidth=4, alpha=0.6, zorder=0)
    axis.set_yscale("log")
    log_scale(axis.xaxis)
    axis.set(
        title=r"c  flows, $e = 0.0501$: work of the time step",
        xlabel=r"$\Delta t/T_R$",
        ylabel="over that of the shear",
    )


def draw():
    figure, axes = plt.subplots(1, 3, figsize=(12.6, 3.9), constrained_layout=True)
    draw_limits(axes[0], "1e-5")
    draw_limits(axes[1], "1e-3")
    draw_flows(axes[2])
    handles = [shape_handle(float(alpha)) for alpha in ALPHAS]
    handles += [
        Line2D([], [], color="0.3", label="theory"),
        Line2D([], [], color="0.3", linestyle=":", label="warned from"),
    ]
    axes[0].legend(handles=handles, fontsize=9, ncols=2, loc="upper left")
    handles = [
        Line2D([], [], color="0.3", marker="o", label=r"$10^{-5} E$, warned"),
        Line2D([], [], color="0.3", marker="o", markerfacecolor="white", linestyle="--", label=r"$10^{-3} E$, not"),
    ]
    axes[2].legend(handles=handles, fontsize=9, loc="upper left")
    save(figure, HERE.parents[1] / "doc" / "images" / "stability_damped.png")
