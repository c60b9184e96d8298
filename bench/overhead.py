#!/usr/bin/python3
"""What pair_style gran/insitu costs, idle, with each measurement in every step, and with all of them at the paper's
sampling rate, over pair_style gran; with --surface ellipsoid, over gran/insitu without measurements, as pair_style gran
has no such loop.

On one dense sheared packing (N = 2000, alpha = 1.5, mu_p = 0.4, I = 0.1), in LIGGGHTS's time loop only, as a Markdown
table: instructions per step counted by callgrind (repeatable, whatever else the machine does; needs valgrind), or with
--time the wall time, also per contact, as medians of alternating runs (wants a quiet machine).
"""
import argparse
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))
from grainscope.columns import outputs  # noqa: E402

EVERY_STEP = "fix mean all ave/time 1 1 1 {value} file /dev/null\n"
STRAIN = "variable strain equal 0.00977*0.009*step\n"
OBSERVERS = {
    "gran/insitu, idle": "",
    "stress/contact": "compute observer all stress/contact\n"
    + EVERY_STEP.format(value=outputs("stress/contact").word("observer", "P")),
    "dissipation mode step": "compute observer all dissipation\n" + EVERY_STEP.format(value="c_observer"),
    "dissipation mode instantaneous": "compute observer all dissipation mode instantaneous\n"
    + EVERY_STEP.format(value="c_observer"),
    "contact/local overlap fn": "compute observer all contact/local overlap fn\ncompute largest all reduce max "
    + outputs("contact/local", ("overlap", "fn")).word("observer", "overlap")
    + "\n"
    + EVERY_STEP.format(value="c_largest"),
    "nematic": "compute observer all nematic\n" + EVERY_STEP.format(value="c_observer"),
    "fabric": "compute observer all fabric\n" + EVERY_STEP.format(value="c_observer"),
    "fabric with weighted tensors": "compute observer all fabric branch force/normal force/tangential\n"
    + EVERY_STEP.format(value="c_observer"),
    "contact/surface": "compute observer all contact/surface\n" + EVERY_STEP.format(value="c_observer mode vector"),
    "contact/direction": "compute observer all contact/direction\n" + EVERY_STEP.format(value="c_observer mode vector"),
    "contact/grain": "compute observer all contact/grain\ncompute largest all reduce max "
    + outputs("contact/grain").word("observer", "N_c")
    + "\n"
    + EVERY_STEP.format(value="c_largest"),
    "fluctuation": "compute observer all fluctuation\n" + EVERY_STEP.format(value="c_observer"),
    "displacement/shear": STRAIN
    + "compute observer all displacement/shear strain v_strain\n"
    + EVERY_STEP.format(value="c_observer"),
    "velocity/memory": STRAIN
    + "compute observer all velocity/memory strain v_strain every 8.8e-5\n"
    + EVERY_STEP.format(value="c_observer"),
    "velocity/correlation, direct": "compute observer all velocity/correlation\n"
    + EVERY_STEP.format(value="c_observer"),
    "velocity/correlation, mesh": "compute observer all velocity/correlation method mesh\n"
    + EVERY_STEP.format(value="c_observer"),
    "layering": "compute observer all layering\n" + EVERY_STEP.format(value="c_observer"),
    "stress/contact + dissipation + nematic": "compute a all stress/contact\ncompute b all dissipation\ncompute "
    "c all nematic\n" + EVERY_STEP.format(value="c_a c_b c_c"),
    "fix press/strain, gain auto": "fix press all press/strain axis y target 50 shear xy rate 0.00977 every 4.6e-4\n",
    "fix deform (the host's)": "fix press all deform 1 xy erate 0.00977 remap v\n",
}
# Everything that examples/simple_shear measures, 100 times per unit strain: once in this many steps.
PAPER_INTERVAL = 114
PAPER = (
    STRAIN
    + """compute a all stress/contact
compute b all dissipation
compute c all nematic
compute d all fabric
compute e all contact/surface
compute f all contact/direction
compute g all contact/grain
compute h all fluctuation
compute i all displacement/shear strain v_strain
compute j all velocity/memory strain v_strain
compute k all velocity/correlation component vy
compute l all velocity/correlation component wz
compute m all layering
"""
    + f"compute n all reduce max {outputs('contact/grain').word('g', 'N_c')}\n"
    + "".join(
        f"fix {name} all ave/time {PAPER_INTERVAL} 1 {PAPER_INTERVAL} {value} file /dev/null\n"
        for name, value in (
            ("scalars", "c_a c_b c_c c_d c_h c_i c_n"),
            ("surface", "c_e mode vector"),
            ("direction", "c_f mode vector"),
            ("memory", "c_j mode vector"),
            ("linear", "c_k mode vector"),
            ("spin", "c_l mode vector"),
            ("layers", "c_m mode vector"),
        )
    )
)
# fix press/strain along stress paths, over the host's fix deform. Not named as in in.dense: its state is not taken up.
PATHS = {
    "fix deform (the host's)": OBSERVERS["fix deform (the host's)"],
    "one edge by target, one shear": "fix path all press/strain axis y target 50 shear xy rate 0.00977 every 4.6e-4\n",
    "three edges by targets": "fix path all press/strain x target 50 y target 50 z target 50 every/step 5\n",
    "three edges by targets, two shears": "fix path all press/strain x target 50 y target 50 z target 50 "
    "shear xy rate 0.00977 shear xz rate 0.005 every 4.6e-4\n",
}
# of --surface: variables of the decks, and the pair style that others are compared with
SURFACES = {
    "superquadric": ({}, "gran"),
    "ellipsoid": ({"surface": "ellipsoid", "move": "nve/spheroid"}, "gran/insitu"),
}
SETTINGS = "tangential_damping off gaussianCurvature yes curvatureLimitFactor 100"
LEDGER = {  # with `ledger on`, which wants a restart file of its own
    "ledger on, idle": "",
    "ledger on, energy/ledger": "compute observer all energy/ledger\n"
    + EVERY_STEP.format(value=outputs("energy/ledger").word("observer", "residual")),
}
CONTACTS = (
    "compute count all stress/contact\n" f"thermo_style custom step {outputs('stress/contact').word('count', 'N_c')}\n"
)


