# SPDX-License-Identifier: GPL-2.0-or-later
"""displacement/shear and velocity/memory against the oracle, which reads the same series from dumps with image
flags."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from deck import Deck, number
from grainscope.columns import outputs
from oracle import comparison_motion as comparison
from oracle import correlation, motion
from packing import dense_packing, tilted
from watch import Watched, deforming, image_of, pressed, watch

F_FLOW = outputs("press/strain").of("flow")

# Sums of some hundred terms in double precision; squares of displacements of 1e-3 grains, differences of positions of
# 10.
EXACT, DISPLACED = 1e-10, 1e-9
LAGS = 8
FLOWS = {"box": ("box",), "fit": ("fit",), "layers 4": ("layers", 4)}
# Every step, so that the box of each force evaluation is known; other intervals in motion_analytic.py.
EVERY, STEPS = 1, 100


def memories(every, strain, plane):
    names = ("vy", "vx", "wz")
    return {
        Watched(
            f"memory{k}",
            f"velocity/memory component {name} every {number(every)} lags {LAGS} flow {words} plane {plane}{strain}",
            True,
            3,
            (LAGS + 1, 4),
        ): (name, flow)
        for k, (name, (words, flow)) in enumerate(zip(names, FLOWS.items()))
    }


def require_agreement(compared, tolerance, when):
    for c in compared:
        require_close(c.found, c.expected, 0.0 if c.counted else tolerance, f"{when}, {c.name}", c.scale)


def check_displacement(watched, moments, strains, plane):
    """At every call, from all calls before it."""
    calls = [(m.grains.x[m.chosen], image_of(m)[m.chosen], m.box, m.force_box, s) for m, s in zip(moments, strains)]
    for k, moment in enumerate(moments):
        vector = moment.vector(watched)
        require_close(moment.scalar(watched), vector[2], 0.0, "displacement scalar", 1.0)
        if k in (0, 1, 2, len(moments) // 2, len(moments) - 1):
            require_agreement(
                comparison.of_displacement(vector, calls[: k + 1], plane), DISPLACED, f"step {moment.step}"
            )


def check_memory(watched, name, flow, moments, strains, plane, every):
    """The samples are taken by calls, every `every` of strain."""
    taken = correlation.samples_of(strains, every)
    require(len(taken) > LAGS, f"only {len(taken)} samples")
    samples = [
        correlation.component(*motion.of_group(m.grains, m.chosen, m.box, flow, plane), name)
        for m in (moments[k] for k in taken)
    ]
    vector = moments[-1].vector(watched)
    require_close(moments[-1].scalar(watched), vector[0], 0.0, "memory scalar", 1.0)
    require_agreement(
        comparison.of_memory(vector, moments[-1].array(watched), samples, [strains[k] for k in taken], LAGS),
        EXACT,
        watched.command,
    )


def agrees(deck, flow, plane="xy", group="all", check=None):
    """Strain comes from fix press/strain, or else from a variable."""
    axes = tuple("xyz".index(a) for a in plane)
    every = 6.5 * EVERY * flow.rate * deck.dt()
    strain, words = (F_FLOW["strain"], "") if flow.length_rate else ("v_strain", " strain v_strain")
    body = [*deck.body, f"variable strain equal step*dt*{number(flow.rate)}"]

    def case(ranks):
        displacement = Watched("moved", f"displacement/shear{words}", True, 8)
        kept = memories(abs(every), words, plane)
        moments = watch(
            replace(deck, body=body),
            [displacement, *kept],
            flow,
            ranks,
            group,
            steps=STEPS,
            every=EVERY,
            thermo_every=EVERY,
            contacts=False,
            extra=(strain,),
        )
        strains = [m.printed[strain] for m in moments]
        check_displacement(displacement, moments, strains, axes)
        for watched, (name, kind) in kept.items():
            check_memory(watched, name, kind, moments, strains, axes, abs(every))
        if check:
            check(moments)

    return case


def flipped(moments):
    tilts = [m.box.edges[0, 1] for m in moments]
    require(np.abs(np.diff(tilts)).max() > 0.9 * moments[0].box.edges[0, 0], f"no flip: tilts {tilts}")


def length_moved(moments):
    require(abs(moments[-1].box.edges[1, 1] / moments[0].box.edges[1, 1] - 1.0) > 1e-4, "L_y did not move")
    flipped(moments)


SPHERES = dense_packing(atom_style="sphere")


def near_the_flip(alpha, sign=1.0, **choices):
    return Deck(tilted(dense_packing(alpha, **choices), sign * 0.495))


CASES = {
    "spheres": agrees(near_the_flip(1.0, atom_style="sphere"), deforming(0.2), check=flipped),
    "backward": agrees(near_the_flip(1.0, -1.0, atom_style="sphere"), deforming(-0.2), check=flipped),
    "spheroids": agrees(near_the_flip(1.5), deforming(0.2), check=flipped),
    "under-pressure-control": agrees(near_the_flip(1.0, atom_style="sphere"), pressed(0.2, 3e5), check=length_moved),
    "backward-under-pressure-control": agrees(
        near_the_flip(1.0, -1.0, atom_style="sphere"), pressed(-0.2, 3e5), check=length_moved
    ),
    "sheared-in-yz": agrees(Deck(SPHERES), deforming(0.2, (1, 2)), "yz"),
    "subgroup": agrees(near_the_flip(1.0, atom_style="sphere"), deforming(0.2), group="20:80", check=flipped),
}

if __name__ == "__main__":
    main(CASES)
