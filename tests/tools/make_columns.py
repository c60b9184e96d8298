# SPDX-License-Identifier: GPL-2.0-or-later
"""tools/grainscope/columns.json from the program: runs in which every style of ours says its outputs.

Usage: make_columns.py            # prints it
       make_columns.py --write    # and writes tools/grainscope/columns.json
"""
import json
from pathlib import Path
import re
import sys

from deck import Deck
from packing import dense_packing
from plates import bed, plated
from run import run

FILE = Path(__file__).resolve().parents[2] / "tools" / "grainscope" / "columns.json"
# With every keyword that adds outputs.
COMMANDS = {
    "stress/contact": "rows types",
    "fabric": "rows types branch force/normal force/tangential",
    "contact/direction": "",
    "contact/surface": "",
    "contact/force": "",
    "packing": "",
    "contact/grain": "",
    "contact/local": "id image point normal branch overlap force fn fn_damping ft un ut sliding slip mobilisation "
    "wall triangle strong cluster",
    "contact/solver": "",
    "wall/contact": "impacts yes",
    "wall/triangle": "wear yes",
    "displacement/shear": "strain v_strain",
    "dissipation": "rows types",
    "energy/ledger": "",
    "fluctuation": "",
    "layering": "",
    "nematic": "",
    "velocity/correlation": "",
    "velocity/memory": "strain v_strain",
    "property/atom": "shapex shapey shapez quatw quati quatj quatk blockiness1 blockiness2",
    "press/strain": "axis y target 2e4 shear xy rate 0.02 every 1e-3",
}
# Where a plate is; fix press/strain has none in its box.
UNDER_A_PLATE = {"press/wall": "mesh plate axis z target 2e4 area box every/step 5"}
ALL = {**COMMANDS, **UNDER_A_PLATE}
FIXES = ("press/strain", "press/wall")


def kind_of(style):
    return "fix" if style in FIXES else "compute"


def tables(text):
    """{ID: {kind: list of outputs}} of all tables that `outputs` printed."""
    found = {}
    for part in text.split("Outputs of ")[1:]:
        lines = part.splitlines()
        ID = re.match(r"\w+ (\w+) \(", lines[0])[1]
        head = [word.strip() for word in lines[1].split(" | ")]
        found[ID] = {}
        for line in lines[2:]:
            words = [word.strip() for word in line.split(" | ")]
            if len(words) != len(head):
                break
            row = dict(zip(head, words))
            one = {
                "index": row["index"] if row["index"] == "-" else int(row["index"]),
                "name": row["name"],
                "unit": row["unit"],
                "extensive": row["int/extensive"] != "intensive",
                "whole": row["int/extensive"].endswith("whole"),
                "meaning": row["meaning"],
            }
            found[ID].setdefault(row["kind"], []).append(one)
    return found


def decks():
    """(a deck of its scene, the commands that are for it) each."""
    surface = {"surface": "ellipsoid", "extra": "ledger on tangential_damping off"}
    yield Deck(dense_packing(1.5), body=["variable strain equal 0.02*step*dt"], **surface), COMMANDS
    yield plated(bed(across=3, layers=2)), UNDER_A_PLATE


def made():
    IDs = {style: f"it{k}" for k, style in enumerate(ALL)}
    said = {}
    for deck, commands in decks():
        for style, keywords in commands.items():
            deck.body += [f"{kind_of(style)} {IDs[style]} all {style} {keywords}", f"outputs {IDs[style]}"]
        said.update(tables(run(deck).file("log.liggghts").read_text()))
    return {style: {"kind": kind_of(style), **said[IDs[style]]} for style in sorted(ALL)}


def text_of(columns):
    """One output a line."""
    styles = []
    for style, entry in columns.items():
        lists = ",\n".join(
            f'  "{kind}": [\n' + ",\n".join(f"    {json.dumps(one)}" for one in outputs) + "]"
            for kind, outputs in entry.items()
            if kind != "kind"
        )
        styles.append(f'"{style}": {{"kind": "{entry["kind"]}",\n{lists}}}')
    return "{\n" + ",\n".join(styles) + "\n}\n"


if __name__ == "__main__":
    text = text_of(made())
    if "--write" in sys.argv:
        FILE.write_text(text)
    else:
        print(text, end="")
