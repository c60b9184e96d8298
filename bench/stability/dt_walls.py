#!/usr/bin/python3
"""Where the time step fails for grains that are pressed on walls: doc/stability_time_step.md.

Single grains lie on a plane, in a corner of three planes, or between two plates, held by a load at a given overlap, and
are stirred by a breath. Copies of each, with densities that put the time step from 0.8 to 1.25 of the limit of the
linear theory, run side by side: the limit is between the last whose motion stays bounded and the first whose motion
grows. Rows that are in the csv file are not measured again.
"""
import argparse
import math
import pathlib

import numpy as np

import dt_walls_chart
from dt_network import positive_root
from dt_tools import DENSITY, STIFFNESS, TANGENTIAL, YOUNG, Runner, Table, damping_ratio, rayleigh_time

DT = 0.01
RATIOS = np.round(np.arange(0.80, 1.2501, 0.02), 2)
RESTITUTIONS, OVERLAPS = ("0.1", "0.5", "0.99"), ("1e-3", "1e-2")
POSTURES = ((1.0, "lying"), (0.33, "lying"), (0.33, "standing"), (1.5, "lying"), (1.5, "standing"), (3.0, "lying"))
POSTURES += ((3.0, "standing"),)
SCENES, DAMPINGS = ("plane", "corner", "plates"), ("off", "on")
KINDS = ("primitive", "mesh", "stiff")  # the last: primitive, of another Young's modulus
STIFFER = 200  # so many times; LIGGGHTS takes no more
GAP = 2.0  # between the plates
NORMALS = {
    "plane": ((0, 0, 1),),
    "corner": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "plates": ((0, 0, 1), (0, 0, -1)),
}


class Pressed:
    """A spheroid of semi-axes (1, 1, alpha) size that touches the walls of a scene with the ends of its axes."""

    def __init__(self, scene, alpha, posture, overlap, kind):
        upright = (posture == "standing") == (alpha > 1)  # lying: on the flat side of a disc, on the side of a rod
        self.alpha, self.axis = alpha, np.array((0.0, 0.0, 1.0) if upright else (1.0, 0.0, 0.0))
        self.normals = np.array(NORMALS[scene], dtype=float)
        self.along = np.abs(self.normals @ self.axis)  # 1 where the axis is the normal
        self.size, share = 1.0, float(overlap) * 2 * alpha ** (1 / 3)
        if scene == "plates":
            self.size = 0.5 * GAP / (self._reach()[0] - share)
        self.overlap = share * self.size
        self.kind, self.pair = kind, kind == "pair"

    def _reach(self):
        """From the centre to the surface along each normal, over the size."""
        return np.where(self.along > 0.5, self.alpha, 1.0)

    def place(self):
        """On the walls at 0."""
        outside = 10.0 * (1 - np.abs(self.normals).max(axis=0))
        low = self.normals[self.normals.sum(axis=1) > 0]
        height = self.size * self._reach()[: len(low)] - self.overlap
        return outside + height @ low

    def spread(self):
        """Moments of inertia over the mass, as a matrix."""
        along = np.outer(self.axis, self.axis)
        return self.size**2 / 5 * (2 * along + (1 + self.alpha**2) * (np.eye(3) - along))

    def mass(self, density=DENSITY):
        return 4 / 3 * math.pi * self.alpha * self.size**3 * density

    def stiffness(self):
        """Tangent stiffness of each contact; the radius is that of the Gaussian curvature."""
        radius = self.size * np.where(self.along > 0.5, 1 / self.alpha, self.alpha)
        modulus = 2 * STIFFNESS * STIFFER / (1 + STIFFER) if self.kind == "stiff" else STIFFNESS
        return 2 * modulus * np.sqrt((radius / 2 if self.pair else radius) * self.overlap)

    def matrices(self, e, damping):
        """M^-1/2 K M^-1/2 and the same of C. On a primitive wall the arm is that of the deepest point, on a mesh it
        ends at the plane. Of a pair, mirror images of each other, those of the mode in which they move against each
        other."""
        arms = self.size * self._reach() - {"mesh": 1, "pair": 0.5}.get(self.kind, 0) * self.overlap
        values, vectors = np.linalg.eigh(self.spread())
        light = vectors @ np.diag(values**-0.5) @ vectors.T
        springs, dashpots = np.zeros((6, 6)), np.zeros((6, 6))
        moving = self.mass() / (2 if self.pair else 1)
        for n, arm, k in zip(self.normals, arms, self.stiffness()):
            x, y, z = -arm * n
            lever = np.hstack([np.eye(3), np.array(((0, z, -y), (-z, 0, x), (y, -x, 0))) @ light])
            normal = np.outer(n, n)
            plane = np.eye(3) - normal
            gamma = 2 * damping_ratio(float(e)) * math.sqrt(k * moving)
            tangential = gamma * math.sqrt(TANGENTIAL) if damping == "on" else 0.0
            springs += lever.T @ (k * normal + TANGENTIAL * k * plane) @ lever / moving
            dashpots += lever.T @ (gamma * normal + tangential * plane) @ lever / moving
        return springs, dashpots

    def limit(self, e, damping):
        """dt at which the largest eigenvalue of dt^2 K + 2 dt C is 4, at the density of dt_tools."""
        springs, dashpots = self.matrices(e, damping)
        dt = 2 / math.sqrt(np.trace(springs))
        for _ in range(100):
            q = np.linalg.eigh(dt**2 * springs + 2 * dt * dashpots)[1][:, -1]
            before, dt = dt, positive_root(q @ springs @ q, 2 * q @ dashpots @ q, 4)
            if abs(dt / before - 1) < 1e-10:
                break
        return dt

    def watched(self, e, damping):
        """The share of the limit at which the watch looks at grains: the largest s = (dt^2 k + 2 dt gamma)/m at the
        limit."""
        dt = self.limit(e, damping)
        k = self.stiffness().max()
        moving = self.mass() / (2 if self.pair else 1)
        return (dt**2 * k + 4 * dt * damping_ratio(float(e)) * math.sqrt(k * moving)) / moving

    def unit(self):
        return rayleigh_time(self.alpha) * self.size


