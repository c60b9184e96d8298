# SPDX-License-Identifier: GPL-2.0-or-later
"""The reader of dumps, on files whose numbers are known, whole and damaged."""
from concurrent.futures import ThreadPoolExecutor
import gzip
import importlib.util
import sys

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, dump_grains, dump_local
from dump_files import new_folder, snapshot
from grainscope.dumps import Dump
from grainscope.errors import InputError
from grainscope.grains import read_grains
from packing import dense_packing, tilted
from run import run

COLUMNS = {"id": [1, 2, 3], "x": [0.1, 0.2, 1.0 / 3.0], "y": [1, -2, 3], "z": [0, 0, 1e-12]}


def written(*texts, name="grains.dump"):
    path = new_folder() / name
    path.write_text("".join(texts))
    return path


def refused(call, *words):
    try:
        call()
    except InputError as error:
        missing = [word for word in words if word not in str(error)]
        require(not missing, f"'{error}' lacks {missing}")
        return
    require(False, f"nothing was refused; expected {words}")


def many_snapshots(ranks):
    """Steps in their order, whatever that of the file; the last of one step counts; empty snapshots are snapshots."""
    later = dict(COLUMNS, x=[7.0, 8.0, 9.0])
    empty = {name: [] for name in COLUMNS}
    dump = Dump(written(*[snapshot(step, columns) for step, columns in ((20, COLUMNS), (5, empty), (20, later))]))
    require(dump.steps == [5, 20] and len(dump) == 2 and not dump.notes, f"{dump.steps} {dump.notes}")
    require_equal(dump[-1]["x"], later["x"], "x of the last")
    require_equal(dump.at(20).vectors("x", "y"), np.transpose([later["x"], COLUMNS["y"]]), "x and y")
    require([len(one) for one in dump] == [0, 3], "numbers of rows")
    require(list(dump[0].columns) == list(COLUMNS) and dump[0]["x"].shape == (0,), "columns of an empty snapshot")


def many_files(ranks):
    """A file for each step, some of them compressed; patterns are sorted by steps, not by names."""
    folder = new_folder()
    for step in (900, 1000):
        (folder / f"grains.{step}.dump").write_text(snapshot(step, dict(COLUMNS, x=[step, 0, 0])))
    with gzip.open(folder / "grains.50.dump.gz", "wt") as file:
        file.write(snapshot(50, dict(COLUMNS, x=[50, 0, 0])) + snapshot(60, dict(COLUMNS, x=[60, 0, 0])))
    dump = Dump(str(folder / "grains.*"))
    require(dump.steps == [50, 60, 900, 1000], str(dump.steps))
    require([one["x"][0] for one in dump] == dump.steps, "x is the step")
    (folder / "grains.again").write_text(snapshot(900, COLUMNS))
    refused(lambda: Dump(str(folder / "grains.*")), "step 900 is in two files", "grains.900.dump", "grains.again")


def side_by_side(ranks):
    """Snapshots in files of their own that threads read at the same time, as a film does. Threads change as often as
    they can, so that one that takes another's file is seen."""
    folder = new_folder()
    for step in range(8):
        (folder / f"grains.{step}.dump").write_text(snapshot(step, dict(COLUMNS, x=[step, 0, 0])))
    dump, before = Dump(str(folder / "grains.*")), sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda step: (step, dump.at(step).step, dump.at(step)["x"][0]), [*range(8)] * 500))
    sys.setswitchinterval(before)
    wrong = [one for one in found if len(set(one)) > 1]
    require(not wrong, f"{len(wrong)} of {len(found)} are of other steps, the first: {wrong[:3]}")


def boxes(ranks):
    """Edges of orthogonal and tilted boxes, also tilted against the axes; LIGGGHTS writes the bounds around them."""
    for tilts in (None, (2.0, 1.0, 0.5), (-3.0, -1.0, 0.5), (1.0, -2.5, -0.5)):
        box = Dump(written(snapshot(0, COLUMNS, (10.0, 8.0, 6.0), tilts)))[0].box
        xy, xz, yz = tilts or (0.0, 0.0, 0.0)
        require_close(box.edges, [[10, 0, 0], [xy, 8, 0], [xz, yz, 6]], 1e-15, f"edges, {tilts}")
        require_close(box.origin, [0, 0, 0], 1e-14, "origin", 1.0)
        require(list(box.periodic) == [True, True, False], "periodic edges")
        far = 2 * box.edges[0] - box.edges[1] + 3 * box.edges[2]
        near = np.array([0.3, -0.2, 0.1])
        require_close(box.nearest((near + far)[None])[0], near + 3 * box.edges[2], 1e-14, "nearest image", 10.0)


