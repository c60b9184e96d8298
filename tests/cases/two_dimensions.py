# SPDX-License-Identifier: GPL-2.0-or-later
"""Discs in two dimensions: every measure against numpy, or LIGGGHTS's own compute pressure; the depth of the box, which
means nothing, changes nothing."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from catalogue import DIRECT, DIRECTION, FABRIC, FLUCTUATION, GRAIN, LAYERING, MESH
from deck import POISSON, YOUNG, Deck, thermo
from everything import INSTANT, NEMATIC, RATE, STEP, STRESS, Questions, differences, press
from grainscope.columns import outputs
from oracle import correlation as pairs
from oracle.measures import (
    dissipation_instantaneous,
    friction_of_step,
    normal_loss_of_step,
    six,
    stress_vector,
)
from oracle.motion import fluctuation, layer_of, of_group
from packing import Grain, Packing, disc_packing, tilted
from run import run
from watch import deforming, watch

C_STRESS = outputs("stress/contact").of("s")
SUMS = 1e-10  # in another order


def in_plane(box):
    """Its volume is the area of the plane."""
    edges = box.edges.copy()
    edges[2, 2] = 1.0
    return replace(box, edges=edges)


def any_depth(ranks):
    """Every number that there is, and the motion to the last bit."""
    results = []
    for depth in (1.0, 20.0):
        deck = Deck(disc_packing(depth=depth), extra="ledger on")
        questions = Questions(deck.packing)
        body = [press(2e5), *questions.defined(), *questions.output(10), "run 300"]
        results.append(run(replace(deck, body=body), ranks))
    for other in results[1:]:
        found = {name: value for name, value in differences(questions, other, results[0]).items() if "box" not in name}
        for name, value in found.items():
            require(value <= SUMS, f"another depth of the box, {name}: off by {value:.3e}")
        require_same_snapshots(
            [
                (step, {k: v for k, v in columns.items() if k[:2] != "c_"})
                for step, columns in other.dump("grains.dump")
            ],
            [
                (step, {k: v for k, v in columns.items() if k[:2] != "c_"})
                for step, columns in results[0].dump("grains.dump")
            ],
            "another depth of the box",
        )


def stress(ranks):
    """By the rows of contacts and the grains; and the virial of compute pressure over the area."""
    host = ["c_pr[1]", "c_pr[2]", "c_pr[4]"]
    flow = deforming(RATE)
    deck = Deck(disc_packing(), body=["compute pr all pressure thermo_temp virial"])
    for moment in watch(deck, [STRESS], flow, ranks, every=20, steps=100, extra=host):
        box = in_plane(moment.force_box)
        expected = stress_vector(moment.rows, moment.grains, box, moment.chosen, YOUNG, 1.0)
        names = outputs("stress/contact")
        expected[names.at("N2")] = 0.0
        mean_diameter = 2.0 * moment.grains.radius.mean()
        expected[names.at("kappa")] = (YOUNG * mean_diameter / expected[names.at("P")]) ** (2.0 / 3.0)
        found = moment.vector(STRESS)
        for first, last in ((0, 26), (26, 29), (29, 32), (32, 34), (34, 35), (35, 36)):
            require_close(found[first:last], expected[first:last], SUMS, f"stress/contact from {first + 1}")
        for name in names.names("vector"):
            if name[:1] == "s" and "z" in name[1:3]:
                require(moment.printed[STRESS.columns()[names.index(name)]] == 0.0, f"{name} is not 0")
        virial = [moment.printed[c] for c in host]
        scale = abs(virial[0])
        require_close([-found[0], -found[1], -found[6]], virial, SUMS, "compute pressure", scale)


def lattice(ranks):
    """A square lattice at rest: sigma = sum F r/area, with the force of Hertz's law."""
    step, count = 1.99, 8
    grains = [Grain(((i + 0.5) * step, (k + 0.5) * step, 0.0)) for i in range(count) for k in range(count)]
    for depth in (1.0, 10.0):
        packing = Packing(
            (count * step, count * step, depth),
            grains,
            atom_style="sphere",
            origin=(0.0, 0.0, -0.5 * depth),
            dimension=2,
        )
        body = [
            "compute s all stress/contact",
            "compute mean all stress/contact pressure mean",
            *thermo(1, "c_mean", *C_STRESS.vector()),
            "run 0",
        ]
        table = run(Deck(packing, body=body), ranks).thermo()[0]
        modulus = YOUNG / (2.0 * (1.0 - POISSON**2))
        force = 4.0 / 3.0 * modulus * math.sqrt(0.5) * (2.0 - step) ** 1.5
        for name in ("sxx", "syy"):
            require_close(table[C_STRESS[name]], [-force / step], 1e-9, name)
        require_close(table["c_mean"], [force / step], 1e-9, "mean pressure, of two directions")
        require_equal(table[C_STRESS["szz"]], [0.0], "szz")
        require_close(table[C_STRESS["N_c"]], [2.0 * count**2], SUMS, "N_c")


