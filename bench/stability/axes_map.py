#!/usr/bin/python3
"""Where fix press/strain converges, oscillates and diverges with several edges under control, over its gain and its
interval, and how it holds a shear stress.

Spheres pressed to rest, and driven along z from there, each at two restitutions (in.axes_state). From each state runs
`gain auto`, and with targets for edges fixed gains in its units (`mean` and `shear ... target` take `gain auto` only).
At rest the targets are 10 % above the pressure: a step to answer. Results go to axes_cells.csv and, of longer
runs, axes_long.csv, a row per run as it ends: what is there is not run again. The line of theory is the largest root of
the sampled recursion with the K_ab and eta_ab of the state's contacts (axes_network.csv). Without a binary, chart and
tables are made of these files alone.
"""
import argparse
import itertools
import math
import pathlib

import numpy as np

from dt_tools import DENSITY, HERE, TANGENTIAL, Runner, Table, damping_ratio, read_dump
from gain_map import LARGEST_ERROR, MARKS, Line2D, autocorrelation, plt, save

CHART = HERE.parent.parent / "doc" / "images" / "stability_axes.png"
PRESSURE, RATE, SHEAR, TIME_STEP = 50.0, 1.118e-4, 10.0, 0.009  # of the driven edge I = 0.001, where fast 0.01
STEP = 1.1 * PRESSURE
RESTITUTIONS = ("0.1", "0.9")
INTERVALS = {1: 2000, 3: 2000, 10: 2000, 30: 2400, 100: 4000, 300: 7500}  # and the steps of a run
GAINS = (0.5, 1, 2, 3, 4, 6, 8)  # of the automatic one
# Oscillating: std over the target above the first where the correlation with the next input is below the second; the
# other pair is of periods of 4 to 6.
SWINGS = ((0.01, -0.1), (0.05, 0.5))
MOTIONS = {  # name -> state, motions, axes of the loops, the target that is looked at
    "three targets": ("rest", f"x target {STEP} y target {STEP} z target {STEP}", (0, 1, 2), STEP),
    "mean": ("rest", f"mean target {STEP}", "mean", STEP),
    "shear": ("rest", f"y target {PRESSURE} shear xy target {SHEAR}", None, SHEAR),
    "two targets": ("slow", f"x target {PRESSURE} y target {PRESSURE} z rate -{RATE}", (0, 1), PRESSURE),
    "two targets, fast": ("fast", f"x target {PRESSURE} y target {PRESSURE} z rate -{10 * RATE}", (0, 1), PRESSURE),
    "mean, driven": ("slow", f"mean target {PRESSURE} z rate -{RATE}", "mean", PRESSURE),
}
LONG = {  # motions and interval -> steps
    ("two targets, fast", 100): 12000,
    ("two targets, fast", 300): 15000,
    ("shear", 10): 48000,
    ("shear", 100): 48000,
}
PANELS = ("three targets", "two targets")
COLUMNS = "motions e damped interval gain kp inputs mean rms std lag1 clipped ke ended".split()
STEP_COLUMN, P_MEAN, L_X, RATE_X, S_XY, CLIPPED, KINETIC = 0, 1, 5, 6, 8, 9, 10


class Network:
    """K_ab and eta_ab of the three edges, of the contacts that in.axes_state left."""

    def __init__(self, path, e):
        rows, edges = read_dump(path)
        normal, branch, overlap = rows[:, 2:5], rows[:, 5:8], rows[:, 8]
        stiffness = 1.5 * (rows[:, 9] - rows[:, 10]) / overlap
        damping = 2 * damping_ratio(e) * np.sqrt(stiffness * 4 / 3 * math.pi * DENSITY / 2)
        along = normal[:, :, None] * normal[:, None, :]
        arms = branch[:, :, None] * branch[:, None, :] / np.linalg.det(edges)
        self.length = edges[0, 0]
        law = stiffness[:, None, None] * (along + TANGENTIAL * (np.eye(3) - along))
        self.stiffness = (arms * law).sum(0)
        self.damping = (arms * damping[:, None, None] * along).sum(0)


def loops(stiffness, damping, axes):
    """K and eta of the loops: of edges, or of the mean pressure that moves all three (or, as here, of those that it
    moves)."""
    if axes == "mean":
        return stiffness.mean(0).sum().reshape(1, 1), damping.mean(0).sum().reshape(1, 1)
    place = np.ix_(axes, axes)
    return stiffness[place], damping[place]


def automatic(stiffness, damping, time):
    """Rates per pressure of `gain auto`."""
    return 0.5 / np.abs(damping + stiffness * time).sum(1)


def largest_root(stiffness, damping, interval, gains, shares):
    """Of p' = p - K T u, w' = g (p - (K (T + dt)/2 + eta) u), b' = b + c w', u' = b + w': pressures, rates of the
    errors and, where an edge is driven, rates to go on with, of several loops."""
    time, one, zero = interval * TIME_STEP, np.eye(len(gains)), np.zeros((len(gains), len(gains)))
    late = np.diag(gains) @ (stiffness * (time + TIME_STEP) / 2 + damping)
    recursion = np.block(
        [
            [one, -stiffness * time, zero],
            [np.diag(gains), -late, one],
            [np.diag(shares * gains), -np.diag(shares) @ late, one],
        ]
    )
    return np.abs(np.linalg.eigvals(recursion if shares.any() else recursion[: -len(gains), : -len(gains)])).max()


