"""What a grid of steady runs tells together: fits over the inertial number and the shape, and where friction and normal
damping dissipate equally."""

from dataclasses import dataclass

import numpy as np

from grainscope.fits import FitError, crossing, fit_fraction_law, fit_friction_law, power_law
from grainscope.progress import progress

FEWEST = 4  # runs over the inertial number for the laws of Eqs. 5 and 6; power laws take three
ROUND = 1.2  # shapes rounder than this are beyond the crossover of Fig. 4 and left out of its power laws


@dataclass
class Crossover:
    """A point with P_t = P_n. sliding_above: friction dissipates more at a larger mu (the left branch of Fig. 3)."""

    alpha: float
    mu: float
    mu_error: float
    I: float
    I_error: float
    sliding_above: bool


@dataclass
class Fitted:
    """A fitted parameter; what it is of by alpha, mu, I (nan: over all of them)."""

    fit: str
    parameter: str
    value: float
    error: float
    points: int
    alpha: float = np.nan
    mu: float = np.nan
    I: float = np.nan


def select(runs, over, **fixed):
    """The runs with the fixed parameters, in ascending order of another."""
    return sorted(
        (run for run in runs if all(run.parameters[name] == value for name, value in fixed.items())),
        key=lambda run: run.parameters[over],
    )


def values(runs, name):
    return sorted({run.parameters[name] for run in runs})


def ratio_of(run, kind):
    """P_t/P_n and its error; kind: W (over steps), or instant (Eq. 4 of the paper)."""
    (normal, normal_error), (friction, friction_error) = run[f"{kind}_n"], run[f"{kind}_t"]
    ratio = friction / normal
    return ratio, abs(ratio) * np.hypot(normal_error / normal, friction_error / friction)


def kinds(runs):
    """The definitions of the powers that all runs have: W (over steps), and instant (Eq. 4) with measure all."""
    return [kind for kind in ("W", "instant") if all(f"{kind}_n" in run.means for run in runs)]


def crossovers(runs, kind="W"):
    """Points with P_t = P_n, between neighbouring runs of the grid, by interpolation in the logarithms: those between
    neighbours in mu at each I, and between neighbours in I at each mu."""
    found = []
    for alpha in values(runs, "alpha"):
        for inertial in values(runs, "I"):
            line = [
                run for run in select(runs, "mu", alpha=alpha, I=inertial) if run.mu > 0 and run[f"{kind}_t"][0] > 0
            ]
            if len(line) > 1:
                reached = np.log([run.inertial for run in line])
                over = np.log([run.mu for run in line])
                for x, error, sign in crossing(over, *zip(*(ratio_of(run, kind) for run in line))):
                    found.append(
                        Crossover(
                            alpha, np.exp(x), np.exp(x) * error, np.exp(np.interp(x, over, reached)), 0.0, sign > 0
                        )
                    )
        for mu in values(runs, "mu"):
            line = [run for run in select(runs, "I", alpha=alpha, mu=mu) if mu > 0 and run[f"{kind}_t"][0] > 0]
            if len(line) > 1:
                branch = rises_with_friction(runs, alpha, mu, kind)
                for x, error, _ in crossing(
                    np.log([run.inertial for run in line]), *zip(*(ratio_of(run, kind) for run in line))
                ):
                    found.append(Crossover(alpha, mu, 0.0, np.exp(x), np.exp(x) * error, branch))
    return found


def rises_with_friction(runs, alpha, mu, kind):
    """Whether P_t/P_n at this mu is on its rise with mu: below the mu of its largest value over the inertial
    numbers."""
    line = [run for run in runs if run.alpha == alpha and run.mu > 0 and run[f"{kind}_t"][0] > 0]
    best = max(line, key=lambda run: ratio_of(run, kind)[0])
    return mu <= best.mu


