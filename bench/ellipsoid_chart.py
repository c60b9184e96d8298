#!/usr/bin/python3
"""What a contact of two ellipsoids costs and how exact it is: LIGGGHTS's superquadric routines and the ellipsoid
kernel, on the same pairs.

Tables in Markdown from the programs ellipsoid_kernel and ellipsoid_accuracy, and a chart. Each time is the quickest of
several repetitions in random order: what other work on the machine leaves whole.
"""
import argparse
import json
import pathlib
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = pathlib.Path(__file__).resolve().parent
INK, COLOURS = "#333333", {"liggghts": "#c05a1c", "spheroids": "#1f4e79", "side_by_side": "#2e8b57"}
ALPHAS = (0.05, 0.33, 0.67, 1, 1.5, 3, 20)
CHARTED = (0.33, 1.5, 3)
OWN, DEFAULT = 1e-10, 3e-5
WHO = {
    "liggghts": "LIGGGHTS",
    "spheroids": "spheroids",
    "side_by_side": "spheroids, side by side",
    "triaxial": "triaxial",
}


def measure(program, repetitions):
    """(who, situation, warm or cold, alpha, tolerance or None) -> ns, largest and rms error of the point."""
    command = [
        str(program),
        "--benchmark_format=json",
        f"--benchmark_repetitions={repetitions}",
        "--benchmark_enable_random_interleaving=true",
    ]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
    found = {}
    for run in json.loads(done.stdout)["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        who, situation, start, alpha, *rest = run["name"].split("/")
        tolerance = next((float(part.split(":")[1]) for part in rest if part.startswith("tolerance")), None)
        key = who, situation, start, float(alpha.split(":")[1]), tolerance
        ns = 1e9 * run["pair"]
        if key not in found or ns < found[key][0]:
            found[key] = ns, run.get("point_max"), run.get("point_rms")
    return found


def times(found):
    situations = [
        (situation, start) for situation in ("touching", "near_miss", "rejected") for start in ("warm", "cold")
    ]
    print(
        "\n| alpha | by | "
        + " | ".join(f"{situation.replace('_', ' ')}, {start}" for situation, start in situations)
        + " |"
    )
    print("|---" * (2 + len(situations)) + "|")
    for alpha in ALPHAS:
        for who, name in WHO.items():
            row = [found[who, situation, start, float(alpha), None][0] for situation, start in situations]
            print(
                f"| {alpha:g} | {name} | "
                + " | ".join(f"{ns:.0f}" if ns < 1000 else f"{1e-3 * ns:.1f}e3" for ns in row)
                + " |"
            )


def chart(found, file):
    plt.rcParams.update(
        {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": INK, "text.color": INK}
    )
    figure, panels = plt.subplots(1, len(CHARTED), figsize=(12.5, 4.2), layout="constrained", sharey=True, sharex=True)
    for axes, alpha in zip(panels, CHARTED):
        for who, own in (("liggghts", OWN), ("spheroids", DEFAULT)):
            series = sorted(
                (key[4], *value)
                for key, value in found.items()
                if key[:4] == (who, "touching", "warm", alpha) and key[4]
            )
            ns = [point[1] for point in series]
            for column, style, word in ((2, "-", "largest"), (3, ":", "rms")):
                axes.loglog(
                    ns,
                    [point[column] for point in series],
                    style,
                    marker="o",
                    markersize=3,
                    color=COLOURS[who],
                    linewidth=1,
                    label=f"{WHO[who]}, {word}",
                )
            for tolerance, x, largest, _ in series:
                if tolerance == own or tolerance in (1e-2, 1e-20, 1e-1):
                    text = f"{tolerance:.0e}".replace("e-0", "e-") + (" (default)" if tolerance == own else "")
                    axes.annotate(
                        text, (x, largest), (5, 4), textcoords="offset points", color=COLOURS[who], fontsize=8
                    )
            mark = found[who, "touching", "warm", alpha, own]
            axes.plot(mark[0], mark[1], "o", markersize=9, markerfacecolor="none", markeredgecolor=COLOURS[who])
        ns, largest, rms = found["side_by_side", "touching", "warm", alpha, None]
        axes.plot(ns, largest, "*", markersize=11, color=COLOURS["side_by_side"], label="side by side, largest")
        axes.set(title=f"aspect ratio {alpha:g}", xlabel="time of one contact [ns]", xlim=(14, 1500))
        axes.set_xticks([20, 50, 100, 200, 500, 1000], labels=["20", "50", "100", "200", "500", "1000"])
        axes.minorticks_off()
    panels[0].set(ylabel="error of the contact point / smallest semi-axis", ylim=(1e-17, 1e-1))
    panels[0].legend(frameon=False, fontsize=8, loc="center left")
    figure.savefig(file, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="where the two programs are: <build>/bench")
    parser.add_argument("--repetitions", type=int, default=9)
    parser.add_argument("--pairs", type=int, default=20000, help="of each line of the table of errors")
    parser.add_argument("--by-overlap", action="store_true", help="a line for each overlap")
    parser.add_argument("--chart", type=pathlib.Path, default=HERE.parent / "doc" / "images" / "ellipsoid_accuracy.png")
    arguments = parser.parse_args()
    found = measure(arguments.folder / "ellipsoid_kernel", arguments.repetitions)
    times(found)
    chart(found, arguments.chart)
    accuracy = [
        str(arguments.folder / "ellipsoid_accuracy"),
        str(arguments.pairs),
        *(["overlap"] if arguments.by_overlap else []),
    ]
    print("\n" + subprocess.run(accuracy, stdout=subprocess.PIPE, text=True, check=True).stdout)


if __name__ == "__main__":
    main()
