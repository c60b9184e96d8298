# SPDX-License-Identifier: GPL-2.0-or-later
"""`strain time` beyond whatever becomes of the host's own time, with slopes by numpy."""
from dataclasses import replace

import numpy as np

from case import main, require_close, require_equal
from deck import Deck, thermo
from grainscope.columns import outputs
from packing import dense_packing
from run import run


def time_goes_on(ranks):
    """`strain time` is the time that has passed: beyond a restart, steps of another length and steps that are
    numbered anew, which the host's own time does not survive."""
    packing = dense_packing(atom_style="sphere", speed=8.0, overlap=-0.05)
    deck, memory, moved = Deck(packing), outputs("velocity/memory").of("m"), outputs("displacement/shear").of("d")
    dt, step, lag = deck.dt(), 5, 2
    lines = [
        "compute d all displacement/shear strain time",
        f"compute m all velocity/memory strain time every {5 * dt:.17g} lags 3",
        *thermo(step, *moved.vector(), *memory.vector(), memory[lag + 1, "lag"]),
    ]

    def check(blocks, lengths, what):
        """`blocks` of the runs, `lengths` of their steps over dt; runs repeat the last line of the run before."""
        time, square, end = [], [], 0.0
        for block, length in zip(blocks, lengths):
            passed = end + dt * length * (block["step"] - block["step"][0])
            begin = 1 if time else 0
            time += list(passed[begin:])
            square += list(block[moved["d2_y"]][begin:])
            end = passed[-1]
        last = {name: values[-1] for name, values in blocks[-1].items()}
        require_close(last[moved["strain"]], end, 1e-13, f"{what}: time")
        require_close(last[moved["D_y"]], 0.5 * np.polyfit(time, square, 1)[0], 1e-9, f"{what}: D_y")
        require_equal(last[memory["samples"]], len(time), f"{what}: samples")
        lags = np.subtract(time[lag:], time[:-lag])
        require_close(last[memory[lag + 1, "lag"]], lags.mean(), 1e-12, f"{what}: mean lag")

    for between, length in (
        (["reset_timestep 0"], 1),
        (["reset_timestep 1000"], 1),
        ([f"timestep {2 * dt:.17g}"], 2),
        ([f"timestep {2 * dt:.17g}", "reset_timestep 15"], 2),
    ):
        result = run(replace(deck, body=[*lines, "run 40", *between, "run 40"]), ranks)
        check(result.thermo(), (1, length), " ".join(between))

    first = run(replace(deck, body=[*lines, "run 40", f"timestep {2 * dt:.17g}", "run 20", "write_restart r"]), ranks)
    for renumbered in ([], ["reset_timestep 5"]):
        text = deck.restarted(first.folder / "r", [f"timestep {2 * dt:.17g}", *lines, *renumbered, "run 40"])
        check([*first.thermo(), *run(text, ranks).thermo()], (1, 2, 2), f"restarted {renumbered}")


CASES = {"goes-on": time_goes_on}

if __name__ == "__main__":
    main(CASES)
