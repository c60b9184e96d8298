#!/usr/bin/python3
"""How fast the same dense sheared packing runs with each surface model, pair style and integrator: a Markdown table.

The packing of in.dense, tiled to the number of grains asked for, is sheared on at constant volume. Times are those of
LIGGGHTS's time loop, of runs that alternate between the cases. On one rank: medians, of times multiplied by the share
of a processor that the run had (other work on the machine then matters little); the gain is the median of the gains
over the first case, round by round. On more ranks, which wait for each other: the quickest run; this wants a quiet
machine. With --count instructions per step by callgrind instead (repeatable; needs valgrind). With --compare lammps
the spheres (alpha = 1) run in LAMMPS too, with contacts as stiff and as damped (README.md).
"""
import argparse
from dataclasses import dataclass
import functools
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
from grainscope.open_mpi import session  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
TILE = 2000
LIMITS = "tangential_damping off gaussianCurvature yes curvatureLimitFactor 100"
# atom style, pair style, surface model, integrator
CASES = {
    "gran": ("superquadric", "gran", f"superquadric {LIMITS}", "nve/superquadric"),
    "insitu": ("superquadric", "gran/insitu", f"superquadric {LIMITS}", "nve/superquadric"),
    "ellipsoid": ("superquadric", "gran/insitu", f"ellipsoid {LIMITS}", "nve/superquadric"),
    "ellipsoid+spheroid": ("superquadric", "gran/insitu", f"ellipsoid {LIMITS}", "nve/spheroid"),
    "gran+ellipsoid": ("superquadric", "gran", f"ellipsoid {LIMITS}", "nve/superquadric"),
    "spheres": ("sphere", "gran/insitu", "default tangential_damping off", "nve/sphere"),
}
LAMMPS = "lammps"
SPHERES = ("spheres", LAMMPS)
COLUMNS = (
    "alpha",
    "N",
    "ranks",
    "skin",
    "case",
    "ms per step",
    "gain",
    "pair",
    "neighbour",
    "communication",
    "rest",
    "rebuilds",
    "listed per grain",
    "MB",
)
PARTS = ("Pair", "Neigh", "Comm")


@dataclass
class Packing:
    """A tile of in.dense, as its dump tells it."""

    alpha: float
    box: np.ndarray  # lengths along x, y, z
    tilt: float
    grains: np.ndarray  # x y z vx vy vz omegax omegay omegaz quaternion

    @staticmethod
    def read(dump, alpha):
        lines = dump.read_text().splitlines()
        bounds = np.array([line.split() for line in lines[5:8]], dtype=float)
        tilt = bounds[0, 2]
        box = bounds[:, 1] - bounds[:, 0] - np.array([abs(tilt), 0.0, 0.0])
        grains = np.array([line.split() for line in lines[9:]], dtype=float)[:, 1:]
        return Packing(alpha, box, tilt, grains)

    def write(self, count, spheres, data, turn):
        """`count` grains as a data file, and set commands for what a data file cannot hold. Copies of a grain have
        successive numbers."""
        copies = round((count / len(self.grains)) ** (1.0 / 3.0))
        total = copies**3
        if total * len(self.grains) != count:
            raise SystemExit(f"{count} grains are not a cube of tiles of {len(self.grains)}")
        rate = 0.1 * math.sqrt(0.05 * min(self.alpha, 1.0)) / (2.0 * self.alpha ** (1.0 / 3.0))
        first = np.arange(len(self.grains)) * total + 1
        edges = np.array([[self.box[0], 0.0, 0.0], [self.tilt, self.box[1], 0.0], [0.0, 0.0, self.box[2]]])
        atoms, velocities = [], []
        for number, place in enumerate(np.ndindex(copies, copies, copies)):
            shift = np.array(place) - 0.5 * (copies - 1)
            x = self.grains[:, :3] + shift @ edges
            v = self.grains[:, 3:6] + [rate * self.box[1] * shift[1], 0.0, 0.0]
            atoms.append(np.column_stack([first + number, x]))
            velocities.append(np.column_stack([first + number, v, self.grains[:, 6:9]]))
        shape = "1 2 1000" if spheres else f"1 1000 1 1 {self.alpha} 2 2"
        half = 0.5 * copies * self.box
        with data.open("w") as out:
            out.write(f"{copies} x {copies} x {copies} tiles\n\n{count} atoms\n1 atom types\n")
            for axis, edge in zip("xyz", half):
                out.write(f"{float(-edge)!r} {float(edge)!r} {axis}lo {axis}hi\n")
            out.write(f"{float(copies * self.tilt)!r} 0 0 xy xz yz\n\nAtoms\n\n")
            np.savetxt(out, np.vstack(atoms), f"%d {shape} %.15g %.15g %.15g")
            out.write("\nVelocities\n\n")
            np.savetxt(out, np.vstack(velocities), "%d" + " %.8g" * 6)
        with turn.open("w") as out:
            for number, grain in zip(first, self.grains) if not spheres else ():
                out.write(
                    f"set atom {number}*{number + total - 1} quat_direct "
                    + " ".join(repr(float(q)) for q in grain[9:13])
                    + " omegax {:.8g} omegay {:.8g} omegaz {:.8g}\n".format(*grain[6:9])
                )


