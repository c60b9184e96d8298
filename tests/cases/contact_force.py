# SPDX-License-Identifier: GPL-2.0-or-later
"""compute contact/force, and the columns strong and cluster of contact/local, against numpy and scipy from rows of
contacts, and where the answer is known by hand."""
from dataclasses import replace

import numpy as np

import clumps
from case import main, require, require_close, require_equal, require_same_snapshots
from deck import Deck, dump_grains, dump_local, number, shear, thermo
from grainscope.columns import outputs
from oracle import network
from packing import Grain, Packing, dense_packing, disc_packing
from run import run
from wall_measures import BOX

MEASURE = outputs("contact/force")
C_IT = MEASURE.of("it")
COLUMNS = ("id", "force", "branch", "fn", "ft", "strong", "cluster")
WIDTH = 14
BINS, MOST, TAIL = 24, 4.0, 1.2
EXACT = 1e-11  # sums of some hundred terms, squared and divided


def measured(deck, ranks, words="", group="union all", steps=60, every=20):
    """[(vector by name, array, rows of contacts) of each snapshot]."""
    body = [
        *deck.body,
        f"group chosen {group}",
        f"compute it chosen contact/force bins {BINS} max {MOST} tail {TAIL} {words}",
        f"compute rows chosen contact/local {' '.join(COLUMNS)} {words}",
        *thermo(every, "c_it", *C_IT.vector(), *C_IT.array(range(1, BINS + 1))),
        *dump_local("rows", WIDTH, every, "rows"),
        f"run {steps}",
    ]
    result = run(replace(deck, body=body), ranks)
    table, found = result.thermo()[-1], []
    dumps = result.dump("rows.dump")
    require(len(dumps) == len(table["step"]) > 1, "several snapshots")
    for row, (_, columns) in enumerate(dumps):
        vector = {name: float(table[C_IT[name]][row]) for name in MEASURE.names("vector")}
        require_equal(float(table["c_it"][row]), vector["F_n"], "scalar")
        array = np.array([float(table[word][row]) for word in C_IT.array(range(1, BINS + 1))]).reshape(BINS, 3)
        rows = np.stack([columns[f"c_rows[{k}]"] for k in range(1, WIDTH + 1)], axis=1).reshape(-1, WIDTH)
        found.append((vector, array, rows))
    return found


def require_agreement(vector, array, rows, dimension=3):
    ids, force, branch, fn, ft = rows[:, :2], rows[:, 2:5], rows[:, 5:8], rows[:, 8], rows[:, 9:12]
    by_hand = network.force_statistics(fn, np.linalg.norm(ft, axis=1), force, branch, TAIL, dimension)
    strong = fn > fn.mean()
    labels, clusters = network.clusters(ids, strong)
    at_wall = ids[:, 1] == 0
    by_hand.update(N_c=(~at_wall).sum(), N_w=at_wall.sum(), clusters=len(clusters), cluster_max=max(clusters.values()))
    require(sorted(vector) == sorted(by_hand), "every output is compared")
    for name, value in by_hand.items():
        require_close(vector[name], value, EXACT, name, max(abs(value), 1e-3))
    require_equal(rows[:, 12], strong, "strong")
    require_equal(rows[:, 13], labels, "cluster")

    edges = np.linspace(0.0, MOST, BINS + 1)
    counts = np.histogram(fn / fn.mean(), edges)[0]
    require_close(array[:, 0], 0.5 * (edges[1:] + edges[:-1]), 1e-14, "f")
    require_equal(array[:, 2], counts, "contacts of a bin")
    require_close(array[:, 1], counts / len(fn) / (MOST / BINS), EXACT, "density")


def agrees(alpha, style="superquadric", words="", **choices):
    def case(ranks):
        packing = dense_packing(alpha, sizes=(0.9, 1.0, 1.1), atom_style=style, overlap=-0.002, speed=1.0, minimum=200)
        deck = Deck(packing, **choices)
        deck.body = [shear(0.3)]
        found = measured(deck, ranks, words)
        for one in found:
            require_agreement(*one)
            require(0 < one[0]["N_strong"] < one[0]["N_c"], "strong and weak contacts")

    return case


def at_walls(ranks):
    """For each choice of walls; a wall connects no grains."""
    for walls in ("yes", "no", "only"):
        deck = replace(BOX.deck, body=[*BOX.deck.body, f"run {BOX.settle}"])
        for one in measured(deck, ranks, f"walls {walls}", steps=20, every=10):
            require_agreement(*one)
            require((one[0]["N_w"] > 20) == (walls != "no"), "contacts with walls")


