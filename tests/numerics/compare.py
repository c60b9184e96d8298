# SPDX-License-Identifier: GPL-2.0-or-later
"""Largest differences between figures that several builds of the kernels gave, by name, each against its bound.
Usage: compare.py <figures> <figures> ..."""

import sys

# Kernels of our own arithmetic do the same IEEE operations in the same order whatever compiles them: nothing is fused
# (-ffp-contract=off) or reordered, side by side or not. Eigen fuses and orders by the processor; measured: 6e-17 in the
# fabric, 0 in the ledger. Its books add up thousands of terms, each rounded to 1e-16 of the energies in it.
BOUNDS = {
    "spheroid": 0.0,
    "triaxial": 0.0,
    "rotation": 0.0,
    "correlation": 0.0,
    "bands": 1e-13,
    "fabric": 1e-14,
    "ledger": 1e-12,
}


def rows_of(path):
    with open(path) as file:
        for line in file:
            name, *numbers = line.split()
            unit, *values = map(float, numbers)
            yield name, unit, values


def differences(first, second):
    """(largest difference by name, number of rows by name)"""
    largest, rows = dict.fromkeys(BOUNDS, 0.0), dict.fromkeys(BOUNDS, 0)
    for (name, unit, a), (other, _, b) in zip(rows_of(first), rows_of(second), strict=True):
        if name != other:
            sys.exit(f"compare: a row of {name} beside one of {other}: are these figures of one program?")
        rows[name] += 1
        if len(a) != len(b):
            sys.exit(f"compare: a pair touches in one build and is apart in another: {a} {b}")
        for x, y in zip(a, b):
            difference = abs(x - y) / unit
            if not difference <= largest[name]:
                largest[name] = difference
    return largest, rows


def main(files):
    failed = False
    for path in files[1:]:
        largest, rows = differences(files[0], path)
        print(f"{path} against {files[0]}:")
        for name, bound in BOUNDS.items():
            good = rows[name] > 0 and largest[name] <= bound
            failed = failed or not good
            print(
                f"  {name:12} {rows[name]:6} rows  largest difference {largest[name]:.1e}  bound "
                f"{bound:.0e}{'' if good else '  EXCEEDED'}"
            )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
