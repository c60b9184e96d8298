# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs an example as expected.json says and checks the values it names. The schema is in tests/README.md.

    run_example.py FOLDER [RANKS]   (default: on each number of ranks of expected.json)
"""
import json
from pathlib import Path
import shutil
import sys
import tempfile

import numpy as np

from run import SKIPPED, Failure, Skipped, columns_of, run

REDUCE = {
    "mean": np.mean,
    "last": lambda v: v[-1],
    "first": lambda v: v[0],
    "min": np.min,
    "max": np.max,
    "rms": lambda v: np.sqrt(np.mean(v * v)),
}


def table(path):
    names, rows = None, []
    for line in path.read_text().splitlines():
        if line.startswith("#") and not rows:
            names = line.lstrip("# ").split()
        elif line and not line.startswith("#"):
            rows.append([float(w) for w in line.split()])
    if not rows:
        raise Failure(f"{path.name} holds no row of numbers")
    if not names or len(names) != len(rows[0]):
        names = [str(k + 1) for k in range(len(rows[0]))]
    return columns_of(names, rows)


def column(data, wanted):
    names = list(data)
    if isinstance(wanted, int):
        wanted = names[wanted - 1] if wanted <= len(names) else str(wanted)
    if wanted not in data:
        wanted = next((name for name in names if name[1:2] == "_" and name[2:] == wanted), wanted)
    if wanted not in data:
        raise Failure(f"no column {wanted!r}; there are {', '.join(names)}")
    return data[names[0]], data[wanted]


def check(result, value):
    data = result.thermo()[-1] if value["file"] == "log" else table(result.file(value["file"]))
    order, found = column(data, value["column"])
    found = found[order >= value["from"]] if "from" in value else found
    if not len(found):
        raise Failure(f"no row of {value['file']} at or after {value['from']}")
    reduced = float(REDUCE[value["reduce"]](found))
    good = abs(reduced - value["expected"]) <= value["tolerance"]
    print(
        f"{'ok  ' if good else 'OFF '} {value['reduce']} of {value['column']} in {value['file']}: {reduced!r}, "
        f"expected {value['expected']} +- {value['tolerance']} ({value['reason']})"
    )
    return good


def arguments(variables):
    for name, value in variables.items():
        yield from ("-var", name, *map(str, value if isinstance(value, list) else [value]))


def main(folder, *ranks):
    expected = json.loads((folder / "expected.json").read_text())
    good = True
    for ranks in map(int, ranks or expected["ranks"]):
        with tempfile.TemporaryDirectory(prefix="grainscope-") as scratch:
            copy = Path(scratch) / folder.name
            shutil.copytree(folder, copy)
            deck = (copy / f"in.{folder.name}").read_text()
            print(f"{folder.name} on {ranks} rank(s)")
            result = run(deck, ranks, folder=copy, arguments=list(arguments(expected.get("variables", {}))))
            good = all([check(result, value) for value in expected["values"]]) and good
    return good


if __name__ == "__main__":
    try:
        sys.exit(0 if main(Path(sys.argv[1]).resolve(), *sys.argv[2:]) else 1)
    except Skipped as reason:
        print(f"SKIPPED {reason}")
        sys.exit(SKIPPED)
    except Failure as failure:
        print(f"FAILED {failure}")
        sys.exit(1)
