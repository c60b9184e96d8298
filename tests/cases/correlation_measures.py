# SPDX-License-Identifier: GPL-2.0-or-later
"""velocity/correlation against all pairs in the oracle, directly and on a mesh, and where C(r) is known."""
from dataclasses import replace
import itertools
import math

import numpy as np

from case import main, require, require_close
from deck import Deck, shear
from oracle import comparison_motion as comparison
from oracle import correlation
from packing import Grain, Packing, dense_packing, tilted
from run import run
from watch import Flow, Watched, deforming, pressed, watch

# Sums of thousands of terms of either sign, over the square root of their number.
EXACT = 1e-9
# Not a whole number of bins or mesh cells in any height: no lag of the mesh falls on the edge of a bin.
RANGE = 4.037
SPHERES = dense_packing(atom_style="sphere")
PLANES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


def correlation_of(name, words, bins=19):
    return Watched(name, f"velocity/correlation bins {bins} {words}", True, 5, (bins, 4))


def variants(plane):
    """Computes and what the oracle needs to know of each."""
    known = {
        "default": ("", {}),
        "vx": ("component vx flow fit", {"name": "vx", "flow": ("fit",)}),
        "wz": ("component wz flow layers 4", {"name": "wz", "flow": ("layers", 4)}),
        "near": (f"component vz flow rate 0.03 range {RANGE}", {"name": "vz", "flow": ("rate", 0.03), "reach": RANGE}),
        "far": ("range 6.53", {"reach": 6.53}),
        "mesh": (f"method mesh range {RANGE}", {"mesh": 4, "reach": RANGE}),
        "fine": (f"method mesh mesh 7 range {RANGE} component wx", {"mesh": 7, "reach": RANGE, "name": "wx"}),
    }
    bins = {"near": 7, "fine": 5, "mesh": 11}
    return {
        correlation_of(k, f"plane {plane} {words}", bins.get(k, 19)): {"bins": bins.get(k, 19), **options}
        for k, (words, options) in known.items()
    }


def agrees(deck, flow=Flow(), plane="xy", group="all", settle=50, check=None):
    def case(ranks):
        watched = variants(plane)
        moments = watch(
            deck, list(watched), flow, ranks, group, settle=settle, every=10, thermo_every=10, contacts=False
        )
        for moment, (one, options) in itertools.product(moments, watched.items()):
            vector = moment.vector(one)
            require_close(moment.scalar(one), vector[0], 0.0, "correlation scalar", 1.0)
            for c in comparison.of_correlation(vector, moment.array(one), moment, plane=PLANES[plane], **options):
                require_close(
                    c.found,
                    c.expected,
                    0.0 if c.counted else EXACT,
                    f"step {moment.step}, {one.name}, {c.name}",
                    c.scale,
                )
        if check:
            check(moments)

    return case


def flipped(moments):
    tilts = [m.box.edges[0, 1] for m in moments]
    require(tilts[0] > 0.0 > tilts[-1], f"no flip: the tilt went from {tilts[0]} to {tilts[-1]}")


def flipping(deck):
    """First off the lattice, which lies on the edges of cells."""
    lx, ly, _ = deck.packing.edges
    return agrees(deck, deforming(0.002 * lx / ly / (20 * deck.dt())), settle=5, check=flipped)


def running(ranks):
    """average running: numerators, pairs, squares and grains of all calls on different steps add up; r is the mean."""
    watched = correlation_of("all", "average running", 9)
    once = correlation_of("once", "", 9)
    deck = Deck(dense_packing(atom_style="sphere"))
    moments = watch(deck, [watched, once], pressed(0.05), ranks, settle=50, contacts=False, every=5, thermo_every=5)
    tables, vectors = [m.array(once) for m in moments], [m.vector(once) for m in moments]
    for k, moment in enumerate(moments, 1):
        numerator, pairs = sum(t[:, 2] for t in tables[:k]), sum(t[:, 3] for t in tables[:k])
        grains = sum(v[3] for v in vectors[:k])
        square = sum(v[2] * v[3] for v in vectors[:k]) / grains
        table, expected = correlation.correlation_table(
            sum(t[:, 0] for t in tables[:k]) / k, numerator, pairs, square, grains
        )
        for c in comparison.of_correlation_table(
            "running", moment.vector(watched), moment.array(watched), table, expected
        ):
            require_close(c.found, c.expected, 0.0 if c.counted else EXACT, f"step {moment.step}, {c.name}", c.scale)


