# SPDX-License-Identifier: GPL-2.0-or-later
"""From the output of run.py's runs to the rows of results.csv."""
from dataclasses import dataclass
import math

import numpy as np

SERIES = ("strain", "P", "sigma_xy", "volume", "Z", "step_n", "step_t")
MODES = ("instantaneous_n", "instantaneous_t", "ledger_n", "ledger_t")
LEAKS = ("G_k", "G_p", "G_n", "G_open", "G_dt")
COLUMN = {
    name: number
    for number, name in enumerate(
        "step W_shear W_box W_frame W_other D_n D_t D_damp D_rolling G_k G_p G_n G_open G_dt U_n U_t K_tr K_rot "
        "residual relative".split()
    )
}
SOLID = 4 / 3 * math.pi * 500 * np.mean(np.linspace(0.8, 1.2, 15) ** 3)  # volume of the grains over alpha
BLOCKS = 8
WINDOW = 0.04  # strain, at I = 0.1
FINEST_OF_MODES = "fraction 0.05"


@dataclass
class Rows:
    """A run's rows of means; `account` holds the totals at their ends."""

    alpha: float
    rate: float
    values: dict
    account: np.ndarray

    @staticmethod
    def read(scratch, run):
        prefix = str(scratch / run.name)
        rate = np.loadtxt(f"{prefix}.times.txt")[0]
        values = dict(zip(SERIES, np.loadtxt(f"{prefix}.series.txt", ndmin=2).T[1:]))
        account = np.empty((0, len(COLUMN)))
        if run.options.get("measure") != "basic":
            values.update(zip(MODES, np.loadtxt(f"{prefix}.modes.txt", ndmin=2).T[1:]))
            account = np.loadtxt(f"{prefix}.account.txt", ndmin=2)
        rows = Rows(run.flow.alpha, rate, values, account[-len(values["P"]) :])
        return rows[1:]  # a run begins with a force evaluation that moves no spring

    def __getitem__(self, part):
        return Rows(
            self.alpha, self.rate, {name: column[part] for name, column in self.values.items()}, self.account[part]
        )

    def __len__(self):
        return len(self.values["P"])

    def until(self, strain):
        passed = self.values["strain"] - self.values["strain"][0]
        return self[: int(np.searchsorted(passed, strain * (1 - 1e-6)))]

    def blocks(self, count=BLOCKS):
        edges = np.linspace(0, len(self), count + 1).astype(int)
        return [self[a:b] for a, b in zip(edges, edges[1:])]

    def means(self):
        """What is charted: ratios of means, powers over rate x P x volume."""
        mean = {name: column.mean() for name, column in self.values.items()}
        unit = self.rate * mean["P"] * mean["volume"]
        found = {
            "mu_eff": mean["sigma_xy"] / mean["P"],
            "phi": SOLID * self.alpha / mean["volume"],
            "P": mean["P"] / (50 * min(self.alpha, 1)),
            "Z": mean["Z"],
        }
        found.update((name, mean[name] / unit) for name in ("step_n", "step_t", *MODES) if name in mean)
        if "ledger_n" in mean:
            lost = mean["ledger_n"] + mean["ledger_t"]
            for mode in ("step", "instantaneous"):
                for part in "nt":
                    found[f"{mode}_{part} - ledger_{part}"] = (mean[f"{mode}_{part}"] - mean[f"ledger_{part}"]) / lost
        if len(self.account) > 1:
            change = self.account[-1] - self.account[0]
            lost = change[COLUMN["D_n"]] + change[COLUMN["D_t"]]
            found.update((name, change[COLUMN[name]] / lost) for name in (*LEAKS, "residual"))
            found["G"] = sum(found[name] for name in LEAKS)
        return found


def with_errors(rows):
    """Mean and standard error of each quantity, the error from blocks."""
    blocks = [block.means() for block in rows.blocks()]
    return {
        name: (value, np.std([block[name] for block in blocks], ddof=1) / math.sqrt(BLOCKS))
        for name, value in rows.means().items()
    }


def grouped(runs):
    """Runs that differ in nothing but their number."""
    groups = {}
    for run in runs:
        groups.setdefault((run.flow, run.label), []).append(run)
    return groups


def is_step(label):
    return label == "default" or label.startswith("fraction")


def standard_error(values):
    return np.std(values, ddof=1) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def of_means(scratch, runs):
    """Means of single runs, with errors from blocks."""
    for run in runs:
        for name, (value, error) in with_errors(Rows.read(scratch, run)).items():
            yield run.study, run.flow, run.label, "", name, value, error


