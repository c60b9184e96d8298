# SPDX-License-Identifier: GPL-2.0-or-later
"""surface ellipsoid: gran/insitu, whose own loop leaves out what is surely apart, moves grains exactly as pair_style
gran, which looks at every neighbour in every step. A contact that the loop overlooks once parts the two for good."""
from dataclasses import replace
import math
import re

import numpy as np

from case import main, require, require_same_snapshots
from deck import Deck, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import Grain, Packing, dense_packing
from run import run
from sphere_bitwise import FROZEN, STIFFNESS, TYPES
import sphere_bitwise

C_SOLVER = outputs("contact/solver").of("solver")

SOLVER = ["compute solver all contact/solver", *thermo(1000, *C_SOLVER.vector())]


def builds(result):
    return sum(int(n) for n in re.findall(r"^Neighbor list builds = (\d+)", result.output, flags=re.M))


def same_as_gran(deck, ranks, lists, skipped, contacts=1.0):
    """`lists`: neighbour lists at least; `skipped`: the share of listed pairs that must not have been looked at;
    `contacts` per grain."""
    plain = run(replace(deck, pair="gran"), ranks)
    at = next(k for k, line in enumerate(deck.body) if line.startswith("run "))
    counting = replace(deck, body=[*deck.body[:at], *SOLVER, *deck.body[at:]])
    own = run(counting, ranks)
    require_same_snapshots(own.dump("grains.dump"), plain.dump("grains.dump"), "gran/insitu against gran")
    table = own.thermo()[-1]
    counts = ("pairs_listed", "pairs_solved", "pairs_touching", "fallbacks")
    listed, solved, touching, fallbacks = (table[C_SOLVER[name]][-1] for name in counts)
    steps = table[C_SOLVER["pairs_listed"]].size and int(own.dump("grains.dump")[-1][0])
    print(f"{builds(own)} lists; of {listed:.0f} listed {solved:.0f} solved, {touching:.0f} touched")
    require(builds(own) >= lists, f"{builds(own)} neighbour lists, at least {lists} wanted")
    require(
        solved <= (1.0 - skipped) * listed, f"{solved} of {listed} listed pairs were solved: hardly any was left out"
    )
    require(
        touching >= contacts * steps * len(deck.packing.grains),
        f"too few contacts to prove anything: {touching} in {steps} steps",
    )
    require(fallbacks == 0.0, f"{fallbacks} contacts without a regular answer")


def sheared(packing, steps=2000, strain=0.7, lists=10, skipped=0.3, contacts=1.0, before=(), **choices):
    """The box flips at strains 0.5, 1.5, ..."""
    deck = Deck(packing, surface="ellipsoid", **choices)
    deck.body = [*before, shear(strain / (steps * deck.dt())), *dump_grains(packing, steps), f"run {steps}"]
    return lambda ranks: same_as_gran(deck, ranks, lists, skipped, contacts)


def observed(packing, steps=400, strain=0.3, before=(), properties=None, own="", **choices):
    """Also while contacts are measured in every step."""
    deck = Deck(packing, surface="ellipsoid", **choices)
    deck.body = [*before, shear(strain / (steps * deck.dt()))]
    return sphere_bitwise.same_as_gran(deck, steps, properties, own)


SIZES = (0.8, 0.9, 1.0, 1.1, 1.2)


def mixed():
    """Spheres, prolate, oblate and triaxial grains, the symmetry axis along any body axis."""
    packing = dense_packing(1.5, sizes=(0.9, 1.0, 1.1))
    shapes = ((1.0, 1.0, 1.5), (1.1, 1.1, 1.1), (1.4, 1.1, 0.9), (1.5, 1.0, 1.0), (1.2, 0.7, 1.2), (0.9, 1.3, 1.2))
    grains = [replace(g, semi_axes=shapes[k % len(shapes)], type=1 + k % 2) for k, g in enumerate(packing.grains)]
    return replace(packing, grains=grains, types=2)


def half_spheres():
    """Spheres in one half of the box, so that a rank may hold nothing else, and spheroids in the other."""
    packing = dense_packing(1.0, minimum=200)
    middle = 0.5 * packing.edges[0]
    grains = [replace(g, semi_axes=(0.9, 0.9, 1.1)) if g.position[0] > middle else g for g in packing.grains]
    return replace(packing, grains=grains)


CURVED = "curvatureLimitFactor 2"


