"""Pictures of simple-shear runs: series.png (what the flow does over strain) and dissipation.png (where its energy
goes); of runs with `-var measure all` also the figures of the paper, fig02.png to fig18.png, and memory.png and
layering.png."""
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from grainscope.errors import warn
from grainscope.figures.paper import draw_figures
from grainscope.figures.style import RUN_COLOURS
from grainscope.shear.output import add_run_arguments, read_run

NORMAL, FRICTION, INPUT = "#4477AA", "#EE9966", "#222222"
PANELS = [
    ("P", "pressure / target"),
    ("mu_eff", r"effective friction $\mu$"),
    ("phi", r"solid fraction $\phi$"),
    ("Z", "coordination $Z$"),
    ("S2", "nematic order $S_2$"),
    ("spin", r"$-2\,\langle\omega_z\rangle/\dot\gamma$"),
]


def running_mean(strain, values, width=0.25):
    """Mean over a window of `width` in strain, shorter at both ends."""
    half = max(1, int(round(0.5 * width / np.mean(np.diff(strain)))))
    sums = np.concatenate([[0.0], np.cumsum(values)])
    low = np.maximum(np.arange(len(values)) - half, 0)
    high = np.minimum(np.arange(len(values)) + half + 1, len(values))
    return (sums[high] - sums[low]) / (high - low)


def plot_series(runs, start, path):
    """Six quantities over strain: every row faint, its running mean on top, the steady mean dashed."""
    figure, axes = plt.subplots(3, 2, figsize=(9, 7.5), sharex=True, constrained_layout=True)
    for axis, (name, title) in zip(axes.flat, PANELS):
        for run, colour in zip(runs, RUN_COLOURS):
            rows, strain = run.steady(start), run["strain"]
            axis.plot(strain, run[name], color=colour, alpha=0.25, linewidth=0.7)
            axis.plot(strain, running_mean(strain, run[name]), color=colour, linewidth=1.6, label=run.name)
            axis.hlines(
                run[name][rows].mean(), strain[rows][0], strain[-1], color=colour, linewidth=1.0, linestyle=(0, (5, 3))
            )
        smooth = np.concatenate([run[name][run.steady(start)] for run in runs])
        spread = np.ptp(smooth)
        axis.set_ylim(max(0.0, smooth.min() - 0.6 * spread), smooth.max() + 0.3 * spread)
        axis.set_title(title, fontsize=10)
        axis.set_xlim(0, max(run["strain"][-1] for run in runs))
    for axis in axes[-1]:
        axis.set_xlabel(r"shear strain $\gamma$")
    figure.legend(
        *axes[0, 0].get_legend_handles_labels(), loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=len(runs)
    )
    figure.savefig(path)
    plt.close(figure)


def plot_dissipation(runs, start, path):
    """Per run the two losses stacked over strain under the power put in; on the right their steady means."""
    figure, axes = plt.subplots(
        1,
        len(runs) + 1,
        figsize=(4.2 * len(runs) + 2.2, 3.8),
        constrained_layout=True,
        sharey=True,
        gridspec_kw={"width_ratios": [3] * len(runs) + [0.9 + 0.4 * len(runs)]},
    )
    highest = 0.0
    for axis, run in zip(axes, runs):
        strain = run["strain"]
        smooth = {
            name: running_mean(strain, values)
            for name, values in (("n", run["W_n"]), ("t", run["W_t"]), ("in", run.injected))
        }
        axis.stackplot(
            strain,
            smooth["n"],
            smooth["t"],
            colors=[NORMAL, FRICTION],
            labels=["normal damping", "friction"],
            linewidth=0,
        )
        axis.plot(strain, smooth["in"], color=INPUT, linewidth=1.2, label="put in (shear and box)")
        axis.set_title(run.name)
        axis.set_xlabel(r"shear strain $\gamma$")
        axis.set_xlim(0, strain[-1])
        highest = max(highest, smooth["in"].max(), (smooth["n"] + smooth["t"]).max())
    axes[0].set_ylim(0, 1.05 * highest)
    axes[0].set_ylabel(r"power / ($\dot\gamma\,P\,\Omega$)")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=3)

    for place, run in enumerate(runs):
        rows = run.steady(start)
        normal, friction, put_in = run["W_n"][rows].mean(), run["W_t"][rows].mean(), run.injected[rows].mean()
        axes[-1].bar(place, normal, color=NORMAL, width=0.6)
        axes[-1].bar(place, friction, bottom=normal, color=FRICTION, width=0.6)
        axes[-1].hlines(put_in, place - 0.4, place + 0.4, color=INPUT, linewidth=1.2)
        for middle, part in ((0.5 * normal, normal), (normal + 0.5 * friction, friction)):
            axes[-1].text(
                place, middle, f"{100 * part / (normal + friction):.0f} %", ha="center", va="center", fontsize=9
            )
    axes[-1].set_xticks(range(len(runs)), [run.name for run in runs])
    axes[-1].set_xlim(-0.6, len(runs) - 0.4)
    axes[-1].set_title("steady mean")
    figure.savefig(path)
    plt.close(figure)


def draw_over_strain(runs, start, output):
    """series.png and dissipation.png, and their paths; neither when there are too many runs to tell apart."""
    if len(runs) > len(RUN_COLOURS):
        warn(f"{len(runs)} runs; series.png and dissipation.png are drawn for up to {len(RUN_COLOURS)}")
        return []
    plot_series(runs, start, output / "series.png")
    plot_dissipation(runs, start, output / "dissipation.png")
    return [output / "series.png", output / "dissipation.png"]


def add_arguments(parser):
    add_run_arguments(parser)
    parser.add_argument("--output", default=".", metavar="FOLDER", help="where the pictures go (default: here)")


def run(arguments):
    output = Path(arguments.output)
    output.mkdir(parents=True, exist_ok=True)
    runs = [read_run(folder) for folder in arguments.run]
    paths = draw_over_strain(runs, arguments.start, output)
    measured = [run for run in runs if run.measured_all]
    if measured:
        paths += draw_figures(measured, arguments.start, output)
    print(*paths, sep="\n")
