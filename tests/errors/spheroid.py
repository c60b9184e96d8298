# SPDX-License-Identifier: GPL-2.0-or-later
"""What fix nve/spheroid refuses."""
from dataclasses import replace

from case import main
from deck import Deck
from packing import Grain, Packing, dense_packing
from refusal import refusal

INTEGRATE = ["unfix integrate", "fix integrate all nve/spheroid"]
ADVICE = "use fix nve/superquadric"


def grains(*changed):
    """Six spheroids far apart; (number, semi-axes, blockiness) of those that are none."""
    six = [Grain((-15.0 + 6.0 * k, 0.0, 0.0), (1.0, 1.0, 1.5)) for k in range(6)]
    for k, semi_axes, blockiness in changed:
        six[k - 1] = replace(six[k - 1], semi_axes=semi_axes, blockiness=blockiness)
    return Packing((40.0, 20.0, 20.0), six, origin=(-20.0, -10.0, -10.0), triclinic=False)


def refused(*words, packing=None, fix="fix integrate all nve/spheroid", before=(), after=("run 1",)):
    return refusal(lambda: Deck(packing or grains(), body=["unfix integrate", *before, fix, *after]), *words)


ROUND = (2.0, 2.0)
INSERT = [
    "region top block -20 20 -10 10 4 8 units box",
    "fix odd all particletemplate/superquadric 15485863 atom_type 1 density constant 1000 shape constant 1 1.2 1.5 "
    "blockiness constant 2 2 volume_limit 1e-9",
    "fix kinds all particledistribution/discrete 15485867 1 odd 1.0",
    "fix insert all insert/pack seed 32452843 distributiontemplate kinds insert_every 50 vel constant 0 0 0 "
    "overlapcheck yes all_in yes particles_in_region 3 region top",
    "run 200",
]
CFD = ["fix cfd all couple/cfd couple_every 100 mpi", "fix drag all couple/cfd/force/implicit", "run 1"]
CASES = {
    "spheres": refused(
        "fix nve/spheroid: needs atom_style superquadric, got 'sphere'", packing=dense_packing(atom_style="sphere")
    ),
    "triaxial-grains": refused(
        "fix nve/spheroid: grain 2 has three different moments of inertia (semi-axes 1 1.2 1.5, blockiness 2 2)",
        ADVICE,
        packing=grains((5, (1.0, 2.0, 3.0), ROUND), (2, (1.0, 1.2, 1.5), ROUND)),
    ),
    "boxy-about-an-equator": refused(
        "grain 4 has three different moments of inertia (semi-axes 1.5 1 1, blockiness 4 2)",
        ADVICE,
        packing=grains((4, (1.5, 1.0, 1.0), (4.0, 2.0))),
    ),
    "triaxial-between-runs": refused(
        "grain 3 has three different moments of inertia (semi-axes 1 2 3, blockiness 2 2)",
        ADVICE,
        after=("run 10", "set atom 3 shape 1 2 3", "run 1"),
    ),
    "triaxial-inserted": refused(
        "has three different moments of inertia (semi-axes 1 1.2 1.5, blockiness 2 2)", ADVICE, after=INSERT
    ),
    "implicit-cfd-coupling": refused(
        "fix nve/spheroid: fix drag (couple/cfd/force/implicit) leaves its torque to the integrator", ADVICE, after=CFD
    ),
}

if __name__ == "__main__":
    main(CASES)
