#!/usr/bin/python3
"""How fast scenes with walls run: a drum that is a primitive cylinder, one that is a mesh, a silo that empties, a bed
between two plates, and a mixer with blades.

Each scene is brought into motion once and kept as a restart file, from which the runs go on: of spheroids with
LIGGGHTS's pair style, surface and integrator against those of grainscope; of spheres (alpha = 1; atom_style sphere)
with pair_style gran against gran/insitu. A Markdown table of instructions per step by callgrind (repeatable; needs
valgrind), with the shares of walls in the steps of grainscope; or with --time of milliseconds per step, as in speed.py.
"""
import argparse
import collections
from dataclasses import dataclass, field
import functools
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import numpy as np

from speed import Bench

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/tools"))
from meshes import drum, rectangle, stl, two  # noqa: E402

R = 0.003  # radius of the sphere of a grain's volume [m]
GRAIN = 4.0 / 3.0 * math.pi * R**3
LOOSE, PACKED = 0.25, 0.6  # solid fractions
SIDES = 48  # of a cylinder
# pair style -> surface model and integrator of spheroids; spheres have those of LIGGGHTS
SPHEROIDS = {"gran": ("superquadric", "nve/superquadric"), "gran/insitu": ("ellipsoid", "nve/spheroid")}
# instructions of these functions, and of what they call
PARTS = {
    "walls": ["FixWallGran::post_force"],
    "their meshes": ["FixNeighlistMesh::pre_force", "FixMoveMesh::initial_integrate"],
}


@dataclass
class Scene:
    """Lengths in metres; in commands, {wall} stands for a wall's style and models."""

    boundary: str
    box: tuple  # lower and upper corner
    fill: str  # region of the grains at first
    walls: list
    meshes: dict = field(default_factory=dict)
    rest: list = field(default_factory=list)  # further walls, until the grains are at rest
    motion: list = field(default_factory=list)  # from then on, with the height ${top} of the grains at rest
    down: str = "0 0 -1"


def ring(radius, height):
    angles = (2.0 * math.pi * k / SIDES for k in range(SIDES + 1))
    return [(radius * math.cos(a), radius * math.sin(a), height) for a in angles]


def turned(*profile):
    """A surface of revolution about z, through points (radius, height)."""
    triangles = []
    for low, high in zip(profile, profile[1:]):
        near, far = ring(*low), ring(*high)
        for k in range(SIDES):
            face = two(near[k], near[k + 1], far[k + 1], far[k])
            triangles += face[1:] if low[0] == 0.0 else face
    return triangles


def grid(corner, one, other, m, n):
    """A rectangle in m by n parts."""
    corner, one, other = np.array(corner), np.array(one) / m, np.array(other) / n
    return [t for i in range(m) for k in range(n) for t in rectangle(corner + i * one + k * other, one, other)]


def drum_radius(count, length):
    """Of a drum that is half full."""
    return math.sqrt(2.0 * count * GRAIN / (PACKED * math.pi * length))


def primitive_drum(count):
    length = 10.5 * R
    radius = drum_radius(count, length)
    wall = f"fix drum all {{wall}} primitive type 1 zcylinder {radius} 0 0"
    return Scene(
        "f f p",
        ((-1.05 * radius, -1.05 * radius, 0.0), (1.05 * radius, 1.05 * radius, length)),
        f"cylinder z 0 0 {0.95 * radius} 0 {length}",
        [],
        rest=[wall],
        motion=["unfix drum", f"{wall} shear x 2.0"],
        down="0 -1 0",
    )


def mesh_drum(count):
    length = 17.0 * R
    radius = drum_radius(count, length)
    return Scene(
        "f f f",
        ((-1.05 * radius, -0.05 * length, -1.05 * radius), (1.05 * radius, 1.05 * length, 1.05 * radius)),
        f"cylinder y 0 0 {0.95 * radius} {0.03 * length} {0.97 * length}",
        ["fix drum all mesh/surface file drum.stl type 1", "fix wall all {wall} mesh n_meshes 1 meshes drum"],
        {"drum": drum(radius, 0.0, length, SIDES)},
        motion=[f"fix turn all move/mesh mesh drum rotate origin 0 0 0 axis 0 1 0 period {math.pi}"],
    )


def silo(count):
    radius, mouth = 0.04, 0.02
    cone = radius - mouth
    top = cone + count * GRAIN / (LOOSE * math.pi * radius**2)
    side = [(radius, cone + (top - cone) * k / 8) for k in range(9)]
    return Scene(
        "f f f",
        ((-1.05 * radius, -1.05 * radius, -0.05), (1.05 * radius, 1.05 * radius, top)),
        f"cylinder z 0 0 {0.95 * radius} {cone} {top}",
        ["fix silo all mesh/surface file silo.stl type 1", "fix wall all {wall} mesh n_meshes 1 meshes silo"],
        {"silo": turned((mouth, 0.0), *side)},
        rest=["fix plug all {wall} primitive type 1 zplane 0"],
        motion=["unfix plug"],
    )