def of_types(ranks):
    """Of the contacts between two types alone: their own mean decides."""
    packing = dense_packing(types=2, sizes=(0.9, 1.0, 1.1), atom_style="sphere", overlap=0.001, speed=1.0)
    deck = Deck(packing)
    deck.body = [shear(0.3)]
    for one in measured(deck, ranks, "types 1 2"):
        require_agreement(*one)


def in_a_region(ranks):
    """The contacts whose points are in it."""
    deck = Deck(dense_packing(sizes=(0.9, 1.0, 1.1), atom_style="sphere", overlap=0.001, speed=1.0, minimum=200))
    middle = " ".join(number(0.5 * e) for e in deck.packing.edges)
    deck.body = [shear(0.3), f"region ball sphere {middle} 4.5 units box"]
    for one in measured(deck, ranks, "region ball"):
        require_agreement(*one)
        require(100 < one[0]["N_c"] < 500, "some of the contacts")


def discs(ranks):
    """Of two dimensions: the deviator is of the plane."""
    deck = Deck(disc_packing(overlap=0.001, speed=1.0))
    deck.body = [shear(0.3)]
    for one in measured(deck, ranks):
        require_agreement(*one, dimension=2)


def of_a_group(ranks):
    packing = dense_packing(sizes=(0.9, 1.0, 1.1), atom_style="sphere", overlap=0.001, speed=1.0)
    deck = Deck(packing)
    deck.body = [shear(0.3)]
    for one in measured(deck, ranks, group="id 20:80"):
        require_agreement(*one)


def empty_group(ranks):
    deck = Deck(dense_packing(atom_style="sphere"))
    deck.body = [
        "group none id 5000",
        f"compute it none contact/force bins {BINS}",
        "compute rows none contact/local cluster strong",
        *thermo(5, *C_IT.vector(), *C_IT.array(range(1, BINS + 1))),
        *dump_local("rows", 2, 5, "rows"),
        "run 5",
    ]
    result = run(deck, ranks)
    table = result.thermo()[-1]
    middles = (np.arange(BINS) + 0.5) * (6.0 / BINS)
    for row in range(len(table["step"])):
        require_equal([float(table[w][row]) for w in C_IT.vector()], [0.0] * len(C_IT.vector()), "an empty group")
        array = np.array([float(table[word][row]) for word in C_IT.array(range(1, BINS + 1))]).reshape(BINS, 3)
        require_close(array, np.stack([middles, 0 * middles, 0 * middles], axis=1), 1e-14, "bins")


def trajectory_untouched(ranks):
    """The same bits with every number asked in every step, over neighbour lists, and without."""
    packing = dense_packing(1.5, overlap=0.001, speed=2.0)
    asked = [
        "compute it all contact/force",
        "compute state all packing",
        "compute rows all contact/local strong cluster",
        *dump_local("rows", 2, 1, "rows"),
        *thermo(1, "c_it", "c_state"),
    ]
    found = []
    for lines in ([], asked):
        deck = Deck(packing, surface="ellipsoid")
        deck.body = [shear(0.3), *lines, *dump_grains(packing, 50), "run 150"]
        found.append(run(deck, ranks).dump("grains.dump"))
    require_same_snapshots(*found, "with and without")


def of_clumps(ranks):
    """A clump is one grain of a cluster, known by the lowest ID of its spheres; branches go between centres of mass."""
    names = ("strong_pressure", "strong_deviator", "N_strong", "clusters", "cluster_max")
    words = " ".join(C_IT[name] for name in names)
    columns = ("id_i", "id_j", "fn", "strong", "cluster")
    lines = [
        "compute it all contact/force",
        f"fix it all ave/time 15 1 15 {words} file force.txt",
        "compute chains all contact/local id fn strong cluster",
        *dump_local("chains", len(columns), 15, "chains"),
    ]
    result, moments = clumps.measured(clumps.start(), ranks, 60, 15, lines)
    table, chains_dump = result.averages("force.txt"), dict(result.dump("chains.dump"))
    compared = 0
    for moment in moments:
        if moment.step % 15 or moment.step == 0:
            continue
        rows = np.stack([chains_dump[moment.step][f"c_chains[{k}]"] for k in range(1, len(columns) + 1)], axis=1)
        ids, strong = moment.rows["id"], rows[:, 2] > rows[:, 2].mean()
        require_equal(rows[:, :2], ids, "rows of the two dumps")
        order = np.searchsorted(moment.grains["id"], ids)
        lowest = moment.grains["id"].copy()
        for body in range(moment.body.max() + 1):
            lowest[moment.body == body] = moment.grains["id"][moment.body == body].min()
        labels, found = network.clusters(lowest[order], strong)
        require_equal(rows[:, 3], strong, "strong")
        require_equal(rows[:, 4], labels, "cluster")
        branch = moment.rows["branch"] - moment.arm(order[:, 0]) + moment.arm(order[:, 1])
        force, zero = moment.rows["force"], np.zeros(len(rows))
        by_hand = network.force_statistics(rows[:, 2], zero, force, branch, 1.0)
        by_hand.update(clusters=len(found), cluster_max=max(found.values()))
        row = list(table["TimeStep"]).index(moment.step)
        for name in names:  # the table has six digits
            require_close(float(table[C_IT[name]][row]), by_hand[name], 1e-5, name, max(abs(by_hand[name]), 1e-3))
        compared += 1
    require(compared >= 4, "several snapshots")


