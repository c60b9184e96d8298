# SPDX-License-Identifier: GPL-2.0-or-later
"""What pair_style gran/insitu refuses."""
from dataclasses import replace

from case import main
from deck import Deck
from packing import dense_packing
from refusal import refusal


def deck(*body, **choices):
    return Deck(dense_packing(atom_style="sphere"), body=[*body, "run 1"], **choices)


def as_text(old, new, *body):
    text = deck(*body).text()
    assert old in text
    return text.replace(old, new)


PAIR = "pair_style gran/insitu"


def small_box():
    packing = dense_packing(atom_style="sphere")
    one_layer = [g for g in packing.grains if g.position[2] < 2.8]
    return Deck(replace(packing, grains=one_layer, edges=(*packing.edges[:2], 4.0)), body=["run 1"])


CASES = {
    "hybrid": refusal(lambda: as_text(PAIR, "pair_style hybrid gran/insitu"), "gran/insitu cannot be a sub-style of hybrid",
                      "use it alone"),
    "misspelt-model": refusal(lambda: as_text("model hertz", "model hurtz"), "pair_style gran/insitu: invalid contact model"),
    "misspelt-setting": refusal(lambda: as_text("tangential history", "tangential history limitFours on"), "limitFours"),
    "small-periodic-box": refusal(small_box, "pair_style gran/insitu: the periodic box must be at least 2 x (largest diameter x "
                                  "contact distance factor + skin)", "high along z, got 4"),
    "setup-twice": refusal(lambda: as_text("tangential history", "tangential history setup host setup neutral"),
                           "pair_style gran/insitu: 'setup' is given twice"),
    "guard-by-hand": refusal(lambda: deck("fix gran_insitu_guard all run/guard", "run 1"), "fix run/guard: is made by pair_style gran/insitu"),
    "memory-by-hand": refusal(lambda: deck("fix gran_insitu_setup all setup/memory", "run 1"), "fix setup/memory: is made by pair_style gran/insitu"),
    "newton-on": refusal(lambda: deck("compute c all stress/contact", tangential="off").text().replace("newton off", "newton on"),
                         "compute stress/contact requires 'newton off', got 'newton on'"),
}

if __name__ == "__main__":
    main(CASES)
