#!/usr/bin/python3
"""The error of the time step in the energy of a collision, G_dt of compute energy/ledger, against the time step:
bench/in.order for four shapes, as a Markdown table and as doc/images/ledger_order.png. Beside it the residual of the
ledger, which does not depend on the step."""
import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from grainscope.figures.style import plt, shape_colour, shape_marker  # noqa: E402

SHAPES = (0.33, 1.0, 1.5, 3.0)
FRACTIONS = (0.16, 0.08, 0.04, 0.02, 0.01)


def collide(binary, alpha, fraction):
    """(|G_dt|, |residual|), both over D_n + D_t."""
    command = [
        str(binary),
        "-in",
        str(ROOT / "bench" / "in.order"),
        "-log",
        "none",
        "-var",
        "alpha",
        str(alpha),
        "-var",
        "fraction",
        str(fraction),
    ]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    lost, step, residual = map(float, re.search(r"^ledger (\S+) (\S+) (\S+)$", output, re.M).groups())
    return abs(step) / lost, residual


def draw(found, path):
    figure, axes = plt.subplots(figsize=(5.0, 3.6))
    for alpha in SHAPES:
        axes.loglog(
            FRACTIONS,
            [found[alpha, f][0] for f in FRACTIONS],
            marker=shape_marker(alpha),
            color=shape_colour(alpha),
            label=rf"$\alpha$ = {alpha:g}",
        )
    axes.loglog(FRACTIONS, [max(found[a, f][1] for a in SHAPES) for f in FRACTIONS], "k.--", label="residual, largest")
    axes.loglog(FRACTIONS, [0.15 * f * f for f in FRACTIONS], color="0.6", label=r"$\propto dt^2$")
    axes.set_xlabel(r"$dt / T_R$")
    axes.set_ylabel(r"over $D_n + D_t$")
    axes.legend(fontsize=8)
    figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    binary = parser.parse_args().binary.resolve()
    found = {(a, f): collide(binary, a, f) for a in SHAPES for f in FRACTIONS}
    print(
        "| alpha | "
        + " | ".join(f"dt = {f:g} T_R" for f in FRACTIONS)
        + " | largest residual |\n|"
        + "---|" * (len(FRACTIONS) + 2)
    )
    for a in SHAPES:
        print(
            f"| {a:g} | "
            + " | ".join(f"{found[a, f][0]:.1e}" for f in FRACTIONS)
            + f" | {max(found[a, f][1] for f in FRACTIONS):.0e} |"
        )
    draw(found, ROOT / "doc" / "images" / "ledger_order.png")


if __name__ == "__main__":
    main()
