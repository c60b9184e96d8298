#!/usr/bin/python3
"""Where the energy of sheared spheroids goes, and whether the ledger closes: bench/in.closure for every combination
given, as a Markdown table in percent of D_n + D_t, for the stretch under pressure control and the one at constant
volume. The last two columns are the error of the time step (G_dt) and the residual."""
import argparse
import itertools
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
from grainscope.open_mpi import session  # noqa: E402

DECK = pathlib.Path(__file__).resolve().parent / "in.closure"
COLUMNS = (
    "W_shear",
    "W_box",
    "W_frame",
    "W_other",
    "D_n",
    "D_t",
    "G_k",
    "G_p",
    "G_n",
    "G_open",
    "G_dt",
    "U_n",
    "U_t",
    "K_tr",
    "K_rot",
    "residual",
)
SHOWN = ("W_shear", "W_box", "W_frame", "W_other", "D_n", "G_k", "G_p", "G_n", "G_open", "G_dt", "residual")


def ledgers(binary, variables, ranks):
    """The last rows of the two stretches."""
    command = [str(binary), "-in", str(DECK), "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(ranks), *command]
    with tempfile.TemporaryDirectory() as folder, session() as environment:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", env=environment)
    if done.returncode:
        raise SystemExit(f"the run failed: {' '.join(command)}\n{done.stdout[-2000:]}")
    rows = [line.split() for line in done.stdout.splitlines()]
    rows = [row for row in rows if len(row) == 1 + len(COLUMNS) and row[0].isdigit()]
    return [dict(zip(COLUMNS, map(float, rows[k][1:]))) for k in (1, 3)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("--alpha", type=float, nargs="+", default=[0.33, 1.0, 1.5, 3.0])
    parser.add_argument("--mu", type=float, nargs="+", default=[0.0, 0.4, 10.0])
    parser.add_argument("--grains", type=int, default=500)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--set", nargs="*", default=[], help="further variables of the deck, name=value")
    arguments = parser.parse_args()
    print(f"| N | ranks | alpha | mu_p | stretch | {' | '.join(SHOWN)} |\n|" + "---|" * (len(SHOWN) + 5), flush=True)
    more = dict(item.split("=") for item in arguments.set)
    for alpha, mu in itertools.product(arguments.alpha, arguments.mu):
        both = ledgers(
            arguments.binary.resolve(), {"N": arguments.grains, "alpha": alpha, "mu": mu, **more}, arguments.ranks
        )
        for stretch, row in zip(("pressure", "volume"), both):
            unit = (row["D_n"] + row["D_t"]) / 100.0
            print(
                f"| {arguments.grains} | {arguments.ranks} | {alpha:g} | {mu:g} | {stretch} | "
                + " | ".join(f"{row[name] / unit:.2g}" for name in SHOWN)
                + " |",
                flush=True,
            )


if __name__ == "__main__":
    main()
