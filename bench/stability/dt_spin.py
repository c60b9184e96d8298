#!/usr/bin/python3
"""How far a grain may turn in a time step: doc/stability_time_step.md.

Stages, each of which leaves rows in a csv file beside this script and goes on where it was interrupted:

  hits   discs and rods that spin edge over edge hit a plane, or a grain at rest, at 0.15 of Rayleigh's time and spins
    from 1e-3 to 1 rad per step; against the same with a hundredth of the step
  lists  the same with a neighbour list, and with it all that is remembered of distances, made again in each step
  law    the energy that the contact law makes or takes of collisions without friction
  free   tumbling in free flight for 100,000 steps, against the closed form
  chart  doc/images/stability_spin.png
"""
import math
import sys

import numpy as np

import dt_spin_chart
from dt_pairs import Pairs
from dt_tools import DENSITY, SHEAR_MODULUS, Table, axes_of, hertz_time, rayleigh_time, read_dump, run_stages, unit

ALPHAS = (0.1, 0.33, 3.0)
TURNS = ("0.001", "0.003", "0.01", "0.03", "0.1", "0.3", "1")  # rad per step
RULE, FINER = 0.15, 100
LAWS, COUNT = ("frictionless", "mu 0.5"), 24  # grains of each law and target
TARGETS = ("plane", "grain")


