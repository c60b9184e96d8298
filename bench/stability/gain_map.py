#!/usr/bin/python3
"""Where the pressure control of fix press/strain converges, oscillates and diverges, over its gain, its interval and
the inertial number.

Steady states come from examples/simple_shear. From each of them runs `gain auto`, a box that is held (gain 0) and fixed
gains, at several intervals between inputs, with `limit` and `maxrate` so wide that the clip holds nothing; then `gain
auto` from the dilute start, with the defaults. Results go to gain_cells.csv and gain_dilute.csv beside this file, a row
per run as it ends: what is there already is not run again. A chart and Markdown tables are made of the two files alone.
The slowest flow is asked for on its own: --inertial 0.001 --alpha 1.5.
"""
import argparse
import csv
import itertools
import math
import os
import pathlib
import re
import subprocess
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from grainscope.figures.style import RUN_COLOURS, plt, save  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

DECK = ROOT / "examples" / "simple_shear" / "in.simple_shear"
CHART = ROOT / "doc" / "images" / "stability_gain.png"
CELL_FILE, START_FILE = HERE / "gain_cells.csv", HERE / "gain_dilute.csv"
INERTIAL = {0.1: 3.0, 0.03: 2.5, 0.01: 2.0, 0.001: 0.7}  # and the strain after which its state counts as steady
ALPHAS = (1.0, 1.5)
GAINS = (0.03, 0.1, 0.3, 1.0, 1.5, 2.0, 2.5, 3.5, 5.0, 7.0, 10.0)  # of the automatic one
CROWDED = (1.5, 2.5)  # gains without a label
INTERVALS = (0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)  # of 1e-3 I^(1/3)
FEW = {0.001: ((1.0, 2.0, 5.0), (0.3, 1.0, 2.5, 5.0, 10.0))}  # intervals and gains where steps are many
STARTS = {
    0.1: (0.2, 1.0, 20.0),
    0.03: (0.2, 1.0, 20.0),
    0.01: (1.0, 20.0),
    0.001: (1.0,),
}  # intervals of the dilute starts
INPUTS, SKIPPED = 60, 15  # of a run at least, and of them those that are left out
LEAST_STRAIN = 0.8  # of a run, over the root of I
CLOSE = 1.1  # the edge is known when two gains are as near as this
CLIPS = {"wide": "limit 0.3 maxrate {:g}", "default": ""}
LARGEST_ERROR = 1.0  # root mean square of P/P_t - 1: contacts open all over
ALTERNATING = -0.5  # correlation of an error with the next: the swings are the controller's own, not the flow's
MARKS = {"converged": ("o", "white", 3), "oscillating": ("s", RUN_COLOURS[5], 5), "diverging": ("X", RUN_COLOURS[1], 6)}
KEY = ("inertial", "alpha", "interval", "gain", "clip")
CELL_COLUMNS = (
    "inertial",
    "alpha",
    "interval",
    "steps",
    "gain",
    "clip",
    "kp",
    "inputs",
    "mean",
    "rms",
    "least",
    "largest",
    "lag1",
    "lag2",
    "clipped",
    "length_least",
    "length_largest",
    "resistance",
    "rate",
    "dt",
    "target",
    "ended",
)
START_COLUMNS = (
    "inertial",
    "alpha",
    "interval",
    "strain",
    "mean",
    "std",
    "largest",
    "phi",
    "inputs",
    "clipped",
    "clipped_until",
)