def relative_to(found, reference):
    """Errors: relative ones; those of powers over the whole dissipated power."""
    lost = reference["ledger_n"] + reference["ledger_t"]
    errors = {name: found[name] / reference[name] - 1 for name in ("mu_eff", "phi", "P")}
    errors.update((name, (found[name] - reference[name]) / lost) for name in ("ledger_n", "ledger_t"))
    return errors


def of_pairs(scratch, runs):
    """What other settings than the step change against the default, from the same start over some strain: mean and
    standard error over the starts. Runs of another step begin with a start of their own (onset.py), and are not told.
    """
    groups = {key: [Rows.read(scratch, run) for run in group] for key, group in grouped(runs).items()}
    for (flow, label), own in groups.items():
        if is_step(label):
            continue
        strain = WINDOW * flow.I / 0.1
        errors = [
            relative_to(a.until(strain).means(), b.until(strain).means()) for a, b in zip(own, groups[flow, "default"])
        ]
        for name in errors[0]:
            values = np.array([one[name] for one in errors])
            yield "paired", flow, label, strain, name, values.mean(), standard_error(values)


def of_accounts(scratch, runs):
    """Terms of the account of energy over everything dissipated: means over the starts."""
    for (flow, label), group in grouped(runs).items():
        found = [Rows.read(scratch, run).means() for run in group]
        for name in (*LEAKS, "residual"):
            values = [one[name] for one in found]
            yield "account", flow, label, "", name, np.mean(values), standard_error(values)


def of_divergence(scratch, runs, bins=25):
    """How far the shear stress of single rows is from that of the reference, root mean square over a bin of strain."""
    groups = {key: Rows.read(scratch, group[0]).values for key, group in grouped(runs).items()}
    for (flow, label), own in groups.items():
        if label != FINEST_OF_MODES:
            other = groups[flow, FINEST_OF_MODES if is_step(label) else "default"]
            apart = (own["sigma_xy"] - other["sigma_xy"]) / other["sigma_xy"].mean()
            passed = own["strain"] - own["strain"][0]
            for part in np.array_split(np.arange(len(apart)), bins):
                yield "divergence", flow, label, passed[part].mean(), "sigma_xy", math.sqrt(
                    (apart[part] ** 2).mean()
                ), math.nan


def of_sampling(scratch, run, intervals=(5, 10, 25, 50, 100, 250, 500)):
    """Relative error of the means over the whole strain: statistical, and that from sampling every so many rows only,
    root mean square over the ways to begin."""
    rows = Rows.read(scratch, run)
    strain = rows.values["strain"][-1] - rows.values["strain"][0]
    whole = with_errors(rows)
    names = ("mu_eff", "phi", "P", "step_n", "step_t")
    for name in names:
        yield "sampling", run.flow, "statistical", strain, name, whole[name][1] / whole[name][0], math.nan
    for every in intervals:
        parts = [rows[first::every].means() for first in range(0, every, max(1, every // 25))]
        for name in names:
            error = math.sqrt(np.mean([(one[name] / whole[name][0] - 1) ** 2 for one in parts]))
            yield "sampling", run.flow, f"every {every * strain / (len(rows) - 1):.3g}", strain, name, error, math.nan


def of_costs(scratch, runs):
    """Processor time per unit of strain, the quickest of the rounds, and that over the default's; the second quickest
    over the quickest tells the scatter. Steps and neighbour lists per unit of strain."""
    found = {}
    for key, group in grouped(runs).items():
        numbers = []
        for run in group:
            rate, step = np.loadtxt(scratch / f"{run.name}.times.txt")[:2]
            steps, seconds, lists = np.array((scratch / f"{run.name}.cost").read_text().split(), dtype=float)
            numbers.append(np.array([seconds, steps, lists]) / (steps * rate * step))
        found[key] = np.sort(np.array(numbers), axis=0)
    for (flow, label), numbers in found.items():
        seconds, steps, lists = numbers[0]
        over = seconds / found[flow, "default"][0, 0]
        yield "cost", flow, label, "", "relative time", over, over * (numbers[1, 0] / seconds - 1)
        yield "cost", flow, label, "", "seconds", seconds, math.nan
        yield "cost", flow, label, "", "steps", steps, math.nan
        yield "cost", flow, label, "", "lists", lists, math.nan


def of_times(scratch, runs):
    """Rayleigh's and Hertz's time of each flow, in shear times."""
    for run in runs:
        rate, _, rayleigh, hertz = np.loadtxt(scratch / f"{run.name}.times.txt")
        yield "times", run.flow, "", "", "T_R", rate * rayleigh, math.nan
        yield "times", run.flow, "", "", "T_H", rate * hertz, math.nan
