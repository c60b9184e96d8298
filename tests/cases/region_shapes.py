# SPDX-License-Identifier: GPL-2.0-or-later
"""Every shape of region that the host has, in a tilted box that shears: stress by the parts of branches inside, found
in numpy by asking for points alone; volumes, boxes that follow the grains, two dimensions, regions that are made anew
and moved between runs."""
from dataclasses import replace
import math
import os

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, thermo
from packing import dense_packing
from refusal import require_refused
from regions import FLOW, SHEARED, fractions, measured, slab, stress_of, turned
from run import run
from watch import Watched

POINTS = 400  # on each branch, between which its ends inside are found by halving
HALVINGS = 45
SUMS = 1e-11  # rounding of some hundred terms, and of ends inside to 1e-15 of a branch


def between(x, low, high):
    return (x >= low) & (x <= high)


def in_ball(x, centre, radius):
    return ((x - np.array(centre)) ** 2).sum(axis=1) <= radius**2


def in_round(x, axis, centre, low, high, radius_low, radius_high):
    across = [k for k in range(3) if k != axis]
    off = np.hypot(x[:, across[0]] - centre[0], x[:, across[1]] - centre[1])
    s = x[:, axis]
    radius = radius_low + (s - low) * (radius_high - radius_low) / (high - low)
    return between(s, low, high) & (off <= radius)


def in_prism(x):
    """prism 1 6 0.5 5.5 1 5 1.5 -0.8 1.1"""
    edges = np.array([[5.0, 1.5, -0.8], [0.0, 5.0, 1.1], [0.0, 0.0, 4.0]])
    s = np.linalg.solve(edges, (x - np.array([1.0, 0.5, 1.0])).T).T
    return between(s, 0.0, 1.0).all(axis=1)


def in_moved_block(x, step, dt):
    """block 1 4 1 4 1 4, turned about an axis by half a radian per 100 steps and shifted along x."""
    shift, pivot = np.array([0.01 * step, 0.0, 0.0]), np.array([2.0, 2.0, 2.0])
    back = (x - shift - pivot) @ turned(0.005 * step, (1.0, 1.0, 0.0)) + pivot
    return between(back, 1.0, 4.0).all(axis=1)


def in_plane(x):
    return (x - np.array([4.0, 3.0, 3.0])) @ np.array([1.0, 2.0, -1.0]) >= 0.0


# Of x, step and time step.
SHAPES = {
    "prism": ("prism 1 6 0.5 5.5 1 5 1.5 -0.8 1.1", lambda x, n, dt: in_prism(x)),
    "plane": ("plane 4 3 3 1 2 -1", lambda x, n, dt: in_plane(x)),
    "cone_x": ("cone x 2.9 2.7 2.2 0.7 1 6", lambda x, n, dt: in_round(x, 0, (2.9, 2.7), 1.0, 6.0, 2.2, 0.7)),
    "cone_y": ("cone y 3.1 2.7 0.0 2.5 0.5 5", lambda x, n, dt: in_round(x, 1, (3.1, 2.7), 0.5, 5.0, 0.0, 2.5)),
    "cone_z": (
        "cone z 3.1 2.6 2.4 0.0 0.5 5 side out",
        lambda x, n, dt: ~in_round(x, 2, (3.1, 2.6), 0.5, 5.0, 2.4, 0.0),
    ),
    "pipe": ("cylinder z 3 2.5 1.9 INF INF", lambda x, n, dt: in_round(x, 2, (3.0, 2.5), -1e20, 1e20, 1.9, 1.9)),
    "rod": ("cylinder x 3 2.5 1.9 1 7", lambda x, n, dt: in_round(x, 0, (3.0, 2.5), 1.0, 7.0, 1.9, 1.9)),
    "grows": ("sphere 3 2.8 2.7 v_radius", lambda x, n, dt: in_ball(x, (3.0, 2.8, 2.7), 1.0 + 0.01 * n)),
    "flies": ("block 1 4 1 4 1 4 move v_shift NULL NULL rotate v_angle 2 2 2 1 1 0", in_moved_block),
}
TOGETHER = {
    "any": (
        "union 3 prism flies cone_y",
        lambda x, n, dt: in_prism(x) | in_moved_block(x, n, dt) | SHAPES["cone_y"][1](x, n, dt),
    ),
    "all": ("intersect 2 flies cone_z", lambda x, n, dt: in_moved_block(x, n, dt) & SHAPES["cone_z"][1](x, n, dt)),
    "none": ("union 2 prism grows side out", lambda x, n, dt: ~(in_prism(x) | SHAPES["grows"][1](x, n, dt))),
}
VARIABLES = ["variable radius equal 1.0+0.01*step", "variable shift equal 0.01*step", "variable angle equal 0.005*step"]


def region_lines():
    return [f"region {name} {words} units box" for name, (words, _) in {**SHAPES, **TOGETHER}.items()]