def one_search(ranks):
    """Computes of several components, asked in one step: the pairs are found once for three of them, and again for
    those that differ in something else."""
    words = {f"all_{c}": (f"component {c}", {"name": c}) for c in ("vy", "wz", "vx", "wx")}
    words["near"] = (f"component vz range {RANGE}", {"name": "vz", "reach": RANGE})
    words["fitted"] = ("component vz flow fit", {"name": "vz", "flow": ("fit",)})
    watched = {correlation_of(name, text): options for name, (text, options) in words.items()}
    for moment in watch(
        Deck(SPHERES), list(watched), deforming(0.05), ranks, settle=20, every=10, thermo_every=10, contacts=False
    ):
        for one, options in watched.items():
            for c in comparison.of_correlation(moment.vector(one), moment.array(one), moment, **options):
                what = f"step {moment.step}, {one.name}, {c.name}"
                require_close(c.found, c.expected, 0.0 if c.counted else EXACT, what, c.scale)


def asked_beside(ranks):
    """Whatever is asked before it in the same step, a compute gives the same to the last bit: of the grains as they are
    then, though another fix changed their velocities in between."""
    answers = []
    for before in ((), ("vy", "wx"), ("vx",)):
        lines = [shear(0.05), "compute roll all velocity/correlation component vx"]
        for c in before:
            lines += [
                f"compute {c} all velocity/correlation component {c}",
                f"fix {c} all ave/time 5 1 5 c_{c}[2] mode vector file {c}.txt",
            ]
        lines += [
            "fix turn all momentum 10 linear 0 0 0 angular",
            "fix roll all ave/time 5 1 5 c_roll[1] c_roll[2] c_roll[3] c_roll[4] mode vector file roll.txt",
            "run 20",
        ]
        answers.append(run(replace(Deck(SPHERES), body=lines), ranks).file("roll.txt").read_text())
    require(answers[0].count("\n") > 60, f"20 steps gave\n{answers[0]}")
    for answer in answers[1:]:
        require(answer == answers[0], "what was asked before changed a correlation")


def not_periodic(ranks):
    """No images across faces that are none, also beyond half the box."""
    watched = correlation_of("open", "range 6.53")
    packing = Packing(SPHERES.edges, SPHERES.grains, atom_style="sphere", triclinic=False)
    moment = watch(Deck(packing, boundary="p f p"), [watched], ranks=ranks, steps=0, contacts=False)[0]
    for c in comparison.of_correlation(
        moment.vector(watched), moment.array(watched), moment, reach=6.53, periodic=(True, False, True)
    ):
        require_close(c.found, c.expected, 0.0 if c.counted else EXACT, c.name, c.scale)


