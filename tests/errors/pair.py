# SPDX-License-Identifier: GPL-2.0-or-later
"""What pair_style gran/insitu refuses."""
from dataclasses import replace

from case import main, require
from deck import Deck
from packing import dense_packing
from refusal import refusal, require_refused
from run import run, tail


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


def spheroids(old="", new="", *body, **choices):
    text = Deck(dense_packing(1.5), body=[*body, "run 1"], **choices).text()
    assert old in text
    return text.replace(old, new)


def boxy_without_surface():
    return spheroids(" surface superquadric", "").replace("blockiness 2.0 2.0", "blockiness 2.0 3.0", 1)


SYNCHRONIZED = "time_level synchronized"
MODEL = "model hertz tangential history"
WALL = f"fix floor all wall/gran {MODEL} primitive type 1 zplane -1.0"
BOUNDING = (
    "grains of atom_style superquadric need a surface model of their shape, or they collide as their bounding "
    "spheres"
)


def warned_under_gran(ranks):
    """The host's own pair style goes on as it was, and says what it does, once; and nothing where all is well."""
    output = run(spheroids(" surface superquadric", "", pair="gran"), ranks).output
    said = "without a surface model collide as their bounding spheres: add 'surface superquadric', or 'surface ellip"
    require(said in " ".join(output.split()), tail(output))
    require(output.count("bounding spheres") == 1, "it was said more than once")
    for right in (spheroids(pair="gran"), deck(pair="gran")):
        require("bounding spheres" not in run(right, ranks).output, "warned of without a reason")


def continued_otherwise(ranks):
    """Of grains that are no spheres more is kept; of spheres not, and either level goes on from the other."""
    for style, refused, ledger in (
        ("superquadric", True, ""),
        ("superquadric", True, "ledger on "),
        ("sphere", False, ""),
    ):
        packing = dense_packing(1.5 if refused else 1.0, atom_style=style)
        with_it, without = (Deck(packing, surface="ellipsoid", extra=ledger + words) for words in (SYNCHRONIZED, ""))
        for first, second, said in (
            (with_it, without, "it was written with 'time_level synchronized'. Use 'time_level synchronized'"),
            (without, with_it, "it was written without 'time_level synchronized'. Use 'time_level host'"),
        ):
            file = run(replace(first, body=["run 3", "write_restart a.restart"]), ranks).folder / "a.restart"
            again = second.restarted(file, ["run 3"])
            if refused:
                require_refused(again, ranks, said)
            else:
                require("the restart file was written with" in " ".join(run(again, ranks).output.split()), "not said")


def continued_with_as_many_columns(ranks):
    """Other numbers, though as many of each contact, are not taken for what they are not."""
    made = Deck(dense_packing(1.5), surface="ellipsoid")
    ledger, level = replace(made, extra="ledger on"), replace(made, extra=SYNCHRONIZED)
    for first, second, many in (
        (replace(level, tangential="no_history"), ledger, 16),
        (replace(ledger, rolling="epsd2"), level, 19),
    ):
        for one, other in ((first, second), (second, first)):
            file = run(replace(one, body=["run 3", "write_restart a.restart"]), ranks).folder / "a.restart"
            require_refused(
                other.restarted(file, ["run 3"]),
                ranks,
                f"holds {many} numbers per contact, as many as this pair_style, but with other meanings",
            )


