# SPDX-License-Identifier: GPL-2.0-or-later
"""What a measure is of: the keywords types, rows, walls, volume, plane, pressure and axis, against sums over the rows
of contacts in numpy. Definitions in doc/scope.md."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, thermo
from grainscope.columns import outputs
from packing import Grain, Packing
from run import run
from wall_measures import BOX, EXACT, Scene
from watch import Watched, moments_of, watched_deck

# Two types of grains between walls of type 2.
TYPES, PAIRS = 2, [(1, 1), (1, 2), (2, 2)]
CHOSEN = {"11": (1, 1), "12": (1, 2), "21": (2, 1), "2any": (2, None), "any": (None, None)}


def words(pair):
    return "types " + " ".join("*" if one is None else str(one) for one in pair)


def mixture():
    packing = replace(
        BOX.deck.packing,
        types=TYPES,
        grains=[replace(g, type=1 + k % TYPES) for k, g in enumerate(BOX.deck.packing.grains)],
    )
    body = [line.replace("primitive type 1", "primitive type 2") for line in BOX.deck.body]
    material = replace(BOX.deck.material, friction=(0.2, 0.4, 0.4, 0.6), restitution=(0.3, 0.5, 0.5, 0.7))
    return Scene(replace(BOX.deck, packing=packing, body=body, material=material), velocity=BOX.velocity, settle=60)


MIXTURE = mixture()
STRESS = Watched("stress", "stress/contact rows types", True, 36, (3, 12))
FABRIC = Watched("fabric", "fabric rows types walls yes", True, 22, (3, 9))
LOSS = {
    mode: Watched(f"loss_{mode}", f"dissipation mode {mode} rows types", True, 10, (3, 12))
    for mode in ("instantaneous", "step")
}
OF_TYPES = {name: Watched(f"stress{name}", f"stress/contact {words(pair)}", True, 36) for name, pair in CHOSEN.items()}
LOSS_OF = {name: Watched(f"loss{name}", f"dissipation {words(pair)}", True, 10) for name, pair in CHOSEN.items()}
GRAIN_OF = {name: Watched(f"grain{name}", f"contact/grain {words(pair)}", peratom=7) for name, pair in CHOSEN.items()}


def types_of(rows, grains):
    """(i, j) of every row; walls are of type 2."""
    ids = rows["id"]
    at_wall = ids[:, 1] == 0
    j = np.where(at_wall, ids[:, 0], ids[:, 1])
    types = 1 + (np.arange(len(grains.x)) % TYPES)  # by ID, as the packing was made
    return np.stack([types[grains.index(ids[:, 0])], np.where(at_wall, 2, types[grains.index(j)])], axis=1)


def of_pair(types, pair):
    def fits(a, b):
        return ((pair[0] is None) | (a == pair[0])) & ((pair[1] is None) | (b == pair[1]))

    return fits(types[:, 0], types[:, 1]) | fits(types[:, 1], types[:, 0])


def stress_of(rows, chosen, volume):
    return -np.einsum("ca,cb->ab", rows["force"][chosen], rows["branch"][chosen]) / volume


def seven(s):
    return np.array([s[0, 0], s[1, 1], s[2, 2], s[0, 1], s[0, 2], s[1, 2], s[1, 0]])


def moments(scene, computes, ranks, group="all"):
    return list(
        moments_of(run(watched_deck(scene.deck, computes, group=group, settle=scene.settle), ranks), group=group)
    )


def rows_by_types(ranks):
    """Rows are sums over the contacts of their pair, and add up to the total."""
    found = moments(MIXTURE, [STRESS, FABRIC, *LOSS.values()], ranks)
    require(len(found) == 5, "snapshots")
    for moment in found:
        rows, types = moment.rows, types_of(moment.rows, moment.grains)
        at_wall, sliding = rows["id"][:, 1] == 0, rows["sliding"] == 1
        stress, fabric = moment.array(STRESS), moment.array(FABRIC)
        size = float(np.abs(moment.vector(STRESS)[:7]).max())
        for row, pair in enumerate(PAIRS):
            own = of_pair(types, pair)
            require(own.sum() > 10 and (at_wall & own).any() == (pair != (1, 1)), f"contacts of {pair}")
            require_equal([*stress[row, :2], *fabric[row, :2]], [*pair, *pair], "types of a row")
            expected = seven(stress_of(rows, own, moment.force_box.volume))
            require_close(stress[row, 2:9], expected, EXACT, f"stress of {pair}", size)
            counts = [(own & ~at_wall).sum(), (own & at_wall).sum(), (own & sliding).sum()]
            require_equal(stress[row, 9:], counts, f"contacts of {pair}")
            n = rows["normal"][own]
            tensor = np.einsum("ca,cb->ab", n, n) / len(n)
            require_close(fabric[row, 2:8], seven(tensor)[:6], EXACT, f"fabric of {pair}", 1.0)
            require_equal(fabric[row, 8], own.sum(), f"contacts in the fabric of {pair}")
        require_close(stress[:, 2:9].sum(axis=0), moment.vector(STRESS)[:7], EXACT, "sum of the rows", size)
        total = (fabric[:, 2:8] * fabric[:, 8:9]).sum(axis=0) / fabric[:, 8].sum()
        require_close(total, moment.vector(FABRIC)[:6], EXACT, "sum of the fabrics", 1.0)
        for watched in LOSS.values():
            loss = moment.array(watched)
            require_equal(loss[:, :2], PAIRS, "types of a row")
            require_close(
                loss[:, 2:].sum(axis=0),
                moment.vector(watched),
                EXACT,
                f"sum of {watched.command}",
                np.abs(moment.vector(watched)).max(),
            )


def chosen_types(ranks):
    """`types a b` in either order, with * for any, and the losses of a pair are its row."""
    computes = [STRESS, LOSS["step"], *OF_TYPES.values(), *LOSS_OF.values(), *GRAIN_OF.values()]
    for moment in moments(MIXTURE, computes, ranks):
        rows, types = moment.rows, types_of(moment.rows, moment.grains)
        size = float(np.abs(moment.vector(STRESS)[:7]).max())
        for name, pair in CHOSEN.items():
            own = of_pair(types, pair)
            vector = moment.vector(OF_TYPES[name])
            expected = seven(stress_of(rows, own, moment.force_box.volume))
            require_close(vector[:7], expected, EXACT, words(pair), size)
            require_equal(vector[[29, 35]].sum(), own.sum(), "contacts, " + words(pair))
            ids = rows["id"][own].astype(int)
            numbers = np.bincount(ids[:, 0], minlength=len(moment.grains.x) + 1)
            numbers += np.bincount(ids[:, 1], minlength=len(numbers))
            require_equal(moment.peratom(GRAIN_OF[name])[:, 0], numbers[1:], "contacts per grain, " + words(pair))
        loss = moment.array(LOSS["step"])
        for name, row in (("11", 0), ("12", 1), ("21", 1)):
            require_close(moment.vector(LOSS_OF[name]), loss[row, 2:], EXACT, words(CHOSEN[name]), np.abs(loss).max())
        require_equal(moment.vector(OF_TYPES["12"]), moment.vector(OF_TYPES["21"]), "either order")
        require_equal(moment.vector(OF_TYPES["any"]), moment.vector(STRESS), "types * *")


PLANES = {"xy": (0, 1, 2), "xz": (0, 2, 1), "yz": (1, 2, 0)}
PRESSURES = {"": None, "x": 0, "y": 1, "z": 2, "mean": "mean"}
IN_PLANE = {
    (plane, pressure): Watched(
        f"s_{plane}_{pressure}",
        f"stress/contact plane {plane}" + (f" pressure {pressure}" if pressure else ""),
        True,
        36,
    )
    for plane in PLANES
    for pressure in PRESSURES
}
VOLUMES = {
    "number": (Watched("s_number", "stress/contact volume 123.5", True, 36), 123.5),
    "variable": (Watched("s_variable", "stress/contact volume v_filled", True, 36), None),
    "auto": (Watched("s_auto", "stress/contact volume auto", True, 36), None),
}


def planes_and_pressures(ranks):
    for moment in moments(MIXTURE, list(IN_PLANE.values()), ranks):
        rows = moment.rows
        s = stress_of(rows, np.ones(len(rows["fn"]), dtype=bool), moment.force_box.volume)
        size = float(np.abs(s).max())
        for (plane, pressure), watched in IN_PLANE.items():
            a, b, c = PLANES[plane]
            which = PRESSURES[pressure] if pressure else b
            p = -np.trace(s) / 3.0 if which == "mean" else -s[which, which]
            require(p > 0.1 * size, "a pressure to divide by")
            expected = [p, s[a, b] / p, (s[a, a] - s[b, b]) / p, (s[b, b] - s[c, c]) / p]
            require_close(moment.vector(watched)[25:29], expected, EXACT, watched.command, max(size, 10.0))
            require_close(moment.scalar(watched), p, EXACT, watched.command, size)


def volumes(ranks):
    """Stresses are per the volume that is given; counts do not know it."""
    computes = [watched for watched, _ in VOLUMES.values()]
    scene = replace(MIXTURE, deck=replace(MIXTURE.deck, body=[*MIXTURE.deck.body, "variable filled equal 2*lx+step"]))
    for moment in moments(scene, computes, ranks):
        box = moment.force_box.volume
        whole = moment.vector(VOLUMES["auto"][0])
        for name, (watched, volume) in VOLUMES.items():
            if name == "variable":
                volume = 2.0 * moment.printed["lx"] + moment.step
            factor = box / (volume or box)
            found, size = moment.vector(watched), np.abs(whole).max() * factor
            require_close(found[:26], whole[:26] * factor, EXACT, f"volume {name}", size)
            require_equal(found[[29, 30, 35]], whole[[29, 30, 35]], "counts")


WHOLE_BOX = "stresses and densities (not Z and numbers) are divided by the volume of the whole box"


def whole_box_warned_of(ranks):
    """Where faces are not periodic and nobody said what the volume is."""
    for word, warnings in (("", 1), (" volume auto", 0), (" volume 10", 0)):
        deck = replace(MIXTURE.deck, body=[*MIXTURE.deck.body, "compute s all stress/contact" + word, "run 0", "run 0"])
        require_equal(run(deck, ranks).output.count(WHOLE_BOX), warnings, f"warnings with '{word}'")


ROOT = math.sqrt(0.5)
LONG, FLAT, TRIAXIAL = (1.0, 1.0, 2.0), (1.0, 1.0, 0.5), (1.0, 1.5, 0.6)
UPRIGHT, ALONG_X = (1.0, 0.0, 0.0, 0.0), (ROOT, 0.0, ROOT, 0.0)


def orders(grains, keywords, ranks):
    placed = [Grain((5.0 * k + 2.5, 5.0, 5.0), shape, turn) for k, (shape, turn) in enumerate(grains)]
    packing = Packing((max(5.0 * len(placed), 10.0), 10.0, 10.0), placed)
    names = outputs("nematic").of("n")
    vector = names.vector()
    deck = Deck(packing, body=[f"compute n all nematic {keywords}", *thermo(1, "c_n", *vector), "run 0"])
    result = run(deck, ranks)
    table = result.thermo()[0]
    return table["c_n"][0], np.array([table[q][0] for q in vector]), result.output.count("mixes flat and long grains")


def mixtures_of_shapes(ranks):
    """Long grains upright, flat ones lying with their short axes along x: each perfect alone, together not."""
    grains = [(LONG, UPRIGHT)] * 3 + [(FLAT, ALONG_X)] * 3
    for keywords, order, counted, warnings in (
        ("", 0.25, 6, 1),
        ("axis auto", 0.25, 6, 1),
        ("axis symmetry", 0.25, 6, 0),
        ("axis long", 1.0, 3, 0),
        ("axis short", 1.0, 3, 0),
    ):
        s2, vector, warned = orders(grains, keywords, ranks)
        require_close(s2, order, 1e-13, f"S2, '{keywords}'")
        require_equal([vector[15], warned], [counted, warnings], f"grains with an axis, warnings, '{keywords}'")
    for keywords, axis in (("axis long", 1), ("axis short", 2), ("", 1)):  # body axes y and z of the triaxial grain
        s2, vector, warned = orders([(TRIAXIAL, UPRIGHT)] * 2, keywords, ranks)
        require_close(vector[6:9], np.eye(3)[axis], 1e-13, f"director, '{keywords}'", 1.0)
        require_equal([vector[15], warned], [2, 0], "triaxial grains")
    _, vector, warned = orders([(LONG, UPRIGHT)] * 2, "axis short", ranks)
    require_equal([*vector[:6], vector[15], warned], [0.0] * 8, "no grain has a shortest axis")


def angle_of_grains(turn, shape, plane, ranks):
    """The mean of theta of contact/grain over two grains that do not touch."""
    placed = [Grain((5.0 * k + 2.5, 5.0, 5.0), shape, turn) for k in range(2)]
    theta = outputs("contact/grain").of("g")["theta"]
    body = [f"compute g all contact/grain plane {plane}", f"compute r all reduce ave {theta}"]
    deck = Deck(Packing((10.0, 10.0, 10.0), placed), body=[*body, *thermo(1, "c_r"), "run 0"])
    return run(deck, ranks).thermo()[0]["c_r"][0]


def angles_in_planes(ranks):
    """theta of a long grain turned by 30 degrees from x towards z, and of a flat one."""
    half = math.radians(30.0) / 2.0
    # z turned to x about y, then from x towards z: about -y
    turn = (math.cos(half) * ROOT + math.sin(half) * ROOT, 0.0, math.cos(half) * ROOT - math.sin(half) * ROOT, 0.0)
    for shape, angle in ((LONG, 30.0), (FLAT, -60.0)):
        _, vector, _ = orders([(shape, turn)] * 2, "plane xz", ranks)
        require_close(np.degrees(vector[10:12]), [angle, angle], 1e-12, f"theta of {shape}", 90.0)
        of_grains = np.degrees(angle_of_grains(turn, shape, "xz", ranks))
        require_close(of_grains, angle, 1e-12, f"theta of grains of {shape}", 90.0)
    _, vector, _ = orders([(LONG, turn)] * 2, "plane yz", ranks)
    require_close(np.degrees(vector[10]), 90.0, 1e-12, "theta in yz", 90.0)


CASES = {
    "rows-by-types": rows_by_types,
    "chosen-types": chosen_types,
    "planes-and-pressures": planes_and_pressures,
    "volumes": volumes,
    "whole-box-warned-of": whole_box_warned_of,
    "mixtures-of-shapes": mixtures_of_shapes,
    "angles-in-planes": angles_in_planes,
}

if __name__ == "__main__":
    main(CASES)
