# SPDX-License-Identifier: GPL-2.0-or-later
"""Spheres under gran/insitu, whose own loop works on four contacts at a time or hands them to the models one by one,
move exactly as under pair_style gran, watched or not; and spheroids of models that are not compiled."""
from dataclasses import replace

from case import main, require, require_same_snapshots
from deck import Deck, Material, dump_grains, shear, thermo
from grainscope.columns import outputs
from packing import Grain, Packing, dense_packing
from plates import bed
from run import run

C_STRESS = outputs("stress/contact").of("stress")
WATCH = [
    "compute stress all stress/contact",
    "compute loss all dissipation",
    *thermo(1, "c_stress", C_STRESS["N_c"], "c_loss"),
]
SIZES = (0.8, 0.9, 1.0, 1.1, 1.2)
TYPES = Material(young=(5e6, 2e7), restitution=(0.3, 0.5, 0.5, 0.8), friction=(0.1, 0.4, 0.4, 0.9))
FROZEN = ["group cold id 1:20", "fix cold cold freeze"]
STIFFNESS = {"kn": "1e6", "kt": "5e5", "gamman": "20", "gammat": "10", "gamman_abs": "2e4", "gammat_abs": "1e4"}
STIFFNESS = {name: f"peratomtypepair 1 {value}" for name, value in STIFFNESS.items()}
LIQUID = {
    "surfaceTension": "scalar 0.05",
    "fluidViscosity": "scalar 1.0",
    "surfaceLiquidContentInitial": "scalar 0.1",
    "maxSeparationDistanceRatio": "scalar 1.1",
    "minSeparationDistanceRatio": "scalar 0.01",
    "contactAngle": "peratomtype 0.0",
}


def text_of(deck, properties):
    """The deck with more property/global before its pair style."""
    lines = list(deck.lines())
    at = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
    lines[at:at] = [f"fix {name} all property/global {name} {value}" for name, value in properties.items()]
    return "\n".join(lines) + "\n"


def same_as_gran(deck, steps, properties=None, own="", contacts=2.0):
    """`own`: words for gran/insitu alone; `contacts` per grain and step."""

    def moved(ranks, watch=(), **choices):
        body = [*watch, *deck.body, *dump_grains(deck.packing, steps), f"run {steps}"]
        return run(text_of(replace(deck, body=body, **choices), properties or {}), ranks)

    def case(ranks):
        plain = moved(ranks, pair="gran").dump("grains.dump")
        extra = f"{deck.extra} {own}".strip()
        require_same_snapshots(moved(ranks, extra=extra).dump("grains.dump"), plain, "gran/insitu against gran")
        watched = moved(ranks, WATCH, extra=extra)
        require_same_snapshots(watched.dump("grains.dump"), plain, "gran/insitu, observed each step, against gran")
        found = watched.thermo()[0][C_STRESS["N_c"]].mean() / len(deck.packing.grains)
        require(found >= contacts, f"too few contacts to prove anything: {found} per grain")

    return case


def sheared(packing=None, steps=800, strain=0.6, before=(), properties=None, own="", **choices):
    """The box flips at a strain of 0.5."""
    deck = Deck(packing or dense_packing(atom_style="sphere"), **choices)
    deck.body = [*before, shear(strain / (steps * deck.dt()))]
    return same_as_gran(deck, steps, properties, own)


def settling(ranks):
    """Grains that fall into a box of walls."""
    packing = bed(speed=1.0)
    deck = Deck(replace(packing, edges=(*packing.edges[:2], 12.0), origin=(0.0, 0.0, 0.0)), boundary="f f f")
    wall = "all wall/gran model hertz tangential history primitive type 1"
    low, high = deck.packing.origin, deck.packing.edges
    deck.body = [
        "fix gravity all gravity 9.81 vector 0 0 -1",
        *(f"fix {axis}{k} {wall} {axis}plane {(low, high)[k][n]}" for n, axis in enumerate("xyz") for k in (0, 1)),
    ]
    same_as_gran(deck, 1500, contacts=1.0)(ranks)