CELL = """
atom_style   superquadric
atom_modify  map array
boundary     p p p
newton       off
communicate  single vel yes
units        si
read_restart {restart}
neighbor     {skin:g} bin
neigh_modify delay 0 contact_distance_factor 1.05
fix          young all property/global youngsModulus peratomtype 5e6
fix          poisson all property/global poissonsRatio peratomtype 0.3
fix          restitution all property/global coefficientRestitution peratomtypepair 1 0.1
fix          friction all property/global coefficientFriction peratomtypepair 1 0.4
pair_style   gran/insitu model hertz tangential history surface ellipsoid tangential_damping off gaussianCurvature yes &
             curvatureLimitFactor 100
pair_coeff   * *
timestep     {dt!r}
fix          move all nve/spheroid
fix          press all press/strain axis y target {target!r} shear xy rate {rate!r} every/step {steps} &
             gain {gain} {clip}
outputs      press
thermo_style custom step f_press v_press_target v_press_L v_press_L_rate v_press_clipped
thermo_modify format float %.12g flush yes
thermo       {steps}
reset_timestep 0
run          {length}
"""


class Bench:
    def __init__(self, binary, grains, folder):
        self.binary, self.grains, self.folder = binary.resolve(), grains, folder
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")

    def run(self, deck, folder, seconds=600, **variables):
        """Whether the run ended well."""
        folder.mkdir(parents=True, exist_ok=True)
        command = [
            str(self.binary),
            "-in",
            str(deck),
            "-log",
            "none",
            *(word for name, value in variables.items() for word in ("-var", name, str(value))),
        ]
        with (folder / "screen").open("w") as screen:
            try:
                return (
                    subprocess.run(
                        command,
                        cwd=folder,
                        env=self.environment,
                        stdout=screen,
                        stderr=subprocess.STDOUT,
                        timeout=seconds,
                    ).returncode
                    == 0
                )
            except subprocess.TimeoutExpired:
                return False

    def start(self, inertial, alpha, interval=1.0):
        """Folder of a run from the dilute start to the steady state, with `gain auto` and defaults."""
        folder = self.folder / f"start_I{inertial:g}_alpha{alpha:g}_every{interval:g}"
        if not (folder / "out" / "final.restart").exists():
            folder.mkdir(parents=True, exist_ok=True)
            text, line = DECK.read_text(), "variable every  equal 1e-3*$I^(1/3)"
            if line not in text:
                raise SystemExit(f"{DECK.name} does not set its interval as this script expects")
            (folder / "in.start").write_text(
                text.replace(line, f"variable every  equal {interval!r}*1e-3*$I^(1/3)").replace(
                    "c_order c_solver", "c_order c_solver v_press_inputs v_press_clipped"
                )
            )
            if not self.run(
                "in.start", folder, out="out", N=self.grains, I=inertial, alpha=alpha, strain=INERTIAL[inertial]
            ):
                raise SystemExit(f"the run in {folder} failed")
        return folder


def parameters(folder):
    """What in.simple_shear wrote of itself."""
    names, values = [line.split() for line in (folder / "out" / "parameters.txt").read_text().splitlines()]
    return {name.split("[")[0]: float(value) for name, value in zip(names[1:], values)}


def inputs_of(screen):
    """Rows of step, averaged pressure, target, length, velocity, clipped, as far as the run came."""
    rows = []
    for line in screen.read_text().splitlines():
        words = line.split()
        if len(words) == 6 and words[0].isdigit():
            try:
                rows.append([float(word) for word in words])
            except ValueError:
                continue
    return np.array(rows)


def autocorrelation(x, lag):
    x = x - x.mean()
    square = float((x * x).sum())
    return float((x[lag:] * x[:-lag]).sum()) / square if square > 0 else 0.0