def boundary(stiffness, damping, interval, driven):
    """Gain over the automatic one at which the largest root leaves the unit circle."""
    automatic_gains = automatic(stiffness, damping, interval * TIME_STEP)
    # b takes a tenth of the elastic share K T/D, D = 0.5 over the automatic gain
    shares = 0.2 * np.diag(stiffness) * interval * TIME_STEP * automatic_gains * driven
    low, high = 0.0, 1e3
    for _ in range(50):
        middle = 0.5 * (low + high)
        stable = largest_root(stiffness, damping, interval, middle * automatic_gains, shares) <= 1 + 1e-12
        low, high = (middle, high) if stable else (low, middle)
    return low


def automatic_gain(name, e, interval, rows):
    """Of the edge x: at rest as it was in the run, beside a driven edge, where rates are not proportional to errors,
    by the contacts of the state."""
    state, _, axes, target = MOTIONS[name]
    if axes is None:
        return math.nan
    if state != "rest":
        stiffness, damping, length = network_of(name, e)
        return automatic(stiffness, damping, interval * TIME_STEP)[0] * length
    error = rows[1:, P_MEAN] - target
    moved = np.abs(error) > 1e-6 * target
    return float(np.median((rows[1:, RATE_X] * rows[1:, L_X])[moved] / error[moved]))


def run(runner, name, e, interval, steps, **variables):
    state, motions, _, _ = MOTIONS[name]
    start = runner.work / f"axes-{e}-{state}.restart"
    return runner.thermo("in.axes_cell", state=start, e=e, motions=motions, every=interval, steps=steps, **variables)


