# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures in regions of the host: parts of a box add up to it, and what is in a region that moves and turns is found
again in numpy from dumps of grains and contacts. Definitions in doc/scope.md."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, dump_local, thermo
from grainscope.columns import outputs
from packing import dense_packing
from refusal import require_refused
from run import run
from wall_measures import BOX
from watch import Flow, Watched, deforming, moments_of, watched_deck

# Shares of lines are differences of numbers of order 1, sums have some hundred terms.
EXACT = 1e-12
CUTS = {"x": (None, 3.1, None), "y": (None, 4.4, None), "z": (None, 2.9, 5.3, None)}


def bound(value, infinite="INF"):
    return infinite if value is None else repr(value)


def pieces():
    """Names and bounds of blocks that divide space."""
    found = {}
    for i in range(2):
        for j in range(2):
            for k in range(3):
                sides = [CUTS["x"][i : i + 2], CUTS["y"][j : j + 2], CUTS["z"][k : k + 2]]
                found[f"piece{i}{j}{k}"] = sides
    return found


PIECES = pieces()


def regions_of(blocks):
    return [
        f"region {name} block " + " ".join(f"{bound(low)} {bound(high)}" for low, high in sides) + " units box"
        for name, sides in blocks.items()
    ]


def whole_line(name="whole"):
    return f"region {name} block INF INF INF INF INF INF units box"


def stress_of(region, more=""):
    name = "stress_" + (region or "all")
    return Watched(name, f"stress/contact {more}" + (f" region {region}" if region else ""), True, 36)


def counts_of(region):
    suffix = f" region {region}" if region else ""
    name = region or "all"
    return {
        "fabric": Watched(f"fabric_{name}", "fabric walls yes" + suffix, True, 22),
        "loss": Watched(f"loss_{name}", "dissipation mode step" + suffix, True, 10),
        "now": Watched(f"now_{name}", "dissipation mode instantaneous" + suffix, True, 10),
    }


def measured(deck, computes, ranks, flow=Flow(), settle=0):
    made = watched_deck(deck, computes, flow=flow, settle=settle)
    return list(moments_of(run(made, ranks)))


def partition_adds_up(deck, flow=Flow(), settle=0):
    def case(ranks):
        computes = [stress_of("", "volume 1.0"), *(stress_of(name, "volume 1.0") for name in PIECES)]
        for name in ["", *PIECES]:
            computes += counts_of(name).values()
        body = [*deck.body, *regions_of(PIECES)]
        moments = measured(replace(deck, body=body), computes, ranks, flow, settle)
        require(len(moments) == 5, f"{len(moments)} snapshots")
        for moment in moments:
            whole = moment.vector(computes[0])
            size = float(np.abs(moment.rows["force"]).max()) * len(moment.rows["fn"])
            found = sum(moment.vector(stress_of(name))[:19] for name in PIECES)
            require_close(found, whole[:19], EXACT, "sum of the stresses", size)
            for entry in (29, 35):
                numbers = sum(moment.vector(stress_of(name))[entry] for name in PIECES)
                require_equal(numbers, whole[entry], "sum of contacts")
            parts = [counts_of(name) for name in PIECES]
            total = counts_of("")
            for kind in ("loss", "now"):
                expected = moment.vector(total[kind])
                found = sum(moment.vector(part[kind]) for part in parts)
                require_close(found, expected, EXACT, f"sum of {kind}", np.abs(expected).max())
            found = sum(moment.vector(part["fabric"])[:6] * moment.vector(part["fabric"])[21] for part in parts)
            contacts = moment.vector(total["fabric"])[21]
            require_close(found, contacts * moment.vector(total["fabric"])[:6], EXACT, "fabric", contacts)

    return case


