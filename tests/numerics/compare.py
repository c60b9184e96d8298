# SPDX-License-Identifier: GPL-2.0-or-later
"""Largest differences between figures that several builds of the kernels gave, by name, each against its bound.
Usage: compare.py <figures> <figures> ..."""

import sys

# Sums differ by rounding where a compiler orders or fuses them otherwise (Eigen's, with -march=native). What that becomes:
BOUNDS = {
    # a few roundings of 1.1e-16, times what the position of a contact point owes to the flatness of ellipsoids of up to 5 : 1
    "spheroid": 2e-12, "triaxial": 2e-12,
    # a thousand steps, each rounded
    "rotation": 2e-13,
    # two hundred steps of a stiff contact, of which each carries on the rounding of the last
    "ledger": 1e-11,
    "fabric": 1e-13, "bands": 1e-13, "correlation": 1e-13,
}
# Two grains may touch in one build only where they are this near to touching, in smallest semi-axes.
GRAZING = 1e-12


def rows_of(path):
    with open(path) as file:
        for line in file:
            name, *numbers = line.split()
            unit, *values = map(float, numbers)
            yield name, unit, values


def differences(first, second):
    """(largest difference by name, number of rows by name, decisions that differ)"""
    largest, rows, decisions = dict.fromkeys(BOUNDS, 0.0), dict.fromkeys(BOUNDS, 0), 0
    for (name, unit, a), (other, _, b) in zip(rows_of(first), rows_of(second), strict=True):
        if name != other:
            sys.exit(f"compare: a row of {name} beside one of {other}: are these figures of one program?")
        rows[name] += 1
        if len(a) != len(b):  # one touches, the other does not
            decisions += 1
            if max(a[1], b[1]) > GRAZING * unit:
                sys.exit(f"compare: a pair touches in one build and is apart in another: {a} {b}")
            continue
        for x, y in zip(a, b):
            difference = abs(x - y) / unit
            if not difference <= largest[name]:
                largest[name] = difference
    return largest, rows, decisions


def main(files):
    failed = False
    for path in files[1:]:
        largest, rows, decisions = differences(files[0], path)
        print(f"{path} against {files[0]}: {decisions} of {rows['spheroid'] + rows['triaxial']} decisions differ")
        for name, bound in BOUNDS.items():
            good = rows[name] > 0 and largest[name] <= bound
            failed = failed or not good
            print(f"  {name:12} {rows[name]:6} rows  largest difference {largest[name]:.1e}  bound {bound:.0e}{'' if good else '  EXCEEDED'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
