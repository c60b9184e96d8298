"""doc/images/stability_spin.png, from the csv files alone."""

import sys

import numpy as np

from dt_tools import HERE, column, rows_of

sys.path.insert(0, str(HERE.parents[1] / "tools"))
from grainscope.figures.style import RUN_COLOURS, Line2D, log_scale, plt, save  # noqa: E402

GRAINS = list(zip(("3", "0.33", "0.1"), RUN_COLOURS, "osD"))  # alpha, colour, marker
TURN = r"$\omega\,\Delta t$"


def draw_hits(axis, name, turn, label):
    """Open: a plane. Filled: a grain. Dashed: with friction."""
    for alpha, colour, marker in GRAINS:
        for target, face in (("plane", "white"), ("grain", colour)):
            for law, style in (("frictionless", "-"), ("mu 0.5", "--")):
                found = rows_of("spin_hits", alpha=alpha, target=target, law=law)
                axis.plot(
                    column(found, turn),
                    np.maximum(column(found, name), 1e-6),
                    style,
                    color=colour,
                    marker=marker,
                    markerfacecolor=face,
                    markersize=5,
                    linewidth=1.0,
                )
    axis.set(xlabel=label)
    log_scale(axis.xaxis)


def draw_free(axis):
    for mover, style in (("nve/spheroid", "-"), ("nve/superquadric", "--")):
        for alpha, colour, marker in GRAINS:
            found = sorted(rows_of("spin_free", mover=mover, alpha=alpha), key=lambda row: float(row["turn"]))
            axis.plot(
                column(found, "turn"),
                np.maximum(column(found, "axis"), 1e-16),
                style,
                color=colour,
                marker=marker,
                markersize=5,
                linewidth=1.0,
            )
    axis.set_yscale("log")
    log_scale(axis.xaxis)
    axis.set(title="c  free flight, 100,000 steps", xlabel=TURN, ylabel="error of the axis, rad")


def draw():
    figure, axes = plt.subplots(1, 3, figsize=(12.6, 3.9), constrained_layout=True)
    draw_hits(axes[0], "rms", "turn", TURN)
    axes[0].set_yscale("log")
    axes[0].set(title="a  error of the energy after a collision (rms)", ylabel="over the energy before")
    draw_hits(axes[1], "worst", "tip_over_sound", "speed of the tip over that of sound")
    axes[1].set_yscale("log")
    axes[1].set(title="b  the largest of 24", ylabel="over the energy before")
    draw_free(axes[2])
    handles = [Line2D([], [], color=c, marker=m, label=rf"$\alpha = {alpha}$") for alpha, c, m in GRAINS]
    axes[0].legend(handles=handles, fontsize=9, loc="upper left")
    handles = [
        Line2D([], [], color="0.3", marker="o", label="grain"),
        Line2D([], [], color="0.3", marker="o", markerfacecolor="white", label="plane"),
        Line2D([], [], color="0.3", linestyle="--", label="friction"),
    ]
    axes[1].legend(handles=handles, fontsize=9, loc="upper left")
    handles = [
        Line2D([], [], color="0.3", label="nve/spheroid"),
        Line2D([], [], color="0.3", linestyle="--", label="nve/superquadric"),
    ]
    axes[2].legend(handles=handles, fontsize=9, loc="center right")
    save(figure, HERE.parents[1] / "doc" / "images" / "stability_spin.png")
