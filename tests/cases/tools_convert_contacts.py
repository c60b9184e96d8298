# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts of runs as lines for ParaView: where they begin and end, how long they are, what they carry."""
import re
import shlex

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, dump_grains, dump_local
from dump_files import PAGE, converted, new_folder, refused, snapshot
from grainscope.columns import outputs
import plates
from packing import dense_packing, disc_packing, tilted
from run import run
from vtp import collection

NAMES = outputs("contact/local").names("local")[:30]


def lines_of(deck, ranks, words="", width=30, steps=10):
    """A run that dumps grains and contacts, and by time the grains, the contacts and the rows of the contacts' dump."""
    deck.body += [f"compute contacts all contact/local {words}", *dump_local("contacts", width, steps, "contacts")]
    deck.body += [*dump_grains(deck.packing, steps), f"run {2 * steps}"]
    result = run(deck, ranks)
    options = ["--contact-columns", *words.split()] if words else []
    words = ["grains.dump", "--to", "vtk", "--contacts", "contacts.dump", *options]
    converted(*words, folder=result.folder)
    grains, contacts = (collection(result.folder / "vtk" / f"{kind}.pvd") for kind in ("grains", "contacts"))
    return [(grains[step], contacts[step], columns) for step, columns in result.dump("contacts.dump")]


def triples(columns, name):
    return np.transpose([columns[f"c_contacts[{NAMES.index(f'{name}_{end}') + 1}]"] for end in "xyz"])


def check_lines(grains, contacts, columns, edges):
    """Each begins at the centre of i, has its middle at the contact point and ends at an image of the centre of j; or
    at a wall. Returns how many cross a periodic face."""
    centres = dict(zip(grains.point_data["id"], grains.points))
    branch, point = triples(columns, "branch"), triples(columns, "point")
    require(len(contacts.lines) == len(branch) > 0, f"{len(contacts.lines)} lines for {len(branch)} contacts")
    crossing = 0
    scale = np.linalg.norm(edges[0])
    for k, line in enumerate(contacts.lines):
        i, j = contacts.cell_data["id_i"][k], contacts.cell_data["id_j"][k]
        corners = contacts.points[line]
        require_close(
            corners[0], centres[i], 1e-5, "a line begins at i", scale
        )  # of a box that is dumped with 6 digits
        require_close(corners[1], point[k], 1e-12, "it goes through the contact point", scale)
        length = np.linalg.norm(branch[k])
        require_close(np.linalg.norm(corners[-1] - corners[0]), length, 1e-12, "its length is that of the branch")
        if j == 0:
            require(len(line) == 2, "it ends at the wall")
            continue
        images = (corners[2] - centres[j]) @ np.linalg.inv(edges)
        require_close(images, np.round(images), 1e-5, "it ends at an image of j", 1.0)
        crossing += bool(np.abs(images).max() > 0.5)
        there = corners[2] - corners[0]
        across = np.linalg.norm(np.cross(corners[1] - corners[0], there)) / length
        require(
            0 < (corners[1] - corners[0]) @ there < length**2 and across < 0.5 * length, "the point is between them"
        )
    for name in ("fn", "overlap", "mobilisation"):
        require_equal(contacts.cell_data[name], columns[f"c_contacts[{NAMES.index(name) + 1}]"], name)
    require_equal(contacts.cell_data["force"], triples(columns, "force"), "force")
    counts = [len(line) for line in contacts.lines]
    require_equal(
        contacts.point_data["fn"], np.repeat(contacts.cell_data["fn"], counts), "fn at the points of the lines"
    )
    return crossing


def in_a_box(packing, **choices):
    def case(ranks):
        cell = np.array([[packing.edges[0], 0, 0], [packing.tilt, packing.edges[1], 0], [0, 0, packing.edges[2]]])
        for grains, contacts, columns in lines_of(Deck(packing, **choices), ranks):
            crossing = check_lines(grains, contacts, columns, cell)
            require(20 < crossing < 0.7 * len(contacts.lines), f"{crossing} of {len(contacts.lines)} cross a face")
            require(set(contacts.cell_data) >= {"sliding", "slip", "ft", "un", "image", "normal"}, "all columns")

    return case


