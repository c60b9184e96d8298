# SPDX-License-Identifier: GPL-2.0-or-later
"""What the computes say against the same quantities from the dumps, by tests/oracle."""
from dataclasses import dataclass, replace

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, Material, box_columns, dump_grains, dump_local, shear, thermo
from grainscope.columns import outputs
from oracle import measures
from oracle.state import ROW_WIDTH, box_of, chosen_rows, grains_of, rows_of
from packing import dense_packing, in_the_open, tilted
from run import run

EVERY, STEPS = 5, 20

# Sums of some hundred terms in double precision.
EXACT = 1e-10
# A contact across a periodic face, or between ranks, is evaluated by both owners; the host's solver for non-spheres
# stops at about 1e-7, so that the two evaluations (averaged by the computes, one of them in the row) differ by that
# much.
TWO_SIDED = 2e-6


COMPUTES = {
    "stress": "stress/contact",
    "now": "dissipation mode instantaneous",
    "loss": "dissipation mode step",
    "order": "nematic",
}


def vector(name):
    return outputs(COMPUTES[name].split()[0]).of(name).vector()


def watched(deck, group="all"):
    """The deck with every compute on `group` in thermo, and with dumps of grains, of all contacts and of the
    group's."""
    computes = [f"compute {name} {group} {command}" for name, command in COMPUTES.items()]
    quantities = [q for name in COMPUTES for q in (f"c_{name}", *vector(name))]
    return replace(
        deck,
        body=[
            *deck.body,
            *computes,
            "compute rows all contact/local",
            f"compute own {group} contact/local",
            *thermo(1, *box_columns(), *quantities),
            *dump_grains(deck.packing, EVERY),
            *dump_local("rows", ROW_WIDTH, EVERY, "rows"),
            *dump_local("own", ROW_WIDTH, EVERY, "own"),
            f"run {STEPS}",
        ],
    )


@dataclass
class Moment:
    """One step of a run: what the computes gave, and what the oracle starts from."""

    printed: dict
    grains: object
    rows: dict
    box: object

    def vector(self, name):
        return np.array([self.printed[q] for q in vector(name)])


def within(rows, low, high):
    """The rows whose grains all have IDs from `low` to `high`; a wall has none."""
    inside = (((rows["id"] >= low) & (rows["id"] <= high)) | (rows["id"] == 0)).all(axis=1)
    return {name: values[inside] for name, values in rows.items()}


def moments(result, low, high, rate=0.0):
    table = result.thermo()[0]
    for (step, columns), (_, every), (_, own) in zip(*map(result.dump, ("grains.dump", "rows.dump", "own.dump"))):
        rows = within(rows_of(every, "rows"), low, high)
        for name, values in rows_of(own, "own").items():
            require_equal(values, rows[name], f"step {step}: contact/local of the group, {name}")
        # The force evaluation of a step saw the box that the end of the step before had left.
        box = box_of(table, max(step - 1, 0), rate)
        yield Moment({name: values[step] for name, values in table.items()}, grains_of(columns), rows, box)


def check_stress(moment, chosen, tolerance, softest=5e6):
    shape = moment.grains.shape
    flattest = 1.0 if shape is None else float(min(s[0] / s[1] for s in map(sorted, shape[chosen])))
    expected = measures.stress_vector(moment.rows, moment.grains, moment.box, chosen, softest, flattest)
    found = moment.vector("stress")
    for name, part in (
        ("total", slice(0, 7)),
        ("normal", slice(7, 13)),
        ("tangential", slice(13, 19)),
        ("kinetic", slice(19, 25)),
        ("P", slice(25, 26)),
        ("ratios", slice(26, 29)),
        ("contacts, Z", slice(29, 31)),
        ("sliding", slice(31, 32)),
        ("mean overlap", slice(32, 33)),
        ("largest overlap", slice(33, 34)),
        ("kappa", slice(34, 35)),
        ("contacts with walls", slice(35, 36)),
    ):
        scale = max(float(np.abs(expected[part]).max()), 1e-300)
        if name in ("tangential", "ratios"):
            scale = max(scale, 1e-3 * float(np.abs(expected[:7]).max())) if name == "tangential" else max(scale, 1e-3)
        require_close(found[part], expected[part], tolerance, f"stress/contact {name}", scale)
    require_close(moment.printed["c_stress"], expected[25], tolerance, "stress/contact scalar")


def check_dissipation(moment, tolerance, dt):
    for walls, first in (("no", 0), ("only", 5)):
        rows = chosen_rows(moment.rows, walls)
        normal, friction = measures.dissipation_instantaneous(rows)
        contacts, sliding = len(rows["sliding"]), rows["sliding"].sum()
        scale = max(abs(normal), abs(friction), 1e-300)
        now, loss = (moment.vector(name)[first : first + 5] for name in ("now", "loss"))
        require_close(now[:2], [normal, friction], tolerance, "dissipation, instantaneous", scale)
        require_close(now[3:], [contacts, sliding], 0.0, "dissipation, contacts", 1.0)
        if walls == "no":
            normal = measures.normal_loss_of_step(rows, moment.grains, moment.box)
        else:
            normal = measures.wall_loss_of_step(rows, moment.grains, np.zeros(3), measures.normal_damping(rows))
        friction = measures.friction_of_step(rows, dt)
        scale = max(abs(normal), abs(friction), 1e-300)
        require_close(loss[:2], [normal, friction], tolerance, "dissipation of the step", scale)
    powers = moment.vector("loss")[[0, 1, 2, 5, 6, 7]]
    scale = max(float(np.abs(powers).max()), 1e-300)
    require_close(moment.printed["c_loss"], powers.sum(), 1e-14, "dissipation scalar", scale)


