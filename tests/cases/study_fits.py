# SPDX-License-Identifier: GPL-2.0-or-later
"""The fits of a study on points whose answer is known: values, and errors against the scatter of repeated noise."""
import numpy as np

from case import main, require, require_close
from grainscope.fits import (
    FitError,
    crossing,
    fit_decay,
    fit_fraction_law,
    fit_friction_law,
    fraction_law,
    friction_law,
    power_law,
)
from grainscope.shear.measures import SteadyRun
from grainscope.study.compare import verdict
from grainscope.study.grid_fits import FEWEST, all_fits, crossovers, laws_of_shape, sizes
from grainscope.study.paper_values import PUBLISHED, Published
from grainscope.study.table import largest, over_seeds

INERTIA = np.geomspace(1e-3, 0.1, 7)
NOISE = 0.003
REPEATS = 300


def known(fit_law, law, truth, x=INERTIA):
    """The exact parameters of exact points; with noise the pulls (value - truth)/error are of mean 0 and width 1 within
    what 300 repeats tell (4 standard deviations of their mean 1/sqrt(300) and width 1/sqrt(600))."""

    def case(ranks):
        found, _ = fit_law(x, law(x, *truth), np.full(len(x), 1e-6))
        require_close(found / np.array(truth), np.ones(len(truth)), 1e-4, "parameters of exact points over their truth")
        random, pulls = np.random.default_rng(1), []
        for _ in range(REPEATS):
            values, errors = fit_law(x, law(x, *truth) + NOISE * random.standard_normal(len(x)), np.full(len(x), NOISE))
            pulls.append((values - np.array(truth)) / errors)
        require_close(np.median(pulls, axis=0), np.zeros(len(truth)), 5 / np.sqrt(REPEATS), "median pull", 1.0)
        # errors grow where a sample scatters more than its errors tell, never shrink: pulls are a little narrow
        inside = (np.abs(pulls) < 1).mean(axis=0)
        require(
            (inside > 0.62).all() and (inside < 0.86).all(),
            f"shares of the values within one error: {inside}, expected about 0.68 to 0.8",
        )

    return case


def power_law_as_fit(x, y, errors):
    values, found = power_law(x, y, errors)
    return np.array(values), np.array(found)


def without_errors(ranks):
    """Points without errors of their own: their scatter tells the fit's."""
    random = np.random.default_rng(2)
    spread, reported = [], []
    for _ in range(REPEATS):
        (_, exponent), (_, error) = power_law(
            INERTIA, INERTIA**-0.5 * np.exp(0.05 * random.standard_normal(7)), np.zeros(7)
        )
        spread.append(exponent)
        reported.append(error)
    require_close(
        np.sqrt(np.mean(np.square(reported))), np.std(spread), 0.15, "error of the exponent, against its spread"
    )


def decay(ranks):
    x = np.linspace(0.5, 5, 15)
    for length in (0.3, 1.0, 4.0):
        found, error = fit_decay(x, np.exp(-x / length))
        require_close(found, length, 1e-5, f"length {length}")
        require(error < 1e-4 * length, f"error {error} of exact points")
    require(fit_decay(x, -np.ones(15)) == (0.0, 0.0), "nothing above 0.05 must give 0")
    require(np.isnan(fit_decay(x, np.full(15, 1.2))).all(), "a correlation that does not decay has no length")
    # below 0.05 nothing counts
    require_close(
        fit_decay(x, np.where(np.exp(-x) > 0.05, np.exp(-x), -0.3))[0], 1.0, 1e-5, "length with an anticorrelated tail"
    )


def refused(ranks):
    for what, call in {
        "two points for three parameters": lambda: fit_friction_law([0.1, 0.2], [0.3, 0.4], [0.1, 0.1]),
        "a negative value": lambda: power_law([1, 2, 3], [1, -1, 1], [1, 1, 1]),
    }.items():
        try:
            found = call()
        except FitError:
            continue
        require(False, f"{what} gave {found}")


def curves_that_do_not_bend(ranks):
    """A straight line in I tells mu_c and phi_c, with the errors of a straight line, but no I_0 and no beta."""
    random = np.random.default_rng(4)
    for fit_law, value, slope in ((fit_friction_law, 0.3, 1.0), (fit_fraction_law, 0.6, -0.001)):
        found, pulls = [], []
        for _ in range(REPEATS):
            values, errors = fit_law(
                INERTIA, value + slope * INERTIA + NOISE * random.standard_normal(7), np.full(7, NOISE)
            )
            if np.isnan(values[1:]).all():
                found.append(values[0])
                pulls.append((values[0] - value) / errors[0])
        require(
            len(found) > REPEATS / 10,
            f"a curve that does not bend was bent in {REPEATS - len(found)} of {REPEATS} cases",
        )
        require(abs(np.median(pulls)) < 1.5, f"the values at 0 are off by {np.median(pulls)} errors")