def triangles_of(scene):
    """Of walls from 0 to 20 as an STL file."""
    corners = {
        "floor": ((0, 0, 0), (20, 0, 0), (20, 20, 0), (0, 20, 0)),
        "side": ((0, 0, 0), (0, 20, 0), (0, 20, 20), (0, 0, 20)),
        "back": ((0, 0, 0), (0, 0, 20), (20, 0, 20), (20, 0, 0)),
        "lid": ((0, 0, GAP), (0, 20, GAP), (20, 20, GAP), (20, 0, GAP)),
    }
    faces = {"plane": ("floor",), "corner": ("floor", "side", "back"), "plates": ("floor", "lid")}[scene]
    lines = ["solid walls"]
    for face in faces:
        a, b, c, d = corners[face]
        normal = np.sign(np.cross(np.subtract(b, a), np.subtract(c, a)))
        for three in ((a, b, c), (a, c, d)):
            lines += ["facet normal %g %g %g" % tuple(normal), "outer loop"]
            lines += ["vertex %g %g %g" % corner for corner in three] + ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid walls"]) + "\n"


def write_walls(work, scene, kind, damping):
    """The commands that make the walls, and the mesh."""
    law = "model hertz tangential history surface ellipsoid"
    more = f"tangential_damping {damping} gaussianCurvature yes curvatureLimitFactor 100"
    planes = {"plane": ("zplane 0.0",), "corner": ("xplane 0.0", "yplane 0.0", "zplane 0.0")}
    planes["plates"] = ("zplane 0.0", f"zplane {GAP}")
    lines = ["fix mesh all mesh/surface file walls.stl type 4"]
    lines += [f"fix walls all wall/gran {law} mesh n_meshes 1 meshes mesh {more}"]
    if kind != "mesh":
        lines = [
            f"fix wall{k} all wall/gran {law} primitive type 4 {plane} {more}" for k, plane in enumerate(planes[scene])
        ]
    (work / "walls.fixes").write_text("\n".join(lines) + "\n")
    (work / "walls.stl").write_text(triangles_of(scene))


def write_grains(path, cases, damping):
    """Every case with every ratio of the time step to the theory's limit."""
    random = np.random.default_rng(7)
    with open(path, "w") as file:
        atom = 0
        for grain, e in cases:
            reference = grain.limit(e, damping)
            for ratio in RATIOS:
                atom += 1
                density = DENSITY * (DT / (ratio * reference)) ** 2
                shape = " ".join(repr(grain.size * s) for s in (1.0, 1.0, grain.alpha))
                turn = "1 0 0 0" if grain.axis[2] else "0.5 0.5 0.5 0.5"  # the latter takes z to x
                stir = 1e-8 * random.normal(size=6)
                motion = " ".join(
                    f"{name} {value!r}"
                    for name, value in zip(("vx", "vy", "vz", "omegax", "omegay", "omegaz"), stir.tolist())
                )
                file.write(
                    f"create_atoms {RESTITUTIONS.index(e) + 1} single {' '.join(map(repr, grain.place().tolist()))} "
                    f"units box\nset atom {atom} shape {shape} blockiness 2 2 density {density!r} quat_direct {turn} "
                    f"{motion}\n"
                )


