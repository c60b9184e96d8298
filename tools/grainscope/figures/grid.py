"""Figures of the paper that need a grid of runs: 3 (regimes), 8 (critical friction and solid fraction) and 14 (finite
size). Each takes the steady runs and a path."""

import matplotlib.pyplot as plt
import numpy as np

from grainscope.figures.style import (
    friction_colour,
    friction_label,
    log_scale,
    points,
    save,
    shape_colour,
    shape_legend,
    shape_marker,
    shape_ratio,
    values_of,
)
from grainscope.study.grid_fits import critical_values, crossovers, kinds, sizes


def note(figure, text):
    figure.text(0.5, 0.5, text, ha="center", va="center", color="0.4")


def draw_branches(axis, found, alpha, **style):
    """The two branches of the level set of one shape."""
    for rise in (True, False):
        branch = sorted((c for c in found if c.alpha == alpha and c.sliding_above == rise), key=lambda c: (c.I, c.mu))
        if branch:
            error = np.array([(c.mu_error, c.I_error) for c in branch]).T
            axis.errorbar(
                [c.mu for c in branch],
                [c.I for c in branch],
                xerr=error[0],
                yerr=error[1],
                color=shape_colour(alpha),
                **style,
            )


def regimes(measures, path):
    """Fig. 3: where friction and normal damping dissipate equally, over friction and inertial number, a curve per
    shape; dotted: by the powers of Eq. 4, which lose part of the friction at high mu; dashed: I ~ mu^2. Inset: I_c at
    mu = 0.01 over the shape."""
    figure, axis = plt.subplots(figsize=(6.2, 4.6), constrained_layout=True)
    found = {kind: crossovers(measures, kind) for kind in kinds(measures)}
    for alpha in values_of(measures, "alpha"):
        draw_branches(axis, found["W"], alpha, marker=shape_marker(alpha), markersize=4, linewidth=1.2, elinewidth=0.8)
        draw_branches(axis, found.get("instant", []), alpha, linestyle=":", linewidth=0.9, elinewidth=0)
    axis.set(xlabel=r"friction coefficient $\mu_p$", ylabel=r"inertial number $I$")
    if not found["W"]:
        note(figure, "friction and normal damping are nowhere equal among these runs")
    else:
        roundest = min(values_of(measures, "alpha"), key=lambda alpha: abs(np.log(alpha)))
        middle = [c for c in found["W"] if c.sliding_above and c.alpha == roundest]
        if middle:
            factor = np.exp(np.mean([np.log(c.I / c.mu**2) for c in middle]))
            line = np.array([min(c.mu for c in middle), max(c.mu for c in middle)])
            axis.plot(line, factor * line**2, color="black", linestyle="--", linewidth=0.9)
        frictions = [mu for mu in values_of(measures, "mu") if mu > 0]
        axis.set(
            xscale="log",
            yscale="log",
            xlim=(0.7 * min(frictions), 1.4 * max(frictions)),
            ylim=(0.7 * min(m.inertial for m in measures), 1.6 * max(m.inertial for m in measures)),
        )
        if len({c.sliding_above for c in found["W"]}) == 2:
            for place, regime in ((0.08, "normal\ndissipation"), (0.56, "sliding"), (0.95, "rolling")):
                axis.text(place, 0.97, regime, transform=axis.transAxes, ha="center", va="top", fontsize=9, color="0.4")
        inset(axis, [c for c in found["W"] if c.sliding_above and c.I_error > 0 and abs(np.log(c.mu / 0.01)) < 1e-6])
    shape_legend(figure, measures)
    save(figure, path)


def inset(axis, slice_of):
    """The crossovers at one friction coefficient over the shape ratio."""
    if len(slice_of) < 2:
        return
    small = axis.inset_axes([0.44, 0.16, 0.24, 0.27])
    points(
        small,
        [shape_ratio(c.alpha) for c in slice_of],
        [(c.I, c.I_error) for c in slice_of],
        color="0.3",
        marker="o",
        markersize=3,
    )
    small.set_xlabel(r"$r_g$", fontsize=8, labelpad=1)
    small.set_title(r"$I_c$ at $\mu_p = 0.01$", fontsize=8)
    small.tick_params(labelsize=7)


def critical(measures, path):
    """Fig. 8: critical friction and solid fraction of the fits of Eqs. 5 and 6, over the aspect ratio; fits that tell
    mu_c within a fifth, phi_c within a twentieth of it."""
    figure, axes = plt.subplots(1, 2, figsize=(8.2, 3.4), constrained_layout=True)
    drawn = False
    panels = (("mu_c", r"critical friction $\mu_c$", 0.2), ("phi_c", r"critical solid fraction $\phi_c$", 0.05))
    for axis, (name, label, known) in zip(axes, panels):
        fitted = [(alpha, mu, pair) for alpha, mu, pair in critical_values(measures, name) if pair[1] < known * pair[0]]
        for mu in values_of(measures, "mu"):
            chosen = [(alpha, pair) for alpha, at, pair in fitted if at == mu]
            if chosen:
                points(axis, *zip(*chosen), color=friction_colour(mu), marker="o", label=friction_label(mu))
                drawn = True
        axis.set(xscale="log", xlabel=r"aspect ratio $\alpha$", ylabel=label)
        axis.set_xticks(values_of(measures, "alpha"), [f"{alpha:g}" for alpha in values_of(measures, "alpha")])
        axis.minorticks_off()
    if not drawn:
        note(figure, "the fits need four or more inertial numbers")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)


def finite_size(measures, path):
    """Fig. 14: effective friction and solid fraction against the inertial number for systems of different size."""
    groups = sizes(measures)
    figure, axes = plt.subplots(1, 2, figsize=(8.2, 3.4), constrained_layout=True)
    for number, ((alpha, mu, grains), runs) in enumerate(sorted(groups.items())):
        dashes = ["-", "--", ":", "-."][sorted({key[2] for key in groups if key[:2] == (alpha, mu)}).index(grains) % 4]
        for axis, name in zip(axes, ("mu_eff", "phi")):
            points(
                axis,
                [m.inertial for m in runs],
                [m[name] for m in runs],
                color=shape_colour(alpha),
                marker=shape_marker(alpha),
                linestyle=dashes,
                label=rf"$\alpha = {alpha:g}$, $\mu_p = {mu:g}$, $N = {grains:g}$",
            )
    for axis, label in zip(axes, (r"$\mu = \sigma_{xy}/P$", r"$\phi$")):
        axis.set(xlabel=r"inertial number $I$", ylabel=label)
        if groups:
            log_scale(axis.xaxis)
    if not groups:
        note(figure, "all these runs have one size for each shape")
    else:
        figure.legend(*axes[0].get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)
    save(figure, path)
