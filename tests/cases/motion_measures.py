# SPDX-License-Identifier: GPL-2.0-or-later
"""fluctuation, layering and velocity/correlation against the oracle, on sheared packings and in every mean flow."""
from dataclasses import replace

from case import main, require, require_close
from deck import Deck
from oracle import comparison_motion as comparison
from packing import dense_packing, tilted
from watch import Flow, Watched, deforming, pressed, watch

# Sums of some hundred terms in double precision.
EXACT = 1e-10
PLANES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}
FLOWS = {"box": ("box",), "rate 0.03": ("rate", 0.03), "fit": ("fit",), "layers 4": ("layers", 4)}


def fluctuations(plane):
    """One compute for each mean flow, and what the oracle needs to know of it."""
    return {
        Watched(f"flow{k}", f"fluctuation plane {plane} flow {words} layers 6", True, 14, (6, 5)): flow
        for k, (words, flow) in enumerate(FLOWS.items())
    }


LAYERINGS = {
    Watched("across", "layering", True, 4, (21, 2)): (1, 40),
    Watched("along", "layering axis x layers 12", True, 4, (7, 2)): (0, 12),
}


def agrees(deck, flow=Flow(), plane="xy", group="all", settle=50, check=None):
    def case(ranks):
        moving = fluctuations(plane)
        moments = watch(
            deck, [*moving, *LAYERINGS], flow, ranks, group, settle=settle, every=5, thermo_every=5, contacts=False
        )
        for moment in moments:
            for watched, kind in moving.items():
                vector = moment.vector(watched)
                require_close(moment.scalar(watched), vector[9], 0.0, "fluctuation scalar", 1.0)
                require_agreement(
                    comparison.of_fluctuation(vector, moment.array(watched), moment, kind, PLANES[plane], 6),
                    f"step {moment.step}, {watched.command}",
                )
            for watched, (axis, layers) in LAYERINGS.items():
                vector = moment.vector(watched)
                require_close(
                    moment.scalar(watched), vector[0] / vector[2] if vector[2] else 0.0, 1e-14, "layering scalar", 1.0
                )
                require_agreement(
                    comparison.of_layering(vector, moment.array(watched), moment, axis, layers),
                    f"step {moment.step}, {watched.command}",
                )
        require(len(moments) == 5, f"{len(moments)} snapshots")
        if check:
            check(moments)

    return case


def require_agreement(compared, when):
    for c in compared:
        require_close(c.found, c.expected, 0.0 if c.counted else EXACT, f"{when}, {c.name}", c.scale)


def flipped(moments):
    tilts = [m.box.edges[0, 1] for m in moments]
    require(tilts[0] > 0.0 > tilts[-1], f"no flip: the tilt went from {tilts[0]} to {tilts[-1]}")


def flipping(deck):
    lx, ly, _ = deck.packing.edges
    return agrees(deck, deforming(0.002 * lx / ly / (20 * deck.dt())), settle=0, check=flipped)


def length_moved(moments):
    require(abs(moments[-1].box.rate[1, 1]) > 1e-4, "L_y does not move")


SPHERES = dense_packing(atom_style="sphere")


def triaxial():
    packing = dense_packing(1.5, wobble=2.0)
    return replace(packing, grains=[replace(g, semi_axes=(0.6, 0.8, 1.1)) for g in packing.grains])


CASES = {
    "spheres": agrees(Deck(SPHERES), deforming(0.05)),
    "spheres-at-rest": agrees(Deck(SPHERES)),
    "spheres-polydisperse": agrees(
        Deck(dense_packing(atom_style="sphere", sizes=(0.8, 1.0, 1.2), overlap=0.1)), deforming(0.05)
    ),
    **{
        f"spheroid-{alpha:g}": agrees(Deck(dense_packing(alpha)), deforming(0.05))
        for alpha in (0.33, 0.67, 1.0, 1.5, 3.0)
    },
    "triaxial": agrees(Deck(triaxial()), deforming(0.05)),
    "spheres-through-a-flip": flipping(Deck(tilted(SPHERES, 0.499))),
    "tilted-backward": agrees(Deck(tilted(SPHERES, -0.48)), deforming(-0.05)),
    "under-pressure-control": agrees(Deck(SPHERES), pressed(0.05), settle=100, check=length_moved),
    "sheared-in-xz": agrees(Deck(SPHERES), deforming(0.05, (0, 2)), "xz"),
    "sheared-in-yz": agrees(Deck(SPHERES), deforming(0.05, (1, 2)), "yz"),
    "subgroup": agrees(Deck(SPHERES), deforming(0.05), group="20:80"),
    "group-of-one": agrees(Deck(SPHERES), deforming(0.05), group="20:20"),
}

if __name__ == "__main__":
    main(CASES)