def plates(count):
    x, y = 34.0 * R, 20.0 * R
    top = count * GRAIN / (LOOSE * x * y)
    return Scene(
        "p p f",
        ((0.0, 0.0, -R), (x, y, top + R)),
        f"block 0 {x} 0 {y} {0.3 * R} {top}",
        ["fix floor all {wall} primitive type 1 zplane 0"],
        motion=["fix lid all {wall} primitive type 1 zplane ${top} shear x 0.4"],
    )


def mixer(count):
    radius = 20.0 * R
    depth = count * GRAIN / (PACKED * math.pi * radius**2)
    top = depth * PACKED / LOOSE
    blades = []
    for k in range(4):
        along = np.array([math.cos(0.5 * k * math.pi), math.sin(0.5 * k * math.pi), 0.0])
        lean = np.array([-0.5 * along[1], 0.5 * along[0], 0.8])
        blades += grid(0.15 * radius * along + [0.0, 0.0, 1.5 * R], 0.75 * radius * along, depth * lean, 8, 5)
    profile = [*((radius * k / 8, 0.0) for k in range(9)), *((radius, 1.1 * top * k / 12) for k in range(1, 13))]
    return Scene(
        "f f f",
        ((-1.05 * radius, -1.05 * radius, -R), (1.05 * radius, 1.05 * radius, 1.1 * top)),
        f"cylinder z 0 0 {0.95 * radius} {depth} {top}",
        [
            "fix bin all mesh/surface file bin.stl type 1",
            "fix blades all mesh/surface file blades.stl type 1",
            "fix wall all {wall} mesh n_meshes 2 meshes bin blades",
        ],
        {"bin": turned(*profile), "blades": blades},
        motion=["fix turn all move/mesh mesh blades rotate origin 0 0 0 axis 0 0 1 period 1.0"],
    )


SCENES = {"drum": primitive_drum, "drum, mesh": mesh_drum, "silo": silo, "plates": plates, "mixer": mixer}


