# SPDX-License-Identifier: GPL-2.0-or-later
"""Fluctuations against mean flows that are no flow of the box, granular temperatures, memories over time, and groups
whose grains come and go: all against numpy from dumps."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import Grain, Packing, dense_packing
from run import run
from wall_measures import BOX
from watch import Watched, moments_of, watched_deck

EXACT = 1e-10
FLUCTUATION = outputs("fluctuation")
SIZE = len(FLUCTUATION.names("vector"))
REGION = "region part block INF INF INF 4.0 INF INF units box"
FLOWS = ("none", "gradient", "fit", "layers 3", "cells 2 3 2", "cells 1 1 1")


def slug(flow):
    return flow.replace(" ", "_")


def watched(flow, region):
    name = slug(flow) + ("_part" if region else "")
    return Watched(name, f"fluctuation flow {flow}" + (" region part" if region else ""), True, SIZE)


def cell_of(x, box, cells):
    s = np.linalg.solve(box.edges, (x - box.origin).T).T
    places = [np.clip(np.floor(s[:, k] * n).astype(int), 0, n - 1) for k, n in enumerate(cells)]
    return places[0] + cells[0] * (places[1] + cells[1] * places[2])


def expected_of(flow, grains, chosen, box, inertia):
    """dv, dw of the chosen grains; the gradient that was fitted."""
    m, x, v, w = grains.mass[chosen], grains.x[chosen], grains.v[chosen], grains.omega[chosen]
    gradient = np.zeros((3, 3))
    cells = (1, 1, 1)
    words = flow.split()
    if words[0] == "layers":
        cells = (1, int(words[1]), 1)
    if words[0] == "cells":
        cells = tuple(map(int, words[1:]))
    if words[0] in ("gradient", "fit"):
        terms = x - np.average(x, axis=0, weights=m)
        if words[0] == "fit":
            terms = terms[:, 1:2]
        matrix = np.column_stack([np.ones(len(m)), terms]) * np.sqrt(m)[:, None]
        fitted = np.linalg.lstsq(matrix, v * np.sqrt(m)[:, None], rcond=None)[0]
        v = v - terms @ fitted[1:]
        if words[0] == "gradient":
            gradient = fitted[1:].T
    cell = cell_of(x, box, cells)
    dv, dw = np.empty_like(v), np.empty_like(w)
    for c in set(cell):
        mine = cell == c
        dv[mine] = v[mine] - np.average(v[mine], axis=0, weights=m[mine])
        dw[mine] = w[mine] - w[mine].mean(axis=0)
    return m, dv, dw, gradient, 2.0 * inertia[chosen]


def check(found, flow, grains, chosen, box):
    m, dv, dw, gradient, _ = expected_of(flow, grains, chosen, box, grains.radius)
    value = dict(zip(FLUCTUATION.names("vector"), found))
    mass = m.sum()
    temperatures = (m[:, None] * dv**2).sum(axis=0) / mass
    rotation = 0.4 * (m * grains.radius[chosen] ** 2 * (dw**2).sum(axis=1)).sum()
    size = temperatures.max()
    require_close([value[f"T_{a}"] for a in "xyz"], temperatures, EXACT, f"{flow}: temperatures", size)
    require_close(value["T"], temperatures.mean(), EXACT, f"{flow}: T", size)
    require_close(value["T_rot"], rotation / (3.0 * mass), EXACT, f"{flow}: T_rot")
    require_close(value["E_tr"], 1.5 * mass * value["T"], EXACT, f"{flow}: E_tr")
    require_close(value["E_rot"], 1.5 * mass * value["T_rot"], EXACT, f"{flow}: E_rot")
    rms = np.sqrt((dv**2).mean(axis=0))
    require_close([value[f"dv_{a}"] for a in "xyz"], rms, EXACT, f"{flow}: rms", rms.max())
    names = [f"L_{a}{b}" for a in "xyz" for b in "xyz"]
    require_close([value[n] for n in names], gradient.ravel(), 1e-9, f"{flow}: gradient", 1.0 + np.abs(gradient).max())
    require_equal(value["N_grains"], chosen.sum(), f"{flow}: grains")


def mean_flows(ranks):
    """Spheres between walls, on a floor that slides: no flow of the box."""
    deck = replace(BOX.deck, body=[*BOX.deck.body, REGION])
    computes = [watched(flow, region) for flow in FLOWS for region in (False, True)]
    moments = list(moments_of(run(watched_deck(deck, computes, settle=60), ranks)))
    require(len(moments) == 5, f"{len(moments)} snapshots")
    for moment in moments:
        part = moment.grains.x[:, 1] <= 4.0
        require(10 < part.sum() < len(part) - 10, "grains in the region")
        for flow in FLOWS:
            everywhere = np.ones(len(part), dtype=bool)
            for region, chosen in ((False, everywhere), (True, part)):
                check(moment.vector(watched(flow, region)), flow, moment.grains, chosen, moment.box)


def solid_rotation(ranks):
    """A bed that turns and stretches like a solid has no fluctuation against the gradient, which is told."""
    random = np.random.default_rng(3)
    gradient = np.array([[0.1, -0.7, 0.2], [0.7, 0.05, -0.3], [0.0, 0.4, -0.2]])
    grains = []
    for k in range(30):
        place = 3.0 * np.array([k % 3, k // 3 % 3, k // 9]) + random.uniform(0.9, 1.1, 3)
        grains.append(Grain(tuple(place), velocity=tuple(np.array([1.0, 2.0, 3.0]) + gradient @ place)))
    packing = Packing((15.0, 15.0, 15.0), grains, atom_style="sphere", triclinic=False)
    names = FLUCTUATION.of("f")
    asked = [names["T"], *(names[f"L_{a}{b}"] for a in "xyz" for b in "xyz"), names["lever_measured"]]
    body = ["compute f all fluctuation flow gradient", *thermo(1, *asked), "run 0"]
    table = run(Deck(packing, boundary="f f f", body=body), ranks).thermo()[0]
    require(table[asked[0]][0] < 1e-24, "no temperature")
    found = np.array([table[q][0] for q in asked[1:10]]).reshape(3, 3)
    require_close(found, gradient, 1e-12, "the gradient", 1.0)


def over_time(ranks):
    """`strain time` is the strain of a variable that is the time."""
    packing = dense_packing(atom_style="sphere")
    moved, memory = outputs("displacement/shear"), outputs("velocity/memory")
    lines, asked = ["variable passed equal step*dt"], []
    for name, source in (("a", "time"), ("b", "v_passed")):
        lines.append(f"compute d{name} all displacement/shear strain {source}")
        lines.append(f"compute m{name} all velocity/memory strain {source} every 5e-3 lags 3")
        asked.append([*moved.of(f"d{name}").vector(), *memory.of(f"m{name}").vector()])
        asked[-1] += memory.of(f"m{name}").array(range(1, 5))
    table = run(Deck(packing, body=[*lines, *thermo(2, *asked[0], *asked[1]), "run 40"]), ranks).thermo()[-1]
    for one, other in zip(*asked):
        require_close(table[one], table[other], 1e-9, one, np.abs(table[other]).max() + 1e-300)
    d = outputs("displacement/shear").of("da")
    require(table[d["D_y"]][-1] > 0.0 and table[d["d2_y"]][-1] > 0.0, "something has moved")


def correlation_in_a_region(ranks):
    """Pairs of which both are in the region, against their mean; none in a region without grains."""
    far = "region far block INF INF INF INF 1000.0 1001.0 units box"
    deck = replace(BOX.deck, body=[*BOX.deck.body, REGION, far])
    words = "velocity/correlation component vy bins 5 range 6.0 flow none region"
    part, none = (Watched(f"c_{name}", f"{words} {name}", True, 5, (5, 4)) for name in ("part", "far"))
    moments = list(moments_of(run(watched_deck(deck, [part, none], settle=60), ranks)))
    for moment in moments:
        grains = moment.grains
        mine = grains.x[:, 1] <= 4.0
        x, v = grains.x[mine], grains.v[mine, 1] - np.average(grains.v[mine, 1], weights=grains.mass[mine])
        i, j = np.triu_indices(len(x), 1)
        r = np.linalg.norm(x[i] - x[j], axis=1)
        found = moment.array(part)
        for k in range(5):
            pairs = (r >= 1.2 * k) & (r < 1.2 * (k + 1))
            if 1.2 * (k + 1) <= 2.0 * grains.radius.min():
                pairs[:] = False
            require_equal(found[k, 3], pairs.sum(), f"pairs of bin {k}")
            products = (v[i] * v[j])[pairs].sum()
            require_close(found[k, 2], products, EXACT, f"products of bin {k}", (v**2).sum())
        require_equal(moment.vector(part)[3], mine.sum(), "grains")
        require_close(moment.vector(part)[2], (v**2).mean(), EXACT, "<dv^2>")
        require_equal(moment.vector(none), np.zeros(5), "nothing in the empty region")


def free_grains(gradient, noise, speed=(0.0, 0.0, 0.0)):
    """Grains that do not touch, on a grid, in a box with faces far away: x = x_0 + v t."""
    random = np.random.default_rng(7)
    places = 6.0 * np.array(list(np.ndindex(5, 5, 5))) + random.uniform(20.0, 22.0, (125, 3))
    v = np.array(speed) + (places - 33.0) @ np.array(gradient).T + random.normal(0.0, noise, (125, 3))
    radii = random.choice([0.8, 1.0, 1.2], 125)
    return [Grain(tuple(x), (r,) * 3, velocity=tuple(u)) for x, u, r in zip(places, v, radii)]


TURN = [[0.0, -3.0, 0.5], [3.0, 0.0, -1.0], [-0.5, 1.0, 0.0]]
MOVED = {
    "none": "none",
    "rate": "rate 1.7 plane xz",
    "fit": "fit plane yz",
    "gradient": "gradient",
    "layers": "layers 4",
    "cells": "cells 3 1 2",
    "part": "gradient region part",
}
PART = [
    "variable ahead equal 20*step*dt",
    "variable none equal 0",
    "region part sphere 33.0 33.0 33.0 11.0 units box move v_ahead v_none v_none",
]


def in_part(x, time):
    return np.linalg.norm(x - 33.0 - np.array([20.0 * time, 0.0, 0.0]), axis=1) <= 11.0


def mean_motion(words, u, x, m, dt, middle, edge):
    """What a mean flow takes of u, what grains at x, half way, have come by."""
    axes = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}
    plane = axes[words[words.index("plane") + 1]] if "plane" in words else axes["xy"]
    cells, taken = [1, 1, 1], np.zeros_like(u)
    terms = (x - np.average(x, axis=0, weights=m))[:, {"fit": plane[1:], "gradient": (0, 1, 2)}.get(words[0], ())]
    if words[0] == "rate":
        taken[:, plane[0]] = float(words[1]) * dt * (x[:, plane[1]] - middle)
    if words[0] == "layers":
        cells[plane[1]] = int(words[1])
    if words[0] == "cells":
        cells = list(map(int, words[1:4]))
    matrix = np.column_stack([np.ones(len(m)), terms]) * np.sqrt(m)[:, None]
    taken = taken + terms @ np.linalg.lstsq(matrix, u * np.sqrt(m)[:, None], rcond=None)[0][1:]
    cell = np.ravel_multi_index(np.floor(x / edge * cells).astype(int).T, cells)
    for one in set(cell):
        mine = cell == one
        taken[mine] += np.average((u - taken)[mine], axis=0, weights=m[mine])
    return taken


def displacements_against_flows(ranks):
    """Of grains in free flight, asked every ten steps."""
    edge, every = 66.0, 12
    packing = Packing((edge,) * 3, free_grains(TURN, 2.0, (5.0, -3.0, 1.0)), atom_style="sphere", triclinic=False)
    moved = outputs("displacement/shear")
    lines, asked = [*PART], []
    for name, words in MOVED.items():
        lines.append(f"compute d_{name} all displacement/shear strain time flow {words}")
        asked += moved.of(f"d_{name}").vector()
    lines += [*dump_grains(packing, every), "dump_modify grains first yes", *thermo(every, *asked), "run 60"]
    result = run(Deck(packing, boundary="f f f", body=lines), ranks)
    dumps, table = result.dump("grains.dump"), result.thermo()[-1]
    mass = dumps[0][1]["mass"]
    places = [np.stack([columns[a] for a in "xyz"], axis=1) for _, columns in dumps]
    require(len(places) == 6, f"{len(places)} snapshots")
    dt = float(table[moved.of("d_none")["strain"]][1])
    for name, words in MOVED.items():
        d, words = np.zeros_like(places[0]), words.split()
        mine = in_part(places[0], 0.0) if name == "part" else np.ones(len(mass), dtype=bool)
        many = mine.sum()
        for at in range(1, len(places)):
            u, x = (places[at] - places[at - 1])[mine], 0.5 * (places[at] + places[at - 1])[mine]
            d[mine] += u - mean_motion(words, u, x, mass[mine], dt, edge / 2.0, edge)
            if name == "part":
                mine &= in_part(places[at], at * dt)
            expected = (d[mine] ** 2).mean(axis=0)
            found = [table[moved.of(f"d_{name}")[f"d2_{a}"]][at] for a in "xyz"]
            require_close(found, expected, 1e-9, f"flow {name}, call {at}", expected.max())
            numbers = [table[moved.of(f"d_{name}")[n]][at] for n in ("N", "N_start")]
            require_equal(numbers, [mine.sum(), many], f"flow {name}: grains")
        require(name != "part" or 5 < mine.sum() < many - 2, f"{mine.sum()} of {many} left in the region")


def solid_turns(ranks):
    """A bed that turns like a solid by large angles between two calls has no displacement against the gradient; without
    grains in contact it is moved by a region that turns with the deck's own displace_atoms."""
    packing = Packing((66.0,) * 3, free_grains(np.zeros((3, 3)), 0.0), atom_style="sphere", triclinic=False)
    moved = outputs("displacement/shear").of("d")
    body = [
        "compute d all displacement/shear strain time flow gradient",
        "compute n all displacement/shear strain time flow none",
        *thermo(1, *moved.vector(), outputs("displacement/shear").of("n")["d2_x"]),
        "run 1",
    ]
    for axis, angle in (("0 0 1", 40.0), ("1 2 -1", 70.0), ("1 0 0", -100.0)):
        body += [f"displace_atoms all rotate 33.0 33.0 33.0 {axis} {angle} units box", "run 1"]
    tables = run(Deck(packing, boundary="f f f", body=body), ranks).thermo()
    for table in tables[1:]:
        require(max(table[moved[f"d2_{a}"]][-1] for a in "xyz") < 1e-20, "nothing against the turn")
    require(tables[-1][outputs("displacement/shear").of("n")["d2_x"]][-1] > 10.0, "the bed has turned")


