# SPDX-License-Identifier: GPL-2.0-or-later
"""What surface ellipsoid and compute contact/solver refuse."""
from dataclasses import replace

from case import main, require
from deck import Deck, thermo
from packing import Grain, Packing, dense_packing
from refusal import refusal
from run import attempt, tail

ADVICE = "use surface superquadric"
SOLVER = "compute solver all contact/solver"


def grains(*boxy):
    """Six spheroids far apart in x, so on every rank; (number, blockiness) of those that are none."""
    six = [Grain((-15.0 + 6.0 * k, 0.0, 0.0), (1.0, 1.0, 1.5)) for k in range(6)]
    for k, blockiness in boxy:
        six[k - 1] = replace(six[k - 1], blockiness=blockiness)
    return Packing((40.0, 20.0, 20.0), six, origin=(-20.0, -10.0, -10.0), triclinic=False)


def deck(*body, packing=None, **choices):
    choices.setdefault("surface", "ellipsoid")
    return Deck(packing or grains(), body=[*(body or ("run 1",))], processors="* 1 1", **choices)


def refused(*words, body=(), **choices):
    return refusal(lambda: deck(*body, **choices), *words)


def taken(*body, **choices):
    """The other side of a limit."""

    def case(ranks):
        result = attempt(deck(*body, **choices), ranks)
        require(result.code == 0, f"refused:\n{tail(result.output)}")

    return case


INSERT = [
    "region top block -20 20 -10 10 4 8 units box",
    "fix odd all particletemplate/superquadric 15485863 atom_type 1 density constant 1000 shape constant 1 1 1 "
    "blockiness constant 4 4 volume_limit 1e-9",
    "fix kinds all particledistribution/discrete 15485867 1 odd 1.0",
    "fix insert all insert/pack seed 32452843 distributiontemplate kinds insert_every 50 vel constant 0 0 0 "
    "overlapcheck yes all_in yes particles_in_region 3 region top",
    "run 200",
]
BOTH = "surface ellipsoid: meanCurvature and gaussianCurvature cannot both be yes"
NEEDS = "surface ellipsoid: every grain must have blockiness 2 2, got"


LIQUID = [
    f"fix {name} all property/global {name} {value}"
    for name, value in (
        ("surfaceTension", "scalar 0.05"),
        ("fluidViscosity", "scalar 1.0"),
        ("surfaceLiquidContentInitial", "scalar 0.1"),
        ("maxSeparationDistanceRatio", "scalar 1.1"),
        ("minSeparationDistanceRatio", "scalar 0.01"),
        ("contactAngle", "peratomtype 0.0"),
    )
]
SPHERES = Packing(
    (40.0, 20.0, 20.0),
    [Grain((-15.0 + 6.0 * k, 0.0, 0.0)) for k in range(6)],
    origin=(-20.0, -10.0, -10.0),
    triclinic=False,
)


def bridge(model, number, **choices):
    return refused(
        f"surface ellipsoid: 'cohesion {model}' works with spheres only, and grain {number} is not a sphere",
        "cohesion sjkr or sjkr2",
        body=(*LIQUID, "run 1"),
        cohesion=model,
        **choices,
    )


ONE_SPHEROID = replace(SPHERES, grains=[*SPHERES.grains[:4], grains().grains[4], SPHERES.grains[5]])


def solver_of(style="gran/insitu", surface="ellipsoid", atom_style="superquadric"):
    return lambda: Deck(
        dense_packing(1.5 if atom_style == "superquadric" else 1.0, atom_style=atom_style),
        pair=style,
        surface=surface,
        body=[SOLVER, *thermo(1, "c_solver"), "run 1"],
    )


