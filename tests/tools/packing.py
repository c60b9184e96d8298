# SPDX-License-Identifier: GPL-2.0-or-later
"""Initial states: a box and its grains, and the deck lines that create them."""
from dataclasses import dataclass, replace
import math

import numpy as np

DENSITY = 1000.0
SKIN = 0.2


def number(value):
    """A double as text that reads back as the same double."""
    return repr(float(value))


def numbers(values):
    return " ".join(number(v) for v in values)


@dataclass
class Grain:
    position: tuple
    semi_axes: tuple = (1.0, 1.0, 1.0)
    quaternion: tuple = (1.0, 0.0, 0.0, 0.0)
    velocity: tuple = (0.0, 0.0, 0.0)
    omega: tuple = (0.0, 0.0, 0.0)
    type: int = 1
    blockiness: tuple = (2.0, 2.0)

    def volume(self):
        return 4.0 / 3.0 * math.pi * math.prod(self.semi_axes)

    def mass(self):
        return DENSITY * self.volume()


@dataclass
class Packing:
    """atom_style is 'superquadric', or 'sphere', which needs three equal semi-axes. dimension 2: discs of these radii,
    all at one z."""

    edges: tuple
    grains: list
    tilt: float = 0.0
    atom_style: str = "superquadric"
    types: int = 1
    origin: tuple = (0.0, 0.0, 0.0)
    triclinic: bool = True
    dimension: int = 3

    def lines(self):
        (x, y, z), (lx, ly, lz) = self.origin, self.edges
        bounds = numbers([x, x + lx, y, y + ly, z, z + lz])
        shape = f"prism {bounds} {number(self.tilt)} 0 0" if self.triclinic else f"block {bounds}"
        yield f"region box {shape} units box"
        yield f"create_box {self.types} box"
        for k, grain in enumerate(self.grains, 1):
            yield f"create_atoms {grain.type} single {numbers(grain.position)} units box"
            yield f"set atom {k} {self._shape(grain)} {self._motion(grain)}"

    def _shape(self, grain):
        if self.atom_style == "sphere":
            return f"diameter {number(2.0 * grain.semi_axes[0])} density {number(DENSITY)}"
        return (
            f"shape {numbers(grain.semi_axes)} blockiness {numbers(grain.blockiness)} density {number(DENSITY)} "
            f"quat_direct {numbers(grain.quaternion)}"
        )

    @staticmethod
    def _motion(grain):
        names = ("vx", "vy", "vz", "omegax", "omegay", "omegaz")
        return " ".join(f"{n} {number(v)}" for n, v in zip(names, (*grain.velocity, *grain.omega)))


def _random_quaternion(random, wobble):
    """A rotation of a random axis by up to `wobble` radians."""
    axis = random.normal(size=3)
    axis /= np.linalg.norm(axis)
    half = 0.5 * wobble * random.uniform()
    return (math.cos(half), *(math.sin(half) * axis))


def _face_centred(counts):
    """Points of a face-centred lattice of so many cells of edge 1, a quarter of a cell off its corner."""
    basis = np.array([[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]])
    corners = np.stack(np.meshgrid(*[np.arange(n) for n in counts], indexing="ij"), axis=-1).reshape(-1, 3)
    return (corners[:, None, :] + basis[None, :, :]).reshape(-1, 3) + 0.25


