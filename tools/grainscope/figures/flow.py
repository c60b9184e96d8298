"""Figures of the paper about the flow as a whole: 2, 4, 5, 6, 7, 15, 16 and 18. Each takes the steady runs and a
path."""

from matplotlib.colors import TwoSlopeNorm
import matplotlib.pyplot as plt
import numpy as np

from grainscope.figures.style import (
    curves_by_inertia,
    curves_by_shape,
    friction_colour,
    friction_grid,
    friction_label,
    legible,
    log_scale,
    nearest,
    save,
    shape_colour,
    shape_legend,
    values_of,
    with_value,
)
from grainscope.fits import FitError, fit_fraction_law, fit_friction_law, fraction_law, friction_law, power_law

SHAPE_RATIO = r"shape ratio $r_g$"
INERTIA = r"inertial number $I$"


def against_shape(measures, rows):
    """One panel per (value, label) against the shape ratio."""
    measures = legible(measures)
    figure, axes = plt.subplots(1, len(rows), figsize=(3.4 * len(rows), 3.0), constrained_layout=True)
    for axis, (value, label) in zip(axes, rows):
        curves_by_shape(axis, measures, value)
        axis.set_xlabel(SHAPE_RATIO)
        axis.set_ylabel(label)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure, axes


def against_inertia(measures, rows):
    """One row of panels per (value, label) against the inertial number, a column per friction coefficient."""
    figure, axes, columns = friction_grid(measures, len(rows))
    for row, (value, label) in zip(axes, rows):
        for axis, runs in zip(row, columns):
            curves_by_inertia(axis, runs, value)
        row[0].set_ylabel(label)
    for axis in axes[-1]:
        axis.set_xlabel(INERTIA)
    shape_legend(figure, measures)
    return figure, axes, columns


def orientation(measures, path):
    """Fig. 2: nematic order, angle to the flow (spheres have none), rotation."""
    figure, axes = against_shape(
        measures,
        [
            (lambda m: m["S2"], r"nematic order $S_2$"),
            (lambda m: None if m.alpha == 1 else m["theta_x"], r"angle to the flow $\theta_x$ [°]"),
            (lambda m: m["spin"], r"$-2\,\langle\omega_z\rangle/\dot\gamma$"),
        ],
    )
    axes[0].set_ylim(bottom=0)
    axes[2].set_ylim(bottom=0)
    axes[2].axhline(1, color="0.6", linewidth=0.8, linestyle=":")
    save(figure, path)


def add_shape_slopes(axis, runs, value, colour):
    """Power laws through the flat and through the long grains beyond the crossover at 1.2, where there are at least
    three of them."""
    for side in ([m for m in runs if m.alpha <= 1 / 1.2 + 1e-3], [m for m in runs if m.alpha >= 1.2]):
        x, y = np.array([m.alpha for m in side]), np.array([value(m) for m in side])
        if len(side) < 3 or (y[:, 0] <= 0).any():
            continue
        (factor, exponent), _ = power_law(x, *y.T)
        axis.plot(x, factor * x**exponent, color=colour, linewidth=0.8, linestyle="--")
        axis.annotate(
            f"{exponent:+.2f}",
            (x.mean(), factor * x.mean() ** exponent),
            textcoords="offset points",
            xytext=(4, 6),
            fontsize=8,
            color=colour,
        )