CASES = {
    "boxy-grain": refused(f"{NEEDS} 4 3 of grain 5", ADVICE, packing=grains((5, (4.0, 3.0)))),
    "boxy-one-way": refused(f"{NEEDS} 2 2.02 of grain 1", ADVICE, packing=grains((1, (2.0, 2.02)))),
    "first-of-two-boxy-grains": refused(
        f"{NEEDS} 3 3 of grain 2", ADVICE, packing=grains((6, (4.0, 4.0)), (2, (3.0, 3.0)))
    ),
    "boxy-grain-under-gran": refused(f"{NEEDS} 4 3 of grain 5", ADVICE, packing=grains((5, (4.0, 3.0))), pair="gran"),
    "boxy-between-runs": refused(
        f"{NEEDS} 5 2 of grain 3", ADVICE, body=("run 10", "set atom 3 blockiness 5 2", "run 1")
    ),
    "boxy-created-later": refused(
        f"{NEEDS} 4 4 of grain 7",
        ADVICE,
        body=(
            "run 10",
            "create_atoms 1 single 15 5 5 units box",
            "set atom 7 shape 1 1 1 blockiness 4 4 density 1000 quat_direct 1 0 0 0",
            "run 1",
        ),
    ),
    "boxy-inserted": refused(f"{NEEDS} 4 4 of grain", ADVICE, body=INSERT),
    "nearly-an-ellipsoid-is-taken": taken(packing=grains((4, (2.005, 2.0)))),
    "spheres": refusal(
        lambda: Deck(dense_packing(atom_style="sphere"), body=["run 1"])
        .text()
        .replace("tangential history", "tangential history surface ellipsoid"),
        "surface ellipsoid needs atom_style superquadric",
    ),
    "wall-of-spheres": refusal(
        lambda: Deck(
            replace(dense_packing(atom_style="sphere"), triclinic=False),
            boundary="p p f",
            body=[
                "fix floor all wall/gran model hertz tangential history surface ellipsoid primitive type 1 zplane -5",
                "run 1",
            ],
        ),
        "surface ellipsoid needs atom_style superquadric",
    ),
    "both-curvatures": refused(BOTH, extra="meanCurvature yes gaussianCurvature yes"),
    "both-curvatures-of-a-wall": refused(
        BOTH,
        boundary="p p f",
        body=(
            "fix floor all wall/gran model hertz tangential history surface ellipsoid primitive type 1 zplane "
            "-5 meanCurvature yes "
            "gaussianCurvature yes",
            "run 1",
        ),
    ),
    "limit-negative": refused(
        "surface ellipsoid: curvatureLimitFactor must be at least 0, got -0.5", extra="curvatureLimitFactor -0.5"
    ),
    "limit-negative-under-gran": refused(
        "curvatureLimitFactor must be at least 0, got -2", extra="curvatureLimitFactor -2", pair="gran"
    ),
    "bridge-washino": bridge("washino/capillary/viscous", 1),
    "bridge-easo": bridge("easo/capillary/viscous", 1),
    "bridge-under-gran": bridge("washino/capillary/viscous", 1, pair="gran"),
    "bridge-of-one-spheroid": bridge("washino/capillary/viscous", 5, packing=ONE_SPHEROID),
    "bridge-of-spheres-is-taken": taken(*LIQUID, "run 1", packing=SPHERES, cohesion="washino/capillary/viscous"),
    "misspelt-surface": refusal(lambda: deck(surface="elipsoid"), "invalid contact model", "elipsoid"),
    "solver-of-a-group": refused(
        "compute contact/solver: the group must be 'all'",
        "got 'few'",
        body=("group few id 1:3", SOLVER.replace("all", "few"), "run 1"),
    ),
    "solver-needs-surface-ellipsoid": refusal(
        solver_of(surface="superquadric"), "compute contact/solver: needs a pair_style with 'surface ellipsoid', got '"
    ),
    "solver-of-spheres": refusal(
        solver_of(atom_style="sphere"), "compute contact/solver: needs a pair_style with 'surface ellipsoid', got '"
    ),
    "solver-needs-gran-insitu": refusal(
        solver_of("gran"), "compute contact/solver requires pair_style gran/insitu, got 'gran'"
    ),
}

if __name__ == "__main__":
    main(CASES)
