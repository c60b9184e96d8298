#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How the time step, the surface model, the integrator, the skin and the sampling of the simple shear flow trade speed
for accuracy.

    run.py build/release/bin/grainscope --scratch folder

Runs the grid below on one core, one run after the other (about 35 minutes), and writes results.csv beside this script.
What the folder holds already is not run again. chart.py draws the results.
"""
import argparse
from dataclasses import dataclass, field
import itertools
import math
import os
import pathlib
import re
import subprocess
import time

import collect


HERE = pathlib.Path(__file__).resolve().parent
DECK = HERE / "in.accuracy"
ALPHAS, FRICTIONS = (1.5, 1.0, 0.33), (0.4, 10.0, 0.0)
DEFAULT_FRACTION = 0.15
VARIANTS = {
    "superquadric": {"surface": "superquadric"},
    "nve/superquadric": {"move": "nve/superquadric"},
    "skin 0.05": {"reach": 0.05},
    "skin 0.1": {"reach": 0.1},
    "skin 0.4": {"reach": 0.4},
}


@dataclass(frozen=True)
class Flow:
    """Which flow: everything that is physics."""

    alpha: float
    mu: float
    I: float = 0.1
    e: float = 0.1

    def __str__(self):
        return f"a{self.alpha:g}_mu{self.mu:g}_I{self.I:g}_e{self.e:g}"

    @property
    def shorter_strain(self):
        """Strain in the shorter of Rayleigh's and Hertz's time, which is Rayleigh's throughout."""
        thin = min(self.alpha, 1.0)
        rayleigh = math.pi * 0.8 * thin / (0.8766 + 0.163 * 0.3) * math.sqrt(1000 * 2.6 / 5e6)
        return rayleigh * self.I * math.sqrt(0.05 * thin) / (2 * self.alpha ** (1 / 3))


@dataclass
class Run:
    study: str
    flow: Flow
    strain: float
    start: str = ""  # the run whose restart file is gone on from
    label: str = ""  # what differs from the default
    number: int = 0
    options: dict = field(default_factory=dict)

    @property
    def name(self):
        words = [self.study, str(self.flow), self.label.replace("/", "-").replace(" ", "-"), str(self.number)]
        return "_".join(word for word in words if word)


def state(flow, number=0):
    return f"state_{flow}_{number}"


def by_fraction(fractions):
    return {
        "default" if fraction == DEFAULT_FRACTION else f"fraction {fraction:g}": {"fraction": fraction}
        for fraction in fractions
    }


def is_flat(flow):
    """Flat grains take three times as many steps per strain."""
    return flow.alpha < 1


def quick_flows():
    return [Flow(alpha, mu) for mu, alpha in itertools.product(FRICTIONS, ALPHAS)]


def bouncy_flows():
    return [Flow(alpha, 0.4, e=0.9) for alpha in ALPHAS] + [Flow(1.5, 0.0, e=0.9), Flow(1.5, 10.0, e=0.9)]


def slow_flows():
    return [Flow(alpha, 0.4, 0.01) for alpha in ALPHAS]


def preparations():
    """Steady states: four of each flow at I = 0.1 and e = 0.1, half a unit of strain apart, and one of each other
    flow."""
    coarse = {"fraction": 0.3, "measure": "basic", "sample": 0.1, "repeat": 1, "block": 600}
    for flow in quick_flows():
        yield Run("state", flow, 5 if is_flat(flow) else 4, options=coarse)
        for number in range(1, 4):
            yield Run("state", flow, 0.5, state(flow, number - 1), number=number, options=coarse)
    for flow in bouncy_flows():
        yield Run("state", flow, 0.8 if is_flat(flow) else 1.5, state(Flow(flow.alpha, flow.mu)), options=coarse)
    for flow in slow_flows():
        yield Run("state", flow, 0.5 if is_flat(flow) else 1, state(Flow(flow.alpha, flow.mu)), options=coarse)
    for alpha in ALPHAS:
        yield Run("timed", Flow(alpha, 0.4), 1.5, options={**coarse, "ledger": "off"})


def mode_runs():
    """All modes of dissipation and the account of energy, in every step."""
    for flow in quick_flows() + bouncy_flows():
        for label, options in by_fraction((0.6, 0.3, 0.15, 0.05)).items():
            yield Run("modes", flow, 0.2 if is_flat(flow) else 0.5, state(flow), label, options=options)
    for label in ("superquadric", "nve/superquadric"):
        yield Run("modes", Flow(1.5, 0.4), 0.5, state(Flow(1.5, 0.4)), label, options=VARIANTS[label])
    for flow in slow_flows():
        for label, options in by_fraction((0.6, 0.3, 0.15, 0.075)).items():
            yield Run("modes", flow, 0.1 if is_flat(flow) else 0.3, state(flow), label, options=options)


def paired_runs():
    """Short runs from the same states, before chaos parts them."""
    for flow in quick_flows() + slow_flows():
        slow = flow.I < 0.1
        variants = by_fraction((0.6, 0.4, 0.3, 0.15, 0.1, 0.05, 0.02, 0.01))
        if not slow:
            variants.update((label, VARIANTS[label]) for label in ("superquadric", "nve/superquadric", "skin 0.1"))
        for number in range(1 if slow else 2 if is_flat(flow) and flow.mu != 0.4 else 3):
            for label, options in variants.items():
                yield Run("paired", flow, 0.004 if slow else 0.04, state(flow, number), label, number, options)


def sampling_runs():
    flow = Flow(1.5, 0.4)
    yield Run("sampling", flow, 6, state(flow, 1), options={"measure": "basic", "sample": 2e-4, "repeat": 1})