def motion(ranks):
    """Fluctuations, whose rotational energy is that of discs; layers; directions."""
    flow = deforming(RATE)
    computes = [FLUCTUATION, LAYERING, DIRECTION]
    for moment in watch(Deck(disc_packing()), computes, flow, ranks, every=20, steps=60, settle=50):
        box, grains = in_plane(moment.box), moment.grains
        vector, array = fluctuation(grains, moment.chosen, box, layers=4)
        _, dw = of_group(grains, moment.chosen, box)
        vector[7] = 0.25 * grains.mass @ (grains.radius**2 * (dw**2).sum(axis=1))
        vector[8] = vector[7] / vector[6]
        found = moment.vector(FLUCTUATION)
        for first, last in ((0, 3), (3, 6), (6, 8), (8, 10), (10, 12), (12, 14)):
            require_close(found[first:last], vector[first:last], SUMS, f"fluctuation from {first + 1}")
        require_close(moment.array(FLUCTUATION)[:, 1:], array[:, 1:], 1e-9, "layers of fluctuation", array[:, 1].max())
        require(found[2] == found[3] == found[4] == 0.0, "motion out of the plane")
        require_layers(moment.array(LAYERING), grains, box)
        require_directions(moment.array(DIRECTION), moment.rows)


def require_layers(found, grains, box, layers=10):
    length, count = box.edges[1, 1], np.bincount(layer_of(grains.x, box, 1, layers), minlength=layers)
    area, n = box.volume, len(grains.x) / box.volume
    dn = count * layers / area - n
    for lag in range(layers // 2 + 1):
        integral = np.sum(dn * np.roll(dn, -lag)) * length / layers
        expected = box.edges[0, 0] / (n * length) * integral
        require_close(found[lag, 1], expected, SUMS, f"layering at lag {lag}", n * layers)
        require_close(found[lag, 0], lag * length / layers, SUMS, "lag")


def require_directions(found, rows, bins=12):
    beta = np.arctan2(rows["normal"][:, 1], rows["normal"][:, 0]) % np.pi
    where = np.minimum((beta / np.pi * bins / 2).astype(int), bins // 2 - 1)
    count = np.bincount(where, minlength=bins // 2)
    force = np.bincount(where, np.abs(rows["fn"]), bins // 2)
    friction = np.bincount(where, np.linalg.norm(rows["ft"], axis=1), bins // 2)
    names = outputs("contact/direction")
    for name, expected in (("N_c", count), ("F_n_sum", force), ("F_t_sum", friction)):
        require_close(found[:, names.at(name)], np.tile(expected, 2), SUMS, f"contact/direction {name}")
    require_close(found[:, names.at("density")].sum() * 2.0 * np.pi / bins, 1.0, SUMS, "integral of the density")


def losses(ranks):
    """Powers and contacts by the rows; of the order of axes, which discs have none of, the mean spin is left."""
    deck = Deck(disc_packing())
    for moment in watch(deck, [INSTANT, STEP, NEMATIC, GRAIN], deforming(RATE), ranks, every=20, steps=100):
        rows, names = moment.rows, outputs("dissipation")
        normal, friction = dissipation_instantaneous(rows)
        found = moment.vector(INSTANT)
        require_close(found[[names.at("P_n"), names.at("P_t")]], [normal, friction], SUMS, "mode instantaneous")
        found = moment.vector(STEP)
        require_close(found[names.at("P_n")], normal_loss_of_step(rows, moment.grains, moment.box), 1e-9, "P_n")
        require_close(found[names.at("P_t")], friction_of_step(rows, deck.dt()), SUMS, "P_t", abs(friction) or 1.0)
        touched = np.bincount(moment.grains.index(rows["id"].ravel()), minlength=len(moment.grains.ids))
        require_equal(moment.peratom(GRAIN)[:, 0], touched, "contacts of grains")
        order, expected = moment.vector(NEMATIC), np.zeros(20)
        expected[outputs("nematic").at("omega_z")] = moment.grains.omega[:, 2].mean()
        require_close(order, expected, SUMS, "nematic of discs")


def fabric(ranks):
    """F, its axes in the plane first, and what follows; the weighted tensors with the coefficients of the plane."""
    names = outputs("fabric")
    for moment in watch(Deck(disc_packing()), [FABRIC], deforming(RATE), ranks, every=20, steps=100):
        n, rows = moment.rows["normal"][:, :2], moment.rows
        tensor = n.T @ n / len(n)
        values, vectors = np.linalg.eigh(tensor)
        found = moment.vector(FABRIC)
        full = np.zeros((3, 3))
        full[:2, :2] = tensor
        require_close(found[:6], six(full), SUMS, "F")
        require_close(found[6:9], [values[1], values[0], 0.0], SUMS, "eigenvalues")
        for k, at in ((0, 9), (1, 12)):
            require_close(abs(found[at : at + 2] @ vectors[:, 1 - k]), 1.0, SUMS, f"eigenvector {k + 1}")
        require_equal(found[15:18], [0.0, 0.0, 1.0], "eigenvector 3")
        deviator = tensor - 0.5 * np.eye(2)
        size = math.sqrt(2.0 * np.sum(deviator**2))
        require_close(found[names.at("deviator")], size, 1e-8, "deviator")
        require_close(size, values[1] - values[0], 1e-12, "sqrt(2 F':F') is the difference of the eigenvalues")
        angle = 0.5 * math.atan2(2.0 * tensor[0, 1], tensor[0, 0] - tensor[1, 1])
        require_close(found[names.at("angle")], angle, 1e-8, "angle", 1.0)
        require_close(found[names.at("ratio")], values[1] / values[0], SUMS, "ratio")
        weight = 1.0 / (1.0 + np.einsum("ca,ab,cb->c", n, 4.0 * deviator, n))
        sums = [
            np.einsum("c,ca,cb->ab", weight * amount, n, n)
            for amount in (
                np.linalg.norm(rows["branch"], axis=1),
                rows["fn"],
                np.linalg.norm(rows["ft"], axis=1),
            )
        ]
        traces = (np.trace(sums[0]), np.trace(sums[1]), np.trace(sums[1]))
        for k, (one, trace) in enumerate(zip(sums, traces)):
            full[:2, :2] = 4.0 / trace * (one - 0.5 * np.trace(one) * np.eye(2))
            require_close(found[22 + 6 * k : 28 + 6 * k], six(full), 1e-9, f"weighted tensor {k + 1}", 1.0)


def correlation(ranks):
    """By all pairs, to half the smaller of the heights in the plane; on the mesh by pairs moved to its cells."""
    deck = Deck(tilted(disc_packing(depth=1.0), 0.3))
    for moment in watch(deck, [DIRECT, MESH], deforming(RATE), ranks, every=20, steps=40, settle=50, contacts=False):
        box, grains = in_plane(moment.box), moment.grains
        dv, dw = of_group(grains, moment.chosen, box)
        values = pairs.component(dv, dw, "vy")
        smallest = 2.0 * grains.radius.min()
        for watched, x, reach in (
            (DIRECT, grains.x, 0.5 * pairs.heights(box)[:2].min()),
            (MESH, pairs.on_mesh(grains.x, box, 4, 4.037 / 6), 4.037),
        ):
            flat = np.concatenate([x[:, :2], 0.0 * x[:, 2:]], axis=1)
            numerator, number = pairs.pair_sums(flat, values, box, 6, reach, smallest, (True, True, False))
            r = (np.arange(6) + 0.5) * reach / 6
            table, vector = pairs.correlation_table(r, numerator, number, np.mean(values**2), len(values))
            found = moment.array(watched)
            scale = np.mean(values**2) * math.sqrt(number.max())
            require_close(found[:, 0], table[:, 0], SUMS, f"{watched.command}: r")
            require_close(found[:, 2], table[:, 2], 1e-9, f"{watched.command}: products", scale)
            require_equal(found[:, 3], table[:, 3], f"{watched.command}: pairs")
            require_close(found[:, 1], table[:, 1], 1e-9, f"{watched.command}: C", 1.0)
            require_close(moment.vector(watched)[2:4], vector[2:4], SUMS, f"{watched.command}: <dv^2>, N")


main(
    {
        "any-depth": any_depth,
        "stress": stress,
        "lattice": lattice,
        "motion": motion,
        "losses": losses,
        "fabric": fabric,
        "correlation": correlation,
    }
)
