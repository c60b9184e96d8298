#!/usr/bin/python3
"""What the two methods of compute velocity/correlation cost and how far they lie apart, against the number of grains.

Points at random in a sheared box (a cube, tilt 0.3), with velocities from a random field whose C(r) is known: close to
exp(-r/0.08 L). Tables in Markdown, and a chart. Times are processor times of one rank, which other work on the machine
hardly disturbs.
"""
import argparse
from dataclasses import dataclass
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
from grainscope.columns import outputs  # noqa: E402
from grainscope.open_mpi import session  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
FIRST, BINS, TILT, LENGTH, SOLID = 2000, 19, 0.3, 0.08, 0.55
MESHES = (1, 2, 3, 4, 6)
DEFAULT_MESH = 4
INK, COLOURS = "#333333", {"direct": "#1f4e79", "mesh": "#c05a1c", "short": "#2e8b57", "fine": "#8a6fb0"}


class Field:
    """v(x) = sum a cos(k.x + phase) over waves that fit the box, with the spectrum of exp(-r/l)."""

    def __init__(self, edges, length, random, waves=1000):
        n = np.array(list(np.ndindex(25, 25, 25))) - 12
        n = n[len(n) // 2 + 1 :]  # one of each wave and its opposite
        k = 2.0 * np.pi * n @ np.linalg.inv(edges)
        weight = (1.0 + length**2 * (k**2).sum(axis=1)) ** -2
        longest = np.argsort(-weight)[:waves]
        self.k, self.weight = k[longest], weight[longest] / weight[longest].sum()
        self.phase = random.uniform(0.0, 2.0 * np.pi, waves)

    def at(self, x):
        value = np.zeros(len(x))
        for k, weight, phase in zip(self.k, self.weight, self.phase):
            value += np.sqrt(2.0 * weight) * np.cos(x @ k + phase)
        return value

    def correlation(self, r):
        """Over all positions and directions."""
        return np.sinc(np.outer(r, np.linalg.norm(self.k, axis=1)) / np.pi) @ self.weight


@dataclass
class Points:
    """In a box that grows with their number: 15 across for the first 2000."""

    count: int
    file: pathlib.Path
    size: float = 0.0
    diameter: float = 0.0
    waves: Field = None

    def __post_init__(self):
        random = np.random.default_rng(2025)
        self.size = 15.0 * (self.count / FIRST) ** (1.0 / 3.0)
        self.diameter = (6.0 * SOLID / np.pi / self.count) ** (1.0 / 3.0) * self.size
        edges = self.size * np.array([[1.0, TILT, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        self.waves = Field(edges, LENGTH * self.size, random)
        x = random.random((self.count, 3)) @ edges.T
        v = self.waves.at(x)
        number = np.arange(1, self.count + 1)
        with self.file.open("w") as out:
            out.write(f"points\n\n{self.count} atoms\n1 atom types\n")
            for axis in "xyz":
                out.write(f"0 {float(self.size)!r} {axis}lo {axis}hi\n")
            out.write(f"{float(edges[0, 1])!r} 0 0 xy xz yz\n\nAtoms\n\n")
            np.savetxt(out, np.column_stack([number, x]), f"%d 1 {self.diameter:.6g} 1000 %.17g %.17g %.17g")
            out.write("\nVelocities\n\n")
            np.savetxt(out, np.column_stack([number, v]), "%d 0 %.17g 0 0 0 0")

    def known(self, r, width):
        """Mean of the field's correlation over each bin."""
        inside = r[:, None] + width * (np.arange(41) - 20.0) / 41.0
        c = self.waves.correlation(inside.ravel()).reshape(inside.shape)
        return (c * inside**2).sum(axis=1) / (inside**2).sum(axis=1)


@dataclass
class Measured:
    seconds: float
    length: float
    r: np.ndarray
    c: np.ndarray
    pairs: np.ndarray


class Bench:
    def __init__(self, binary, folder):
        self.binary, self.folder = binary, folder
        self.environment = dict(
            os.environ,
            OMPI_ALLOW_RUN_AS_ROOT="1",
            OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
            OMPI_MCA_btl_vader_single_copy_mechanism="none",
        )

    def run(self, points, correlation, columns=("c_c",), steps=0, ranks=1):
        """Processor seconds of the run, seconds of its quickest step, and the last row of the columns."""
        launch = [] if ranks == 1 else ["mpirun", "--oversubscribe", "-np", str(ranks)]
        command = [
            *launch,
            str(self.binary),
            "-in",
            str(HERE / "in.correlation"),
            "-log",
            "none",
            "-var",
            "data",
            str(points.file),
            "-var",
            "correlation",
            correlation,
            "-var",
            "columns",
            " ".join(columns),
            "-var",
            "steps",
            str(steps),
        ]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        with session(self.environment) as environment:
            done = subprocess.run(
                command, cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
            )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        rows = [line.split() for line in done.stdout.splitlines()]
        values = np.array([row for row in rows if len(row) == len(columns) + 2 and row[0].isdigit()], dtype=float)
        if done.returncode or len(values) != steps + 1:
            raise SystemExit(f"the run failed: {' '.join(command)}\n{done.stdout}")
        processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return processor, np.diff(values[:, 1]).min(initial=np.inf), values[-1, 2:]

    def measure(self, points, options, bins=BINS):
        """On one rank, in processor time: over many steps, or once where it takes seconds. Bins are read when there are
        BINS of them."""
        own = outputs("velocity/correlation")
        names = ("r", "C", "pairs")
        cells = [own.word("c", name, k) for k in range(1, BINS + 1) for name in names] if bins == BINS else []
        correlation = f"velocity/correlation bins {bins} {options}"
        first, _, values = self.run(points, correlation, ["c_c", *cells])
        seconds = max(first - self.run(points, "nematic")[0], 1e-3)
        if seconds < 2.0:
            steps = min(200, int(3.0 / seconds) + 1)
            seconds = (self.run(points, correlation, steps=steps)[0] - first) / steps
        print(f"  {points.count} {correlation}: {seconds:.4g} s", flush=True)
        return Measured(seconds, values[0], *values[1:].reshape(-1, 3).T)

    def gain(self, points, options, steps=400):
        """How many times as fast two ranks are as one, by the quickest step of each."""
        one, two = (
            self.run(points, f"velocity/correlation {options}", steps=steps, ranks=ranks)[1] for ranks in (1, 2)
        )
        print(f"  {points.count} {options or 'direct'}: {one:.4g} s, on two ranks {two:.4g} s", flush=True)
        return one / two


def mesh_cells(mesh, bins=BINS):
    """Of a cube sheared by TILT, whose x edge has the smallest height; lengths are rounded up to products of 2, 3, 5
    and 7."""

    def fast(n):
        while True:
            rest = n
            for factor in (2, 3, 5, 7):
                while rest % factor == 0:
                    rest //= factor
            if rest == 1:
                return n
            n += 1

    across = fast(2 * bins * mesh)
    return across * fast(int(np.ceil(2 * bins * mesh * np.hypot(1.0, TILT) - 1e-6))) ** 2


def bins_as_wide(count):
    return round(BINS * (count / FIRST) ** (1.0 / 3.0))


def measure_all(bench, counts):
    """By count: name of the case -> Measured."""
    results = {}
    for count in counts:
        points = Points(count, bench.folder / "points.data")
        cases = {
            "direct": bench.measure(points, ""),
            "short": bench.measure(points, f"range {5.0 * points.diameter:.10g}"),
            "fine": bench.measure(points, "method mesh mesh 2", bins=bins_as_wide(count)),
        }
        for mesh in MESHES:
            cases[f"mesh {mesh}"] = bench.measure(points, f"method mesh mesh {mesh}")
        reference = cases["direct"]
        results[count] = cases, points.known(reference.r, 2.0 * reference.r[0]), points.size
        points.file.unlink()
    return results


def error(mesh, direct):
    return np.abs(mesh.c - direct.c).max()


def tables(results):
    print(f"\n| N | direct | direct, range 5 d | mesh {DEFAULT_MESH} | mesh 2, bins as wide at each N |")
    print("|---|---|---|---|---|")
    for count, (cases, _, _) in results.items():
        times = [cases[name] for name in ("direct", "short", f"mesh {DEFAULT_MESH}", "fine")]
        print(f"| {count} | " + " | ".join(f"{1e3 * m.seconds:.3g}" for m in times) + " |")
    print(
        "\n| mesh | cells | MB | ms | "
        + " | ".join(f"C, N = {count}" for count in results)
        + " | "
        + " | ".join(f"l, N = {count}" for count in results)
        + " |\n|"
        + "---|" * (4 + 2 * len(results))
    )
    last = results[max(results)][0]
    for mesh in MESHES:
        row = [results[count][0] for count in results]
        c = " | ".join(f"{error(cases[f'mesh {mesh}'], cases['direct']):.1e}" for cases in row)
        length = " | ".join(
            f"{100.0 * (cases[f'mesh {mesh}'].length / cases['direct'].length - 1.0):+.2f} %" for cases in row
        )
        print(
            f"| {mesh} | {mesh_cells(mesh):.2g} | {8e-6 * mesh_cells(mesh):.2g} | "
            f"{1e3 * last[f'mesh {mesh}'].seconds:.3g} | {c} | {length} |"
        )
    print("\n| N | direct from the field's own C(r) | l/L direct |\n|---|---|---|")
    for count, (cases, known, size) in results.items():
        used = cases["direct"].pairs > 0
        print(
            f"| {count} | {np.abs(cases['direct'].c - known)[used].max():.1e} | {cases['direct'].length / size:.4f} |"
        )


def chart(results, file):
    plt.rcParams.update(
        {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": INK, "text.color": INK}
    )
    figure, (time, accuracy, curve) = plt.subplots(1, 3, figsize=(12.5, 4.2), layout="constrained")
    counts = np.array(list(results))

    def series(axes, values, label, colour, **style):
        axes.loglog(counts, values, marker="o", color=colour, label=label, markersize=4, **style)

    def seconds(case):
        return [results[count][0][case].seconds for count in counts]

    series(time, seconds("direct"), "direct", COLOURS["direct"])
    series(time, seconds("short"), "direct, range 5 diameters", COLOURS["short"])
    series(time, seconds(f"mesh {DEFAULT_MESH}"), f"mesh {DEFAULT_MESH}", COLOURS["mesh"])
    series(time, seconds("fine"), "mesh 2, bins as wide at each N", COLOURS["fine"])
    time.set(xlabel="grains N", ylabel="processor time of one measurement [s]", title="Cost, 19 bins to half the box")
    time.legend(frameon=False)

    for mesh, strength in zip(MESHES, np.linspace(0.3, 1.0, len(MESHES))):
        series(
            accuracy,
            [error(results[count][0][f"mesh {mesh}"], results[count][0]["direct"]) for count in counts],
            f"mesh {mesh}",
            COLOURS["mesh"],
            alpha=strength,
        )
        last = results[counts[-1]][0]
        accuracy.annotate(
            f"mesh {mesh}",
            (counts[-1], error(last[f"mesh {mesh}"], last["direct"])),
            (6, -3),
            textcoords="offset points",
        )
    accuracy.set(
        xlabel="grains N",
        ylabel="largest |C of mesh - C of direct|",
        title="Accuracy of the mesh",
        xlim=(None, 2.5 * counts[-1]),
    )

    shown = max(count for count in counts if count <= 64000)
    cases, known, size = results[shown]
    used = cases["direct"].pairs > 0
    r = cases["direct"].r / size
    curve.plot(r[used], known[used], color=INK, linewidth=1, label="the field's own")
    curve.plot(
        r[used],
        cases["direct"].c[used],
        "o",
        color=COLOURS["direct"],
        markersize=6,
        markerfacecolor="white",
        label="direct",
    )
    curve.plot(
        r[used],
        cases[f"mesh {DEFAULT_MESH}"].c[used],
        "x",
        color=COLOURS["mesh"],
        markersize=5,
        label=f"mesh {DEFAULT_MESH}",
    )
    curve.set(xlabel="r / L", ylabel="C(r)", title=f"C(r), N = {shown}")
    curve.legend(frameon=False)
    figure.savefig(file, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument(
        "--counts", type=int, nargs="+", default=[2000, 8000, 32000, 64000, 128000, 256000], help="numbers of points"
    )
    parser.add_argument(
        "--chart", type=pathlib.Path, default=HERE.parent / "doc" / "images" / "correlation_methods.png"
    )
    parser.add_argument("--ranks", action="store_true", help="only how much faster two ranks are, in wall time")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(arguments.binary.resolve(), pathlib.Path(name))
        if arguments.ranks:
            points = Points(
                FIRST, bench.folder / "points.data"
            )  # milliseconds, which other work leaves whole now and then
            for options in ("", "method mesh mesh 2"):
                print(f"{options or 'direct'}: two ranks are {bench.gain(points, options):.2f} times as fast")
            return
        results = measure_all(bench, sorted(arguments.counts))
    tables(results)
    chart(results, arguments.chart)


if __name__ == "__main__":
    main()