def fill_memory():
    """What the host gives no value to, as half of the edges of its prisms, is 2261634.5 (glibc)."""
    os.environ["MALLOC_PERTURB_"] = str(0x41 ^ 0xFF)


def part_inside(has, first, last):
    """Of each line from first to last: has(t, lines) is true where the lines are inside; its changes are found by
    halving."""
    lines = np.repeat(np.arange(len(first)), POINTS + 1)
    t = first[:, None] + (last - first)[:, None] * np.linspace(0.0, 1.0, POINTS + 1)
    inside = has(t.ravel(), lines).reshape(t.shape)
    before, after = inside[:, :-1], inside[:, 1:]
    total = ((before & after) * np.diff(t)).sum(axis=1)
    changed, k = np.nonzero(before != after)
    leaves, low, high = before[changed, k], t[changed, k], t[changed, k + 1]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = has(middle, changed) == leaves
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    np.add.at(total, changed, np.where(leaves, low - t[changed, k], t[changed, k + 1] - high))
    return total


def shares(inside, moment, dt, start, end):
    """Of each line, over the images of the box, by points on it alone."""
    box, total = moment.force_box, np.zeros(len(start))
    fa, fb = fractions(start, box), fractions(end, box)
    for image in np.ndindex(3, 3, 3):
        shift = np.array(image) - 1.0
        sides = [slab(fa[:, k] - shift[k], fb[:, k] - shift[k], 0.0, 1.0) for k in range(3)]
        first = np.maximum(np.max([low for low, _ in sides], axis=0), 0.0)
        last = np.minimum(np.min([high for _, high in sides], axis=0), 1.0)
        here = first < last
        origin, along = (start - box.edges @ shift)[here], (end - start)[here]

        def has(t, lines, origin=origin, along=along):
            return inside(origin[lines] + t[:, None] * along[lines], moment.step, dt)

        total[here] += part_inside(has, first[here], last[here])
    return total


def shapes(ranks):
    fill_memory()
    deck = replace(SHEARED, body=[*VARIABLES, *region_lines()])
    computes = [stress_of(name, "volume 1.0") for name in [*SHAPES, *TOGETHER]]
    moments = measured(deck, computes, ranks, FLOW, 30)
    for moment in moments[::2]:
        rows, grains = moment.rows, moment.grains
        ends = grains.x[grains.index(rows["id"][:, 0])]
        size = np.abs(rows["force"]).max() * len(rows["fn"])
        for name, (_, inside) in {**SHAPES, **TOGETHER}.items():
            part = shares(inside, moment, deck.dt(), ends - rows["branch"], ends)
            require(0.005 < part.mean() < 0.995, f"{name} has {part.mean()} of the branches")
            expected = -np.einsum("c,ca,cb->ab", part, rows["force"], rows["branch"])
            found = moment.vector(stress_of(name))
            seven = [*expected[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]], expected[1, 0]]
            require_close(found[:7], seven, SUMS, f"stress in {name}, step {moment.step}", size)
            f = fractions(rows["point"], moment.force_box)
            x = moment.force_box.origin + (moment.force_box.edges @ (f - np.floor(f)).T).T
            require_equal(found[29], inside(x, moment.step, deck.dt()).sum(), f"contacts in {name}")


def volumes(deck, lines, expected, ranks, flow=FLOW):
    """Omega of each region is the pressure per volume 1 over the pressure."""
    deck = replace(deck, body=[*VARIABLES, *lines])
    own = [Watched(f"own_{name}", f"stress/contact region {name}", True, 36) for name in expected]
    unit = [Watched(f"unit_{name}", f"stress/contact volume 1 region {name}", True, 36) for name in expected]
    for moment in measured(deck, [*own, *unit], ranks, flow):
        for o, u, (name, volume) in zip(own, unit, expected.items()):
            value = volume(moment) if callable(volume) else volume
            require_close(moment.vector(u)[0] / moment.vector(o)[0], value, 1e-11, f"volume of {name}")


def closed_forms(ranks):
    fill_memory()
    cone = math.pi / 3.0 * 4.5 * 2.4**2
    expected = {
        "cone_z": lambda m: m.force_box.volume - cone,
        "grows": lambda m: 4.0 / 3.0 * math.pi * (1.0 + 0.01 * m.step) ** 3,
        "prism": 5.0 * 5.0 * 4.0,
        "flies": 27.0,
    }
    packing = dense_packing()
    place = 0.5 * np.array(packing.edges) - np.array([3.5, 3.0, 3.0])  # in the middle of the box
    moved = replace(packing, origin=tuple(-place))
    for grain in moved.grains:
        grain.position = tuple(np.array(grain.position) - place)
    volumes(Deck(moved), region_lines(), expected, ranks)