class Runs:
    """Of a scene: the one that makes its state, and those that go on from it."""

    def __init__(self, bench, name, alpha, count):
        self.bench, self.name, self.alpha, self.count = bench, name, alpha, count
        self.scene = SCENES[name](count)
        self.spheres = alpha == 1.0
        self.side = R * alpha ** (-1.0 / 3.0)  # semi-axes side, side, alpha side
        self.time_step = 5e-5 * self.side * min(alpha, 1.0) / R
        for mesh, triangles in self.scene.meshes.items():
            (bench.folder / f"{mesh}.stl").write_text(stl(mesh, triangles))
        self.state = bench.states / f"{name.replace(', ', '_')}_{alpha:g}_{count}.restart"
        if not self.state.exists():
            bench.execute(self.command(self.first()))

    def command(self, lines):
        deck = self.bench.folder / "in.scene"
        deck.write_text("\n".join([*lines, ""]))
        return [str(self.bench.binary), "-in", str(deck), "-log", "none"]

    def styles(self, pair):
        """Contact models and integrator."""
        surface, move = ("default", "nve/sphere") if self.spheres else SPHEROIDS[pair]
        return f"model hertz tangential history surface {surface}", move

    def walls(self, pair, lines):
        return [line.replace("{wall}", f"wall/gran {self.styles(pair)[0]}") for line in lines]

    def physics(self, pair):
        model, move = self.styles(pair)
        return [
            f"neighbor {0.2 * self.side * max(self.alpha, 1.0)} bin",
            "neigh_modify delay 0 contact_distance_factor 1.05",
            "fix young all property/global youngsModulus peratomtype 5e6",
            "fix poisson all property/global poissonsRatio peratomtype 0.3",
            "fix restitution all property/global coefficientRestitution peratomtypepair 1 0.3",
            "fix friction all property/global coefficientFriction peratomtypepair 1 0.5",
            f"pair_style {pair} {model}",
            "pair_coeff * *",
            f"timestep {self.time_step}",
            *self.walls(pair, self.scene.walls),
            f"fix gravity all gravity 9.81 vector {self.scene.down}",
            f"fix move all {move}",
            "thermo_modify lost ignore",
            "thermo 1000000",
        ]

    def first(self):
        """Grains at random places push themselves apart, fall, and come to rest, braked; then the scene moves."""
        pair = "gran/insitu"
        low, high = self.scene.box
        if self.spheres:
            style, kind, turned_at_random = (
                "sphere",
                f"sphere 10007 atom_type 1 density constant 2500 radius constant {R}",
                "",
            )
        else:
            style, turned_at_random = "superquadric", "orientation random "
            kind = (
                f"superquadric 10007 atom_type 1 density constant 2500 shape constant {self.side} {self.side} "
                f"{self.alpha * self.side} blockiness constant 2 2"
            )
        steps = round(0.4 / self.time_step)
        return [
            f"atom_style {style}",
            "atom_modify map array",
            f"boundary {self.scene.boundary}",
            "newton off",
            "communicate single vel yes",
            "units si",
            "region box block " + " ".join(f"{a} {b}" for a, b in zip(low, high)) + " units box",
            "create_box 1 box",
            *self.physics(pair),
            *self.walls(pair, self.scene.rest),
            f"fix grain all particletemplate/{kind}",
            "fix sizes all particledistribution/discrete/numberbased 10141 1 grain 1.0",
            f"region fill {self.scene.fill} units box",
            "fix fill all insert/pack seed 15485863 distributiontemplate sizes insert_every once overlapcheck no "
            f"all_in yes {turned_at_random}region fill particles_in_region {self.count}",
            "fix slow all viscous 0.2",
            "run 1500",
            "unfix fill",
            "fix slow all viscous 2e-3",
            f"run {steps}",
            "unfix slow",
            "variable high equal bound(all,zmax)",
            f'print "variable top equal ${{high}}" file {self.state}.top',
            f"include {self.state}.top",
            *self.walls(pair, self.scene.motion),
            f"run {steps}",
            f"write_restart {self.state}",
        ]

    def deck(self, pair, settle, steps):
        motion = [line for line in self.scene.motion if not line.startswith("unfix")]
        return self.command(
            [
                "atom_modify map array",
                "newton off",
                "communicate single vel yes",
                f"read_restart {self.state}",
                f"include {self.state}.top",
                *self.physics(pair),
                *self.walls(pair, motion),
                f"run {settle}",
                f"run {steps}",
            ]
        )

    def milliseconds(self, pair, steps):
        return 1e3 * self.bench.run(self.deck(pair, steps // 5, steps), 1, steps).step

    def instructions(self, pair, steps):
        """Of a step, and of its parts."""
        whole = self.bench.count(functools.partial(self.deck, pair, steps), steps)
        more, less = (inclusive(self.bench.profile(n)) for n in (steps, 0))
        return whole, [sum(more[name] - less[name] for name in names) / steps for names in PARTS.values()]


def inclusive(profile):
    """Instructions of LIGGGHTS's functions and what they call, by name."""
    command = ["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(profile)]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    found = collections.Counter()
    for number, name in re.findall(r"^ *([\d,]+) .*LAMMPS_NS::(\w+::\w+)\(", text, re.M):
        found[name] = max(found[name], int(number.replace(",", "")))
    return found


def row(runs, *words):
    print(f"| {runs.name} | {runs.alpha:g} | " + " | ".join(words) + " |", flush=True)


def count_instructions(runs, steps):
    (before, _), (now, parts) = (runs.instructions(pair, steps) for pair in SPHEROIDS)
    shares = (f"{100.0 * part / now:.1f} %" for part in parts)
    row(runs, f"{1e-6 * before:.3g}e6", f"{1e-6 * now:.3g}e6", f"{before / now:.2f}", *shares)


def take_time(runs, steps, repeats):
    rounds = [[runs.milliseconds(pair, steps) for pair in SPHEROIDS] for _ in range(repeats)]
    before, now = (statistics.median(times) for times in zip(*rounds))
    row(runs, f"{before:.3f}", f"{now:.3f}", f"{statistics.median(a / b for a, b in rounds):.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument(
        "--scenes",
        nargs="+",
        choices=SCENES,
        default=list(SCENES),
        metavar="scene",
        help="of %(choices)s (default: all)",
    )
    parser.add_argument(
        "--alpha", type=float, nargs="+", default=[0.5, 1.0, 2.0], help="aspect ratios (default %(default)s)"
    )
    parser.add_argument("--grains", type=int, default=2000, help="(default %(default)s)")
    parser.add_argument("--time", action="store_true", help="milliseconds instead of instructions per step")
    parser.add_argument("--repeats", type=int, default=5, help="rounds with --time (default %(default)s)")
    parser.add_argument("--steps", type=int, help="of each run (default 40, with --time 500)")
    parser.add_argument("--states", type=pathlib.Path, help="folder that keeps the states (each takes a minute)")
    arguments = parser.parse_args()
    columns = ["scene", "alpha", "gran", "gran/insitu", "ratio", *([] if arguments.time else PARTS)]
    print("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        states = (arguments.states or folder).resolve()
        states.mkdir(parents=True, exist_ok=True)
        bench = Bench(arguments.binary.resolve(), None, folder, states)
        for scene in arguments.scenes:
            for alpha in arguments.alpha:
                runs = Runs(bench, scene, alpha, arguments.grains)
                if arguments.time:
                    take_time(runs, arguments.steps or 500, arguments.repeats)
                else:
                    count_instructions(runs, arguments.steps or 40)


if __name__ == "__main__":
    main()
