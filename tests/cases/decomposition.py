# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains on corners of the decomposition, ranks without grains, slices thinner than a grain, boxes two grains wide and
less: as on one rank, or refused with the number."""
from dataclasses import replace
import itertools
import math
import re

import numpy as np

from case import main, require, require_close
from deck import Deck, box_columns, dump_grains, shear, thermo
from everything import RATE, Questions, differences, press
from grainscope.columns import outputs
from packing import SKIN, Grain, Packing, dense_packing, in_the_open, tilted
from refusal import require_refused
from run import attempt, run, tail

C_MOVED = outputs("displacement/shear").of("moved")
C_STRESS = outputs("stress/contact").of("stress")

SUMS = 1e-10  # sums in another order; see rank_sweep.py
GRIDS = {
    1: (),
    2: ("2 1 1", "1 2 1", "1 1 2"),
    3: ("3 1 1", "1 3 1"),
    4: ("2 2 1", "4 1 1", "1 1 4"),
    8: ("2 2 2", "8 1 1", "1 8 1", "1 1 8"),
}
EXTRA = "ledger on tangential_damping off"


def asked(packing, flow, surface="ellipsoid", before=(), steps=5, every=1):
    """A deck that asks everything in each of a few steps."""
    questions = Questions(packing, pressed="press/strain" in flow)
    body = [*before, flow, *questions.defined(), *questions.output(every), f"run {steps}"]
    return questions, Deck(packing, surface=surface, extra=EXTRA, body=body)


def same(packing, ranks, flow=shear(RATE), contacts=1, grids=None, bound=SUMS, **choices):
    """All of GRIDS against one rank; hands back the results by grid."""
    questions, deck = asked(packing, flow, **choices)
    results = {"1 1 1": run(deck)}
    printed = results["1 1 1"].thermo()[-1][C_STRESS["N_c"]]
    require(printed.min() >= contacts, f"contacts {printed}, expected {contacts} at least")
    for grid in grids or GRIDS[ranks]:
        results[grid] = run(replace(deck, processors=grid), ranks)
        found = differences(questions, results[grid], results["1 1 1"])
        name, worst = max(found.items(), key=lambda item: item[1])
        print(f"processors {grid}: worst {worst:.2e} in {name}", flush=True)
        require(worst <= bound, f"processors {grid}: {name} differs by {worst:.3e} of its scale")
    return results


# Corners. All numbers are sums of powers of two, so that the faces between ranks are met exactly, in the tilted box
# too.

EDGE, REACH = 16.0, 1.9375


def clusters(tilt):
    """Seven grains: one exactly on the corner between eight ranks, six on its edges. Eight: one in each of the ranks
    that meet at the corner of the box. And three in a row on a face, the middle one on an edge of the box."""
    half = 0.5 * EDGE
    middle, face = (half + 0.5 * tilt, half, half), 0.5 * tilt
    points = [middle]
    points += [tuple(middle[k] + side * REACH * (k == d) for k in range(3)) for d in range(3) for side in (-1, 1)]
    points += [tuple(0.5 * REACH * side for side in sides) for sides in itertools.product((-1, 1), repeat=3)]
    return [*points, *((face, half, REACH * k) for k in (-1, 0, 1))]


def at_corners(tilt, atom_style="superquadric", shape=(1.0, 1.0, 1.25), shift=0.0):
    random = np.random.default_rng(3)
    grains = []
    for x, y, z in clusters(tilt):
        y_out, z_out = math.floor(y / EDGE), math.floor(z / EDGE)
        x, y, z = x - y_out * tilt, y - y_out * EDGE, z - z_out * EDGE
        x -= EDGE * math.floor((x - tilt * y / EDGE) / EDGE)
        grains.append(
            Grain(
                (x - shift, y, z),
                shape,
                velocity=tuple(0.05 * random.normal(size=3)),
                omega=tuple(0.1 * random.normal(size=3)),
            )
        )
    return Packing((EDGE, EDGE, EDGE), grains, tilt=tilt, atom_style=atom_style)


def on_corners(tilt, **choices):
    def case(ranks):
        results = same(at_corners(tilt, **choices), ranks, contacts=6 + 12 + 2)
        if ranks == 8:
            holders = next(line for line in results["2 2 2"].output.splitlines() if line.startswith("Nlocal:")).split()
            require(int(holders[5]) >= 1, f"a rank of eight around the corner holds no grain: {' '.join(holders)}")

    return case


def arrive_on_the_upper_face(ranks):
    """Grains that are moved onto x = hi to the last bit, where no rank is responsible until they are wrapped: none is
    lost or doubled."""
    packing = at_corners(0.0, shift=1.0)
    packing = replace(
        packing, grains=[replace(g, position=(g.position[0] % EDGE, *g.position[1:])) for g in packing.grains]
    )
    require(any(g.position[0] == EDGE - 1.0 for g in packing.grains), "no grain comes to lie on the face")
    same(packing, ranks, contacts=20, before=["displace_atoms all move 1 0 0 units box"])


def empty_ranks(ranks):
    """A cluster in the middle of a large box: the outer ranks hold no grain."""
    packing = in_the_open(dense_packing(1.5, overlap=0.04, speed=0.05))
    results = same(packing, ranks, contacts=100, grids=("4 1 1",) if ranks == 4 else ("8 1 1", "1 4 2"))
    for grid, result in results.items():
        grains = next(line for line in result.output.splitlines() if line.startswith("Nlocal:")).split()
        require(
            grid == "1 1 1" or grains[5:7] == ["0", "min"], f"processors {grid}: no rank was empty: {' '.join(grains)}"
        )


def migrants(ranks):
    """A lively gas: grains go through several ranks and faces, with all that is remembered of them."""
    packing = dense_packing(1.5, overlap=-0.25, speed=2.0, minimum=200)
    # Collisions at these speeds multiply what rounding does by ten each: 2e-9 seen, and as much on one rank where
    # grains are sorted again.
    results = same(packing, ranks, press(1e3, rate=0.5), contacts=0, bound=1e-7, steps=400, every=100)
    last = results["1 1 1"].thermo()[-1]
    require(last[C_STRESS["N_c"]][-1] > 100, "too few contacts")
    require(last[C_MOVED["d2_z"]][-1] > 2.0, f"grains moved by {last[C_MOVED['d2_z']][-1]} only, in squares")
    travelled = [columns for _, columns in results["1 1 1"].dump("grains.dump")]
    require(
        bool((np.abs(travelled[-1]["x"] - travelled[0]["x"]) > 0.5 * packing.edges[0]).any()),
        "no grain went through a face",
    )


# Narrow boxes

FACTOR = 1.05
NEEDED = 2.0 * (2.0 * FACTOR + SKIN)  # twice the reach: diameter times contact distance factor, and skin
# (The host's bounding sphere of a superquadric is a ten-thousandth larger.)
NEEDED_OF_SUPERQUADRICS = 2.0 * (2.0 * 1.0001 * FACTOR + SKIN)


def three_layers(height, edge_x=4, speed=0.05, atom_style="sphere"):
    """Close-packed layers, three in a box of this height: all ways across the box lead from grain to grain."""
    random = np.random.default_rng(5)
    spacing, rows = 1.98, 4
    grains = []
    for layer, row, k in itertools.product(range(3), range(rows), range(edge_x)):
        x = spacing * (k + 0.5 * (row + layer) + 0.2) % (edge_x * spacing)
        y = spacing * math.sqrt(0.75) * (row + layer / 3.0 + 0.2) % (rows * spacing * math.sqrt(0.75))
        at = np.array([x, y, height * (layer + 0.4) / 3.0]) + 0.02 * random.uniform(-1.0, 1.0, 3)
        grains.append(Grain(tuple(at), velocity=tuple(speed * random.normal(size=3))))
    return Packing((edge_x * spacing, rows * spacing * math.sqrt(0.75), height), grains, atom_style=atom_style)


def just_above(needed, atom_style):
    def case(ranks):
        same(three_layers(needed * (1.0 + 1e-9), atom_style=atom_style), ranks, contacts=100, flow=press(2e5))

    return case


def refused(deck, ranks, axis):
    """Refused with both numbers; what was found is less than what is needed, and by less than the skin: until a list is
    built, the one before is good for it. Hands back the height found."""
    result = attempt(deck, ranks)
    text = " ".join(result.output.split())
    printed = re.search(
        rf"the periodic box must be at least 2 x \(largest diameter x contact distance factor \+ skin\) = "
        rf"{NEEDED:g} high along "
        rf"{axis}, got ([0-9.]+)",
        text,
    )
    require(result.code != 0 and printed is not None, f"not refused; the output ends:\n{tail(result.output)}")
    require(NEEDED - SKIN < float(printed[1]) <= NEEDED, f"refused at {printed[1]}, with {NEEDED:g} needed")
    return float(printed[1])


def just_below(ranks):
    """On whatever grid the host chooses, and on slices along the narrow axis."""
    height = NEEDED * 0.999
    for grid in ("", f"1 1 {ranks}", f"{ranks} 1 1"):
        found = refused(Deck(three_layers(height), body=["run 1"], processors=grid), ranks, "z")
        require_close(found, height, 1e-5, "height found")


def shrinks(*lines):
    """A box that is large enough at first: it runs, and is then refused, not by a hang or a wrong contact."""

    def case(ranks):
        deck = Deck(three_layers(NEEDED * 1.003), extra=EXTRA, body=["run 20"])
        require(run(deck, ranks).code == 0, "refused at once")
        refused(replace(deck, body=["run 20", *lines]), ranks, "z")

    return case


def sheared_too_narrow(ranks):
    """Tilting takes height along the flow: at tilt xy, L_x L_y/sqrt(L_y^2 + xy^2)."""
    packing = three_layers(
        NEEDED * 1.2, edge_x=3
    )  # 5.94: 4.6 at a tilt of 0.82 L_y, and a flip at 0.43 L_y leaves 5.45
    edges = (NEEDED * 1.01, *packing.edges[1:])
    grains = [
        replace(g, position=(g.position[0] * edges[0] / packing.edges[0], *g.position[1:])) for g in packing.grains
    ]
    deck = Deck(replace(packing, edges=edges, grains=grains), body=[shear(2.0), "run 400"])
    require(run(replace(deck, body=["run 1"]), ranks).code == 0, "refused at once")
    refused(deck, ranks, "x")


# Restart files of a box that moves


def beyond_the_box(ranks):
    """A restart file written during a run, when the box has left grains outside that no neighbour list has taken in
    yet: none is lost, and each is where it was, with the velocity of the image that it is."""
    packing = tilted(dense_packing(1.5, speed=0.2), 0.3)
    deck = Deck(packing, surface="ellipsoid", extra=EXTRA)
    flow = press(2e5, rate=0.5)
    steps = 60
    through = run(
        replace(
            deck, body=[flow, *thermo(1, *box_columns()), *dump_grains(packing, 1), "restart 1 state.*", f"run {steps}"]
        ),
        ranks,
    )
    table, tested = through.thermo()[-1], 0
    for step, grains in through.dump("grains.dump")[5:]:
        box = {name: table[name][step] for name in box_columns()}
        outside = _outside(grains, box)
        if not outside or tested == 3:
            continue
        tested += 1
        body = [flow, *thermo(1, "atoms", *box_columns()), *dump_grains(packing, 1), "run 0"]
        again = run(deck.restarted(through.folder / f"state.{step}", body), (ranks, 1, 2)[tested - 1])
        require(
            again.thermo()[-1]["atoms"][0] == len(packing.grains),
            f"step {step}: {again.thermo()[-1]['atoms'][0]} grains were read",
        )
        _same_grains(again.dump("grains.dump")[0][1], grains, box, 0.5)
    require(tested == 3, f"grains were outside in {tested} steps only")


def _fractions(grains, box):
    z = (grains["z"] - box["zlo"]) / box["lz"]
    y = (grains["y"] - box["ylo"]) / box["ly"]
    return np.stack([(grains["x"] - box["xlo"] - box["xy"] * y) / box["lx"], y, z])


def _outside(grains, box):
    fractions = _fractions(grains, box)
    return int(((fractions < 0.0) | (fractions >= 1.0)).any(axis=0).sum())


def _same_grains(found, expected, box, rate):
    turns = np.round(_fractions(found, box) - _fractions(expected, box))
    for name, move in (
        ("x", box["lx"] * turns[0] + box["xy"] * turns[1]),
        ("y", box["ly"] * turns[1]),
        ("z", box["lz"] * turns[2]),
        ("vx", rate * box["ly"] * turns[1]),
        ("vz", 0.0 * turns[0]),
    ):
        require_close(found[name], expected[name] + move, 1e-12, f"{name} of grains beyond the box", 10.0)
    require(bool(turns.any()), "no grain was wrapped")


def cannot_balance(ranks):
    """The host has no command that moves faces between ranks: when it gets one, all of this is to be asked with it."""
    require_refused(Deck(dense_packing(), body=["balance x uniform"]), ranks, "Unknown command: balance")
    require_refused(
        Deck(dense_packing(), body=["fix even all balance 10 1.1 shift x 10 1.1"]),
        ranks,
        'Invalid fix style: "balance"',
    )


CASES = {
    "on-corners": on_corners(0.0),
    "on-corners-of-a-tilted-box": on_corners(8.0),
    "spheres-on-corners-of-a-tilted-box": on_corners(8.0, atom_style="sphere", shape=(1.0, 1.0, 1.0)),
    "arrive-on-the-upper-face": arrive_on_the_upper_face,
    "empty-ranks": empty_ranks,
    "migrants": migrants,
    "just-above-the-least-height": just_above(NEEDED, "sphere"),
    "just-above-the-least-height-of-ellipsoids": just_above(NEEDED_OF_SUPERQUADRICS, "superquadric"),
    "just-below-the-least-height": just_below,
    "shrinks-by-press-strain": shrinks(
        "fix press all press/strain axis z target 1e9 every/step 5 gain 1e-8 maxrate 0.5", "run 2000"
    ),
    "shrinks-by-fix-deform": shrinks("fix squeeze all deform 1 z erate -0.05 remap v", "run 2000"),
    "shrinks-by-change-box": shrinks("change_box all z scale 0.99 remap units box", "run 1"),
    "sheared-too-narrow": sheared_too_narrow,
    "restart-of-grains-beyond-the-box": beyond_the_box,
    "host-cannot-balance": cannot_balance,
}

if __name__ == "__main__":
    main(CASES)
