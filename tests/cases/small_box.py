# SPDX-License-Identifier: GPL-2.0-or-later
"""A box that fix press/strain would make too small for contact history: refused when the run is set up where that is
certain, warned of once where it is likely, and no word where it is neither."""
from dataclasses import replace
import math

from case import main, require
from deck import Deck, thermo
from packing import SKIN, dense_packing, disc_packing
from refusal import require_refused
from run import attempt, run

NEEDED = 2.0 * (2.0 * 1.05 + SKIN)
CERTAIN, LIKELY = "fix press/strain: the box becomes too small", "fix press/strain: the box may become too small"


def loose(overlap):
    """32 spheres that do not touch, in a box of some 1.8 x the height that is needed."""
    return dense_packing(atom_style="sphere", overlap=overlap, minimum=32, speed=0.1)


def solid_fraction_at_least_height(packing):
    """Of the grains in the present cross section, as high as is needed."""
    return sum(g.volume() for g in packing.grains) / (packing.edges[0] * packing.edges[2] * NEEDED)


DILUTE, DENSER = loose(-0.5), loose(-0.4)


def pressed(packing, words="target 1e5 shear xy rate 0.1 every 1e-3", steps=7000, more=(), **choices):
    deck = Deck(packing, **choices)
    deck.body = [*thermo(100, "ly"), f"fix press all press/strain axis y {words}", *more, f"run {steps}"]
    return deck


def refused(ranks):
    """Before the first step, with the numbers."""
    phi = solid_fraction_at_least_height(DILUTE)
    require(phi < 0.45, "a dilute packing")
    low = NEEDED * phi / 0.45
    result = require_refused(
        pressed(DILUTE),
        ranks,
        CERTAIN,
        f"at a solid fraction of 0.45 these {len(DILUTE.grains)} grains fill it up to a height of {low:.6g} along y",
        f"factor + skin) = {NEEDED:.6g}",
        f"Take {math.ceil(len(DILUTE.grains) * 0.64 / phi - 1e-9):.0f} grains or more",
    )
    require("Loop time" not in result.output, "no step was made")


def warned(ranks):
    """Once, though the deck runs twice."""
    require(0.45 < solid_fraction_at_least_height(DENSER) < 0.64, "a packing that may stay loose enough")
    result = run(pressed(DENSER, steps=5, more=["run 5"]), ranks)
    require(result.output.count(LIKELY) == 1, "one warning")


def discs(ranks):
    """Of two dimensions: by areas, warned of below 0.84."""
    packing = disc_packing(sizes=(1.0,), overlap=-0.7, rows=4)
    phi = len(packing.grains) * math.pi / (packing.edges[0] * NEEDED)
    require(phi < 0.84, "a dilute packing")
    deck = pressed(replace(packing, triclinic=False), "target 1e5 every/step 10", 5)
    expected = (
        f"at a solid fraction of 0.84 these 16 grains fill it up to a height of {NEEDED * phi / 0.84:.6g} along y"
    )
    output = " ".join(run(deck, ranks).output.split())
    require(output.count(LIKELY) == 1 and expected in output, "one warning, of areas")


def only_what_is_certain(ranks):
    """Dilute, but: the run is too short to get there, or the box too slow; the flow is fast; nothing shears; target or
    rate may change; the gain is given; grains attract or roll with friction; nobody moves them. That is warned of, and
    what comes of it in the run is another matter."""
    slow, v_rate = "target 1e5 shear xy rate 0.1 every 1e-3", "variable rate equal 0.1"
    still = pressed(DILUTE)
    still.body = ["unfix integrate", *still.body]
    varied = pressed(DILUTE, slow.replace("0.1", "v_rate"))
    varied.body = [v_rate, *varied.body]
    for deck in (
        pressed(DILUTE, steps=10),
        pressed(DILUTE, slow + " maxrate 1e-3"),
        pressed(DILUTE, slow.replace("rate 0.1", "rate 1.0")),
        pressed(DILUTE, "target 1e5 every/step 10"),
        pressed(DILUTE, slow + " gain 1e-9"),
        pressed(DILUTE, cohesion="sjkr"),
        pressed(DILUTE, rolling="cdt"),
        still,
        varied,
    ):
        output = attempt(deck, ranks).output
        require(output.count(LIKELY) == 1 and CERTAIN not in output, f"one warning: {deck.body}")


def large_enough(ranks):
    """A dense packing; a target of 0; grains that are still to come."""
    for deck in (
        pressed(dense_packing(atom_style="sphere"), steps=10),
        pressed(DILUTE, "target 0 every/step 10", 10),
    ):
        require("the box" not in run(deck, ranks).output, f"no word: {deck.body}")


def forecast_comes_true(ranks):
    """The flow that is refused, at a rate that is a variable and thus not certain to stay: within the strain of the run
    the box does become too small."""
    deck = pressed(DILUTE, "target 1e5 shear xy rate v_rate every 1e-3")
    deck.body = ["variable rate equal 0.1", *deck.body]
    result = require_refused(deck, ranks, "the periodic box must be at least")
    require("Memory usage per processor" in result.output, "the run had begun")


CASES = {
    "refused": refused,
    "warned": warned,
    "discs": discs,
    "only-what-is-certain": only_what_is_certain,
    "large-enough": large_enough,
    "forecast-comes-true": forecast_comes_true,
}

if __name__ == "__main__":
    main(CASES)