def dense_packing(
    alpha=1.0,
    sizes=(1.0,),
    types=1,
    overlap=0.02,
    speed=0.4,
    wobble=0.15,
    seed=7,
    atom_style="superquadric",
    minimum=100,
    blockiness=(2.0, 2.0),
):
    """Spheroids a, a, alpha a on a stretched face-centred lattice whose neighbours overlap by `overlap` diameters,
    slightly turned, with random velocities: dense and full of contacts from the first step. The box holds the host's
    smallest periodic height, 2 x (largest diameter + skin), and at least `minimum` grains."""
    random = np.random.default_rng(seed)
    cell = 2.0 * math.sqrt(2.0) * (1.0 - overlap) * np.array([1.0, 1.0, alpha]) * float(np.mean(sizes))
    needed = (
        2.0 * (2.0 * max(sizes) * max(1.0, alpha) * 1.05 + SKIN) * np.array([1.13, 1.0, 1.0])
    )  # a sheared box loses height
    counts = np.ceil(needed / cell + 1e-9).astype(int)
    counts[0] += counts[0] % 2  # so that the lattice also fits a box tilted by half its length
    while 4 * counts.prod() < minimum:
        k = np.argmin(counts * cell)
        counts[k] += 2 if k == 0 else 1
    points = _face_centred(counts) * cell
    grains = []
    for k, point in enumerate(points):
        a = sizes[k % len(sizes)]
        grains.append(
            Grain(
                tuple(point),
                (a, a, alpha * a),
                _random_quaternion(random, wobble if alpha != 1.0 else 0.0),
                tuple(speed * random.normal(size=3)),
                tuple(speed * random.normal(size=3)),
                1 + k % types,
                blockiness,
            )
        )
    return Packing(tuple(counts * cell), grains, atom_style=atom_style, types=types)


def filled_packing(ratio=10.0, overlap=0.02, speed=0.3, seed=7):
    """Balls of radius 1 as in dense_packing, and in the holes between them balls of 1/ratio on a lattice of their own:
    a mixture in which most small grains touch others."""
    large = dense_packing(overlap=overlap, speed=speed, seed=seed, atom_style="sphere", minimum=32)
    edges, centres = np.array(large.edges), np.array([grain.position for grain in large.grains])
    radius = 1.0 / ratio
    counts = np.floor(edges / (2.0 * math.sqrt(2.0) * (1.0 - overlap) * radius)).astype(int)
    points = _face_centred(counts) * edges / counts
    apart = points[:, None, :] - centres
    apart -= edges * np.round(apart / edges)
    points = points[np.linalg.norm(apart, axis=2).min(axis=1) >= 1.0 + (1.0 - 2.0 * overlap) * radius]
    random = np.random.default_rng(seed)
    for point in points:
        motion = (tuple(speed * random.normal(size=3)) for _ in range(2))
        large.grains.append(Grain(tuple(point), (radius,) * 3, (1.0, 0.0, 0.0, 0.0), *motion))
    return large


def disc_packing(sizes=(0.8, 1.0, 1.2), overlap=0.02, speed=0.4, seed=7, rows=10, depth=1.0):
    """Discs of two dimensions on a triangular lattice, `rows` in each direction, with random velocities: full of
    contacts from the first step. `depth`: of the box, across their plane."""
    random = np.random.default_rng(seed)
    spacing = 2.0 * (1.0 - overlap) * float(np.mean(sizes))
    height = 0.5 * math.sqrt(3.0) * spacing
    grains = []
    for row in range(rows):
        for k in range(rows):
            a = sizes[int(random.integers(len(sizes)))]
            grains.append(
                Grain(
                    ((k + 0.25 + 0.5 * (row % 2)) * spacing, (row + 0.5) * height, 0.0),
                    (a, a, a),
                    velocity=(*(speed * random.normal(size=2)), 0.0),
                    omega=(0.0, 0.0, speed * random.normal()),
                )
            )
    edges = (rows * spacing, rows * height, depth)
    return Packing(edges, grains, atom_style="sphere", origin=(0.0, 0.0, -0.5 * depth), dimension=2)


def in_the_open(packing, factor=3.0):
    """The same grains in the middle of a box `factor` times as large: no contact crosses a face, so that
    sum over contacts of (x_i - x_j) F = sum over grains of x f exactly."""
    edges = tuple(factor * e for e in packing.edges)
    origin = tuple(-0.5 * (factor - 1.0) * e for e in packing.edges)
    return replace(packing, edges=edges, origin=origin)


def tilted(packing, fraction):
    """The same lattice in a box whose tilt is `fraction` of its length; it fits at 1/2."""
    tilt = fraction * packing.edges[0]
    grains = []
    for grain in packing.grains:
        x, y, z = grain.position
        outside = math.floor((x - tilt * y / packing.edges[1]) / packing.edges[0])
        grains.append(replace(grain, position=(x - outside * packing.edges[0], y, z)))
    return replace(packing, grains=grains, tilt=tilt)