@dataclass
class Result:
    step: float  # seconds
    parts: list  # seconds per step: PARTS and the rest
    rebuilds: int
    neighbours: float  # per grain
    memory: float  # bytes, of the largest process


class Bench:
    def __init__(self, binary, lammps, folder, states):
        self.binary, self.lammps, self.folder, self.states = binary, lammps, folder, states
        self.environment = dict(
            os.environ,
            OMPI_ALLOW_RUN_AS_ROOT="1",
            OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
            OMPI_MCA_btl_vader_single_copy_mechanism="none",
            OMPI_MCA_hwloc_base_binding_policy="none",
        )

    def execute(self, command):
        """Standard output and error together, the memory of the largest process in bytes, and the share of a processor
        that the process had whenever it could run: the start of MPI waits for other things."""
        with tempfile.TemporaryFile("w+") as text, session(self.environment) as environment:
            process = subprocess.Popen(command, cwd=self.folder, env=environment, stdout=text, stderr=subprocess.STDOUT)
            os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
            ran, queued, _ = map(int, pathlib.Path(f"/proc/{process.pid}/schedstat").read_text().split())
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            text.seek(0)
            output = text.read()
        if process.returncode:
            raise SystemExit(f"the run failed: {' '.join(command)}\n{output[-3000:]}")
        return output, usage.ru_maxrss * 1024.0, ran / (ran + queued)

    def packing(self, alpha):
        dump = self.states / f"dense_{alpha:g}.restart.dump"
        if not dump.exists():
            self.execute(
                [
                    str(self.binary),
                    "-in",
                    str(HERE / "in.dense"),
                    "-log",
                    "none",
                    "-var",
                    "alpha",
                    f"{alpha:g}",
                    "-var",
                    "strain",
                    "2",
                    "-var",
                    "out",
                    str(dump.with_suffix("")),
                ]
            )
        return Packing.read(dump, alpha)

    def prepare(self, packing, count, case):
        spheres = case in SPHERES
        data = self.folder / f"{'spheres' if spheres else 'grains'}_{packing.alpha:g}_{count}.data"
        turn = data.with_suffix(".turn")
        if not data.exists():
            packing.write(count, spheres, data, turn)
        return data, turn

    def deck(self, packing, count, case, settle, steps, reach):
        data, turn = self.prepare(packing, count, case)
        values = {"data": data, "reach": reach, "settle": settle, "steps": steps}
        if case == LAMMPS:
            program, script = self.lammps, "in.lammps"
        else:
            program, script = self.binary, "in.speed"
            values.update(zip(("grains", "pair", "surface", "move"), CASES[case]), turn=turn, alpha=packing.alpha)
        return [str(program), "-in", str(HERE / script), "-log", "none"] + [
            str(word) for name, value in values.items() for word in ("-var", name, value)
        ]

    def run(self, deck, ranks, steps):
        """The last run of a deck, which has so many steps."""
        launch = [] if ranks == 1 else ["mpirun", "--oversubscribe", "-np", str(ranks)]
        output, memory, share = self.execute([*launch, *deck])
        output = output[output.rindex("Loop time of") :]
        scale = (share if ranks == 1 else 1.0) / steps

        def seconds(pattern):
            return float(re.search(pattern, output, re.M)[1]) * scale

        step = seconds(r"^Loop time of (\S+)")
        # LIGGGHTS: "Pair  time (%) = 0.2 (75)"; LAMMPS: "Pair    | 0.2 | 0.2 | 0.2 |", least, mean and most
        parts = [seconds(rf"^{part} *(?:time \(%\) =|\| *\S+ *\|) *(\S+)") for part in PARTS]
        return Result(
            step,
            [*parts, step - sum(parts)],
            int(re.search(r"^Neighbor list builds = (\d+)", output, re.M)[1]),
            float(re.search(r"^Ave neighs/atom = (\S+)", output, re.M)[1]),
            memory,
        )

    def count(self, deck_of, steps):
        """Instructions per step, of steps that follow as many others: of deck_of(steps) less those of deck_of(0)."""

        def collected(steps_after):
            valgrind = [
                "valgrind",
                "--tool=callgrind",
                f"--callgrind-out-file={self.profile(steps_after)}",
                "--collect-atstart=no",
                "--toggle-collect=LAMMPS_NS::Verlet::run(int)",
            ]
            output, _, _ = self.execute([*valgrind, *deck_of(steps_after)])
            return int(re.search(r"Collected : (\d+)", output)[1])

        return (collected(steps) - collected(0)) / steps

    def profile(self, steps):
        """Of callgrind, when so many steps were counted."""
        return self.folder / f"callgrind.{steps}"


