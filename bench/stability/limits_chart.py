"""doc/images/stability_limits.png, from the csv files alone."""

import sys

import numpy as np

from dt_tools import HERE, column, rows_of

sys.path.insert(0, str(HERE.parents[1] / "tools"))
from grainscope.figures.style import (  # noqa: E402
    Line2D,
    RUN_COLOURS,
    plt,
    save,
    shape_colour,
    shape_handle,
    shape_marker,
)

QUANTITIES = {
    "force": "force, first step",
    "torque": "torque, first step",
    "force_40": "force, step 40",
    "spin_40": "spin, step 40",
    "place_40": "place, step 40",
    "D_t": "friction, 40 steps",
}


def draw_alpha(axis):
    """Distance from alpha = 1: filled above, open below."""
    for name, colour in zip(QUANTITIES, RUN_COLOURS):
        for side, face in (("above", colour), ("below", "white")):
            found = rows_of("limits_alpha", law="gaussian", mover="nve/spheroid", side=side)
            deviation, value = column(found, "deviation"), column(found, name)
            axis.plot(
                deviation[value > 0],
                value[value > 0],
                color=colour,
                marker="o",
                markersize=4,
                markerfacecolor=face,
                linewidth=0.8,
            )
    axis.axvline(1e-9, color="0.6", linewidth=4, alpha=0.4, zorder=0)
    axis.text(1.6e-9, 2e-13, "equal semi-axes below", color="0.4", fontsize=9, va="bottom")
    axis.set(
        xscale="log",
        yscale="log",
        xlabel=r"$|\alpha - 1|$",
        ylabel=r"distance from $\alpha = 1$",
        title=r"a  towards the sphere",
    )
    axis.legend(
        handles=[
            Line2D([], [], color=colour, marker="o", markersize=4, label=label)
            for label, colour in zip(QUANTITIES.values(), RUN_COLOURS)
        ],
        fontsize=8,
        loc="upper left",
    )


def draw_jamming(axis):
    """Pressure over that of the packing: without friction dashed."""
    for mu, style in (("0.4", "-"), ("0", "--")):
        for alpha in ("0.33", "1", "3"):
            found = rows_of("limits_jamming", mu=mu, alpha=alpha)
            axis.plot(
                column(found, "change"),
                np.maximum(column(found, "pressure"), 1e-5),
                style,
                color=shape_colour(float(alpha)),
                marker=shape_marker(float(alpha)),
                markersize=4,
                linewidth=1.2,
            )
    axis.set(yscale="log", xlabel=r"$\phi/\phi_P - 1$", ylabel=r"$P/P_0$", title="b  around jamming, constant volume")
    handles = [shape_handle(alpha) for alpha in (3.0, 1.0, 0.33)]
    handles += [
        Line2D([], [], color="0.3", linestyle=style, label=rf"$\mu_p = {mu}$")
        for mu, style in (("0.4", "-"), ("0", "--"))
    ]
    axis.legend(handles=handles, fontsize=8, loc="lower right")


def draw_residuals(axis):
    """Of every case, over all that went through the ledger."""
    groups = [
        ("flows", rows_of("limits_ends", kind="flow")),
        ("flows at P", rows_of("limits_ends", kind="pressed")),
        ("left alone", rows_of("limits_ends", kind="alone")),
        ("jamming", rows_of("limits_jamming")),
    ]
    for place, (name, found) in enumerate(groups):
        spread = np.linspace(-0.3, 0.3, len(found))
        for shift, row in zip(spread, found):
            axis.plot(
                place + shift,
                max(float(row["residual"]), 1e-17),
                color=shape_colour(float(row["alpha"])),
                marker=shape_marker(float(row["alpha"])),
                markersize=4,
            )
    axis.set_xticks(range(len(groups)), [name for name, _ in groups])
    axis.set(yscale="log", ylim=(1e-17, 1e-9), ylabel="residual of the ledger", title="c  does the ledger close?")


def draw():
    figure, axes = plt.subplots(1, 3, figsize=(13.5, 4.0), constrained_layout=True)
    for axis, panel in zip(axes, (draw_alpha, draw_jamming, draw_residuals)):
        panel(axis)
    save(figure, HERE.parents[1] / "doc" / "images" / "stability_limits.png")
