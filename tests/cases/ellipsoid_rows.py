# SPDX-License-Identifier: GPL-2.0-or-later
"""The rows of compute contact/local for ellipsoids against contacts found on their own: which grains touch, where, with
what normal, overlap and force."""
import math

import numpy as np

from case import main, require, require_close
from deck import POISSON, YOUNG, Deck, box_columns, dump_grains, dump_local, shear, thermo
from oracle import ellipsoid
from oracle.state import ROW_WIDTH, box_of, grains_of, rows_of
from packing import dense_packing
from run import run

RATE, STEPS = 0.03, 20
RESTITUTION = 0.5
# What the host's own solver is worth: it stops when normals agree to about 1e-5, and positions follow. The oracle
# bisects to 1e-16 and loses digits where it subtracts.
TOLERANCE = {"superquadric": 1e-4, "ellipsoid": 1e-10}


def geometry_agrees(rows, expected, smallest, tolerance):
    keys = [(int(a), int(b), *map(int, image)) for (a, b), image in zip(rows["id"], rows["image"])]
    overlaps = {key: overlap for key, (_, _, overlap) in expected.items()}
    missing = [k for k in overlaps.keys() - set(keys) if overlaps[k] > tolerance * smallest]
    require(not missing, f"no rows for {missing}")
    for k, key in enumerate(keys):
        require(
            key in expected or rows["overlap"][k] < tolerance * smallest,
            f"row {key}, overlap {rows['overlap'][k]}: touches nothing",
        )
        if key in expected:
            point, normal, overlap = expected[key]
            require_close(rows["normal"][k], normal, tolerance, f"normal of {key}", 1.0)
            require_close(rows["overlap"][k], overlap, tolerance, f"overlap of {key}", smallest)
            require_close(rows["point"][k], point, tolerance, f"point of {key}", 2.0 * smallest)


def kinematics_agree(rows, grains, box):
    """At step 0, where velocities are those of the deck: u = v + omega x lever, of i less that of j's image."""
    i, j = grains.index(rows["id"][:, 0]), grains.index(rows["id"][:, 1])
    lever_i = rows["point"] - grains.x[i]
    u = (
        grains.v[i]
        + np.cross(grains.omega[i], lever_i)
        - grains.v[j]
        - rows["image"] @ box.rate.T
        - np.cross(grains.omega[j], lever_i + rows["branch"])
    )
    un = np.einsum("ca,ca->c", u, rows["normal"])
    require_close(rows["un"], un, 1e-9, "normal velocity")
    require_close(rows["ut"], u - un[:, None] * rows["normal"], 1e-9, "tangential velocity")
    require_close(rows["branch"], grains.x[i] - grains.x[j] - rows["image"] @ box.edges.T, 1e-12, "branch")


def forces_agree(rows, grains):
    """Hertz with R* of the spheres of equal volume (the host's default), at the overlap of the row."""
    i, j = grains.index(rows["id"][:, 0]), grains.index(rows["id"][:, 1])
    radius = np.cbrt(np.prod(grains.shape, axis=1))
    reduced = radius[i] * radius[j] / (radius[i] + radius[j])
    mass = grains.mass[i] * grains.mass[j] / (grains.mass[i] + grains.mass[j])
    modulus = YOUNG / (2 * (1 - POISSON**2))
    root = np.sqrt(reduced * rows["overlap"])
    elastic = 4.0 / 3.0 * modulus * root * rows["overlap"]
    log_e = math.log(RESTITUTION)
    damping = (
        2.0
        * math.sqrt(5.0 / 6.0)
        * log_e
        / math.hypot(log_e, math.pi)
        * np.sqrt(2.0 * modulus * root * mass)
        * rows["un"]
    )
    require_close(rows["fn_damping"], damping, 1e-9, "damping force")
    require_close(rows["fn"], elastic + damping, 1e-9, "normal force")
    require_close(rows["force"], rows["fn"][:, None] * rows["normal"] + rows["ft"], 1e-12, "force, from its parts")
    require_close(
        np.einsum("ca,ca->c", rows["ft"], rows["normal"]),
        np.zeros(len(rows["fn"])),
        1e-12,
        "tangential force along the normal",
        float(np.abs(rows["fn"]).max()),
    )


def agrees(packing, surface="superquadric"):
    deck = Deck(
        packing,
        surface=surface,
        body=[
            shear(RATE),
            "compute rows all contact/local",
            *thermo(1, *box_columns()),
            *dump_grains(packing, STEPS),
            *dump_local("rows", ROW_WIDTH, STEPS, "rows"),
            f"run {STEPS}",
        ],
    )
    smallest = min(packing.grains[0].semi_axes)

    def case(ranks):
        result = run(deck, ranks)
        table = result.thermo()[0]
        for (step, columns), (_, dumped) in zip(result.dump("grains.dump"), result.dump("rows.dump")):
            grains, box, rows = grains_of(columns), box_of(table, max(step - 1, 0), RATE), rows_of(dumped, "rows")
            require(len(rows["fn"]) > len(grains.ids), f"only {len(rows['fn'])} contacts")
            geometry_agrees(rows, ellipsoid.contacts(grains, box), smallest, TOLERANCE[surface])
            forces_agree(rows, grains)
            if step == 0:
                kinematics_agree(rows, grains, box)

    return case


CASES = {f"spheroid-{alpha:g}": agrees(dense_packing(alpha, wobble=0.3)) for alpha in (0.33, 1.5, 3.0)}
CASES.update(
    {f"ellipsoid-{alpha:g}": agrees(dense_packing(alpha, wobble=0.3), "ellipsoid") for alpha in (0.33, 1.5, 3.0)}
)

if __name__ == "__main__":
    main(CASES)
