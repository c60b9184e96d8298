# SPDX-License-Identifier: GPL-2.0-or-later
"""Outputs of grainscope's computes and fixes by name, from columns.json, which the program's command `outputs` makes:

    outputs("stress/contact").index("P")            26
    outputs("stress/contact").word("s", "P")        "c_s[26]"
    outputs("contact/surface").word("s", "N_c")     "c_s[3]", the column of the array
    outputs("contact/surface").word("s", "N_c", 7)  "c_s[7][3]", one number of it

For a compute or fix that is asked often:

    C_STRESS = outputs("stress/contact").of("stress")
    C_STRESS["P"]                                   "c_stress[26]"
    C_STRESS.vector()                               all of its vector: ["c_stress[1]", ...]
"""
from functools import lru_cache
import json
from pathlib import Path

LISTS = ("vector", "array", "per grain", "local")


@lru_cache
def _all():
    return json.loads((Path(__file__).parent / "columns.json").read_text())


class Columns:
    """The outputs of one style. `only`: of these alone, in this order, where the input script chose columns."""

    def __init__(self, style, only=()):
        self.style = style
        self._entry = _all()[style]
        self._only = list(only)

    def outputs(self, kind):
        """Those of one kind, scalar, vector, array, per grain or local: dicts of index, name, unit, extent, meaning."""
        return self._entry.get(kind, [])

    def names(self, kind):
        return self._only or [one["name"] for one in self.outputs(kind)]

    def index(self, name):
        """Counted from 1, as in input scripts."""
        if self._only:
            return self._only.index(name) + 1
        for kind in LISTS:
            for one in self.outputs(kind):
                if one["name"] == name:
                    return one["index"]
        raise KeyError(
            f"{self.style} has no output '{name}'; there are {', '.join(n for k in LISTS for n in self.names(k))}"
        )

    def at(self, name):
        """Counted from 0, as in Python."""
        return self.index(name) - 1

    def word(self, ID, name, row=None):
        """What reads it in an input script. A scalar that is no element of the vector is `c_ID`."""
        start = f"{'f' if self._entry['kind'] == 'fix' else 'c'}_{ID}" + ("" if row is None else f"[{row}]")
        if name not in self.names("vector") and name in [one["name"] for one in self.outputs("scalar")]:
            return start
        return f"{start}[{self.index(name)}]"

    def of(self, ID):
        return Words(self, ID)


class Words:
    """What reads the outputs of one compute or fix in an input script, by name; of an array by (row, name)."""

    def __init__(self, own, ID):
        self.own, self.ID = own, ID

    def __getitem__(self, name):
        row, name = name if isinstance(name, tuple) else (None, name)
        return self.own.word(self.ID, name, row)

    def all(self, kind):
        return [self[name] for name in self.own.names(kind)]

    def vector(self):
        return self.all("vector")

    def array(self, rows):
        """All of these rows, one after the other."""
        return [self[row, name] for row in rows for name in self.own.names("array")]


def outputs(style, only=()):
    return Columns(style, only)