def cell(bench, inertial, alpha, interval, gain, clip, kp):
    """One run from the steady state; kp is a number, or None for `gain auto`."""
    folder = bench.start(inertial, alpha)
    its = parameters(folder)
    rate, dt, target = its["rate"], its["dt"], its["P_target"]
    steps = max(1, round(interval * 1e-3 * inertial ** (1 / 3) / (rate * dt)))
    count = max(INPUTS, math.ceil(LEAST_STRAIN * math.sqrt(inertial) / (rate * dt * steps)))
    work = bench.folder / "cell"
    work.mkdir(exist_ok=True)
    (work / "in.cell").write_text(
        CELL.format(
            restart=folder / "out" / "final.restart",
            skin=0.2 * max(alpha, 1.0),
            dt=dt,
            target=target,
            rate=rate,
            steps=steps,
            gain="auto" if kp is None else repr(kp),
            clip=CLIPS[clip].format(1e4 * rate),
            length=steps * count,
        )
    )
    ended = bench.run("in.cell", work)
    rows = inputs_of(work / "screen")
    if not len(rows):
        raise SystemExit(f"the run in {work} did not start")
    late = rows[rows[:, 0] > SKIPPED * steps]
    row = dict(
        inertial=inertial,
        alpha=alpha,
        interval=interval,
        steps=steps,
        gain=gain,
        clip=clip,
        kp=kp,
        inputs=len(rows) - 1,
        rate=rate,
        dt=dt,
        target=target,
        ended=int(ended),
    )
    if len(late) > 5:
        pressure = late[:, 1] / target
        row.update(
            mean=pressure.mean(),
            rms=math.sqrt(((pressure - 1) ** 2).mean()),
            least=pressure.min(),
            largest=pressure.max(),
            lag1=autocorrelation(pressure, 1),
            lag2=autocorrelation(pressure, 2),
            clipped=rows[-1, 5] - rows[0, 5],
            length_least=rows[:, 3].min() / rows[0, 3],
            length_largest=rows[:, 3].max() / rows[0, 3],
        )
        if kp is None:  # eta + K T, from L/2 over kp = v/(P - P_t)
            moved = late[late[:, 4] != 0]
            row["resistance"] = float(np.median(0.5 * moved[:, 3] * (moved[:, 1] - target) / moved[:, 4]))
            row["kp"] = float(np.median(moved[:, 4] / (moved[:, 1] - target)))
    return row


def read(file):
    """Rows of a results file, numbers as numbers."""
    if not file.exists():
        return []
    with file.open() as text:
        return [
            {
                name: value if name in ("gain", "clip") else float(value) if value else None
                for name, value in row.items()
            }
            for row in csv.DictReader(text)
        ]


def append(file, row, columns):
    new = not file.exists()
    with file.open("a", newline="") as text:
        writer = csv.DictWriter(text, columns, lineterminator="\n")
        if new:
            writer.writeheader()
        writer.writerow({name: f"{value:.6g}" if isinstance(value, float) else value for name, value in row.items()})


def cells_of(inertial, alpha):
    """(interval, gain, clip): all intervals and gains with the wide clip, and the default clip at the paper's
    interval."""
    intervals, gains = FEW.get(inertial, (INTERVALS, GAINS))
    gains = tuple(f"{gain:g}" for gain in gains)
    for interval in intervals:
        for gain in ("auto", "0", *gains):
            yield inertial, alpha, interval, gain, "wide"
    for gain in gains[gains.index("1") :]:
        yield inertial, alpha, 1.0, gain, "default"


def edge(rows, interval):
    """Largest gain up to which the control converges at an interval, and the least that does not."""
    held = held_errors(rows)[interval]
    verdicts = {
        float(row["gain"]): verdict(row, held)
        for row in rows
        if row["interval"] == interval and row["clip"] == "wide" and row["gain"] not in ("auto", "0")
    }
    bad = min((gain for gain, found in verdicts.items() if found != "converged"), default=math.inf)
    return max((gain for gain in verdicts if gain < bad), default=0.0), bad


def measure(bench, inertials, alphas):
    """Runs every cell that is not in the file yet, and more gains between the last that converges and the first that
    does not. Gains are in units of that of `gain auto` at the same place."""
    done = {tuple(row[name] for name in KEY): row for row in read(CELL_FILE)}
    for inertial, alpha in itertools.product(inertials, alphas):
        for key in cells_of(inertial, alpha):
            if key not in done:
                run_cell(bench, key, done)
        for interval in FEW.get(inertial, (INTERVALS,))[0]:
            while True:
                good, bad = edge([row for key, row in done.items() if key[:2] == (inertial, alpha)], interval)
                if good == 0.0 or not CLOSE * good < bad < math.inf:
                    break
                run_cell(bench, (inertial, alpha, interval, f"{math.sqrt(good * bad):.3g}", "wide"), done)


