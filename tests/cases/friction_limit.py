# SPDX-License-Identifier: GPL-2.0-or-later
"""Mobilisation is the tangential force over the limit that the friction law cuts it by: with cohesion mu times the
normal force before cohesion is added. Contact by contact, grain by grain and on the grains' surface, from limits
written down on their own."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close
from deck import Deck, Material, dump_grains, dump_local, shear, thermo
from grainscope.columns import outputs
from oracle.contacts import grain_table
from oracle.state import ROW_WIDTH, grains_of, rows_of
from oracle.surface import surface_table
from packing import Grain, Packing, dense_packing
from run import run

C_EACH = outputs("contact/grain").of("each")
C_LOSS = outputs("dissipation").of("loss")
C_SURFACE = outputs("contact/surface").of("surface")

ENERGY, FRICTION = 1e5, 0.3
# Positions of order 10 give overlaps of order 0.01.
ROUNDING = 1e-10


def cohesion_of(rows, grains):
    """-energy x area of two spheres with the contact's overlap and the radii of equal volume."""
    radius = np.cbrt(np.prod(grains.shape, axis=1))
    i, j = grains.index(rows["id"][:, 0]), grains.index(rows["id"][:, 1])
    distance = radius[i] + radius[j] - rows["overlap"]
    height = (distance**2 + radius[i] ** 2 - radius[j] ** 2) / (2.0 * distance)
    return -ENERGY * math.pi * (radius[i] ** 2 - height**2)


def of_spheroids(extra):
    """contact/local, contact/grain and contact/surface of sticky spheroids in shear."""

    def case(ranks):
        packing, steps = dense_packing(1.5), 40
        deck = Deck(
            packing,
            surface="ellipsoid",
            cohesion="sjkr",
            extra=extra,
            material=Material(friction=(FRICTION,), cohesion=(ENERGY,)),
        )
        bins = [C_SURFACE[k, "mobilisation"] for k in range(1, 11)]
        deck.body = [
            shear(0.05),
            "compute rows all contact/local",
            "compute each all contact/grain",
            "compute surface all contact/surface",
            *dump_grains(packing, steps),
            *dump_local("rows", ROW_WIDTH, steps, "rows"),
            f"dump each all custom 40 each.dump id {C_EACH['N_c']} {C_EACH['N_sliding']} {C_EACH['mobilisation']}",
            'dump_modify each sort id format "%d %.17g %.17g %.17g"',
            *thermo(steps, "vol", *bins),
            f"run {steps}",
        ]
        result = run(deck, ranks)
        grains, rows = grains_of(result.dump("grains.dump")[-1][1]), rows_of(result.dump("rows.dump")[-1][1], "rows")
        repulsion = rows["fn"] - cohesion_of(rows, grains)
        limit = FRICTION * np.abs(rows["fn"] if "tangential_reduce on" in extra else repulsion)
        expected = np.linalg.norm(rows["ft"], axis=1) / limit
        require_close(rows["mobilisation"], expected, ROUNDING, "mobilisation", 1.0)
        at_limit = rows["sliding"] > 0
        require(at_limit.sum() > 20 and not at_limit.all(), f"{at_limit.sum()} of {len(at_limit)} contacts slide")
        require_close(
            rows["mobilisation"][at_limit], np.ones(at_limit.sum()), ROUNDING, "mobilisation of those that slide"
        )
        require(rows["mobilisation"].max() <= 1.0 + 1e-15, "a mobilisation above 1")
        by_total = np.linalg.norm(rows["ft"], axis=1) / (FRICTION * np.abs(rows["fn"]))
        require(
            "on" in extra.split("tangential_reduce")[-1] or by_total.max() > 2.0,
            "cohesion is too weak to prove anything",
        )

        each = result.dump("each.dump")[-1][1]
        table = grain_table({**rows, "mobilisation": expected}, grains, np.ones(len(grains.ids), bool))
        require_close(each[C_EACH["mobilisation"]], table[:, 4], ROUNDING, "contact/grain", 1.0)
        volume = result.thermo()[0]["vol"][-1]
        on_surface = surface_table({**rows, "mobilisation": expected}, grains, volume, np.ones(len(grains.ids), bool))[
            0
        ][:, 7]
        require_close([result.thermo()[0][b][-1] for b in bins], on_surface, ROUNDING, "contact/surface", 1.0)

    return case


