#!/usr/bin/python3
"""What compute field costs when it is asked in every step: instructions, counted by callgrind, and with --time
nanoseconds of processor time, medians of alternating runs, over the same run without it. All quantities, kernel cell, spheres on a lattice
in contact (3 contacts per grain) and apart: what these two differ by is the contacts'. A Markdown table.
"""
import argparse
import pathlib
import re
import resource
import statistics
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
GRIDS = ("1 10 1", "10 10 1", "40 40 40")
QUANTITIES = (
    "density phi momentum velocity spin temperature stress stress_normal stress_tangential stress_kinetic "
    "traction contacts coordination fabric P_n P_t overlap Q S2 director"
)
SPACINGS = {"contact": 1.96, "apart": 2.05}
CONTACTS = 3  # per grain of the lattice in contact
STEPS = {10: 800, 20: 100}  # of timed runs; a tenth of them with many cells


class Bench:
    def __init__(self, binary, folder):
        self.binary, self.folder = binary, folder

    def run(self, edge, spacing, grid, steps, prefix=(), quantities=QUANTITIES):
        deck = self.folder / "observers"
        asked = f"compute f all field grid {grid} quantities {quantities}\n" if grid else ""
        deck.write_text(asked + ("fix f all field/write 1 1000000 1000000 c_f file f.csv\n" if grid else ""))
        variables = {"edge": edge, "spacing": spacing, "steps": steps, "observers": deck}
        words = [word for name, value in variables.items() for word in ("-var", name, str(value))]
        command = [*prefix, str(self.binary), "-in", str(HERE / "in.field"), "-log", "none", *words]
        result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, errors="replace")
        if result.returncode:
            raise SystemExit(f"the run failed: {' '.join(command)}\n{result.stdout}{result.stderr}")
        return result

    def instructions(self, edge, spacing, grid):
        """Per step, from runs of 2 and 4 steps: what is once per run drops out."""
        counts = []
        for steps in (2, 4):
            prefix = [
                "valgrind",
                "--tool=callgrind",
                f"--callgrind-out-file={self.folder / 'callgrind.out'}",
                "--collect-atstart=no",
                "--toggle-collect=LAMMPS_NS::Verlet::run(int)",
            ]
            counts.append(int(re.search(r"Collected : (\d+)", self.run(edge, spacing, grid, steps, prefix).stderr)[1]))
        return (counts[1] - counts[0]) / 2

    def seconds(self, edge, spacing, grid, steps):
        """Of processor time: others on the machine do not count."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.run(edge, spacing, grid, steps)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def nanoseconds(self, edge, spacing, grid):
        """Per step, without the start of the program."""
        few, many = 1, STEPS[edge] // (10 if grid == GRIDS[-1] else 1)
        start = self.seconds(edge, spacing, grid, few)
        return 1e9 * (self.seconds(edge, spacing, grid, many) - start) / (many - few)


def measured(ask, edge, repeats):
    """Over no sampling, per step, by spacing and grid: medians of alternating runs."""
    found = {}
    for _ in range(repeats):
        for name, spacing in SPACINGS.items():
            idle = ask(edge, spacing, None)
            found.setdefault((name, "idle"), []).append(idle)
            for grid in GRIDS:
                found.setdefault((name, grid), []).append(ask(edge, spacing, grid) - idle)
    return {key: statistics.median(values) for key, values in found.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("--time", action="store_true", help="nanoseconds of processor time instead of instructions")
    parser.add_argument("--repeats", type=int, default=5, help="runs per case with --time (default %(default)s)")
    arguments = parser.parse_args()
    unit = "ns" if arguments.time else "instructions"
    print(f"| N | grid | per grain [{unit}] | per contact | a step without, per grain |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(arguments.binary.resolve(), pathlib.Path(name))
        for edge in STEPS:
            ask = bench.nanoseconds if arguments.time else bench.instructions
            found = measured(ask, edge, arguments.repeats if arguments.time else 1)
            for grid in GRIDS:
                grain = found["apart", grid] / edge**3
                contact = (found["contact", grid] / edge**3 - grain) / CONTACTS
                idle = found["contact", "idle"] / edge**3
                print(f"| {edge**3} | {grid} | {grain:.0f} | {contact:.0f} | {idle:.0f} |", flush=True)


if __name__ == "__main__":
    main()
