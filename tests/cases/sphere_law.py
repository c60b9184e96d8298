# SPDX-License-Identifier: GPL-2.0-or-later
"""Every row of compute contact/local, and every dissipation entry, from a contact law written on its own."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from deck import POISSON, Deck, Material, box_columns, dump_grains, dump_local, shear, thermo
from oracle.sphere_law import Law, contacts
from oracle.state import ROW_WIDTH, box_of, grains_of, rows_of
from packing import dense_packing
from run import run

STEPS = 40
# Spring, overlap and velocities carry the round-off of 40 steps and of differences of positions 10 times as large.
TOLERANCE = 1e-9


def law_of(deck):
    types = deck.packing.types

    def pairs(values):
        return np.array(values if len(values) == types * types else values * (types * types)).reshape(types, types)

    young = np.array(deck.material.young if len(deck.material.young) == types else deck.material.young * types)
    return Law(young, POISSON, pairs(deck.material.restitution), pairs(deck.material.friction), deck.dt(), deck.tangential,
               "tangential_damping off" not in deck.extra)


def ordered(rows):
    order = np.lexsort((*rows["image"].T, rows["id"][:, 1], rows["id"][:, 0]))
    return {name: values[order] for name, values in rows.items()}


def follows_the_law(deck, rate):
    quantities = [f"c_{c}[{k}]" for c in ("now", "loss") for k in range(1, 6)]
    deck = replace(deck, body=[shear(rate), "compute rows all contact/local", "compute now all dissipation mode instantaneous",
                               "compute loss all dissipation", *thermo(1, *box_columns(), *quantities),
                               *dump_grains(deck.packing, 1), *dump_local("rows", ROW_WIDTH, 1, "rows"), f"run {STEPS}"])

    def case(ranks):
        result = run(deck, ranks)
        law, table, slid = law_of(deck), result.thermo()[0], 0
        for (step, columns), (_, dumped) in zip(result.dump("grains.dump"), result.dump("rows.dump")):
            grains, box = grains_of(columns), box_of(table, max(step - 1, 0), rate)
            expected, found = ordered(contacts(law, grains, box, step == 0)), rows_of(dumped, "rows")
            require(np.array_equal(found["id"], expected["id"]), f"step {step}: other contacts")
            for name in expected.keys() & found.keys():
                scale = {"sliding": 1.0, "slip": 1e-3, "overlap": 1.0}.get(name)
                if name in ("ft", "fn_damping", "fn", "force"):
                    scale = float(np.abs(expected["force"]).max())
                if name in ("ut", "un"):
                    scale = float(max(np.abs(expected["ut"]).max(), np.abs(expected["un"]).max()))
                require_close(found[name], expected[name], TOLERANCE, f"step {step}: {name}", scale)
            slid += int(expected["sliding"].sum())
            check_powers(expected, [table[q][step] for q in quantities], deck.dt(), step)
        if deck.tangential != "off":
            require(slid > STEPS, f"only {slid} sliding contacts")
    return case


def check_powers(rows, found, dt, step):
    sliding = rows["sliding"] > 0
    normal = -np.sum(rows["fn_damping"] * rows["un"])
    rubbing = -np.sum(np.einsum("ca,ca->c", rows["ft"], rows["ut"])[sliding])
    damping = np.sum((rows["gamma_t"] * np.einsum("ca,ca->c", rows["ut"], rows["ut"]))[~sliding])
    scale = max(abs(normal), abs(rubbing), abs(damping))
    require_close(found[:3], [normal, rubbing, damping], TOLERANCE, f"step {step}: instantaneous powers", scale)
    friction = np.sum(np.linalg.norm(rows["ft"], axis=1) * rows["slip"]) / dt
    # slip/dt: the round-off of a spring over a time step.
    require_close(found[6], friction, 1e-7, f"step {step}: friction of the step", max(abs(friction), scale))


def spheres(**choices):
    packing = choices.pop("packing", None) or dense_packing(atom_style="sphere", minimum=60, speed=0.8)
    return Deck(packing, **choices)


TWO_TYPES = {"packing": dense_packing(atom_style="sphere", minimum=60, types=2, sizes=(0.9, 1.0, 1.1), overlap=0.053, speed=0.8),
             "material": Material(young=(5e6, 2e7), restitution=(0.3, 0.5, 0.5, 0.8), friction=(0.05, 0.2, 0.2, 0.9))}
CASES = {name: follows_the_law(spheres(**choices), 0.03) for name, choices in {
    "history": {},
    "history-undamped": {"extra": "tangential_damping off"},
    "no-history": {"tangential": "no_history"},
    "frictionless": {"tangential": "off"},
    "slippery": {"material": Material(friction=(0.01,), restitution=(0.1,))},
    "two-types": TWO_TYPES,
}.items()}

if __name__ == "__main__":
    main(CASES)
