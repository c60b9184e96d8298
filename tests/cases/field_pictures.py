# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of fields: what is drawn of csv files that hold known numbers, and what is refused with what words."""
import os
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.collections import QuadMesh
from matplotlib.quiver import Quiver
import numpy as np
from PIL import Image

from case import main, require, require_close, require_equal
from command import asked, require_refused
from grainscope.errors import InputError
from grainscope.fields import panels, read_field, read_fields
from grainscope.rows import animate, cut, draw, frames

SIZE = np.array([4.0, 6.0, 10.0])


def quantity(k, place, step):
    """Number k of the quantities at places: other for each quantity, cell and step."""
    return (k + 1.0) * ((place - 0.5 * SIZE) @ [1.0, 10.0, 100.0]) + k + step


def write(
    name, cells, names=("rho", "v_x", "v_y", "v_z"), step=0, tilt=0.0, errors=False, coordinates="xyz", first=1.0
):
    """A csv file of quantities at the middles of a grid of SIZE, tilted along x over y; errors are 1, 2, ... times
    0.1."""
    index = np.array([(x, y, z) for z in range(cells[2]) for y in range(cells[1]) for x in range(cells[0])])
    place = (index + 0.5) / cells * SIZE
    place[:, 0] += tilt * place[:, 1]
    columns = {one: place[:, k] for k, one in enumerate(coordinates)}
    columns |= {"V": np.full(len(place), np.prod(SIZE / cells)), "N": np.arange(len(place), dtype=float) + first}
    columns |= {one: quantity(k, place, step) for k, one in enumerate(names)}
    if errors:
        columns |= {one + "_error": 0.0 * values + 0.1 * k for k, (one, values) in enumerate(list(columns.items()), 1)}
    path = Path(os.environ["GRAINSCOPE_SCRATCH"]) / name
    lines = [f"# step {step}", f"# time {0.5 * step:.17g}", f"# cells {' '.join(map(str, cells))}", ",".join(columns)]
    lines += [",".join(f"{value:.17g}" for value in row) for row in np.array(list(columns.values())).T]
    path.write_text("\n".join(lines) + "\n")
    return path


def titles(figure):
    return [axis.get_title(loc="left") for axis in figure.axes if axis.get_title(loc="left")]


def refused(call, *words):
    """An error that has all these words."""
    try:
        call()
    except InputError as error:
        missing = [word for word in words if word not in str(error)]
        require(not missing, f"'{error}' lacks {missing}")
        return
    require(False, f"nothing was refused; expected {words}")


def cells_in_order(ranks):
    """x is the fastest; numbers come back to the last bit."""
    field = read_field(write("a.csv", (3, 2, 4), step=7))
    require(field.cells == (3, 2, 4) and field.step == 7 and field.time == 3.5, f"{field}")
    require_equal(field.columns["N"], np.arange(24.0).reshape(4, 2, 3) + 1.0, "number of a cell")
    require_equal(field.columns["x"][3, 1], (np.arange(3) + 0.5) / 3 * 4.0, "x along a row")
    require_equal(field.columns["z"][:, 1, 2], (np.arange(4) + 0.5) / 4 * 10.0, "z along a column")
    require(field.quantities == ["N", "rho", "v_x", "v_y", "v_z"], f"quantities {field.quantities}")


def profiles(ranks):
    """A panel for each column and vector; each line has the column over the one axis that is resolved."""
    for axis, cells in enumerate(((5, 1, 1), (1, 5, 1), (1, 1, 5))):
        field = read_field(write("a.csv", cells))
        figure = draw([field], ["rho", "v"])
        require(titles(figure) == ["rho", "v"], f"titles {titles(figure)}")
        require(figure.axes[0].get_xlabel() == "xyz"[axis], f"label {figure.axes[0].get_xlabel()}")
        where = (np.arange(5) + 0.5) / 5 * SIZE[axis]
        for panel, names in zip(figure.axes, (["rho"], ["v_x", "v_y", "v_z"])):
            require([line.get_label() for line in panel.lines] == names, f"lines {panel.lines}")
            for line, name in zip(panel.lines, names):
                require_equal(line.get_xdata(), field.columns["xyz"[axis]].ravel(), f"places of {name}")
                require_close(line.get_xdata(), where, 1e-15, f"places of {name}")
                require_equal(line.get_ydata(), field.columns[name].ravel(), f"values of {name}")
        plt.close(figure)


def empty_cells(ranks):
    """What is of grains is not drawn where there are none; a density is 0 there."""
    field = read_field(write("a.csv", (5, 1, 1), first=0.0))
    figure = draw([field], ["rho", "v"])
    for panel, names in zip(figure.axes, (["rho"], ["v_x", "v_y", "v_z"])):
        for line, name in zip(panel.lines, names):
            require_equal(np.isnan(line.get_ydata()), [name != "rho", *[False] * 4], f"{name}: what is not drawn")
    plt.close(figure)