def balls_that_slide(ranks):
    """Two balls glued together so that repulsion and cohesion all but cancel: mobilisation 1, not their ratio."""
    grains = [Grain((side * 0.995, 0.0, 0.0), velocity=(0.0, -0.2 * side, 0.0)) for side in (-1, 1)]
    packing = Packing((12.0, 12.0, 12.0), grains, atom_style="sphere", origin=(-6.0, -6.0, -6.0))
    deck = Deck(
        packing,
        cohesion="sjkr",
        extra="tangential_damping off",
        timestep=2e-4,
        material=Material(friction=(FRICTION,), cohesion=(8e4,)),
    )
    deck.body = ["compute rows all contact/local", *dump_local("rows", ROW_WIDTH, 1, "rows"), "run 200"]
    slid, ratio = 0, 0.0
    for _, columns in run(deck, ranks).dump("rows.dump"):
        rows = rows_of(columns, "rows")
        if not len(rows["fn"]) or not rows["sliding"][0]:
            continue
        slid += 1
        ratio = max(ratio, np.linalg.norm(rows["ft"][0]) / (FRICTION * abs(rows["fn"][0])))
        require_close(rows["mobilisation"], [1.0], 1e-14, "mobilisation")
    require(
        slid > 20 and ratio > 30.0,
        f"{slid} sliding steps, F_t up to {ratio} of the total normal force: nothing is proved",
    )


LIQUID = {
    "surfaceTension": "scalar 0.05",
    "fluidViscosity": "scalar 2.0",
    "surfaceLiquidContentInitial": "scalar 0.1",
    "maxSeparationDistanceRatio": "scalar 1.1",
    "minSeparationDistanceRatio": "scalar 0.01",
    "contactAngle": "peratomtype 0.0",
}


def liquid_bridge(model):
    """A bridge drags too, without a limit: mobilisation and friction are of the dry part alone."""

    def case(ranks):
        grains = [Grain((side * 0.998, 0.0, 0.0), velocity=(0.0, -0.5 * side, 0.0)) for side in (-1, 1)]
        packing = Packing((12.0, 12.0, 12.0), grains, atom_style="sphere", origin=(-6.0, -6.0, -6.0))
        deck = Deck(
            packing,
            cohesion=model,
            extra="tangential_damping off",
            material=Material(friction=(FRICTION,)),
            timestep=1e-4,
        )
        lines = list(
            replace(
                deck,
                body=[
                    "compute rows all contact/local",
                    *dump_local("rows", ROW_WIDTH, 1, "rows"),
                    "compute loss all dissipation mode instantaneous",
                    *thermo(1, C_LOSS["P_t"]),
                    "run 100",
                ],
            ).lines()
        )
        at = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
        lines[at:at] = [f"fix {name} all property/global {name} {value}" for name, value in LIQUID.items()]
        result = run("\n".join(lines) + "\n", ranks)
        losses, slid, dragged, stuck = result.thermo()[0][C_LOSS["P_t"]], 0, 0.0, 0.0
        for step, columns in result.dump("rows.dump"):
            rows = rows_of(columns, "rows")
            if not len(rows["fn"]):
                continue
            elastic = 4.0 / 3.0 * 0.5 * 5e6 / 0.91 * math.sqrt(0.5 * rows["overlap"][0]) * rows["overlap"][0]
            limit = FRICTION * abs(elastic + rows["fn_damping"][0])
            # Nase et al.: drag of two spheres of R* = 1/2 at the smallest separation that the model takes, 0.01 R*.
            drag = -6.0 * math.pi * 2.0 * 0.5 * (0.5333333 * math.log(100.0) + 0.9588) * rows["ut"][0]
            dry = rows["ft"][0] - drag
            require_close(rows["mobilisation"][0], np.linalg.norm(dry) / limit, 1e-9, "mobilisation", 1.0)
            loss = -dry @ rows["ut"][0] if rows["sliding"][0] else 0.0
            require_close(losses[step], loss, 1e-9, "P_t", max(abs(loss), limit))
            slid += int(rows["sliding"][0])
            stuck = max(stuck, rows["mobilisation"][0] * (1 - rows["sliding"][0]))
            dragged = max(dragged, np.linalg.norm(drag) / limit)
        require(
            slid > 5 and 0.1 < stuck < 1.0 and dragged > 0.01,
            f"{slid} sliding steps, {stuck}, {dragged}: nothing is proved",
        )

    return case


CASES = {
    "spheroids": of_spheroids("tangential_damping off"),
    "spheroids-cohesion-reduces": of_spheroids("tangential_damping off tangential_reduce on"),
    "balls-that-slide": balls_that_slide,
    "liquid-bridge-washino": liquid_bridge("washino/capillary/viscous"),
    "liquid-bridge-easo": liquid_bridge("easo/capillary/viscous"),
}

if __name__ == "__main__":
    main(CASES)
