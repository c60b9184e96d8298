# SPDX-License-Identifier: GPL-2.0-or-later
"""fabric, contact/surface, contact/direction and contact/grain where the answer is known by hand."""
import itertools
import math

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, Material
from oracle.surface import areas, spheroid_area
from packing import Grain, Packing, dense_packing
from watch import Watched, deforming, watch

# Exact numbers, reached through square roots and one eigenvalue problem.
ROUNDING = 1e-13
FABRIC = Watched("fabric", "fabric", True, 22)


def ask(packing, *computes, ranks=1, **choices):
    return watch(Deck(packing, **choices), computes, ranks=ranks, steps=0, contacts=False)[0]


def simple_cubic(count=4, spacing=1.9375):
    """Spheres of radius 1; the spacing is exact in binary, so that normals are exactly along the axes."""
    grains = [Grain(tuple(spacing * (np.array(c) + 0.5))) for c in itertools.product(range(count), repeat=3)]
    return Packing((count * spacing,) * 3, grains, atom_style="sphere")


def cubic_lattice(ranks):
    direction = Watched("direction", "contact/direction bins 36", array=(36, 9))
    grain = Watched("grain", "contact/grain", peratom=7)
    packing = simple_cubic()
    moment = ask(packing, FABRIC, direction, grain, ranks=ranks)
    vector, count = moment.vector(FABRIC), len(packing.grains)
    require_close(vector[:6], [1 / 3, 1 / 3, 1 / 3, 0, 0, 0], ROUNDING, "F")
    require_close(vector[6:9], np.full(3, 1 / 3), ROUNDING, "eigenvalues")
    require_equal(vector[9:18], np.eye(3).ravel(), "eigenvectors")
    require_close(vector[[18, 20, 21]], [0.0, 1.0, 3 * count], ROUNDING, "deviator, ratio, contacts", 1.0)
    table = moment.array(direction)
    peaks = np.zeros(36)
    peaks[[0, 9, 18, 27]] = count
    require_equal(table[:, 1], peaks, "contacts by direction: those along z are left out")
    require_close(table[:, 2], peaks / (4 * count) / (2 * math.pi / 36), ROUNDING, "density")
    force = table[0, 3]
    require_close(table[:, 3], np.where(peaks > 0, force, 0.0), ROUNDING, "F_n by direction")
    require_equal(moment.peratom(grain)[:, :2], np.tile([6.0, 0.0], (count, 1)), "contacts of each grain")


def pairs_along(*normals):
    """Pairs of touching spheres, apart from each other, their normals along the given directions."""
    grains = []
    for k, n in enumerate(normals):
        half = 0.98 * np.array(n, dtype=float) / np.linalg.norm(n)
        middle = np.array([8.0 * k + 4.0, 4.0, 4.0])
        grains += [Grain(tuple(middle - half)), Grain(tuple(middle + half))]
    return Packing((8.0 * max(len(normals), 2), 8.0, 8.0), grains, atom_style="sphere")


X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
PLACES = {
    "f": slice(0, 6),
    "eigenvalues": slice(6, 9),
    "vectors": slice(9, 18),
    "deviator": slice(18, 19),
    "angle": slice(19, 20),
    "ratio": slice(20, 21),
    "contacts": slice(21, 22),
}


def fabric(normals, plane="xy", **parts):
    """`parts`: entries of PLACES."""

    def case(ranks):
        watched = Watched("fabric", f"fabric plane {plane}", True, 22)
        vector = ask(pairs_along(*normals), watched, ranks=ranks).vector(watched)
        for name, value in parts.items():
            require_close(vector[PLACES[name]], np.ravel(value).astype(float), 1e-12, name, 1.0)

    return case


def at_degrees(angle):
    return (math.cos(math.radians(angle)), math.sin(math.radians(angle)), 0.0)


def area(shape, angle, axis="auto"):
    def case(ranks):
        watched = Watched("surface", f"contact/surface angle {angle} axis {axis} bins 10", vector=3, array=(10, 17))
        packing = Packing(
            (40.0,) * 3, [Grain((10.0, 10.0, 10.0), shape), Grain((30.0, 30.0, 30.0), tuple(2.0 * s for s in shape))]
        )
        moment = ask(packing, watched, ranks=ranks)
        # The second grain has four times the area of the first; the bins hold the mean.
        whole, found = 2.5 * spheroid_area(shape[0], shape[2]) if axis == "auto" else None, moment.array(watched)[:, 1]
        index = "xyz".index(axis) if axis != "auto" else 2
        expected = 2.5 * areas(shape, index, 10, angle, 8)
        require_close(found, expected, 1e-12, "areas")
        require_close(found.sum(), whole or expected.sum(), 1e-12, "sum of the areas")
        require_close(moment.vector(watched), [0.0, whole or expected.sum(), 2.0], 1e-12, "P, area, grains")

    return case


