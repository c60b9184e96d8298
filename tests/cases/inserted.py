# SPDX-License-Identifier: GPL-2.0-or-later
"""Superquadrics that fix insert/pack made: in a data file, and in a run without a screen."""
from cases.data_files import ALL, DERIVED, GIVEN, INTEGERS, PLACES, reading, seen
from case import main, require, require_close, require_equal, require_same_snapshots
from deck import Deck, dump_grains
from packing import Packing
from run import attempt, run, tail


def inserted(ranks, arguments=()):
    """Superquadrics put in by fix insert/pack."""
    deck = Deck(Packing((8.0,) * 3, [], triclinic=False), boundary="f f f", timestep=1e-5)
    template = "density constant 1000 shape constant 0.5 0.5 0.75 blockiness constant 2.0 2.0"
    deck.body = [
        f"fix shapes all particletemplate/superquadric 15485863 atom_type 1 {template}",
        "fix mix all particledistribution/discrete 15485867 1 shapes 1.0",
        "region inner block 1 7 1 7 1 7 units box",
        "fix pack all insert/pack seed 32452843 distributiontemplate mix orientation random insert_every once "
        "overlapcheck yes all_in yes particles_in_region 20 region inner",
        *dump_grains(deck.packing, 1, columns=ALL),
        "run 1",
        "write_data grains.data",
    ]
    return attempt(deck, ranks, arguments=arguments)


def inserted_to_file(ranks):
    """What fix insert/pack made can be written, and comes back."""
    result = inserted(ranks)
    require(result.code == 0, tail(result.output))
    deck = Deck(Packing((8.0,) * 3, []), boundary="f f f", timestep=1e-5)
    again = run(reading(deck, result.folder / "grains.data", *seen(deck)), ranks).dump("grains.dump")[0][1]
    written = result.dump("grains.dump")[-1][1]
    require(len(written["id"]) == 20, f"{len(written['id'])} grains")
    for name in f"{INTEGERS} {GIVEN} {PLACES}".split():
        require_equal(again[name], written[name], name)
    for name in DERIVED.split():  # the template multiplies in another order
        require_close(again[name], written[name], 1e-14, name)


def screen_none(ranks):
    """fix insert/pack, of which one part prints without asking for a screen; the same grains as with one."""
    with_screen, without = inserted(ranks), inserted(ranks, ("-screen", "none"))
    require(without.code == 0, f"code {without.code}: {tail(without.output)}")
    require(without.output.strip() == "", f"it said on the screen: {tail(without.output)}")
    require("Resetting random" in with_screen.output, "nothing that printed without asking")
    require_same_snapshots(without.dump("grains.dump"), with_screen.dump("grains.dump"), "without a screen")


CASES = {
    "inserted": inserted_to_file,
    "screen-none": screen_none,
}

if __name__ == "__main__":
    main(CASES)
