#!/usr/bin/python3
"""Instructions per step of pair_style gran/insitu, idle and with each observer every step, against pair_style gran.

Counts instructions with callgrind (repeatable, whatever else the machine does) in LIGGGHTS's time loop only, on one dense sheared
packing (N = 2000, alpha = 1.5, mu_p = 0.4, I = 0.1); prints a Markdown table. Needs valgrind.
"""
import argparse
import pathlib
import re
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
EVERY_STEP = "fix mean all ave/time 1 1 1 {value} file /dev/null\n"
OBSERVERS = {
    "stress/contact": "compute observer all stress/contact\n" + EVERY_STEP.format(value="c_observer[26]"),
    "dissipation mode step": "compute observer all dissipation\n" + EVERY_STEP.format(value="c_observer"),
    "dissipation mode instantaneous": "compute observer all dissipation mode instantaneous\n" + EVERY_STEP.format(value="c_observer"),
    "contact/local overlap fn": "compute observer all contact/local overlap fn\ncompute largest all reduce max c_observer[1]\n"
                                + EVERY_STEP.format(value="c_largest"),
    "nematic": "compute observer all nematic\n" + EVERY_STEP.format(value="c_observer"),
    "stress/contact + dissipation + nematic": "compute a all stress/contact\ncompute b all dissipation\ncompute c all nematic\n"
                                              + EVERY_STEP.format(value="c_a c_b c_c"),
    "fix press/strain, gain auto": "fix press all press/strain axis y target 50 shear xy rate 0.00977 every 4.6e-4\n",
    "fix deform (the host's)": "fix press all deform 1 xy erate 0.00977 remap v\n",
}


def instructions(binary, state, steps, pair, observers, folder):
    deck = folder / "observers"
    deck.write_text(observers)
    output = folder / "callgrind.out"
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={output}", "--collect-atstart=no",
               "--toggle-collect=LAMMPS_NS::Verlet::run(int)", str(binary), "-in", str(HERE / "in.overhead"), "-screen", "none",
               "-log", "none", "-var", "state", str(state), "-var", "pair", pair, "-var", "steps", str(steps),
               "-var", "observers", str(deck)]
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    found = re.search(r"Collected : (\d+)", result.stderr)
    if result.returncode or not found or int(found[1]) == 0:
        raise SystemExit(f"the run failed: {' '.join(command)}\n{result.stdout}{result.stderr}")
    return int(found[1]) / steps


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("--steps", type=int, default=20, help="steps to count (default %(default)s)")
    parser.add_argument("--state", type=pathlib.Path, help="restart file of bench/in.dense (made when not given: a minute)")
    arguments = parser.parse_args()
    binary = arguments.binary.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        state = arguments.state and arguments.state.resolve()
        if not state:
            state = folder / "dense.restart"
            subprocess.run([str(binary), "-in", str(HERE / "in.dense"), "-var", "out", str(state), "-log", "none"], cwd=folder,
                           check=True, stdout=subprocess.DEVNULL)
        base = instructions(binary, state, arguments.steps, "gran", "", folder)
        print("| case | instructions per step | over gran |\n|---|---|---|")
        print(f"| pair_style gran | {base:.4g} | |", flush=True)
        for label, observers in [("gran/insitu, idle", "")] + list(OBSERVERS.items()):
            count = instructions(binary, state, arguments.steps, "gran/insitu", observers, folder)
            print(f"| {label} | {count:.4g} | {100 * (count / base - 1):+.2f} % |", flush=True)


if __name__ == "__main__":
    main()
