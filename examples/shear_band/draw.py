#!/usr/bin/python3
"""Draws the profiles that in.shear_band wrote in the current folder and the local friction mu(I), and prints how well
stress balances load and weight, and losses the work of shear: ./draw.py [picture]"""
import math
from pathlib import Path
import sys

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from grainscope.figures import style as figure_style  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402

from grainscope.fields import read_field  # noqa: E402

A, DENSITY, GRAVITY, LOAD, SPEED = 0.003, 2500.0, 9.81, 1500.0, 0.4  # as in the deck
PLATE = 28  # grains of the lid
DIAMETER = 2.0 * A * 1.5 ** (1.0 / 3.0)
RADIUS = 1.5 * A  # of a plate's grains
LEAST = 1e-6  # I that is drawn; below, and where the velocity falls with y, on this line
BLUE, ORANGE, GREEN, PINK = figure_style.RUN_COLOURS[:4]


def table(path):
    names = path.read_text().splitlines()[1].split()[1:]
    return dict(zip(names, np.loadtxt(path).T))


def error_of_mean(values):
    return np.std(values, ddof=1) / math.sqrt(len(values))


class Profile:
    def __init__(self, folder):
        self.field = field = read_field(folder / "profile.csv")
        balance = table(folder / "balance.txt")
        self.lid = balance["lid"].mean()
        self.pull = balance["pull"].mean(), error_of_mean(balance["pull"])
        self.slab = {name: balance[name].mean() for name in ("weight", "pressure")}
        self.slab_error = error_of_mean(balance["pressure"])
        self.y, volume = field["y"], field["V"]
        self.step = self.y[1] - self.y[0]
        self.area = volume[0] / self.step
        # Cells that hold no branches to a plate's grains
        self.inner = (self.y > RADIUS + 2 * A) & (self.y < self.lid - RADIUS - 2 * A)
        self.pressure = -(field["s_yy"] + field["sk_yy"])
        self.pressure_error = np.hypot(field.error("s_yy"), field.error("sk_yy"))
        self.shear = field["s_xy"] + field["sk_xy"]
        self.shear_error = np.hypot(field.error("s_xy"), field.error("sk_xy"))
        self.rate = np.gradient(field["v_x"], self.y)

    def weight(self):
        """Load and weight above, at the middles: of the bed alone, gravity leaves the plates out."""
        mass = DENSITY * self.field["phi"] * self.field["V"]
        above = np.cumsum(mass[::-1])[::-1] - 0.5 * mass
        lid = PLATE * DENSITY * 4 / 3 * math.pi * RADIUS**3
        return LOAD + GRAVITY * (above - lid) / self.area


def say(profile, weight):
    inner = profile.inner
    off = profile.pressure[inner] / weight[inner] - 1
    print(
        f"pressure over load and weight, {inner.sum()} cells: mean {off.mean():+.2%}, "
        f"rms {np.sqrt((off**2).mean()):.2%}"
    )
    print(f"in two slabs: {profile.slab['pressure']:.1f} +- {profile.slab_error:.1f}, {profile.slab['weight']:.1f} Pa")
    shear = profile.shear[inner]
    print(
        f"shear stress {shear.mean():.1f} +- {profile.shear_error[inner].mean():.1f} Pa, "
        f"over cells {np.ptp(shear):.1f}; "
        f"pull on the lid {profile.pull[0]:.1f} +- {profile.pull[1]:.1f} Pa"
    )
    field = profile.field
    names = ("P_n", "P_t", "P_t_damp")
    lost = profile.step * sum(field[name].sum() for name in names)
    error = profile.step * math.hypot(*(np.linalg.norm(field.error(name)) for name in names))
    print(f"lost {lost:.1f} +- {error:.1f} W/m2; pull on the lid times its speed {SPEED * profile.pull[0]:.1f}")
    below = profile.step * sum(field[name][inner] for name in names).sum()
    work = profile.step * (profile.shear * profile.rate)[inner].sum()
    print(f"in the cells drawn: lost {below:.1f}, work of shear {work:.1f} W/m2")


def line(axis, profile, name, colour, label=None):
    field, inner = profile.field, profile.inner
    y = profile.y[inner] / DIAMETER
    value, error = field[name][inner], field.error(name)[inner]
    axis.plot(value, y, "o-", ms=2.5, lw=1, color=colour, label=label)
    axis.fill_betweenx(y, value - error, value + error, color=colour, alpha=0.25, linewidth=0)


def draw(profile, weight):
    figure, axes = plt.subplots(2, 3, figsize=(9.6, 6.4), layout="constrained")
    inner, y = profile.inner, profile.y[profile.inner] / DIAMETER
    speed, stress, heat, loss, order, law = axes.flat
    line(speed, profile, "v_x", BLUE)
    speed.set(xlabel="$v_x$ [m/s]", xscale="log", title="velocity")
    stress.errorbar(
        profile.pressure[inner], y, xerr=profile.pressure_error[inner], fmt="o", ms=3, color=BLUE, label="$P$"
    )
    stress.plot(weight[inner], y, "-", lw=1, color="0.3", label="load + weight above")
    stress.errorbar(
        profile.shear[inner], y, xerr=profile.shear_error[inner], fmt="s", ms=3, color=ORANGE, label=r"$\tau$"
    )
    stress.axvline(profile.pull[0], color=ORANGE, lw=1, ls="--", label="pull on the lid")
    stress.set(xlabel="stress [Pa]", title="stress, kinetic included", xlim=(0, None))
    line(heat, profile, "T", PINK)
    heat.set(xlabel="$T$ [m$^2$/s$^2$]", xscale="log", title="temperature")
    line(loss, profile, "P_t", ORANGE, "friction $P_t$")
    line(loss, profile, "P_n", BLUE, "normal damping $P_n$")
    work = (profile.shear * profile.rate)[inner]
    loss.plot(work, y, "-", color="0.3", lw=1, label=r"work of shear $\tau\, dv_x/dy$")
    loss.set(xlabel="power per volume [W/m$^3$]", xscale="log", title="losses")
    line(order, profile, "phi", GREEN, r"$\phi$")
    line(order, profile, "S2", PINK, "$S_2$")
    order.set(xlim=(0, 1), title="solid fraction, order")
    inertial = profile.rate[inner] * DIAMETER * np.sqrt(DENSITY / profile.pressure[inner])
    inertial = np.maximum(inertial, LEAST)
    friction = profile.shear[inner] / profile.pressure[inner]
    error = friction * np.hypot(
        profile.shear_error[inner] / profile.shear[inner], profile.pressure_error[inner] / profile.pressure[inner]
    )
    law.errorbar(inertial, friction, yerr=error, fmt="none", ecolor="0.6", lw=0.8)
    dots = law.scatter(inertial, friction, c=y, s=16, cmap="viridis", zorder=3)
    figure.colorbar(dots, ax=law, label="$y/d$", shrink=0.8)
    law.set(
        xlabel="$I$",
        ylabel=r"$\mu = \tau/P$",
        xscale="log",
        xlim=(0.7 * LEAST, 0.5),
        title=r"local $\mu(I)$, all cells",
    )
    for axis in (speed, stress, heat, loss, order):
        axis.set_ylabel("$y/d$")
    stress.legend(fontsize=7, loc=(0.27, 0.03))
    order.legend(fontsize=7, loc="lower right")
    loss.legend(fontsize=7, loc="upper left")
    loss.set_ylim(0, 28)
    return figure


def main(picture):
    profile = Profile(Path("."))
    weight = profile.weight()
    say(profile, weight)
    figure = draw(profile, weight)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "shear_band.png")