def with_walls(ranks):
    """Contacts with a floor at z = 0 and with a mesh above end at the wall."""
    packing = plates.bed(layers=2)
    deck = plates.plated(packing)
    found = np.zeros(2, dtype=int)
    for grains, contacts, columns in lines_of(deck, ranks):
        check_lines(grains, contacts, columns, np.diag(packing.edges))
        walls = contacts.cell_data["id_j"] == 0
        ends = np.array([contacts.points[line[-1]][2] for line, wall in zip(contacts.lines, walls) if wall])
        overlaps = contacts.cell_data["overlap"][walls]
        away = np.abs(ends[:, None] - [0.0, plates.top_of(packing)])
        require(bool((away.min(axis=1) <= overlaps).all() and overlaps.max() < 0.1), f"lines end at the walls: {ends}")
        found += np.bincount(away.argmin(axis=1), minlength=2)
    require(found[0] > 10 and found[1] > 0, f"{found} contacts with floor and mesh")


def chosen_columns(ranks):
    """The words that the compute was given name its columns, in their order."""
    packing = dense_packing()
    for grains, contacts, columns in lines_of(Deck(packing), ranks, "branch fn id point", 9):
        require(set(contacts.cell_data) == {"branch", "fn", "id_i", "id_j", "point"}, f"{set(contacts.cell_data)}")
        require_equal(contacts.cell_data["fn"], columns["c_contacts[4]"], "fn")
        require_equal(contacts.cell_data["id_j"], columns["c_contacts[6]"], "id_j")


def page(ranks):
    """What doc/visualise.md says for ParaView, word for word: lines of the input script and the command."""
    found = re.search(r"## ParaView.*?```\n(.*?)```.*?\n    grainscope-tools convert (.*?)\n", PAGE.read_text(), re.S)
    require(found is not None, f"{PAGE}: no code block and command under '## ParaView'")
    packing = dense_packing(1.5)
    result = run(Deck(packing, [*found[1].replace(" 1000 ", " 10 ").splitlines(), "run 10"]), ranks)
    words = shlex.split(found[2])
    converted(*words, folder=result.folder)
    dt = float(words[words.index("--dt") + 1])
    for kind in ("grains", "surfaces", "contacts", "box"):
        data = collection(result.folder / "vtk" / f"{kind}.pvd")
        require_close(list(data), [0.0, 10 * dt], 1e-12, f"times of {kind}")
    require(len(data[0.0].lines) == 12, "the box")
    contacts = collection(result.folder / "vtk" / "contacts.pvd")[0.0]
    require(set(contacts.cell_data) == {"id_i", "id_j", "point", "branch", "force", "fn"}, str(set(contacts.cell_data)))
    require(len(contacts.lines) > len(packing.grains), "contacts")


def rows(**columns):
    """A dump local of one contact, of the columns that are named; others are 0."""
    values = dict.fromkeys(NAMES, 0.0) | {"id_i": 1, "id_j": 2, "normal_x": 1.0, "branch_x": 1.9} | columns
    return {f"c_contacts[{k}]": [values[name]] for k, name in enumerate(NAMES, 1)}


def across_a_face(ranks):
    """Where a grain was dumped on the other side of the box, its line is at its contact: short, not across the box."""
    folder = new_folder()
    spheres = {"id": [1, 2], "x": [0.05, 8.15], "y": [0.0, 0.5], "z": [9.9, 0.0], "radius": [1.0, 1.0]}
    text = snapshot(0, spheres, tilts=(1.0, 0.0, 0.0), sides="pp pp ff")
    (folder / "grains").write_text(text)
    # i is dumped at x = 0.05, y = 0; its image that touches is at x = 11.05, y = 10
    place = {"point_x": 10.1, "point_y": 10.25, "point_z": 9.9, "branch_x": 1.9, "branch_y": -0.5}
    (folder / "contacts").write_text(snapshot(0, rows(**place), tilts=(1.0, 0.0, 0.0), kind="ENTRIES"))
    converted("grains", "--to", "vtk", "--contacts", "contacts", folder=folder)
    found = collection(folder / "vtk" / "contacts.pvd")[0.0]
    require_close(found.points, [[11.05, 10, 9.9], [10.1, 10.25, 9.9], [9.15, 10.5, 9.9]], 1e-14, "the line")