class Bench:
    def __init__(self, binary, state, folder, settings=SETTINGS, **variables):
        self.binary, self.state, self.folder, self.settings = binary, state, folder, settings
        self.variables = variables

    def with_ledger(self):
        """The same packing, prepared with `ledger on`."""
        settings = "ledger on " + SETTINGS
        state = prepare(self.binary, self.folder, settings, **self.variables)
        return Bench(self.binary, state, self.folder, settings, **self.variables)

    def run(self, pair, observers, steps, prefix=()):
        deck = self.folder / "observers"
        deck.write_text(observers)
        command = [
            *prefix,
            str(self.binary),
            "-in",
            str(HERE / "in.overhead"),
            "-log",
            "none",
            "-var",
            "state",
            str(self.state),
            "-var",
            "pair",
            pair,
            "-var",
            "steps",
            str(steps),
            "-var",
            "observers",
            str(deck),
            "-var",
            "settings",
            self.settings,
            *variable_words(self.variables),
        ]
        result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, errors="replace")
        if result.returncode:
            raise SystemExit(f"the run failed: {' '.join(command)}\n{result.stdout}{result.stderr}")
        return result

    def instructions(self, pair, observers, steps):
        """Per step."""
        valgrind = [
            "valgrind",
            "--tool=callgrind",
            f"--callgrind-out-file={self.folder / 'callgrind.out'}",
            "--collect-atstart=no",
            "--toggle-collect=LAMMPS_NS::Verlet::run(int)",
        ]
        count = int(re.search(r"Collected : (\d+)", self.run(pair, observers, steps, valgrind).stderr)[1])
        if count == 0:
            raise SystemExit("callgrind counted nothing: is the binary stripped?")
        return count / steps

    def seconds(self, pair, observers, steps):
        """Per step."""
        return float(re.search(r"Loop time of (\S+)", self.run(pair, observers, steps).stdout)[1]) / steps

    def contacts(self):
        return float(
            re.search(r"^\s*0\s+(\S+)", self.run("gran/insitu", CONTACTS + "reset_timestep 0\n", 0).stdout, re.M)[1]
        )


def variable_words(variables):
    return [word for name, value in variables.items() for word in ("-var", name, str(value))]


