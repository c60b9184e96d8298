"""Figures of the paper about correlations and contacts: 9, 10, 11, 12 and 17, and two it tells in words: layering and
memory. Each takes the steady runs and a path."""

from matplotlib.colors import LogNorm, Normalize
from matplotlib.ticker import NullFormatter
import matplotlib.pyplot as plt
import numpy as np

from grainscope.figures.style import (
    curves_by_shape,
    friction_grid,
    legible,
    save,
    shape_colour,
    shape_legend,
    shape_marker,
    values_of,
)
from grainscope.fits import fit_decay


def label_of(m, measures):
    """The run's parameters as far as they differ among the runs."""
    parts = [rf"$\alpha = {m.alpha:g}$"]
    if len(values_of(measures, "mu")) > 1:
        parts.append(rf"$\mu_p = {m.mu:g}$")
    if len(values_of(measures, "I")) > 1:
        parts.append(rf"$I = {m.I:g}$")
    return ", ".join(parts)


def line_style(m, measures):
    """Colour by shape; dashes by friction and inertial number."""
    kinds = sorted({(other.mu, other.I) for other in measures})
    return {"color": shape_colour(m.alpha), "linestyle": ["-", "--", ":", "-."][kinds.index((m.mu, m.I)) % 4]}


def correlations(measures, path):
    """Fig. 9: C(r) of the velocity along the gradient with its exponential, and the correlation length against the
    shape."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.2, 3.3), constrained_layout=True)
    shown = legible(measures, inertial=0.1, mu=0.4)
    for m in shown:
        r, c = m.curves["correlation"]["r"], m.curves["correlation"]["vy"]
        style = line_style(m, shown)
        left.plot(
            r,
            c,
            color=style["color"],
            marker=shape_marker(m.alpha),
            markersize=4,
            linestyle="none",
            label=label_of(m, shown),
        )
        length = m.means.get("l_vy", (0.0, 0.0))[0]
        if length > 0:
            line = np.linspace(0, r.max(), 100)
            left.plot(line, np.exp(-line / length), linewidth=0.9, color=style["color"], linestyle="--")
    left.axhline(0, color="0.6", linewidth=0.8)
    left.set(xlabel=r"$r\,/\,d_{eq}$", ylabel=r"$\tilde{C}(r)$", ylim=(-0.25, 1.02), xlim=(0, None))
    curves_by_shape(right, legible(measures, inertial=0.1), lambda m: m.means.get("l_vy"))
    right.set(xlabel=r"shape ratio $r_g$", ylabel=r"$\ell\,/\,d_{eq}$", ylim=(0, None))
    right.legend(fontsize=8, loc="best")
    figure.legend(*left.get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)


def fabric(measures, path):
    """Fig. 10: the two eigenvectors of the fabric in the plane of shear, as long as their eigenvalues."""
    measures = legible(measures)
    figure, axes, columns = friction_grid(measures, 1, width=4.2, height=4.2)
    limit = 1.1 * max(m.fabric_axes()[0][0] for m in measures)
    for axis, runs in zip(axes[0], columns):
        for angle in (-45, 45):
            end = limit * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
            axis.plot([-end[0], end[0]], [-end[1], end[1]], color="0.85", linewidth=0.8, zorder=0)
        for m in runs:
            values, vectors = m.fabric_axes()
            for value, (x, y), width in zip(values, vectors, (2.0, 1.2)):
                axis.plot(
                    [-value * x, value * x],
                    [-value * y, value * y],
                    linewidth=width,
                    marker=shape_marker(m.alpha),
                    markersize=4,
                    **line_style(m, runs),
                )
        axis.set(xlim=(-limit, limit), ylim=(-limit, limit), aspect="equal", xlabel=r"flow $x$")
        add_reciprocals(axis, runs)
    axes[0, 0].set_ylabel(r"gradient $y$")
    shape_legend(figure, measures)
    save(figure, path)


def add_reciprocals(axis, runs):
    """Below the axis, for shapes alpha and 1/alpha: the angle between their largest eigenvectors, and the ratio of the
    eigenvalues, long over flat."""
    texts = []
    for prolate in (m for m in runs if m.alpha > 1):
        for oblate in (m for m in runs if m.alpha < 1 and m.I == prolate.I and abs(m.alpha * prolate.alpha - 1) < 0.02):
            (long, *_), (first, _) = prolate.fabric_axes()
            (flat, *_), (second, _) = oblate.fabric_axes()
            angle = np.degrees(np.arccos(min(1.0, abs(first @ second))))
            texts.append(
                rf"$\alpha$ = {prolate.alpha:g}, {oblate.alpha:g}: $\eta$ = {angle:.1f}°, "
                rf"$\lambda^p/\lambda^o$ = {long / flat:.2f}"
            )
    axis.set_xlabel("\n".join([axis.get_xlabel(), *texts]))


def polar_panels(titles, measures, height=3.6):
    """A row of polar axes and their runs' legend on the right."""
    figure, axes = plt.subplots(
        1, len(titles), figsize=(3.7 * len(titles), height), subplot_kw={"projection": "polar"}, constrained_layout=True
    )
    for axis, title in zip(axes, titles):
        axis.set_title(title, pad=18, loc="center")
        axis.grid(color="0.85", linewidth=0.6)
        axis.spines["polar"].set_color("0.7")
        axis.tick_params(labelsize=8, colors="0.35")
    return figure, axes