def quaternion_of(random):
    q = random.normal(size=4)
    return q / np.linalg.norm(q)


def rotated(q, v):
    w, u = q[0], np.array(q[1:])
    return v + 2.0 * np.cross(u, np.cross(u, v) + w * v)


def touching_at(psi, shape, angle, random):
    """Two equal spheroids of equal orientation, each the other's image in the point where they touch, at `psi` on
    both."""
    a, c = shape[0], shape[2]
    parametric = psi if angle == "parametric" else math.atan2(c * math.sin(psi), a * math.cos(psi))
    if angle == "polar":
        parametric = math.atan2(math.sin(psi) / a, math.cos(psi) / c)
    around = random.uniform(0.0, 2.0 * math.pi)
    point = np.array(
        [
            a * math.sin(parametric) * math.cos(around),
            a * math.sin(parametric) * math.sin(around),
            c * math.cos(parametric),
        ]
    )
    q = quaternion_of(random)
    half = 0.99 * rotated(q, point)
    return [(-half, q), (half, q)]


def every_bin(shape, angle, bins=10):
    """Bin j is hit by 1 + j % 3 pairs, in random orientations."""

    def case(ranks):
        random, grains = np.random.default_rng(3), []
        hits = [1 + j % 3 for j in range(bins)]
        for j, k in [(j, k) for j in range(bins) for k in range(hits[j])]:
            psi = (j + 0.2 + 0.3 * k) * 0.5 * math.pi / bins
            middle = np.array([9.0 * (len(grains) // 2) + 4.5, 9.0, 9.0])
            grains += [Grain(tuple(middle + x), shape, tuple(q)) for x, q in touching_at(psi, shape, angle, random)]
        watched = Watched("surface", f"contact/surface angle {angle} bins {bins}", vector=3, array=(bins, 17))
        table = ask(Packing((9.0 * len(grains) / 2, 18.0, 18.0), grains), watched, ranks=ranks).array(watched)
        require_equal(table[:, 2], 2.0 * np.array(hits), "contacts per bin")
        share = np.array(hits) / sum(hits)
        require_close(table[:, 3], share / table[:, 1], ROUNDING, "rho_s")
        require_close(table[:, 4] * table[:, 1] / table[:, 1].sum(), share, ROUNDING, "rho_s A_p: surface integral 1")

    return case


def pole_on_equator(ranks):
    """The pole of one grain (psi = 0: first bin) touches the equator of another (psi = pi/2: last bin)."""
    root = math.sqrt(0.5)
    shape = (1.0, 1.0, 2.0)
    grains = [Grain((10.0, 10.0, 10.0), shape), Grain((10.0, 10.0, 12.98), shape, (root, 0.0, root, 0.0))]
    watched = Watched("surface", "contact/surface", vector=3, array=(10, 17))
    table = ask(Packing((20.0,) * 3, grains), watched, ranks=ranks).array(watched)
    require_equal(table[:, 2], [1.0, *[0.0] * 8, 1.0], "contacts per bin")
    require_close(table[0, 5], table[-1, 5], 1e-12, "both see the same normal force")


def statistics_of_spheres(ranks):
    """Contacts of randomly turned spheres are anywhere on them: rho_s A_p is 1 in every bin, within the scatter of
    numbers."""
    random = np.random.default_rng(11)
    packing = dense_packing(1.0, minimum=1000)
    for grain in packing.grains:
        grain.quaternion = tuple(quaternion_of(random))
    watched = Watched("surface", "contact/surface bins 6", vector=3, array=(6, 17))
    table = ask(packing, watched, ranks=ranks).array(watched)
    expected = table[:, 2].sum() * table[:, 1] / table[:, 1].sum()
    require(table[:, 2].sum() > 10000, f"only {table[:, 2].sum()} contacts")
    # 12 contacts of a grain sit on one lattice, so that they are not independent: twice the scatter of independent
    # ones, five times.
    require(
        bool((np.abs(table[:, 2] - expected) < 10.0 * np.sqrt(expected)).all()),
        f"{table[:, 2]}, expected about {expected}",
    )


def opposite_bins(packing):
    """Each contact counts at beta and beta + pi: the two halves of the table are equal to the last bit."""

    def case(ranks):
        watched = Watched("direction", "contact/direction", array=(72, 9))
        moments = watch(Deck(packing), [watched], deforming(0.05), ranks, settle=100, contacts=False)
        for moment in moments:
            table = moment.array(watched)
            require(table[:, 1].sum() > 2 * len(packing.grains), "too few contacts")
            require_equal(table[:36, 1:], table[36:, 1:], "beta and beta + pi")
            # One for all contacts, but for those whose normal stands on the plane: none here.
            require_close(table[:, 2].sum() * 2 * math.pi / 72, 1.0, ROUNDING, "integral of the density")

    return case


def powers_add_up(packing, material=Material()):
    """Over bins, and over grains, to compute dissipation mode instantaneous."""

    def case(ranks):
        power = Watched("power", "dissipation mode instantaneous", True, 10)
        surface = Watched("surface", "contact/surface", vector=3, array=(10, 17))
        grain = Watched("grain", "contact/grain", peratom=7)
        computes = [power, grain, *([surface] if packing.atom_style == "superquadric" else [])]
        deck = Deck(packing, extra="tangential_damping off", material=material)
        for moment in watch(deck, computes, deforming(0.05), ranks, settle=100, contacts=False):
            expected, grains = moment.vector(power), moment.peratom(grain)
            scale = np.abs(expected[:2]).max()
            require_close(grains[:, 2:4].sum(axis=0), expected[:2], 1e-11, "P_n, P_t over grains", scale)
            require_equal(grains[:, :2].sum(axis=0), 2.0 * expected[3:5], "contacts, sliding contacts over grains")
            if surface in computes:
                table = moment.array(surface)
                require_close(table[:, 9:11].sum(axis=0), expected[:2], 1e-11, "P_n, P_t over bins", scale)
                require_equal(table[:, 2].sum(), 2.0 * expected[3], "contacts over bins")
                require_close(np.sum(table[:, 8] * table[:, 2]), 2.0 * expected[4], 1e-11, "sliding contacts over bins")

    return case


PROLATE, OBLATE, SPHERE = (1.0, 1.0, 3.0), (1.0, 1.0, 0.33), (1.0, 1.0, 1.0)
SHAPES = {"prolate": PROLATE, "oblate": OBLATE, "sphere": SPHERE}
CASES = {
    "cubic-lattice": cubic_lattice,
    # F = diag(1/4, 0, 3/4).
    "three-of-four-along-z": fabric(
        [Z, Z, Z, X],
        f=(0.25, 0, 0.75, 0, 0, 0),
        eigenvalues=(0.75, 0.25, 0),
        vectors=(Z, X, Y),
        ratio=3,
        angle=0,
        contacts=4,
        deviator=math.sqrt(1.5 * (25 + 1 + 16) / 144),
    ),
    "three-of-four-along-z-in-xz": fabric([Z, Z, Z, X], "xz", angle=math.pi / 2),
    # Equal eigenvalues: x is the lab axis least along z, y the third.
    "two-of-four-along-z": fabric([Z, Z, X, Y], eigenvalues=(0.5, 0.25, 0.25), vectors=(Z, X, Y), ratio=2, angle=0),
    "one-of-four-less-along-x": fabric([Y, Y, Z, Z, X], eigenvalues=(0.4, 0.4, 0.2), vectors=(Y, Z, X), ratio=1),
    # One direction only: nothing to divide by, the ratio is 0.
    "all-along-one": fabric(
        [at_degrees(30)] * 2,
        eigenvalues=(1, 0, 0),
        angle=math.radians(30),
        deviator=1,
        ratio=0,
        vectors=(at_degrees(30), Z, (-0.5, math.sqrt(0.75), 0)),
    ),
    "angle-is-of-lines": fabric([at_degrees(100)], angle=math.radians(-80), contacts=1),
    **{
        f"area-of-{name}-{angle}": area(shape, angle)
        for name, shape in SHAPES.items()
        for angle in ("polar", "parametric")
    },
    "area-about-another-axis": area((1.0, 1.5, 2.5), "polar", "y"),
    "area-about-another-axis-parametric": area((1.0, 1.5, 2.5), "parametric", "x"),
    **{
        f"every-bin-{name}-{angle}": every_bin(SHAPES[name], angle)
        for name in ("prolate", "oblate")
        for angle in ("polar", "parametric")
    },
    "pole-on-equator": pole_on_equator,
    "statistics-of-spheres": statistics_of_spheres,
    "opposite-bins": opposite_bins(dense_packing(atom_style="sphere")),
    "opposite-bins-of-spheroids": opposite_bins(dense_packing(1.5)),
    "powers-add-up": powers_add_up(dense_packing(1.5)),
    "powers-of-spheres-add-up": powers_add_up(dense_packing(atom_style="sphere"), Material(friction=(0.1,))),
}

if __name__ == "__main__":
    main(CASES)
