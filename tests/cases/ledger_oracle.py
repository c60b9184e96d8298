# SPDX-License-Identifier: GPL-2.0-or-later
"""Every entry of the energy ledger, in every step, against a ledger written on its own (oracle/ledger.py), for packings
of spheres."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from columns import outputs
from deck import Deck, Material, box_columns, dump_grains, shear, thermo
from oracle.ledger import ENTRIES, STORES, Snapshot, book
from oracle.state import box_of, grains_of
from packing import dense_packing, tilted
from sphere_law import law_of
from run import run

C_LEDGER = outputs("energy/ledger").of("ledger")
F_PRESS = outputs("press/strain").of("press")

STEPS = 60
COLUMNS = (*ENTRIES, *STORES)
RATES = [C_LEDGER[f"{name}_rate"] for name in ENTRIES]
STORED = [C_LEDGER[name] for name in STORES]
# Differences of energies of one step: rounding of the dumped state and of springs followed over all steps, as in
# sphere_law.py.
TOLERANCE = 1e-8


def follows(deck, motion, box_at, frame_at):
    """`box_at(table, step)`: the box that the evaluation of a step saw; `frame_at`: gradient and centre of the step
    after it."""
    deck = replace(deck, extra=f"ledger on {deck.extra}".strip())
    columns = [
        *box_columns(),
        *RATES,
        *STORED,
        C_LEDGER["residual"],
        C_LEDGER["D_t"],
        *([F_PRESS["L_rate"]] if "press" in motion[0] else []),
    ]
    deck.body = [
        *motion,
        "compute ledger all energy/ledger",
        *dump_grains(deck.packing, 1),
        *thermo(1, *columns),
        f"run {STEPS}",
    ]

    def case(ranks):
        result = run(deck, ranks)
        law, table, dt = law_of(deck), result.thermo()[0], deck.dt()
        snapshots = [
            Snapshot(law, grains_of(columns), box_at(table, step), step == 0)
            for step, columns in result.dump("grains.dump")
        ]
        largest = dict.fromkeys(COLUMNS, 0.0)
        end = None
        for step in range(STEPS):
            last, now, frame = snapshots[step], snapshots[step + 1], frame_at(table, step)
            moved, next_end = book(last, now, dt, frame, deck.tangential == "history")
            jump = 0.0 if end is None else last.translation(last.grains.v, last.grains.x, dt, frame) - end
            end = next_end
            stored = {**now.stored(dt), "K_tr": end}
            check_step(table, step + 1, moved, jump, stored, dt, largest)
        require(largest["D_n"] > 0.0 and (deck.tangential != "history" or largest["G_open"] > 0.0), "nothing happened")
        residual = np.abs(table[C_LEDGER["residual"]]).max()
        require(residual <= 1e-12 * sum(stored.values()), f"the residual is {residual}")
        for name in COLUMNS:
            print(f"{name}: largest {largest[name]:.3e}")

    return case


def check_step(table, step, moved, jump, stored, dt, largest):
    found = {name: table[q][step] * dt for name, q in zip(ENTRIES, RATES)}
    scale = max(abs(value) for value in moved.values())
    energy = sum(abs(value) for value in stored.values())
    for name in ENTRIES[4:] + ("W_shear",):
        require_close(found[name], moved[name], TOLERANCE, f"step {step}: {name}", max(scale, 1e-7 * energy))
    between = found["W_box"] + found["W_frame"] + found["W_other"]
    require_close(
        between,
        moved["W_box"] + jump,
        TOLERANCE,
        f"step {step}: work of the box and between steps",
        max(scale, 1e-7 * energy),
    )
    for name, q in zip(STORES, STORED):
        require_close(table[q][step], stored[name], TOLERANCE, f"step {step}: {name}", energy)
    for name, value in {**moved, **stored}.items():
        largest[name] = max(largest[name], abs(value))


def in_simple_shear(rate=0.03, **choices):
    packing = choices.pop("packing", None) or dense_packing(atom_style="sphere", minimum=60, speed=0.8)
    deck = Deck(packing, **choices)

    def frame_at(table, step):
        box = box_of(table, step, rate)
        return box.gradient, box.centre

    return follows(deck, [shear(rate)], lambda table, step: box_of(table, max(step - 1, 0), rate), frame_at)


def under_control(rate=0.03, rest="gain 2e-6 maxrate 10 limit 0.05", **choices):
    packing = choices.pop("packing", None) or dense_packing(atom_style="sphere", minimum=60, speed=0.8)

    def box_at(table, step):
        before = max(step - 1, 0)
        return box_of(table, before, rate, table[F_PRESS["L_rate"]][before])

    def frame_at(table, step):
        box = box_of(table, step, rate, table[F_PRESS["L_rate"]][step])
        return box.gradient, box.centre

    motion = [f"fix press all press/strain axis y target 3e5 shear xy rate {rate} every 1e-3 {rest}"]
    return follows(Deck(packing, **choices), motion, box_at, frame_at)


UNDAMPED = "tangential_damping off"
LOOSE = dict(packing=dense_packing(atom_style="sphere", minimum=60, speed=2.0, overlap=0.001))
CASES = {
    "sheared": in_simple_shear(extra=UNDAMPED),
    "sheared-with-tangential-damping": in_simple_shear(),
    "sheared-slippery": in_simple_shear(extra=UNDAMPED, material=Material(friction=(0.05,))),
    "sheared-frictionless": in_simple_shear(tangential="off"),
    "no-history": in_simple_shear(tangential="no_history"),
    "contacts-open-and-close": in_simple_shear(extra=UNDAMPED, **LOOSE),
    "polydisperse": in_simple_shear(
        extra=UNDAMPED, packing=dense_packing(atom_style="sphere", minimum=60, speed=0.8, sizes=(0.9, 1.0, 1.1))
    ),
    "through-a-flip": under_control(
        0.4, extra=UNDAMPED, packing=tilted(dense_packing(atom_style="sphere", minimum=60, speed=0.8), 0.49)
    ),
    "under-pressure-control": under_control(extra=UNDAMPED),
    "drift-kept": under_control(rest="gain 2e-6 maxrate 10 limit 0.05 momentum no", extra=UNDAMPED),
}

if __name__ == "__main__":
    main(CASES)