def check_order(moment, chosen):
    found = moment.vector("order")
    if moment.grains.shape is None:
        require_close(found[12:15], moment.grains.omega[chosen].mean(axis=0), EXACT, "mean angular velocity")
        return
    order = measures.nematic(moment.grains, chosen)
    require_close(found[:6], order["q"], EXACT, "Q", 1.0)
    require_close(moment.printed["c_order"], order["s2"], EXACT, "S2", 1.0)
    require_close(abs(found[6:9] @ order["director"]), 1.0 if order["with_axis"] else 0.0, 1e-8, "director", 1.0)
    require_close(found[[9, 10]], [order["biaxiality"], order["theta"]], EXACT, "biaxiality, theta_x", 1.0)
    require_close(found[12:15], order["spin"], EXACT, "mean angular velocity")
    require_close(found[15:17], [order["with_axis"], order["with_theta"]], 0.0, "grains counted", 1.0)
    require_close(found[17:20], order["eigenvalues"], EXACT, "eigenvalues", 1.0)


def check_force_balance(moment, tolerance):
    """The rows' forces add up to the force on each grain."""
    total = np.zeros_like(moment.grains.force)
    np.add.at(total, moment.grains.index(moment.rows["id"][:, 0]), moment.rows["force"])
    between = chosen_rows(moment.rows, "no")
    np.add.at(total, moment.grains.index(between["id"][:, 1]), -between["force"])
    require_close(
        total, moment.grains.force, tolerance, "rows' forces per grain", float(np.abs(moment.rows["force"]).max())
    )


def agrees(deck, group="", rate=0.0, balance=True, softest=5e6, fewest=1.0, check=None):
    """`group`: a LIGGGHTS `id` range, empty for all. `fewest`: contacts per grain that must be there, to prove
    something."""
    two_sided = deck.packing.atom_style == "superquadric"

    def case(ranks):
        tolerance = TWO_SIDED if two_sided and (ranks > 1 or deck.packing.origin == (0.0, 0.0, 0.0)) else EXACT
        start = [f"group chosen id {group}"] if group else ["group chosen union all"]
        result = run(watched(replace(deck, body=[*start, *deck.body]), "chosen"), ranks)
        count = 0
        low, high = map(int, group.split(":")) if group else (1, len(deck.packing.grains))
        for moment in moments(result, low, high, rate):
            chosen = (moment.grains.ids >= low) & (moment.grains.ids <= high)
            require(len(moment.rows["fn"]) >= fewest * chosen.sum(), f"only {len(moment.rows['fn'])} contacts")
            check_stress(moment, chosen, tolerance, softest)
            check_dissipation(moment, tolerance, deck.dt())
            check_order(moment, chosen)
            if balance:
                # 1e-12: a dozen terms.
                check_force_balance(moment, 1e-12 if tolerance == EXACT else tolerance)
            count += 1
        require(count == STEPS // EVERY + 1, f"{count} snapshots")
        if check:
            check(result)

    return case


def undamped(packing, **choices):
    """The rows do not hold the tangential damping coefficient: those parts are compared where it is off, and by
    contact_law.py."""
    return Deck(packing, extra="tangential_damping off", **choices)


def flipping(alpha, **choices):
    """Sheared through a flip of the box, half-way through the run."""
    deck = undamped(tilted(dense_packing(alpha, **choices), 0.499))
    lx, ly, _ = deck.packing.edges
    rate = 0.002 * lx / ly / (STEPS * deck.dt())
    deck.body = [shear(rate)]

    def flipped(result):
        tilt = result.thermo()[0]["xy"]
        require(tilt[0] > 0.0 > tilt[-1], f"no flip: the tilt went from {tilt[0]} to {tilt[-1]}")

    return agrees(deck, rate=rate, check=flipped)


def cluster(alpha, **choices):
    return in_the_open(dense_packing(alpha, speed=0.1, **{"overlap": 0.05, **choices}))


def walled():
    packing = replace(dense_packing(atom_style="sphere"), triclinic=False)
    deck = undamped(packing, boundary="p p f")
    wall = "wall/gran model hertz tangential history primitive type 1 zplane"
    low, high = 0.1, packing.edges[2] - 0.1
    deck.body = [f"fix floor all {wall} {low}", f"fix ceiling all {wall} {high}"]
    return deck


TWO_MATERIALS = Material(young=(5e6, 2e7), restitution=(0.3, 0.5, 0.5, 0.8), friction=(0.05, 0.2, 0.2, 0.9))
CASES = {
    "spheres": agrees(undamped(dense_packing(atom_style="sphere"))),
    "spheres-in-the-open": agrees(undamped(cluster(1.0, atom_style="sphere"))),
    **{f"spheroid-{alpha:g}-in-the-open": agrees(undamped(cluster(alpha))) for alpha in (0.33, 1.5, 3.0)},
    "spheroid-1.5": agrees(undamped(dense_packing(1.5))),
    "spheres-through-a-flip": flipping(1.0, atom_style="sphere"),
    "spheroids-through-a-flip": flipping(1.5),
    "polydisperse": agrees(undamped(cluster(1.5, sizes=(0.8, 1.0, 1.2), overlap=0.1))),
    "two-types": agrees(undamped(cluster(1.5, types=2), material=TWO_MATERIALS)),
    "frictionless": agrees(undamped(cluster(1.5), tangential="off")),
    "no-history": agrees(undamped(cluster(1.5), tangential="no_history")),
    "subgroup": agrees(undamped(cluster(1.5)), group="20:80", balance=False, fewest=0.5),
    "group-of-one": agrees(undamped(cluster(1.5)), group="20:20", balance=False, fewest=0.0),
    "walls": agrees(walled(), fewest=0.5),
}

if __name__ == "__main__":
    main(CASES)
