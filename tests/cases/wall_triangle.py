# SPDX-License-Identifier: GPL-2.0-or-later
"""wall/triangle: every triangle once, wherever it is owned; what all have together is what wall/contact says."""
import numpy as np

from case import main, require, require_close, require_equal
from deck import dump_local, thermo
from grainscope.columns import outputs
from walled import FLOOR, area_of, boxed, cube, flat, run_with_meshes

OWN = outputs("wall/triangle")
WALL = outputs("wall/contact").of("w")
SUMS = ("N", "F_n", "P_t")
WIDTH = len(OWN.names("local"))
# Sums of some ten numbers of the same size, in double precision.
ROUNDING = 1e-12


def sorted_rows(snapshot):
    """{name: values}, by wall and triangle."""
    rows = {name: snapshot[OWN.word("t", name)] for name in OWN.names("local")}
    order = np.lexsort((rows["triangle"], rows["wall"]))
    return {name: values[order] for name, values in rows.items()}


def on_the_floor(every, steps, moves=True):
    deck = boxed(cube(), meshes=("floor", "ceiling"))
    deck.body += [
        "fix gravity all gravity 9.81 vector 0.3 0 -1",
        *(["fix move all move/mesh mesh floor linear 1.0 0.0 0.0"] if moves else []),
        "compute w all wall/contact walls ceiling floor",
        "compute t all wall/triangle walls ceiling floor wear yes",
        *thermo(every, *(WALL[row, f"{name}_w"] for row in (1, 2) for name in (*SUMS, "area"))),
        *dump_local("t", WIDTH, every, "t"),
        f"run {steps}",
    ]
    return deck


CEILING = flat(-1.0, 7.0, 3, height=5.88, aside=-0.3)
MESHES = {"floor": FLOOR, "ceiling": CEILING}


def rows(ranks):
    deck = on_the_floor(5, 50)
    result = run_with_meshes(deck, ranks, **MESHES)
    table, dumps = result.thermo()[-1], [sorted_rows(snapshot) for _, snapshot in result.dump("t.dump")]
    walls = np.repeat([1.0, 2.0], [len(CEILING), len(FLOOR)])
    numbers = np.concatenate([np.arange(len(CEILING)), np.arange(len(FLOOR))]).astype(float)
    still = np.array([np.mean(t, axis=0) for t in [*CEILING, *FLOOR]])
    for k, found in enumerate(dumps):
        require_equal(found["wall"], walls, "walls")
        require_equal(found["triangle"], numbers, "every triangle once")
        require_close(found["area"], area_of([*CEILING, *FLOOR]), ROUNDING, "areas")
        centre = np.stack([found[f"centre_{a}"] for a in "xyz"], axis=1)
        moved = np.outer(walls == 2.0, [5 * k * deck.dt(), 0.0, 0.0])
        require_close(centre, still + moved, ROUNDING, "centres", 10.0)
        require_close(np.abs(found["normal_z"]), np.ones(len(walls)), ROUNDING, "normals")
        for row in (1, 2):
            own = found["wall"] == row
            for name, values in (
                ("N", found["N"]),
                ("F_n", found["p"] * found["area"]),
                ("P_t", found["P_t"] * found["area"]),
            ):
                whole = table[WALL[row, f"{name}_w"]]
                require_close(values[own].sum(), whole[k], ROUNDING, f"sum of {name}", float(np.abs(whole).max()))
    require(np.count_nonzero(dumps[-1]["N"]) > 8, "few triangles are touched")
    if ranks > 1:
        alone = run_with_meshes(deck, 1, **MESHES).dump("t.dump")
        for found, (_, snapshot) in zip(dumps, alone):
            for name, values in sorted_rows(snapshot).items():
                # what differs in rounding is carried on for 50 steps
                require_close(
                    found[name], values, 1e-9, f"{name} of {ranks} ranks and of one", np.abs(values).max() or 1
                )


def wear(ranks):
    """The integral of its rate, over all steps but the first evaluation of each run; whoever asks when."""
    deck = on_the_floor(1, 40)
    deck.body += ["run 20"]
    result = run_with_meshes(deck, ranks, **MESHES)
    dumps = {step: sorted_rows(snapshot) for step, snapshot in result.dump("t.dump")}
    total = sum(dumps[step]["wear_rate"] for step in range(1, 61)) * deck.dt()
    require(total.max() > 0.0, "nothing slides")
    require_close(dumps[60]["wear"], total, ROUNDING, "wear")
    # mu F_n |u_t| is what is lost where the force is opposite to the motion, and more than that elsewhere
    most = 0.4 * dumps[60]["wear_rate"]
    require(bool((dumps[60]["P_t"] <= most * (1.0 + ROUNDING)).all()), "friction beyond mu F_n |u_t|")
    require(dumps[60]["P_t"].sum() > 0.9 * most.sum(), "friction and wear have nothing in common")
    deck = on_the_floor(30, 60)
    rarely = sorted_rows(run_with_meshes(deck, ranks, **MESHES).dump("t.dump")[-1][1])
    require_close(rarely["wear"], dumps[60]["wear"], 1e-2, "wear, asked rarely, in one run")


if __name__ == "__main__":
    main({"rows": rows, "wear": wear})