def prepare(binary, folder, settings=SETTINGS, **variables):
    """The dense packing's restart file."""
    state = folder / f"dense-{len(settings)}.restart"
    subprocess.run(
        [
            str(binary),
            "-in",
            str(HERE / "in.dense"),
            "-var",
            "out",
            str(state),
            "-var",
            "settings",
            settings,
            "-log",
            "none",
            *variable_words(variables),
        ],
        cwd=folder,
        check=True,
        stdout=subprocess.DEVNULL,
    )
    return state


def begin_table(base, pair):
    print(
        f"| case | instructions per step | over {pair} |\n|---|---|---|\n| pair_style {pair} | {base:.5g} | |",
        flush=True,
    )


def count_instructions(bench, steps, pair):
    """Over `pair` without measurements."""
    base = bench.instructions(pair, "", steps)
    begin_table(base, pair)
    ledger = bench.with_ledger()
    for label, observers in {**OBSERVERS, **LEDGER}.items():
        count = (ledger if label in LEDGER else bench).instructions("gran/insitu", observers, steps)
        print(f"| {label} | {count:.4g} | {100 * (count / base - 1):+.2f} % |", flush=True)


def count_paths(binary, state, folder, steps):
    """On 600 grains, surface ellipsoid. A binary that knows one edge only ends at the third path."""
    variables, _ = SURFACES["ellipsoid"]
    state = state or prepare(binary, folder, N=600, **variables)
    bench = Bench(binary, state, folder, **variables)
    print("| case | instructions per step | over fix deform |\n|---|---|---|")
    base = None
    for label, motions in PATHS.items():
        count = bench.instructions("gran/insitu", motions, steps)
        base = base or count
        print(f"| {label} | {count:.5g} | {100 * (count / base - 1):+.2f} % |", flush=True)


def count_whole_set(bench, pair):
    """Over two intervals, with one sample in each."""
    steps = 2 * PAPER_INTERVAL
    base = bench.instructions(pair, "", steps)
    begin_table(base, pair)
    for label, observers in {"gran/insitu, idle": "", f"the whole set, once in {PAPER_INTERVAL} steps": PAPER}.items():
        count = bench.instructions("gran/insitu", observers, steps)
        print(f"| {label} | {count:.5g} | {100 * (count / base - 1):+.2f} % |", flush=True)


def take_time(bench, steps, repeats):
    contacts = bench.contacts()
    ledger = bench.with_ledger()
    cases = {**OBSERVERS, **LEDGER}
    times = {label: [] for label in ("pair_style gran", *cases)}
    for _ in range(repeats):
        times["pair_style gran"].append(bench.seconds("gran", "", steps))
        for label, observers in cases.items():
            times[label].append((ledger if label in LEDGER else bench).seconds("gran/insitu", observers, steps))
    base = statistics.median(times["pair_style gran"])
    print(
        f"{contacts:.0f} contacts, medians of {repeats} runs of {steps} steps\n\n| case | ms per step | over "
        "gran | ns per contact |\n|---|---|---|---|"
    )
    for label, values in times.items():
        time = statistics.median(values)
        print(
            f"| {label} | {1e3 * time:.3f} | {100 * (time / base - 1):+.1f} % | {1e9 * (time - base) / contacts:.0f} |"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("--time", action="store_true", help="wall time instead of instructions")
    parser.add_argument(
        "--paper",
        action="store_true",
        help="instructions of all measurements together at the paper's sampling rate (10 minutes)",
    )
    parser.add_argument("--paths", action="store_true", help="instructions of fix press/strain along stress paths")
    parser.add_argument(
        "--surface",
        choices=SURFACES,
        default="superquadric",
        help="surface model, of ellipsoid under fix nve/spheroid (default %(default)s; not with --time)",
    )
    parser.add_argument("--repeats", type=int, default=9, help="runs per case with --time (default %(default)s)")
    parser.add_argument(
        "--state", type=pathlib.Path, help="restart file of bench/in.dense (made when not given: a minute)"
    )
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        binary, state = arguments.binary.resolve(), arguments.state and arguments.state.resolve()
        if arguments.paths:
            count_paths(binary, state, folder, 40)
            return
        variables, pair = SURFACES[arguments.surface]
        bench = Bench(binary, state or prepare(binary, folder, **variables), folder, **variables)
        if arguments.paper:
            count_whole_set(bench, pair)
        elif arguments.time:
            take_time(bench, 100, arguments.repeats)
        else:
            count_instructions(bench, 20, pair)


if __name__ == "__main__":
    main()