def sheared_flight(ranks):
    """Grains that fly with a box that is sheared through flips: its flow is no displacement, whoever finds it, and with
    `flow none` it is one."""
    rate, edge, every = 8.0, 12.0, 20
    random = np.random.default_rng(11)
    places = 3.0 * np.array(list(np.ndindex(4, 4, 4))) + 1.5
    places[:, [0, 2]] += random.uniform(-0.3, 0.3, (64, 2))  # those of a height keep their distances
    v = np.zeros((64, 3))
    v[:, 0] = rate * (places[:, 1] - edge / 2.0)
    v[:, 2] = random.normal(0.0, 3.0, (4, 4, 1)).repeat(4, axis=2).ravel()  # columns that do not meet
    v[:, 2] += 1.0
    radii = random.choice([0.2, 0.3], 64)
    grains = [Grain(tuple(x), (r,) * 3, velocity=tuple(u)) for x, u, r in zip(places, v, radii)]
    deck = Deck(Packing((edge,) * 3, grains, atom_style="sphere"))
    flows = ("box", "none", f"rate {rate}", "fit", "gradient", "layers 4")
    moved, asked = outputs("displacement/shear"), []
    deck.body = [shear(rate)]
    for k, flow in enumerate(flows):
        deck.body.append(f"compute d{k} all displacement/shear strain time flow {flow}")
        asked += moved.of(f"d{k}").vector()
    deck.body += [*thermo(every, *asked), "run 600"]
    table = run(deck, ranks).thermo()[-1]
    time = table[moved.of("d0")["strain"]]
    require(rate * time[-1] > 1.5, "flips")
    m = radii**3
    for k, flow in enumerate(flows):
        found = np.array([table[moved.of(f"d{k}")[f"d2_{a}"]] for a in "xyz"])
        expected = np.zeros((3, len(time)))
        if flow == "none":
            expected[0] = ((v[:, 0] - np.average(v[:, 0], weights=m)) ** 2).mean() * time**2
        require_close(found[:2], expected[:2], 1e-9, f"flow {flow}: x, y", edge**2)
        if flow in ("box", "none", f"rate {rate}"):  # the others fit noise too
            mean = 0.0 if flow == "box" else np.average(v[:, 2], weights=m)
            expected = ((v[:, 2] - mean) ** 2).mean() * time**2
            require_close(found[2], expected, 1e-9, f"flow {flow}: z", expected.max())