def tumbling(edge, count=70, seed=3, **choices):
    """Long rods that spin and fly fast, nowhere near each other at first: the closest a bound on motion comes to being
    overtaken."""
    random = np.random.default_rng(seed)
    cells = math.ceil(count ** (1 / 3))
    corners = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)[:count]
    grains = []
    for corner in corners:
        q = random.normal(size=4)
        where = (corner + 0.5) * edge / cells + random.uniform(-1.0, 1.0, size=3)
        away = where - 0.5 * edge
        grains.append(
            Grain(
                tuple(where),
                (0.5, 0.5, 2.5),
                tuple(q / np.linalg.norm(q)),
                tuple(6.0 * random.normal(size=3) - 4.0 * away / np.linalg.norm(away)),
                tuple(8.0 * random.normal(size=3)),
            )
        )
    return Packing((edge,) * 3, grains, **choices)


def rods(
    body, edge=26.0, skin=7.0, lists=5, skipped=0.8, contacts=0.005, still=False, triclinic=True, before=(), **choices
):
    packing = tumbling(edge, triclinic=triclinic)
    if still:
        packing = replace(
            packing, grains=[replace(g, velocity=(0.0, 0.0, 0.0), omega=(0.0, 0.0, 0.0)) for g in packing.grains]
        )
    deck = Deck(packing, surface="ellipsoid", **choices)
    steps = sum(int(line.split()[1]) for line in body if line.startswith("run "))
    deck.body = [
        f"neighbor {skin} bin",
        *before,
        *dump_grains(packing, steps),
        *body,
    ]  # lists that last: a rod turns far within one
    return lambda ranks: same_as_gran(deck, ranks, lists, skipped, contacts)


JUMPS = [
    line
    for k in range(8)
    for line in (
        "run 150",
        f"velocity all ramp v{'xyz'[k % 3]} {5 - 10 * (k % 2)} {10 * (k % 2) - 5} {'yzx'[k % 3]} 0 26 sum yes "
        "units box",
    )
]
# grains go with it, and move no other way
SQUEEZE = "fix squeeze all deform 1 x erate -0.5 y erate -0.5 z erate -0.5 remap x"
WALLS = [
    f"fix wall{axis}{k} all wall/gran model hertz tangential history surface ellipsoid primitive type 1 "
    f"{axis}plane {26.0 * k}"
    for axis in "xyz"
    for k in (0, 1)
]


def cohesive(ranks):
    """Cohesion acts on grains that do not touch: then the loop is the host's, which looks at everything."""
    deck = Deck(dense_packing(1.5), surface="ellipsoid", cohesion="sjkr")
    deck.body = [shear(0.3 / (600 * deck.dt())), *dump_grains(deck.packing, 600), "run 600"]
    plain = run(replace(deck, pair="gran"), ranks)
    own = run(replace(deck, body=[*SOLVER, *deck.body]), ranks)
    require_same_snapshots(own.dump("grains.dump"), plain.dump("grains.dump"), "gran/insitu against gran")
    table = own.thermo()[-1]
    require(
        table[C_SOLVER["pairs_listed"]][-1] == 0.0 and table[C_SOLVER["pairs_touching"]][-1] > 0.0,
        "not the host's loop",
    )


