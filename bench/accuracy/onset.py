#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run shows first when it goes on from a state that another time step has made.

    onset.py build/release/bin/grainscope --scratch folder

Each flow has STATES steady states, made with 0.3 T_R and, over a last strain of 0.02, with 0.01 T_R. From each of them
a run with each of STEPS starts. Means over rows of 6 T_R are compared with those of the run of 0.01 T_R. Half an hour;
writes onset.csv.
"""
import argparse
import csv
import pathlib

import numpy as np

from run import HERE, Flow, Run, execute

FLOWS = [Flow(alpha, mu) for alpha in (1.5, 1.0) for mu in (0.0, 0.4, 10.0)] + [Flow(0.33, 0.4)]
STATES, ROWS = 8, 10
FINEST = 0.01
STEPS = (FINEST, 0.05, 0.15, 0.3, 0.6)
MADE_BY = (0.3, FINEST)
COLUMNS = ("alpha", "mu", "made_by", "fraction", "row", "quantity", "value", "error")


class Runs:
    def __init__(self, binary, scratch):
        self.binary, self.scratch = binary, scratch

    def go(self, study, flow, strain, start="", number=0, **options):
        """Runs what has not been run before, and gives its name."""
        run = Run(study, flow, strain, start, number=number, options=options)
        if not (self.scratch / f"{run.name}.cost").exists():
            execute(self.binary, self.scratch, run)
        return run.name

    def states(self, flow):
        """Steady states by 0.3 T_R, half a unit of strain apart, and each of them 0.02 of strain later by 0.01 T_R."""
        coarse = {"fraction": 0.3, "measure": "basic", "sample": 0.1, "repeat": 1, "block": 600}
        names = [self.go("state", flow, 5, **coarse)]
        for number in range(1, STATES):
            names.append(self.go("state", flow, 0.5, names[-1], number, **coarse))
        return names, [
            self.go("fine", flow, 0.02, name, number, fraction=FINEST, measure="basic", block=600)
            for number, name in enumerate(names)
        ]

    def rows(self, name):
        """Shear stress, pressure and the two powers of each row, averaged over every step."""
        strain, pressure, stress = np.loadtxt(self.scratch / f"{name}.series.txt")[:ROWS, 1:4].T
        powers = np.loadtxt(self.scratch / f"{name}.powers.txt")[:ROWS, 1:].T
        return {"sigma_xy": stress, "P": pressure, "P_n": powers[0], "P_t": powers[1]}


def differences(runs, flow, names, made_by):
    """Rows of onset.csv: relative to the mean of the finest; powers to all that it dissipates."""
    found = {
        fraction: [
            runs.rows(
                runs.go(f"onset{made_by:g}-{fraction:g}", flow, 0.04, name, n, fraction=fraction, measure="power")
            )
            for n, name in enumerate(names)
        ]
        for fraction in STEPS
    }
    finest = found[FINEST]
    lost = np.mean([one["P_n"].mean() + one["P_t"].mean() for one in finest])
    for fraction in STEPS[1:]:
        for quantity in finest[0]:
            scale = lost if quantity.startswith("P_") else np.mean([one[quantity].mean() for one in finest])
            apart = np.array([a[quantity] - b[quantity] for a, b in zip(found[fraction], finest)]) / scale
            for row, values in enumerate(apart.T):
                error = values.std(ddof=1) / np.sqrt(STATES)
                yield flow.alpha, flow.mu, made_by, fraction, row, quantity, values.mean(), error


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope program")
    parser.add_argument("--scratch", type=pathlib.Path, default=pathlib.Path("onset-runs"), help="folder (%(default)s)")
    arguments = parser.parse_args()
    scratch = arguments.scratch.resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    runs = Runs(arguments.binary.resolve(), scratch)
    found = []
    for flow in FLOWS:
        for made_by, names in zip(MADE_BY, runs.states(flow)):
            found += differences(runs, flow, names, made_by)
            print(f"{flow}, states of {made_by:g} T_R", flush=True)
    with open(HERE / "onset.csv", "w", newline="") as out:
        out.write(
            "# Written by onset.py. made_by, fraction: time steps of the state and of the run over T_R; row: of 6 T_R\n"
            "# value: difference from the run of 0.01 T_R, over its mean (powers: over the power dissipated).\n"
            "# error: standard error over the states.\n"
        )
        csv.writer(out, lineterminator="\n").writerow(COLUMNS)
        csv.writer(out, lineterminator="\n").writerows(
            [[f"{value:.4g}" if isinstance(value, float) else value for value in row] for row in found]
        )


if __name__ == "__main__":
    main()