EDGE_OF_PART = 4.0  # grains with a smaller x are in the region


def grains_that_come_and_go(ranks):
    """A group that grows, a region that grains leave and come back to, grains that are deleted."""
    packing = dense_packing(atom_style="sphere", speed=8.0, overlap=-0.05)
    memory, moved = outputs("velocity/memory"), outputs("displacement/shear").of("d")
    lines = [
        "variable strain equal step*1.0",
        "group some id 1:30",
        f"region part block INF {EDGE_OF_PART} INF INF INF INF units box",
        "compute group some velocity/memory component vy strain v_strain every 1.0 lags 4 flow none",
        "compute region all velocity/memory component vy strain v_strain every 1.0 lags 4 flow none region part",
        "compute d some displacement/shear strain v_strain",
        *dump_grains(packing, 1),
        "dump_modify grains first yes",
    ]
    asked = [*moved.vector()]
    for ID in ("group", "region"):
        asked += [*memory.of(ID).vector(), *memory.of(ID).array(range(1, 6))]
    lines += [
        *thermo(1, *asked),
        "run 39",
        "group some id 11:40",
        "run 40",
        "group gone id 1:5",
        "delete_atoms group gone compress no",
        "run 2",
    ]
    result = run(Deck(packing, body=lines), ranks)
    dumps, printed = dict(result.dump("grains.dump")), {}
    for block in result.thermo():
        for at, step in enumerate(block["step"]):
            printed[int(step)] = {name: values[at] for name, values in block.items()}
    for ID in ("group", "region"):
        returned = check_memory(dumps, printed, ID, memory.of(ID))
        require(returned > (0 if ID == "region" else -1), f"{returned} grains came back")
    for step, expected in ((38, (30, 30, 0)), (79, (30, 30, 10)), (81, (25, 30, 10))):
        numbers = [printed[step][moved[name]] for name in ("N", "N_start", "N_other")]
        require_equal(numbers, expected, f"step {step}: followed, at the start, others")