def volumes_add_up(ranks):
    """Omega of each piece is the pressure per volume 1 over the pressure: together they fill the tilted box."""
    deck = replace(SHEARED, body=[*regions_of(PIECES), whole_line()])
    names = [*PIECES, "whole"]
    own = [Watched(f"own_{name}", f"stress/contact region {name}", True, 36) for name in names]
    unit = [Watched(f"unit_{name}", f"stress/contact volume 1 region {name}", True, 36) for name in names]
    for moment in measured(deck, [stress_of(""), *own, *unit], ranks, FLOW, 30):
        box = moment.force_box.volume
        volumes = [moment.vector(u)[0] / moment.vector(o)[0] for o, u in zip(own, unit)]
        require_close(sum(volumes[:-1]), box, 1e-11, "sum of the volumes", box)
        found, expected = moment.vector(own[-1]), moment.vector(stress_of(""))
        require_close(found[:26], expected[:26], EXACT, "the region that is the box", np.abs(expected[:26]).max())
        require_equal(found[[29, 30, 35]], expected[[29, 30, 35]], "its contacts")


# In numpy, without the rules of src/CORE.


def turned(angle, axis):
    axis = np.array(axis) / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + math.sin(angle) * k + (1.0 - math.cos(angle)) * k @ k


def slab(a, b, low, high):
    """Where a + (b - a) t lies between low and high, as first and last t."""
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (low - a) / (b - a), (high - a) / (b - a)
    flat = a == b
    first = np.where(flat, np.where((a >= low) & (a < high), -np.inf, np.inf), np.minimum(one, other))
    last = np.where(flat, np.inf, np.maximum(one, other))
    return first, last


def in_block(low, high):
    def part(a, b):
        sides = [slab(a[:, k], b[:, k], low[k], high[k]) for k in range(3)]
        return np.max([s[0] for s in sides], axis=0), np.min([s[1] for s in sides], axis=0)

    def has(x):
        return ((x >= low) & (x <= high)).all(axis=1)

    return part, has


def in_ball(centre, radius):
    def part(a, b):
        d, f = b - a, a - centre
        aa, bb, cc = (d * d).sum(1), (d * f).sum(1), (f * f).sum(1) - radius**2
        root = np.sqrt(np.maximum(bb * bb - aa * cc, 0.0))
        empty = bb * bb <= aa * cc
        return np.where(empty, 1.0, (-bb - root) / aa), np.where(empty, 0.0, (-bb + root) / aa)

    def has(x):
        return ((x - centre) ** 2).sum(axis=1) <= radius**2

    return part, has


def in_pipe(centre, radius, low, high):
    """Along y."""

    def part(a, b):
        flat = np.array([1.0, 0.0, 1.0])
        first, last = in_ball(np.array([centre[0], 0.0, centre[1]]), radius)[0](a * flat, b * flat)
        start, end = slab(a[:, 1], b[:, 1], low, high)
        return np.maximum(first, start), np.minimum(last, end)

    def has(x):
        off = (x[:, 0] - centre[0]) ** 2 + (x[:, 2] - centre[1]) ** 2
        return (off <= radius**2) & (x[:, 1] >= low) & (x[:, 1] <= high)

    return part, has


LOW, HIGH = np.array([3.0, 3.2, 2.7]), np.array([7.0, 7.0, 5.3])
PIVOT, AXIS, RATE, SPEED = np.array([5.0, 5.0, 4.0]), (1.0, 2.0, -1.0), 0.9, np.array([5.0, -3.0, 2.0])
SHAPES = {
    "still": ("block 3.0 7.0 3.2 7.0 2.7 5.3", in_block(LOW, HIGH), 4.0 * 3.8 * 2.6, False),
    "moving": ("block 3.0 7.0 3.2 7.0 2.7 5.3", in_block(LOW, HIGH), 4.0 * 3.8 * 2.6, True),
    "ball": ("sphere 3.2 3.3 3.4 1.9", in_ball(np.array([3.2, 3.3, 3.4]), 1.9), 4 / 3 * math.pi * 1.9**3, False),
    "pipe": (
        "cylinder y 3.1 3.2 2.1 1.0 6.0",
        in_pipe((3.1, 3.2), 2.1, 1.0, 6.0),
        math.pi * 2.1**2 * 5.0,
        False,
    ),
    "outside": ("sphere 3.2 3.3 3.4 1.9 side out", in_ball(np.array([3.2, 3.3, 3.4]), 1.9), None, False),
}
MOTION = [
    f"variable moved_x equal {SPEED[0]}*step*dt",
    f"variable moved_y equal {SPEED[1]}*step*dt",
    f"variable moved_z equal {SPEED[2]}*step*dt",
    f"variable turned equal {RATE}*step*dt*100",
]


