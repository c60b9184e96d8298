"""The figures of Bilotto, Trulsson & Molinari (2025) for steady runs of examples/simple_shear with `measure all`, by
file name."""

from grainscope.figures import contacts
from grainscope.figures import flow
from grainscope.figures import grid
from grainscope.progress import progress
from grainscope.shear.measures import steady_run

FIGURES = {
    "fig02.png": flow.orientation,
    "fig04.png": flow.dissipation,
    "fig05.png": flow.fluctuations,
    "fig06.png": flow.lever,
    "fig07.png": flow.rheology,
    "fig09.png": contacts.correlations,
    "fig10.png": contacts.fabric,
    "fig11.png": contacts.surface,
    "fig12.png": contacts.surface_maps,
    "fig15.png": flow.normal_stress_differences,
    "fig16.png": flow.diffusion,
    "fig17.png": contacts.directions,
    "fig18.png": flow.stress_parts,
    "memory.png": contacts.memory,
    "layering.png": contacts.layering,
}
# Those that need many runs: a grid of friction coefficients and inertial numbers, or several sizes
GRID_FIGURES = {"fig03.png": grid.regimes, "fig08.png": grid.critical, "fig14.png": grid.finite_size}


def sorted_runs(measures):
    return sorted(measures, key=lambda m: (m.mu, m.I, m.alpha))


def draw_figures(runs, start, output):
    """Draws all figures of the runs that measured everything, sorted by shape; the paths."""
    measures = sorted_runs(steady_run(run, start) for run in progress(runs, "runs"))
    for name in progress(FIGURES, "figures"):
        FIGURES[name](measures, output / name)
    return [output / name for name in FIGURES]
