# SPDX-License-Identifier: GPL-2.0-or-later
"""The first evaluation of a run: no spring moves there, and LIGGGHTS does not keep tangential damping to the friction
limit. `setup host` does as LIGGGHTS and is warned of; `setup neutral` keeps the limit, of grains and of walls; measures
say which."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from deck import Deck, Material, dump_grains, dump_local, shear, thermo
from ellipsoid_walls import run_in_folder_with_floor
from grainscope.columns import outputs
from oracle.sphere_law import contacts
from oracle.state import ROW_WIDTH, Box, grains_of, rows_of
from packing import Grain, Packing, dense_packing
from run import run
from sphere_law import law_of

C_EACH = outputs("contact/grain").of("each")
C_LOSS = outputs("dissipation").of("loss")
C_STRESS = outputs("stress/contact").of("stress")

WARNING = "LIGGGHTS does not limit tangential damping"
BOX = Box(np.eye(3) * 1e3, np.zeros(3), np.zeros((3, 3)))
LOSSES = C_LOSS.vector()[:5]  # of contacts between grains
AT_WALLS = [C_LOSS[name] for name in ("P_n_w", "P_t_w", "P_t_damp_w")]
# Both are a handful of operations on numbers that were dumped in full.
ROUNDING = 1e-12
# A repetition begins with the springs that the evaluation has cut to the limit: 1e-12 of the force is between them.
REPEATED = 1e-11


def passing(**choices):
    """Two balls that overlap by 0.004 radii and pass each other, mu = 0.1: gamma_t u is 99 times mu F_n."""
    grains = [Grain((side * 0.998, 0.0, 0.0), velocity=(0.0, -side * 0.4, 0.0)) for side in (-1, 1)]
    packing = Packing((12.0, 12.0, 12.0), grains, atom_style="sphere", origin=(-6.0, -6.0, -6.0), triclinic=False)
    choices.setdefault("material", Material(friction=(0.1,)))
    deck = Deck(packing, boundary="f f f", **choices)
    deck.body = [
        "compute rows all contact/local",
        "compute loss all dissipation mode instantaneous",
        "compute stress all stress/contact",
        "compute each all contact/grain",
        f"compute mobilised all reduce max {C_EACH['mobilisation']}",
        *dump_grains(packing, 1),
        *dump_local("rows", ROW_WIDTH, 1, "rows"),
        *thermo(1, *LOSSES, C_STRESS["sliding"], "c_mobilised"),
    ]
    return deck


def first_row(result, deck):
    """What was found in the first evaluation, and what a law written on its own gives."""
    rows = rows_of(result.dump("rows.dump")[0][1], "rows")
    return rows, contacts(law_of(deck), grains_of(result.dump("grains.dump")[0][1]), BOX, True), result.thermo()[0]


def check_measures(rows, expected, table):
    for name in ("fn", "ft", "sliding", "slip", "mobilisation"):
        require_close(rows[name], expected[name], ROUNDING, name, max(1.0, np.abs(expected[name]).max()))
    speed = np.linalg.norm(expected["ut"])
    damped = float(expected["gamma_t"][0]) * speed**2
    found = [table[q][0] for q in (*LOSSES, C_STRESS["sliding"], "c_mobilised")]
    require_close(found, [0.0, 0.0, damped, 1.0, 1.0, 1.0, expected["mobilisation"][0]], ROUNDING, "measures", damped)


def as_the_host(ranks):
    """To the last bit of pair_style gran; flagged, and said once."""
    deck = passing()
    deck.body += ["run 5", "run 5"]
    result = run(deck, ranks)
    rows, expected, table = first_row(result, deck)
    check_measures(rows, expected, table)
    ratio = expected["mobilisation"][0]
    require(90.0 < ratio < 110.0, f"the force is {ratio} times its limit: not what this is about")
    require(result.output.count(WARNING) == 1, f"warned {result.output.count(WARNING)} times")
    require(
        f"a contact has a tangential force of {ratio:.6g} times its friction limit" in result.output,
        "the warning lacks its value",
    )
    plain = replace(deck, pair="gran", body=[*dump_grains(deck.packing, 1), "run 5", "run 5"])
    require_same_snapshots(result.dump("grains.dump"), run(plain, ranks).dump("grains.dump"), "against pair_style gran")


def neutral(ranks):
    """mu F_n in the first evaluation, and never more."""
    deck = passing(extra="setup neutral")
    deck.body += ["run 10"]
    result = run(deck, ranks)
    rows, expected, table = first_row(result, deck)
    check_measures(rows, expected, table)
    require_close(np.linalg.norm(rows["ft"]), 0.1 * rows["fn"][0], ROUNDING, "tangential force")
    require_close(table["c_mobilised"].max(), 1.0, ROUNDING, "largest mobilisation")
    require(WARNING not in result.output, "warned though the limit is kept")


def repeated_row(ranks):
    """After `run 0` the next run has the same first row."""
    deck = passing(extra="setup neutral")
    deck.body += ["run 0", "run 2"]
    before, after = run(deck, ranks).thermo()
    for name in (*LOSSES, C_STRESS["sliding"], "c_mobilised"):
        require_close(after[name][0], before[name][0], ROUNDING, name)


def beside_a_moving_mesh(order):
    """LIGGGHTS stops a mesh when the fix that moves it is set up, before or after the wall meets it: after `run 0` the
    next run has the same first row all the same,"""

    def case(ranks):
        deck = on_a_wall(0.01, "mesh", "setup neutral")
        mesh, wall = deck.body[:2]
        move = "fix move all move/mesh mesh floor linear 0.3 0.1 0.4"
        fixes = [mesh, move, wall] if order == "move first" else [mesh, wall, move]
        measures = ["compute loss all dissipation mode instantaneous", *thermo(1, *AT_WALLS)]
        deck.body = [*fixes, *measures, "run 5", "velocity all set -5 -2 -0.3", "run 0", "run 0", "run 3"]
        _, first, second, third = run_in_folder_with_floor(deck, ranks).thermo()
        require(first[AT_WALLS[0]][0] > 0.0, "nothing is lost at the mesh: nothing is proved")
        for name in AT_WALLS:
            for later in (second, third):
                require_close(later[name][0], first[name][0], REPEATED, name)

    return case


def when_a_motion_ends(ranks):
    """A mesh whose motion ended is at rest: as one that is moved on by nothing, to the last bit. Only the first
    evaluation, which repeats the last one, has the velocities of the motion."""

    def grains_after(*end):
        deck = on_a_wall(0.5, "mesh", "setup neutral")
        mesh, wall = deck.body[:2]
        move = "fix move all move/mesh mesh floor linear 2.0 0 0"
        measures = ["compute loss all dissipation mode instantaneous", *thermo(1, *AT_WALLS)]
        deck.body = [mesh, move, wall, *measures, "run 5", "run 5", "unfix move", *end]
        deck.body += [*dump_grains(deck.packing, 1), "run 0", "run 20", "run 20"]
        result = run_in_folder_with_floor(deck, ranks)
        _, moved, repeated, *later = result.thermo()
        require(moved[AT_WALLS[1]][-1] > 0.0, "nothing slides on the mesh: nothing is proved")
        for name in AT_WALLS:
            require_close(repeated[name][0], moved[name][-1], REPEATED, name)
            require_close(later[1][name][0], later[0][name][-1], REPEATED, name)
        return result.dump("grains.dump")

    ended = grains_after()
    still = grains_after("fix still all move/mesh mesh floor linear 0 0 0")
    require_same_snapshots(ended, still, "against a mesh that is moved by nothing")


def after_a_change(ranks):
    """Springs are loaded, and the velocities are others: nothing that is remembered holds."""
    deck = passing(extra="setup neutral", material=Material(friction=(0.5,)))
    deck.body += ["run 3", "set atom 1 vz 1.5", "run 3"]
    result = run(deck, ranks)
    require("were changed since the last run" in result.output, "the change was not noticed")
    first = result.thermo()[1]
    require_close(first["c_mobilised"].max(), 1.0, ROUNDING, "largest mobilisation")
    require(first[C_STRESS["sliding"]][0] == 1.0, "the contact is not at its limit: nothing is proved")


def below_the_limit(ranks):
    """Where the limit is far neutral and host are one trajectory, and nothing is said."""
    deck = passing(material=Material(friction=(50.0,)))
    deck.body += ["run 20"]
    ours, neutrals = run(deck, ranks), run(replace(deck, extra="setup neutral"), ranks)
    require(WARNING not in ours.output, "warned though no limit was exceeded")
    require_same_snapshots(neutrals.dump("grains.dump"), ours.dump("grains.dump"), "neutral against host")


def packings(ranks):
    """Contacts across the box and between ranks: no contact of a dense packing is ever beyond its limit in a first
    evaluation."""
    packing = dense_packing(1.5, speed=2.0)
    deck = Deck(packing, surface="ellipsoid", extra="setup neutral", material=Material(friction=(0.05,)))
    deck.body = [
        "compute each all contact/grain",
        "compute rows all contact/local mobilisation",
        "compute most all reduce max c_rows",
        "compute stress all stress/contact",
        shear(0.05),
        *thermo(1, "c_most", C_STRESS["sliding"]),
        "run 0",
        "velocity all set 0 0 0.5 sum yes",
        "set group all omegax 3",
        "run 0",
    ]
    bounded, unbounded = run(deck, ranks).thermo(), run(replace(deck, extra=""), ranks).thermo()
    for ours, hosts in zip(bounded, unbounded):
        require_close(ours["c_most"][0], 1.0, ROUNDING, "largest mobilisation")
        require(hosts["c_most"][0] > 5.0, "the host keeps the limit: nothing is proved")
        require_equal(ours[C_STRESS["sliding"]], hosts[C_STRESS["sliding"]], "sliding fraction")


def on_a_wall(friction, wall, extra):
    """A ball that spins on the floor, pressed into it by 0.004 of its radius."""
    ball = Grain((0.3, 0.2, 0.996), velocity=(0.2, 0.0, 0.0), omega=(0.0, 3.0, 0.0))
    packing = Packing((24.0, 24.0, 24.0), [ball], atom_style="sphere", origin=(-12.0, -12.0, -12.0), triclinic=False)
    deck = Deck(packing, boundary="f f f", extra=extra, material=Material(friction=(friction,)))
    model = f"fix wall all wall/gran {replace(deck, extra='').model()}"
    walls = {
        "plane": [f"{model} primitive type 1 zplane 0.0"],
        "mesh": ["fix floor all mesh/surface file floor.stl type 1", f"{model} mesh n_meshes 1 meshes floor"],
    }[wall]
    deck.body = [*walls, *dump_grains(packing, 1), "run 1"]
    return deck


def spin_on_a_frictionless(wall):
    """It is not touched by damping: spin and sliding stay what they were, to the last bit."""

    def case(ranks):
        kept, lost = (run_in_folder_with_floor(on_a_wall(0.0, wall, extra), ranks) for extra in ("setup neutral", ""))
        for result, changes in ((kept, False), (lost, True)):
            (_, before), (_, after) = result.dump("grains.dump")
            change = max(abs(after[name][0] - before[name][0]) for name in ("vx", "omegay"))
            require(change > 1e-3 if changes else change == 0.0, f"spin or velocity changed by {change}")
        require(
            f"{WARNING} in the first evaluation of a run, and a contact has a tangential force although its "
            "friction is 0" in " ".join(lost.output.split()),
            "the host's damping is not warned of",
        )

    return case


def friction_of(wall):
    """f_x = mu f_z, and the torque that goes with it."""

    def case(ranks):
        kept, lost = (
            run_in_folder_with_floor(on_a_wall(0.1, wall, extra), ranks).dump("grains.dump")[0][1]
            for extra in ("setup neutral", "")
        )
        require_close(abs(kept["fx"]), 0.1 * kept["fz"], ROUNDING, "friction of the wall")
        # The arm is the distance to the contact point, radius less overlap (or less half of it), whichever the host
        # takes for a wall.
        arm = abs(kept["tqy"][0] / kept["fx"][0])
        require(0.99 < arm <= 1.0, f"the arm of the friction is {arm}")
        require_close(lost["fz"], kept["fz"], 0.0, "force on the wall", 1.0)
        require(abs(lost["fx"][0]) > 10.0 * abs(kept["fx"][0]), "the host keeps the limit: nothing is proved")

    return case


CASES = {
    "as-the-host": as_the_host,
    "neutral": neutral,
    "repeated-row": repeated_row,
    "beside-a-mesh-moved-before": beside_a_moving_mesh("move first"),
    "beside-a-mesh-moved-after": beside_a_moving_mesh("wall first"),
    "when-a-motion-ends": when_a_motion_ends,
    "after-a-change": after_a_change,
    "below-the-limit": below_the_limit,
    "packings": packings,
    "spin-on-a-frictionless-plane": spin_on_a_frictionless("plane"),
    "spin-on-a-frictionless-mesh": spin_on_a_frictionless("mesh"),
    "friction-of-a-plane": friction_of("plane"),
    "friction-of-a-mesh": friction_of("mesh"),
}

if __name__ == "__main__":
    main(CASES)
