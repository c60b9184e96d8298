# SPDX-License-Identifier: GPL-2.0-or-later
"""pair_style gran/insitu moves grains exactly as pair_style gran does, watched or not."""
from dataclasses import replace

from case import main, require, require_same_snapshots
from deck import Deck, Material, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import dense_packing
from run import run

C_STRESS = outputs("stress/contact").of("stress")

STEPS = 500
STRAIN = 0.7  # the box flips once, at 0.5


def sheared(packing, **choices):
    deck = Deck(packing, **choices)
    deck.body = [shear(STRAIN / (STEPS * deck.dt())), *dump_grains(packing, STEPS)]
    return deck


def requires_same_trajectory(deck):
    def case(ranks):
        grains = len(deck.packing.grains)
        plain = run(replace(deck, pair="gran", body=[*deck.body, f"run {STEPS}"]), ranks).dump("grains.dump")
        idle = run(replace(deck, body=[*deck.body, f"run {STEPS}"]), ranks).dump("grains.dump")
        watched = run(
            replace(
                deck,
                body=[
                    *deck.body,
                    "compute stress all stress/contact",
                    "compute loss all dissipation",
                    *thermo(1, "c_stress", C_STRESS["N_c"], "c_loss"),
                    f"run {STEPS}",
                ],
            ),
            ranks,
        )
        require_same_snapshots(idle, plain, "gran/insitu against gran")
        require_same_snapshots(watched.dump("grains.dump"), plain, "gran/insitu, observed each step, against gran")
        contacts = watched.thermo()[0][C_STRESS["N_c"]]
        require(
            contacts.mean() >= 2 * grains, f"too few contacts to prove anything: {contacts.mean()} of {grains} grains"
        )

    return case


ALPHAS = (0.33, 1.5, 3.0)
SIZES = (0.8, 0.9, 1.0, 1.1, 1.2)
CASES = {
    "spheres": sheared(dense_packing(atom_style="sphere")),
    "spheres-as-superquadrics": sheared(dense_packing()),
    **{f"spheroid-{alpha:g}": sheared(dense_packing(alpha)) for alpha in ALPHAS},
    "polydisperse": sheared(dense_packing(1.5, sizes=SIZES)),
    "two-types": sheared(
        dense_packing(1.5, types=2),
        material=Material(young=(5e6, 2e7), restitution=(0.3, 0.5, 0.5, 0.8), friction=(0.1, 0.4, 0.4, 0.9)),
    ),
    "tangential-off": sheared(dense_packing(1.5), tangential="off"),
    "tangential-no-history": sheared(dense_packing(1.5), tangential="no_history"),
    "rolling-cdt": sheared(dense_packing(1.5), rolling="cdt"),
    "hooke": sheared(dense_packing(1.5), normal="hooke"),
    "tangential-damping-off": sheared(dense_packing(1.5), extra="tangential_damping off"),
    "gaussian-curvature": sheared(dense_packing(1.5), extra="gaussianCurvature yes"),
    "limit-force": sheared(dense_packing(1.5), extra="limitForce on"),
    "uncompiled-combination": sheared(dense_packing(1.5), tangential="no_history", cohesion="sjkr"),
    "boxy-grains": sheared(dense_packing(1.5, blockiness=(4.0, 3.0), overlap=-0.12)),
}

if __name__ == "__main__":
    main({name: requires_same_trajectory(deck) for name, deck in CASES.items()})
