"""doc/images/stability_walls.png, from the csv file alone."""

import sys

import numpy as np

from dt_tools import HERE, column, rows_of

sys.path.insert(0, str(HERE.parents[1] / "tools"))
from grainscope.figures.style import RUN_COLOURS, Line2D, log_scale, plt, save  # noqa: E402

RULE = 0.15
SCENES = (("plane", "o"), ("corner", "^"), ("plates", "s"))
GRAINS = (("0.33", "lying"), ("0.33", "standing"), ("1", "lying"), ("1.5", "lying"), ("1.5", "standing"))
GRAINS += (("3", "lying"), ("3", "standing"))


def measured(rows):
    return column(rows, "theory") * np.sqrt(column(rows, "bounded") * column(rows, "grows"))


def draw_all(axis):
    for (scene, marker), colour in zip(SCENES, RUN_COLOURS):
        for damping in ("off", "on"):
            rows = rows_of("dt_walls", scene=scene, damping=damping)
            face = colour if damping == "off" else "white"
            points = dict(linestyle="", marker=marker, color=colour, markerfacecolor=face, markersize=4)
            axis.plot(column(rows, "theory"), measured(rows), **points)
    axis.plot((0.2, 6), (0.2, 6), color="0.6", linewidth=0.8, zorder=0)
    log_scale(axis.xaxis)
    log_scale(axis.yaxis)
    axis.set(
        title=f"a  all {len(rows_of('dt_walls'))} limits",
        xlabel=r"theory, $\Delta t/T_R$",
        ylabel=r"measured, $\Delta t/T_R$",
    )


def draw_worst(axis):
    for (scene, marker), colour in zip(SCENES, RUN_COLOURS):
        rows = rows_of("dt_walls", scene=scene, kind="primitive", damping="on", overlap="1e-2", e="0.1")
        rows = [row for grain in GRAINS for row in rows if (row["alpha"], row["posture"]) == grain]
        axis.plot(range(len(GRAINS)), measured(rows), color=colour, marker=marker, markersize=5, linewidth=1)
    axis.plot(range(len(GRAINS)), column(rows, "pair"), "--", color="0.3", marker="x", linewidth=1)
    axis.axhline(RULE, color="0.6", linewidth=4, alpha=0.6, zorder=0)
    axis.set_xticks(range(len(GRAINS)), [f"{alpha}\n{posture}" for alpha, posture in GRAINS], fontsize=8)
    axis.set_ylim(0, None)
    axis.set(title=r"b  $e = 0.1$, damped, $d/2r = 10^{-2}$", ylabel=r"unstable from $\Delta t/T_R$")


def draw():
    figure, axes = plt.subplots(1, 2, figsize=(9.6, 3.9), constrained_layout=True)
    draw_all(axes[0])
    draw_worst(axes[1])
    handles = [
        Line2D([], [], color=colour, marker=marker, label=scene) for (scene, marker), colour in zip(SCENES, RUN_COLOURS)
    ]
    damped = [
        Line2D([], [], color="0.3", marker="o", markerfacecolor="white", linestyle="", label="tangential damping")
    ]
    pair = [Line2D([], [], color="0.3", marker="x", linestyle="--", label="a pair alone, same overlap")]
    axes[0].legend(handles=handles + damped, fontsize=9, loc="upper left")
    axes[1].legend(handles=handles + pair, fontsize=9, loc="upper right")
    save(figure, HERE.parents[1] / "doc" / "images" / "stability_walls.png")
