# SPDX-License-Identifier: GPL-2.0-or-later
"""Every measure on 1, 2 and 4 ranks from one state; ranks and groups may be empty; measuring moves no grain; restarts
continue."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from catalogue import BLOCKS, DISPLACEMENT, MEMORY, everything, strain_lines
from deck import Deck, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import dense_packing, in_the_open, tilted
from refusal import refusal
from run import run
from watch import grain_columns

C_FABRIC = outputs("fabric").of("fabric")
C_GRAIN = outputs("contact/grain").of("grain")
C_MEMORY = outputs("velocity/memory").of("memory")
C_MOVED = outputs("displacement/shear").of("moved")

# Sums in another order; for non-spheres the host's solver, stopped at about 1e-7, sees a contact from one side or the
# other. Angles, eigenvectors and single grains or bins, where nothing averages, amplify either.
SUMS, SOLVER = 1e-9, 5e-5
RATE, STEPS = 0.05, 3


def measuring(deck, steps=STEPS, group="all"):
    """Body lines that ask everything in each step of a shear flow."""
    computes = everything(deck.packing)
    quantities = [q for w in computes for q in w.columns()]
    grains = dump_grains(
        deck.packing, 1, columns=grain_columns(deck.packing, *(c for w in computes for c in w.atom_columns()))
    )
    return [
        *strain_lines(RATE),
        shear(RATE),
        *(w.define(group) for w in computes),
        *thermo(1, *quantities),
        *grains,
        f"run {steps}",
    ]


def state_of(deck):
    lines = [shear(0.02), "run 300", "reset_timestep 0", "write_restart state.restart"]
    return run(replace(deck, processors="", body=lines)).folder / "state.restart"


def measure(deck, state, ranks, group_lines=(), group="all"):
    deck = replace(deck, processors=deck.processors if ranks == 4 else "")
    return run(deck.restarted(state, [*group_lines, *measuring(deck, group=group)]), ranks)


def vector_scales(values, blocks):
    scales, first = np.empty(len(values)), 0
    for size in blocks:
        part = slice(first, first + size)
        scales[part] = max(np.abs(values[part]).max(), 1e-12)
        first += size
    return scales


def same_vector(watched, found, expected, tolerance, when):
    scales = vector_scales(expected, BLOCKS[watched.name])
    require_close(found / scales, expected / scales, tolerance, f"{when}, {watched.command}", 1.0)


def same_array(watched, found, expected, tolerance, when):
    """Column by column. A contact on the edge of a bin may be seen on either side of it: then the sum over bins is the
    same."""
    counts = {"surface": 2, "direction": 1}.get(watched.name)
    alike = np.ones(len(expected), dtype=bool) if counts is None else found[:, counts] == expected[:, counts]
    if counts is not None:
        require_equal(
            found[:, counts].sum(), expected[:, counts].sum(), f"{when}, {watched.command}: contacts over bins"
        )
        require(
            int((~alike).sum()) <= 2,
            f"{when}, {watched.command}: contacts {found[:, counts]}, expected {expected[:, counts]}",
        )
    for column in range(expected.shape[1]):
        scale = max(np.abs(expected[:, column]).max(), 1e-12)
        if watched.name in ("direct", "mesh", "memory") and column == 2:  # a sum of terms of either sign
            scale = max(scale, np.sqrt(expected[:, 3].max()) * 0.1)
        require_close(
            found[alike, column],
            expected[alike, column],
            tolerance,
            f"{when}, {watched.command}, column {column + 1}",
            scale,
        )


def printed(table, watched, row):
    vector = np.array([table[f"c_{watched.name}[{k}]"][row] for k in range(1, watched.vector + 1)])
    rows, columns = watched.array
    array = np.array(
        [[table[f"c_{watched.name}[{r}][{c}]"][row] for c in range(1, columns + 1)] for r in range(1, rows + 1)]
    )
    return vector, array.reshape(rows, columns)


def same_results(found, expected, packing, tolerance):
    for row in range(STEPS + 1):
        for watched in everything(packing):
            (v1, a1), (v2, a2) = (printed(r.thermo()[-1], watched, row) for r in (found, expected))
            if watched.vector:
                same_vector(watched, v1, v2, tolerance, f"step {row}")
            if watched.array[0]:
                same_array(watched, a1, a2, tolerance, f"step {row}")
    for (step, left), (_, right) in zip(found.dump("grains.dump"), expected.dump("grains.dump")):
        for name in C_GRAIN.all("per grain"):
            require_close(
                left[name],
                right[name],
                tolerance,
                f"step {step}, contact/grain {name}",
                max(np.abs(right[name]).max(), 1e-12),
            )


def same_on(deck, tolerance, group_lines=(), group="all"):
    def case(ranks):
        state = state_of(deck)
        one, many = (measure(deck, state, n, group_lines, group) for n in (1, ranks))
        require(one.thermo()[-1][C_FABRIC["N_c"]][0] > 50, "the state has too few contacts")
        same_results(many, one, deck.packing, tolerance)

    return case


def empty_ranks(ranks):
    """A cluster in the middle of a large box cut in four along x: the outer ranks hold no grain."""
    deck = Deck(in_the_open(dense_packing(1.5, overlap=0.04, speed=0.05)), processors="4 1 1")
    state = (
        run(replace(deck, processors="", body=["run 2", "reset_timestep 0", "write_restart state.restart"])).folder
        / "state.restart"
    )
    one, many = (measure(deck, state, n) for n in (1, ranks))
    grains = next(line for line in many.output.splitlines() if line.startswith("Nlocal:")).split()
    require(grains[5:7] == ["0", "min"], f"no rank was empty: {' '.join(grains)}")
    same_results(many, one, deck.packing, SOLVER)


# What does not depend on grains: middles of bins, layers and lags, the rate of the box.
FIXED = {"surface": (0,), "direction": (0,), "moving": (0,), "layers": (0,), "direct": (0,), "mesh": (0,), "memory": ()}


def empty_group(packing):
    """Zero, not NaN, for a group that holds no grain."""

    def case(ranks):
        deck = Deck(packing)
        result = measure(deck, state_of(deck), ranks, ["group nobody id 99999"], "nobody")
        for watched in everything(packing):
            for row in range(STEPS + 1):
                vector, array = printed(result.thermo()[-1], watched, row)
                if watched.name == "moving":
                    vector[10] = 0.0
                if watched.name == "moved":
                    vector[0] = 0.0
                if watched.name == "memory":
                    vector[2] = 0.0  # samples of nobody
                    array[:, 0] = 0.0
                array[:, FIXED.get(watched.name, ())] = 0.0
                require_equal(vector, np.zeros_like(vector), f"{watched.command} of nobody")
                require_equal(array, np.zeros_like(array), f"{watched.command} of nobody")
        for _, columns in result.dump("grains.dump"):
            require(all(not columns[name].any() for name in C_GRAIN.all("per grain")), "contact/grain of nobody")

    return case


def does_not_disturb(packing):
    """Everything measured in every step, and nothing: the same trajectory to the last bit, through a flip."""

    def case(ranks):
        steps = 200
        deck = Deck(packing)
        silent = [shear(RATE), *dump_grains(packing, steps), f"run {steps}"]
        lines = measuring(deck, steps)
        talking = [line for line in lines if not line.startswith(("dump", "run"))]
        talking += [
            *dump_grains(packing, steps),
            f"dump asked all custom 1 asked.dump id {C_GRAIN['N_c']}",
            f"run {steps}",
        ]
        expected = run(replace(deck, body=silent), ranks)
        found = run(replace(deck, body=talking), ranks)
        require_same_snapshots(
            found.dump("grains.dump"), expected.dump("grains.dump"), "measured in every step against not at all"
        )
        require(found.thermo()[-1][C_FABRIC["N_c"]].mean() > 100, "too few contacts to prove anything")

    return case


# Its box goes through a restart file to the last bit; that of fix deform does not.
PRESS = f"fix press all press/strain axis y target 2e5 shear xy rate {RATE} every 7e-4"


def restart_continues(packing, other_ranks=None):
    """displacement/shear and velocity/memory after read_restart, against the run that wrote the same file and went
    on."""

    def case(ranks):
        deck = Deck(packing)
        computes = [DISPLACEMENT, MEMORY]
        for name, flow in (("fitted", "gradient"), ("given", f"rate {RATE}")):
            computes.append(replace(DISPLACEMENT, name=name, command=f"{DISPLACEMENT.command} flow {flow}"))
        start = [
            *strain_lines(RATE),
            PRESS,
            *(w.define("all") for w in computes),
            *thermo(3, *(q for w in computes for q in w.columns())),
        ]
        through = run(
            replace(deck, body=[*start, "run 60", "write_restart half.restart", "run 60"]), other_ranks or ranks
        )
        again = run(deck.restarted(through.folder / "half.restart", [*start, "run 60"]), ranks)
        expected, found = through.thermo()[-1], again.thermo()[-1]
        require(expected[C_MEMORY["samples"]][-1] > 5 and expected[C_MOVED["d2_x"]][-1] > 0.0, "nothing was measured")
        for name, values in expected.items():
            # Other ranks add up in another order, through 60 chaotic steps.
            require_close(
                found[name],
                values,
                1e-9 if other_ranks else 0.0,
                f"{name} after the restart",
                max(1e-9, np.abs(values).max()),
            )

    return case


def restart_refused(ranks):
    """The memory of one measurement is not taken for that of another."""
    deck = Deck(dense_packing(atom_style="sphere", speed=0.2))
    start = [*strain_lines(RATE), PRESS]
    saved = run(replace(deck, body=[*start, MEMORY.define("all"), "run 3", "write_restart half.restart"]), ranks)
    other = f"compute {MEMORY.name} all velocity/memory component wz"
    refusal(
        lambda: deck.restarted(saved.folder / "half.restart", [*start, other, "run 1"]),
        f"{MEMORY.name}_record: the restart file holds the memory of another compute",
    )(ranks)


SPHERES, SPHEROIDS = dense_packing(atom_style="sphere", speed=0.2), dense_packing(1.5, speed=0.2)
CASES = {
    "spheres": same_on(Deck(SPHERES), SUMS),
    "spheroids": same_on(Deck(SPHEROIDS), SOLVER),
    "oblate-grains": same_on(Deck(dense_packing(0.5, speed=0.2)), SOLVER),
    "ellipsoids": same_on(Deck(SPHEROIDS, surface="ellipsoid"), SUMS),
    "subgroup": same_on(Deck(SPHERES), SUMS, ["group some id 10:120"], "some"),
    "empty-ranks": empty_ranks,
    "empty-group": empty_group(SPHEROIDS),
    "empty-group-of-spheres": empty_group(SPHERES),
    "does-not-disturb-spheres": does_not_disturb(tilted(SPHERES, 0.49)),
    "does-not-disturb-spheroids": does_not_disturb(tilted(SPHEROIDS, 0.49)),
    "restart-continues": restart_continues(tilted(SPHEROIDS, 0.495)),
    "restart-of-spheres-continues": restart_continues(tilted(SPHERES, 0.495)),
    "restart-refused": restart_refused,
    "restart-on-other-ranks": restart_continues(tilted(SPHERES, 0.495), other_ranks=1),
}

if __name__ == "__main__":
    main(CASES)