def run_cell(bench, key, done):
    inertial, alpha, interval, gain, clip = key
    kp = None if gain == "auto" else float(gain) * done[inertial, alpha, interval, "auto", "wide"]["kp"]
    row = done[key] = cell(bench, *key, kp)
    append(CELL_FILE, row, CELL_COLUMNS)
    print(*key, *(f"{name} {row.get(name)}" for name in ("rms", "lag1", "lag2", "clipped", "ended")), flush=True)


def dilute(bench, inertials, alphas):
    """`gain auto` from the dilute start, with the defaults: how its pressure is in the last quarter of the strain."""
    done = {(row["inertial"], row["alpha"], row["interval"]) for row in read(START_FILE)}
    for inertial, alpha, interval in ((i, a, interval) for i in inertials for a in alphas for interval in STARTS[i]):
        if (inertial, alpha, interval) in done:
            continue
        folder = bench.start(inertial, alpha, interval)
        series = np.loadtxt(folder / "out" / "series.txt")
        late = series[series[:, 1] > 0.75 * INERTIAL[inertial]]
        row = dict(
            inertial=inertial,
            alpha=alpha,
            interval=interval,
            strain=INERTIAL[inertial],
            mean=late[:, 2].mean(),
            std=late[:, 2].std(),
            largest=series[:, 2].max(),
            phi=late[:, 5].mean(),
            **clips_of(folder / "screen"),
        )
        append(START_FILE, row, START_COLUMNS)
        print(row, flush=True)


def clips_of(screen):
    """Inputs and clipped ones in all, and the strain after which none is clipped, from the last two columns of the
    thermo output."""
    rows = [
        line.split() for line in screen.read_text().splitlines() if re.fullmatch(r"\s*\d+( +[-\d.e+]+){9,}\s*", line)
    ]
    table = np.array([[float(row[1]), float(row[-2]), float(row[-1])] for row in rows])
    return dict(
        inputs=table[-1, 1], clipped=table[-1, 2], clipped_until=table[table[:, 2] < table[-1, 2], 0].max(initial=0.0)
    )


def network(rows):
    """Damping eta and stiffness K of the contacts, from what `gain auto` took at each interval: eta + K T, fitted."""
    automatic = [row for row in rows if row["gain"] == "auto"]
    resistance = np.array([row["resistance"] for row in automatic])
    design = np.array([[1.0, row["steps"] * row["dt"]] for row in automatic])
    return np.linalg.lstsq(design / resistance[:, None], np.ones(len(automatic)), rcond=None)[0]


def boundary(eta, stiffness, interval, dt):
    """Largest stable gain over the automatic one, by the Jury criterion on the sampled recursion with `interval` in
    whole steps of dt."""
    automatic = 0.5 / (eta + stiffness * interval)  # kp/L
    alternation = eta - 0.5 * stiffness * dt
    overshoot = 0.5 * stiffness * (interval + dt) - eta
    return np.minimum(1.0 / np.maximum(alternation, 1e-300), 1.0 / np.maximum(overshoot, 1e-300)) / automatic


def verdict(row, held):
    """Of a run, against the rms error of the box that is held: a weak gain lets the pressure go as far as that one
    does."""
    if not row["ended"] or row["rms"] > max(LARGEST_ERROR, held):
        return "diverging"
    return "oscillating" if row["lag1"] < ALTERNATING else "converged"


def held_errors(rows):
    """Interval -> rms error in the held box, of the rows of one flow."""
    return {row["interval"]: row["rms"] for row in rows if row["gain"] == "0"}


