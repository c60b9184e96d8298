"""What the paper (and where named, others) published, as comparisons with a study's steady runs. Each gives value and
error, or None where the runs do not hold it."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

from grainscope.fits import FitError, power_law
from grainscope.study.grid_fits import (
    critical_values,
    crossovers,
    kinds,
    laws_of_crossover,
    laws_of_shape,
    select,
    sizes,
)

SLIDING, ROLLING = 0.4, 10


@dataclass
class Published:
    """relation: '=', '<' or '>'; the tolerance is how well the published value is known."""

    quantity: str
    relation: str
    value: float
    tolerance: float
    source: str
    measure: Callable
    all_sizes: bool = False  # of several systems all are wanted, not the largest alone


def nearest_inertia(runs, inertial):
    """The inertial number of the runs that is nearest, within a factor of 1.5; nan when there is none."""
    nearest = min({run.I for run in runs}, key=lambda found: abs(np.log(found / inertial)), default=np.nan)
    return nearest if abs(np.log(nearest / inertial)) < np.log(1.5) else np.nan


def friction_of(runs, mu):
    """The friction coefficient that stands for this one: for 0 the least, if it is at most 0.001; nan when there is
    none."""
    if mu > 0:
        return mu
    least = min((run.mu for run in runs), default=np.nan)
    return least if least <= 0.001 else np.nan


def one(runs, name, inertial=0.01, **wanted):
    """(mean, error) of the run with these parameters at the inertial number nearest to this one."""
    wanted["I"] = nearest_inertia(runs, inertial)
    if "mu" in wanted:
        wanted["mu"] = friction_of(runs, wanted["mu"])
    return next(
        (
            run[name]
            for run in runs
            if name in run.means and all(run.parameters[key] == value for key, value in wanted.items())
        ),
        None,
    )


def fitted(laws, fit, parameter, **wanted):
    """(value, error) of a fit."""
    return next(
        (
            (law.value, law.error)
            for law in laws
            if law.fit == fit
            and law.parameter == parameter
            and all(getattr(law, key) == value for key, value in wanted.items())
        ),
        None,
    )


def powers(runs):
    """The powers of Eq. 4, which the paper shows, where they were measured; else those over steps."""
    return kinds(runs)[-1]


def exponent(name, alpha, mu, smallest=None):
    """Exponent of name ~ I^x over all inertial numbers (three at least), or the smallest two."""

    def measure(runs):
        line = select(runs, "I", alpha=alpha, mu=friction_of(runs, mu))[:smallest]
        if len(line) < (smallest or 3) or any(name not in run.means for run in line):
            return None
        try:
            (_, found), (_, error) = power_law(
                [run.inertial for run in line], *np.transpose([run[name] for run in line])
            )
        except FitError:
            return None
        return found, error

    return measure


def exponents():
    """Rows of Fig. 6: over all inertial numbers, and between the smallest two, since the curves bend at large ones."""
    for name, title, values in (
        ("lever", "velocity", (-0.49, -0.19, -0.46)),
        ("spin_fluctuation", "spin", (-0.54, -0.25, -0.47)),
    ):
        for value, alpha, mu in zip(values, (1.5, 1, 1), (0, SLIDING, ROLLING)):
            friction = "-> 0" if mu == 0 else f"= {mu:g}"
            for smallest, which in ((None, ""), (2, ", two smallest I")):
                yield Published(
                    f"{title} fluctuation ~ I^x, mu {friction}, alpha = {alpha:g}{which}",
                    "=",
                    value,
                    0.02,
                    "Fig. 6",
                    exponent(name, alpha, mu, smallest),
                )


def shape_slope(name, side, mu):
    def measure(runs):
        chosen = [run for run in runs if run.mu == friction_of(runs, mu) and run.I == nearest_inertia(runs, 0.01)]
        return fitted(laws_of_shape(chosen), f"{powers(runs)}_{name} ~ M^x, {side}", "x")

    return measure


def crossover_exponent(alpha):
    return lambda runs: fitted(
        laws_of_crossover([run for run in runs if run.alpha == alpha]), f"I_c ~ mu^p, {powers(runs)}", "p"
    )


def crossover_at(runs, alpha, mu):
    return next(
        (
            (c.I, c.I_error)
            for c in crossovers([run for run in runs if run.alpha == alpha], powers(runs))
            if c.sliding_above and c.I_error > 0 and np.isclose(c.mu, mu)
        ),
        None,
    )


def rolling_at(runs, alpha, inertial):
    inertial = nearest_inertia(runs, inertial)
    chosen = [run for run in runs if run.alpha == alpha and run.I == inertial]
    return next(((c.mu, c.mu_error) for c in crossovers(chosen, powers(runs)) if not c.sliding_above), None)


def ratio(first, second):
    """(value, error) of a quotient of two pairs; None where there is none."""
    if first is None or second is None or second[0] == 0:
        return None
    value = first[0] / second[0]
    return value, np.hypot(first[1], value * second[1]) / abs(second[0])


def ratio_of_shapes(name, alpha, other, mu):
    return lambda runs: ratio(one(runs, name, alpha=alpha, mu=mu), one(runs, name, alpha=other, mu=mu))


def crossover_ratio(alpha, other):
    return lambda runs: ratio(crossover_at(runs, alpha, 0.01), crossover_at(runs, other, 0.01))


def rolling_ratio(alpha, other):
    return lambda runs: ratio(rolling_at(runs, alpha, 0.1), rolling_at(runs, other, 0.1))


def correlation_length(runs):
    """The largest l/L_y at I = 0.1."""
    found = [
        ratio(run["l_vy"], run["L_y"]) for run in runs if run.I == nearest_inertia(runs, 0.1) and "l_vy" in run.means
    ]
    return max(found, default=None)


def friction_of_longest(runs):
    """log10 of the friction coefficient, of three at least, whose correlation length at I = 0.1, averaged over the
    shapes, is largest."""
    chosen = [run for run in runs if run.I == nearest_inertia(runs, 0.1) and run.mu > 0 and "l_vy" in run.means]
    means = {mu: np.mean([run["l_vy"][0] for run in chosen if run.mu == mu]) for mu in {run.mu for run in chosen}}
    return (np.log10(max(means, key=means.get)), 0.0) if len(means) > 2 else None


def critical(name, alpha, mu):
    def measure(runs):
        chosen = [run for run in runs if run.alpha == alpha and run.mu == friction_of(runs, mu)]
        return next((pair for _, _, pair in critical_values(chosen, name)), None)

    return measure


def fabric_angle(runs):
    """Angle of the largest eigenvector of the fabric of spheres to the flow [deg], and what the errors of its
    components make of it."""
    inertial = nearest_inertia(runs, 0.01)
    run = next(
        (run for run in runs if run.alpha == 1 and run.mu == SLIDING and run.I == inertial and "F_xy" in run.means),
        None,
    )
    if run is None:
        return None
    _, axes = run.fabric_axes()
    spread = np.hypot(run["F_xx"][1], run["F_yy"][1]) / (4 * abs(run["F_xy"][0]))
    return np.degrees(np.arctan2(axes[0, 1], axes[0, 0])), np.degrees(spread)


def extreme(name, choose, shapes=lambda alpha: True):
    """The largest or smallest value among all runs."""
    return lambda runs: choose([run[name] for run in runs if name in run.means and shapes(run.alpha)], default=None)


def friction_share(runs):
    """Share of friction in the loss of the flattest shape in the sliding regime."""
    flattest = min(run.alpha for run in runs)
    normal, friction = (one(runs, f"{powers(runs)}_{part}", alpha=flattest, mu=SLIDING) for part in "nt")
    if normal is None:
        return None
    share = friction[0] / (normal[0] + friction[0])
    return share, share * (1 - share) * np.hypot(normal[1] / normal[0], friction[1] / friction[0])


def size_effect(runs):
    """The largest relative change of mu between the two largest systems of one shape and friction."""
    changes = []
    groups = sizes(runs)
    for alpha, mu in {key[:2] for key in groups}:
        (_, small), (_, large) = sorted((key[2], line) for key, line in groups.items() if key[:2] == (alpha, mu))[-2:]
        for run in large:
            changes += [ratio(run["mu_eff"], other["mu_eff"]) for other in small if other.I == run.I]
    return max(((abs(value - 1), error) for value, error in changes), default=None)


PUBLISHED = [
    Published(
        "spin -2<omega_z>/rate of spheres, mu = 0.4",
        "=",
        1,
        0.01,
        "Fig. 2c",
        lambda runs: one(runs, "spin", alpha=1, mu=SLIDING),
    ),
    *(
        Published(f"I_c ~ mu^p, alpha = {alpha:g}", "=", 2, 0.1, 'Fig. 3, "roughly"', crossover_exponent(alpha))
        for alpha in (0.5, 0.67, 1, 1.5, 2)
    ),
    *(
        Published(
            f"I_c at mu = 0.01, alpha = {alpha:g} over that of spheres", ">", 1, 0, "Fig. 3", crossover_ratio(alpha, 1)
        )
        for alpha in (0.5, 0.67, 1.5, 2)
    ),
    *(
        Published(f"I_c at mu = 0.01, alpha = {flat:g} over {long:g}", ">", 1, 0, "Fig. 3", crossover_ratio(flat, long))
        for flat, long in ((0.67, 1.5), (0.5, 2))
    ),
    *(
        Published(
            f"mu where rolling begins at I = 0.1, alpha = {one_:g} over {other:g}",
            ">",
            1,
            0,
            "Fig. 3",
            rolling_ratio(one_, other),
        )
        for one_, other in ((1.5, 1), (0.67, 1.5), (0.5, 2))
    ),
    Published("P_n ~ M^x, mu -> 0, I ~ 0.01, long", "=", -0.90, 0.05, "Fig. 4", shape_slope("n", "long", 0)),
    Published("P_n ~ M^x, mu -> 0, I ~ 0.01, flat", "=", -0.96, 0.05, "Fig. 4", shape_slope("n", "flat", 0)),
    Published("P_t ~ M^x, mu = 0.1, I ~ 0.01, long", "=", -0.30, 0.05, "Fig. 4", shape_slope("t", "long", 0.1)),
    Published("P_t ~ M^x, mu = 0.1, I ~ 0.01, flat", "=", -0.33, 0.05, "Fig. 4", shape_slope("t", "flat", 0.1)),
    Published(
        "friction's share of the loss, flattest shape, mu = 0.4, I ~ 0.01",
        ">",
        0.95,
        0,
        'Sec. III B, "virtually all"',
        friction_share,
    ),
    Published(
        "E_rot/E_tr, alpha = 1.5, mu -> 0, I ~ 0.01",
        ">",
        1,
        0,
        "Fig. 5c",
        lambda runs: one(runs, "E_rot/E_tr", alpha=1.5, mu=0),
    ),
    Published(
        "E_rot/E_tr of spheres, mu = 10, I ~ 0.01",
        "=",
        1,
        0.1,
        "Fig. 5c",
        lambda runs: one(runs, "E_rot/E_tr", alpha=1, mu=ROLLING),
    ),
    *exponents(),
    Published(
        "velocity fluctuation, alpha = 0.5 over 1.5, mu -> 0, I ~ 0.01",
        "=",
        1,
        0.1,
        'Fig. 6, "collapse"',
        ratio_of_shapes("lever", 0.5, 1.5, 0),
    ),
    *(
        Published(
            f"spin fluctuation, alpha = {far:g} over {near:g}, mu -> 0, I ~ 0.01",
            "<",
            1,
            0,
            "Fig. 6",
            ratio_of_shapes("spin_fluctuation", far, near, 0),
        )
        for far, near in ((0.5, 0.67), (2, 1.5))
    ),
    Published(
        "mu_eff, alpha = 0.5 over 2, mu -> 0, I ~ 0.01", "<", 1, 0, "Sec. III C", ratio_of_shapes("mu_eff", 0.5, 2, 0)
    ),
    *(
        Published(
            f"S2, alpha = {flat:g} over {long:g}, mu -> 0, I ~ 0.01",
            ">",
            1,
            0,
            "Sec. III C",
            ratio_of_shapes("S2", flat, long, 0),
        )
        for flat, long in ((0.67, 1.5), (0.5, 2))
    ),
    Published("mu_c of spheres, mu -> 0", "=", 0.10, 0.01, "Peyneau & Roux 2008", critical("mu_c", 1, 0)),
    Published("phi_c of spheres, mu -> 0", "=", 0.64, 0.005, "Peyneau & Roux 2008", critical("phi_c", 1, 0)),
    Published("largest Z of spheres", "<", 6, 0, "Fig. 7", extreme("Z", max, lambda alpha: alpha == 1)),
    Published("largest Z of other shapes", "<", 10, 0, "Fig. 7", extreme("Z", max, lambda alpha: alpha != 1)),
    Published(
        "mu_c at mu = 10 over that at mu = 1, alpha = 0.5",
        "<",
        1,
        0,
        "Fig. 8",
        lambda runs: ratio(critical("mu_c", 0.5, ROLLING)(runs), critical("mu_c", 0.5, 1)(runs)),
    ),
    Published("largest l/L_y at I = 0.1", "<", 0.16, 0, "Sec. III D", correlation_length),
    Published(
        "log10 of the mu of the largest l at I = 0.1", "=", -0.5, 0.5, "Fig. 9b, mu = 0.1 to 1", friction_of_longest
    ),
    Published(
        "angle of the fabric of spheres to the flow [deg], mu = 0.4, I ~ 0.01", "=", -45, 5, "Fig. 10", fabric_angle
    ),
    *(
        Published(
            f"deviator of the fabric, alpha = {flat:g} over {long:g}, mu = 0.4, I ~ 0.01",
            ">",
            1,
            0,
            "Fig. 10",
            ratio_of_shapes("fabric_deviator", flat, long, SLIDING),
        )
        for flat, long in ((0.67, 1.5), (0.5, 2))
    ),
    Published("largest change of mu with N", "<", 0.02, 0, "Fig. 14, N = 2000 to 4000", size_effect, all_sizes=True),
    Published("largest N2/P", "<", 0, 0, "Fig. 15", extreme("N2", max)),
    Published("D_z, alpha = 0.5 over 2, mu -> 0, I ~ 0.01", ">", 1, 0, "App. E", ratio_of_shapes("D_z", 0.5, 2, 0)),
    Published("D_y ~ I^x, mu -> 0, alpha = 1", "=", -1 / 8, 0.03, "App. E", exponent("D_y", 1, 0)),
]