def refusals(ranks):
    """Columns that are missing or are others, steps and grains that are not there."""
    folder = new_folder()
    spheres = {"id": [1, 2], "x": [0.0, 1.9], "y": [0.0, 0.0], "z": [0.0, 0.0], "radius": [1.0, 1.0]}
    (folder / "grains").write_text(snapshot(0, spheres))
    words = ["grains", "--to", "vtk", "--contacts", "contacts"]

    def contacts(columns, step=0):
        (folder / "contacts").write_text(snapshot(step, columns, kind="ENTRIES"))

    whole = rows()
    contacts({name: values for name, values in whole.items() if name != "c_contacts[13]"})
    remedy = " ".join(f"c_contacts[{k}]" for k in (1, 2, 6, 7, 8, 12, 13, 14, 16, 17, 18, 19))
    remedy = f"dump contacts all local 1000 contacts.*.dump {remedy}"
    refused("convert", words, "no column branch_y", "compute contacts all contact/local\n", remedy, folder=folder)
    contacts(rows(normal_x=0.5))
    refused("convert", words, "do not hold normal", "--contact-columns", folder=folder)
    contacts(rows(image_y=0.25))
    refused("convert", words, "do not hold image_y", folder=folder)
    refused("convert", [*words, "--contact-columns", "id", "fn"], "a column c_contacts[4], but", folder=folder)
    refused("convert", [*words, "--contact-columns", "id", "fnn"], "must be of id image", "'fnn'", folder=folder)
    contacts(whole | {"c_other[1]": [1.0]})
    refused("convert", words, "of one compute contact/local", "c_contacts, c_other", folder=folder)
    contacts(whole, step=10)
    refused("convert", words, "in the same steps", "steps 10", "steps 0", folder=folder)
    (folder / "grains").write_text(snapshot(0, spheres) + snapshot(1, spheres))
    later = {name: values for name, values in whole.items() if name != "c_contacts[1]"}
    (folder / "contacts").write_text("".join(snapshot(*one, kind="ENTRIES") for one in ((0, whole), (1, later))))
    refused("convert", words, "no column id_i", folder=folder)
    require(not (folder / "vtk").exists(), "something was written before contacts were refused")
    contacts(rows(id_i=7))
    messages = converted(*words, folder=folder)
    require("1 contacts are left out" in messages, messages)
    text = snapshot(0, whole, kind="ENTRIES") + snapshot(5, whole, kind="ENTRIES")
    (folder / "contacts").write_text(text + snapshot(9, whole, kind="ENTRIES")[:-3])
    messages = converted(*words, folder=folder)
    require("contacts of 1 steps are left out" in messages and "step 9 is incomplete" in messages, messages)
    found = collection(folder / "vtk" / "contacts.pvd")[0.0]
    require_equal(found.points, [[0, 0, 0], [0, 0, 0], [-1.9, 0, 0]], "the line of a contact")
    contacts({name: [] for name in whole})
    converted(*words, folder=folder)
    require(len(collection(folder / "vtk" / "contacts.pvd")[0.0].lines) == 0, "lines of no contacts")


main(
    {
        "spheres": in_a_box(dense_packing(atom_style="sphere")),
        "spheroids": in_a_box(tilted(dense_packing(1.5, (1.0, 0.8)), 0.3), surface="ellipsoid"),
        "discs": in_a_box(disc_packing()),
        "with-walls": with_walls,
        "chosen-columns": chosen_columns,
        "across-a-face": across_a_face,
        "page": page,
        "refusals": refusals,
    }
)