CASES = {
    "spheroid-0.33": sheared(dense_packing(0.33), strain=1.7),
    "spheroid-1.5": sheared(dense_packing(1.5), strain=1.7),
    "spheroid-3": sheared(dense_packing(3.0), 800),
    "spheres": sheared(dense_packing(), 1200, skipped=0.0),
    "spheres-of-five-sizes": sheared(dense_packing(sizes=SIZES), 600, 0.6, 3, 0.0),
    "frozen-spheres": sheared(dense_packing(), 600, 0.2, 3, 0.0, before=FROZEN),
    "softened-spheres": sheared(
        dense_packing(), 600, 0.6, 3, 0.0, extra="gaussianCurvature yes curvatureLimitFactor 0.5"
    ),
    "spheres-here-spheroids-there": sheared(half_spheres(), 600, 0.6, 3, 0.0, processors="* 1 1"),
    "polydisperse": sheared(dense_packing(1.5, sizes=SIZES), 1200),
    "mixed-shapes-and-types": sheared(mixed(), 1200, material=TYPES),
    "frozen-grains": sheared(dense_packing(1.5), 600, 0.2, 3, before=FROZEN),
    "narrow-contact-distance": sheared(dense_packing(1.5), 600, 0.6, 3, 0.25, contact_distance_factor=1.0),
    "gaussian-curvature": sheared(dense_packing(1.5), 600, 0.6, 3, extra=f"gaussianCurvature yes {CURVED}"),
    "mean-curvature": sheared(dense_packing(0.5), 600, 0.6, 3, extra=f"meanCurvature yes {CURVED}"),
    "mean-curvature-of-mixed-shapes": sheared(mixed(), 600, 0.6, 3, extra=f"meanCurvature yes {CURVED}"),
    "curvature-keywords-without-limit": sheared(dense_packing(1.5), 600, 0.6, 3, extra="meanCurvature yes"),
    "tangential-off": sheared(dense_packing(1.5), 600, 0.6, 3, tangential="off"),
    "tangential-no-history": sheared(dense_packing(1.5), 600, 0.6, 3, tangential="no_history"),
    "hooke": sheared(dense_packing(1.5), 600, 0.6, 3, normal="hooke"),
    "rolling-cdt": sheared(dense_packing(1.5), 600, 0.6, 3, rolling="cdt"),
    "rolling-epsd2": sheared(dense_packing(0.5), 600, 0.6, 3, rolling="epsd2"),
    "limit-force-undamped": sheared(dense_packing(1.5), 600, 0.6, 3, extra="tangential_damping off limitForce on"),
    "moved-by-nve-spheroid": sheared(
        dense_packing(0.5), 600, 0.6, 3, before=["unfix integrate", "fix integrate all nve/spheroid"]
    ),
    "cohesion": cohesive,
    "observed-spheroids": observed(dense_packing(1.5), steps=1200, strain=0.7),
    "observed-mixed-shapes-and-types": observed(mixed(), material=TYPES),
    "observed-spheres": observed(dense_packing(sizes=SIZES)),
    "observed-spheres-and-spheroids": observed(half_spheres(), processors="* 1 1"),
    "observed-frozen": observed(mixed(), strain=0.2, before=FROZEN, material=TYPES),
    "observed-tangential-off": observed(dense_packing(1.5), tangential="off"),
    "observed-tangential-no-history": observed(dense_packing(0.5), tangential="no_history"),
    "observed-undamped": observed(dense_packing(0.5), extra="tangential_damping off"),
    "observed-limit-force": observed(dense_packing(1.5), extra="limitForce on"),
    "observed-hooke": observed(dense_packing(0.5), normal="hooke", tangential="no_history"),
    "observed-hooke-two-sevenths": observed(dense_packing(1.5), normal="hooke", extra="ktToKnUser on"),
    "observed-gaussian-curvature": observed(dense_packing(1.5, sizes=SIZES), extra=f"gaussianCurvature yes {CURVED}"),
    "observed-rolling": observed(dense_packing(1.5), rolling="epsd2"),
    "observed-with-ledger": observed(dense_packing(1.5), own="ledger on"),
    "observed-stiffness": observed(dense_packing(1.5), normal="hertz/stiffness", properties=STIFFNESS),
    "tumbling-rods": rods(["run 1200"]),
    "tumbling-rods-with-jumps": rods(JUMPS),
    "tumbling-rods-in-a-deforming-box": rods(
        ["fix squeeze all deform 1 y erate -0.1 xy erate 0.4 remap v", "run 700"], skin=3.0
    ),
    "rods-squeezed-by-the-box": rods([SQUEEZE, "run 270"], edge=40.0, skin=3.0, lists=3, contacts=1e-4, still=True),
    "tumbling-rods-between-walls": rods([*WALLS, "run 1000"], boundary="f f f", triclinic=False),
    "tumbling-rods-shrink-wrapped": rods(["run 500"], boundary="s s s", triclinic=False),
    "shapes-set-between-runs": rods(
        [*WALLS, "run 155", "set group all shape 0.7 0.7 2.5", "run 60 pre no"],
        boundary="f f f",
        triclinic=False,
        lists=2,
    ),
    "between-runs": rods(
        [
            "run 60",
            "run 60 pre no post no",
            'run 90 every 30 "set atom 1*20 quat 1 2 3 40"',
            "delete_atoms group gone compress no",
            "run 60",
            "change_box all x scale 1.05 y scale 0.97 remap",
            "run 60",
            "run 60 pre no",
        ],
        before=["group gone id 5 15 25"],
        skin=3.0,
    ),
    "pushed-rods": rods(
        [
            "group pushed id 1:20",
            "unfix integrate",
            "group free subtract all pushed",
            "fix integrate free nve/superquadric integration_scheme 1",
            "fix push pushed move wiggle 3 0 0 0.5",
            "run 600",
        ]
    ),
}

if __name__ == "__main__":
    main(CASES)
