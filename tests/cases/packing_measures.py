# SPDX-License-Identifier: GPL-2.0-or-later
"""compute packing against numpy, from dumps of grains and contacts, and where the answer is known by hand."""
from dataclasses import replace
import math

import numpy as np
from scipy.special import beta

from case import main, require, require_close, require_equal
from deck import DENSITY, Deck, dump_grains, dump_local, number, shear, thermo
from grainscope.columns import outputs
from oracle import network
from packing import Grain, Packing, dense_packing, disc_packing
from run import run
from wall_measures import BOX

MEASURE = outputs("packing")
C_IT = MEASURE.of("it")
# Sums of some hundred terms; of spheroids the two owners of a contact differ by 1e-7 in its force, and one writes it.
OF_SPHERES, OF_SPHEROIDS = 1e-12, 1e-6
RATE = 0.3
ROWS = ["compute rows chosen contact/local id force branch"]
LOOSE = {"overlap": -0.002, "speed": 1.0, "minimum": 200}  # contacts open and close: there are rattlers


PARTS = {"whole": "", "left": "region left", "right": "region right"}


def given(table, row):
    return {name: float(table[C_IT[name]][row]) for name in MEASURE.names("vector")}


def measured(deck, ranks, words="", group="union all", steps=60, every=20):
    """[(what compute packing gave by name, volume, dump of grains, dump of contacts) of each snapshot]."""
    body = [
        *deck.body,
        f"group chosen {group}",
        f"compute it chosen packing {words}",
        *ROWS,
        *thermo(every, "vol", *C_IT.vector()),
        *dump_grains(deck.packing, every),
        *dump_local("rows", 8, every, "rows"),
        f"run {steps}",
    ]
    result = run(replace(deck, body=body), ranks)
    table = result.thermo()[-1]
    snapshots = list(zip(result.dump("grains.dump"), result.dump("rows.dump")))
    require(len(snapshots) > 1 and len(table["step"]) == len(snapshots), "several snapshots")
    return [
        (given(table, row), float(table["vol"][row]), grains, rows)
        for row, ((_, grains), (_, rows)) in enumerate(snapshots)
    ]


def expected(volume, grains, rows, limit, chosen, fullness=1.0, rate=RATE, dimension=3):
    """By numpy; `chosen`: which rows of the dump of grains are in the group."""
    if "shapex" in grains:
        shapes = np.stack([grains[f"shape{a}"] for a in "xyz"], axis=1)[chosen]
    else:
        shapes = np.repeat(grains["radius"][chosen][:, None], 3, axis=1)
    solids = 4.0 / 3.0 * math.pi * shapes.prod(axis=1) * fullness
    diameters = np.cbrt(6.0 / math.pi * solids)
    if dimension == 2:
        solids, diameters = math.pi * shapes[:, 0] ** 2, 2.0 * shapes[:, 0]
    names = [f"c_rows[{k}]" for k in range(1, 9)]
    table = np.stack([rows[name] for name in names], axis=1).reshape(-1, 8)
    ids, force, branch = table[:, :2], table[:, 2:5], table[:, 5:8]
    at_wall = ids[:, 1] == 0
    n, n_w = len(solids), at_wall.sum()
    n_c = len(ids) - n_w
    held = network.backbone(grains["id"][chosen], ids, limit)
    between, with_walls = network.backbone_contacts(held, ids)
    pressure = np.sum(force[:, 1] * branch[:, 1]) / volume
    rho = grains["mass"][chosen].sum() / solids.sum()
    return {
        "phi": solids.sum() / volume,
        "d": diameters.mean(),
        "I": rate * diameters.mean() * math.sqrt(rho / pressure),
        "Z": (2 * n_c + n_w) / n,
        "Z_backbone": (2 * between + with_walls) / len(held) if held else 0.0,
        "rattlers": 1.0 - len(held) / n,
        "N": n,
        "N_c": n_c,
        "N_w": n_w,
        "N_rattlers": n - len(held),
        "N_c_backbone": between,
        "N_w_backbone": with_walls,
        "P": pressure,
        "rate": rate,
        "rho": rho,
        "V_s": solids.sum(),
        "Omega": volume,
        "d_spread": diameters.std() / diameters.mean(),
    }


def require_agreement(found, limit, tolerance, group=(1, 10**9), volume=None, **choices):
    for one, box, grains, rows in found:
        chosen = (grains["id"] >= group[0]) & (grains["id"] <= group[1])
        by_hand = expected(volume or box, grains, rows, limit, chosen, **choices)
        require(list(one) == list(by_hand), "every output is compared")
        for name, value in by_hand.items():
            require_close(one[name], value, tolerance, name, max(abs(value), 1e-3))