def region_line(name):
    words, _, _, moves = SHAPES[name]
    side = words.partition(" side ")
    motion = ""
    if moves:
        motion = " move v_moved_x v_moved_y v_moved_z rotate v_turned " + " ".join(map(str, (*PIVOT, *AXIS)))
    return f"region {name} {side[0]}{' side out' if side[1] else ''} units box{motion}"


def at_rest(name, step, dt):
    """Points now to where they were when the region had not moved."""
    if not SHAPES[name][3]:
        return lambda x: x
    turn, shift = turned(RATE * step * dt * 100, AXIS), SPEED * step * dt
    return lambda x: (x - shift - PIVOT) @ turn + PIVOT


def fractions(x, box):
    return np.linalg.solve(box.edges, (x - box.origin).T).T


def share(name, moment, dt, start, end):
    """Of lines, over all images of the periodic box."""
    part, back = SHAPES[name][1][0], at_rest(name, moment.step, dt)
    box = moment.force_box
    total = np.zeros(len(start))
    fa, fb = fractions(start, box), fractions(end, box)
    for image in np.ndindex(3, 3, 3):
        shift = np.array(image) - 1.0
        first, last = np.zeros(len(start)), np.ones(len(start))
        for k in range(3):
            enters, leaves = slab(fa[:, k] - shift[k], fb[:, k] - shift[k], 0.0, 1.0)
            first, last = np.maximum(first, enters), np.minimum(last, leaves)
        moved = box.edges @ shift
        enters, leaves = part(back(start - moved), back(end - moved))
        inner = np.maximum(np.minimum(last, leaves) - np.maximum(first, enters), 0.0)
        total += np.maximum(last - first, 0.0) - inner if name == "outside" else inner
    return total


def is_inside(name, moment, dt, x):
    box = moment.force_box
    f = fractions(x, box)
    wrapped = box.origin + (box.edges @ (f - np.floor(f)).T).T
    found = SHAPES[name][1][1](at_rest(name, moment.step, dt)(wrapped))
    return ~found if name == "outside" else found


