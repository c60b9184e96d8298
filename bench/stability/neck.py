#!/usr/bin/python3
"""Where a ball leaves the neck of two larger ones, by size ratio, friction, time step and time level: the table of
doc/stability.md. A minute.

    bench/stability/neck.py build/release/bin/grainscope
"""
import os
import pathlib
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parent.parent.parent / "tests"
sys.path[:0] = [str(TESTS / folder) for folder in ("cases", "tools", ".", "../tools")]

from oracle.ball_on_neck import Neck  # noqa: E402
from time_level import leaves_at, neck_deck  # noqa: E402

RATIOS, FRICTION, STEPS = (1.0, 3.0, 10.0, 20.0), (0.5, 1.0, 10.0), (5, 10, 20, 40)


def main():
    os.environ["GRAINSCOPE_BINARY"] = str(pathlib.Path(sys.argv[1]).resolve())
    for ratio in RATIOS:
        for friction in FRICTION:
            neck = Neck(1.0 / ratio, friction)
            row = [f"{ratio:g}", f"{friction:g}", f"{neck.leaves_at(STEPS[-1])[0]:.1f}"]
            for level in ("host", "synchronized"):
                for steps in STEPS:
                    long = int(1.5 * neck.leaves_at(steps)[1])
                    angle = leaves_at(neck, long, 1, neck_deck(neck, level, steps=steps))
                    row.append("stuck" if angle is None else f"{angle:.1f}")
            print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.environ["GRAINSCOPE_SCRATCH"] = folder
        main()
