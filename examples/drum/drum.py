#!/usr/bin/python3
"""Reads what in.drum wrote in the current folder: torque and power of the drum, where the energy went, how the grains
are aligned."""
import math
from pathlib import Path

import numpy as np

TIME_STEP = 5e-5


def table(path):
    names = path.read_text().splitlines()[1].split()[1:]
    return dict(zip(names, np.loadtxt(path).T))


def mean(values, parts=10):
    """With its error, from means of parts."""
    parts = [part.mean() for part in np.array_split(values, parts)]
    return f"{np.mean(values):.4g} +- {np.std(parts, ddof=1) / math.sqrt(len(parts)):.1g}"


def main(folder):
    heap, power, energy = (table(folder / f"{name}.txt") for name in ("drum", "power", "energy"))
    print(f"slope {mean(heap['slope'])} degrees")
    print(f"moment of the weight {mean(heap['weight'])}, of the drum {mean(heap['torque'])} N m")
    print(f"power of the drum {mean(power['power'])}, torque x rate {mean(power['torque_rate'])} W")
    print(f"lost {mean(power['lost'])} W, at the drum {mean(power['lost_w'])} W")
    last = {name: values[-1] for name, values in energy.items()}
    time = TIME_STEP * (power["step"][1] - power["step"][0])
    at_drum = last["D_n_w"] + last["D_t_w"] + last["D_damp_w"]
    print(f"W_wall {last['W_wall']:.6f}, sum of the power {time * power['power'].sum():.6f} J")
    print(f"lost at the drum {at_drum:.6f}, sum of the power {time * power['lost_w'].sum():.6f} J; in % of W_wall:")
    names = list(energy)[3:-3]
    print(", ".join(f"{name} {100.0 * last[name] / last['W_wall']:.2f}" for name in names))
    print(f"imbalance {last['imbalance']:.1e}")
    xx, yy, zz, xy = (heap[f"Q{name}"].mean() for name in ("xx", "yy", "zz", "xy"))
    order = 1.5 * np.linalg.eigvalsh([[xx, xy, 0.0], [xy, yy, 0.0], [0.0, 0.0, zz]])[-1]
    print(f"order {order:.3f}, {math.degrees(0.5 * math.atan2(2.0 * xy, xx - yy)):.1f} degrees from x")


if __name__ == "__main__":
    main(Path.cwd())