def try_fit(fit, names, function, points, **where):
    """The parameters of a fit as Fitted; none where the points determine none."""
    x, pairs = zip(*points) if points else ((), ())
    y, errors = np.array(pairs).reshape(-1, 2).T
    try:
        found, found_errors = function(np.array(x), y, errors)
    except FitError:
        return []
    return [
        Fitted(fit, name, value, error, len(x), **where)
        for name, value, error in zip(names, found, found_errors)
        if np.isfinite(value)
    ]


def laws_of_inertia(runs):
    """Eqs. 5 and 6, and power laws in I, for each shape and friction coefficient."""
    found = []
    for alpha in values(runs, "alpha"):
        for mu in values(runs, "mu"):
            line = select(runs, "I", alpha=alpha, mu=mu)

            def points(name):
                return [(run.inertial, run[name]) for run in line if name in run.means]

            if len(line) >= FEWEST:
                found += try_fit(
                    "mu(I)", ("mu_c", "c_mu", "I_0"), fit_friction_law, points("mu_eff"), alpha=alpha, mu=mu
                )
                found += try_fit(
                    "phi(I)", ("phi_c", "c_phi", "beta"), fit_fraction_law, points("phi"), alpha=alpha, mu=mu
                )
            for name in ("lever", "spin_fluctuation", "D_y", "D_z"):
                if len(points(name)) >= 3:
                    found += try_fit(f"{name} ~ I^x", ("factor", "x"), power_law, points(name), alpha=alpha, mu=mu)
    return found


def laws_of_shape(runs):
    """Fig. 4: power laws of the dissipation in M = max(alpha, 1/alpha), for flat and for long grains beyond the
    crossover."""
    found = []
    for mu in values(runs, "mu"):
        for inertial in values(runs, "I"):
            line = select(runs, "alpha", mu=mu, I=inertial)
            for side, chosen in (
                ("flat", [run for run in line if run.alpha <= 1 / ROUND + 1e-3]),
                ("long", [run for run in line if run.alpha >= ROUND]),
            ):
                for name in (f"{kind}_{part}" for kind in kinds(runs) for part in "nt"):
                    points = [(max(run.alpha, 1 / run.alpha), run[name]) for run in chosen if run[name][0] > 0]
                    if len(points) >= 2:
                        found += try_fit(f"{name} ~ M^x, {side}", ("factor", "x"), power_law, points, mu=mu, I=inertial)
    return found


def laws_of_crossover(runs):
    """I_c ~ mu^p along the left branch of Fig. 3, for each shape and both definitions of the powers, through the points
    between neighbours in mu: those between neighbours in I are made of the same runs."""
    found = []
    for kind in kinds(runs):
        points = [point for point in crossovers(runs, kind) if point.sliding_above and point.mu_error > 0]
        for alpha in values(runs, "alpha"):
            line = [c for c in points if c.alpha == alpha]
            if len(line) >= 2:
                slope = np.polyfit(np.log([c.mu for c in line]), np.log([c.I for c in line]), 1)[
                    0
                ]  # turns errors of mu into those of I
                branch = [(c.mu, (c.I, np.hypot(c.I_error, slope * c.I * c.mu_error / c.mu))) for c in line]
                found += try_fit(f"I_c ~ mu^p, {kind}", ("factor", "p"), power_law, branch, alpha=alpha)
    return found


def all_fits(runs):
    found = []
    for alpha in progress(values(runs, "alpha"), "fits of shapes"):
        found += laws_of_inertia([run for run in runs if run.alpha == alpha])
    return found + laws_of_shape(runs) + laws_of_crossover(runs)


def critical_values(runs, name):
    """(alpha, mu, (value, error)) of mu_c or phi_c."""
    return [
        (found.alpha, found.mu, (found.value, found.error))
        for found in laws_of_inertia(runs)
        if found.parameter == name
    ]


def sizes(runs):
    """Runs by (alpha, mu, N), where a shape and friction coefficient have several N."""
    found = {}
    for run in sorted(runs, key=lambda run: run.I):
        found.setdefault((run.alpha, run.mu, run.parameters["N"]), []).append(run)
    return {key: line for key, line in found.items() if sum(other[:2] == key[:2] for other in found) > 1}