def sheared(packing, **choices):
    deck = Deck(packing, **choices)
    deck.body = [shear(RATE)]
    return deck


def agrees(alpha, style="superquadric", limit=4, words="", sizes=(0.8, 0.9, 1.0, 1.1), **choices):
    """In shear, with rattlers and without them."""

    def case(ranks):
        tolerance = OF_SPHERES if alpha == 1.0 else OF_SPHEROIDS
        packing = dense_packing(alpha, sizes=sizes, atom_style=style, **LOOSE)
        found = measured(sheared(packing, **choices), ranks, words)
        require_agreement(found, limit, tolerance)
        some = [one["N_rattlers"] for one, *_ in found]
        require(0 < max(some) < found[0][0]["N"], f"rattlers: {some}")

    return case


def blocky(ranks):
    """Superquadrics: their volume by the beta functions of scipy, 1.63 times that of the ellipsoid."""
    n1, n2 = 5.0, 4.0
    e1, e2 = 2.0 / n1, 2.0 / n2
    fullness = 2.0 * e1 * e2 * beta(0.5 * e1 + 1.0, e1) * beta(0.5 * e2, 0.5 * e2) / (4.0 / 3.0 * math.pi)
    require(1.5 < fullness < 1.8, "fullness")
    packing = dense_packing(1.2, sizes=(0.9, 1.0), overlap=0.04, blockiness=(n1, n2))
    require_agreement(measured(sheared(packing), ranks), 4, OF_SPHEROIDS, fullness=fullness)

    # compute fluctuation scales its lever by the same diameter
    d = np.mean([2.0 * np.cbrt(fullness * math.prod(grain.semi_axes)) for grain in packing.grains])
    deck = sheared(packing)
    deck.body += ["compute own all fluctuation", f"compute given all fluctuation diameter {number(d)}"]
    deck.body += [*thermo(5, "c_own", "c_given"), "run 5"]
    table = run(deck, ranks).thermo()[-1]
    require_close(table["c_own"], table["c_given"], 1e-12, "lever")


def discs(ranks):
    """Of two dimensions: areas, and rattlers have fewer than two contacts."""
    for overlap in (-0.002, 0.02):
        packing = disc_packing(overlap=overlap, speed=1.0)
        found = measured(sheared(packing), ranks)
        require_agreement(found, 2, OF_SPHERES, dimension=2)
        require(0.7 < found[0][0]["phi"] < 1.0, "areas of discs")


def of_a_group(ranks):
    """Contacts count when both grains are in the group; Omega stays the box."""
    packing = dense_packing(sizes=(0.8, 1.0, 1.1), atom_style="sphere", **LOOSE)
    found = measured(sheared(packing), ranks, "rattlers 2", group="id 1:120")
    require_agreement(found, 2, OF_SPHERES, group=(1, 120))


def empty_group(ranks):
    packing = dense_packing(atom_style="sphere")
    deck = sheared(packing)
    deck.body += ["group none id 5000", "compute it none packing", *thermo(10, "vol", *C_IT.vector()), "run 10"]
    table = run(deck, ranks).thermo()[-1]
    for row in range(len(table["step"])):
        values = given(table, row)
        require_close(values.pop("Omega"), float(table["vol"][row]), 1e-14, "Omega")
        require_close(values.pop("rate"), RATE, 1e-12, "rate")
        require_equal(list(values.values()), [0.0] * len(values), "an empty group")


def at_walls(ranks):
    """Spheres between planes, for each choice of walls: those that count hold grains too; rate and volume as given."""
    for walls, words in (("yes", ""), ("no", "walls no"), ("only", "walls only rattlers 1")):
        deck = replace(BOX.deck, body=[*BOX.deck.body, f"run {BOX.settle}"])
        deck.body.append("variable rate equal 0.1+0.1")
        found = measured(deck, ranks, f"{words} volume 850 rate v_rate", steps=20, every=10)
        for _, _, _, rows in found:  # of all contacts
            at_wall = rows["c_rows[2]"] == 0
            keep = {"yes": at_wall | True, "no": ~at_wall, "only": at_wall}[walls]
            for name in rows:
                rows[name] = rows[name][keep]
        require_agreement(found, 1 if walls == "only" else 4, OF_SPHERES, volume=850.0, rate=0.2)
        require(walls == "no" or found[-1][0]["N_w"] > 50, "contacts with walls")


