# SPDX-License-Identifier: GPL-2.0-or-later
"""fix press/wall on beds: the pressure that it holds against forces that the host adds up, the gain on packings, ranks,
restarts, the energy of the plate, variables."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from deck import Deck, Material, dump_grains, thermo
from grainscope.columns import outputs
from ledger import LEDGER, ROUNDING, TOTALS, UNDAMPED, account, require_closed, turnover
from packing import DENSITY
from plates import bed, plate_of, plated, press, top_of
from run import run

F_PRESS = outputs("press/wall").of("press")
STATE = ["f_press", *F_PRESS.vector()]
TRAVEL, TARGET, NOW, POSITION, VELOCITY, INPUTS, CLIPPED, ERROR = STATE[1:]
G = 9.81
FALL = f"fix pull all gravity {G} vector 0 0 -1"
SOFT = Material(restitution=(0.2,))


def pressed(target, rest, steps, every=1, packing=None, lines=(), columns=(), mesh="mesh/surface", **choices):
    deck = plated(packing or bed(), mesh, material=SOFT, **choices)
    deck.body += [*lines, press(target, rest), *thermo(every, *STATE, *columns), f"run {steps}"]
    return deck


def area(deck):
    return deck.packing.edges[0] * deck.packing.edges[1]


def weight(deck):
    return G * sum(grain.mass() for grain in deck.packing.grains)


def holds(rest, style="sphere", **choices):
    """Under gravity, from a plate that touches nothing to a bed at rest. The host adds up the forces on the mesh; the
    floor bears them and the weight of the grains."""

    def case(ranks):
        target, steps = 2e4, 12000
        packing = bed(style=style, shape=(0.9, 1.0, 1.3 if style != "sphere" else 1.0))
        deck = pressed(
            target,
            rest,
            steps,
            100,
            packing,
            [FALL, "compute walls all wall/contact walls floor losses no"],
            ["f_plate[3]", outputs("wall/contact").word("walls", "force_z")],
            "mesh/surface/stress",
            **choices,
        )
        table = run(deck, ranks).thermo()[0]
        late = table["step"] > 0.75 * steps
        # 1e-6: at rest but for the end of an exponential settling, 1e-13 as measured; a bed that rounding led elsewhere
        # may take longer
        require_close(table["f_press"][late].mean(), target, 1e-6, "averaged pressure")
        require_close(table[NOW][late], np.full(late.sum(), target), 1e-6, "pressure now")
        require_equal(
            table[CLIPPED][late], np.full(late.sum(), table[CLIPPED][late][0]), "no input is clipped any more"
        )
        require_close(table["f_plate[3]"][1:], table[NOW][1:] * area(deck), 1e-10, "the host's force on the mesh")
        floor = -table[outputs("wall/contact").word("walls", "force_z")][late].mean()
        require_close(floor, target * area(deck) + weight(deck), 1e-6, "what the floor bears")
        require(table[CLIPPED][-1] > 0.0 and table[TRAVEL][-1] < -0.05, "the plate had nowhere to go")

    return case


def stable(gain, restitution, every):
    """Nothing but the gain keeps the loop from swinging: a packing at the target, one that bounces."""

    def case(ranks):
        target = 2e4
        deck = pressed(target, f"every/step {every} {gain}", 200 * every + 4000, every)
        deck.material = replace(deck.material, restitution=(restitution,))
        table = run(deck, ranks).thermo()[0]
        last = np.abs(table["f_press"][-40:] / target - 1.0)
        print(f"error of the last 40 inputs: {last.mean():.2e}, at most {last.max():.2e}")
        require(last.max() < 0.05, f"the pressure is off by {last.max():.2e} of the target")
        require_equal(table[CLIPPED][-40:], np.full(40, table[CLIPPED][-1]), "no input is clipped any more")

    return case


def same_on_ranks(ranks):
    """A start, contacts and settling are those of one rank."""
    found = []
    for n in (1, ranks):
        deck = pressed(2e4, "every/step 7", 600, 10)
        deck.body[-1:] = [*dump_grains(deck.packing, 600), deck.body[-1]]
        result = run(deck, n)
        found.append((result.thermo()[0], result.dump("grains.dump")[-1][1]))
    (one, here), (many, there) = found
    require(one[NOW].max() > 0.0 and one[INPUTS][-1] > 80.0, "nothing was pressed")
    # Sums of forces in another order: 1e-16, which grows in a bed that moves.
    for name in STATE:
        require_close(many[name], one[name], 1e-9, name, max(1e-3, np.abs(one[name]).max()))
    for name in ("x", "y", "z", "vz"):
        require_close(there[name], here[name], 1e-9, name, 1.0)


def restarted(extra):
    """A run that is taken up again goes on to the last bit, in the middle of an interval; with `setup neutral` as the
    run that was never split."""

    def case(ranks):
        first, second = 333, 300
        deck = pressed(2e4, "every/step 7", first, 10, extra=extra)
        lines = [*deck.body[:-1], *dump_grains(deck.packing, 50)]
        parts = [f"run {first}", "write_restart half.restart", f"run {second}"]
        through = run(replace(deck, body=[*lines, *parts]), ranks)
        again = run(deck.restarted(through.folder / "half.restart", [*lines, parts[-1]]), ranks)
        (_, before), (after,) = through.thermo(), again.thermo()
        require(before[NOW].min() > 0.0 and before[VELOCITY][0] != 0.0, "the plate touches nothing")
        for name in STATE:
            require_equal(after[name], before[name], f"restarted against write-and-continue, {name}")
        found, expected = again.dump("grains.dump"), through.dump("grains.dump")
        expected = [snapshot for snapshot in expected if snapshot[0] >= found[0][0]]
        require_same_snapshots(found[1:], expected[-len(found) + 1 :], "restarted against write-and-continue")
        if "neutral" not in extra:
            return
        whole = run(replace(deck, body=[*lines, f"run {first + second}"]), ranks)
        # A list is built once more, so forces are summed in another order: 1e-16, which grows.
        for (_, one), (_, other) in zip(expected[-3:], whole.dump("grains.dump")[-3:]):
            for name in ("x", "y", "z", "vx", "vy", "vz"):
                require_close(one[name], other[name], 1e-9, f"split against whole, {name}", 1.0)
        require_close(after[POSITION][-1], whole.thermo()[0][POSITION][-1], 1e-9, "where the plate is", 1.0)

    return case


def energy(ranks):
    """The ledger closes, and the work of walls is that of the plate: the mean of its forces before the step and after
    it, times the way of the step."""
    deck = pressed(2e4, "every/step 7", 1500, 1, lines=[LEDGER, FALL], columns=TOTALS, extra=f"ledger on {UNDAMPED}")
    table, dt = run(deck, ranks).thermo()[0], deck.dt()
    a = account(table)
    require_closed(a, ROUNDING, "under the plate")
    force, speed = table[NOW] * area(deck), table[VELOCITY]
    # V is that of the coming step; the force on grains is -F along z
    work = -0.5 * dt * ((force[:-1] + force[1:]) * speed[:-1]).sum()
    require(work > 0.02 * turnover(a), f"the plate did {work:g} of {turnover(a):g}")
    require_close(a["W_wall"], work, 1e-10, "work of the plate")


def follows_a_variable(ranks):
    """A target that rises: P_mean follows it, and the target is that of the step."""
    deck = pressed(
        "v_load", "every/step 5", 6000, 50, lines=["variable load equal 1e4+2*step", FALL], columns=["v_load"]
    )
    table = run(deck, ranks).thermo()[0]
    late = table["step"] > 3000
    require_equal(table[TARGET], table["v_load"], "the target")
    require_close(table["f_press"][late], table[TARGET][late], 2e-2, "averaged pressure")


def counts_time(ranks):
    """every/time t is every/step n where t is n steps."""
    packing, found = bed(), []
    dt = plated(packing).dt()
    for rest in ("every/step 5", f"every/time {5.0 * dt!r}"):
        found.append(run(pressed(2e4, rest, 400, 1, packing, [FALL]), ranks).thermo()[0])
    for name in STATE:
        require_close(found[1][name], found[0][name], 1e-9, name, max(1e-3, np.abs(found[0][name]).max()))


def others_do_not_count(ranks):
    """Grains outside the group press, and are not counted; a mesh beside is another wall."""
    deck = plated(bed(), material=SOFT)
    few, every = (outputs("wall/contact").word(name, "force_z") for name in ("few", "every"))
    deck.body += [
        "group few id 1:16",
        press(2e4).replace("press all", "press few"),
        "compute few few wall/contact walls plate losses no",
        "compute every all wall/contact walls plate losses no",
        *thermo(10, NOW, few, every),
        "run 2000",
    ]
    table = run(deck, ranks).thermo()[0]
    few, every = table[few], table[every]
    require(every.max() > few.max() > 0.0, "no grain outside the group presses")
    require_close(table[NOW] * area(deck), few, 1e-12, "the force of the group", every.max())


def sinking(ranks):
    """A floor that is drawn away at a steady velocity takes the bed along, and the plate follows it: below its target
    by V/k_p, with a base at it."""
    packing, steps, target = bed(across=3, layers=2, speed=0.05), 4000, 2e4
    speed = 0.01 * np.sqrt(target / DENSITY)
    for base, low, high in ((" base no", -0.3, -0.03), (" base yes", -1e-6, 1e-6)):
        deck = Deck(packing, boundary="p p m", material=SOFT)
        plate = plate_of(packing)
        deck.body = [
            f"fix plate all mesh/surface file {plate} type 1",
            f"fix ground all mesh/surface file {plate} type 1 move 0. 0. {-top_of(packing)!r}",
            f"fix walls all wall/gran {deck.model()} mesh n_meshes 2 meshes plate ground",
            press(target, "every/step 5" + base),
            *thermo(5, *STATE),
            f"run {steps}",
            f"fix down all move/mesh mesh ground linear 0. 0. {-speed!r}",
            f"run {steps}",
        ]
        rest, table = run(deck, ranks).thermo()
        late = table["step"] > table["step"][0] + 0.75 * steps
        error = table["f_press"][late].mean() / target - 1.0
        print(f"{base}: at rest {rest['f_press'][-1] / target - 1.0:.1e}, sinking {error:.2e}")
        require(low < error < high, f"{base}: the pressure is off by {error:.2e}")
        require_close(table[VELOCITY][late].mean(), -speed, 1e-3, "velocity of the plate")


def smaller_plates(ranks):
    """A warning if `area box` is more than the plate, or what walls inside the box leave of it."""
    packing = bed(across=3, layers=2)
    edge = packing.edges[0]
    for scale, side, area, words in (
        (1.0, "", "box", None),
        (0.5, "", "box", "but the plate 'plate' spans 0.25 of it."),
        (0.5, "", "12.0", None),
        (1.0, f"xplane {0.9 * edge!r}", "box", "but the plate 'plate' meets inside the box: side."),
        (1.0, f"xplane {edge!r}", "box", None),
    ):
        deck = plated(packing, material=SOFT, boundary="f f f")
        deck.body[1] = deck.body[1] + f" scale {scale!r} move 0. 0. {(1.0 - scale) * top_of(packing)!r}"
        if side:
            deck.body.append(deck.body[0].replace("fix floor", "fix side").replace("zplane 0.0", side))
        deck.body += [press(2e4, area=area), "run 1", "run 1"]
        output = " ".join(run(deck, ranks).output.split())
        found = output.split("'area box' divides by the cross-section of the box, ")[1:]
        require(len(found) == (words is not None), f"{scale} {side}: {len(found)} warnings")
        require(not words or found[0].startswith(words), f"{scale} {side}: {found}")


CASES = {
    "sinking": sinking,
    "smaller-plates": smaller_plates,
    "holds-spheres": holds("every/step 10"),
    "holds-spheroids": holds("every/step 10", "superquadric", surface="ellipsoid"),
    "holds-hooke": holds("every/step 10", normal="hooke"),
    "stable-every-step": stable("", 0.2, 1),
    "stable-rarely": stable("", 0.2, 100),
    "stable-bouncing": stable("", 0.9, 10),
    "stable-damped": stable("", 0.06, 20),
    "same-on-ranks": same_on_ranks,
    "restarted": restarted(""),
    "restarted-neutral": restarted("setup neutral"),
    "energy": energy,
    "target-follows-a-variable": follows_a_variable,
    "counts-time": counts_time,
    "group": others_do_not_count,
}

if __name__ == "__main__":
    main(CASES)