def timed_runs():
    """The same runs again and again in turn, measuring as the example does."""
    variants = {
        **by_fraction((0.6, 0.4, 0.3, 0.15, 0.1, 0.05)),
        **VARIANTS,
        "superquadric and nve/superquadric": {"surface": "superquadric", "move": "nve/superquadric"},
        "sample 0.1": {"sample": 0.1, "repeat": 1},
        "sample 0.01": {"sample": 0.01, "repeat": 1},
        "sample 0.0001": {"sample": 1e-4},
        "sample every step": {"sample": 0},
    }
    for number, alpha, label in itertools.product(range(4), ALPHAS, variants):
        yield Run(
            "cost",
            Flow(alpha, 0.4),
            0.05 if alpha < 1 else 0.12,
            f"timed_{Flow(alpha, 0.4)}_0",
            label,
            number,
            {"ledger": "off", "measure": "basic", "sample": 1e-3, **variants[label]},
        )


def execute(binary, scratch, run):
    """Runs the deck and leaves the cost of its last time loop in run.cost: steps, seconds of processor time, lists
    built."""
    words = {
        "out": scratch / run.name,
        "alpha": run.flow.alpha,
        "mu": run.flow.mu,
        "I": run.flow.I,
        "e": run.flow.e,
        "strain": run.strain,
        **run.options,
    }
    if run.start:
        words.update(start=1, **{"from": scratch / f"{run.start}.restart"})
    command = [str(binary), "-in", str(DECK), "-log", "none"]
    command += [str(word) for name, value in words.items() for word in ("-var", name, value)]
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    begun = time.monotonic()
    with open(scratch / f"{run.name}.log", "w+") as log:
        process = subprocess.Popen(command, cwd=scratch, env=environment, stdout=log, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        log.seek(0)
        text = log.read()
    if process.returncode or "ERROR" in text:
        raise SystemExit(f"the run failed: {' '.join(command)}\n{text[-2000:]}")
    share = min(1.0, (usage.ru_utime + usage.ru_stime) / (time.monotonic() - begun))
    loop, steps = re.findall(r"^Loop time of (\S+) on 1 procs for (\d+) steps", text, re.M)[-1]
    builds = re.findall(r"^Neighbor list builds = (\d+)", text, re.M)[-1]
    (scratch / f"{run.name}.cost").write_text(f"{steps} {float(loop) * share} {builds}\n")
    return float(loop) * share


def all_runs():
    return [*preparations(), *mode_runs(), *paired_runs(), *timed_runs(), *sampling_runs()]


HEADER = """\
# Written by run.py. Columns: study, flow (alpha, mu_p, I, e), setting, at, quantity, value, standard error (empty: none).
# times: T_R, T_H [1/rate].
# modes: means of single runs. mu_eff, phi, Z [-], P [target]; powers <mode>_n, <mode>_t [rate P volume];
#   differences of modes, G_*, residual [D_n + D_t].
# paired: difference of means over the strain `at` from the default, from the same start: mu_eff, phi, P relative;
#   ledger_n, ledger_t [D_n + D_t]; mean over the starts.
# account: G_*, residual [D_n + D_t] of the same runs.
# divergence: rms difference of the shear stress from that of step 0.05 (steps) or of the default (all else) [its mean], at the
#   strain `at` since the start.
# sampling: relative errors of means over the strain `at`.
# cost: relative time [default] of the quickest of the rounds, error: how much slower the second quickest was; processor seconds,
#   steps, neighbour lists per unit of strain.
study,alpha,mu,I,e,setting,at,quantity,value,error
"""  # noqa: E501, as it stands in the file


def number(value):
    if not isinstance(value, float):
        return str(value)
    return "" if math.isnan(value) else f"{value:.4g}"


def gather(scratch, runs):
    """results.csv, of what has been run."""
    done = {}
    for run in runs:
        if (scratch / f"{run.name}.cost").exists():
            done.setdefault(run.study, []).append(run)
    rows = itertools.chain(
        collect.of_times(scratch, [run for run in done["state"] if run.number == 0]),
        collect.of_means(scratch, done["modes"]),
        collect.of_pairs(scratch, done["paired"]),
        collect.of_accounts(scratch, done["paired"]),
        collect.of_divergence(
            scratch, [run for run in done["modes"] if (run.flow.mu, run.flow.I, run.flow.e) == (0.4, 0.1, 0.1)]
        ),
        collect.of_sampling(scratch, done["sampling"][0]),
        collect.of_costs(scratch, done["cost"]),
    )
    with open(HERE / "results.csv", "w") as out:
        out.write(HEADER)
        for study, flow, label, at, quantity, value, error in rows:
            out.write(
                ",".join(
                    [
                        study,
                        *map(number, (flow.alpha, flow.mu, flow.I, flow.e)),
                        label,
                        number(at),
                        quantity,
                        number(float(value)),
                        number(float(error)),
                    ]
                )
                + "\n"
            )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument(
        "--scratch",
        type=pathlib.Path,
        default=pathlib.Path("accuracy-runs"),
        help="folder of all runs (default %(default)s)",
    )
    arguments = parser.parse_args()
    scratch = arguments.scratch.resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    runs = all_runs()
    for count, run in enumerate(runs, 1):
        if not (scratch / f"{run.name}.cost").exists():
            seconds = execute(arguments.binary.resolve(), scratch, run)
            print(f"{count}/{len(runs)} {run.name} {seconds:.1f} s", flush=True)
    gather(scratch, runs)


if __name__ == "__main__":
    main()