def wrapped(x, length):
    return x - length * np.floor(x / length)


def check_memory(dumps, printed, ID, words):
    """Returns how often a grain came back that had been there before."""
    samples, sums, returned, seen = [], np.zeros((5, 2)), 0, set()
    length = dense_packing(atom_style="sphere", speed=8.0, overlap=-0.05).edges[0]
    for step in range(82):
        columns = dumps[step]
        ids = columns["id"].astype(int)
        if ID == "group":
            mine = np.isin(ids, range(1, 31 if step < 40 else 41))
        else:
            mine = wrapped(columns["x"], length) <= EDGE_OF_PART
        v = columns["vy"][mine] - np.average(columns["vy"][mine], weights=columns["mass"][mine])
        samples.append(dict(zip(ids[mine], v)))
        for grain, now in samples[-1].items():
            for lag in range(5):
                if lag > step or any(grain not in samples[step - k] for k in range(lag + 1)):
                    break
                sums[lag] += now * samples[step - lag][grain], 1.0
        new = set(samples[-1]) - (set(samples[-2]) if step else set())
        returned += len(new & seen)
        seen |= set(samples[-1])
        numbers = [printed[step][words[name]] for name in ("N", "N_new")]
        require_equal(numbers, [len(samples[-1]), len(new)], f"{ID}, step {step}: grains, new ones")
        found = np.array([[printed[step][words[k, c]] for c in ("products", "pairs")] for k in range(1, 6)])
        require_equal(found[:, 1], sums[:, 1], f"{ID}, step {step}: pairs")
        require_close(found[:, 0], sums[:, 0], EXACT, f"{ID}, step {step}: products", np.abs(sums[:, 0]).max())
    return returned


