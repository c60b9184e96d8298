#!/usr/bin/python3
"""Limits that a contact law must bear: alpha -> 1, friction and restitution at their ends, near jamming.
doc/stability.md.

Stages, each of which leaves rows in a csv beside this script and goes on where it was interrupted:

  alpha   forces and energies of one dense configuration against alpha - 1, from 0.1 to 1e-12 on both sides
  ends    dense flows and packings left alone with mu_p = 0, 0.4, 1e6 and e = 0.0501, 0.1, 1
  jamming flows at constant volume around the solid fraction of a packing under pressure
  said    what the program answers to values out of its range
  chart   doc/images/stability_limits.png
"""
import argparse
import math
import pathlib
import sys

import numpy as np

import limits_chart
from dt_tools import YOUNG, Runner, Table, rayleigh_time, unit

SHAPES = (0.33, 1.0, 3.0)
LAWS = {"gaussian": "ellipsoid gaussianCurvature yes curvatureLimitFactor 100", "radius": "ellipsoid"}
MOVERS = ("nve/spheroid", "nve/superquadric")
DEVIATIONS = (
    "1e-1",
    "1e-2",
    "1e-3",
    "1e-4",
    "1e-5",
    "1e-6",
    "1e-7",
    "1e-8",
    "2e-9",
    "1.1e-9",
    "9e-10",
    "1e-10",
    "1e-12",
)
ENERGIES = ("U_n", "U_t", "K_tr", "K_rot", "D_n", "D_t", "G_k", "G_p", "G_n", "G_open", "G_dt")