def steps_for(count):
    return max(150, min(1000, 4_000_000 // count))


def cases_for(arguments, alpha):
    cases = arguments.cases + ([LAMMPS] if arguments.compare else [])
    return [case for case in cases if case not in SPHERES or alpha == 1.0]


def take_time(bench, arguments):
    print(f"{arguments.repeats} rounds, ms per step\n")
    print("| " + " | ".join(COLUMNS) + " |\n" + "|---" * len(COLUMNS) + "|")
    for alpha in arguments.alpha:
        packing = bench.packing(alpha)
        for count in arguments.grains:
            steps = arguments.steps or steps_for(count)
            for ranks in arguments.ranks:
                runs = [(reach, case) for reach in arguments.skin for case in cases_for(arguments, alpha)]
                results = {run: [] for run in runs}
                for _ in range(arguments.repeats):
                    for run in runs:
                        deck = bench.deck(packing, count, run[1], max(20, steps // 5), steps, run[0])
                        results[run].append(bench.run(deck, ranks, steps))
                if ranks > 1:
                    results = {run: [min(result, key=lambda one: one.step)] for run, result in results.items()}
                for (reach, case), result in results.items():
                    gain = statistics.median(first.step / one.step for first, one in zip(results[runs[0]], result))
                    whole = 1e3 * statistics.median(one.step for one in result)
                    parts = " | ".join(
                        f"{1e3 * statistics.median(part):.3f}" for part in zip(*(one.parts for one in result))
                    )
                    print(
                        f"| {alpha:g} | {count:,} | {ranks} | {reach:g} | {case} | {whole:.3f} | {gain:.2f} | {parts} "
                        f"| {result[0].rebuilds} in {steps} | {result[0].neighbours:.2f} "
                        f"| {1e-6 * result[0].memory:.0f} |",
                        flush=True,
                    )


def count_instructions(bench, arguments):
    print("| alpha | N | case | instructions per step | gain |\n|---|---|---|---|---|")
    for alpha in arguments.alpha:
        packing = bench.packing(alpha)
        for count in arguments.grains:
            first = None
            for case in cases_for(arguments, alpha):
                steps = arguments.steps or 20
                deck_of = functools.partial(bench.deck, packing, count, case, steps, reach=arguments.skin[0])
                number = bench.count(deck_of, steps)
                first = first or number
                print(f"| {alpha:g} | {count:,} | {case} | {number:.4g} | {first / number:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument(
        "--alpha",
        type=float,
        nargs="+",
        default=[0.33, 0.67, 1.0, 1.5, 3.0],
        help="aspect ratios (default %(default)s)",
    )
    parser.add_argument(
        "--grains", type=int, nargs="+", default=[TILE], help="2000, 16000, 128000, ... (default %(default)s)"
    )
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2], help="MPI ranks (default %(default)s)")
    parser.add_argument(
        "--skin", type=float, nargs="+", default=[0.2], help="skin over the longest semi-axis (default %(default)s)"
    )
    parser.add_argument(
        "--cases",
        nargs="+",
        choices=CASES,
        default=list(CASES),
        metavar="case",
        help="of %(choices)s; gains are relative to the first (default: all)",
    )
    parser.add_argument("--compare", choices=[LAMMPS], help="a further case: spheres in LAMMPS (program lmp)")
    parser.add_argument("--repeats", type=int, default=5, help="rounds (default %(default)s)")
    parser.add_argument("--steps", type=int, help="steps of each run (default: 1000 for 2000 grains, fewer for more)")
    parser.add_argument("--count", action="store_true", help="instructions per step instead of time, on one rank")
    parser.add_argument(
        "--states", type=pathlib.Path, help="folder that keeps the packings (a new one takes 2 to 15 minutes)"
    )
    arguments = parser.parse_args()
    lammps = shutil.which("lmp")
    if arguments.compare and not lammps:
        parser.error("--compare lammps needs LAMMPS's program lmp, which is not here (Debian: apt-get install lammps)")
    if arguments.compare and 1.0 not in arguments.alpha:
        parser.error("--compare lammps compares spheres, but 1 is not among --alpha")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        states = (arguments.states or folder).resolve()
        states.mkdir(parents=True, exist_ok=True)
        bench = Bench(arguments.binary.resolve(), lammps, folder, states)
        if arguments.count:
            count_instructions(bench, arguments)
        else:
            take_time(bench, arguments)


if __name__ == "__main__":
    main()