def cell(runner, name, e, damped, interval, gain, kp):
    """One run; kp is a number, or None for `gain auto`."""
    target = MOTIONS[name][3]
    steps = INTERVALS[interval] * (3 if name == "shear" else 1)  # a shear stress comes slowly
    rows, ended = run(runner, name, e, interval, steps, gain="auto" if kp is None else repr(kp), damped=damped)
    values = [math.nan] * 8
    late = rows[len(rows) // 3 :] if len(rows) else rows
    if len(late) > 5:
        stress = late[:, S_XY if name == "shear" else P_MEAN] / target
        rms = math.sqrt(((stress - 1) ** 2).mean())
        lag = autocorrelation(stress, 1)
        swings = [stress.mean(), rms, stress.std(), lag, rows[-1, CLIPPED], rows[-1, KINETIC]]
        values = [automatic_gain(name, e, interval, rows) if kp is None else kp, len(rows) - 1, *swings]
    return *values, int(ended)


def measure(runner, table):
    for e in RESTITUTIONS:
        if not (runner.work / f"axes-{e}-slow.restart").exists():
            output = runner.output("in.axes_state", e=e, out=runner.work / f"axes-{e}")
            if "ERROR" in output:
                raise SystemExit(output[-2000:])
    networks = Table(
        "axes_network", 2, ["state", "e", "L_x", *(f"{m}_{a}{b}" for m in "Kn" for a in "xyz" for b in "xyz")]
    )
    for state, e in itertools.product(("rest", "slow", "fast"), RESTITUTIONS):
        if not networks.has(state, e):
            network = Network(runner.work / f"axes-{e}-{state}.contacts", float(e))
            networks.add(state, e, network.length, *network.stiffness.ravel(), *network.damping.ravel())
    for name, e, interval in itertools.product(MOTIONS, RESTITUTIONS, INTERVALS):
        for damped in ("off", "on") if name == "shear" else ("off",):
            key = name, e, damped, str(interval)
            for gain in ("auto", *(str(g) for g in GAINS if name in PANELS)):
                if not table.has(*key, gain):
                    kp = None if gain == "auto" else float(gain) * float(found(table, *key, "auto")["kp"])
                    table.add(*key, gain, *cell(runner, name, e, damped, interval, gain, kp))


def measure_long(runner):
    """How `gain auto` begins, where that takes longer than the cells."""
    table = Table("axes_long", 3, "motions e interval steps first_90 peak peak_at late_mean late_rms last".split())
    for (name, interval), e in itertools.product(LONG, RESTITUTIONS):
        if not table.has(name, e, interval):
            rows, _ = run(runner, name, e, interval, LONG[name, interval])
            stress = rows[:, S_XY if name == "shear" else P_MEAN] / MOTIONS[name][3]
            late = stress[len(stress) // 2 :]
            first, peak = rows[(stress > 0.9).argmax(), 0], rows[stress.argmax(), 0]
            swings = stress.max(), peak, late.mean(), math.sqrt(((late - 1) ** 2).mean()), stress[-1]
            table.add(name, e, str(interval), LONG[name, interval], first, *swings)


def found(table, *key):
    return next(row for row in table.rows if tuple(row[c] for c in table.columns[: len(key)]) == key)


def verdict(row):
    if row["ended"] != "1" or not float(row["rms"]) <= LARGEST_ERROR:
        return "diverging"
    swing, lag = float(row["std"]), float(row["lag1"])
    return "oscillating" if any(swing > least and lag < most for least, most in SWINGS) else "converged"


def network_of(name, e):
    """K and eta of the loops, and the length of the edge x."""
    rows = Table("axes_network", 2, ["state", "e"]).rows
    row = next(r for r in rows if (r["state"], r["e"]) == (MOTIONS[name][0], e))
    values = [float(value) for key, value in row.items() if key[:2] in ("K_", "n_")]
    return *loops(*np.reshape(values, (2, 3, 3)), MOTIONS[name][2]), float(row["L_x"])


def draw(table):
    figure, axes = plt.subplots(2, 2, figsize=(8.0, 6.4), constrained_layout=True, sharex=True, sharey=True)
    for axis, (name, e) in zip(axes.flat, itertools.product(PANELS, RESTITUTIONS)):
        for row in table.rows:
            if (row["motions"], row["e"]) == (name, e):
                marker, colour, size = MARKS[verdict(row)]
                height = 0.3 if row["gain"] == "auto" else float(row["gain"])
                style = dict(color=colour, markersize=size + 2, markeredgecolor="black", markeredgewidth=0.5)
                axis.plot(float(row["interval"]), height, marker, **style)
        stiffness, damping, _ = network_of(name, e)
        fine = np.unique(np.geomspace(1, 400, 60).round())
        axis.plot(
            fine, [boundary(stiffness, damping, n, name == PANELS[1]) for n in fine], color="black", linewidth=1.4
        )
        axis.axhline(1.0, color="black", linewidth=0.8, linestyle=":", zorder=0)
        axis.set(xscale="log", yscale="log", xlim=(0.7, 450), ylim=(0.22, 12))
        axis.set_xticks(list(INTERVALS), labels=[str(n) for n in INTERVALS])
        axis.set_yticks((0.3, *GAINS), labels=["auto", *(f"{g:g}" for g in GAINS)])
        axis.minorticks_off()
        title = "three targets, at rest" if name == PANELS[0] else "two targets, the third edge driven"
        axis.set_title(f"{title}, $e = {e}$", fontsize=9)
    for axis in axes[:, 0]:
        axis.set_ylabel(r"gain / gain of $\tt{auto}$")
    for axis in axes[-1]:
        axis.set_xlabel("steps between inputs")
    style = dict(linestyle="", markeredgecolor="black", markeredgewidth=0.5)
    seen = {verdict(row) for row in table.rows if row["motions"] in PANELS}
    handles = [Line2D([], [], marker=m, color=c, label=n, **style) for n, (m, c, _) in MARKS.items() if n in seen]
    handles.append(Line2D([], [], color="black", linewidth=1.4, label="largest root is 1"))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=4)
    save(figure, CHART)


def tables(table):
    print("| motions | e | interval | K T/eta | auto: run/contacts | boundary | converged up to | fails at |")
    print("|---" * 8 + "|")
    for name, e, interval in itertools.product(PANELS, RESTITUTIONS, INTERVALS):
        rows = [r for r in table.rows if (r["motions"], r["e"], r["interval"]) == (name, e, str(interval))]
        if not rows:
            continue
        stiffness, damping, length = network_of(name, e)
        time = interval * TIME_STEP
        ratio = float(rows[0]["kp"]) / (automatic(stiffness, damping, time)[0] * length)
        verdicts = {float(r["gain"]): verdict(r) for r in rows if r["gain"] != "auto"}
        bad = min((g for g, v in verdicts.items() if v != "converged"), default=math.inf)
        good = max((g for g in verdicts if g < bad), default=0.0)
        print(
            f"| {name} | {e} | {interval} | {stiffness[0, 0] * time / damping[0, 0]:.2g} | {ratio:.2f} | "
            f"{boundary(stiffness, damping, interval, name == PANELS[1]):.1f} | {good:g} | "
            f"{bad:g} {verdicts.get(bad, '')} |"
        )
    print(
        "\n| motions | e | tangential damping | interval | verdict | mean | rms | std | correlation | kinetic energy |"
    )
    print("|---" * 10 + "|")
    for row in table.rows:
        if row["gain"] == "auto":
            cells = (row[c] for c in ("motions", "e", "damped", "interval"))
            print(
                "|",
                *(f"{c} |" for c in cells),
                verdict(row),
                *(f"| {row[c]}" for c in ("mean", "rms", "std", "lag1", "ke")),
                "|",
            )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, nargs="?", help="the grainscope binary")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("axes-map"), help="folder of the runs")
    arguments = parser.parse_args()
    table = Table("axes_cells", 5, COLUMNS)
    if arguments.binary:
        runner = Runner(arguments.binary, arguments.work)
        measure(runner, table)
        measure_long(runner)
    tables(table)
    draw(table)


if __name__ == "__main__":
    main()
