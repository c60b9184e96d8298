"""Cost of a study's runs, as they were measured, and of the paper's whole grid and of a million grains by the cost
model: Markdown tables."""
import numpy as np

from grainscope.study.cost_model import PAPER, classical_cost_of_grid, cost_of_grid, memory_of, seconds_of, step_seconds
from grainscope.study.table import coverage, read_study


def measured(runs):
    """A row for each shape and size: core time of a grain's step at the lowest and highest solid fraction, memory and
    files of a run."""
    rows = [
        "| alpha | N | runs | phi | core us per grain and step | memory per rank [MB] | files per run [MB] |",
        "|---|---|---|---|---|---|---|",
    ]
    for alpha, grains in sorted({(run.alpha, run.parameters["N"]) for run in runs}):
        line = sorted(
            (
                run
                for run in runs
                if run.alpha == alpha and run.parameters["N"] == grains and "grain_step" in run.parameters
            ),
            key=lambda run: run["phi"][0],
        )
        if not line:
            continue
        phi, time, memory, files = np.array(
            [
                [
                    run["phi"][0],
                    1e6 * run.parameters["grain_step"],
                    run.parameters["memory"] / 1e6,
                    run.parameters["bytes"] / 1e6,
                ]
                for run in line
            ]
        ).T
        quarter = max(1, len(line) // 4)
        rows.append(
            f"| {alpha:g} | {grains:g} | {len(line)} | {phi[0]:.2f} to {phi[-1]:.2f} | {np.median(time):.2f} "
            f"({np.median(time[:quarter]):.2f} to {np.median(time[-quarter:]):.2f}) | {memory.max():.0f} | "
            f"{np.median(files):.1f} |"
        )
    return rows


def predicted():
    """The paper's grid, by the model, and the classical way."""
    ways = {"grainscope": cost_of_grid(**PAPER), "dumps, read afterwards": classical_cost_of_grid(**PAPER)}
    grid = f"{ways['grainscope'].runs} runs, N = {PAPER['grains']}, strain {PAPER['strain']}"
    return [
        f"| the paper's grid: {grid} | core-hours | GB written |",
        "|---|---|---|",
        *(f"| {way} | {cost.core_hours:.0f} | {cost.gigabytes:.0f} |" for way, cost in ways.items()),
    ]


def scaled(grains=1_000_000, alpha=1.5, inertial=0.1, strain=16):
    """A large run on more and more ranks, by the model."""
    rows = [
        f"| {grains:,} grains, alpha = {alpha:g}, I = {inertial:g}, strain {strain:g}: ranks | ms per step | "
        "hours | core-hours | GB per rank |",
        "|---|---|---|---|---|",
    ]
    for ranks in (1, 16, 64, 256, 1024):
        step = step_seconds(alpha, inertial, grains, ranks)
        hours = seconds_of(alpha, inertial, grains, strain, ranks) / 3600
        rows.append(
            f"| {ranks} | {1e3 * step:.3g} | {hours:.3g} | {hours * ranks:.3g} | "
            f"{memory_of(grains, ranks) / ranks / 1e9:.2g} |"
        )
    return rows


def add_arguments(parser):
    parser.add_argument("study", help="folder of table.csv and curves")


def run(arguments):
    runs = read_study(arguments.study)
    hours = sum(run.parameters.get("core_time", 0.0) for run in runs) / 3600
    print(
        *measured(runs),
        "",
        f"{coverage(arguments.study)}: {hours:.2f} core-hours.",
        "",
        *predicted(),
        "",
        *scaled(),
        sep="\n",
    )
