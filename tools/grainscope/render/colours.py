# SPDX-License-Identifier: GPL-2.0-or-later
"""Colours of grains by a column of the dump or by how they lie, and the colour bars that explain them."""

from dataclasses import dataclass

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch
import numpy as np

from grainscope.errors import InputError
from grainscope.render.camera import AXES

GREY = (0.75, 0.75, 0.75, 1.0)
MOST_KINDS = 10  # different whole numbers that have colours of their own
STRIP = 0.085  # height of the colour bars below the picture, over its width


@dataclass
class Scale:
    """A colour map between two values, or colours of kinds, whole numbers; and what is written beside it."""

    label: str
    colormap: matplotlib.colors.Colormap
    low: float = 0.0
    high: float = 1.0
    kinds: tuple = ()
    ticks: tuple = ()  # in degrees

    def __post_init__(self):
        self.colormap(0.0)  # makes its table, which the threads of a film must not do side by side

    def colours(self, values):
        """(N,4); grey where a value is not finite."""
        if self.kinds:
            found = self.colormap(np.searchsorted(self.kinds, values))
        else:
            found = self.colormap(np.clip((values - self.low) / (self.high - self.low), 0.0, 1.0))
        return np.where(np.isfinite(values)[:, None], found, GREY)


def angles(grains, axis):
    """Angle [degrees], 0 to 90, between an axis and the long axis of prolate grains, the flat plane of oblate ones; nan
    of spheres."""
    sizes = np.sort(grains.semi_axes, axis=1)
    oblate = sizes[:, 1] - sizes[:, 0] > sizes[:, 2] - sizes[:, 1]
    body = np.where(oblate, np.argmin(grains.semi_axes, axis=1), np.argmax(grains.semi_axes, axis=1))
    along = grains.rotations[:, AXES.index(axis), :]
    cosine = np.abs(np.take_along_axis(along, body[:, None], axis=1)[:, 0])
    angle = np.degrees(np.arccos(np.clip(cosine, 0.0, 1.0)))
    return np.where(grains.are_spheres, np.nan, np.where(oblate, 90.0 - angle, angle))


def values_of(grains, name, axis):
    """What grains are coloured by: `alignment` with an axis, a column, or the length of the vector that three columns
    NAMEx NAMEy NAMEz are."""
    if name == "alignment":
        return angles(grains, axis)
    snapshot = grains.snapshot
    parts = [name + axis for axis in AXES]
    if name not in snapshot and all(part in snapshot for part in parts):
        return np.linalg.norm(snapshot.vectors(*parts), axis=1)[grains.rows]
    values = snapshot[name][grains.rows]
    if values.dtype.kind not in "fiu":
        raise InputError(f"--colour must be a column of numbers, got '{name}' with '{values[0]}'")
    return values


def scale_of(values, name, axis="x", limits=None, colormap=None, label=None):
    """The scale for values of grains; None where there is nothing to tell apart: the alignment of spheres."""
    values = values[np.isfinite(values)]
    if name == "alignment":
        low, high = limits or (0.0, 90.0)
        ticks = () if limits else (0, 30, 60, 90)
        chosen = matplotlib.colormaps[colormap or "viridis_r"]
        return Scale(label or f"angle to {axis}", chosen, low, high, ticks=ticks) if values.size else None
    kinds = np.unique(values)
    if limits is None and 0 < len(kinds) <= MOST_KINDS and np.all(kinds == np.round(kinds)):
        chosen = matplotlib.colormaps[colormap or "tab10"]
        colours = chosen(np.arange(len(kinds)) if colormap is None else np.linspace(0.0, 1.0, len(kinds)))
        return Scale(label or name, matplotlib.colors.ListedColormap(colours), kinds=tuple(kinds))
    low, high = limits or (values.min(initial=np.inf), values.max(initial=-np.inf))
    if not low < high:
        low, high = (low - 0.5 * abs(low or 1.0), low + 0.5 * abs(low or 1.0)) if low == high else (0.0, 1.0)
    return Scale(label or name, matplotlib.colormaps[colormap or "viridis"], low, high)


def decisive(values):
    """Those of the values of a snapshot that the scale of all snapshots depends on."""
    kinds = np.unique(values[np.isfinite(values)])
    return kinds if len(kinds) <= MOST_KINDS else np.append(kinds[:MOST_KINDS], kinds[-1])


def strip_height(width):
    return max(1, round(STRIP * width))


def strip(scales, width, note=""):
    """Colour bars side by side, and a note at the right, as rows of pixels; nothing when there is nothing to say."""
    if not scales and not note:
        return np.empty((0, width, 3))
    height = strip_height(width)
    figure = Figure(figsize=(width / 100.0, height / 100.0), dpi=100)
    canvas = FigureCanvasAgg(figure)
    size = 0.013 * width
    for k, scale in enumerate(scales):
        left = 0.05 + 0.36 * k
        if scale.kinds:
            patches = [
                Patch(color=colour, label=f"{kind:g}")
                for kind, colour in zip(scale.kinds, scale.colours(np.array(scale.kinds)))
            ]
            figure.legend(
                handles=patches,
                title=scale.label,
                loc="center left",
                bbox_to_anchor=(left - 0.02, 0.5),
                ncol=len(patches) if len(scales) == 1 else (len(patches) + 1) // 2,
                frameon=False,
                fontsize=size,
                title_fontsize=size,
                handlelength=1.0,
                columnspacing=1.0,
            )
            continue
        axes = figure.add_axes([left, 0.70, 0.25, 0.20])
        mappable = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(scale.low, scale.high), scale.colormap)
        bar = figure.colorbar(mappable, cax=axes, orientation="horizontal", ticks=list(scale.ticks) or None)
        if scale.ticks:
            bar.ax.set_xticklabels([f"{tick:g}°" for tick in scale.ticks])
        else:
            bar.ax.locator_params(nbins=5)
        bar.outline.set_visible(False)
        bar.ax.tick_params(length=0, labelsize=size)
        bar.ax.xaxis.get_offset_text().set_fontsize(size)
        bar.set_label(scale.label, fontsize=size)
    figure.text(0.97, 0.5, note, ha="right", va="center", fontsize=size)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3] / 255.0
