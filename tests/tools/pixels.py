# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of grainscope-tools render, looked at pixel by pixel. They are drawn without light, so that a grain is a
spot of one colour: that of its type."""
import matplotlib.image
import numpy as np
import scipy.ndimage

from case import require
from dump_files import new_folder, snapshot, tool

KINDS = [  # matplotlib's tab10, as it is published
    (31, 119, 180),
    (255, 127, 14),
    (44, 160, 44),
    (214, 39, 40),
    (148, 103, 189),
    (140, 86, 75),
    (227, 119, 194),
    (127, 127, 127),
    (188, 189, 34),
    (23, 190, 207),
]
SIZE = (240, 200)
STRIP = 0.085  # height of the colour bars over the width


def spheres(places, radii, **more):
    """Columns of a dump of spheres, each of a type of its own."""
    x, y, z = np.transpose(places)
    number = list(range(1, len(x) + 1))
    columns = {"id": number, "type": number, "x": x, "y": y, "z": z, "radius": np.broadcast_to(radii, len(x))}
    return columns | more


def drawn(columns, *words, size=SIZE, light="none", folder=None, strip=False, **box):
    """The picture of a dump of these columns (height, width, 3), from 0 to 255, in a box that is not periodic; with or
    without the strip of colour bars below it."""
    folder = folder or new_folder()
    (folder / "grains.dump").write_text(snapshot(5, columns, **({"sides": "ff ff ff"} | box)))
    words = ["grains.dump", "--size", *size, "--light", light, "--jobs", 1, "--output", "picture.png", *words]
    code, messages = tool("render", *words, folder=folder)
    require(code == 0, f"render {words}: {messages}")
    picture = read(folder / "picture.png")
    require(picture.shape == (size[1], size[0], 3), f"a picture of {picture.shape}")
    return picture if strip else picture[: -round(STRIP * size[0])]


def read(path):
    return np.round(255.0 * matplotlib.image.imread(path)[..., :3]).astype(int)


def spot(picture, colour, tolerance=3):
    """Which pixels have a colour."""
    return np.all(np.abs(picture - np.array(colour)) <= tolerance, axis=-1)


def linear(values):
    """Light of sRGB values from 0 to 255, in which a pixel at an edge is a mean."""
    values = np.asarray(values) / 255.0
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def cover(picture, colour):
    """How much of each pixel an object of this colour covers, before a white ground and with nothing else beside it."""
    near = scipy.ndimage.binary_dilation(spot(picture, colour), np.ones((3, 3)))
    missing = 1.0 - linear(colour)
    return np.where(near, np.clip((1.0 - linear(picture)) @ missing / (missing @ missing), 0.0, 1.0), 0.0)


def middle(weights):
    """Centre of gravity (from the left, from the top) in pixels."""
    require(weights.sum() > 0, "nothing of this colour is in the picture")
    rows, columns = np.indices(weights.shape) + 0.5
    return np.array([(weights * columns).sum(), (weights * rows).sum()]) / weights.sum()


def moments(weights):
    """Area, and second moments about the centre of gravity over the area."""
    rows, columns = np.indices(weights.shape) + 0.5
    away = np.stack([columns, rows], axis=-1) - middle(weights)
    return weights.sum(), np.einsum("ij,ija,ijb->ab", weights, away, away) / weights.sum()
