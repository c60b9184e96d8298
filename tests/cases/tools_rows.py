# SPDX-License-Identifier: GPL-2.0-or-later
"""grainscope-tools rows on tables of fix ave/time mode vector and fix ave/spatial: what is read, drawn and refused.
Files of fix field/write are the matter of field_pictures.py."""
import os
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from case import main, require, require_close, require_equal
from command import asked, require_refused
from deck import Deck, dump_grains
from grainscope.fields import read_fields
from grainscope.rows import draw
from packing import dense_packing
from run import run

EXAMPLE = "# Time-averaged data for fix bins\n# TimeStep Number-of-rows\n# Row c_a[1] c_a[2] r\n"


def written(name, steps, rows=3, header=EXAMPLE):
    """Tables at these steps: row k of step s has the values s + k, s - k and k/10."""
    path = Path(os.environ["GRAINSCOPE_SCRATCH"]) / name
    tables = [f"{s} {rows}\n" + "".join(f"{k} {s + k} {s - k} {k / 10}\n" for k in range(1, rows + 1)) for s in steps]
    path.write_text(header + "".join(tables))
    return path


def titles(figure):
    return [axis.get_title(loc="left") for axis in figure.axes if axis.get_title(loc="left")]


def tables(ranks):
    """A panel for each column, a line for each step, over the first column or another; several files in the order of
    their steps."""
    a, b = written("a.txt", [200, 400]), written("b.txt", [300], rows=5)
    fields = read_fields([a, b])
    require([field.step for field in fields] == [200, 300, 400], f"steps {[field.step for field in fields]}")
    figure = draw(fields)
    require(titles(figure) == ["c_a[1]", "c_a[2]", "r"], f"titles {titles(figure)}")
    k = np.arange(1.0, 6.0)
    for panel, name in zip(figure.axes, titles(figure)):
        require(panel.get_xlabel() == "Row", f"label {panel.get_xlabel()}")
        require(len(panel.lines) == 3, f"{len(panel.lines)} lines")
        for line, step, rows in zip(panel.lines, (200, 300, 400), (3, 5, 3)):
            expected = {"c_a[1]": step + k, "c_a[2]": step - k, "r": k / 10}[name][:rows]
            require_equal(line.get_xdata(), k[:rows], f"{name}: rows")
            require_equal(line.get_ydata(), expected, f"{name}: values")
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    require(words == [f"{a}, step 200", f"{b}, step 300", f"{a}, step 400"], f"legend {words}")
    figure = draw(read_fields([a], "r"), ["c_a[2]"])
    require(figure.axes[0].get_xlabel() == "r" and titles(figure) == ["c_a[2]"], f"{titles(figure)}")
    require_equal(figure.axes[0].lines[0].get_xdata(), k[:3] / 10, "over r")
    plt.close("all")


def files_of_the_program(ranks):
    """Bins of fix ave/spatial hold what a dump of the same step says, in the six digits of the file; fix ave/time mode
    vector has the array of compute fabric's axes."""
    deck = Deck(dense_packing())
    deck.body += [
        "compute fabric all fabric",
        "fix tables all ave/time 2 1 2 c_fabric mode vector file tables.txt",
        "fix bins all ave/spatial 2 1 2 x lower 0.5 vx units reduced file bins.txt",
        *dump_grains(deck.packing, 2),
        "run 4",
    ]
    result = run(deck, ranks)
    for name, columns in (("tables.txt", ["Row", "c_fabric"]), ("bins.txt", ["Bin", "Coord", "Ncount", "vx"])):
        fields = read_fields([result.file(name)])
        require([list(field.columns) for field in fields] == [columns] * len(fields), f"{name}: {fields[0].has}")
    snapshots = dict(result.dump("grains.dump"))
    for field in fields:
        grains = snapshots[field.step]
        require(field["Ncount"].sum() == len(grains["x"]), f"{field['Ncount']} of {len(grains['x'])} grains")
        momentum = (field["Ncount"] * field["vx"]).sum()
        require_close(momentum, grains["vx"].sum(), 1e-5, "sum of vx", np.abs(grains["vx"]).sum())


def incomplete(ranks):
    """A last table that the run has not ended is left out, and said."""
    whole = written("a.txt", [200, 400]).read_text()
    for cut in (1, 2, 10, 40):  # without the end of the last line, a digit, words, rows
        path = written("a.txt", [200, 400])
        path.write_text(whole[:-cut])
        picture = path.with_suffix(".png")
        code, said = asked("rows", path, "--output", picture)
        require(code == 0 and "the table of step 400 is incomplete and left out" in said, f"{cut}, {code}: {said}")
        require(len(read_fields([path])) == 1, f"tables, cut {cut}")
    code, said = asked("rows", written("b.txt", []), "--output", picture)
    require(code == 1 and "at least one row" in said, f"{code}: {said}")


def command_line(ranks):
    """A picture, a film; and words that are refused."""
    path = written("a.txt", [200, 400])
    picture, film = path.with_suffix(".png"), path.with_suffix(".gif")
    code, said = asked("rows", path, "c_a[1]", "--against", "r", "--output", picture, "--animate", film)
    require(code == 0 and said.split() == [str(picture), str(film)], said)
    with Image.open(film) as frames:
        require(frames.n_frames == 2, f"{frames.n_frames} frames")
    csv = path.with_name("a.csv")
    csv.write_text("# step 0\n# time 0\n# cells 2 1 1\nx,y,z,V,N\n0,0,0,1,1\n1,0,0,1,1\n")
    series = path.with_name("series.txt")
    series.write_text("# TimeStep c_a c_b\n0 1.5 2.5\n1 1.5 2.5\n")
    for words, expected in (
        ([path], "--output or --animate must name a file"),
        ([path, "c_a[3]", "--output", picture], "no column 'c_a[3]'; nearest: c_a"),
        ([path, "--against", "q", "--output", picture], "no column 'q'; it has Row"),
        ([path, "--vectors", "c", "--output", picture], "--vectors is for maps, got 'c' for a profile along Row"),
        ([path, "--slice", "Row=1", "--output", picture], "--slice Row=1 leaves one cell"),
        ([path, csv, "--output", picture], f"{csv} is, {path} is not"),
        ([csv, "--against", "x", "--output", picture], "--against is for tables of fix ave/time, got 'x'"),
        ([series, "--output", picture], "a row for each step is for `plot`"),
        ([path.with_name("none.txt"), "--output", picture], "none.txt: No such file"),
    ):
        require_refused(["rows", *words], expected)


main(
    {
        "tables": tables,
        "files-of-the-program": files_of_the_program,
        "incomplete": incomplete,
        "command-line": command_line,
    }
)