def mirrored(psi, values, left, right):
    """Steps over the bins of psi in (0, pi/2), mirrored to -psi and pi - psi: angles and radii of the right half, the
    left half, or both."""
    edges = np.linspace(0, np.pi, 2 * len(psi) + 1)
    both = np.concatenate([values, values[::-1]])
    angles = np.linspace(edges[:-1], edges[1:], 9, axis=1).ravel()
    radii = np.repeat(both, 9)
    if left and right:
        return np.concatenate([angles, angles + np.pi]), np.concatenate([radii, radii[::-1]])
    return (angles, radii) if right else (-angles, radii)


def surface(measures, path):
    """Fig. 11: contact density, normal and tangential force on the grain by the angle to its symmetry axis (upward).
    With flat and long grains together, flat ones are drawn on the left, long ones on the right, spheres on both sides.
    The density is drawn twice, over the exact areas of the bins and over the area element that the paper prints."""
    titles = [
        r"$\rho_s A_p$",
        r"$\rho_s A_p$, area as printed",
        r"$\overline{F}_n\,/\,PA_p$",
        r"$\overline{F}_t\,/\,PA_p$",
    ]
    measures = legible(measures, mu=0.4)
    figure, axes = polar_panels(titles, measures)
    kinds = {np.sign(m.r_g) for m in measures}
    split = {-1.0, 1.0} <= kinds
    for m in measures:
        table = m.curves["surface"]
        for axis, name in zip(axes, ("density", "printed density", "F_n", "F_t")):
            angles, radii = mirrored(
                table["psi"], table[name], left=not split or m.alpha <= 1, right=not split or m.alpha >= 1
            )
            axis.plot(angles, radii, linewidth=1.4, label=label_of(m, measures), **line_style(m, measures))
    for axis in axes:
        axis.set_theta_zero_location("N")
        axis.set_theta_direction(-1)
        axis.set_ylim(bottom=0)
        axis.set_thetagrids(range(0, 360, 30), ["axis", "", "", "" if split else "equator", *[""] * 8])
        few_circles(axis)
        if split:
            axis.set_xlabel("flat grains        long grains", fontsize=9)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)


def few_circles(axis):
    """About four labelled circles, away from the curves' usual peaks."""
    axis.yaxis.set_major_locator(plt.MaxNLocator(4, prune="lower"))
    axis.set_rlabel_position(22.5)


def directions(measures, path):
    """Fig. 17: contact normals by their angle to the flow in the plane of shear; density, normal and tangential
    force."""
    titles = [r"density $\rho(\beta)$", r"$\overline{F}_n\,/\,PA_p$", r"$\overline{F}_t\,/\,PA_p$"]
    measures = legible(measures, mu=0.4)
    figure, axes = polar_panels(titles, measures)
    for m in measures:
        table = m.curves["direction"]
        around = np.append(table["beta"], table["beta"][0] + 2 * np.pi)
        for axis, name in zip(axes, ("density", "F_n", "F_t")):
            axis.plot(
                around,
                np.append(table[name], table[name][0]),
                linewidth=1.2,
                label=label_of(m, measures),
                **line_style(m, measures),
            )
    for axis in axes:
        axis.set_ylim(bottom=0)
        few_circles(axis)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)


def grain_picture(alpha, values, pixels=360, tilt=25.0):
    """The value at the grain's surface by the polar angle to its axis, as an image (nan outside the grain), its extent
    over d_eq. The view is along the plane of shear's normal, tilted; the axis is upright in flat grains and lies in
    long ones."""
    a, c = alpha ** (-1 / 3) / 2, alpha ** (2 / 3) / 2
    reach = 1.02 * max(a, c)
    u, v = np.meshgrid(np.linspace(-reach, reach, pixels), np.linspace(-reach, reach, pixels))
    along, across = (u, v) if alpha > 1 else (v, u)
    # The ray (along, across, s) in a body frame whose axis is tilted toward the viewer.
    cosine, sine = np.cos(np.radians(tilt)), np.sin(np.radians(tilt))
    # z = along cosine + s sine,  x = -along sine + s cosine,  y = across:  quadratic in s
    q = (cosine / a) ** 2 + (sine / c) ** 2
    half = along * sine * cosine * (1 / c**2 - 1 / a**2)
    rest = (along * sine / a) ** 2 + (across / a) ** 2 + (along * cosine / c) ** 2 - 1
    discriminant = half**2 - q * rest
    s = (-half + np.sqrt(np.maximum(discriminant, 0))) / q
    z = along * cosine + s * sine
    radius = np.hypot(-along * sine + s * cosine, across)
    psi = np.arctan2(radius, np.abs(z))
    bins = np.minimum((psi / (np.pi / 2) * len(values)).astype(int), len(values) - 1)
    return np.where(discriminant > 0, values[bins], np.nan), reach