def error_bands(ranks):
    """From value - error to value + error, for each column that has errors; none without."""
    field = read_field(write("a.csv", (1, 1, 4), errors=True))
    require(not any("error" in title for title, _ in panels(field)), f"{panels(field)}")
    figure = draw([field], ["rho", "v"])
    for panel, names in zip(figure.axes, (["rho"], ["v_x", "v_y", "v_z"])):
        require(len(panel.collections) == len(names), f"{len(panel.collections)} bands of {names}")
        for band, name in zip(panel.collections, names):
            found = {tuple(point) for point in band.get_paths()[0].vertices}
            values, error, z = (field[one] for one in (name, name + "_error", "z"))
            for edge in (values - error, values + error):
                require(set(zip(z, edge)) <= found, f"{name}: {edge} is no edge of {sorted(found)}")
    figure = draw([read_field(write("b.csv", (1, 1, 4)))], ["rho"])
    require(not figure.axes[0].collections, "a band without errors")


def several_files(ranks):
    """A line for each file, in the order of steps whatever that of names is."""
    paths = [write(f"{name}.csv", (1, 4, 1), step=step) for name, step in (("a", 30), ("b", 10), ("c", 20))]
    fields = read_fields(paths)
    require([field.step for field in fields] == [10, 20, 30], f"steps {[field.step for field in fields]}")
    figure = draw(fields, ["rho"])
    require(len(figure.axes[0].lines) == 3, f"{len(figure.axes[0].lines)} lines")
    for line, field in zip(figure.axes[0].lines, fields):
        require_equal(line.get_ydata(), field["rho"], f"step {field.step}")
    require(len({line.get_color() for line in figure.axes[0].lines}) == 3, "colours of files")
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    require(words == ["step 10, t = 5", "step 20, t = 10", "step 30, t = 15"], f"legend {words}")


def maps(ranks):
    """The lowest cell at the lower left, edges of the grid at the edges of the picture, one map for each component."""
    planes = {"xy": (4, 3, 1), "xz": (4, 1, 3), "yz": (1, 4, 3)}
    for plane, cells in planes.items():
        field = read_field(write("a.csv", cells))
        figure = draw([field], ["rho", "v"])
        require(titles(figure) == ["rho", "v_x", "v_y", "v_z"], f"titles {titles(figure)}")
        across, up = (SIZE["xyz".index(axis)] for axis in plane)
        for axis, name in zip(figure.axes, titles(figure)):
            (image,) = axis.images
            require_close(image.get_extent(), [0.0, across, 0.0, up], 1e-15, f"extent of {name}")
            require(image.origin == "lower" and image.get_interpolation() == "nearest", f"{name} is drawn otherwise")
            require_equal(image.get_array(), field.columns[name].reshape(3, 4), f"{name} in {plane}")
            require((axis.get_xlabel(), axis.get_ylabel()) == tuple(plane), f"axes of {name} in {plane}")
        low, high = figure.axes[1].images[0].get_clim()
        require(low == -high and high == np.abs(field["v_x"]).max(), f"colours from {low} to {high}")
        colours = draw([field], ["N"]).axes[0].images[0].get_clim()
        require(colours == (1.0, 12.0), f"colours of what has one sign: {colours}")
        plt.close(figure)


def tilted_maps(ranks):
    """Cells of a tilted grid are drawn where they are."""
    field = read_field(write("a.csv", (4, 3, 1), tilt=0.25))
    figure = draw([field], ["rho"])
    (mesh,) = (one for one in figure.axes[0].collections if isinstance(one, QuadMesh))
    require_equal(np.reshape(mesh.get_array(), (3, 4)), field["rho"], "values")
    x, y = np.moveaxis(mesh.get_coordinates(), 2, 0)
    expected_y = np.repeat(np.arange(4.0) * 2.0, 5).reshape(4, 5)
    require_close(y, expected_y, 1e-14, "y of corners")
    require_close(x, np.arange(5.0) + 0.25 * expected_y, 1e-14, "x of corners")


