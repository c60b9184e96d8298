# SPDX-License-Identifier: GPL-2.0-or-later
"""Every row of compute contact/local, and every dissipation entry, from a contact law written on its own."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from deck import POISSON, Deck, Material, box_columns, dump_grains, dump_local, shear, thermo
from grainscope.columns import outputs
from oracle.sphere_law import Law, contacts
from oracle.state import ROW_WIDTH, box_of, grains_of, rows_of
from packing import dense_packing
from run import run

F_PRESS = outputs("press/strain").of("press")

STEPS = 40
# Spring, overlap and velocities carry the round-off of 40 steps and of differences of positions 10 times as large.
TOLERANCE = 1e-9


def law_of(deck):
    types = deck.packing.types

    def pairs(values):
        return np.array(values if len(values) == types * types else values * (types * types)).reshape(types, types)

    young = np.array(deck.material.young if len(deck.material.young) == types else deck.material.young * types)
    return Law(
        young,
        POISSON,
        pairs(deck.material.restitution),
        pairs(deck.material.friction),
        deck.dt(),
        deck.tangential,
        "tangential_damping off" not in deck.extra,
        "limitForce on" in deck.extra,
        deck.cohesion,
        pairs(deck.material.cohesion),
        "tangential_reduce on" in deck.extra,
        "setup neutral" in deck.extra,
        "time_level synchronized" in deck.extra,
    )


def ordered(rows):
    order = np.lexsort((*rows["image"].T, rows["id"][:, 1], rows["id"][:, 0]))
    return {name: values[order] for name, values in rows.items()}


def follows_the_law(deck, motion, box_at):
    """`motion`: the fix that moves the box; `box_at(table, step)`: the box that the force evaluation of a step saw."""
    quantities = [word for ID in ("now", "loss") for word in outputs("dissipation").of(ID).vector()[:5]]
    deck = replace(
        deck,
        body=[
            *motion,
            "compute rows all contact/local",
            "compute now all dissipation mode instantaneous",
            "compute loss all dissipation",
            *dump_grains(deck.packing, 1),
            *dump_local("rows", ROW_WIDTH, 1, "rows"),
        ],
    )
    columns = [*box_columns(), *quantities, *([F_PRESS["L_rate"]] if "press" in motion[0] else [])]
    deck.body += [*thermo(1, *columns), f"run {STEPS}"]

    def case(ranks):
        result = run(deck, ranks)
        law, table, slid = law_of(deck), result.thermo()[0], 0
        for (step, columns), (_, dumped) in zip(result.dump("grains.dump"), result.dump("rows.dump")):
            expected = ordered(contacts(law, grains_of(columns), box_at(table, step), step == 0))
            check_rows(rows_of(dumped, "rows"), expected, step)
            check_powers(expected, [table[q][step] for q in quantities], deck.dt(), step)
            slid += int(expected["sliding"].sum())
        require(
            F_PRESS["L_rate"] not in table or np.ptp(table[F_PRESS["L_rate"]]) > 0.01, "the box length did not change"
        )
        require(deck.tangential == "off" or slid > STEPS, f"only {slid} sliding contacts")

    return case


def check_rows(found, expected, step):
    require(np.array_equal(found["id"], expected["id"]), f"step {step}: other contacts")
    force = float(np.abs(expected["force"]).max())
    speed = float(max(np.abs(expected["ut"]).max(), np.abs(expected["un"]).max()))
    scales = {
        "sliding": 1.0,
        "slip": 1e-3,
        "overlap": 1.0,
        "ut": speed,
        "un": speed,
        "mobilisation": max(1.0, float(expected["mobilisation"].max())),  # over a limit that may be nearly 0
        **{name: force for name in ("ft", "fn_damping", "fn", "force")},
    }
    for name in expected.keys() & found.keys():
        require_close(found[name], expected[name], TOLERANCE, f"step {step}: {name}", scales.get(name))


def in_simple_shear(deck, rate=0.03):
    return follows_the_law(deck, [shear(rate)], lambda table, step: box_of(table, max(step - 1, 0), rate))


def under_control(deck, rate=0.03):
    """Sheared, compressed and driven by fix press/strain: images move with both rates."""
    motion = [
        f"fix press all press/strain axis y target 3e5 shear xy rate {rate} every 1e-3 gain 2e-6 maxrate 10 limit 0.05"
    ]

    def box_at(table, step):
        before = max(step - 1, 0)
        return box_of(table, before, rate, table[F_PRESS["L_rate"]][before])

    return follows_the_law(deck, motion, box_at)


def check_powers(rows, found, dt, step):
    cut = rows["cut"] > 0
    normal = -np.sum(rows["fn_damping"] * rows["un"])
    rubbing = -np.sum(np.einsum("ca,ca->c", rows["ft"], rows["ut"])[cut])
    damping = np.sum(rows["gamma_t"] * np.einsum("ca,ca->c", rows["ut"], rows["ut"]))
    scale = max(abs(normal), abs(rubbing), abs(damping))
    require_close(found[:3], [normal, rubbing, damping], TOLERANCE, f"step {step}: instantaneous powers", scale)
    friction = np.sum(np.linalg.norm(rows["ft"], axis=1) * rows["slip"]) / dt
    # slip/dt: the round-off of a spring over a time step.
    require_close(found[6], friction, 1e-7, f"step {step}: friction of the step", max(abs(friction), scale))


def spheres(**choices):
    packing = choices.pop("packing", None) or dense_packing(atom_style="sphere", minimum=60, speed=0.8)
    return Deck(packing, **choices)


TWO_TYPES = {
    "packing": dense_packing(atom_style="sphere", minimum=60, types=2, sizes=(0.9, 1.0, 1.1), overlap=0.053, speed=0.8),
    "material": Material(young=(5e6, 2e7), restitution=(0.3, 0.5, 0.5, 0.8), friction=(0.05, 0.2, 0.2, 0.9)),
}
STICKY = Material(cohesion=(1e5,))  # about as strong as the repulsion
CASES = {
    name: in_simple_shear(spheres(**choices))
    for name, choices in {
        "history": {},
        "history-undamped": {"extra": "tangential_damping off"},
        "no-history": {"tangential": "no_history"},
        "frictionless": {"tangential": "off"},
        "limit-force": {"extra": "limitForce on", "material": Material(restitution=(0.1,))},
        "slippery": {"material": Material(friction=(0.01,), restitution=(0.1,))},
        "two-types": TWO_TYPES,
        "sjkr": {"cohesion": "sjkr", "material": STICKY},
        "sjkr2": {"cohesion": "sjkr2", "material": STICKY},
        "sjkr-reduces-friction": {"cohesion": "sjkr", "material": STICKY, "extra": "tangential_reduce on"},
        "sjkr-no-history": {"cohesion": "sjkr", "material": STICKY, "tangential": "no_history"},
        "sjkr-limit-force": {
            "cohesion": "sjkr",
            "material": replace(STICKY, restitution=(0.1,)),
            "extra": "limitForce on tangential_reduce on",
        },
        "neutral": {"extra": "setup neutral"},
        "neutral-slippery": {"material": Material(friction=(0.01,), restitution=(0.1,)), "extra": "setup neutral"},
        "neutral-two-types": {**TWO_TYPES, "extra": "setup neutral"},
        "synchronized": {"extra": "time_level synchronized"},
        "synchronized-no-history": {"extra": "time_level synchronized", "tangential": "no_history"},
        "synchronized-two-types": {**TWO_TYPES, "extra": "time_level synchronized"},
    }.items()
}
CASES["under-pressure-control"] = under_control(spheres())
CASES["sheared-backward"] = in_simple_shear(spheres(), -0.03)

if __name__ == "__main__":
    main(CASES)