def surface_maps(measures, path):
    """Fig. 12: friction mobilisation, and inhomogeneity of the dissipated power, on the grains; the latter over the
    exact areas and over those of the area element that the paper prints."""
    measures = legible(measures, mu=0.4)
    figure, axes = plt.subplots(
        3, len(measures), figsize=(1.7 * len(measures) + 1.6, 4.4), squeeze=False, constrained_layout=True
    )
    tables = [m.curves["surface"] for m in measures]
    shares = np.concatenate([table[name] for table in tables for name in ("inhomogeneity", "printed inhomogeneity")])
    limit = max(2.0, shares.max(), 1 / max(shares[shares > 0].min(initial=1.0), 0.05))
    mobilised = (
        0.95 * min(table["mobilisation"].min() for table in tables),
        max(table["mobilisation"].max() for table in tables) or 1,
    )
    rows = [
        ("mobilisation", r"mobilisation $\mathcal{M}$", Normalize(*mobilised), "viridis"),
        ("inhomogeneity", r"inhomogeneity $\mathcal{I}$", LogNorm(1 / limit, limit), "RdBu_r"),
        ("printed inhomogeneity", "$\\mathcal{I}$, area as printed", LogNorm(1 / limit, limit), "RdBu_r"),
    ]
    widest = max(1.05 * max(m.alpha ** (-1 / 3), m.alpha ** (2 / 3)) / 2 for m in measures)
    for row, (name, label, norm, colours) in zip(axes, rows):
        for axis, m, table in zip(row, measures, tables):
            values = np.maximum(table[name], norm.vmin)
            picture, reach = grain_picture(m.alpha, values)
            image = axis.imshow(
                picture,
                norm=norm,
                cmap=colours,
                extent=[-reach, reach, -reach, reach],
                origin="lower",
                interpolation="nearest",
            )
            axis.set(xlim=(-widest, widest), ylim=(-0.56, 0.56))
            axis.axis("off")
        bar = figure.colorbar(image, ax=list(row), label=label, shrink=0.85)
        if isinstance(norm, LogNorm):
            ticks = [tick for tick in (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20) if 1 / limit <= tick <= limit]
            bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
            bar.ax.yaxis.set_minor_formatter(NullFormatter())
            bar.ax.minorticks_off()
    for axis, m in zip(axes[0], measures):
        axis.set_title(label_of(m, measures).replace(", ", "\n"), loc="center", fontsize=9)
    save(figure, path)


def memory(measures, path):
    """How long a grain's velocity along the gradient lasts, in strain, with the exponential."""
    measures = legible(measures, mu=0.4)
    figure, axis = plt.subplots(figsize=(4.6, 3.3), constrained_layout=True)
    for m in measures:
        strain, c = m.curves["memory"]["lag"], m.curves["memory"]["vy"]
        axis.plot(
            strain,
            c,
            marker=shape_marker(m.alpha),
            markersize=3,
            linewidth=1.0,
            label=label_of(m, measures),
            **line_style(m, measures),
        )
        length = fit_decay(strain[1:], c[1:])[0]
        if length > 0:
            axis.plot(strain, np.exp(-strain / length), color=shape_colour(m.alpha), linewidth=0.8, linestyle="--")
    axis.axhline(0, color="0.6", linewidth=0.8)
    axis.set(
        xlim=(0, None),
        xlabel=r"strain difference",
        ylabel=r"$\langle\delta v_y(0)\,\delta v_y(\gamma)\rangle\,/\,\langle\delta v_y^2\rangle$",
    )
    figure.legend(*axis.get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)


def layering(measures, path):
    """Correlation of the density of centres across the gradient: no layers where it decays at once."""
    measures = legible(measures, mu=0.4)
    figure, axis = plt.subplots(figsize=(4.6, 3.3), constrained_layout=True)
    for m in measures:
        axis.plot(
            m.curves["layering"]["y"],
            m.curves["layering"]["C"],
            marker=shape_marker(m.alpha),
            markersize=3,
            linewidth=1.0,
            label=label_of(m, measures),
            **line_style(m, measures),
        )
    axis.axhline(0, color="0.6", linewidth=0.8)
    axis.set(xlabel=r"$y\,/\,d_{eq}$", ylabel=r"$C(y)\,/\,C(0)$", xlim=(0, None))
    figure.legend(*axis.get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, path)