def cut_off(ranks):
    """Wherever a file ends, its whole snapshots are read, and what is left out is said; a resumed run goes on."""
    first, second = snapshot(10, COLUMNS), snapshot(20, COLUMNS)
    for end in range(1, len(second)):
        dump = Dump(written(first, second[:end]))
        whole = end == len(second)
        said = not whole and second.startswith("ITEM: TIMESTEP\n", 0, end)
        require(dump.steps == ([10, 20] if whole else [10]), f"cut at {end}: {dump.steps}")
        require(bool(dump.notes) == said, f"cut at {end}: {dump.notes}")
        if "\n1 " in second[:end]:
            require("step 20 is incomplete" in dump.notes[0], dump.notes[0])
        resumed = Dump(written(first, second[:end], second))
        require(resumed.steps == [10, 20], f"cut at {end} and resumed: {resumed.steps}")
        require_equal(resumed[1]["x"], COLUMNS["x"], "x")
    refused(lambda: Dump(written(second[:-2])), "no whole snapshot", "step 20 is incomplete, 2 whole rows of 3")


def refusals(ranks):
    dump = Dump(written(snapshot(0, COLUMNS)))
    refused(lambda: dump[0]["vx"], "no column vx; it has id x y z")
    refused(lambda: dump[0].require("vx", "x", "vy"), "no column vx, vy")
    refused(lambda: dump.at(3), "no snapshot of step 3", "there are 0")
    refused(lambda: Dump(str(new_folder() / "none.*")), "none.*: no such file")
    refused(lambda: Dump(str(new_folder() / "none")), "none: No such file")
    refused(lambda: Dump(written("")), "not a text dump of LIGGGHTS", "ITEM: TIMESTEP")
    refused(lambda: Dump(written("# step x\n1 2\n")), "not a text dump of LIGGGHTS")
    text = snapshot(0, COLUMNS)
    damaged = Dump(written(text.replace("\n2 ", "\n2 3 ")))
    refused(lambda: damaged[0], "step 0 is damaged", "row 2 has 5 values for 4 columns")
    refused(lambda: Dump(written(text.replace("0.2", "0.2.3")))[0], "step 0 is damaged", "'0.2.3")
    refused(lambda: Dump(written(text.replace("10.0", "ten")))[0], "step 0 is damaged", "ten")
    refused(lambda: read_grains(written(snapshot(0, {name: [] for name in COLUMNS}))), "holds no grains")
    refused(lambda: read_grains(written(text)), "no column radius", "x y z radius", "quat1 quat2 quat3 quat4")


def words_and_frames(ranks):
    """Columns of words, as `element`, beside numbers; a DataFrame where there is pandas, a sentence where not."""
    one = Dump(written(snapshot(0, dict(COLUMNS, element=["C", "O", "7"]))))[0]
    require(list(one["element"]) == ["C", "O", "7"], str(one["element"]))
    require_equal(one["x"], COLUMNS["x"], "x beside words")
    if importlib.util.find_spec("pandas"):
        require(list(one.frame().columns) == [*COLUMNS, "element"] and len(one.frame()) == 3, "the frame")
    else:
        refused(one.frame, "python3-pandas")


def of_a_run(ranks):
    """Dumps that LIGGGHTS itself wrote, of grains and of contacts, against the harness's own reader."""
    packing = tilted(dense_packing(1.5, (1.0, 0.8)), 0.3)
    deck = Deck(packing, surface="ellipsoid", extra="tangential_damping off")
    deck.body = ["compute contacts all contact/local", *dump_local("contacts", 30, 5, "contacts")]
    deck.body += [*dump_grains(packing, 5), "run 10"]
    result = run(deck, ranks)
    for name in ("grains.dump", "contacts.dump"):
        ours, own = Dump(result.file(name)), result.dump(name)
        require(ours.steps == [step for step, _ in own] == [0, 5, 10], f"{name}: {ours.steps}")
        for one, (_, columns) in zip(ours, own):
            require(list(one.columns) == list(columns) and len(one) > 0, f"{name}: {list(one.columns)}")
            for column, values in columns.items():
                require_equal(one[column], values, f"{name} {column}")
    require_close(ours[0].box.edges[1], [0.3 * packing.edges[0], packing.edges[1], 0], 1e-5, "the tilted edge")


main(
    {
        "many-snapshots": many_snapshots,
        "many-files": many_files,
        "side-by-side": side_by_side,
        "boxes": boxes,
        "cut-off": cut_off,
        "refusals": refusals,
        "words-and-frames": words_and_frames,
        "of-a-run": of_a_run,
    }
)
