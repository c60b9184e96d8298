#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How the time step shifts the means of a steady flow: long runs, each at one step from a dilute start of its own.

    steady.py build/release/bin/grainscope --hours 3 --jobs 2     # runs on, and adds what ends to steady.csv
    steady.py --plan                                              # what there is, and what the rest will take

A run is one flow at one step from one seed. It shears over a strain that is left out and one that is measured in
BLOCKS blocks. The next run is always that of the flow and step that has the smallest part of its strain. When the hours
are over no run is started; those at work still end. steady_chart.py makes the tables and figures.
"""
import argparse
import csv
import itertools
import math
import pathlib
import shutil
import time
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait

import numpy as np

from run import HERE, Flow, Run, execute

RESULTS = HERE / "steady.csv"
BLOCKS = 5
QUANTITIES = ("mu_eff", "phi", "Z", "P_n", "P_t")
COLUMNS = ("alpha", "mu", "I", "fraction", "seed", "block", "strain", *QUANTITIES, "seconds")
SOLID = 4 / 3 * math.pi * 500 * np.mean(np.linspace(0.8, 1.2, 15) ** 3)  # volume of the grains over alpha

# Strain that is wanted of each step over that of the flow, in the order in which steps are begun with.
SHARE = {0.15: 0.75, 0.6: 1.5, 0.3: 1.0, 0.4: 0.6, 0.05: 0.25, 0.1: 0.3}


class Series:
    """Runs of one flow: how far they settle, how far each measures, and the strain that is wanted at SHARE 1."""

    def __init__(self, flow, settling, measured, wanted, seconds):
        self.flow, self.settling, self.measured, self.wanted = flow, settling, measured, wanted
        self.seconds = seconds  # per unit of strain at 0.15, for the plan


SERIES = [
    *(Series(Flow(1.0, mu), 10, 100, 800, 1.0) for mu in (0.0, 0.4, 10.0)),
    *(Series(Flow(1.5, mu), 10, 50, 400, 3.0) for mu in (0.0, 0.4, 10.0)),
    *(Series(Flow(0.33, mu), 10, 25, 100, 9.0) for mu in (0.0, 0.4, 10.0)),
    Series(Flow(1.0, 0.4, 0.01), 5, 25, 100, 10.0),
    Series(Flow(1.5, 0.4, 0.01), 5, 10, 50, 30.0),
    Series(Flow(1.0, 10.0, 0.01), 5, 25, 100, 10.0),
]


def prime_above(number):
    return next(n for n in itertools.count(number + 1) if all(n % d for d in range(2, math.isqrt(n) + 1)))


def read_results():
    """Rows of steady.csv as dictionaries of numbers."""
    if not RESULTS.exists():
        return []
    with open(RESULTS, newline="") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return [{name: float(value) for name, value in row.items()} for row in rows]


def of_series(rows, series, fraction):
    flow = series.flow
    wanted = (flow.alpha, flow.mu, flow.I, fraction)
    return [row for row in rows if (row["alpha"], row["mu"], row["I"], row["fraction"]) == wanted]


def blocks_of(series, prefix):
    """Means over BLOCKS equal strains, the settling left out. mu_eff is a ratio of means; powers over rate P volume."""
    rate = np.loadtxt(f"{prefix}.times.txt")[0]
    _, strain, pressure, stress, volume, contacts, power_n, power_t = np.loadtxt(f"{prefix}.series.txt").T
    if series.flow.mu > 0:
        power_n, power_t = np.loadtxt(f"{prefix}.powers.txt").T[1:]
    edges = series.settling + series.measured / BLOCKS * np.arange(BLOCKS + 1)
    for number, (low, high) in enumerate(zip(edges, edges[1:])):
        part = (strain > low) & (strain <= high)
        unit = rate * (pressure[part] * volume[part]).mean()
        yield number, (
            stress[part].mean() / pressure[part].mean(),
            SOLID * series.flow.alpha / volume[part].mean(),
            contacts[part].mean(),
            power_n[part].mean() / unit,
            power_t[part].mean() / unit,
        )


def run_one(binary, scratch, series, fraction, seed):
    """Rows of one run."""
    flow = series.flow
    sample = 2.4 * flow.shorter_strain
    strain = series.settling + series.measured
    options = {
        "fraction": fraction,
        "seed": prime_above(15485863 + 1000 * seed),
        "sample": sample,
        "repeat": max(1, round(strain / 1000 / sample)),
        "measure": "power" if flow.mu > 0 else "basic",
        "ledger": "on" if flow.mu > 0 else "off",
    }
    run = Run("steady", flow, strain, label=f"{fraction:g}", number=seed, options=options)
    seconds = execute(binary, scratch, run)
    rows = [
        (flow.alpha, flow.mu, flow.I, fraction, seed, number, series.measured / BLOCKS, *means, seconds / BLOCKS)
        for number, means in blocks_of(series, scratch / run.name)
    ]
    for file in scratch.glob(f"{run.name}.*"):
        file.unlink()
    return rows


def append(rows):
    new = not RESULTS.exists()
    with open(RESULTS, "a", newline="") as out:
        if new:
            out.write(
                "# Written by steady.py. Means of a block of a run; fraction: time step over T_R; strain: of it;\n"
                "# mu_eff, phi, Z [-]; P_n, P_t [rate P volume]; seconds of processor time.\n"
            )
            csv.writer(out, lineterminator="\n").writerow(COLUMNS)
        csv.writer(out, lineterminator="\n").writerows([[f"{value:.6g}" for value in row] for row in rows])


def most_missed(rows, pending, only):
    """The flow and step that has least of its strain, what is at work counted, and the next seed."""

    def state(series, fraction):
        waiting = sum(1 for one in pending if one[:2] == (series, fraction))
        seeds = {row["seed"] for row in of_series(rows, series, fraction)}
        return len(seeds) + waiting

    choices = [
        (state(series, fraction) * series.measured / (SHARE[fraction] * series.wanted), n, series, fraction)
        for n, (fraction, series) in enumerate(itertools.product(SHARE, SERIES))
        if only is None or str(series.flow) in only
    ]
    done, _, series, fraction = min(choices, key=lambda choice: choice[:2])
    return None if done >= 1 else (series, fraction, state(series, fraction))


def run_on(binary, scratch, hours, jobs, only):
    end = time.monotonic() + 3600 * hours
    scratch.mkdir(parents=True, exist_ok=True)
    rows, pending = read_results(), {}
    with ThreadPoolExecutor(jobs) as pool:
        while True:
            while len(pending) < jobs and time.monotonic() < end:
                chosen = most_missed(rows, pending.values(), only)
                if chosen is None:
                    break
                pending[pool.submit(run_one, binary, scratch, *chosen)] = chosen
            if not pending:
                return
            for future in wait(pending, return_when=FIRST_COMPLETED).done:
                series, fraction, seed = pending.pop(future)
                append(future.result())
                rows = read_results()
                left = max(0, end - time.monotonic()) / 60
                print(f"{series.flow} {fraction:g} T_R seed {seed}; {left:.0f} min left", flush=True)


def show_plan():
    rows, hours = read_results(), 0.0
    for series, fraction in itertools.product(SERIES, SHARE):
        found = of_series(rows, series, fraction)
        strain = sum(row["strain"] for row in found)
        wanted = SHARE[fraction] * series.wanted
        per_strain = series.seconds * 0.15 / fraction
        if found:
            per_strain = (
                sum(row["seconds"] for row in found) / strain * series.measured / (series.measured + series.settling)
            )
        runs = max(0, math.ceil((wanted - strain) / series.measured))
        left = runs * (series.settling + series.measured) * per_strain / 3600
        hours += left
        print(f"{series.flow}  {fraction:4g} T_R  strain {strain:5.0f} of {wanted:5.0f}  {left:5.2f} core hours left")
    print(f"{hours:.1f} core hours left")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, nargs="?", help="the grainscope program")
    parser.add_argument(
        "--scratch", type=pathlib.Path, default=pathlib.Path("steady-runs"), help="folder (%(default)s)"
    )
    parser.add_argument("--hours", type=float, default=1.0, help="when to start no more runs (default %(default)s)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (default %(default)s)")
    parser.add_argument("--only", nargs="*", help="flows, as the plan names them")
    parser.add_argument("--plan", action="store_true", help="say what is missing, and run nothing")
    arguments = parser.parse_args()
    if arguments.plan:
        show_plan()
    elif arguments.binary is None or shutil.which(str(arguments.binary.resolve())) is None:
        parser.error(f"needs a program to run, or --plan; got {arguments.binary}")
    else:
        run_on(arguments.binary.resolve(), arguments.scratch.resolve(), arguments.hours, arguments.jobs, arguments.only)


if __name__ == "__main__":
    main()