def plane_wave(words):
    """v_y = cos(k x) on a cubic lattice, k a whole number of waves in the box: C at a lattice vector R is cos(k R_x),
    and a bin holds the mean of its vectors."""
    count, spacing, waves = 8, 3.0, 1
    length = count * spacing
    k = 2.0 * math.pi * waves / length

    def case(ranks):
        grains = [
            Grain(tuple(spacing * (np.array(c) + 0.5)), velocity=(0.0, math.cos(k * spacing * (c[0] + 0.5)), 0.0))
            for c in itertools.product(range(count), repeat=3)
        ]
        bins, reach = 13, 11.3
        watched = correlation_of("wave", f"range {reach} {words}", bins)
        moment = watch(
            Deck(Packing((length,) * 3, grains, atom_style="sphere")), [watched], ranks=ranks, steps=0, contacts=False
        )[0]
        steps = np.array([v for v in itertools.product(range(-count // 2, count // 2), repeat=3) if any(v)])
        r = spacing * np.linalg.norm(steps, axis=1)
        where = np.floor(r * bins / reach).astype(int)
        table = moment.array(watched)
        for j in range(bins):
            inside = (where == j) & ((j + 1) * reach / bins > 2.0)
            c = np.cos(k * spacing * steps[inside, 0]).mean() if inside.any() else 0.0
            require_close(table[j, 1], c, 1e-12, f"C in bin {j}", 1.0)
            require_close(table[j, 3], 0.5 * len(grains) * inside.sum(), 0.0, f"pairs in bin {j}", 1.0)
        require_close(moment.vector(watched)[2:4], [0.5, len(grains)], 1e-12, "<dv^2>, grains")

    return case


def decays(ranks):
    """Values with exp(-r/l) in the fitted bins give l: pairs far apart, one in each bin, products a_i b_i =
    exp(-r_i/l)."""
    length, bins, reach = 2.5, 6, 9.0
    grains = []
    for j in range(bins):
        r = (j + 0.5) * reach / bins
        speed = math.exp(-0.5 * r / length)
        for x in (0.0, r):
            for row, mirrored in ((0, 1.0), (1, -1.0)):  # the mean is zero
                grains.append(
                    Grain(
                        (5.0 + x, 30.0 * j + 10.0, 40.0 * row + 10.0), (0.4,) * 3, velocity=(0.0, mirrored * speed, 0.0)
                    )
                )
    watched = correlation_of("fit", f"range {reach}", bins)
    packing = Packing((60.0, 30.0 * bins, 80.0), grains, atom_style="sphere")
    moment = watch(Deck(packing), [watched], ranks=ranks, steps=0, contacts=False)[0]
    square = np.mean([g.velocity[1] ** 2 for g in grains])
    r = (np.arange(bins) + 0.5) * reach / bins
    table = moment.array(watched)
    require_close(table[:, 3], np.full(bins, 2.0), 0.0, "pairs per bin", 1.0)
    require_close(table[:, 1], np.exp(-r / length) / square, 1e-12, "C", 1.0)
    expected = correlation.decay(r, np.exp(-r / length) / square)
    require_close(moment.vector(watched)[[0, 1, 4]], expected, 1e-9, "l, its error, bins")


CASES = {
    "spheres": agrees(Deck(SPHERES), deforming(0.05)),
    "spheres-at-rest": agrees(Deck(SPHERES)),
    "polydisperse": agrees(
        Deck(dense_packing(atom_style="sphere", sizes=(0.8, 1.0, 1.2), overlap=0.1)), deforming(0.05)
    ),
    "spheroid-0.33": agrees(Deck(dense_packing(0.33)), deforming(0.05)),
    "spheroid-3": agrees(Deck(dense_packing(3.0)), deforming(0.05)),
    "through-a-flip": flipping(Deck(tilted(SPHERES, 0.4985))),
    "tilted-backward": agrees(Deck(tilted(SPHERES, -0.48)), deforming(-0.05)),
    "under-pressure-control": agrees(Deck(SPHERES), pressed(0.05)),
    "sheared-in-xz": agrees(Deck(SPHERES), deforming(0.05, (0, 2)), "xz"),
    "sheared-in-yz": agrees(Deck(SPHERES), deforming(0.05, (1, 2)), "yz"),
    "subgroup": agrees(Deck(SPHERES), deforming(0.05), group="20:80"),
    "group-of-one": agrees(Deck(SPHERES), deforming(0.05), group="20:20"),
    "running": running,
    "one-search": one_search,
    "asked-beside": asked_beside,
    "not-periodic": not_periodic,
    "plane-wave": plane_wave("method direct"),
    "plane-wave-on-a-mesh": plane_wave("method mesh"),
    "decays": decays,
}

if __name__ == "__main__":
    main(CASES)
