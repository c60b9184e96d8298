#!/usr/bin/python3
"""Errors against known solutions for a range of time steps: the problems of tests/cases/verification_*.py, as tables in
doc/verification.md and as doc/images/verification.png. Two minutes."""
import argparse
import importlib
import os
import pathlib
import re
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / folder) for folder in ("tools", "tests/tools", "tests", "tests/cases")]
from grainscope.figures.style import plt  # noqa: E402
import numpy as np  # noqa: E402
from verification import FLOOR, SWEEP, order_of  # noqa: E402
import verification_friction as friction  # noqa: E402

PAGE, CHART = ROOT / "doc" / "verification.md", ROOT / "doc" / "images" / "verification.png"
PARTS = ("normal", "friction", "forces", "spheroids")
COLUMNS = (0.2, 0.1, 0.05, 0.0125)
# What the panels show: problem and quantity, and the orders that guide the eye.
PANELS = {
    "contacts with a dashpot": (
        (1,),
        {
            "bounces-hooke": ["heights"],
            "bounces-hertz": ["heights"],
            "restitution-hooke": ["restitution", "duration"],
            "restitution-hertz": ["restitution", "duration"],
            "head-on-hertz": ["velocities after"],
            "stacked-hertz": ["heights"],
        },
    ),
    "elastic contacts of spheres": (
        (2, 3.5),
        {
            "elastic-impact-of-equal-spheres": ["largest overlap", "largest force", "speed after", "duration"],
            "bounces-hertz-elastic": ["heights"],
            "stacked-hertz-elastic": ["heights"],
        },
    ),
    "friction, rolling friction, drag": (
        (1, 2),
        {
            "slip-to-roll": ["time"],
            "oblique-on-a-plane": ["spin"],
            "oblique-damped": ["spin"],
            "oblique-damped-along-the-normal": ["spin"],
            "oblique-of-two-spheres": ["velocities"],
            "spin-down-epsd2": ["spin"],
            "spin-down-cdt": ["spin at rest"],
            "settling": ["velocity"],
        },
    ),
    "spheroids": (
        (2, 2.5),
        {
            "elastic-impact-prolate-poles": ["largest overlap", "duration"],
            "elastic-impact-oblate-edge-on-prolate-pole": ["largest overlap"],
            "leaning-prolate": ["velocity after", "spin after"],
            "leaning-oblate": ["velocity after"],
            "precession-superquadric": ["precession rate", "tilt of the axis"],
        },
    ),
}


def measure(part):
    """(problem, errors by quantity) by the problem's name."""
    problems = importlib.import_module(f"verification_{part}").PROBLEMS
    made = {name: make() for name, make in problems.items()}
    return {name: (problem, problem.sweep(SWEEP)) for name, problem in made.items()}


def table(found):
    lines = ["| problem | quantity | " + " | ".join(f"dt = {f:g} T_R" for f in COLUMNS) + " | order | expected |"]
    lines.append("|" + "---|" * (len(COLUMNS) + 4))
    for problem, errors in found.values():
        for quantity, values in errors.items():
            cells = [f"{values[SWEEP.index(f)]:.1e}".replace("e-0", "e-") for f in COLUMNS]
            expected = problem.bounds[quantity].order
            orders = [f"{order_of(problem, SWEEP, values):.2f}", f"{expected:g}"] if expected else ["", "exact"]
            lines.append(f"| {problem.title} | {quantity} | " + " | ".join([*cells, *orders]) + " |")
    return "\n".join(lines)


def rebound_table():
    """Measured and computed values of Kharaz, Gorham & Salman's impacts."""
    lines = ["| quantity | angle [degrees] | measured | computed | rigid sliding |", "|---|---|---|---|---|"]
    for k, (name, (angles, measured)) in enumerate(friction.MEASURED.items()):
        computed, rigid = friction.rebounds(angles)[k], friction.rigid_sliding(angles)[k]
        for row in zip(angles, measured, computed, rigid):
            slides = f"{row[3]:.3g}" if row[0] >= friction.SLIDES_FROM else ""
            lines.append(f"| {name} | {row[0]:.1f} | {row[1]:.3g} | {row[2]:.3g} | {slides} |")
    return "\n".join(lines)


def excess_table():
    """Friction of a sliding impact over Coulomb's, by restitution and settings of the law."""
    lines = [
        "| e | " + " | ".join(f"`{extra}`" if extra else "LIGGGHTS's defaults" for extra in friction.SETTINGS) + " |"
    ]
    lines.append("|" + "---|" * (1 + len(friction.SETTINGS)))
    for e in friction.RESTITUTIONS:
        ratios = [friction.excess(e, extra) for extra in friction.SETTINGS]
        lines.append(f"| {e:g} | " + " | ".join(f"{ratio:.3f}" for ratio in ratios) + " |")
    return "\n".join(lines)


def insert(text, name, made):
    """What stands between the page's two marks of that name is replaced."""
    return re.sub(rf"(<!-- {name} -->\n).*?(<!-- end -->)", lambda m: f"{m[1]}{made}\n{m[2]}", text, flags=re.S)


def draw(found):
    figure, panels = plt.subplots(2, 2, figsize=(11.0, 13.0), layout="constrained")
    for axes, (title, (guides, shown)) in zip(panels.flat, PANELS.items()):
        top = 0.0
        for name, quantities in shown.items():
            problem, errors = found[name]
            for quantity in quantities:
                seen = errors[quantity] > FLOOR
                top = max(top, errors[quantity].max())
                label = f"{problem.title}: {quantity}"
                axes.loglog(np.array(SWEEP)[seen], errors[quantity][seen], marker="o", markersize=3, label=label)
        for order in guides:
            axes.loglog(SWEEP, 2.0 * top * (np.array(SWEEP) / SWEEP[0]) ** order, "--", color="0.6", linewidth=0.8)
            axes.annotate(
                f"$dt^{{{order:g}}}$",
                (SWEEP[-1], 2.0 * top * (SWEEP[-1] / SWEEP[0]) ** order),
                color="0.4",
                va="bottom",
            )
        axes.set(title=title, xlabel=r"$dt/T_R$", ylabel="relative error", ylim=(FLOOR, None))
        axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(0.0, -0.13))
    figure.savefig(CHART, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    os.environ["GRAINSCOPE_BINARY"] = str(parser.parse_args().binary.resolve())
    with tempfile.TemporaryDirectory() as scratch:
        os.environ["GRAINSCOPE_SCRATCH"] = scratch
        found = {part: measure(part) for part in PARTS}
        rebounds, excess = rebound_table(), excess_table()
    text = PAGE.read_text()
    for part in PARTS:
        text = insert(text, part, table(found[part]))
    PAGE.write_text(insert(insert(text, "rebounds", rebounds), "excess", excess))
    draw({name: both for of_part in found.values() for name, both in of_part.items()})


if __name__ == "__main__":
    main()