class Lattice:
    """Face-centred, two sizes, overlapping by 2 %, displaced, turned and moving at random; always the same but for
    alpha."""

    CELLS = 4

    def __init__(self, sizes=(1.0, 1.05)):
        self.sizes = sizes
        random = np.random.default_rng(11)
        cell = 2 * math.sqrt(2) * 0.98 * np.mean(sizes)
        basis = np.array([[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]])
        corners = np.stack(np.meshgrid(*[np.arange(self.CELLS)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
        places = (corners[:, None] + basis + 0.25).reshape(-1, 3) * cell
        self.edge, count = self.CELLS * cell, len(places)
        self.places = places + 0.01 * random.uniform(-1, 1, (count, 3))
        self.quaternions = unit(random.normal(size=(count, 4)))
        self.velocities, self.spins = 0.3 * random.normal(size=(2, count, 3))

    def write(self, path, alpha):
        """Commands that make the grains; alpha None makes spheres of atom_style sphere."""
        with open(path, "w") as file:
            for k, place in enumerate(self.places):
                a = self.sizes[k % 2]
                shape = (
                    f"diameter {2 * a!r} density 1000"
                    if alpha is None
                    else f"shape {a!r} {a!r} {alpha * a!r} blockiness 2 2 density 1000 quat_direct "
                    + words(self.quaternions[k])
                )
                motion = " ".join(
                    f"{n} {v!r}"
                    for n, v in zip(
                        ("vx", "vy", "vz", "omegax", "omegay", "omegaz"),
                        (*self.velocities[k].tolist(), *self.spins[k].tolist()),
                    )
                )
                file.write(f"create_atoms 1 single {words(place)} units box\nset atom {k + 1} {shape} {motion}\n")


def words(numbers):
    return " ".join(map(repr, numbers.tolist()))


def snapshots(path):
    """Step -> rows."""
    found, lines = {}, iter(open(path).read().splitlines())
    for line in lines:
        if line == "ITEM: TIMESTEP":
            step = int(next(lines))
        elif line.startswith("ITEM: NUMBER OF"):
            count = int(next(lines))
        elif line.startswith("ITEM: ATOMS"):
            found[step] = np.array([next(lines).split() for _ in range(count)], dtype=float)[:, 1:]
    return found


def state(runner, lattice, alpha, law, mover):
    """Forces and torques at the start, forces, torques, places, velocities and spins 40 steps later, energies;
    contacts, overlap, residual."""
    lattice.write(runner.work / "alpha.grains", alpha)
    kind = "sphere" if alpha is None else "superquadric"
    rows, ended = runner.thermo("in.limits_alpha", grains=kind, edge=repr(lattice.edge), surface=law, move=mover)
    if not ended:
        raise SystemExit(f"the run of alpha {alpha!r} did not end")
    shots = snapshots(runner.work / "alpha.dump")
    first, last = shots[min(shots)], shots[max(shots)]
    return {
        "force": first[:, :3],
        "torque": first[:, 3:6],
        "force_40": last[:, :3],
        "torque_40": last[:, 3:6],
        "place_40": last[:, 6:9],
        "spin_40": last[:, 12:15],
        **dict(zip(ENERGIES, rows[-1, 1:12])),
    }, rows[-1]


VECTORS = ("force", "torque", "force_40", "torque_40", "place_40", "spin_40")


def distances(found, reference):
    """From one state to another: vectors in rms, relative (torques at the start to the forces, places to 1 m), energies
    over all that was dissipated."""
    scale = {"torque": rms(reference["force"]), "place_40": 1.0}
    vectors = [rms(found[n] - reference[n]) / scale.get(n, rms(reference[n])) for n in VECTORS]
    return vectors + [abs(found[n] - reference[n]) / (reference["D_n"] + reference["D_t"]) for n in ENERGIES]


def alpha(runner):
    """Distances from the state of alpha = 1 exactly; two rows for atom_style sphere, with the two sizes and with
    one."""
    table = Table(
        "limits_alpha", 4, ("law", "mover", "side", "deviation", *VECTORS, *ENERGIES, "relative_residual", "contacts")
    )
    for law, mover in ((law, mover) for law in LAWS for mover in MOVERS):
        for side, lattice in (("sphere", Lattice()), ("sphere of one size", Lattice((1.0, 1.0)))):
            if not table.has(law, mover, side, "0"):
                found, row = state(runner, lattice, None, "default", "nve/sphere")
                table.add(
                    law,
                    mover,
                    side,
                    "0",
                    *distances(found, state(runner, lattice, 1.0, LAWS[law], mover)[0]),
                    row[13],
                    row[15],
                )
        lattice, reference = Lattice(), None
        for side, deviation in ((s, d) for d in DEVIATIONS for s in ("below", "above")):
            if not table.has(law, mover, side, deviation):
                reference = reference or state(runner, lattice, 1.0, LAWS[law], mover)[0]
                found, row = state(
                    runner, lattice, 1 + float(deviation) * (1 if side == "above" else -1), LAWS[law], mover
                )
                table.add(law, mover, side, deviation, *distances(found, reference), row[13], row[15])


def rms(vectors):
    return math.sqrt((vectors**2).sum(axis=-1).mean())


ACCOUNT = ("W_shear", "W_other", "D_n", "D_t", "G_k", "G_p", "G_n", "G_open", "G_dt")
CASE = (
    "pressure",
    "Z",
    "phi",
    "deepest",
    "energy_start",
    "energy_end",
    "energy_largest",
    *ACCOUNT,
    "residual",
    "solver",
    "warnings",
)


def case(runner, stem, shape, press, **options):
    """One run of in.limits at 0.15 of Rayleigh's time: the columns of CASE."""
    text = runner.output(
        "in.limits",
        state=f"{stem}.restart",
        alpha=f"{shape:g}",
        press=press,
        dt=repr(0.15 * rayleigh_time(shape)),
        **options,
    )
    rows, ended = runner.rows(text)
    if not ended:
        raise SystemExit(text[-1500:])
    energy, last, half = rows[:, 5], rows[-1], rows[len(rows) // 2 :]
    turned_over = abs(last[7:11]).sum() + last[11:18].clip(0).sum() + energy[0]
    warnings = sum(line.startswith("WARNING") for line in text.splitlines())
    return (
        half[:, 1].mean() / (float(press) * min(1, shape) * YOUNG),
        half[:, 3].mean(),
        last[4],
        rows[:, 2].max() / (2 * shape ** (1 / 3)),
        energy[1],
        energy[-1],
        energy.max(),
        last[7],
        last[10],
        *last[11:18],
        abs(last[18]) / turned_over,
        last[20],
        warnings,
    )


FLOWS = (("0", "0.1"), ("0.4", "0.1"), ("1e6", "0.1"), ("0.4", "0.0501"), ("0.4", "1"), ("0", "1"), ("1e6", "1"))
LEFT_ALONE = (("0", "1"), ("0.4", "1"), ("1e6", "1"), ("0.4", "0.99"), ("0", "0.0501"))


def ends(runner):
    """Sheared at I = 0.1 by 0.3 at constant volume and pressure, and stirred and left alone for 10,000 steps."""
    table = Table("limits_ends", 4, ("kind", "alpha", "mu", "e", *CASE))
    for kind, laws, options in (
        ("flow", FLOWS, {"strain": 0.3}),
        ("pressed", FLOWS, {"strain": 0.3, "pressed": 1}),
        ("alone", LEFT_ALONE, {"inertial": 0, "stir": 0.02, "steps": 10000}),
    ):
        for shape, (mu, e) in ((shape, law) for shape in SHAPES for law in laws):
            if not table.has(kind, f"{shape:g}", mu, e):
                table.add(
                    kind,
                    f"{shape:g}",
                    mu,
                    e,
                    *case(runner, runner.packing(shape, "1e-5"), shape, "1e-5", mu=mu, e=e, **options),
                )


DENSITIES = ("-0.05", "-0.02", "-0.01", "-0.005", "0", "0.005", "0.01", "0.02", "0.05")


def jamming(runner):
    """Solid fraction over that of the packing less 1; sheared at I = 0.01 of its pressure by 0.1."""
    table = Table("limits_jamming", 3, ("mu", "alpha", "change", *CASE))
    for mu, shape, change in ((m, s, d) for m in ("0", "0.4") for s in SHAPES for d in DENSITIES):
        if not table.has(mu, f"{shape:g}", change):
            swell = (1 + float(change)) ** (-1 / 3)
            table.add(
                mu,
                f"{shape:g}",
                change,
                *case(
                    runner,
                    runner.packing(shape, "1e-5", mu),
                    shape,
                    "1e-5",
                    mu=mu,
                    e="0.1",
                    swell=repr(swell),
                    inertial=0.01,
                    strain=0.1,
                ),
            )


def said(runner):
    """Prints the errors that values out of range give."""
    stem = runner.packing(1.0, "1e-5")
    for options in ({"e": "0"}, {"e": "0.05"}, {"e": "1.01"}, {"mu": "-0.1"}, {"mu": "1e300"}, {"e": "0.0501"}):
        text = runner.output("in.limits", state=f"{stem}.restart", alpha="1", steps=10, inertial=0, **options)
        print(options, [line for line in text.splitlines() if "ERROR" in line or "WARNING" in line] or "runs")


def chart(_):
    limits_chart.draw()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("stages", nargs="*", default=["alpha", "ends", "jamming", "said", "chart"])
    parser.add_argument(
        "--work",
        type=pathlib.Path,
        default=pathlib.Path("dt_map.work"),
        help="folder of packings (default %(default)s)",
    )
    arguments = parser.parse_args()
    runner = Runner(arguments.binary, arguments.work)
    for stage in arguments.stages:
        getattr(sys.modules[__name__], stage)(runner)


if __name__ == "__main__":
    main()
