# SPDX-License-Identifier: GPL-2.0-or-later
"""Every entry of the energy ledger, in every step, against a ledger written on its own (oracle/ledger.py), for packings
of spheres."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from deck import Deck, Material, box_columns, dump_grains, shear, thermo
from grainscope.columns import outputs
from oracle.ledger import AXES, ENTRIES, STORES, Snapshot, book, carried
from oracle.state import box_of, grains_of
from packing import dense_packing, tilted
from sphere_law import law_of
from run import run

C_LEDGER = outputs("energy/ledger").of("ledger")
F_PRESS = outputs("press/strain").of("press")

STEPS = 30
COLUMNS = (*ENTRIES, *AXES, *STORES)
RATES = [C_LEDGER[f"{name}_rate"] for name in (*ENTRIES, *AXES)]
STORED = [C_LEDGER[name] for name in STORES]
# Differences of energies of one step: rounding of the dumped state and of springs followed over all steps, as in
# sphere_law.py.
TOLERANCE = 1e-8


def follows(deck, motion, box_at, frame_at):
    """`box_at(table, step)`: the box that the evaluation of a step saw; `frame_at`: that of the step after it."""
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
        end, before = None, None
        for step in range(STEPS):
            last, now, box = snapshots[step], snapshots[step + 1], frame_at(table, step)
            moved, next_end = book(last, now, dt, (box.gradient, box.centre), deck.tangential == "history")
            if before:
                book_between(moved, last, dt, end, before, box)
            end, before = next_end, box
            stored = {**now.stored(dt), "K_tr": end.sum()}
            check_step(table, step + 1, moved, stored, dt, largest)
        require(largest["D_n"] > 0.0 and (deck.tangential != "history" or largest["G_open"] > 0.0), "nothing happened")
        residual = np.abs(table[C_LEDGER["residual"]]).max()
        require(residual <= 1e-12 * sum(stored.values()), f"the residual is {residual}")
        for name in COLUMNS:
            print(f"{name}: largest {largest[name]:.3e}")

    return case


def book_between(moved, last, dt, end, before, after):
    """Grains as they are when a step begins, in three frames: that of the step before, that with longer edges, and the
    new one; `end`: their kinetic energy along x, y, z as that step left it."""
    frames = ((before.gradient, before.centre), carried(before, after), (after.gradient, after.centre))
    old, stretched, new = (last.translation(last.grains.v, last.grains.x, dt, frame) for frame in frames)
    moved["W_other"] += (old - end).sum()
    moved["W_box"] += (stretched - old).sum()
    moved["W_frame"] += (new - stretched).sum()
    for name, change in zip(AXES, stretched - old):
        moved[name] += change


def check_step(table, step, moved, stored, dt, largest):
    found = {name: table[q][step] * dt for name, q in zip((*ENTRIES, *AXES), RATES)}
    scale = max(abs(value) for value in moved.values())
    energy = sum(abs(value) for value in stored.values())
    for name in found:
        require_close(found[name], moved[name], TOLERANCE, f"step {step}: {name}", max(scale, 1e-7 * energy))
    axes = sum(found[name] for name in AXES)
    require_close(axes, found["W_box"], 1e-14, f"step {step}: W_box by axis", energy)
    for name, q in zip(STORES, STORED):
        require_close(table[q][step], stored[name], TOLERANCE, f"step {step}: {name}", energy)
    for name, value in {**moved, **stored}.items():
        largest[name] = max(largest[name], abs(value))


def in_simple_shear(rate=0.03, **choices):
    packing = choices.pop("packing", None) or dense_packing(atom_style="sphere", minimum=60, speed=0.8)
    deck = Deck(packing, **choices)

    return follows(
        deck,
        [shear(rate)],
        lambda table, step: box_of(table, max(step - 1, 0), rate),
        lambda table, step: box_of(table, step, rate),
    )


def in_a_box_of_three_rates(rates=(0.05, -0.08, 0.02), tilt=0.0, **choices):
    """Each edge at a speed of its own, rates of the first length; `tilt`: the speed of xy, of the first L_y."""
    packing = choices.pop("packing", None) or dense_packing(atom_style="sphere", minimum=60, speed=0.8)
    first = np.array(packing.edges)

    def frame_at(table, step):
        box = box_of(table, step)
        np.fill_diagonal(box.rate, np.array(rates) * first)
        box.rate[0, 1] = tilt * first[1]
        return box

    words = " ".join(f"{axis} erate {rate}" for axis, rate in zip("xyz", rates))
    tilting = f" xy erate {tilt}" if tilt else ""
    return follows(
        Deck(packing, **choices),
        [f"fix stretch all deform 1 {words}{tilting} remap v"],
        lambda table, step: frame_at(table, max(step - 1, 0)),
        frame_at,
    )


def under_control(rate=0.03, rest="gain 2e-6 maxrate 10 limit 0.05", **choices):
    packing = choices.pop("packing", None) or dense_packing(atom_style="sphere", minimum=60, speed=0.8)

    def box_at(table, step):
        before = max(step - 1, 0)
        return box_of(table, before, rate, table[F_PRESS["L_rate"]][before])

    def frame_at(table, step):
        return box_of(table, step, rate, table[F_PRESS["L_rate"]][step])

    motion = [f"fix press all press/strain axis y target 3e5 shear xy rate {rate} every 1e-3 {rest}"]
    return follows(Deck(packing, **choices), motion, box_at, frame_at)


UNDAMPED = "tangential_damping off"
LEVEL = "time_level synchronized"
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
    "three-rates": in_a_box_of_three_rates(extra=UNDAMPED),
    "three-rates-and-shear": in_a_box_of_three_rates(
        tilt=0.3, extra=UNDAMPED, packing=tilted(dense_packing(atom_style="sphere", minimum=60, speed=0.8), 0.2)
    ),
    "synchronized": in_simple_shear(extra=f"{LEVEL} {UNDAMPED}"),
    "synchronized-damped": in_simple_shear(
        extra=LEVEL, packing=dense_packing(atom_style="sphere", minimum=60, speed=0.8, sizes=(0.9, 1.0, 1.1))
    ),
    "synchronized-no-history": in_simple_shear(extra=LEVEL, tangential="no_history"),
    "synchronized-open-and-close": in_simple_shear(extra=f"{LEVEL} {UNDAMPED}", **LOOSE),
    "synchronized-under-pressure-control": under_control(extra=f"{LEVEL} {UNDAMPED}"),
    "drift-kept": under_control(rest="gain 2e-6 maxrate 10 limit 0.05 momentum no", extra=UNDAMPED),
}

if __name__ == "__main__":
    main(CASES)
