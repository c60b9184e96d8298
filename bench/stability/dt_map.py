#!/usr/bin/python3
"""Where the time step stops being safe, against aspect ratio alpha and restitution e: doc/stability.md.

Stages, each of which leaves rows in a csv beside this script and goes on where it was interrupted:

  theory  of packings at rest: the time step at which the linear theory says that the contact network becomes unstable,
    and its bounds
  growth  of the same packings, stirred by a breath: the time step at which the motion grows in a run
  pairs   of colliding pairs, random in all: the energy after over the energy before
  flow    of the packings sheared at I = 0.1: the ledger of a flow
  chart   of all of them: doc/images/stability_dt.png
"""
import argparse
import csv
import math
import pathlib
import sys

import numpy as np

import dt_chart
from dt_network import Network
from dt_pairs import Pairs
from dt_tools import HERE, Runner, Table, damping_ratio, hertz_time, rayleigh_time

ALPHAS = (0.2, 0.33, 0.5, 0.67, 1.0, 1.5, 2.0, 3.0, 5.0)
PRESSURES = (
    "1e-5",
    "1e-3",
)  # over the smallest semi-axis ratio and Young's modulus: the paper's, and one for soft grains

LAWS = [(e, damping) for damping in ("off", "on") for e in ("0.1", "0.3", "0.5", "0.7", "0.9", "0.99")]


def theory(runner):
    """Time steps in units of Rayleigh's time."""
    table = Table(
        "dt_theory",
        4,
        (
            "press",
            "alpha",
            "e",
            "damping",
            "network",
            "bound",
            "trace",
            "pair_stiff",
            "pair_damped",
            "Z",
            "overlap",
            "largest",
        ),
    )
    for press in PRESSURES:
        for alpha in ALPHAS:
            missing = [law for law in LAWS if not table.has(press, f"{alpha:g}", *law)]
            if not missing:
                continue
            network = Network(runner.packing(alpha, press), alpha)
            unit, reduced = rayleigh_time(alpha), network.mass / 2
            diameter = 2 * alpha ** (1 / 3)
            for e, tangential in missing:
                laws = network.laws(float(e), tangential == "on")
                dt = network.limit(*laws)
                w = dt * math.sqrt(network.stiffness.max() / reduced)
                table.add(
                    press,
                    f"{alpha:g}",
                    e,
                    tangential,
                    dt / unit,
                    *(b / unit for b in network.bounds(*laws)),
                    w * w,
                    2 * damping_ratio(float(e)) * w,
                    2 * len(network.i) / network.count,
                    network.overlap.mean() / diameter,
                    network.overlap.max() / diameter,
                )


def grows(runner, stem, alpha, e, damping, dt):
    """Whether the motion of a stirred packing reached a thousandth of the energy of its springs."""
    rows, ended = runner.thermo(
        "in.dt_growth", state=f"{stem}.restart", alpha=f"{alpha:g}", e=e, damping=damping, dt=repr(dt), steps=1500
    )
    return not ended or not np.isfinite(rows).all() or rows[:, 1].max() > 1e-3 * rows[1:, 2].max()


def growth(runner):
    """Halves the interval from 0.7 to 1.4 of the theory's limit five times: 2 %."""
    table = Table("dt_growth", 4, ("press", "alpha", "e", "damping", "stable", "unstable", "over_theory"))
    known = {
        tuple(row[c] for c in ("press", "alpha", "e", "damping")): float(row["network"])
        for row in csv.DictReader(open(HERE / "dt_theory.csv"))
    }
    for press, alpha, (e, damping) in ((p, a, law) for p in PRESSURES for a in ALPHAS for law in LAWS):
        key = (press, f"{alpha:g}", e, damping)
        if table.has(*key) or e not in ("0.1", "0.5", "0.99") or (press == "1e-3" and e == "0.5"):
            continue
        stem, unit, limit = runner.packing(alpha, press), rayleigh_time(alpha), known[key]
        low, high = 0.7 * limit, 1.4 * limit
        for _ in range(5):
            middle = math.sqrt(low * high)
            low, high = (low, middle) if grows(runner, stem, alpha, e, damping, middle * unit) else (middle, high)
        table.add(*key, low, high, math.sqrt(low * high) / limit)


