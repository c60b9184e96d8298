# SPDX-License-Identifier: GPL-2.0-or-later
"""surface ellipsoid against surface superquadric: one state, the same forces; restart files go from either to the
other; a restart goes on exactly."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from deck import Deck, dump_grains, dump_local, shear, thermo
from grainscope.columns import outputs
from oracle.state import ROW_WIDTH
from packing import Grain, Packing, dense_packing, tilted
from run import run

C_ROWS = outputs("contact/local").of("rows")
C_SOLVER = outputs("contact/solver").of("solver")

# Of the rms force, and of that times the radius 1. The host's solver stops by the angle of the normals, at about 1e-5;
# its points, and so the torques, are off by more.
FORCE, TORQUE = 1e-4, 5e-4
STEPS = 400


def vectors(columns, prefix):
    return np.stack([columns[prefix + axis] for axis in "xyz"], axis=1)


def evaluated(deck, state, surface, ranks):
    """Grains and contacts at the moment of a restart file, and the counts of the solver."""
    lines = [
        *dump_grains(deck.packing, 1),
        "compute rows all contact/local",
        *dump_local("rows", ROW_WIDTH, 1, "rows"),
        "run 0",
    ]
    result = run(replace(deck, surface=surface).restarted(state, lines), ranks)
    return result.dump("grains.dump")[0][1], len(result.dump("rows.dump")[0][1][C_ROWS["id_i"]])


def made_by(surface, deck, ranks):
    """A flow's restart file, its box turned back once."""
    body = [shear(0.7 / (STEPS * deck.dt())), f"run {STEPS}", "write_restart state.restart"]
    return run(replace(deck, surface=surface, body=body), ranks).folder / "state.restart"


def same_forces(packing, extra="", makers=("superquadric", "ellipsoid")):
    # Without tangential damping: with it the host's force jumps where sliding begins, and a contact there may be seen
    # on either side.
    deck = Deck(packing, extra=f"tangential_damping off {extra}")

    def case(ranks):
        for maker in makers:
            state = made_by(maker, deck, ranks)
            (found, ours), (expected, theirs) = (
                evaluated(deck, state, surface, ranks) for surface in ("ellipsoid", "superquadric")
            )
            require(ours > 2 * len(packing.grains), f"only {ours} contacts")
            require(
                abs(ours - theirs) <= 2, f"{ours} contacts, {theirs} with surface superquadric"
            )  # some only just touch
            rms = np.sqrt((vectors(expected, "f") ** 2).sum(axis=1).mean())
            for prefix, what, tolerance in (("f", "forces", FORCE), ("tq", "torques", TORQUE)):
                f, g = vectors(found, prefix), vectors(expected, prefix)
                print(f"{what}, state made by {maker}: largest difference {np.abs(f - g).max() / rms:.1e} of the rms")
                require_close(f, g, tolerance, f"{what}, state made by surface {maker}", rms)

    return case


def flows_on_from_the_other(ranks):
    """Forces 10 steps after a change of surface, with the springs, points and flags that the other left."""
    deck = Deck(dense_packing(1.5), extra="tangential_damping off")
    for maker in ("superquadric", "ellipsoid"):
        state = made_by(maker, deck, ranks)
        rest = [*dump_grains(deck.packing, 10), "run 10"]
        runs = [
            run(replace(deck, surface=surface).restarted(state, rest), ranks)
            for surface in ("ellipsoid", "superquadric")
        ]
        ends = [result.dump("grains.dump")[-1][1] for result in runs]
        rms = np.sqrt((vectors(ends[1], "f") ** 2).sum(axis=1).mean())
        require_close(
            vectors(ends[0], "f"), vectors(ends[1], "f"), FORCE, f"forces 10 steps on, from surface {maker}", rms
        )