def slices(ranks):
    """A layer of three axes, or a line of two, by its number from 0."""
    path = write("a.csv", (2, 3, 4))
    whole = read_field(path)
    for word, expected in (
        ("x=1", whole.columns["rho"][:, :, 1]),
        ("y=2", whole.columns["rho"][:, 2, :]),
        ("z=3", whole.columns["rho"][3]),
    ):
        (image,) = draw(cut([whole], word), ["rho"]).axes[0].images
        require_equal(image.get_array(), expected, word)
    flat = read_field(write("b.csv", (3, 1, 4)))
    (line,) = draw(cut([flat], "x=0"), ["rho"]).axes[0].lines
    require_equal(line.get_ydata(), flat.columns["rho"][:, 0, 0], "profile beside x=0")
    refused(lambda: cut([whole], None), "--slice", "2 x 3 x 4", "x=0 to x=1, y=0 to y=2, z=0 to z=3")
    for word in ("z=4", "w=0", "z", "z=-1", "3", "z=1.5"):
        refused(lambda: cut([whole], word), "--slice", f"'{word}'", "z=0 to z=3")
    refused(lambda: cut([read_field(write("c.csv", (1, 1, 4)))], "z=1"), "--slice z=1", "one cell", "1 x 1 x 4")
    refused(lambda: cut([read_field(write("d.csv", (1, 1, 1)))], None), "d.csv", "one cell")


def arrows(ranks):
    """The components in the plane of the map, at middles; none longer than the way to the next one."""
    for cells, names in (((4, 3, 1), "xy"), ((1, 3, 4), "yz")):
        field = read_field(write("a.csv", cells))
        (found,) = (one for one in draw([field], ["rho"], "v").axes[0].collections if isinstance(one, Quiver))
        across, up = names
        require_equal(found.U, field["v_" + across].ravel(), f"v_{across}")
        require_equal(found.V, field["v_" + up].ravel(), f"v_{up}")
        places = np.array([field[across].ravel(), field[up].ravel()]).T
        require_equal(found.get_offsets(), places, "places")
        longest = np.hypot(found.U, found.V).max() / found.scale
        spacing = min(np.diff(np.unique(places[:, k])).min() for k in (0, 1))
        require_close(longest, spacing, 1e-12, "longest arrow")
    many = read_field(write("b.csv", (60, 2, 1)))
    (found,) = (one for one in draw([many], ["rho"], "v").axes[0].collections if isinstance(one, Quiver))
    require(found.U.size <= 24, f"{found.U.size} arrows over 60 x 2 cells")
    refused(lambda: draw([many], ["rho"], "w"), "--vectors w", "w_x and w_y", "rho")
    refused(lambda: cut([read_field(write("c.csv", (1, 4, 1)))], None, "v"), "--vectors", "'v'", "profile along y")


def rings(ranks):
    """Grids about an axis have coordinates r, t, a, and vectors by these components."""
    field = read_field(write("a.csv", (4, 1, 3), ("rho", "v_r", "v_t", "v_a"), coordinates="rta"))
    require(dict(panels(field)) == {"N": ["N"], "rho": ["rho"], "v": ["v_r", "v_t", "v_a"]}, f"{panels(field)}")
    axis = draw([field], ["v_t"], "v").axes[0]
    require((axis.get_xlabel(), axis.get_ylabel()) == ("r", "a"), "axes of the map")
    (found,) = (one for one in axis.collections if isinstance(one, Quiver))
    require_equal(found.V, field["v_a"].ravel(), "v_a upwards")


def animation(ranks):
    """A frame for each file in the order of steps, on axes and with colours that do not change."""
    for cells in ((1, 1, 6), (4, 3, 1)):
        fields = read_fields([write(f"{step}.csv", cells, step=step) for step in (30, 10, 20)])
        steps, ranges = [], set()
        for figure, field in zip(frames(fields, ["rho"]), fields):
            axis = figure.axes[0]
            drawn = axis.images[0].get_array() if axis.images else axis.lines[0].get_ydata()
            require_equal(drawn, field["rho"], f"frame of step {field.step}")
            steps.append(figure.texts[0].get_text() if figure.texts else figure._suptitle.get_text())
            ranges.add(axis.images[0].get_clim() if axis.images else axis.get_ylim())
        require(steps == ["step 10, t = 5", "step 20, t = 10", "step 30, t = 15"], f"titles {steps}")
        require(len(ranges) == 1, f"ranges {ranges}")
        everything = np.array([field["rho"] for field in fields])
        low, high = ranges.pop()
        require(low <= everything.min() and high >= everything.max(), f"range {low} to {high}")
        gif = fields[0].path.with_suffix(".gif")
        animate(fields, gif, ["rho"])
        with Image.open(gif) as picture:
            require(picture.n_frames == 3, f"{picture.n_frames} frames")


