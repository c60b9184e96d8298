# SPDX-License-Identifier: GPL-2.0-or-later
"""Pairs of numbers to compare, as in comparison.py: fluctuations, layering, correlations, displacements."""
import math

import numpy as np

from oracle import correlation, motion, series
from oracle.comparison import TINY, compare, magnitude


def of_fluctuation(vector, array, moment, flow=("box",), plane=(0, 1), layers=10, diameter=None):
    expected, table = motion.fluctuation(moment.grains, moment.chosen, moment.box, flow, plane, layers, diameter)
    # Velocities of the flow, which cancel, carry the rounding errors.
    speed = max(magnitude(moment.grains.v[moment.chosen]) if moment.chosen.any() else 0.0, TINY)
    spin = magnitude(moment.grains.omega[moment.chosen]) if moment.chosen.any() else TINY
    mass = moment.grains.mass[moment.chosen].sum() or TINY
    over_rate = 1.0 / (abs(expected[10]) * moment.box.edges[plane[1], plane[1]]) if expected[10] else 1.0
    yield compare("fluctuation rms dv", vector[:3], expected[:3], speed)
    yield compare("fluctuation rms dw", vector[3:6], expected[3:6], spin)
    yield compare("fluctuation E_tr", vector[6], expected[6], 0.5 * mass * speed**2)
    yield compare("fluctuation E_rot", vector[7], expected[7])
    yield compare("fluctuation E_rot/E_tr", vector[8], expected[8], max(abs(expected[8]), TINY))
    yield compare("fluctuation lever", vector[9], expected[9], max(expected[9], TINY))
    yield compare("fluctuation rate", vector[10], expected[10])
    yield compare("fluctuation measured rate", vector[11], expected[11], speed / moment.box.edges[plane[1], plane[1]])
    yield compare("fluctuation profile", vector[12], expected[12], speed * over_rate)
    yield compare("fluctuation noise", vector[13], expected[13], speed * over_rate)
    yield compare("fluctuation layers", array[:, 0], table[:, 0], moment.box.edges[plane[1], plane[1]])
    yield compare("fluctuation grains per layer", array[:, 1], table[:, 1], 1.0, True)
    yield compare("fluctuation profile of layers", array[:, 2:], table[:, 2:], speed)


def of_layering(vector, array, moment, axis=1, layers=40):
    table, expected = series.layering(moment.grains.x[moment.chosen], moment.box, axis, layers)
    yield compare("layering lags", array[:, 0], table[:, 0])
    yield compare("layering C", array[:, 1], table[:, 1])
    yield compare("layering peak", vector[0], expected[0], magnitude(table[:, 1]))
    # Equal peaks: either lag is right.
    lag = int(np.argmin(np.abs(table[:, 0] - vector[1])))
    yield compare("layering lag of the peak", table[lag, 1], expected[0], magnitude(table[:, 1]))
    yield compare("layering C(0)", vector[2], expected[2])
    yield compare("layering grains", vector[3], expected[3], 1.0, True)


def of_correlation(
    vector,
    array,
    moment,
    name="vy",
    bins=19,
    reach=None,
    flow=("box",),
    plane=(0, 1),
    mesh=0,
    periodic=(True, True, True),
):
    """`mesh`: cells to a bin's width, 0 for the direct sum."""
    grains, chosen, box = moment.grains, moment.chosen, moment.box
    reach = reach or 0.5 * min(correlation.heights(box))
    smallest = 2.0 * (grains.radius[chosen] if grains.shape is None else grains.shape[chosen].min(axis=1)).min()
    values = correlation.component(*motion.of_group(grains, chosen, box, flow, plane), name)
    x = correlation.on_mesh(grains.x[chosen], box, mesh, reach / bins) if mesh else grains.x[chosen]
    numerator, pairs = correlation.pair_sums(x, values, box, bins, reach, smallest, periodic)
    r = (np.arange(bins) + 0.5) * reach / bins
    table, expected = correlation.correlation_table(r, numerator, pairs, np.mean(values**2), len(values))
    yield from of_correlation_table(f"C(r) of {name}" + (" on a mesh" if mesh else ""), vector, array, table, expected)


def of_correlation_table(label, vector, array, table, expected):
    mean_square = expected[2]
    yield compare(f"{label}: r", array[:, 0], table[:, 0])
    # Terms of either sign: their sizes carry the rounding errors.
    yield compare(
        f"{label}: numerator", array[:, 2], table[:, 2], max(mean_square, TINY) * math.sqrt(max(table[:, 3].max(), 1.0))
    )
    yield compare(f"{label}: pairs", array[:, 3], table[:, 3], 1.0, True)
    yield compare(f"{label}: C", array[:, 1], table[:, 1], 1.0)
    yield from of_decay(label, vector[:2], vector[4], expected)
    yield compare(f"{label}: <dv^2>", vector[2], expected[2])
    yield compare(f"{label}: grains", vector[3], expected[3], 1.0, True)


def of_decay(label, found, bins, expected):
    """The bottom of a parabola is known to the square root of the precision; both sides look for the zero of its
    slope."""
    yield compare(f"{label}: bins in the fit", bins, expected[4], 1.0, True)
    yield compare(f"{label}: decay length", found[0], expected[0], max(expected[0], TINY))
    yield compare(f"{label}: its error", found[1], expected[1], max(expected[0], TINY))


def of_memory(vector, array, samples, strains, lags):
    """`samples`: the values of all grains at each sample; both ends of the fit as in of_decay."""
    expected, length, error = correlation.memory_table(samples, strains, lags)
    size = max(float(np.mean(np.square(samples))), TINY) * math.sqrt(max(expected[0, 3], 1.0))
    yield compare("memory: strain", array[:, 0], expected[:, 0], max(abs(strains[-1] - strains[0]), TINY))
    yield compare("memory: C", array[:, 1], expected[:, 1], 1.0)
    yield compare("memory: numerator", array[:, 2], expected[:, 2], size)
    yield compare("memory: pairs", array[:, 3], expected[:, 3], 1.0, True)
    yield compare("memory: decay strain, error", vector[:2], [length, error], max(length, TINY))
    yield compare("memory: samples", vector[2], len(samples), 1.0, True)


def of_displacement(vector, calls, plane=(0, 1)):
    expected = series.displacement_vector(calls, plane)
    # Differences of positions in the box carry the rounding errors: relative to a step's smallest useful square.
    square = max(magnitude(expected[1:4]), TINY)
    yield compare("displacement: strain", vector[0], expected[0], max(abs(expected[0]), TINY))
    yield compare("displacement: <d^2>", vector[1:4], expected[1:4], square)
    yield compare("displacement: D", vector[4:7], expected[4:7], magnitude(expected[4:7]))
    yield compare("displacement: grains", vector[7], expected[7], 1.0, True)