class Hits(Pairs):
    """Pairs of which the first spins about an axis across its own and the second is at rest, and as many single grains
    that spin above a plane at z = 0. No grain advances: each would touch as it turned by a part of a step."""

    def __init__(self, alpha, spin, dt):
        super().__init__(alpha, 1.0, len(LAWS), COUNT)
        self.spin = spin
        n, turn = len(self.phase), spin * dt * self.phase
        arm = self._touching(unit(self.branch))[2]
        across = unit(np.cross(arm, self.normal))  # also across the axis, as the arm is between axis and normal
        self.velocities = np.zeros((2, n, 3))
        self.spins = np.array([spin * across, np.zeros((n, 3))])
        self._turn_back(across, turn)
        lean = np.radians(np.random.default_rng(6).uniform(15, 75, size=n))  # of the axis, from the upright
        self.height = np.hypot(alpha * np.cos(lean), np.sin(lean))
        sense = 1 if alpha < 1 else -1  # in which the lean grows, or becomes less, towards the touch
        before = lean - sense * np.minimum(turn, 0.9 * (lean if alpha < 1 else 0.5 * math.pi - lean))
        self.single_quaternions = np.array([(math.cos(t / 2), 0, math.sin(t / 2), 0) for t in before])
        self.single_spins = np.tile((0.0, sense * spin, 0.0), (n, 1))

    def _turn_back(self, across, turn):
        """By so much, or where the grains would overlap then by as much less as is needed."""
        quaternions, away = self.quaternions[0].copy(), np.linalg.norm(self.branch, axis=1)
        for _ in range(20):
            turned = product(np.column_stack([np.cos(turn / 2), -np.sin(turn / 2)[:, None] * across]), quaternions)
            self.quaternions[0], self.axes[0] = turned, axes_of(turned)
            dyads = self.axes[0][:, :, None] * self.axes[0][:, None, :]
            self.squares[0] = np.eye(3) + (self.alpha**2 - 1) * dyads
            touching = np.linalg.norm(self._touching(unit(self.branch))[0], axis=1) >= away
            turn = np.where(touching, 0.7 * turn, turn)
            if not touching.any():
                break

    def spacing(self):
        return 14.0 * max(1, self.alpha)

    def edge(self):
        return 4 * self.spacing()

    def write(self, path):
        lines = []
        for pair in range(len(self.phase)):
            kind = pair // COUNT + 1
            place = self.spacing() * (np.array([pair % 5, pair // 5 % 5, 1 + pair // 25]) - (2, 2, 0))
            for k, side in ((0, -0.5), (1, 0.5)):
                grain = self.quaternions[k, pair], self.spins[k, pair]
                lines += grain_lines(len(lines), kind, place + side * self.branch[pair], self.alpha, *grain)
        for single in range(len(self.phase)):
            kind = single // COUNT + 1
            place = np.array(
                (self.spacing() * (single % 7 - 3), self.spacing() * (single // 7 - 3), self.height[single])
            )
            grain = self.single_quaternions[single], self.single_spins[single]
            lines += grain_lines(len(lines), kind, place, self.alpha, *grain)
        path.write_text("\n".join(lines) + "\n")

    def after(self, path):
        """Per target, law and collision: energy over that before, minus 1; the same of the vector of the angular
        momentum of pairs; whether the spinning grain was never touched."""
        rows = read_dump(path)[0]
        n, moment = len(self.phase), self.mass / 5 * (1 + self.alpha**2)
        energy, momentum = self._energy(rows), self._momentum(rows)
        before = 0.5 * moment * self.spin**2
        apart = np.linalg.norm(rows[:, 7:10] - self._spins(), axis=1) < 1e-9 * self.spin
        pairs, start = slice(0, 2 * n), moment * self.spins[0]
        turned = momentum[pairs].reshape(n, 2, 3).sum(axis=1) - start
        return {
            "grain": (energy[pairs].reshape(n, 2).sum(axis=1) / before - 1, apart[pairs].reshape(n, 2)[:, 0]),
            "plane": (energy[2 * n :] / before - 1, apart[2 * n :]),
            "momentum": np.linalg.norm(turned, axis=1) / (moment * self.spin),
        }

    def _spins(self):
        return np.concatenate([self.spins.transpose(1, 0, 2).reshape(-1, 3), self.single_spins])

    def _split(self, rows):
        axes = axes_of(rows[:, 10:14])
        along = np.einsum("na,na->n", rows[:, 7:10], axes)[:, None] * axes
        return along, rows[:, 7:10] - along

    def _energy(self, rows):
        along, across = (np.einsum("na,na->n", part, part) for part in self._split(rows))
        flight = np.einsum("na,na->n", rows[:, 4:7], rows[:, 4:7])
        return 0.5 * self.mass * (flight + (2 * along + (1 + self.alpha**2) * across) / 5)

    def _momentum(self, rows):
        """About the middle of the pairs."""
        along, across = self._split(rows)
        places = rows[:, 1:4].copy()
        n = 2 * len(self.phase)
        places[:n] -= np.repeat(places[:n].reshape(-1, 2, 3).mean(axis=1), 2, axis=0)
        return self.mass * (np.cross(places, rows[:, 4:7]) + (2 * along + (1 + self.alpha**2) * across) / 5)


def product(p, q):
    """Of quaternions."""
    w, v = p[:, :1], p[:, 1:]
    return np.hstack(
        [w * q[:, :1] - (v * q[:, 1:]).sum(axis=1, keepdims=True), w * q[:, 1:] + q[:, :1] * v + np.cross(v, q[:, 1:])]
    )


def grain_lines(lines, kind, place, alpha, quaternion, spin):
    """The two commands of one more grain, after as many lines."""
    atom = lines // 2 + 1
    return [
        f"create_atoms {kind} single {' '.join(map(repr, map(float, place)))} units box",
        f"set atom {atom} shape 1 1 {alpha!r} blockiness 2 2 density {DENSITY!r} quat_direct "
        + " ".join(map(repr, map(float, quaternion)))
        + "".join(f" {name} {float(s)!r}" for name, s in zip(("omegax", "omegay", "omegaz"), spin)),
    ]


def run_hits(runner, collisions, dt, duration, **more):
    steps = math.ceil(duration / dt)
    rows, ended = runner.thermo(
        "in.dt_spin",
        edge=collisions.edge(),
        size=max(1, collisions.alpha),
        dt=repr(dt),
        steps=steps,
        every=steps,
        **more,
    )
    if not ended or rows[0, 1:].any():
        raise SystemExit(f"in.dt_spin failed: alpha {collisions.alpha}, spin {collisions.spin}")
    return rows


def setting(alpha, turn):
    """Grains, time step, and a time in which the collision is over."""
    dt = RULE * rayleigh_time(alpha)
    spin = float(turn) / dt
    speed = spin * max(1, alpha)
    return Hits(alpha, spin, dt), dt, 1 / spin + 8 * hertz_time(alpha, speed), speed


def hits(runner):
    """Mean, rms and largest difference of the energy from the run with the fine step, over the energy before; and what
    the law alone makes or takes of it, rms of the fine run. Missed: collisions that did not take place, in the coarse
    run and in the fine one."""
    columns = ("alpha", "target", "law", "turn", "tip_over_sound", "mean", "rms", "worst", "by_law")
    table = Table("spin_hits", 4, (*columns, "missed", "missed_fine", "touching", "momentum"))
    for alpha in ALPHAS:
        for turn in TURNS:
            if table.has(f"{alpha:g}", TARGETS[-1], LAWS[-1], turn):
                continue
            collisions, dt, duration, speed = setting(alpha, turn)
            collisions.write(runner.work / "spin.grains")
            last = run_hits(runner, collisions, dt, duration)
            coarse = collisions.after(runner.work / "spin.dump")
            run_hits(runner, collisions, dt / FINER, duration)
            fine = collisions.after(runner.work / "spin.dump")
            for target in TARGETS:
                for k, law in enumerate(LAWS):
                    part = slice(k * COUNT, (k + 1) * COUNT)
                    (energy, apart), (right, never) = ([x[part] for x in run[target]] for run in (coarse, fine))
                    error = energy - right
                    table.add(
                        *(f"{alpha:g}", target, law, turn, speed / math.sqrt(SHEAR_MODULUS / DENSITY)),
                        *(
                            error.mean(),
                            math.sqrt((error**2).mean()),
                            np.abs(error).max(),
                            math.sqrt((right**2).mean()),
                        ),
                        *(apart.mean(), never.mean(), last[-1, 1 if target == "grain" else 2]),
                        coarse["momentum"][part].max() if target == "grain" else math.nan,
                    )


def lists(runner):
    """The largest difference in any number of any grain at the end; 0: the same bits."""
    table = Table("spin_lists", 2, ("alpha", "turn", "difference"))
    for alpha in ALPHAS:
        for turn in TURNS:
            if table.has(f"{alpha:g}", turn):
                continue
            collisions, dt, duration, _ = setting(alpha, turn)
            collisions.write(runner.work / "spin.grains")
            ends = []
            for rebuild in ("every 1 check yes", "every 1 check no"):
                run_hits(runner, collisions, dt, duration, rebuild=rebuild)
                ends.append(read_dump(runner.work / "spin.dump")[0])
            table.add(f"{alpha:g}", turn, np.abs(ends[0] - ends[1]).max())


def law(runner):
    """What the law itself makes or takes of the energy without friction, with a tenth of the step: with the radius of
    curvature at the contact (curvatureLimitFactor 100), and with the grain's own radius (0)."""
    table = Table("spin_law", 4, ("alpha", "turn", "curvature", "target", "mean", "rms", "worst"))
    for alpha, turn, curvature in ((a, t, c) for a in ALPHAS for t in ("0.003", "0.03") for c in ("100", "0")):
        if table.has(f"{alpha:g}", turn, curvature, TARGETS[-1]):
            continue
        collisions, dt, duration, _ = setting(alpha, turn)
        collisions.write(runner.work / "spin.grains")
        run_hits(runner, collisions, dt / 10, duration, curvature=curvature)
        after = collisions.after(runner.work / "spin.dump")
        for target in TARGETS:
            energy = after[target][0][:COUNT]
            rms = math.sqrt((energy**2).mean())
            table.add(f"{alpha:g}", turn, curvature, target, energy.mean(), rms, np.abs(energy).max())


FREE_STEPS = 100_000
MOVERS = ("nve/spheroid", "nve/superquadric")


def free(runner):
    """Grains that turn at 45 degrees to their axis: the largest errors of 20 looks."""
    table = Table("spin_free", 3, ("mover", "alpha", "turn", "energy", "momentum", "axis"))
    for mover in MOVERS:
        for turn in TURNS[::2] + ("0.3",):
            if table.has(mover, f"{ALPHAS[-1]:g}", turn):
                continue
            spin = float(turn) * np.array((math.sqrt(0.5), 0, math.sqrt(0.5)))
            lines = []
            for k, alpha in enumerate(ALPHAS):
                lines += grain_lines(len(lines), 1, (0, 10 * k, 20), alpha, (1, 0, 0, 0), spin)
            (runner.work / "spin.grains").write_text("\n".join(lines) + "\n")
            every = FREE_STEPS // 20
            _, ended = runner.thermo("in.dt_spin", mover=mover, edge=50, size=3, dt=1.0, steps=FREE_STEPS, every=every)
            if not ended:
                raise SystemExit(f"{mover} failed")
            looks = snapshots(runner.work / "spin.dump")
            for k, alpha in enumerate(ALPHAS):
                table.add(mover, f"{alpha:g}", turn, *errors_of_top(looks[:, k], alpha, spin, every))


def snapshots(path):
    rows = [line.split() for line in open(path) if len(line.split()) == 14 and not line.startswith("ITEM")]
    return np.array(rows, dtype=float).reshape(-1, len(ALPHAS), 14)


def errors_of_top(looks, alpha, spin, every):
    """Relative of energy and angular momentum; of the axis in rad against its turn about the angular momentum."""
    along, across = 2 / 5, (1 + alpha**2) / 5

    def parts(omega, axis):
        share = (omega * axis).sum(axis=-1, keepdims=True) * axis
        momentum = along * share + across * (omega - share)
        return momentum, 0.5 * (omega * momentum).sum(axis=-1)

    axes = axes_of(looks[:, 10:14])
    momentum, energy = parts(looks[:, 7:10], axes)
    start, energy_0 = parts(spin, np.array((0.0, 0.0, 1.0)))
    size = np.linalg.norm(start)
    turned = every * np.arange(len(looks)) * size / across
    pole, first = start / size, np.array((0.0, 0.0, 1.0))
    upright = (first @ pole) * pole
    known = upright + np.cos(turned)[:, None] * (first - upright) + np.sin(turned)[:, None] * np.cross(pole, first)
    angle = 2 * np.arcsin(np.minimum(1, 0.5 * np.linalg.norm(axes - known, axis=1)))
    drift = np.linalg.norm(momentum - start, axis=1) / size
    return np.abs(energy / energy_0 - 1).max(), drift.max(), angle.max()


def chart(_):
    dt_spin_chart.draw()


if __name__ == "__main__":
    run_stages(sys.modules[__name__], ("hits", "lists", "law", "free", "chart"), "scratch folder")