def dissipation(measures, path):
    """Fig. 4: power lost to normal damping and to friction, over rate x P x volume, against the aspect ratio."""
    measures = legible(measures)
    figure, axes = plt.subplots(1, 2, figsize=(7.6, 3.3), constrained_layout=True)
    quantities = [
        (lambda m: m["W_n"], r"$\mathcal{P}_n\,/\,\dot\gamma P\Omega$"),
        (lambda m: m["W_t"], r"$\mathcal{P}_t\,/\,\dot\gamma P\Omega$"),
    ]
    for axis, (value, label) in zip(axes, quantities):
        for mu in values_of(measures, "mu"):
            for inertial in values_of(measures, "I"):
                runs = [m for m in with_value(measures, mu=mu, I=inertial) if value(m)[0] > 0]
                if not runs:
                    continue
                means, errors = np.array([value(m) for m in runs]).T
                several = len(values_of(measures, "I")) > 1
                axis.errorbar(
                    [m.alpha for m in runs],
                    means,
                    yerr=np.minimum(errors, 0.9 * means),
                    marker="o",
                    markersize=5,
                    linewidth=1.2,
                    color=friction_colour(mu),
                    capsize=2,
                    label=friction_label(mu) + (rf", $I = {inertial:g}$" if several else ""),
                )
                add_shape_slopes(axis, runs, value, friction_colour(mu))
        axis.set(xscale="log", xlim=(0.3, 3.4), xlabel=r"aspect ratio $\alpha$", ylabel=label)
        axis.set_xticks([0.33, 0.5, 0.67, 1, 1.5, 2, 3], ["0.33", "0.5", "0.67", "1", "1.5", "2", "3"])
        axis.minorticks_off()
        log_scale(axis.yaxis)
    handles = {label: handle for axis in axes for handle, label in zip(*axis.get_legend_handles_labels())}
    figure.legend(handles.values(), handles.keys(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)


def fluctuations(measures, path):
    """Fig. 5: ratios of velocity fluctuations, and of the energy of rotation to that of translation."""
    figure, axes = against_shape(
        measures,
        [
            (lambda m: m["dv_x/dv_y"], r"$\delta v_x\,/\,\delta v_y$"),
            (lambda m: m["dv_x/dv_z"], r"$\delta v_x\,/\,\delta v_z$"),
            (lambda m: m["E_rot/E_tr"], r"$\delta E_{rot}\,/\,\delta E_{transl}$"),
        ],
    )
    for axis in axes:
        axis.axhline(1, color="0.6", linewidth=0.8, linestyle="--")
    log_scale(axes[2].yaxis)
    save(figure, path)


def lever(measures, path):
    """Fig. 6: velocity and spin fluctuations against the inertial number, with the power law of the roundest shape."""
    rows = [
        (lambda m: m["lever"], r"$\delta v\,/\,\dot\gamma d_{eq}$"),
        (lambda m: m["spin_fluctuation"], r"$\delta\omega\,/\,\dot\gamma$"),
    ]
    figure, axes, columns = against_inertia(measures, rows)
    for row, (value, _) in zip(axes, rows):
        for axis, runs in zip(row, columns):
            alpha = min(values_of(runs, "alpha"), key=lambda alpha: abs(np.log(alpha)))
            roundest = with_value(runs, alpha=alpha)
            if len(roundest) >= 3:
                x = np.array([m.inertial for m in roundest])
                (factor, exponent), (_, error) = power_law(x, *np.array([value(m) for m in roundest]).T)
                axis.plot(x, factor * x**exponent, color="black", linewidth=0.9, linestyle="--")
                axis.text(
                    0.95,
                    0.93,
                    rf"slope {exponent:.2f} $\pm$ {error:.2f} ($\alpha$ = {alpha:g})",
                    transform=axis.transAxes,
                    ha="right",
                    fontsize=8,
                )
        log_scale(row[0].yaxis)
    save(figure, path)


def rheology(measures, path):
    """Fig. 7: effective friction, solid fraction and coordination against the inertial number; mu(I) and phi(I) fitted
    to four or more runs of a shape."""
    rows = [
        (lambda m: m["mu_eff"], r"$\mu = \sigma_{xy}/P$"),
        (lambda m: m["phi"], r"$\phi$"),
        (lambda m: m["Z"], r"$Z$"),
    ]
    figure, axes, columns = against_inertia(measures, rows)
    laws = [(fit_friction_law, friction_law), (fit_fraction_law, fraction_law)]
    for row, (value, _), (fit_law, law) in zip(axes, rows, laws):
        for axis, runs in zip(row, columns):
            for alpha in values_of(runs, "alpha"):
                found = with_value(runs, alpha=alpha)
                if len(found) < 4:
                    continue
                x = np.array([m.inertial for m in found])
                try:
                    parameters, _ = fit_law(x, *np.array([value(m) for m in found]).T)
                except FitError:
                    continue
                line = np.geomspace(x.min(), x.max(), 60)
                axis.plot(line, law(line, *parameters), color=shape_colour(alpha), linewidth=0.8, linestyle="--")
    highest = max(m["Z"][0] for m in measures)
    for axis in axes[2]:
        for contacts, style in ((3, "--"), (6, "-."), (10, ":")):
            if contacts < 1.3 * highest:
                axis.axhline(contacts, color="0.6", linewidth=0.8, linestyle=style, zorder=0)
    axes[2, 0].set_ylim(bottom=0)
    save(figure, path)


def normal_stress_differences(measures, path):
    """Fig. 15: N1 = sigma_xx - sigma_yy and N2 = sigma_yy - sigma_zz over P, tension positive."""
    figure, axes, _ = against_inertia(measures, [(lambda m: m["N1"], r"$N_1/P$"), (lambda m: m["N2"], r"$N_2/P$")])
    for axis in axes.flat:
        axis.axhline(0, color="0.6", linewidth=0.8, zorder=0)
    save(figure, path)


def diffusion(measures, path):
    """Fig. 16: mean square displacements over strain with their straight lines, and the diffusion coefficients against
    I."""
    figure, axes, columns = friction_grid(measures, 4, width=4.0, height=2.1)
    for row, axis_name in ((0, "y"), (1, "z")):
        for axis, runs in zip(axes[row], columns):
            for m in runs:
                strain, squares = m.curves["displacement"]["strain"], m.curves["displacement"][f"{axis_name}2"]
                line = squares.mean() + 2 * m[f"D_{axis_name}"][0] * (strain - strain.mean())
                axis.plot(strain, squares, color=shape_colour(m.alpha), linewidth=1.2)
                axis.plot(strain, line, color=shape_colour(m.alpha), linewidth=0.8, linestyle="--")
            axis.set_xlabel(r"strain since the start of the averages")
            axis.set_xlim(left=0)
        axes[row, 0].set_ylim(bottom=0)
        axes[row, 0].set_ylabel(rf"$\langle {axis_name}^2\rangle\,/\,d_{{eq}}^2$")
    for row, axis_name in ((2, "y"), (3, "z")):
        for axis, runs in zip(axes[row], columns):
            curves_by_inertia(axis, runs, lambda m, name=axis_name: m[f"D_{name}"])
            axis.set_xlabel(INERTIA)
        axes[row, 0].set_ylabel(rf"$D_{axis_name}\,/\,\dot\gamma d_{{eq}}^2$")
        log_scale(axes[row, 0].yaxis)
    shape_legend(figure, measures)
    save(figure, path)


def stress_parts(measures, path):
    """Fig. 18: shear stress over P from normal forces, from tangential forces, and in all, over friction and shape."""
    frictions, shapes = values_of(measures, "mu"), values_of(measures, "alpha")
    parts = [
        ("normal forces", lambda m: m["n_xy"][0]),
        ("tangential forces", lambda m: m["t_xy"][0]),
        ("total", lambda m: m["n_xy"][0] + m["t_xy"][0]),
    ]
    chosen = [m for m in measures if m.I == nearest(measures, "I", 0.01)]
    figure, axes = plt.subplots(
        3,
        1,
        figsize=(1.2 + max(3.6, 0.7 * len(shapes)), 1.2 + 3 * max(0.9, 0.4 * len(frictions))),
        constrained_layout=True,
        sharex=True,
    )
    for axis, (title, value) in zip(axes, parts):
        table = np.full((len(frictions), len(shapes)), np.nan)
        for m in chosen:
            table[frictions.index(m.mu), shapes.index(m.alpha)] = value(m)
        limit = np.nanmax(np.abs(table))
        norm = TwoSlopeNorm(0, -limit, limit) if np.nanmin(table) < 0 else plt.Normalize(0, limit)
        image = axis.pcolormesh(
            table, norm=norm, cmap="RdBu_r" if np.nanmin(table) < 0 else "viridis", edgecolors="white", linewidth=1
        )
        for (row, column), number in np.ndenumerate(table):
            if np.isfinite(number):
                red, green, blue, _ = image.cmap(norm(number))
                axis.text(
                    column + 0.5,
                    row + 0.5,
                    f"{number:.3f}",
                    ha="center",
                    va="center",
                    fontsize=8,
                    color="black" if 0.3 * red + 0.6 * green + 0.1 * blue > 0.5 else "white",
                )
        axis.set_yticks(np.arange(len(frictions)) + 0.5, [f"{mu:g}" for mu in frictions])
        axis.set_xticks(np.arange(len(shapes)) + 0.5, [f"{alpha:g}" for alpha in shapes])
        axis.set_ylabel(r"$\mu_p$")
        axis.set_title(rf"$\sigma_{{xy}}/P$, {title}")
        figure.colorbar(image, ax=axis)
    axes[-1].set_xlabel(rf"aspect ratio $\alpha$   ($I = {chosen[0].I:g}$)")
    save(figure, path)
