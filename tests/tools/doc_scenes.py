# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks in which the snippets of the pages `How do I measure` run: each holds what its questions ask about. A snippet
names its scene in the comment above it, `<!-- run: shear -->`."""
from dataclasses import dataclass, replace
import math
import os
from pathlib import Path

import numpy as np

from cases import clumps
from deck import Deck, Material
from packing import Grain, Packing, dense_packing, disc_packing
from plates import bed, plated

GRAVITY = "fix gravity all gravity 9.81 vector 0 0 -1"
RADIUS = 6.0  # of the drum
TYPES = Material(friction=(0.4, 0.3, 0.3, 0.2))


@dataclass
class Scene:
    """`start`: lines before a snippet. `steps` of the run behind it. `folder`: where its files are, if it has any."""

    start: list
    steps: int = 200
    folder: object = None


def sheared(packing, **choices):
    """Sheared along x, gradient y, at a pressure."""
    deck = Deck(packing, material=TYPES if packing.types > 1 else Material(), extra="ledger on", **choices)
    deck.body = [
        "variable rate equal 0.5",
        "fix press all press/strain y target 2e4 shear xy rate 0.5 every/step 10",
        "outputs press",
    ]
    return list(deck.lines())


def shear():
    """Rice-like grains of two types in a periodic box."""
    return Scene(sheared(dense_packing(1.5, types=2), surface="ellipsoid"))


def discs():
    return Scene(sheared(disc_packing()))


def of_clumps():
    """Clumps and single spheres that settle between two walls."""
    return Scene(list(clumps.start(walls=True)), 2000, clumps.folder())


def bedded():
    """A bed of spheres under gravity, on a floor and under the mesh `plate`."""
    deck = plated(bed(layers=5), extra="ledger on")
    return Scene([*deck.lines(), GRAVITY], 2000)


def drum():
    """A periodic drum about z, half full of rice-like grains, which turns; gravity along -y."""
    random, grains, spacing = np.random.default_rng(3), [], 2.1
    for k in range(2):
        for i in range(-3, 4):
            for j in range(-3, 1):
                x, y, z = spacing * i, spacing * j, 3.1 * (k + 0.5)
                if math.hypot(x, y) < RADIUS - 1.1:
                    grains.append(Grain((x, y, z), (1.0, 1.0, 1.5), velocity=tuple(random.normal(size=3))))
    edge = 2.0 * RADIUS + 1.0
    packing = Packing((edge, edge, 6.8), grains, origin=(-0.5 * edge, -0.5 * edge, 0.0), triclinic=False)
    deck = Deck(packing, boundary="f f p", surface="ellipsoid", extra="ledger on")
    wall = replace(deck, extra="").model()
    deck.body = [
        f"fix drum all wall/gran {wall} primitive type 1 zcylinder {RADIUS} 0 0 shear x 2.0",
        GRAVITY.replace("0 0 -1", "0 -1 0"),
    ]
    return Scene(list(deck.lines()), 3000)


def compression():
    """The example's own deck, up to its run."""
    deck = (Path(os.environ["GRAINSCOPE_SOURCE"]) / "examples/compression/in.compression").read_text()
    return Scene([line for line in deck.splitlines() if not line.startswith(("run ", "thermo "))], 9000)


SCENES = {"compression": compression, "shear": shear, "discs": discs, "clumps": of_clumps, "bed": bedded, "drum": drum}
