#!/usr/bin/python3
"""Draws bulk modulus, coordination number and solid fraction against pressure: ./draw.py picture table [table ...],
tables as in.isotropic writes them, each named as in the legend."""
from pathlib import Path
import sys

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from grainscope.figures import style as figure_style  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402

YOUNG = 5e6


def read(path):
    names = path.read_text().splitlines()[0].split()[1:]
    return dict(zip(names, np.loadtxt(path, ndmin=2).T))


def say(name, table):
    print(name)
    print("     P/E     phi      Z  Z_backbone  rattlers    K/E  mean field  ratio  largest |P_a/P - 1|")
    for k, pressure in enumerate(table["P"]):
        uneven = max(abs(table[f"P_{axis}"][k] / pressure - 1) for axis in "xyz")
        print(
            f"{pressure / YOUNG:8.1e}  {table['phi'][k]:.4f}  {table['Z'][k]:.3f}  {table['Z_backbone'][k]:10.3f}"
            f"  {table['rattlers'][k]:8.3f}  {table['K'][k] / YOUNG:.5f}  {table['K_mean_field'][k] / YOUNG:10.5f}"
            f"  {table['K'][k] / table['K_mean_field'][k]:5.3f}  {uneven:.1e}"
        )
    power = np.polyfit(np.log(table["P"]), np.log(table["K"]), 1)[0]
    print(f"K grows as P^{power:.3f}")


def main(picture, paths):
    figure, (modulus, number, solid) = plt.subplots(1, 3, figsize=(10.5, 3.4), layout="constrained")
    for path, colour in zip(map(Path, paths), figure_style.RUN_COLOURS):
        table, name = read(path), path.stem.replace("_", " ")
        say(name, table)
        root = np.cbrt(table["P"] / YOUNG)
        modulus.plot(root, table["K"] / YOUNG, "o", color=colour, label=f"{name}: measured")
        modulus.plot(root, table["K_mean_field"] / YOUNG, "-", lw=1, color=colour, label="mean field")
        number.semilogx(table["P"] / YOUNG, table["Z_backbone"], "o-", ms=4, lw=1, color=colour)
        solid.semilogx(table["P"] / YOUNG, table["phi"], "o-", ms=4, lw=1, color=colour)
    modulus.set(xlabel="$(P/E)^{1/3}$", ylabel="$K/E$", title="bulk modulus", xlim=(0, None), ylim=(0, None))
    number.set(xlabel="$P/E$", ylabel="$Z$ without rattlers", title="coordination number")
    solid.set(xlabel="$P/E$", ylabel=r"$\phi$", title="solid fraction")
    modulus.legend(fontsize=8)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
