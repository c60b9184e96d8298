#!/usr/bin/python3
"""Draws stress ratio, volume change and solid fraction of triaxial tests against axial strain, and prints peak and
critical state: ./draw.py picture table [table ...], tables as in.triaxial writes them, each named as in the legend."""
import math
from pathlib import Path
import sys

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from grainscope.figures import style as figure_style  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402

CRITICAL = 0.3  # axial strain from which averages are taken
BLOCKS = 8
SMOOTH = 5  # rows that the peak is a mean of


def read(path):
    names = path.read_text().splitlines()[1].split()[1:]
    return dict(zip(names, np.loadtxt(path).T))


def mean_of(values):
    """Mean and its error, from blocks."""
    blocks = [block.mean() for block in np.array_split(values, BLOCKS)]
    return np.mean(values), np.std(blocks, ddof=1) / math.sqrt(BLOCKS)


def angle_of(q_p):
    """Angle of friction in triaxial compression [degrees]."""
    return math.degrees(math.asin(3.0 * q_p / (6.0 + q_p)))


def peak_of(table):
    """Stress ratio at the peak, axial strain there, and the steepest -d eps_v/d eps_1 over 0.025 of strain."""
    smooth = np.convolve(table["q_p"], np.ones(SMOOTH) / SMOOTH, mode="valid")
    k = int(np.argmax(smooth))
    width = 10
    slope = -(table["eps_v"][width:] - table["eps_v"][:-width]) / (table["eps_1"][width:] - table["eps_1"][:-width])
    return smooth[k], table["eps_1"][k + SMOOTH // 2], slope.max()


def say(name, table):
    late = table["eps_1"] >= CRITICAL
    q_p, error = mean_of(table["q_p"][late])
    values = ", ".join(
        f"{column} {mean:.{digits}f} +- {off:.{digits}f}"
        for column, digits in (("phi", 4), ("Z", 3), ("rattlers", 3), ("sliding", 3))
        for mean, off in [mean_of(table[column][late])]
    )
    lean = math.degrees(math.radians(angle_of(q_p + error)) - math.radians(angle_of(q_p)))
    print(f"{name}: start phi {table['phi'][0]:.4f}, Z {table['Z'][0]:.2f}")
    top, where, dilatancy = peak_of(table)
    psi = math.degrees(math.asin(dilatancy / (2.0 + dilatancy)))
    print(
        f"  peak q/p {top:.3f}, {angle_of(top):.1f} degrees, at eps_1 = {where:.3f}; "
        f"steepest -d eps_v/d eps_1 {dilatancy:.2f}, dilatancy angle {psi:.1f} degrees"
    )
    print(f"  critical q/p {q_p:.3f} +- {error:.3f}, {angle_of(q_p):.1f} +- {lean:.1f} degrees; {values}")
    slope, _ = np.polyfit(table["eps_1"][late], table["eps_v"][late], 1)
    off = {axis: mean_of(table[f"P_{axis}"][late])[0] for axis in "xyz"}
    print(
        f"  d eps_v/d eps_1 there {slope:+.3f}; pressures {off['x']:.2f} {off['y']:.2f} {off['z']:.2f} Pa; "
        f"inputs clipped {table['clipped'][-1]:.2%}"
    )


def main(picture, paths):
    tables = {path.stem: read(path) for path in map(Path, paths)}
    figure, (stress, volume, solid) = plt.subplots(1, 3, figsize=(10.5, 3.4), layout="constrained")
    for (name, table), colour in zip(tables.items(), figure_style.RUN_COLOURS):
        say(name, table)
        stress.plot(table["eps_1"], table["q_p"], lw=1, color=colour, label=name.replace("_", " "))
        volume.plot(table["eps_1"], table["eps_v"], lw=1, color=colour)
        solid.plot(table["eps_1"], table["phi"], lw=1, color=colour)
    stress.set(ylabel="$q/p$", ylim=(0, None), title="stress ratio")
    volume.set(ylabel=r"$\varepsilon_v$", title="volume (positive: it shrinks)")
    solid.set(ylabel=r"$\phi$", title="solid fraction")
    for axis in (stress, volume, solid):
        axis.set(xlabel=r"$\varepsilon_1$", xlim=(0, None))
    stress.legend(fontsize=8)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