def equal_forces(ranks):
    """A lattice whose forces are the same but for rounding has no strong contacts and no weak part."""
    edge, size = 8, 1.99
    places = [tuple(size * (k + 0.5) for k in cell) for cell in np.ndindex(edge, edge, edge)]
    packing = Packing((edge * size,) * 3, [Grain(at) for at in places], atom_style="sphere")
    deck = Deck(packing)
    deck.body = [
        f"compute it all contact/force bins {BINS} tail 1.0",
        "compute rows all contact/local fn strong cluster",
        *thermo(1, *C_IT.vector()),
        *dump_local("rows", 3, 1, "rows"),
        "run 0",
    ]
    result = run(deck, ranks)
    table = result.thermo()[-1]
    numbers = [table[C_IT[name]][0] for name in ("N_c", "N_strong", "N_tail", "N_weak", "clusters")]
    require_equal(numbers, [3 * edge**3, 0, 0, 0, 0], "contacts that are all the same")
    ((_, rows),) = result.dump("rows.dump")
    require(len(np.unique(rows["c_rows[1]"])) > 1, "forces that differ by rounding")
    require_equal(rows["c_rows[2]"], np.zeros(3 * edge**3), "strong")
    require_equal(rows["c_rows[3]"], np.zeros(3 * edge**3), "cluster")


def chains(ranks):
    """Lines of spheres along x with two overlaps: the deep contacts are strong. A line of five over all ranks, a pair
    through the periodic face, and light contacts between them."""
    gaps = [1.99, 1.99, 1.99, 1.99, 1.999, 1.99, 1.999, 1.999, 1.999, 1.999, 1.99]
    places = np.concatenate([[0.5], 0.5 + np.cumsum(gaps)])
    order = [7, 3, 9, 2, 8, 11, 5, 1, 10, 4, 12, 6]  # IDs along the line
    grains = [None] * 12
    for place, grain in zip(places, order):
        grains[grain - 1] = Grain((float(place), 6.0, 6.0))
    length = float(places[-1] - places[0] + 1.99)
    deck = Deck(Packing((length, 12.0, 12.0), grains, atom_style="sphere", triclinic=False), processors=f"{ranks} 1 1")
    deck.body = [
        f"compute it all contact/force bins {BINS}",
        "compute rows all contact/local cluster id strong",
        *thermo(1, *C_IT.vector()),
        *dump_local("rows", 4, 1, "rows"),
        "run 0",
    ]
    result = run(deck, ranks)
    table = result.thermo()[-1]
    # Along the ring: 12 - 6 - 7 3 9 2 8 (two strong contacts and the face between them) and 11 5.
    value = {name: float(table[C_IT[name]][0]) for name in MEASURE.names("vector")}
    numbers = [value[name] for name in ("N_c", "N_strong", "clusters", "cluster_max")]
    require_equal(numbers, [12, 7, 2, 7], "the ring")
    ((_, rows),) = result.dump("rows.dump")
    found = {}
    for cluster, i, j, strong in np.stack([rows[f"c_rows[{k}]"] for k in (1, 2, 3, 4)], axis=1).astype(int):
        require((cluster > 0) == (strong == 1), "strong contacts have a cluster")
        found.setdefault(cluster, set()).update((i, j))
    require(found.get(2) == {12, 6, 7, 3, 9, 2, 8} and found.get(5) == {11, 5}, f"clusters {found}")


CASES = {
    "spheres": agrees(1.0, "sphere"),
    "prolate": agrees(1.5, surface="ellipsoid"),
    "oblate": agrees(0.67, surface="ellipsoid"),
    "superquadric": agrees(1.5),
    "cohesive": agrees(1.0, "sphere", cohesion="sjkr"),
    "at-walls": at_walls,
    "of-types": of_types,
    "in-a-region": in_a_region,
    "discs": discs,
    "of-a-group": of_a_group,
    "empty-group": empty_group,
    "trajectory-untouched": trajectory_untouched,
    "clumps": of_clumps,
    "equal-forces": equal_forces,
    "chains": chains,
}

if __name__ == "__main__":
    main(CASES)