def groups_and_columns(ranks):
    """All quantities without words; components of a vector stay apart where a column has its name."""
    names = ("T_x", "T_y", "T_z", "T", "Q_xx", "Q_yy", "Q_zz", "Q_xy", "Q_xz", "Q_yz", "P_n")
    field = read_field(write("a.csv", (1, 1, 3), names, errors=True))
    expected = ["N", "T_x", "T_y", "T_z", "T", "Q", "P_n"]
    require([title for title, _ in panels(field)] == expected, f"{panels(field)}")
    require(panels(field, ["Q", "T"]) == [("Q", list(names[4:10])), ("T", ["T"])], f"{panels(field, ['Q', 'T'])}")
    figure = draw([field])
    require(titles(figure) == expected, f"{titles(figure)}")
    for word in ("rhoo", "Q_x", ""):
        refused(lambda: panels(field, [word]), f"no column '{word}'", "a.csv", "T_x, T_y, T_z, T")


def not_finite(ranks):
    """What is not finite is left out; limits are those of the rest."""
    path = write("a.csv", (4, 3, 1), ("rho", "phi"))
    lines = path.read_text().splitlines()
    rows = [line.split(",") for line in lines[4:]]
    for row in rows:
        row[-1] = "nan"
    rows[0][-2], rows[5][-2] = "nan", "inf"
    path.write_text("\n".join(lines[:4] + [",".join(row) for row in rows]) + "\n")
    field = read_field(path)
    figure = draw([field], ["rho", "phi"])
    values = field["rho"][np.isfinite(field["rho"])]
    require(np.isfinite(field["rho"]).sum() == 10, f"{field['rho']}")
    largest = np.abs(values).max()
    require(figure.axes[0].images[0].get_clim() == (-largest, largest), "colours")
    require(figure.axes[1].images[0].get_clim() == (0.0, 1.0), "colours of nothing finite")
    animate([field, field], path.with_suffix(".gif"), ["phi"])


def bad_files(ranks):
    path = write("a.csv", (1, 2, 2))
    text = path.read_text()

    def changed(old, new):
        other = path.with_name("bad.csv")
        other.write_text(text.replace(old, new))
        return lambda: read_field(other)

    refused(lambda: read_field(path.with_name("none.csv")), "none.csv", "No such file")
    refused(changed("# cells 1 2 2\n", ""), "bad.csv", "'# cells'")
    refused(changed("# cells 1 2 2", "# cells 1 2 3"), "4 rows", "1 x 2 x 3 cells")
    refused(changed("# cells 1 2 2", "# cells 4"), "'4'")
    refused(changed("# cells 1 2 2", "# cells 2 2 one"), "one")
    refused(changed("x,y,z,V", "x,y,V"), "row 1", "values")
    refused(lambda: changed("x,y,z,V", "a,b,c,V")().coordinates, "no columns x, y, z or r, t, a", "a, b, c, V")
    other = write("b.csv", (1, 4, 1))
    refused(lambda: read_fields([path, other]), "same cells", "1 x 2 x 2", "1 x 4 x 1")
    other = write("c.csv", (1, 2, 2), ("rho",))
    refused(lambda: read_fields([path, other]), "same columns", "v_z")


def command_line(ranks):
    """Files of each kind, and the words of refusals."""
    paths = [write(f"{step}.csv", (4, 3, 1), step=step, errors=True) for step in (0, 10)]
    picture, page, film = (paths[0].with_suffix(ending) for ending in (".png", ".pdf", ".gif"))
    choice = ["rho", "v_x", "--vectors", "v"]
    code, said = asked("rows", *paths, *choice, "--output", picture, "--animate", film)
    require(code == 0 and said.split() == [str(picture), str(film)], said)
    code, said = asked("rows", *paths, *choice, "--output", page)
    require(code == 0 and page.read_bytes().startswith(b"%PDF"), said)
    with Image.open(film) as frames_of_film, Image.open(picture) as image:
        require(frames_of_film.n_frames == 2 and image.format == "PNG", f"{frames_of_film.n_frames}, {image.format}")
    for words, expected in (
        ([], "--output or --animate"),
        (["--output", "a.jpg"], "--output must end in .png or .pdf, got 'a.jpg'"),
        (["--animate", "a.mp4"], "--animate must end in .gif, got 'a.mp4'"),
        (["--animate", "a.gif", "--rate", 0], "--rate must be above 0"),
        (["--output", picture, "rhoo"], "no column 'rhoo'; nearest: rho"),
        (["--output", picture, "--slice", "z=1"], "--slice must be one of the layers"),
        (["--output", picture.parent / "none" / "a.png"], "No such file or directory"),
    ):
        require_refused(["rows", *paths, *words], expected)


main(
    {
        "cells-in-order": cells_in_order,
        "profiles": profiles,
        "empty-cells": empty_cells,
        "error-bands": error_bands,
        "several-files": several_files,
        "maps": maps,
        "tilted-maps": tilted_maps,
        "slices": slices,
        "arrows": arrows,
        "rings": rings,
        "animation": animation,
        "groups-and-columns": groups_and_columns,
        "not-finite": not_finite,
        "bad-files": bad_files,
        "command-line": command_line,
    }
)