def places(ranks):
    """Stress, contacts, kinetic part, order and losses of regions at rest and in motion."""
    names = list(SHAPES)
    packing = dense_packing(alpha=1.5)
    deck = Deck(packing, body=[*MOTION, *(region_line(name) for name in names)], surface="ellipsoid")
    order = {name: Watched(f"order_{name}", f"nematic region {name}", True, 20) for name in names}
    grain = {name: Watched(f"grain_{name}", f"contact/grain region {name}", peratom=7) for name in names}
    now = {name: counts_of(name)["now"] for name in names}
    computes = [stress_of(name) for name in names]
    computes += [*order.values(), *grain.values(), *now.values()]
    seen = {name: 0 for name in names}
    for moment in measured(deck, computes, ranks, settle=20):
        rows, grains, box = moment.rows, moment.grains, moment.force_box
        ends = grains.x[grains.index(rows["id"][:, 0])]
        for name in names:
            volume = SHAPES[name][2] or box.volume - SHAPES["ball"][2]
            shares = share(name, moment, deck.dt(), ends - rows["branch"], ends)
            expected = -np.einsum("c,ca,cb->ab", shares, rows["force"], rows["branch"]) / volume
            found = moment.vector(stress_of(name))
            seven = [*expected[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]], expected[1, 0]]
            size = np.abs(rows["force"]).max() * len(rows["fn"]) / volume
            require_close(found[:7], seven, 1e-11, f"stress in {name}", size)
            at = is_inside(name, moment, deck.dt(), rows["point"])
            require_equal(found[29], at.sum(), f"contacts in {name}")
            mine = is_inside(name, moment, deck.dt(), grains.x)
            require_close(found[30], 2.0 * at.sum() / mine.sum(), 1e-14, f"Z in {name}")
            v = grains.v[mine] - np.average(grains.v[mine], axis=0, weights=grains.mass[mine])
            kinetic = -np.einsum("i,ia,ib->ab", grains.mass[mine], v, v) / volume
            six = kinetic[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
            require_close(found[19:25], six, 1e-10, f"kinetic stress in {name}", np.abs(six).max())
            require_equal(moment.vector(order[name])[15], mine.sum(), f"grains in {name}")
            ids = rows["id"][at].astype(int)
            numbers = np.bincount(ids.ravel(), minlength=len(grains.x) + 1)[1:]
            require_equal(moment.peratom(grain[name])[:, 0], numbers, f"contacts per grain in {name}")
            require_equal(moment.vector(now[name])[3], at.sum(), f"contacts in the dissipation of {name}")
            seen[name] += at.sum()
    require(all(count > 20 for count in seen.values()), f"contacts seen {seen}")


def bins_and_rows(ranks):
    """Directions, places on the surface and rows: of a pair of types, in a region that moves, in one without grains."""
    packing = dense_packing(alpha=1.5, types=2)
    wide = replace(packing, edges=(*packing.edges[:2], 2.5 * packing.edges[2]))
    far = f"region far sphere 5.0 5.0 {1.75 * packing.edges[2]} 2.0 units box"
    deck = Deck(wide, body=[*MOTION, region_line("moving"), far], surface="ellipsoid")
    where = {"in_12": "region moving types 1 2", "in": "region moving", "of_2": "types 2 *", "far": "region far"}
    rose = {n: Watched(f"rose_{n}", f"contact/direction bins 12 {w}", array=(12, 9)) for n, w in where.items()}
    surface = {n: Watched(f"surface_{n}", f"contact/surface volume 1 {w}", True, 3, (10, 17)) for n, w in where.items()}
    surface = {n: replace(w, scalar=False) for n, w in surface.items()}
    for name, words in where.items():
        deck.body.append(f"compute rows_{name} all contact/local {words} id")
        deck.body += dump_local(f"rows_{name}", 2, 5, f"rows_{name}")
    result = run(watched_deck(deck, [*rose.values(), *surface.values()], settle=20), ranks)
    own = {name: dict(result.dump(f"rows_{name}.dump")) for name in where}
    seen = 0
    for moment in moments_of(result):
        rows, ids = moment.rows, moment.rows["id"].astype(int)
        types = 1 + (ids - 1) % 2
        inside = is_inside("moving", moment, deck.dt(), rows["point"])
        chosen = {
            "in_12": inside & (types[:, 0] != types[:, 1]),
            "in": inside,
            "of_2": (types == 2).any(axis=1),
            "far": np.zeros(len(ids), dtype=bool),
        }
        seen += chosen["in_12"].sum()
        for name, mine in chosen.items():
            require_equal(moment.array(rose[name])[:, 1].sum(), 2 * mine.sum(), f"{name}: directions")
            require_equal(moment.array(surface[name])[:, 2].sum(), 2 * mine.sum(), f"{name}: on surfaces")
            columns = list(own[name][moment.step].values()) if moment.step in own[name] else [[], []]
            found = sorted(tuple(sorted(map(int, pair))) for pair in zip(*columns))
            require_equal(found, sorted(tuple(sorted(pair)) for pair in ids[mine].tolist()), f"{name}: rows")
    require(seen > 40, f"{seen} contacts")


def nothing_there(ranks):
    """A region of the box without grains gives 0 everywhere."""
    packing = dense_packing(minimum=30)
    wide = replace(packing, edges=tuple(3.0 * e for e in packing.edges))
    place = [2.0 * e for e in packing.edges]
    deck = Deck(wide, body=[f"region far sphere {place[0]} {place[1]} {place[2]} 1.5 units box"])
    computes = [stress_of("far"), *counts_of("far").values(), Watched("order", "nematic region far", True, 20)]
    for moment in measured(deck, computes, ranks):
        for one in computes:
            require_equal(moment.vector(one), np.zeros(one.vector), one.command)


REFUSED = {
    "s": ("compute s all stress/contact region ball", "the volume of the region is not known (a face cuts the sphere)"),
    "u": ("compute s all stress/contact region both", "the volume of the region is not known (it is a union)"),
    "w": ("compute s all stress/contact region wedge", "region 'wedge': it must be a block, prism, plane"),
    "o": ("compute s all stress/contact region away", "no part of it lies in the box"),
    "l": ("compute s all dissipation mode ledger region ball", "'mode ledger' has no losses by types or of a region"),
}


def refused(ranks):
    lines = [
        "region ball sphere 0 0 0 2 units box",
        "region other sphere 3 3 3 1 units box",
        "region both union 2 ball other units box",
        "region wedge wedge axis z center 3 3 radius 2 bounds 0 5 angle0 0 angle 60 units box",
        "region away block 50 60 50 60 50 60 units box",
    ]
    for line, message in REFUSED.values():
        deck = Deck(dense_packing(minimum=30), body=[*lines, line, "run 0"])
        require_refused(deck, ranks, message)
    taken = ["compute f all fabric region wedge", "compute g all stress/contact region both volume 3.0"]
    run(Deck(dense_packing(minimum=30), body=[*lines, *taken, *thermo(1, "c_f", "c_g"), "run 1"]), ranks)
    gone = [lines[1], "compute f all fabric region other", "run 0", "region other delete", "run 0"]
    require_refused(Deck(dense_packing(minimum=30), body=gone), ranks, "'region' must be a region that is defined")


def without_set_up(ranks):
    """A region is known by its ID: one that takes it between runs is measured, also in a run that is not set up."""
    here, there = ("block 0.0 4.0 0.0 4.0 0.0 4.0 units box", "block 2.0 6.0 1.0 5.0 1.0 6.0 units box")
    measures = ("stress/contact", "fabric", "fluctuation")
    start = [f"region place {here}", f"region here {here}", f"region there {there}"]
    for k, measure in enumerate(measures):
        start += [f"compute {id_}{k} all {measure} region {id_}" for id_ in ("place", "here", "there")]
    asked = []
    for k, (measure, element) in enumerate(zip(measures, ("sxx", "N_c", "N_grains"))):
        asked += [outputs(measure).of(f"{id_}{k}")[element] for id_ in ("place", "here", "there")]
    start += [*thermo(5, *asked), "run 5"]
    other = ["region place delete", whole_line("between"), f"region place {there}"]
    result = run(Deck(dense_packing(), body=[*start, *other, "run 5 pre no", "run 0 pre no"]), ranks)
    first, *later = result.thermo()
    for k in range(3):
        names = asked[3 * k : 3 * k + 3]
        require_equal(first[names[0]], first[names[1]], "as it was made")
        require((first[names[1]] != first[names[2]]).all(), "places that differ")
        for table in later:
            require_equal(table[names[0]][-1:], table[names[2]][-1:], "another region of that ID")
    gone = [*start, "region place delete", "run 5 pre no"]
    require_refused(Deck(dense_packing(), body=gone), ranks, "'region' must be a region that is defined, got 'place'")
    wedge = "region place wedge axis z center 3 3 radius 2 bounds 0 5 angle0 0 angle 60 units box"
    bad = [*start, "region place delete", wedge, "run 5 pre no"]
    require_refused(Deck(dense_packing(), body=bad), ranks, "compute stress/contact", "region 'place'", "wedge")


FLOW = deforming(0.4)
SHEARED = Deck(dense_packing())
CASES = {
    "partition-of-a-sheared-box": partition_adds_up(SHEARED, FLOW, 40),
    "partition-between-walls": partition_adds_up(BOX.deck, settle=60),
    "volumes-add-up": volumes_add_up,
    "places": places,
    "nothing-there": nothing_there,
    "bins-and-rows": bins_and_rows,
    "without-set-up": without_set_up,
    "refused": refused,
}

if __name__ == "__main__":
    main(CASES)
