# SPDX-License-Identifier: GPL-2.0-or-later
"""Every style made and removed 1000 times in one process: memory stays flat, and the run that follows is that of a
process of its own."""
import os
from pathlib import Path
import re
from dataclasses import replace

from case import main, require, require_close, require_same_snapshots
from catalogue import everything
from deck import Deck, dump_grains, shear
from memory import NOTED, SANITIZED, require_flat, watched_run
from packing import dense_packing
from plates import bed, plated
from run import run

# Pages come and go with the host's and the C library's own buffers. What is less, the leak checker of the asan preset
# finds to the byte: these tests are run under it too.
ALLOWED = 64.0
COMPUTES = [
    "stress/contact",
    "dissipation",
    "dissipation mode step",
    "dissipation mode ledger",
    "energy/ledger",
    "nematic",
    "contact/local",
    "contact/local id force",
    "contact/solver",
    "wall/contact impacts yes",
    "wall/triangle wear yes",
    "property/atom shapex quatw blockiness2 volume",
    "contact/force",
    "contact/local strong cluster",
    "packing",
    "field grid 4 4 4 quantities stress temperature Q",
    "field grid 1 8 1 kernel lucy width 1.0 quantities density stress",
    *(w.command for w in everything(dense_packing(1.5))),
]
FIXES = [
    "nve/spheroid",
    "press/strain axis y target 2e4 shear xy rate 0.02 every 1e-3",
    "press/strain axis z target v_held every/step 5",
    "field/write 1 2 10 c_cells file cells.*.csv cells.vts blocks 2",
    "wall/gran model hertz tangential history surface ellipsoid primitive type 1 zplane -2.0 "
    "allow_special_domain_periodic yes",
]
PLATES = ["press/wall mesh plate axis z target 2e4 area box every/step 5"]
MADE_BY_OTHERS = {"contacthistory", "grain/record", "ledger/record", "run/guard", "setup/memory"}
BEFORE_RUNS_ALONE = {"pair/gran/local"}  # the host lets nobody make it after a run
PAIRS = [
    "surface ellipsoid",
    "setup neutral surface ellipsoid",
    "surface ellipsoid ledger on tangential_damping off",
    "surface superquadric",
    "rolling_friction cdt surface superquadric",
]
NOT_COMPILED = ["cohesion sjkr surface ellipsoid"]
HOST_COMPUTES, HOST_FIXES = ["ke", "stress/atom", "coord/atom 2.0", "reduce sum vx"], [
    "nve/superquadric",
    "deform 1 xy erate 0.02 remap v",
]
HOST_PLATES = ["move/mesh mesh plate linear 0 0 0"]


def packed():
    return Deck(
        dense_packing(1.5),
        surface="ellipsoid",
        extra="ledger on tangential_damping off",
        body=["variable strain equal 0.02*step*dt", "variable held equal 2e4"],
    )


def with_cells():
    """What fix field/write writes."""
    deck = packed()
    return replace(deck, body=[*deck.body, "compute cells all field grid 1 4 1"])


def under_a_plate():
    return plated(bed(across=3, layers=2))


def made(kind, style):
    """(lines that make it, lines that remove it)."""
    if kind == "pair":
        return [f"pair_style {style}", "pair_coeff * *"], []
    return [f"{kind} it all {style}"], [f"un{kind} it"]


def asked(kind, style):
    """A run that uses it."""
    if kind != "compute":
        return ["run 0"], []
    where = {
        "contact/grain": ("compute sum all reduce sum c_it[1]", "c_sum"),
        "stress/atom": ("compute sum all reduce sum c_it[1]", "c_sum"),
        "coord/atom": ("compute sum all reduce sum c_it", "c_sum"),
        "wall/triangle": ("compute sum all reduce sum c_it[1]", "c_sum"),
        "contact/local": ("compute sum all reduce sum c_it[1]", "c_sum"),
        "property/atom": ("compute sum all reduce sum c_it[1]", "c_sum"),
        "contact/direction": ("", "c_it[1][1]"),
        "contact/surface": ("", "c_it[1]"),
    }
    define, quantity = where.get(style.split()[0], ("", "c_it"))
    return [*([define] if define else []), f"thermo_style custom step {quantity}", "run 0"], [
        "thermo_style custom step",
        *(["uncompute sum"] if define else []),
    ]


