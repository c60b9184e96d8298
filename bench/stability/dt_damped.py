#!/usr/bin/python3
"""Where the time step fails at restitutions near 0 with tangential damping, LIGGGHTS's default:
doc/stability_time_step.md.

Stages, each of which leaves rows in a csv file beside this script and goes on where it was interrupted:

  theory  of packings at rest: the limit of the linear theory, and of the bound that the program watches
  growth  of the same packings, stirred by a breath: the time step at which the motion grows in a run
  pairs   of colliding pairs, random in all: the energy after over the energy before
  flow    of the packings sheared at I = 0.1: the ledger, and the warning of the time step
  chart   of all of them: doc/images/stability_damped.png
"""
import math
import re
import sys

import numpy as np

import dt_damped_chart
from dt_map import LEDGER, grows
from dt_network import Network
from dt_pairs import Pairs
from dt_tools import Table, rayleigh_time, rows_of, run_stages

ALPHAS = (0.33, 1.0, 1.5, 3.0)
PRESSURES = ("1e-5", "1e-3")  # over the smallest semi-axis ratio and Young's modulus
RESTITUTIONS = ("0.0501", "0.06", "0.08", "0.1", "0.15", "0.2")


def theory(runner):
    """Time steps in units of Rayleigh's time."""
    table = Table("damped_theory", 3, ("press", "alpha", "e", "network", "bound", "overlap", "largest"))
    for press in PRESSURES:
        for alpha in ALPHAS:
            missing = [e for e in RESTITUTIONS if not table.has(press, f"{alpha:g}", e)]
            if not missing:
                continue
            network = Network(runner.packing(alpha, press), alpha)
            unit, diameter = rayleigh_time(alpha), 2 * alpha ** (1 / 3)
            for e in missing:
                laws = network.laws(float(e), True)
                overlaps = network.overlap.mean() / diameter, network.overlap.max() / diameter
                table.add(
                    press, f"{alpha:g}", e, network.limit(*laws) / unit, network.bounds(*laws)[0] / unit, *overlaps
                )


def growth(runner):
    """Halves the interval from 0.85 to 1.4 of the theory's limit five times: 1.6 %."""
    table = Table("damped_growth", 3, ("press", "alpha", "e", "stable", "unstable", "over_theory"))
    for press, alpha, e in ((p, a, e) for e in ("0.0501", "0.2") for p in PRESSURES for a in ALPHAS):
        if table.has(press, f"{alpha:g}", e):
            continue
        limit = float(rows_of("damped_theory", press=press, alpha=f"{alpha:g}", e=e)[0]["network"])
        stem, unit = runner.packing(alpha, press), rayleigh_time(alpha)
        low, high = 0.85 * limit, 1.4 * limit
        for _ in range(5):
            middle = math.sqrt(low * high)
            low, high = (low, middle) if grows(runner, stem, alpha, e, "on", middle * unit) else (middle, high)
        table.add(press, f"{alpha:g}", e, low, high, math.sqrt(low * high) / limit)


SPEED = 0.02
FRACTIONS = ("0.02", "0.1", "0.15", "0.2", "0.25", "0.3", "0.4", "0.5")  # of Rayleigh's time
PAIRS = 150  # of each restitution


def pairs(runner):
    """Energies after over before, minus 1, over the pairs of one restitution."""
    table = Table("damped_pairs", 3, ("alpha", "dt_over_rayleigh", "e", "mean", "error", "worst"))
    matrix = " ".join(RESTITUTIONS[max(i, j)] for i in range(6) for j in range(6))
    for alpha in ALPHAS:
        collisions = Pairs(alpha, SPEED, len(RESTITUTIONS), PAIRS)
        before = collisions.energy(collisions.velocities, collisions.spins, collisions.axes)
        for fraction in FRACTIONS:
            if table.has(f"{alpha:g}", fraction, RESTITUTIONS[-1]):
                continue
            dt = float(fraction) * rayleigh_time(alpha)
            collisions.write(runner.work / "pairs.grains", dt)
            _, ended = runner.thermo(
                "in.dt_pairs",
                shape=f"1 1 {alpha:g}",
                edge=collisions.edge(),
                e=matrix,
                damping="on",
                dt=repr(dt),
                skin=0.2 * max(1, alpha),
                steps=math.ceil(60 / float(fraction)) + 4,
            )
            after = collisions.energy_after(runner.work / "pairs.dump") if ended else np.full(len(before), np.inf)
            for e, change in zip(RESTITUTIONS, (after / before - 1).reshape(len(RESTITUTIONS), PAIRS)):
                error = change.std() / math.sqrt(PAIRS) if ended else math.inf
                table.add(f"{alpha:g}", fraction, e, change.mean(), error, change.max())


FLOWS = ("0.05", "0.075", "0.1", "0.15", "0.2", "0.3")  # time steps over Rayleigh's time
LOOKS = 2200  # steps at least, so that the program looks at the time step twice


def flow(runner):
    """Largest overlap over the diameter, of 20 looks, the ledger at the end, and the b of the first warning of the time
    step, 0 where none came. inf: grains were lost."""
    table = Table("damped_flow", 4, ("press", "alpha", "e", "dt_over_rayleigh", "overlap", *LEDGER, "warned"))
    for press, alpha, fraction in ((p, a, f) for p in PRESSURES for a in ALPHAS for f in FLOWS):
        e = RESTITUTIONS[0]
        if table.has(press, f"{alpha:g}", e, fraction) or (press == "1e-5" and float(fraction) < 0.1):
            continue
        dt = float(fraction) * rayleigh_time(alpha)
        rate = 0.1 * math.sqrt(float(press) * min(1, alpha) * 5e3) / (2 * alpha ** (1 / 3))
        output = runner.output(
            "in.dt_flow",
            state=f"{runner.packing(alpha, press)}.restart",
            alpha=f"{alpha:g}",
            press=press,
            e=e,
            damping="on",
            dt=repr(dt),
            strain=max(0.2, LOOKS * dt * rate),
        )
        said = re.search(r"over the mass is ([^ ,]+)", output)
        warned = float(said[1]) if said else 0.0
        rows, ended = runner.rows(output)
        values = [math.inf] * (1 + len(LEDGER))
        if ended and len(rows) > 1:
            values = [rows[:, 1].max() / (2 * alpha ** (1 / 3)), *rows[-1, 2:]]
        table.add(press, f"{alpha:g}", e, fraction, *values, warned)


def chart(_):
    dt_damped_chart.draw()


if __name__ == "__main__":
    run_stages(sys.modules[__name__], ("theory", "growth", "pairs", "flow", "chart"), "folder of packings")