def crossing_and_error(ranks):
    """ln(ratio) = 2 ln(x/x_0) is straight: the crossing is exact; where it bends; its error against repeated noise."""
    over = np.log([0.001, 0.01, 0.1])
    ratios = (np.exp(over) / 0.02) ** 2
    ((place, _, sign),) = crossing(over, ratios, 0.1 * ratios)
    require_close(np.exp(place), 0.02, 1e-12, "crossing")
    require(sign == 1, "the ratio rises")
    # where the points bend, the cubic is nearer than a straight line, and the error tells how far the two are apart
    bent = np.log([0.4, 1, 10])
    ((place, error, sign),) = crossing(bent, (3 / np.exp(bent)) ** np.array([0.2, 1, 3]), np.zeros(3))
    require(sign == -1 and np.log(10) > place > 0, f"crossing at {place}")
    straight = np.log(3) / (np.log(3) + 3 * np.log(10 / 3)) * np.log(10)
    require_close(error, abs(place - straight), 1e-9, "distance of the cubic from the straight line")
    random = np.random.default_rng(3)
    noisy = [crossing(over, ratios * np.exp(0.1 * random.standard_normal(3)), 0.1 * ratios)[0] for _ in range(2000)]
    places, errors, _ = np.array(noisy).T
    # noise bends the cubic too, which the slope of the straight line does not know
    require_close(np.mean(errors), np.std(places), 0.2, "error of the crossing, against its spread")
    require(crossing(over, ratios + 1e6, ratios) == [], "a ratio that is never 1")


def made_run(alpha, mu, inertial, seed=1, grains=1000, scale=1.0):
    """A run of a world with P_t/P_n = f mu^2/I up to mu = 1 and f/(mu^2 I) beyond, f = max(alpha, 1/alpha), and known
    laws."""
    shape = max(alpha, 1 / alpha)
    ratio = shape * 100 * min(mu, 1 / mu) ** 2 / inertial * 0.01
    normal = 0.3 / (1 + ratio)
    means = {
        "I_reached": inertial,
        "W_n": normal,
        "W_t": 0.3 - normal,
        "instant_n": normal,
        "instant_t": 0.3 - normal,
        "mu_eff": scale * friction_law(inertial, 0.1 + 0.1 * mu / (1 + mu), 0.6, 0.2),
        "phi": fraction_law(inertial, 0.64, 0.3, 0.8),
        "lever": inertial**-0.5,
        "spin_fluctuation": 2 * inertial**-0.4,
        "D_y": 0.03,
        "D_z": 0.02,
        "Z": 5.0,
        "N2": -0.1,
        "spin": 1.0,
    }
    parameters = {"alpha": alpha, "mu": mu, "I": inertial, "N": grains, "seed": seed, "e": 0.1}
    return SteadyRun(
        f"{alpha} {mu} {inertial} {seed}",
        parameters,
        {name: (value, 1e-4 * abs(value)) for name, value in means.items()},
        {},
    )


def made_grid():
    return [
        made_run(alpha, mu, inertial)
        for alpha in (0.5, 0.67, 1, 1.5, 2)
        for mu in (0.001, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30)
        for inertial in (0.01, 0.03, 0.06, 0.1)
    ]


def level_set(ranks):
    """Both branches of the made world: I_c = f mu^2 and f/mu^2."""
    points = crossovers(made_grid())
    for alpha in (0.5, 1, 2):
        shape = max(alpha, 1 / alpha)
        for branch in (True, False):
            line = [c for c in points if c.alpha == alpha and c.sliding_above == branch]
            require(len(line) >= 4, f"{len(line)} points of alpha = {alpha}, sliding_above = {branch}")
            for c in line:
                require_close(c.I, shape * min(c.mu, 1 / c.mu) ** 2, 0.02, f"I_c at mu = {c.mu:.3g}, alpha = {alpha}")
                require(0 < c.mu_error + c.I_error < 0.03 * (c.mu + c.I), f"errors of {c}")


def laws_of_grid(ranks):
    found = {(law.fit, law.parameter, law.alpha, law.mu): law for law in all_fits(made_grid()) if law.I != law.I}
    for alpha in (0.5, 1, 2):
        for fit, parameter, truth in (
            ("lever ~ I^x", "x", -0.5),
            ("spin_fluctuation ~ I^x", "x", -0.4),
            ("mu(I)", "mu_c", 0.15),
            ("phi(I)", "phi_c", 0.64),
            ("phi(I)", "beta", 0.8),
        ):
            require_close(found[fit, parameter, alpha, 1].value, truth, 1e-3, f"{parameter} of {fit}")
        crossover = next(law for key, law in found.items() if key[:3] == ("I_c ~ mu^p, W", "p", alpha))
        require_close(crossover.value, 2, 0.01, "p of I_c ~ mu^p")
    few = [run for run in made_grid() if run.I > 0.02]
    require(
        not any(law.fit == "mu(I)" for law in all_fits(few)),
        f"Eq. 5 was fitted to fewer than {FEWEST} inertial numbers",
    )


