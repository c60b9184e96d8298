# SPDX-License-Identifier: GPL-2.0-or-later
"""fix press/strain: shear like fix deform, the controller's recursion step by step, restarts, ranks, targets at the
edge."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_same_snapshots
from deck import POISSON, YOUNG, Deck, box_columns, dump_grains, number, thermo
from grainscope.columns import outputs
from oracle.sphere_law import Law, contacts
from oracle.state import box_of, grains_of
from packing import dense_packing, tilted
from run import run

F_PRESS = outputs("press/strain").of("press")

STATE = ["f_press", *F_PRESS.vector()]
STRAIN, TARGET, NOW, LENGTH, VELOCITY, INPUTS, CLIPPED, ERROR = STATE[1:9]


def press(target, rate=0.05, every="every 1e-3", rest="", axis="y", name="press"):
    plane = f"shear xy rate {number(rate)} " if rate else ""
    return f"fix {name} all press/strain axis {axis} target {target} {plane}{every} {rest}"


def controlled(line, steps, packing=None, columns=(), **choices):
    deck = Deck(packing or dense_packing(atom_style="sphere"), **choices)
    deck.body = [line, *thermo(1, *STATE, *box_columns(), *columns), *dump_grains(deck.packing, steps), f"run {steps}"]
    return deck


def same_as_fix_deform(packing, plane, strain, ranks):
    """With no gain: the same trajectory as fix deform <plane> erate, through a flip."""
    steps = 300
    deck = Deck(packing)
    rate = number(strain / (steps * deck.dt()))
    output = [*thermo(1, plane), *dump_grains(packing, 50), f"run {steps}"]
    host = run(replace(deck, body=[f"fix shear all deform 1 {plane} erate {rate} remap v", *output]), ranks)
    line = f"fix press all press/strain axis y target 1 shear {plane} rate {rate} every 1e-3 gain 0 momentum no"
    ours = run(replace(deck, body=[line, *output]), ranks)
    tilt = host.thermo()[0][plane]
    require(np.diff(tilt).min() < 0.0 < np.diff(tilt).max(), f"no flip: tilt {tilt[0]} to {tilt[-1]}")
    require_close(ours.thermo()[0][plane], tilt, 1e-12, "tilt")
    for (step, found), (_, expected) in zip(ours.dump("grains.dump"), host.dump("grains.dump")):
        for name in ("x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"):
            # 1e-10: tilts differ by ulps (a sum here, a straight line there); the packing is chaotic.
            require_close(
                found[name], expected[name], 1e-10, f"step {step}, {name}", max(1.0, np.abs(expected[name]).max())
            )


def shears_as_fix_deform(direction):
    """Dense, past the flip at half the box length."""
    packing = tilted(dense_packing(1.0, atom_style="sphere"), math.copysign(0.48, direction))
    strain = math.copysign(0.06, direction) * packing.edges[0] / packing.edges[1]
    return lambda ranks: same_as_fix_deform(packing, "xy", strain, ranks)


def shears_in_plane(plane):
    """A gas, from an upright box past the flip."""
    packing = dense_packing(atom_style="sphere", overlap=-0.3, speed=0.2)
    edges = dict(zip("xyz", packing.edges))
    return lambda ranks: same_as_fix_deform(packing, plane, 0.601 * edges[plane[0]] / edges[plane[1]], ranks)


def windows(table):
    """(first step, last step) of every completed control interval."""
    inputs = np.flatnonzero(np.diff(table[INPUTS]) > 0) + 1
    return list(zip([0, *inputs[:-1]], inputs))


def follows_the_recursion(every, interval, gain, rest="", rate=0.05, target=3e5):
    """dL/dt = kp (mean of P since the last input - target), clipped, held; L grows by dL/dt dt each step."""

    def case(ranks):
        deck = controlled(press(target, rate, every, f"gain {gain} {rest}"), 120)
        table, dt = run(deck, ranks).thermo()[0], deck.dt()
        require_close(
            np.diff(table[LENGTH]),
            table[VELOCITY][1:] * dt,
            1e-9,
            "change of L",
            max(1e-6, np.abs(table[VELOCITY]).max() * dt),
        )
        require_close(table[LENGTH], table["ly"], 0.0, "L against the box", 1.0)
        words = f"limit 0.01 {rest}".split()
        limit = float(words[len(words) - 1 - words[::-1].index("limit") + 1])
        maxrate = float(words[words.index("maxrate") + 1]) if "maxrate" in words else abs(rate) or math.inf
        lasts = math.ceil(interval / dt - 1e-9) * dt  # inputs fall on whole steps
        clipped, held = 0, 0.0
        for first, last in windows(table):
            require_close(table[VELOCITY][first:last], np.full(last - first, held), 0.0, "dL/dt between inputs", 1.0)
            mean = table[NOW][first + 1 : last + 1].mean()
            require_close(table["f_press"][last], mean, 1e-12, f"averaged pressure at step {last}", target)
            bound = table[LENGTH][last - 1] * min(limit / lasts, maxrate)
            wanted = gain * (mean - target)
            held = table[VELOCITY][last]
            require_close(held, np.clip(wanted, -bound, bound), 1e-10, f"dL/dt at step {last}", bound)
            clipped += abs(wanted) > bound
            require(table[CLIPPED][last] == clipped, f"step {last}: {table[CLIPPED][last]} clipped, expected {clipped}")
            require_close(table[ERROR][last], mean / target - 1.0, 1e-12, "relative error", 1.0)
        require(len(windows(table)) >= 10, f"only {len(windows(table))} inputs")

    return case


def counts_inputs(every, per_step, rate=0.05):
    """An input on the first step, then one at every multiple of the interval. `per_step`: intervals passed per step."""

    def case(ranks):
        deck = controlled(press(3e5, rate, every(Deck(dense_packing(atom_style="sphere")).dt()), "gain 0"), 100)
        found = run(deck, ranks).thermo()[0][INPUTS]
        steps = np.arange(1, 101)
        passed = np.floor(steps * per_step + 1e-6).astype(int)
        expected = 1 + passed - (int(per_step) if per_step >= 1 else 0)
        require_close(found[1:], np.minimum(expected, steps), 0.0, "inputs", 1.0)

    return case


def automatic_gain(ranks):
    """kp = 0.5 L/(eta + K T), K and eta from a contact law written on its own, at the first input."""
    rate, target, every = 0.05, 5.2e4, 1e-3
    packing = dense_packing(atom_style="sphere", speed=0.01)
    deck = Deck(packing)
    deck.body = [
        press(target, rate, f"every {every}", "gain auto limit 0.9 maxrate 1e6"),
        *thermo(1, *STATE, *box_columns()),
        *dump_grains(packing, 1),
        "run 2",
    ]
    result = run(deck, ranks)
    table, dumps = result.thermo()[0], result.dump("grains.dump")
    law = Law(np.array([YOUNG]), POISSON, np.array([[0.5]]), np.array([[0.4]]), deck.dt())
    contacts(law, grains_of(dumps[0][1]), box_of(table, 0, rate), True)
    box = box_of(table, 0, rate)
    rows = contacts(law, grains_of(dumps[1][1]), box, False)
    ny2, ry2 = rows["normal"][:, 1] ** 2, rows["branch"][:, 1] ** 2
    stiffness = np.sum((1.5 * rows["kn"] * ny2 + rows["kt"] * (1 - ny2)) * ry2) / box.volume
    sticking = rows["gamma_t"]
    damping = np.sum((rows["gamma_n"] * ny2 + sticking * (1 - ny2)) * ry2) / box.volume
    lasts = math.ceil(every / rate / deck.dt()) * deck.dt()
    kp = 0.5 * table[LENGTH][0] / (damping + stiffness * lasts)
    require(table[CLIPPED][1] == 0.0, "the input was clipped: nothing is proved")
    require_close(table[VELOCITY][1], kp * (table["f_press"][1] - target), 1e-9, "dL/dt of the first input")


def holds_the_target(ranks):
    """The averaged pressure settles at the target."""
    target = 1e5
    deck = controlled(press(target, 0.05, "every 1e-3"), 4000)
    deck.body[1:4] = thermo(10, *STATE)
    table = run(deck, ranks).thermo()[0]
    late = table["f_press"][200:]
    # 10 %: mean over 200 samples of a small, lively packing whose averaged pressure fluctuates by about 25 %.
    require_close(late.mean(), target, 0.1, "pressure over the second half")


def restart_continues(ranks):
    packing = tilted(dense_packing(1.5), 0.495)
    deck = Deck(packing)
    line = press(2e5, 0.05, "every 7e-4")
    rest = [*thermo(1, *STATE), *dump_grains(packing, 100), "run 100"]
    through = run(replace(deck, body=[line, "run 153", "write_restart half.restart", *rest]), ranks)
    again = run(deck.restarted(through.folder / "half.restart", [line, *rest]), ranks)
    require_same_snapshots(
        again.dump("grains.dump")[-1:], through.dump("grains.dump")[-1:], "restarted against write-and-continue"
    )
    tables = again.thermo()[-1], through.thermo()[-1]
    for name in ("f_press", STRAIN, LENGTH, VELOCITY, INPUTS, CLIPPED):
        require_close(tables[0][name][1:], tables[1][name][1:], 0.0, name, 1.0)
    require(tables[0][INPUTS][-1] > tables[0][INPUTS][1] > 1.0, "no input after the restart")


def restart_on_other_ranks(ranks):
    """A file written on one rank continues on several: inputs and averages go on where they were."""
    packing = dense_packing(atom_style="sphere")
    deck, line = Deck(packing), press(2e5, 0.05, "every 7e-4")
    rest = [*thermo(1, *STATE), "run 40"]
    state = run(replace(deck, body=[line, "run 153", "write_restart half.restart"])).folder / "half.restart"
    one, many = (run(deck.restarted(state, [line, *rest]), n).thermo()[0] for n in (1, ranks))
    for name in STATE:
        # Sums in another order, through 40 chaotic steps.
        require_close(many[name], one[name], 1e-9, name, max(1e-6, np.abs(one[name]).max()))


def same_on_ranks(ranks):
    deck = controlled(press(3e5), 40)
    one, many = run(deck, 1), run(deck, ranks)
    for name in STATE:
        expected = one.thermo()[0][name]
        # Sums in another order, through 40 chaotic steps.
        require_close(many.thermo()[0][name], expected, 1e-9, name, max(1e-6, np.abs(expected).max()))
    for name in ("x", "y", "z", "vx", "vy", "vz"):
        require_close(many.dump("grains.dump")[-1][1][name], one.dump("grains.dump")[-1][1][name], 1e-9, name)


def target_zero_expands(ranks):
    table = run(controlled(press(0), 200), ranks).thermo()[0]
    require(table[LENGTH][-1] > table[LENGTH][0] * 1.001, f"L went from {table[LENGTH][0]} to {table[LENGTH][-1]}")
    require_close(table[ERROR], np.zeros(201), 0.0, "relative error, undefined at target 0", 1.0)


def at_the_target_nothing_moves(ranks):
    """No contacts, target 0: pressure and target are equal. Inputs go on, the box length stays."""
    packing = dense_packing(atom_style="sphere", overlap=-0.3, speed=0.0)
    table = run(controlled(press(0), 60, packing), ranks).thermo()[0]
    require_close(table[LENGTH], np.full(61, table[LENGTH][0]), 0.0, "L", 1.0)
    require(table[INPUTS][-1] > 10 and table[CLIPPED][-1] == 0.0, "inputs did not go on, or were clipped")


def target_follows_a_variable(ranks):
    deck = controlled(press("v_wanted"), 60)
    deck.body.insert(0, "variable wanted equal 1e5+1e4*step")
    table = run(deck, ranks).thermo()[0]
    require_close(table[TARGET], 1e5 + 1e4 * np.arange(61), 1e-14, "target")


def without_shear(ranks):
    """An isotropic box, no triclinic edges: only the length along the axis moves."""
    packing = replace(dense_packing(atom_style="sphere"), triclinic=False)
    deck = controlled(press(1e5, 0.0, "every/step 5", axis="z"), 100, packing)
    deck.body[1:4] = thermo(1, *STATE, "lx", "ly", "lz")
    table = run(deck, ranks).thermo()[0]
    require_close(table[LENGTH], table["lz"], 0.0, "L", 1.0)
    require(np.ptp(table["lz"]) > 1e-4 and np.ptp(table["lx"]) == np.ptp(table["ly"]) == 0.0, "the wrong lengths moved")


def momentum_removed(choice):
    def case(ranks):
        packing = dense_packing(atom_style="sphere")
        drifting = [replace(g, velocity=tuple(np.add(g.velocity, (0.3, 0.2, -0.1)))) for g in packing.grains]
        deck = controlled(press(3e5, rest=f"gain 0 momentum {choice}"), 40, replace(packing, grains=drifting))
        result = run(deck, ranks)
        table = result.thermo()[0]
        last = table[INPUTS].size - 1 if choice == "no" else np.flatnonzero(np.diff(table[INPUTS]))[-1] + 1
        deck.body[-1] = f"run {last}"
        deck.body[-3:-1] = dump_grains(packing, int(last))
        grains = grains_of(run(deck, ranks).dump("grains.dump")[-1][1])
        box = box_of(table, last - 1, 0.05)
        v = grains.v - (grains.x - box.centre) @ box.gradient.T
        mean = grains.mass @ v / grains.mass.sum()
        if choice == "yes":
            require_close(mean, np.zeros(3), 1e-12, "mean peculiar velocity at an input", 1.0)
        else:
            require(np.linalg.norm(mean) > 0.1, f"the drift is gone: {mean}")

    return case


def kinetic_part_counts(ranks):
    """A gas without contacts: the pressure is all kinetic, sum m v_y^2 / V."""
    packing = dense_packing(atom_style="sphere", overlap=-0.3, speed=0.2)
    deck = controlled(press(10.0, 0.05, "every/step 1", "gain 0 kinetic yes momentum no"), 3, packing)
    result = run(deck, ranks)
    table = result.thermo()[0]
    grains, box = grains_of(result.dump("grains.dump")[-1][1]), box_of(table, 2, 0.05)
    v = grains.v - (grains.x - box.centre) @ box.gradient.T
    v -= grains.mass @ v / grains.mass.sum()
    require_close(table["f_press"][-1], grains.mass @ v[:, 1] ** 2 / box.volume, 1e-10, "kinetic pressure")


CASES = {
    "shears-as-fix-deform": shears_as_fix_deform(1.0),
    "shears-backward-as-fix-deform": shears_as_fix_deform(-1.0),
    "shears-in-xz": shears_in_plane("xz"),
    "shears-in-yz": shears_in_plane("yz"),
    # Strain 1e-3 at rate 0.05: every 0.02 s.
    "recursion-every-strain": follows_the_recursion("every 1e-3", 0.02, 1e-6),
    "recursion-clipped": follows_the_recursion("every 1e-3", 0.02, 1e-3, "limit 1e-4"),
    "recursion-clipped-by-rate": follows_the_recursion("every 1e-3", 0.02, 1e-3, "maxrate 0.001"),
    "recursion-every-time": follows_the_recursion("every/time 0.03", 0.03, 1e-6),
    "recursion-negative-rate": follows_the_recursion("every 1e-3", 0.02, 1e-6, rate=-0.05),
    "inputs-every-strain": counts_inputs(lambda dt: f"every {number(0.05 * dt * 4)}", 0.25),
    "inputs-every-time": counts_inputs(lambda dt: f"every/time {number(dt * 2.5)}", 0.4),
    "inputs-every-step": counts_inputs(lambda dt: "every/step 7", 1 / 7),
    "automatic-gain": automatic_gain,
    "holds-the-target": holds_the_target,
    "restart-continues": restart_continues,
    "restart-on-other-ranks": restart_on_other_ranks,
    "same-on-ranks": same_on_ranks,
    "target-zero-expands": target_zero_expands,
    "at-the-target-nothing-moves": at_the_target_nothing_moves,
    "target-follows-a-variable": target_follows_a_variable,
    "without-shear": without_shear,
    "momentum-removed": momentum_removed("yes"),
    "momentum-kept": momentum_removed("no"),
    "kinetic-part-counts": kinetic_part_counts,
}

if __name__ == "__main__":
    main(CASES)