SPEEDS = ("0.02", "0.5")
FRACTIONS = ("0.02", "0.05", "0.1", "0.15", "0.2", "0.3", "0.4", "0.5", "0.7", "1", "1.4")  # of Hertz' time
RESTITUTIONS = ("0.1", "0.3", "0.5", "0.7", "0.9", "0.99")
PAIRS = 150  # of each restitution


def pairs(runner):
    """Every run holds all restitutions. Energies after over before, minus 1, over the pairs of one restitution; inf:
    grains flew so far in a step that they were lost."""
    table = Table(
        "dt_pairs", 4, ("speed", "alpha", "dt_over_hertz", "e", "mean", "error", "worst", "touching", "residual")
    )
    matrix = " ".join(RESTITUTIONS[max(i, j)] for i in range(6) for j in range(6))
    for speed, alpha in ((s, a) for s in SPEEDS for a in ALPHAS):
        collisions = Pairs(alpha, float(speed), len(RESTITUTIONS), PAIRS)
        before = collisions.energy(collisions.velocities, collisions.spins, collisions.axes)
        for fraction in FRACTIONS:
            if table.has(speed, f"{alpha:g}", fraction, RESTITUTIONS[-1]):
                continue
            dt = float(fraction) * hertz_time(alpha, float(speed))
            collisions.write(runner.work / "pairs.grains", dt)
            rows, ended = runner.thermo(
                "in.dt_pairs",
                shape=f"1 1 {alpha:g}",
                edge=collisions.edge(),
                e=matrix,
                dt=repr(dt),
                skin=0.2 * max(1, alpha),
                steps=math.ceil(10 / float(fraction)) + 4,
            )
            after = collisions.energy_after(runner.work / "pairs.dump") if ended else np.full(len(before), np.inf)
            ratio = (after / before - 1).reshape(len(RESTITUTIONS), PAIRS)
            for e, change in zip(RESTITUTIONS, ratio):
                error = change.std() / math.sqrt(PAIRS) if ended else math.inf
                table.add(speed, f"{alpha:g}", fraction, e, change.mean(), error, change.max(), *rows[-1, 1:3])


FLOWS = ("0.05", "0.15", "0.3", "0.5", "0.7", "1", "1.4", "2")  # time steps over Rayleigh's time
FLOW_LAWS = (("0.1", "off"), ("0.99", "off"), ("0.1", "on"))
LEDGER = (
    "W_shear",
    "W_box",
    "W_frame",
    "W_other",
    "D_n",
    "D_t",
    "D_damp",
    "G_k",
    "G_p",
    "G_n",
    "G_open",
    "G_dt",
    "U_n",
    "U_t",
    "K_tr",
    "K_rot",
    "residual",
)


def flow(runner):
    """Largest overlap over the diameter, of 20 looks, and the ledger at the end. inf: grains were lost, or the run came
    to a standstill."""
    table = Table("dt_flow", 5, ("press", "alpha", "e", "damping", "dt_over_rayleigh", "overlap", *LEDGER))
    for press, alpha, (e, damping), fraction in (
        (p, a, law, f) for p in PRESSURES for a in ALPHAS[::2] for law in FLOW_LAWS for f in FLOWS
    ):
        key = (press, f"{alpha:g}", e, damping, fraction)
        if table.has(*key) or (press == "1e-5" and fraction == "0.05" and damping == "on"):
            continue
        stem = runner.packing(alpha, press)
        rows, ended = runner.thermo(
            "in.dt_flow",
            state=f"{stem}.restart",
            alpha=f"{alpha:g}",
            press=press,
            e=e,
            damping=damping,
            dt=repr(float(fraction) * rayleigh_time(alpha)),
        )
        if ended and len(rows) > 1:
            table.add(*key, rows[:, 1].max() / (2 * alpha ** (1 / 3)), *rows[-1, 2:])
        else:
            table.add(*key, *[math.inf] * (1 + len(LEDGER)))


def chart(_):
    dt_chart.draw()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("stages", nargs="*", default=["theory", "growth", "pairs", "flow", "chart"])
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