CASES = {
    "units": refusal(
        lambda: deck(units="electron"),
        "pair_style gran/insitu: 'units' must be consistent: si, cgs, lj or micro, got 'electron'",
    ),
    "superquadrics-without-a-surface": refusal(
        lambda: spheroids(" surface superquadric", "", rolling="cdt", extra="tangential_damping off"),
        f"pair_style gran/insitu: {BOUNDING}; got surface 'default'. Write 'pair_style gran/insitu {MODEL} "
        "rolling_friction cdt surface ellipsoid tangential_damping off'",
    ),
    "superquadrics-with-the-surface-of-spheres": refusal(
        lambda: spheroids("surface superquadric", "surface default", extra="setup neutral"),
        f"Write 'pair_style gran/insitu {MODEL} surface ellipsoid setup neutral'",
    ),
    "boxy-grains-without-a-surface": refusal(
        boxy_without_surface, f"Write 'pair_style gran/insitu {MODEL} surface superquadric'"
    ),
    "wall-without-a-surface": refusal(
        lambda: Deck(replace(dense_packing(1.5), triclinic=False), body=[WALL, "run 1"], boundary="p p f"),
        f"fix floor (wall/gran): {BOUNDING}; got surface 'default'. Add 'surface ellipsoid' after its other models",
    ),
    "superquadrics-without-a-surface-under-gran": warned_under_gran,
    "hybrid": refusal(
        lambda: as_text(PAIR, "pair_style hybrid gran/insitu"),
        "gran/insitu cannot be a sub-style of hybrid",
        "use it alone",
    ),
    "misspelt-model": refusal(
        lambda: as_text("model hertz", "model hurtz"), "pair_style gran/insitu: invalid contact model"
    ),
    "misspelt-setting": refusal(
        lambda: as_text("tangential history", "tangential history limitFours on"), "limitFours"
    ),
    "small-periodic-box": refusal(
        small_box,
        "pair_style gran/insitu: the periodic box must be at least 2 x (largest diameter x "
        "contact distance factor + skin)",
        "high along z, got 4",
    ),
    "setup-twice": refusal(
        lambda: as_text("tangential history", "tangential history setup host setup neutral"),
        "pair_style gran/insitu: 'setup' is given twice",
    ),
    **{
        f"synchronized-{name}": refusal(make, f"pair_style gran/insitu: 'time_level synchronized' {requirement}", got)
        for name, make, requirement, got in (
            ("cohesion", lambda: deck(extra=SYNCHRONIZED, cohesion="sjkr"), "works with 'cohesion' off only", "sjkr"),
            (
                "rolling",
                lambda: deck(extra=SYNCHRONIZED, rolling="cdt"),
                "works with 'rolling_friction' off only",
                "rolling_friction cdt",
            ),
            (
                "without-friction",
                lambda: deck(extra=SYNCHRONIZED, tangential="off"),
                "works with 'tangential' history and no_history only",
                "tangential off",
            ),
            (
                "surface",
                lambda: as_text("tangential history", f"tangential history surface multicontact {SYNCHRONIZED}"),
                "works with 'surface' default, superquadric and ellipsoid only",
                "surface multicontact",
            ),
            (
                "normal",
                lambda: as_text("model hertz", "model hooke/hysteresis", "run 1").replace(
                    "history", f"history {SYNCHRONIZED}"
                ),
                "works with the normal models hertz, hooke, hertz/stiffness and hooke/stiffness only",
                "hooke/hysteresis",
            ),
        )
    },
    "synchronized-wall": refusal(
        lambda: Deck(
            replace(dense_packing(atom_style="sphere"), triclinic=False),
            body=[f"fix floor all wall/gran {MODEL} rolling_friction cdt primitive type 1 zplane -1 {SYNCHRONIZED}"],
            boundary="p p f",
        ),
        "fix floor (wall/gran): 'time_level synchronized' works with 'rolling_friction' off only",
        "rolling_friction cdt",
    ),
    "synchronized-wall-misspelt": refusal(
        lambda: deck(f"{WALL} time_level synchronised"),
        "fix floor (wall/gran): 'time_level' must be synchronized or host, got 'synchronised'",
    ),
    "synchronized-under-gran": refusal(lambda: deck(extra=SYNCHRONIZED, pair="gran"), "time_level"),
    "synchronized-restart": continued_otherwise,
    "restart-of-other-columns": continued_with_as_many_columns,
    "guard-by-hand": refusal(
        lambda: deck("fix gran_insitu_guard all run/guard", "run 1"), "fix run/guard: is made by pair_style gran/insitu"
    ),
    "memory-by-hand": refusal(
        lambda: deck("fix gran_insitu_setup all setup/memory", "run 1"),
        "fix setup/memory: is made by pair_style gran/insitu",
    ),
    "newton-on": refusal(
        lambda: deck("compute c all stress/contact", tangential="off").text().replace("newton off", "newton on"),
        "compute stress/contact requires 'newton off', got 'newton on'",
    ),
}

if __name__ == "__main__":
    main(CASES)
