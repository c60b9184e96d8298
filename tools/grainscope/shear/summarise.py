"""Summary of simple-shear runs: steady means with statistical errors, the inertial number reached, energy in against
energy out."""
import numpy as np

from grainscope.means import mean_and_error, text_of
from grainscope.shear.measures import steady_run
from grainscope.shear.output import add_run_arguments, read_run

# Column, title, factor
ROWS = [
    ("P", "pressure / target", 1),
    ("mu_eff", "effective friction", 1),
    ("phi", "solid fraction", 1),
    ("Z", "coordination", 1),
    ("sliding", "sliding contacts", 1),
    ("S2", "nematic order S2", 1),
    ("theta_x", "angle to the flow [deg]", 1),
    ("spin", "-2 omega_z / rate", 1),
    ("overlap_mean", "mean overlap / d [%]", 100),
    ("overlap_max", "largest overlap / d [%]", 100),
    ("kappa", "stiffness number", 1),
]


# Title and (mean, error) of what `measure all` adds
MEASURED = [
    ("velocity fluctuation / rate d", lambda m: m["lever"]),
    ("spin fluctuation / rate", lambda m: m["spin_fluctuation"]),
    ("rotational / transl. energy", lambda m: m["E_rot/E_tr"]),
    ("N1 / P", lambda m: m["N1"]),
    ("N2 / P", lambda m: m["N2"]),
    ("shear stress / P, tangential", lambda m: m["t_xy"]),
    ("fabric deviator", lambda m: m["fabric_deviator"]),
    ("correlation length / d", lambda m: m.means.get("l_vy", (np.nan, 0.0))),
    ("diffusion / rate d2, gradient", lambda m: m["D_y"]),
    ("diffusion / rate d2, vorticity", lambda m: m["D_z"]),
    ("grains with < 2 contacts [%]", lambda m: m["idle"]),
]


def with_error(values):
    return text_of(*mean_and_error(values))


def measured(run, start):
    """What `measure all` adds, as pairs (name, text)."""
    found = steady_run(run, start) if run.measured_all else None
    return [(title, text_of(*value(found)) if found else "-") for title, value in MEASURED]


def summary(run, start=None):
    """Pairs (name, text) of one run."""
    rows = run.steady(start)
    target = run.parameters["I"]
    reached = target / np.sqrt(run["P"][rows].mean())
    off = reached / target - 1
    cells = [
        ("grains", f"{run.parameters['N']:.0f}"),
        ("aspect ratio", f"{run.parameters['alpha']:g}"),
        ("friction coefficient", f"{run.parameters['mu']:g}"),
        ("steady state, strain", f"{run['strain'][rows][0]:.1f} to {run['strain'][-1]:.1f}"),
        ("inertial number", f"{reached:.4f} ({100 * off:+.1f} %)"),
        ("within 5 % of target", "yes" if abs(off) <= 0.05 else f"NO, target {target:g}"),
    ]
    cells += [(title, with_error(factor * run[name][rows])) for name, title, factor in ROWS]
    put_in, lost = run.injected[rows], run.dissipated[rows]
    cells += [
        ("power in: shear", with_error(run["W_shear"][rows])),
        ("power in: box", with_error(run["W_box"][rows])),
        ("power out: normal damping", with_error(run["W_n"][rows])),
        ("power out: friction", with_error(run["W_t"][rows])),
        ("friction's share of the loss", f"{100 * run['W_t'][rows].mean() / lost.mean():.1f} %"),
        ("energy out / energy in", f"{100 * lost.mean() / put_in.mean():.1f} %"),
    ]
    return cells


def add_arguments(parser):
    parser.epilog = (
        "Powers are over rate x target pressure x volume. The inertial number is that of the mean pressure. Errors: "
        "one standard deviation, by blocking."
    )
    add_run_arguments(parser)


def run(arguments):
    runs = [read_run(folder) for folder in arguments.run]
    tables = [summary(run, arguments.start) for run in runs]
    if any(run.measured_all for run in runs):
        tables = [table + measured(run, arguments.start) for table, run in zip(tables, runs)]
    print(" " * 32 + "".join(f" {run.name:>22}" for run in runs))
    for cells in zip(*tables):
        print(f"{cells[0][0]:<32}" + "".join(f" {text:>22}" for _, text in cells))