def restart_goes_on(packing, rate, before, after):
    """To the last bit: springs, and the start of the solver, survive the file. `press/strain` keeps its box to the last
    bit; it flips. On several ranks only as long as no grain has changed ranks: then the host has them in another order
    after the restart.
    """
    press = f"fix press all press/strain axis y target 2e5 shear xy rate {rate} every 7e-4"

    def case(ranks):
        deck = Deck(packing, surface="ellipsoid")
        rest = [*dump_grains(packing, after), *thermo(after, "xy"), f"run {after}"]
        through = run(replace(deck, body=[press, f"run {before}", "write_restart half.restart", *rest]), ranks)
        tilts = through.thermo()[-1]["xy"]
        require(tilts[-1] < tilts[0], f"the box did not flip: tilts {tilts}")
        again = run(deck.restarted(through.folder / "half.restart", [press, *rest]), ranks)
        require_same_snapshots(
            again.dump("grains.dump")[-1:], through.dump("grains.dump")[-1:], "restarted against write-and-continue"
        )

    return case


def start_survives_a_swap(ranks):
    """Grain 1 leaves the first rank, and the host puts the last grain in its place: of the pair 2 3, three to one in
    size, i and j change places, and lambda = 1/4 must become 3/4. From the right start the solver is done in one step,
    every time."""
    turned = (math.cos(0.3), 0.0, math.sin(0.3), 0.0)
    grains = [
        Grain((11.95, 2.0, 2.0), (0.5, 0.5, 0.75), velocity=(5e4, 0.0, 0.0)),
        Grain((3.0, 12.0, 12.0), (0.5, 0.5, 0.75), turned),
        Grain((5.0, 12.1, 12.2), (1.5, 1.5, 2.25)),
    ]
    packing = Packing((24.0, 24.0, 24.0), grains, triclinic=False)
    deck = Deck(packing, surface="ellipsoid", processors="2 1 1", timestep=1e-7)
    deck.body = [
        "compute solver all contact/solver",
        *thermo(1, C_SOLVER["pairs_touching"], C_SOLVER["steps"]),
        "dump order all custom 1 order.dump id",
        "run 40",
    ]
    result = run(deck, ranks)
    order = [columns["id"].tolist() for _, columns in result.dump("order.dump")]
    require(
        order[0] == [1.0, 2.0, 3.0] and order[-1] == [3.0, 2.0, 1.0],
        f"grains are in order {order[-1]}, were {order[0]}: no swap",
    )
    table = result.thermo()[0]
    require(
        table[C_SOLVER["pairs_touching"]][-1] == 41.0,
        f"{table[C_SOLVER['pairs_touching']][-1]} contacts in 41 evaluations",
    )
    require_equal(np.diff(table[C_SOLVER["steps"]]), np.ones(40), "Newton steps")


CURVED = "curvatureLimitFactor 2"
CASES = {
    **{f"spheroid-{alpha:g}": same_forces(dense_packing(alpha, wobble=0.3)) for alpha in (0.33, 0.5, 1.5, 3.0)},
    "spheres": same_forces(dense_packing()),
    "polydisperse": same_forces(dense_packing(1.5, sizes=(0.8, 1.0, 1.2), wobble=0.3)),
    "gaussian-curvature": same_forces(
        dense_packing(1.5, wobble=0.3), f"gaussianCurvature yes {CURVED}", ["superquadric"]
    ),
    "mean-curvature": same_forces(dense_packing(0.5, wobble=0.3), f"meanCurvature yes {CURVED}", ["superquadric"]),
    "limit-without-curvature-keywords": same_forces(dense_packing(1.5, wobble=0.3), CURVED, ["superquadric"]),
    "flows-on-from-the-other": flows_on_from_the_other,
    "restart-of-prolate-grains": restart_goes_on(dense_packing(1.5), 0.3, 240, 600),
    "restart-of-oblate-grains": restart_goes_on(dense_packing(0.5, minimum=300), 0.3, 240, 300),
    "restart-before-a-flip": restart_goes_on(tilted(dense_packing(1.5), 0.48), 0.05, 40, 300),
    "start-survives-a-swap": start_survives_a_swap,
}

if __name__ == "__main__":
    main(CASES)