def rounds(kind, style, times, ran):
    """Noted ten times, first after a tenth; of pair styles that run, after as many rounds again: until then the C
    library makes room for their lists between what else it holds."""
    make, remove = made(kind, style)
    times = times // 10 if SANITIZED else times
    use, leave = asked(kind, style) if ran else ([], [])
    once = [*make, *use, *leave, *remove]
    first = times if ran and kind == "pair" else 0
    return once * first + (once * (times // 10) + [NOTED]) * 10


def last_run(deck):
    """What follows: the grains of a flow, or of a bed."""
    return [*([] if deck.boundary == "p p f" else [shear(0.02)]), *dump_grains(deck.packing, 50), "run 50"]


def grown(kind, styles, times, ran, ranks, start):
    """{style: kilobytes per rank: ten rows}, all in one process, and the grains after a run that follows."""
    deck = start()
    deck.body += [line for style in styles for line in rounds(kind, style, times, ran)]
    deck.body += [
        *(made("pair", "gran/insitu " + deck.model())[0] if kind == "pair" else []),
        *last_run(deck),
    ]
    result, kilobytes = watched_run(deck, ranks)
    return {style: kilobytes[10 * k : 10 * k + 10] for k, style in enumerate(styles)}, result.dump("grains.dump")


def flat(kind, styles, host_styles, times, ran=False, start=packed):
    """Ours stay flat, the host's are printed for comparison; what follows is as if there had been nothing."""

    def case(ranks):
        theirs, _ = grown(kind, host_styles, times, ran, ranks, start)
        for style, kilobytes in theirs.items():
            print(f"the host's {style}: {(kilobytes.max(axis=0) - kilobytes[0]).astype(int)} kB more at most")
        host = max(float((k.max(axis=0) - k[0]).max()) for k in theirs.values())
        ours, after = grown(kind, styles, times, ran, ranks, start)
        for style, kilobytes in ours.items():
            require_flat(kilobytes, host + ALLOWED, style)
        deck = start()
        alone = run(replace(deck, body=[*deck.body, *last_run(deck)]), ranks).dump("grains.dump")
        if not ran:
            return require_same_snapshots(after, alone, f"after {times} rounds against none")
        for name in (
            "x",
            "y",
            "z",
            "vx",
            "vy",
            "vz",
        ):  # every set-up takes positions to the box's coordinates and back: 3e-15
            require_close(after[-1][1][name], alone[-1][1][name], 1e-10, f"after {times} rounds against none, {name}")

    return case


def every_style_is_here(ranks):
    """A style that is added must be added to these lists."""
    here = {
        kind: {style.split()[0] for style in styles}
        for kind, styles in (("Compute", COMPUTES), ("Fix", FIXES + PLATES))
    }
    here["Fix"] |= MADE_BY_OTHERS
    here["Compute"] |= BEFORE_RUNS_ALONE
    for header in (Path(os.environ["GRAINSCOPE_SOURCE"]) / "src").rglob("*.h"):
        for kind, style in re.findall(r"^(Compute|Fix)Style\(([^,]+),", header.read_text(), re.M):
            require(style in here[kind], f"{kind.lower()} {style} is not among those made and removed")


def pairs(name, words=PAIRS):
    return [
        f"{name} model hertz tangential history {one}"
        for one in words
        if name != "gran" or not {"ledger", "setup"} & set(one.split())
    ]


CASES = {
    "every-style-is-here": every_style_is_here,
    "computes-1000-times": flat("compute", COMPUTES, HOST_COMPUTES, 1000),
    "fixes-1000-times": flat("fix", FIXES, HOST_FIXES, 1000, start=with_cells),
    "plates-1000-times": flat("fix", PLATES, HOST_PLATES, 1000, start=under_a_plate),
    "pair-styles-1000-times": flat("pair", pairs("gran/insitu"), pairs("gran"), 1000),
    # The host's own class for these loses its parts, 1 kB each time: no more than that.
    "pair-styles-not-compiled-1000-times": flat(
        "pair", pairs("gran/insitu", NOT_COMPILED), pairs("gran", NOT_COMPILED), 1000
    ),
    "computes-asked-100-times": flat("compute", COMPUTES, HOST_COMPUTES, 100, True),
    "fixes-run-100-times": flat("fix", FIXES, HOST_FIXES, 100, True, with_cells),
    "plates-run-100-times": flat("fix", PLATES, HOST_PLATES, 100, True, under_a_plate),
    "pair-styles-run-200-times": flat("pair", pairs("gran/insitu"), pairs("gran"), 200, True),
}

if __name__ == "__main__":
    main(CASES)
