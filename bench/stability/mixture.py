#!/usr/bin/python3
"""Small spheres among large ones in a shear flow, by time level and time step: mixture.csv, and the table of
doc/stability_data.md. Goes on where it was stopped; ten minutes for 1 : 5, an hour for 1 : 10.

    bench/stability/mixture.py build/release/bin/grainscope
"""
import sys

import numpy as np

import dt_tools
from dt_tools import HERE, Runner, Table

sys.path.insert(0, str(HERE.parents[1] / "tools"))
from grainscope.means import mean_and_error, text_of  # noqa: E402

# ratio of sizes, coefficient of friction, time step over Rayleigh's time, strain
FLOWS = (("5", "0.5", "0.15", 6.0), ("5", "1", "0.15", 6.0), ("5", "1", "0.03", 2.3), ("10", "1", "0.15", 3.0))
LEVELS = ("host", "synchronized")
SETTLES = 1.0  # strain from which on a flow is measured; the state that it begins from has another
STEADY = ("mu_eff", "P", "phi", "Z", "rattlers", "Z_small", "sliding_small", "held_small", "spin_held")
ENERGIES = ("D_n", "D_t", "G_k", "G_p", "G_open", "G_dt", "residual")
COLUMNS = ("ratio", "mu", "T", "level", *(word for name in (*STEADY, *ENERGIES) for word in (name, f"{name}_error")))


def measured(path):
    """Means and errors, by name. Energies are over the work of shear and pressure."""
    names = ("step", *STEADY, "W_shear", "D_n", "D_t", "G_k", "G_p", "G_open", "G_dt", "residual", "W_box")
    table = dict(zip(names, np.loadtxt(path).T))
    table["spin_held"] = table["spin_held"] / table["held_small"]  # from a mean over all small grains
    first = round(SETTLES / 0.005)
    found = {name: mean_and_error(table[name][first:]) for name in STEADY}
    work = np.diff(table["W_shear"] + table["W_box"])[first:].mean()
    found.update((name, mean_and_error(np.diff(table[name])[first:] / work)) for name in ENERGIES)
    return found


def state_of(runner, ratio, mu):
    """The restart file that flows begin from."""
    state = runner.work / f"mixture-{ratio}-{mu}.restart"
    if not state.exists():
        run(runner, ratio=ratio, mu=mu, state=state, table="/dev/null")
    return state


def run(runner, **variables):
    output = runner.output("in.mixture", **variables)
    if "Loop time" not in output or "ERROR" in output:
        raise SystemExit(output[-2000:])


def flows(runner):
    table = Table("mixture", 4, COLUMNS)
    for ratio, mu, step, strain in FLOWS:
        for level in LEVELS:
            if table.has(ratio, mu, step, level):
                continue
            path = runner.work / f"mixture-{ratio}-{mu}-{step}-{level}.txt"
            if not path.exists():
                part = path.with_suffix(".part")
                state = state_of(runner, ratio, mu)
                run(runner, ratio=ratio, mu=mu, T=step, level=level, strain=strain, state=state, table=part, goes_on=1)
                part.rename(path)
            found = measured(path).values()
            table.add(ratio, mu, step, level, *(number for pair in found for number in pair))
    show(table.rows)


def show(rows):
    names = ("mu_eff", "phi", "Z", "rattlers", "Z_small", "held_small", "spin_held", "D_n", "D_t", "G_p")
    print("\n| ratio | mu | dt/T_R | level | " + " | ".join(names) + " |\n" + "|---" * (4 + len(names)) + "|")
    for row in rows:
        values = [text_of(float(row[name]), float(row[f"{name}_error"])) for name in names]
        print("| " + " | ".join([row["ratio"], row["mu"], row["T"], row["level"], *values]) + " |")


if __name__ == "__main__":
    Runner.PATIENCE = 14400
    dt_tools.run_stages(sys.modules[__name__], ("flows",), "of restart files and tables")