def panel(axes, rows):
    """The map of one flow: its cells by what they leave of the held box's error, verdicts as marks, and the
    boundary."""
    wide = {(row["interval"], row["gain"]): row for row in rows if row["clip"] == "wide"}
    held = held_errors(rows)
    for interval in INTERVALS:
        for gain in ("auto", *(f"{g:g}" for g in GAINS)):
            row = wide.get((interval, gain))
            if row is None:
                continue
            height = 0.016 if gain == "auto" else float(gain)
            rms = row["rms"] if row["ended"] else np.inf
            left = min(rms / held[interval], 1e3)
            image = axes.scatter(
                interval, height, marker="s", s=215, c=[left], cmap="YlGnBu", norm=LogNorm(0.1, 1.0), linewidths=0
            )
            marker, colour, size = MARKS[verdict(row, held[interval])]
            axes.plot(
                interval, height, marker, color=colour, markersize=size, markeredgecolor="black", markeredgewidth=0.4
            )
    eta, stiffness = network(rows)
    one = rows[0]
    fine = np.geomspace(0.15, 27.0, 200)
    time = fine * 1e-3 * one["inertial"] ** (1 / 3) / one["rate"]
    axes.plot(fine, boundary(eta, stiffness, time, one["dt"]), color="black", linewidth=1.5)
    edges = [(interval, math.sqrt(math.prod(edge(rows, interval)))) for interval in held]
    axes.plot(
        *zip(*[point for point in edges if point[1] < math.inf]), color=RUN_COLOURS[3], linewidth=1.5, linestyle="--"
    )
    axes.axhline(1.0, color="black", linewidth=0.8, linestyle=":", zorder=0)
    axes.set(xscale="log", yscale="log", xlim=(0.13, 30.0), ylim=(0.011, 14.0))
    axes.set_xticks(INTERVALS, labels=[f"{x:g}" for x in INTERVALS])
    axes.set_yticks((0.016, *GAINS), labels=["auto", *(f"{g:g}" if g not in CROWDED else "" for g in GAINS)])
    axes.minorticks_off()
    axes.set_title(
        rf"$I = {one['inertial']:g}$, $\alpha = {one['alpha']:g}$:  $\eta\dot\gamma = "
        rf"{eta * one['rate'] / one['target']:.2g}\,P_t$,"
        rf" $K = {stiffness / one['target']:.0f}\,P_t$",
        fontsize=9,
    )
    return image


def draw(rows):
    flows = sorted({(row["alpha"], -row["inertial"]) for row in rows})
    columns = sorted({inertial for _, inertial in flows})
    figure, axes = plt.subplots(
        len(ALPHAS),
        len(columns),
        figsize=(4.1 * len(columns) + 0.8, 4.1 * len(ALPHAS)),
        constrained_layout=True,
        sharex=True,
        sharey=True,
        squeeze=False,
    )
    for (line, alpha), (place, inertial) in itertools.product(enumerate(ALPHAS), enumerate(columns)):
        found = [row for row in rows if row["alpha"] == alpha and row["inertial"] == -inertial]
        if found:
            image = panel(axes[line, place], found)
        else:
            axes[line, place].set_visible(False)
    for axis in axes[:, 0]:
        axis.set_ylabel(r"gain / gain of $\tt{auto}$")
    for axis in axes[-1]:
        axis.set_xlabel(r"interval / $10^{-3} I^{1/3}$")
    figure.colorbar(image, ax=axes, shrink=0.6, extend="max", label="rms error of the pressure / that in a held box")
    handles = [
        Line2D(
            [], [], linestyle="", marker=marker, color=colour, markeredgecolor="black", markeredgewidth=0.4, label=name
        )
        for name, (marker, colour, _) in MARKS.items()
    ]
    handles.append(Line2D([], [], color="black", linewidth=1.5, label="boundary of the linear loop (Jury)"))
    handles.append(Line2D([], [], color=RUN_COLOURS[3], linewidth=1.5, linestyle="--", label="edge that was found"))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=5)
    save(figure, CHART)


