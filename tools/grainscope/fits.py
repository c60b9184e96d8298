"""Fits to measured points, with their errors: least squares by scipy, weighted by the points' own errors where all of
them have one."""

import warnings

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import OptimizeWarning, brentq, curve_fit


class FitError(Exception):
    """Points that do not determine what is asked of them; the message says why."""


class LimitError(FitError):
    """The best curve is at a limit of its parameters."""


def fit(model, x, y, errors, starts, low, high):
    """Parameters of y = model(x, *parameters) within (low, high), and their standard errors: those that the points'
    errors make, larger where the points scatter about the curve by more than that. The best of the fits from several
    starts counts; one at a limit does not.
    """
    x, y, errors = (np.asarray(values, dtype=float) for values in (x, y, errors))
    if not all(np.isfinite(values).all() for values in (x, y, errors)):
        raise FitError("a point is not finite")
    spare = len(x) - len(low)
    if spare < 0:
        raise FitError(f"{len(low)} points are needed, there are {len(x)}")
    weighted = bool((errors > 0).all())
    errors = errors if weighted else np.ones_like(y)
    best = np.inf
    for start in starts:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error", OptimizeWarning)
                parameters, covariance = curve_fit(
                    model, x, y, start, errors, absolute_sigma=True, bounds=(low, high), method="trf"
                )
        except (RuntimeError, OptimizeWarning):
            continue
        misfit = (((model(x, *parameters) - y) / errors) ** 2).sum()
        if misfit < best:
            best, found, variances = misfit, parameters, np.diag(covariance)
    if not np.isfinite(best):
        raise FitError("the points determine no curve")
    if any(np.isclose(found, limit, rtol=1e-4, atol=1e-12).any() for limit in (low, high)):
        raise LimitError("the best curve is at a limit of its parameters")
    scatter = best / spare if spare else 0.0
    return found, np.sqrt(variances * (max(1.0, scatter) if weighted else scatter))


def straight_line(x, y, errors):
    """(value at 0, slope) of a straight line, and their errors."""
    return fit(lambda x, p, q: p + q * x, x, y, errors, [(np.mean(y), 0.0)], [-np.inf] * 2, [np.inf] * 2)


def power_law(x, y, errors):
    """(factor, exponent) of y = factor x^exponent, and their errors: a straight line in the logarithms."""
    x, y, errors = (np.asarray(values, dtype=float) for values in (x, y, errors))
    if (x <= 0).any() or (y <= 0).any():
        raise FitError("a power law needs values above 0")
    (intercept, exponent), error = straight_line(np.log(x), np.log(y), errors / y)
    return (np.exp(intercept), exponent), (np.exp(intercept) * error[0], error[1])


def fit_or_line(*arguments):
    """fit(), or where the points do not tell how the curve bends, the value at 0 of a straight line; the other
    parameters are nan then."""
    try:
        return fit(*arguments)
    except LimitError:
        _, x, y, errors, _, low, _ = arguments
        (value, _), (error, _) = straight_line(x, y, errors)
        return (np.array([first] + [np.nan] * (len(low) - 1)) for first in (value, error))


def friction_law(inertial, mu_c, c_mu, I_0):
    """Eq. 5 of Bilotto et al. (2025): mu(I) = mu_c + c_mu/(1 + I_0/I)."""
    return mu_c + c_mu / (1 + I_0 / inertial)


def fit_friction_law(inertial, mu, errors):
    """(mu_c, c_mu, I_0), and their errors; mu_c alone where the points do not tell how mu(I) bends."""
    starts = [(np.min(mu), 0.5, I_0) for I_0 in (0.03, 0.3, 3.0)]
    return fit_or_line(friction_law, inertial, mu, errors, starts, [0, 0, 1e-4], [2, 20, 30])


def fraction_law(inertial, phi_c, c_phi, beta):
    """Eq. 6 of Bilotto et al. (2025): phi(I) = phi_c - c_phi I^beta."""
    return phi_c - c_phi * inertial**beta


def fit_fraction_law(inertial, phi, errors):
    """(phi_c, c_phi, beta), and their errors; phi_c alone where the points do not tell how phi(I) bends."""
    starts = [(np.max(phi), 0.2, beta) for beta in (0.4, 1.0, 1.8)]
    return fit_or_line(fraction_law, inertial, phi, errors, starts, [0, 0, 0.05], [1, 50, 3])


def fit_decay(distance, correlation):
    """Length l of exp(-x/l) over the points above 0.05, and its error: 0 and 0 when there are none; nan where they
    determine no length."""
    distance, correlation = np.asarray(distance), np.asarray(correlation)
    above = correlation > 0.05
    if not above.any():
        return 0.0, 0.0
    x = distance[above]
    try:
        (length,), (error,) = fit(
            lambda x, length: np.exp(-x / length),
            x,
            correlation[above],
            np.zeros(len(x)),
            [[factor * x.max()] for factor in (0.03, 0.3, 3.0)],
            [1e-3 * x.max()],
            [1e3 * x.max()],
        )
    except FitError:
        return np.nan, np.nan
    return length, error


def crossing(x, ratios, errors):
    """Where ln(ratio) changes sign along x, by a monotone cubic through all points: list of (x, its error, +1 where the
    ratio rises). The error is what the points' errors make, and how far a straight line between the two neighbours
    would put it, in quadrature."""
    x, y, dy = np.asarray(x), np.log(ratios), np.asarray(errors) / np.asarray(ratios)
    found = []
    for k in np.flatnonzero((y[:-1] > 0) != (y[1:] > 0)):
        rise, step = y[k + 1] - y[k], x[k + 1] - x[k]
        share = -y[k] / rise
        straight = x[k] + share * step
        curved = brentq(PchipInterpolator(x, y), x[k], x[k + 1])
        # d(share)/dy_k = -(1 - share)/rise, d(share)/dy_(k+1) = -share/rise
        noise = abs(step / rise) * np.hypot((1 - share) * dy[k], share * dy[k + 1])
        found.append((curved, np.hypot(noise, curved - straight), 1 if rise > 0 else -1))
    return found
