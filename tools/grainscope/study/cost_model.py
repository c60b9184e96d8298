"""What a run of examples/simple_shear costs: steps, core time, memory and bytes. The numbers are measured
(doc/cost.md)."""

from dataclasses import dataclass
import math

YOUNG, POISSON, DENSITY, SMALLEST = 5.0e6, 0.3, 1000.0, 0.8  # of the deck
START_STEPS = 3000  # that push the random start apart
# Core time of a grain for a step [s] by aspect ratio, N = 2000, dense flow of mu = 0.4; and for a strain of 1 [s]: what
# is done at strains and not at steps, neighbour lists and measuring everything
GRAIN_STEP = {
    0.33: 0.44e-6,
    0.5: 0.40e-6,
    0.67: 0.36e-6,
    0.83: 0.29e-6,
    1: 0.19e-6,
    1.2: 0.30e-6,
    1.5: 0.36e-6,
    2: 0.49e-6,
    3: 0.55e-6,
}
GRAIN_STRAIN = 1.5e-3
# The same over that of N = 2000, by grains of a rank: grains and springs of larger systems are fetched from memory
GROWTH = {2000: 1.0, 16000: 1.3, 128000: 2.2, 1024000: 2.6}
# Of several ranks: time for grains of neighbouring ranks over that for a rank's own, times the cube root of the number
# of these; and wait [s]
SURFACE, LATENCY = 0.9, 0.3e-3
MEMORY_OF_RANK, MEMORY_OF_GRAIN = 25e6, 7e3
# Files of a run: three restart files and the final grains; series.txt and displacement.txt; tables of a part
BYTES_OF_GRAIN, BYTES_OF_STRAIN, BYTES_OF_PART = 4.3e3, 8e3, 11e3

PAPER = {
    "alphas": (0.33, 0.4, 0.5, 0.56, 0.67, 0.83, 1, 1.2, 1.5, 1.8, 2, 2.5, 3),
    "frictions": 7,
    "inertias": (0.1, 0.046, 0.022, 0.01, 0.0046, 0.0022, 0.001),
    "grains": 2000,
    "strain": 16,
    "steady": 6,
    "part": 0.125,
}
# LIGGGHTS itself on the same flow and machine, core time of a grain for a step [s]; dumps of 1600 snapshots of each
# run, and what reads them
CLASSICAL_GRAIN_STEP = {0.33: 5.9e-6, 0.67: 4.4e-6, 1: 1.75e-6, 1.5: 5.7e-6, 3: 10.2e-6}
SNAPSHOTS, SNAPSHOT_BYTES_OF_GRAIN, SNAPSHOT_SECONDS_OF_GRAIN = 1600, 600.0, 4.5e-4


@dataclass
class Cost:
    runs: int
    core_hours: float
    gigabytes: float


def between(table, x):
    """Value at x of a table, by straight lines in the logarithm of x; beyond its ends that of the end."""
    places = sorted(table)
    x = min(max(x, places[0]), places[-1])
    high = next(place for place in places if place >= x)
    low = max((place for place in places if place <= x))
    if low == high:
        return table[low]
    share = math.log(x / low) / math.log(high / low)
    return table[low] + share * (table[high] - table[low])


def steps_per_strain(alpha, inertial):
    """Time steps for a shear strain of 1, as the deck sets its time step."""
    thin = min(alpha, 1.0)
    target = thin * YOUNG / 1e5
    diameter = 2 * alpha ** (1 / 3)
    rate = inertial * math.sqrt(target / DENSITY) / diameter
    rayleigh = (
        math.pi * SMALLEST * thin / (0.8766 + 0.163 * POISSON) * math.sqrt(DENSITY / (YOUNG / (2 * (1 + POISSON))))
    )
    stiffness = YOUNG / (2 * (1 - POISSON**2))
    hertz = (
        2.94
        * (5 * math.sqrt(2) * math.pi * DENSITY / (8 * stiffness)) ** 0.4
        * SMALLEST
        * thin
        / (rate * diameter) ** 0.2
    )
    return 1 / (rate * 0.15 * min(hertz, rayleigh))


def step_seconds(alpha, inertial, grains, ranks=1):
    """Wall time of a step [s]: that of a rank's grains, and with several ranks of their neighbours on others, by the
    surface of its share of the box."""
    share = grains / ranks
    grain = between(GRAIN_STEP, alpha) + GRAIN_STRAIN / steps_per_strain(alpha, inertial)
    own = grain * between(GROWTH, share) * share
    return own * (1 + SURFACE / share ** (1 / 3)) + LATENCY if ranks > 1 else own


def seconds_of(alpha, inertial, grains, strain, ranks=1, speed=1.0):
    """Wall time of a run [s]."""
    return step_seconds(alpha, inertial, grains, ranks) * steps_per_strain(alpha, inertial) * strain / speed


def memory_of(grains, ranks=1):
    """Memory of a run [bytes], all ranks."""
    return MEMORY_OF_RANK * ranks + MEMORY_OF_GRAIN * grains


def bytes_of(grains, strain, steady, part):
    """Size of all files of a run [bytes]."""
    return BYTES_OF_GRAIN * grains + BYTES_OF_STRAIN * strain + BYTES_OF_PART * (strain - steady) / part


def cost_of_grid(alphas, frictions, inertias, grains, strain, steady, part):
    """Cost of all combinations with `frictions` friction coefficients, on one rank each."""
    runs = len(alphas) * frictions * len(inertias)
    seconds = frictions * sum(seconds_of(alpha, inertial, grains, strain) for alpha in alphas for inertial in inertias)
    return Cost(runs, seconds / 3600, runs * bytes_of(grains, strain, steady, part) / 1e9)


def classical_cost_of_grid(alphas, frictions, inertias, grains, strain, **_):
    """The same runs by LIGGGHTS itself, with dumps of contacts and grains that are read afterwards."""
    runs = len(alphas) * frictions * len(inertias)
    steps = frictions * sum(
        between(CLASSICAL_GRAIN_STEP, alpha) * steps_per_strain(alpha, inertial)
        for alpha in alphas
        for inertial in inertias
    )
    reading = runs * SNAPSHOTS * SNAPSHOT_SECONDS_OF_GRAIN * grains
    return Cost(
        runs, (steps * strain * grains + reading) / 3600, runs * SNAPSHOTS * SNAPSHOT_BYTES_OF_GRAIN * grains / 1e9
    )