def in_regions(ranks):
    """Two halves of the box add up to it; rattlers are those of the whole."""
    packing = replace(dense_packing(sizes=(0.9, 1.0, 1.1), atom_style="sphere", **LOOSE), triclinic=False)
    (lx, ly, lz), deck = packing.edges, Deck(packing)
    deck.body = [
        f"region left block 0 {number(0.4 * lx)} 0 {number(ly)} 0 {number(lz)} units box",
        f"region right block 0 {number(0.4 * lx)} 0 {number(ly)} 0 {number(lz)} side out units box",
        *(f"compute {name} all packing rate 1 {words}" for name, words in PARTS.items()),
        *thermo(20, *(word for name in PARTS for word in MEASURE.of(name).vector())),
        "run 60",
    ]
    table = run(deck, ranks).thermo()[-1]
    for row in range(len(table["step"])):
        whole, left, right = (
            {name: float(table[MEASURE.of(part)[name]][row]) for name in MEASURE.names("vector")} for part in PARTS
        )
        for name in ("N", "N_c", "N_rattlers", "N_c_backbone"):
            require_equal(left[name] + right[name], whole[name], name)
        for name in ("V_s", "Omega"):
            require_close(left[name] + right[name], whole[name], 1e-12, name)
        for name in ("phi", "P"):
            parts = sum(part[name] * part["Omega"] for part in (left, right))
            require_close(parts, whole[name] * whole["Omega"], 1e-12, name)
        require(left["N"] > 40 and whole["N_rattlers"] > 0, "grains")


def line_of_spheres(count, pitch, length):
    grains = [Grain(((k + 0.5) * pitch, 6.0, 6.0)) for k in range(count)]
    return Packing((length, 12.0, 12.0), grains, atom_style="sphere", triclinic=False)


def chains(ranks):
    """Twelve spheres in a line: as a ring through the periodic faces each has two contacts. With one missing, its ends
    fall off, then the next ones, until none is left, over all ranks."""
    for count, rattlers, backbone in ((12, 0, 12), (11, 11, 0)):
        deck = Deck(line_of_spheres(count, 1.99, 12 * 1.99), processors=f"{ranks} 1 1")
        deck.body = ["compute it all packing rattlers 2 rate 1", *thermo(1, *C_IT.vector()), "run 0"]
        found = given(run(deck, ranks).thermo()[-1], 0)
        contacts = count if count == 12 else count - 1
        numbers = [found[name] for name in ("N", "N_c", "N_rattlers", "N_c_backbone", "N_w")]
        require_equal(numbers, [count, contacts, rattlers, backbone, 0], "a line")
        require_close(found["Z_backbone"], 2.0 if backbone else 0.0, 0.0, "Z of the backbone", 1.0)


def inertial_number(ranks):
    """By hand: I = rate d sqrt(rho/P), P of the plane of shear that is said, the box's own rate."""
    packing = dense_packing(atom_style="sphere")
    deck = Deck(packing)
    deck.body = [
        "fix flow all deform 1 xz erate 0.2 remap v",
        "compute it all packing plane xz",
        "compute other all packing plane xz pressure mean rate 2",
        "compute stress all stress/contact plane xz",
        *thermo(5, *C_IT.vector(), MEASURE.of("other")["I"], "c_stress", "c_stress[1]", "c_stress[2]", "c_stress[3]"),
        "run 10",
    ]
    table = run(deck, ranks).thermo()[-1]
    for row in range(len(table["step"])):
        found = given(table, row)
        pressure = float(table["c_stress"][row])
        mean = -sum(float(table[f"c_stress[{k}]"][row]) for k in (1, 2, 3)) / 3.0
        require_close(found["P"], pressure, 1e-12, "P")
        require_close(found["rate"], 0.2, 1e-12, "rate of the box")
        require_close(found["I"], 0.2 * 2.0 * math.sqrt(DENSITY / pressure), 1e-12, "I")
        other = float(table[MEASURE.of("other")["I"]][row])
        require_close(other, 2.0 * 2.0 * math.sqrt(DENSITY / mean), 1e-12, "I of the mean pressure")


CASES = {
    "spheres": agrees(1.0, "sphere"),
    "prolate": agrees(1.5, words="rate 0.3"),
    "oblate": agrees(0.67, words="rattlers 3", limit=3, surface="ellipsoid"),
    "blocky": blocky,
    "discs": discs,
    "of-a-group": of_a_group,
    "empty-group": empty_group,
    "at-walls": at_walls,
    "in-regions": in_regions,
    "chains": chains,
    "inertial-number": inertial_number,
}

if __name__ == "__main__":
    main(CASES)