def laws_of_made_shapes(ranks):
    """W_n is 0.3/(1 + c M): the slope between two shapes by hand; alone a shape gives none."""
    runs = [run for run in made_grid() if run.mu == 0.1 and run.I == 0.01]
    law = next(law for law in laws_of_shape(runs) if law.fit == "W_n ~ M^x, long" and law.parameter == "x")
    normal = {run.alpha: run["W_n"][0] for run in runs}
    require_close(law.value, np.log(normal[2] / normal[1.5]) / np.log(2 / 1.5), 1e-6, "slope")
    require(laws_of_shape([run for run in runs if run.alpha in (1, 2)]) == [], "one shape has no slope")


def seeds_and_sizes(ranks):
    runs = [made_run(1, 0.4, 0.1, seed, scale=scale) for seed, scale in ((1, 1.0), (2, 1.02), (3, 0.98))]
    (one,) = over_seeds(runs)
    values = [run["mu_eff"][0] for run in runs]
    require_close(
        one["mu_eff"], (np.mean(values), np.std(values, ddof=1) / np.sqrt(3)), 1e-12, "mean over seeds and its error"
    )
    require_close(
        one["phi"][1], runs[0]["phi"][1] / np.sqrt(3), 1e-12, "error where the runs differ less than their own errors"
    )
    both = [
        made_run(1, 0.4, 0.1, grains=1000),
        made_run(1, 0.4, 0.1, grains=2000, scale=1.03),
        made_run(2, 0.4, 0.1, grains=1100),
    ]
    require([run.parameters["N"] for run in largest(both)] == [2000, 1100], "the largest system of each shape")
    require(sorted(sizes(both)) == [(1, 0.4, 1000), (1, 0.4, 2000)], "only alpha = 1 has two sizes")
    change = next(p for p in PUBLISHED if p.quantity == "largest change of mu with N").measure(both)
    require_close(change[0], 0.03, 1e-9, "change of mu with N")


def agreement(ranks):
    def published(relation):
        return Published("", relation, 1.0, 0.1, "", None)

    for relation, value, error, expected in (
        ("=", 1.09, 0, "yes"),
        ("=", 1.11, 0, "NO"),
        ("=", 1.2, 0.12, "yes"),
        ("=", 1.4, 0.1, "NO"),
        ("=", 1.2, 0.3, "undecided"),
        ("<", 0.9, 0, "yes"),
        ("<", 1.1, 0, "NO"),
        ("<", 0.9, 0.06, "undecided"),
        ("<", 1.1, 0.06, "undecided"),
        (">", 0.9, 0.04, "NO"),
        (">", 1.1, 0.06, "undecided"),
        (">", 2, 0, "yes"),
        ("=", np.nan, 0.1, "undecided"),
        ("<", 0.5, np.nan, "undecided"),
    ):
        found = verdict(published(relation), value, error)
        require(found == expected, f"{value} +- {error} {relation} 1: {found}, expected {expected}")


def published_of_grid(ranks):
    """Every published number finds its runs in a grid that has them, and says so where it has not."""
    grid = made_grid() + [
        made_run(alpha, mu, inertial)
        for alpha in (0.5, 1, 1.5, 2)
        for mu in (0.4,)
        for inertial in (0.01, 0.03, 0.06, 0.1)
    ]
    found = {p.quantity: p.measure(grid) for p in PUBLISHED}
    untold = [name for name, pair in found.items() if pair is None]
    absent = (
        "E_rot/E_tr",
        "l/L_y",
        "log10 of the mu",
        "fabric",
        "S2",
        "change of mu with N",
        "I_c at mu = 0.01",
        "rolling",
    )
    require(all(any(word in name for word in absent) for name in untold), f"not told: {untold}")
    require_close(found["I_c ~ mu^p, alpha = 1"][0], 2, 0.01, "p")
    require_close(found["spin -2<omega_z>/rate of spheres, mu = 0.4"], (1, 1e-4), 1e-12, "spin")
    require(all(p.measure([made_run(1.5, 0.4, 0.1)]) is None or p.relation for p in PUBLISHED), "one run alone")


main(
    {
        "friction-law": known(fit_friction_law, friction_law, (0.3, 0.5, 0.1)),
        "fraction-law": known(fit_fraction_law, fraction_law, (0.64, 0.4, 0.7)),
        "power-law": known(power_law_as_fit, lambda x, factor, exponent: factor * x**exponent, (0.5, -0.2)),
        "without-errors": without_errors,
        "decay": decay,
        "refused": refused,
        "curves-that-do-not-bend": curves_that_do_not_bend,
        "crossing": crossing_and_error,
        "level-set": level_set,
        "laws-of-grid": laws_of_grid,
        "laws-of-shape": laws_of_made_shapes,
        "seeds-and-sizes": seeds_and_sizes,
        "agreement": agreement,
        "published-of-grid": published_of_grid,
    }
)