def boundary_table(flows):
    """Where the boundary is and what was found; returns the cells of `gain auto` that did not converge."""
    outside = []
    print(
        "| I | alpha | interval | steps | K T/eta | boundary | largest converged | least not converged | auto: "
        "rms | held box: rms |"
    )
    print("|---" * 10 + "|")
    for (inertial, alpha), rows in flows.items():
        eta, stiffness = network(rows)
        held = held_errors(rows)
        for automatic in (row for row in rows if row["gain"] == "auto"):
            interval, time = automatic["interval"], automatic["steps"] * automatic["dt"]
            good, bad = edge(rows, interval)
            print(
                f"| {inertial:g} | {alpha:g} | {interval:g} | {automatic['steps']:.0f} | {stiffness * time / eta:.2g} "
                f"| {boundary(eta, stiffness, time, automatic['dt']):.1f} | {good:g} | {bad:g} | "
                f"{automatic['rms']:.3f} | {held[interval]:.2f} |"
            )
            if verdict(automatic, held[interval]) != "converged":
                outside.append((inertial, alpha, interval))
    return outside


def tables(rows, starts):
    flows = {
        key: [row for row in rows if (row["inertial"], row["alpha"]) == key]
        for key in sorted({(row["inertial"], row["alpha"]) for row in rows}, reverse=True)
    }
    outside = boundary_table(flows)
    print("\n| I | alpha | gain, default clip | verdict | rms | inputs clipped |\n|---|---|---|---|---|---|")
    for (inertial, alpha), found in flows.items():
        for row in found:
            if row["clip"] == "default":
                print(
                    f"| {inertial:g} | {alpha:g} | {row['gain']} | {verdict(row, held_errors(found)[1.0])} | "
                    f"{row['rms']:.2f} "
                    f"| {row['clipped'] / row['inputs']:.0%} |"
                )
    print(
        "\n| I | alpha | interval | strain | mean P/P_t | std | largest | clipped until strain "
        "|\n|---|---|---|---|---|---|---|---|"
    )
    for row in starts:
        print(
            f"| {row['inertial']:g} | {row['alpha']:g} | {row['interval']:g} | {row['strain']:g} | "
            f"{row['mean']:.3f} | {row['std']:.3f} "
            f"| {row['largest']:.2f} | {row['clipped_until']:.2f} |"
        )
    print(f"\ngain auto: {sum(row['gain'] == 'auto' for row in rows)} cells, not converged: {outside or 'none'}")
    far = [
        (row["inertial"], row["alpha"], row["interval"])
        for row in starts
        if math.hypot(row["mean"] - 1, row["std"]) > LARGEST_ERROR
    ]
    print(f"dilute starts: {len(starts)}, rms above {LARGEST_ERROR:g}: {far or 'none'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "binary", type=pathlib.Path, nargs="?", help="the grainscope binary; without it, what the files hold is drawn"
    )
    parser.add_argument("--inertial", type=float, nargs="+", default=[0.1, 0.03, 0.01], choices=list(INERTIAL))
    parser.add_argument("--alpha", type=float, nargs="+", default=list(ALPHAS), choices=list(ALPHAS))
    parser.add_argument("--grains", type=int, default=400)
    parser.add_argument(
        "--work", type=pathlib.Path, default=pathlib.Path("gain-map"), help="folder of the runs (default %(default)s)"
    )
    arguments = parser.parse_args()
    if arguments.binary:
        bench = Bench(arguments.binary, arguments.grains, arguments.work.resolve())
        measure(bench, arguments.inertial, arguments.alpha)
        dilute(bench, arguments.inertial, arguments.alpha)
    rows, starts = read(CELL_FILE), read(START_FILE)
    tables(rows, starts)
    draw(rows)


if __name__ == "__main__":
    main()