def faces_that_follow(ranks):
    """A region with bounds of its own is as large as they say, wherever the face between outermost centres is."""
    packing = dense_packing()
    deck = Deck(packing, boundary="p p s")
    lx, ly, _ = packing.edges
    lines = [
        "region bed block INF INF INF INF -2 4 units box",
        "region open block INF INF INF INF 1 INF units box",
        f"region ball sphere {0.5 * lx} {0.5 * ly} 0.0 2.0 units box",
    ]
    volumes(deck, lines, {"bed": lx * ly * 6.0, "ball": 4.0 / 3.0 * math.pi * 8.0}, ranks, flow=FLOW)
    open_one = replace(deck, body=[*lines, "compute s all stress/contact region open", "run 0"])
    require_refused(open_one, ranks, "it has no end where the box is shrink-wrapped")


FLAT = """dimension 2
atom_style sphere
atom_modify map array
newton off
communicate single vel yes
boundary p p p
region box block 0 15.92 0 15.92 -10 10 units box
create_box 1 box
lattice sq 1.99
region layer block INF INF INF INF -0.1 0.1 units box
create_atoms 1 region layer
set group all diameter 2
set group all density 1000
variable vx atom sin(id*12.9898)
variable vy atom sin(id*78.233)
velocity all set v_vx v_vy NULL units box
neighbor 0.3 bin
neigh_modify delay 0 contact_distance_factor 1.05
"""


def flat_deck(*body):
    material = Deck(dense_packing(), timestep=1e-3).material
    lines = [
        *material.lines(1),
        "pair_style gran/insitu model hertz tangential history",
        "pair_coeff * *",
        "timestep 1e-4",
        "fix move all nve/sphere",
        "fix two all enforce2d",
        *body,
    ]
    return FLAT + "\n".join(lines) + "\n"


def two_dimensions(ranks):
    """Of regions without thickness, those that end at the plane of the grains, and thick ones."""
    columns = []
    lines = ["compute whole all stress/contact volume 1.0"]
    thick = {"thin": "0 0", "below": "-1 0", "above": "0 1", "thick": "-0.5 0.5"}
    for name, ends in thick.items():
        for side, bounds in (("left", "0 6.3"), ("right", "6.3 15.92")):
            lines.append(f"region {name}_{side} block {bounds} INF INF {ends} units box")
            lines.append(f"compute {name}_{side} all stress/contact region {name}_{side}")
            columns += [f"c_{name}_{side}[1]"]
    output = ["thermo 10", f"thermo_style custom step c_whole[1] {' '.join(columns)}"]
    output += ["thermo_modify format float %.17g norm no", "run 40"]
    table = run(flat_deck(*lines, *output), ranks).thermo()[-1]
    whole = table["c_whole[1]"]
    require(bool((np.abs(whole) > 0.0).all()), f"stress {whole}")
    for name in thick:
        found = table[f"c_{name}_left[1]"] * 6.3 * 15.92 + table[f"c_{name}_right[1]"] * (15.92 - 6.3) * 15.92
        require_close(found, whole, 1e-12, f"sum of the stresses, {name}", np.abs(whole).max())


def between_runs(ranks):
    """What a variable, a region or its ID are when a run begins is what counts."""
    packing = dense_packing(minimum=30)
    lines = [
        "variable place equal 0.0",
        "region here block 0 2 INF INF INF INF move v_place NULL NULL units box",
        "region both intersect 2 here here",
        "region direct block 1.5 3.5 INF INF INF INF units box",
        "compute here all stress/contact region here",
        "compute both all stress/contact region both",
        "compute direct all stress/contact region direct",
        *thermo(1, "c_here[1]", "c_both[1]", "c_direct[1]"),
        "run 0",
        "variable place equal 1.5",
        "run 0",
        "region both delete",
        "region here delete",
        "region here block 1.5 3.5 INF INF INF INF units box",
        "region both intersect 2 direct here",
        "run 0",
    ]
    tables = run(Deck(packing, body=lines), ranks).thermo()
    direct = tables[0]["c_direct[1]"][0]
    require(tables[0]["c_here[1]"][0] != direct, "the region has not moved")
    for table in tables[1:]:
        for name in ("here", "both"):
            require_close(table[f"c_{name}[1]"][0], direct, 1e-12, f"stress in {name}")


def half_infinite_prism(ranks):
    lines = ["region p prism INF 3 0 5 0 5 0 0 1 units box", "region u union 2 p box units box"]
    for name in ("p", "u"):
        for style in ("fabric", "stress/contact volume 1.0", "contact/grain"):
            deck = Deck(dense_packing(minimum=30), body=[*lines, f"compute c all {style} region {name}", "run 0"])
            require_refused(
                deck, ranks, "region 'p': LIGGGHTS ignores the bound of a prism that is INF on the other side"
            )


CASES = {
    "shapes": shapes,
    "closed-forms": closed_forms,
    "faces-that-follow": faces_that_follow,
    "two-dimensions": two_dimensions,
    "between-runs": between_runs,
    "half-infinite-prism": half_infinite_prism,
}

if __name__ == "__main__":
    main(CASES)
