#!/usr/bin/python3
"""How well `gain auto` of fix press/strain holds its target, from the dilute start to steady state.

Runs examples/simple_shear for every combination of the inertial numbers, aspect ratios and friction coefficients given,
and prints a Markdown table: mean and standard deviation of P/P_target over the last half of the strain, the largest
value of the whole run (each of them a mean over 0.01 of strain), and the solid fraction.
"""
import argparse
import itertools
import pathlib
import subprocess
import tempfile

import numpy

DECK = pathlib.Path(__file__).resolve().parent.parent / "examples" / "simple_shear" / "in.simple_shear"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("--inertial", type=float, nargs="+", default=[0.1, 0.01])
    parser.add_argument("--alpha", type=float, nargs="+", default=[0.33, 1.0, 3.0])
    parser.add_argument("--mu", type=float, nargs="+", default=[0.0, 0.4, 10.0])
    parser.add_argument(
        "--grains", type=int, default=700, help="at alpha 3 fewer make the box too small (default %(default)s)"
    )
    parser.add_argument("--strain", type=float, default=2.0)
    arguments = parser.parse_args()
    print("| I | alpha | mu_p | mean P/P_t | std | largest | phi |\n|---|---|---|---|---|---|---|", flush=True)
    for inertial, alpha, mu in itertools.product(arguments.inertial, arguments.alpha, arguments.mu):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "out"
            subprocess.run(
                [
                    str(arguments.binary.resolve()),
                    "-in",
                    str(DECK),
                    "-log",
                    "none",
                    "-var",
                    "out",
                    str(out),
                    "-var",
                    "N",
                    str(arguments.grains),
                    "-var",
                    "I",
                    str(inertial),
                    "-var",
                    "alpha",
                    str(alpha),
                    "-var",
                    "mu",
                    str(mu),
                    "-var",
                    "strain",
                    str(arguments.strain),
                ],
                cwd=folder,
                check=True,
                stdout=subprocess.DEVNULL,
            )
            rows = numpy.loadtxt(out / "series.txt")
        steady = rows[rows[:, 1] > arguments.strain / 2]
        print(
            f"| {inertial:g} | {alpha:g} | {mu:g} | {steady[:, 2].mean():.3f} | {steady[:, 2].std():.3f} | "
            f"{rows[:, 2].max():.2f} "
            f"| {steady[:, 5].mean():.3f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
