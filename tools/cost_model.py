"""What a run of examples/simple_shear costs: steps, core-seconds, memory and bytes, by the measurements of doc/cost.md."""
import math

YOUNG, POISSON, DENSITY, SMALLEST = 5.0e6, 0.3, 1000.0, 0.8     # of the deck
GRAIN_STEP = 1.5e-6
MEMORY, MEMORY_OF_GRAIN = 60e6, 20e3


def steps_per_strain(alpha, inertial):
    """Time steps for a shear strain of 1, as the deck sets its time step."""
    thin = min(alpha, 1.0)
    target = thin * YOUNG / 1e5
    diameter = 2 * alpha ** (1 / 3)
    rate = inertial * math.sqrt(target / DENSITY) / diameter
    rayleigh = math.pi * SMALLEST * thin / (0.8766 + 0.163 * POISSON) * math.sqrt(DENSITY / (YOUNG / (2 * (1 + POISSON))))
    stiffness = YOUNG / (2 * (1 - POISSON**2))
    hertz = 2.94 * (5 * math.sqrt(2) * math.pi * DENSITY / (8 * stiffness)) ** 0.4 * SMALLEST * thin / (rate * diameter) ** 0.2
    return 1 / (rate * 0.15 * min(hertz, rayleigh))


def seconds_of(alpha, inertial, grains, strain, ranks=1, speed=1.0):
    """Wall time of a run [s]."""
    return GRAIN_STEP * grains * steps_per_strain(alpha, inertial) * strain / ranks / speed


def memory_of(grains, ranks=1):
    """Memory of a run [bytes], all ranks."""
    return MEMORY * ranks + MEMORY_OF_GRAIN * grains
