# SPDX-License-Identifier: GPL-2.0-or-later
"""compute nematic on axes whose order is known exactly; definitions in doc/compute_nematic.md."""
import math

import numpy as np

from case import main, require_close
from deck import Deck, thermo
from grainscope.columns import outputs
from packing import Grain, Packing
from run import run

C_N = outputs("nematic").of("n")

ROOT = math.sqrt(0.5)
ALONG_Z, ALONG_X, ALONG_Y = (1, 0, 0, 0), (ROOT, 0, ROOT, 0), (ROOT, -ROOT, 0, 0)
PROLATE, OBLATE, SPHERE = (1.0, 1.0, 2.0), (1.0, 1.0, 0.5), (1.0, 1.0, 1.0)


def turned(angle, shape=PROLATE):
    """Symmetry axis in the xy plane at `angle` degrees from x: z turned to x about y, then about z by the angle."""
    half = math.radians(angle) / 2
    c, s = math.cos(half), math.sin(half)
    return shape, (c * ROOT, -s * ROOT, c * ROOT, s * ROOT)


def order(grains, ranks, omega=(0.0, 0.0, 0.0)):
    placed = [
        Grain((5.0 * k + 2.5, 5.0, 5.0), shape, quaternion, omega=omega) for k, (shape, quaternion) in enumerate(grains)
    ]
    packing = Packing((max(5.0 * len(placed), 10.0), 10.0, 10.0), placed)
    vector = C_N.vector()
    deck = Deck(packing, body=["compute n all nematic", *thermo(1, "c_n", *vector), "run 0"])
    table = run(deck, ranks).thermo()[0]
    return table["c_n"][0], np.array([table[q][0] for q in vector])


def expect(grains, s2, **parts):
    """`parts`: theta, biaxiality, q, director, counts; degrees for theta."""
    places = {
        "q": slice(0, 6),
        "director": slice(6, 9),
        "biaxiality": slice(9, 10),
        "theta": slice(10, 11),
        "director_theta": slice(11, 12),
        "spin": slice(12, 15),
        "counts": slice(15, 17),
        "eigenvalues": slice(17, 20),
    }

    def case(ranks):
        found_s2, vector = order(grains, ranks, parts.get("spin", (0.0, 0.0, 0.0)))
        # Exact numbers, reached through square roots and one eigenvalue problem.
        require_close([found_s2], [s2], 1e-14, "S2", 1.0)
        for name, value in parts.items():
            value = np.radians(value) if "theta" in name else value
            require_close(vector[places[name]], np.atleast_1d(value), 1e-13, name, 1.0)

    return case


P = [(PROLATE, q) for q in (ALONG_X, ALONG_Y, ALONG_Z)]
THIRD = 1.0 / 3.0
CASES = {
    # Q = diag(1/4, 1/4, 1/2) - 1/3: S2 = 3/2 (1/2 - 1/3).
    "two-of-four-along-z": expect(
        [P[2], P[2], P[0], P[1]],
        0.25,
        q=(0.25 - THIRD, 0.25 - THIRD, 0.5 - THIRD, 0, 0, 0),
        director=(0, 0, 1),
        biaxiality=0.0,
        counts=(4, 2),
    ),
    # Q = diag(1/4, 0, 3/4) - 1/3: S2 = 3/2 (3/4 - 1/3) = 5/8; middle less smallest 1/4.
    "three-of-four-along-z": expect(
        [P[2], P[2], P[2], P[0]],
        0.625,
        biaxiality=0.25,
        theta=0.0,
        counts=(4, 1),
        eigenvalues=(0.75 - THIRD, 0.25 - THIRD, -THIRD),
    ),
    "all-aligned": expect([P[0]] * 4, 1.0, director=(1, 0, 0), theta=0.0, director_theta=0.0),
    "isotropic": expect(P, 0.0, q=(0,) * 6),
    # Two axes at +-20 degrees about 10: mean angle 10, S2 = 3/2 (cos^2 20 - 1/3).
    "mean-angle": expect(
        [turned(30), turned(-10)], 1.5 * (math.cos(math.radians(20)) ** 2 - THIRD), theta=10.0, director_theta=10.0
    ),
    # A line, not an arrow: 80 and -80 degrees have mean 90, not 0.
    "mean-angle-is-of-lines": expect(
        [turned(80), turned(-80)], 1.5 * (math.cos(math.radians(10)) ** 2 - THIRD), theta=90.0
    ),
    # Oblate grains lie at right angles to their axis: axis at 90 + 15 degrees, major axis at 15.
    "oblate-angle": expect([turned(105, OBLATE)] * 2, 1.0, theta=15.0, director_theta=15.0),
    "spheres-have-no-order": expect(
        [(SPHERE, ALONG_Z)] * 3, 0.0, q=(0,) * 6, director=(0, 0, 0), theta=0.0, counts=(0, 0)
    ),
    "spheres-do-not-dilute": expect([P[2], (SPHERE, ALONG_Z)], 1.0, counts=(1, 0)),
    # Triaxial: the longest semi-axis, here the body's x, turned nowhere.
    "longest-of-three-axes": expect([((2.0, 1.5, 1.0), ALONG_Z)] * 2, 1.0, director=(1, 0, 0), theta=0.0),
    # The symmetry axis is found, not assumed: x here.
    "axis-along-body-x": expect([((2.0, 1.0, 1.0), ALONG_Z)] * 2, 1.0, director=(1, 0, 0)),
    "mean-spin": expect([P[0], P[1]], 0.25, spin=(0.0, 0.0, -0.25)),
}

if __name__ == "__main__":
    main(CASES)