def empty_start(ranks):
    packing = dense_packing(atom_style="sphere")
    lines = [
        "group none initialize",
        "variable strain equal step*1e-3",
        "region far block 900 901 0 1 0 1 units box",
        "compute d none displacement/shear strain v_strain",
        "compute e all displacement/shear strain v_strain flow gradient region far",
        "compute m none velocity/memory strain v_strain every 1e-3 lags 2",
        "fix keep all ave/time 1 1 1 c_d c_m c_e file /dev/null",
        "run 3",
    ]
    output = run(Deck(packing, body=lines), ranks).output
    for words in (
        "compute displacement/shear d: there is no grain in group 'none' at its start",
        "compute displacement/shear e: there is no grain in group 'all' and region 'far' at its start",
        "compute velocity/memory m: there is no grain in the first sample",
    ):
        require_equal(output.count(words), 1, words)


CASES = {
    "mean-flows": mean_flows,
    "solid-rotation": solid_rotation,
    "over-time": over_time,
    "displacements-against-flows": displacements_against_flows,
    "solid-turns": solid_turns,
    "sheared-flight": sheared_flight,
    "correlation-in-a-region": correlation_in_a_region,
    "grains-that-come-and-go": grains_that_come_and_go,
    "empty-start": empty_start,
}

if __name__ == "__main__":
    main(CASES)