def parting(ranks, model):
    """Liquid bridges pull at grains that touch no longer."""
    grains = [
        Grain((side * 0.998, y, 0.0), velocity=(side * speed, 0.3 * side, 0.0))
        for y, speed in ((-3.0, 0.2), (0.0, 1.0), (3.0, 3.0))
        for side in (-1, 1)
    ]
    packing = Packing((16.0, 16.0, 16.0), grains, atom_style="sphere", origin=(-8.0, -8.0, -8.0))
    deck = Deck(packing, cohesion=model, extra="tangential_damping off", timestep=1e-4, contact_distance_factor=1.2)
    same_as_gran(deck, 600, LIQUID, contacts=0.0)(ranks)


def narrow(ranks):
    """Without a margin of the neighbour lists pair_style gran keeps springs of contacts that opened until the next
    list. Under gran/insitu the factor makes no difference."""
    snapshots = []
    for factor in (1.0, 1.05):
        deck = Deck(dense_packing(atom_style="sphere"), contact_distance_factor=factor)
        deck.body = [shear(0.6 / (800 * deck.dt())), *dump_grains(deck.packing, 100), "run 800"]
        snapshots.append(run(deck, ranks).dump("grains.dump"))
    require_same_snapshots(*snapshots, "contact_distance_factor 1.0 against 1.05")


CASES = {
    "hertz": sheared(steps=2000, strain=1.7),
    "hooke": sheared(normal="hooke"),
    "hooke-two-sevenths": sheared(normal="hooke", extra="ktToKnUser on tangential_damping off"),
    "hertz-stiffness": sheared(normal="hertz/stiffness", properties=STIFFNESS),
    "hooke-stiffness": sheared(normal="hooke/stiffness", properties=STIFFNESS),
    "hooke-stiffness-absolute": sheared(
        normal="hooke/stiffness", extra="absolute_damping on limitForce on", properties=STIFFNESS
    ),
    "tangential-off": sheared(tangential="off"),
    "tangential-no-history": sheared(tangential="no_history"),
    "tangential-no-history-of-hooke": sheared(normal="hooke", tangential="no_history"),
    "tangential-damping-off": sheared(extra="tangential_damping off"),
    "limit-force": sheared(extra="limitForce on"),
    "two-types": sheared(dense_packing(atom_style="sphere", types=2), material=TYPES),
    "polydisperse": sheared(dense_packing(atom_style="sphere", sizes=SIZES)),
    "frozen": sheared(strain=0.2, before=FROZEN),
    "frozen-of-two-types": sheared(
        dense_packing(atom_style="sphere", sizes=SIZES, types=2), strain=0.2, before=FROZEN, material=TYPES
    ),
    "rolling-cdt": sheared(rolling="cdt"),
    "rolling-epsd2": sheared(rolling="epsd2"),
    "cohesion-sjkr": sheared(cohesion="sjkr"),
    "ledger": sheared(own="ledger on"),
    "settling-between-walls": settling,
    "bridges-washino": lambda ranks: parting(ranks, "washino/capillary/viscous"),
    "bridges-easo": lambda ranks: parting(ranks, "easo/capillary/viscous"),
    "narrow-contact-distance": narrow,
    "types-that-no-grain-has": sheared(replace(dense_packing(atom_style="sphere"), types=9)),
    "types-that-no-spheroid-has": sheared(replace(dense_packing(1.5), types=9), surface="ellipsoid"),
    "spheroids-of-hertz-stiffness": sheared(
        dense_packing(1.5), surface="ellipsoid", normal="hertz/stiffness", properties=STIFFNESS
    ),
    "spheroids-of-hertz-stiffness-without-friction": sheared(
        dense_packing(1.5), surface="ellipsoid", normal="hertz/stiffness", tangential="off", properties=STIFFNESS
    ),
    "spheroids-of-hooke-stiffness": sheared(
        dense_packing(1.5), surface="ellipsoid", normal="hooke/stiffness", properties=STIFFNESS
    ),
}

if __name__ == "__main__":
    main(CASES)
