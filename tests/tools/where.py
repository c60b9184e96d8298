#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What works where: of every measure in every scene the tests that hold its numbers, or its refusal, to be right.
Writes doc/what_works_where.md from that and from what ctest knows; suite tests hold both together.

usage: where.py BUILD [--write]
"""
from pathlib import Path
import re
import subprocess
import sys

PAGE = Path(__file__).resolve().parents[2] / "doc" / "what_works_where.md"
SCENES = (
    "two dimensions",
    "walls",
    "gravity",
    "several types",
    "clumps",
    "region, moving",
    "region, empty",
    "grains leave, come",
    "tilted box",
    "other plane",
    "units",
)
NOT = "-"  # means nothing there


def refused(tests):
    return ("refused", tests)


# Tests by regular expressions that find their names.
ALL_UNITS = r"every-style-units-"
TWO = r"two-dimensions-"
CLUMPS = r"clumps-as-grains"
MEASURED_AT_WALLS = r"wall/gran-measures-"
COME = r"every-style-changes-grains-(deleted|inserted|lost)"
TILTED = r"every-style-same-sphere|oracle-.*(flip|tilted)"
TABLE = {
    "stress/contact": (
        r"stress/contact-two-dimensions-",
        MEASURED_AT_WALLS,
        r"wall/contact-weight|wall/gran-measures-box$",
        r"scope-(rows-by|chosen)-types",
        r"clumps-(as-grains|between-walls)",
        r"region-places",
        r"region-nothing-there",
        COME,
        r"stress/contact.*oracle-.*through-a-flip",
        r"stress/contact-scope-planes-and-pressures",
        ALL_UNITS,
    ),
    "dissipation": (
        r"dissipation.*two-dimensions-losses",
        MEASURED_AT_WALLS,
        MEASURED_AT_WALLS,
        r"scope-(rows-by|chosen)-types",
        r"clumps-losses",
        r"region-places",
        r"region-nothing-there",
        COME,
        r"dissipation.*oracle-.*through-a-flip",
        NOT,
        ALL_UNITS,
    ),
    "fabric": (
        r"fabric.*two-dimensions-",
        MEASURED_AT_WALLS,
        MEASURED_AT_WALLS,
        r"scope-(rows-by|chosen)-types",
        r"clumps-losses",
        r"region-(partition-of-a-sheared-box|places)",
        r"region-nothing-there",
        COME,
        r"region-partition-of-a-sheared-box",
        r"fabric.*analytic-three-of-four-along-z-in-xz",
        ALL_UNITS,
    ),
    "contact/direction": (
        r"contact/direction.*two-dimensions-",
        MEASURED_AT_WALLS,
        MEASURED_AT_WALLS,
        r"region-bins-and-rows",
        r"clumps-losses",
        r"region-bins-and-rows",
        r"region-nothing-there",
        COME,
        TILTED,
        r"contact/direction.*(in-xz|analytic)",
        ALL_UNITS,
    ),
    "contact/surface": (
        refused(r"two-dimensions-refused-"),
        MEASURED_AT_WALLS,
        MEASURED_AT_WALLS,
        r"region-bins-and-rows",
        refused(r"clumps-refused"),
        r"region-bins-and-rows",
        r"region-bins-and-rows",
        COME,
        TILTED,
        NOT,
        ALL_UNITS,
    ),
    "contact/local": (
        r"two-dimensions-(stress|any-depth)",
        r"wall/gran-measures-numbers|wall/gran.*measures",
        r"wall/gran-measures-",
        r"region-bins-and-rows",
        r"clumps-as-grains",
        r"region-bins-and-rows",
        r"region-bins-and-rows",
        COME,
        TILTED,
        NOT,
        ALL_UNITS,
    ),
    "contact/grain": (
        r"contact/grain.*two-dimensions-",
        MEASURED_AT_WALLS,
        MEASURED_AT_WALLS,
        r"scope-chosen-types",
        r"clumps-as-grains",
        r"region-places",
        r"region-nothing-there",
        COME,
        TILTED,
        r"nematic-scope-angles-in-planes",
        ALL_UNITS,
    ),
    "contact/force": (
        r"contact/force-discs",
        r"contact/force-at-walls",
        r"contact/force-at-walls",
        r"contact/force-of-types",
        r"contact/force-clumps",
        r"contact/force-in-a-region",
        r"contact/force-empty-group",
        COME,
        r"contact/force-(spheres|prolate)",
        NOT,
        r"every-style-units-walls",
    ),
    "packing": (
        r"packing-discs",
        r"packing-at-walls",
        r"packing-at-walls",
        NOT,
        r"packing-clumps",
        r"packing-in-regions",
        r"packing-empty-group",
        COME,
        r"packing-(spheres|prolate)",
        r"packing-inertial-number",
        r"every-style-units-walls",
    ),
    "nematic": (
        r"nematic.*two-dimensions-",
        NOT,
        NOT,
        r"nematic-scope-mixtures-of-shapes",
        refused(r"clumps-refused"),
        r"region-places",
        r"region-nothing-there",
        COME,
        TILTED,
        r"nematic-scope-angles-in-planes",
        ALL_UNITS,
    ),
    "fluctuation": (
        r"fluctuation.*two-dimensions-",
        r"fluctuation-flows-mean-flows",
        r"fluctuation-flows-mean-flows",
        NOT,
        CLUMPS,
        r"fluctuation-flows-mean-flows",
        r"region-nothing-there",
        COME,
        r"fluctuation.*oracle-tilted-backward",
        r"fluctuation.*oracle-sheared-in-(xz|yz)",
        ALL_UNITS,
    ),
    "velocity/correlation": (
        r"velocity/correlation-two-dimensions-",
        r"velocity/correlation-oracle-not-periodic",
        NOT,
        NOT,
        CLUMPS,
        r"velocity/correlation-region-",
        r"velocity/correlation-region-",
        COME,
        r"velocity/correlation-oracle-tilted-backward",
        r"velocity/correlation-oracle-sheared-in-(xz|yz)",
        ALL_UNITS,
    ),
    "velocity/memory": (
        r"two-dimensions-displacement|velocity/memory.*two-dimensions",
        r"flows-over-time",
        NOT,
        NOT,
        CLUMPS,
        r"flows-grains-that-come-and-go",
        r"flows-empty-start",
        r"flows-grains-that-come-and-go",
        r"velocity/memory-oracle-backward",
        r"velocity/memory-oracle-sheared-in-yz",
        ALL_UNITS,
    ),
    "displacement/shear": (
        r"displacement/shear-two-dimensions-displacement",
        r"displacement/shear-faces-",
        NOT,
        NOT,
        r"clumps-crosses-faces",
        NOT,
        NOT,
        r"flows-grains-that-come-and-go",
        r"displacement/shear.*oracle-backward",
        r"displacement/shear.*oracle-sheared-in-yz",
        ALL_UNITS,
    ),
    "layering": (
        r"layering.*two-dimensions-",
        r"layering-faces-top-layer",
        NOT,
        NOT,
        r"clumps-as-grains",
        NOT,
        NOT,
        COME,
        r"layering.*oracle-tilted-backward",
        r"layering.*oracle-sheared-in-",
        ALL_UNITS,
    ),
    "wall/contact": (
        r"wall/contact.*two-dimensions-",
        r"wall/contact-balance",
        r"wall/contact-weight",
        NOT,
        r"clumps-between-walls",
        NOT,
        NOT,
        NOT,
        NOT,
        NOT,
        r"every-style-units-walls",
    ),
    "wall/triangle": (
        refused(r"two-dimensions-refused-mesh-walls"),
        r"wall/triangle-",
        r"wall/triangle-",
        NOT,
        NOT,
        NOT,
        NOT,
        NOT,
        NOT,
        NOT,
        r"every-style-units-walls",
    ),
    "energy/ledger": (
        r"energy/ledger-two-dimensions-ledger",
        r"energy/ledger-walls-",
        r"energy/ledger-walls-(rained|pulls)",
        r"energy/ledger-closes-polydisperse-two-types",
        refused(r"clumps-refused"),
        refused(r"stress/contact\+fabric-region-refused"),
        NOT,
        r"energy/ledger-walls-(rained|drained|drops-out)",
        r"energy/ledger-closes-flip",
        NOT,
        ALL_UNITS,
    ),
    "press/strain": (
        r"press/strain.*two-dimensions-",
        r"press/strain-refused-cylinder-across-the-axis",
        NOT,
        NOT,
        refused(r"clumps-refused"),
        NOT,
        NOT,
        COME,
        r"press/strain-control-shears-as-fix-deform",
        r"press/strain-control-shears-in-(xz|yz)",
        ALL_UNITS,
    ),
}


def names_of_tests(build):
    listed = subprocess.run(["ctest", "-N", "--test-dir", build], stdout=subprocess.PIPE, text=True, check=True).stdout
    names = re.findall(r"Test +#\d+: (\S+)", listed)
    return sorted({re.sub(r"-on-\d+-ranks$", "", name) for name in names})


def cells():
    """(measure, scene, "right" or "refused" or None, regular expression)."""
    for measure, row in TABLE.items():
        assert len(row) == len(SCENES), measure
        for scene, cell in zip(SCENES, row):
            if cell == NOT:
                yield measure, scene, None, ""
            elif isinstance(cell, tuple):
                yield measure, scene, *cell
            else:
                yield measure, scene, "right", cell


TEXT = """\
Of every measure in every scene: *right*, its numbers are held by tests against numpy from dumps, a closed form or a
balance; *refused*, by name, before anything is run; empty, it means nothing there or is of no concern. The table is
made from the names of these tests (`tests/tools/where.py BUILD`, which also prints them). What is measured: [types,
walls, regions ...](scope.md), [two dimensions](two_dimensions.md).""".splitlines()


def page():
    lines = [
        "# What works where",
        "",
        *TEXT,
        "",
        "| | " + " | ".join(SCENES) + " |",
        "|" + "---|" * (len(SCENES) + 1),
    ]
    words = {}
    for measure, scene, verdict, _ in cells():
        words.setdefault(measure, []).append(verdict or "")
    lines += [f"| {measure} | " + " | ".join(row) + " |" for measure, row in words.items()]
    return "\n".join(lines) + "\n"


def missing(build):
    """Cells whose tests are not there."""
    names = names_of_tests(build)
    return [
        f"{measure}, {scene}: no test {pattern}"
        for measure, scene, verdict, pattern in cells()
        if verdict and not any(re.search(pattern, name) for name in names)
    ]


def main():
    build = sys.argv[1]
    names = names_of_tests(build)
    for measure, scene, verdict, pattern in cells():
        if verdict:
            print(f"{measure}, {scene}: {verdict}: {', '.join(n for n in names if re.search(pattern, n))}")
    if "--write" in sys.argv:
        PAGE.write_text(page())
    print("\n".join(missing(build)))


if __name__ == "__main__":
    main()