def snapshots(path, atoms, columns):
    """Per snapshot: the rows of all grains, nan where one was lost."""
    result, rows = [], None
    for line in open(path):
        if line.startswith("ITEM: TIMESTEP"):
            rows = np.full((atoms, columns), np.nan)
            result.append(rows)
        elif line.startswith("ITEM: ATOMS"):
            inside = True
            continue
        if line.startswith("ITEM:"):
            inside = False
        elif inside:
            words = line.split()
            rows[int(words[0]) - 1] = [float(w) for w in words[1:]]
    return np.array(result)


def growing(motion):
    """Whether the part of the motion that alternates from step to step grows; slow motion, such as that of a rod that
    topples, is none of it."""
    part = motion
    for _ in range(3):
        part = (part[2:] - 2 * part[1:-1] + part[:-2]) / 4
    size = np.linalg.norm(part, axis=2)
    lost = ~np.isfinite(size).all(axis=0)
    size = np.where(np.isfinite(size), size, 0)
    stir, late = np.linalg.norm(motion[0], axis=1), size[-40:].max(axis=0)
    return lost | (size.max(axis=0) > 1e3 * stir) | (late > np.maximum(4 * size[30:70].max(axis=0), 0.1 * stir))


def measure(runner, scene, kind, damping, table):
    cases = [(Pressed(scene, a, p, d, kind), e, a, p, d) for a, p in POSTURES for d in OVERLAPS for e in RESTITUTIONS]
    if all(table.has(scene, kind, damping, f"{a:g}", p, d, e) for _, e, a, p, d in cases):
        return
    write_grains(runner.work / "walls.grains", [case[:2] for case in cases], damping)
    write_walls(runner.work, scene, kind, damping)
    pairs = [RESTITUTIONS[min(i, j)] if max(i, j) == 3 and i != j else "0.5" for i in range(4) for j in range(4)]
    young = YOUNG * (STIFFER if kind == "stiff" else 1)
    output = runner.output("in.dt_walls", damping=damping, dt=DT, e=" ".join(pairs), young=young)
    if "ERROR" in output:
        raise SystemExit(output[-2000:])
    atoms = len(cases) * len(RATIOS)
    grows = growing(snapshots(runner.work / "walls.dump", atoms, 6)).reshape(len(cases), -1)
    held = snapshots(runner.work / "walls.dump.pressed", atoms, 3)[0].reshape(len(cases), len(RATIOS), 3)
    for (grain, e, alpha, posture, overlap), row, forces in zip(cases, grows, held):
        limit = grain.limit(e, damping)
        first = int(row.argmax()) if row.any() else len(RATIOS)
        if first in (0, len(RATIOS)) or not row[first:].all():
            raise SystemExit(f"{scene} {kind} {damping} {alpha} {posture} {overlap} {e}: no limit in {row.astype(int)}")
        force = np.abs(forces[0]).max() if scene != "plates" else math.nan  # of Hertz: 2/3 k d
        pair = Pressed("plane", alpha, posture, overlap, "pair")
        table.add(
            *(scene, kind, damping, f"{alpha:g}", posture, overlap, e),
            *(limit / grain.unit(), RATIOS[first - 1], RATIOS[first], grain.watched(e, damping)),
            pair.limit(e, damping) / pair.unit(),
            force / (2 / 3 * grain.stiffness().max() * grain.overlap),
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("dt_map.work"), help="scratch folder")
    arguments = parser.parse_args()
    runner = Runner(arguments.binary, arguments.work)
    columns = ("scene", "kind", "damping", "alpha", "posture", "overlap", "e")
    results = ("theory", "bounded", "grows", "s_at_limit", "pair", "force_over_hertz")
    table = Table("dt_walls", len(columns), (*columns, *results))
    for scene, kind, damping in ((s, k, d) for s in SCENES for k in KINDS for d in DAMPINGS):
        if kind != "stiff" or scene == "plane":
            measure(runner, scene, kind, damping, table)
    dt_walls_chart.draw()


if __name__ == "__main__":
    main()
