"""Colours, markers and layouts that the figures share."""

from contextlib import contextmanager

import matplotlib

matplotlib.use("Agg")
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D
import matplotlib.pyplot as plt
import numpy as np

RUN_COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00"]
FLAT = LinearSegmentedColormap.from_list("flat", ["#6BAED6", "#08306B"])
LONG = LinearSegmentedColormap.from_list("long", ["#FDAE61", "#A50026"])
SPHERE = "#333333"
MANY = 8

plt.rcParams.update(
    {
        "font.size": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.linewidth": 0.8,
        "axes.titlelocation": "left",
        "legend.frameon": False,
        "savefig.dpi": 160,
        "savefig.bbox": "tight",
    }
)


def shape_ratio(alpha):
    return (alpha - 1) / (alpha + 1)


def shape_colour(alpha):
    """Blue for flat grains, dark grey for spheres, red for long ones; the darker the farther from the sphere."""
    if alpha == 1:
        return SPHERE
    return (LONG if alpha > 1 else FLAT)(min(1.0, abs(shape_ratio(alpha)) / 0.5))


def shape_marker(alpha):
    return "D" if alpha == 1 else "o" if alpha > 1 else "s"


def friction_colour(mu):
    """From purple (no friction) to yellow (10), in steps of log10."""
    return plt.get_cmap("viridis")(0.92 * np.clip((np.log10(max(mu, 1e-4)) + 4) / 5, 0, 1))


def values_of(measures, name):
    """The different values of a parameter, ascending."""
    return sorted({getattr(m, name) for m in measures})


def with_value(measures, **wanted):
    """The runs with these parameters, sorted by shape and inertial number."""
    found = [m for m in measures if all(getattr(m, name) == value for name, value in wanted.items())]
    return sorted(found, key=lambda m: (m.alpha, m.I))


def nearest(measures, name, value):
    """The value of mu or I among the runs that is nearest to `value` on a logarithmic scale."""
    return min(values_of(measures, name), key=lambda found: abs(np.log(max(found, 1e-5) / value)))


def legible(measures, inertial=0.01, mu=None):
    """All runs, or of more than MANY those nearest to the inertial number (and the friction coefficient) that the
    paper's figure shows."""
    if len(measures) <= MANY:
        return measures
    kept = [m for m in measures if m.I == nearest(measures, "I", inertial)]
    return kept if mu is None else [m for m in kept if m.mu == nearest(kept, "mu", mu)]


def friction_label(mu):
    return rf"$\mu_p = {mu:g}$"


def shape_handle(alpha):
    return Line2D(
        [], [], color=shape_colour(alpha), marker=shape_marker(alpha), markersize=5, label=rf"$\alpha = {alpha:g}$"
    )


def shape_legend(figure, measures):
    """Legend of the shapes at the right of the figure."""
    figure.legend(
        handles=[shape_handle(alpha) for alpha in reversed(values_of(measures, "alpha"))],
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
    )


def points(axis, x, pairs, **style):
    """A curve through (mean, error) pairs."""
    means, errors = np.array(pairs).T
    style = {"markersize": 5, "linewidth": 1.2, "elinewidth": 0.8, "capsize": 2, "capthick": 0.8, **style}
    axis.errorbar(x, means, yerr=errors, **style)


def curves_by_shape(axis, measures, value):
    """`value` of each run that has it (not None) against the shape ratio, a curve per friction coefficient (and
    inertial number, where there are several)."""
    several = len(values_of(measures, "I")) > 1
    for mu in values_of(measures, "mu"):
        for number, inertial in enumerate(values_of(measures, "I")):
            found = [(m.r_g, value(m)) for m in with_value(measures, mu=mu, I=inertial)]
            found = [(r_g, pair) for r_g, pair in found if pair is not None]
            if not found:
                continue
            label = friction_label(mu) + (rf", $I = {inertial:g}$" if several else "")
            points(
                axis,
                *zip(*found),
                color=friction_colour(mu),
                marker="o",
                linestyle=["-", "--", ":", "-."][number % 4],
                label=label,
            )
    axis.axvline(0, color="0.85", linewidth=0.8, zorder=0)
    axis.set_xlim(-0.55, 0.55)


def log_scale(axis):
    """Makes an x or y axis logarithmic, spanning a factor of four or more, with about four labels."""
    which = axis.axis_name
    getattr(axis.axes, f"set_{which}scale")("log")
    low, high = axis.get_view_interval()
    if high < 4 * low:
        low, high = np.sqrt(low * high) * np.array([0.5, 2.0])
    getattr(axis.axes, f"set_{which}lim")(low, high)
    for digits in ((1, 2, 3, 5), (1, 2, 5), (1, 3), (1,)):
        ticks = [
            digit * 10.0**power for power in range(-9, 10) for digit in digits if low <= digit * 10.0**power <= high
        ]
        if len(ticks) <= 6:
            break
    axis.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    axis.set_ticks([], minor=True)


def curves_by_inertia(axis, measures, value):
    """`value` of each run against the inertial number reached, a curve per shape."""
    for alpha in values_of(measures, "alpha"):
        runs = with_value(measures, alpha=alpha)
        points(
            axis,
            [m.inertial for m in runs],
            [value(m) for m in runs],
            color=shape_colour(alpha),
            marker=shape_marker(alpha),
        )
    reached = [m.inertial for m in measures]
    axis.set_xlim(0.6 * min(reached), 1.7 * max(reached))
    log_scale(axis.xaxis)


def friction_grid(measures, rows, width=3.2, height=2.6, **options):
    """Figure and axes (rows, columns): one column per friction coefficient, titled; and the runs of each column."""
    frictions = values_of(measures, "mu")
    figure, axes = plt.subplots(
        rows,
        len(frictions),
        figsize=(width * len(frictions) + 1.2, height * rows),
        squeeze=False,
        constrained_layout=True,
        sharex="row",
        sharey="row",
        **options,
    )
    for axis, mu in zip(axes[0], frictions):
        axis.set_title(friction_label(mu))
    return figure, axes, [with_value(measures, mu=mu) for mu in frictions]


_marks = []


@contextmanager
def marked(text):
    """Figures that are saved in the block carry the text on top, unless it is empty."""
    _marks.append(text)
    try:
        yield
    finally:
        _marks.pop()


def save(figure, path):
    if _marks and _marks[-1]:
        figure.text(0.5, 1.01, _marks[-1], ha="center", va="bottom", color="#B22222", fontweight="bold")
    figure.savefig(path)
    plt.close(figure)
