# SPDX-License-Identifier: GPL-2.0-or-later
"""grainscope-tools render: walls, force chains, boxes and parts of a dump, by the pixels that they cover."""
import numpy as np
import scipy.ndimage

from case import main, require, require_close, require_equal
from deck import Deck, dump_grains, dump_local
from dump_files import new_folder, snapshot, tool
from grainscope.dumps import Dump
from grainscope.render.chains import chains_of, radii
from grainscope.render.drawn import drawn_of
from grainscope.render.walls import below, edges_of
from packing import dense_packing
from pixels import KINDS, cover, drawn, middle, moments, spheres, spot
import meshes
from run import run

FRONT = ["--view", 0, 0, "--orthographic", "--colour", "type"]
WALL = (197, 203, 212)  # the colour 0.55, 0.60, 0.66 of linear light, as sRGB
CHAINS = ["--only-contacts", "--view", 0, 0, "--orthographic", "--contact-columns", "id", "branch", "fn"]


def scale_of(picture, kinds, places):
    """Pixels per length, from two grains."""
    one, other = (middle(cover(picture, KINDS[kind])) for kind in kinds)
    return np.linalg.norm(one - other) / np.linalg.norm(np.subtract(*places))


def walls(ranks):
    """A square of 4 x 4 before a grain: solid it hides it and covers its area, transparent it lets it through, wire
    covers almost nothing. Two grains beside it tell the scale."""
    places = [(1, 5, 0), (9, 5, 0), (5, 5, 0)]
    columns = spheres(places, 0.5)
    folder = meshes.folder_with(square=meshes.rectangle((3, 3, 2), (4, 0, 0), (0, 4, 0)))
    for style in ("solid", "transparent", "wire"):
        words = [*FRONT, "--walls", "square.stl", "--wall-style", style]
        picture = drawn(columns, *words, folder=folder, size=(400, 300))
        scale = scale_of(picture, (0, 1), places[:2])
        area = spot(picture, WALL).sum() / scale**2
        if style == "solid":
            require_close(area, 16.0, 0.03, "area of the wall")
            require(not spot(picture, KINDS[2]).any(), "the grain behind is seen")
        elif style == "wire":
            drawn_lines = np.any(picture < 245, axis=-1) & (np.ptp(picture, axis=-1) < 25)
            require(30 < drawn_lines.sum() < 4000, f"{drawn_lines.sum()} pixels of a wire")
            centre_row = drawn_lines[picture.shape[0] // 2]
            require(2 <= centre_row.sum() <= 8, f"{centre_row.sum()} pixels of two edges; a diagonal is no edge")
            require_close(moments(cover(picture, KINDS[2]))[0] / scale**2, np.pi * 0.25, 0.03, "the grain behind")
        else:
            behind = picture[tuple(np.round(middle(cover(picture, KINDS[0]))[::-1]).astype(int))]
            require_close(behind, KINDS[0], 1.0, "a grain beside it", 1.0)
            seen = picture[
                tuple(np.round(np.mean([middle(cover(picture, KINDS[k])) for k in (0, 1)], axis=0)[::-1]).astype(int))
            ]
            require(seen[1] > seen[0] + 20 and seen[1] > seen[2] + 20, f"a green grain behind it has the colour {seen}")
            require(np.abs(seen - KINDS[2]).max() > 10, "there is no wall before it")


def wall_edges(ranks):
    """Of a box the 12 edges, also where triangles are given by other corners first; of a prism of 24 sides its rims."""
    triangles = np.array(meshes.box((0, 0, 0), (1, 2, 3)), dtype=float)
    require(len(edges_of(triangles, 30.0)) == 12, f"{len(edges_of(triangles, 30.0))} edges of a box")
    require_close(
        np.linalg.norm(np.diff(edges_of(triangles, 30.0), axis=1), axis=-1).sum(), 24.0, 1e-12, "their length"
    )
    rolled = np.array([np.roll(one, k, axis=0)[:: 1 if k else -1] for k, one in enumerate(triangles)])
    require(len(edges_of(rolled, 30.0)) == 12, "edges of the same triangles, other corners first")
    drum = np.array(meshes.drum(2.0, 0.0, 5.0), dtype=float)
    require(len(edges_of(drum, 30.0)) == 48, f"{len(edges_of(drum, 30.0))} edges of a drum: two rims")
    require(len(edges_of(drum, 1.0)) == 72, f"{len(edges_of(drum, 1.0))} edges of its sides too")
    require(len(edges_of(triangles[:1], 30.0)) == 3, "a triangle")


def primitives(ranks):
    """A cylinder has the width of its diameter and the height of the box or of the ends that it was given; a plane
    fills the box."""
    places = [(1, 1, 1), (9, 1, 1)]
    columns = spheres(places, 0.4)
    for words, expected in (
        (("ycylinder", 2, 5, 5), 4.0 * 10.0),
        (("ycylinder", 2, 5, 5, 3, 8.5), 4.0 * 5.5),
        (("zcylinder", 3, 5, 5), np.pi * 9.0),
        (("zplane", 0.5), 100.0),
    ):
        picture = drawn(columns, *FRONT, "--primitive", *words, "--wall-style", "solid", size=(400, 340))
        scale = scale_of(picture, (0, 1), places)
        shown = spot(picture, WALL)
        area = shown.sum() / scale**2
        if words[0] == "zcylinder":  # seen along it: a ring without width
            across = np.ptp(np.argwhere(shown), axis=0) / scale
            require_close(across, [6.0, 6.0], 0.03, "the ring's width and height")
        else:
            less = 2 * np.pi * 0.16 if words[0] == "zplane" else 0.0
            require_close(area, expected - less, 0.03, f"area of {words}")


def cuts(ranks):
    """Grains whose centres are between the ends of all cuts, and walls there."""
    places = [(x, y, 0.0) for x in (1, 5, 9) for y in (1, 5, 9)]
    columns = spheres(places, 0.4)
    folder = meshes.folder_with(square=meshes.rectangle((0, 0, -1), (10, 0, 0), (0, 10, 0)))
    for words, kept in (
        (["--cut", "x", 4, 6], {3, 4, 5}),
        (["--cut", "x", -1e-3, 6e0, "--cut", "y", 5, 11], {1, 2, 4, 5}),
        (["--where", "x > 4 and not y == 5", "--cut", "y", 0, 2], {3, 6}),
    ):
        picture = drawn(columns, *FRONT, *words, folder=folder)
        shown = {kind for kind in range(9) if spot(picture, KINDS[kind]).sum() > 20}
        # colours are by kinds that are there: as many as there are grains
        require(shown == set(range(len(kept))), f"{words}: {len(shown)} grains are seen, {len(kept)} expected")
    words = ["--walls", "square.stl", "--wall-style", "solid", "--cut", "x", 4, 10, "--cut", "y", 0, 6]
    picture = drawn(columns, *FRONT, *words, folder=folder, size=(300, 320))
    scale = scale_of(picture, (0, 3), [(5, 1, 0), (9, 5, 0)])
    area = spot(picture, WALL).sum() / scale**2
    require_close(area, 36.0 - 4 * np.pi * 0.16, 0.03, "area of a wall that is cut twice")
    # behind the part of a cylinder that is cut off its other half is seen
    words = ["--primitive", "ycylinder", 2, 5, 0, 2, 8, "--wall-style", "solid", "--cut", "z", -5, 0]
    picture = drawn(spheres([(1, 5, -3), (9, 5, -3)], 0.4), *FRONT, *words, size=(300, 320))
    scale = scale_of(picture, (0, 1), [(1, 5, 0), (9, 5, 0)])
    require_close(spot(picture, WALL).sum() / scale**2, 24.0, 0.03, "area of half a cylinder")


def wall_parts(ranks):
    """What is left of a cube's faces between two planes has the area of these parts; of many triangles at random places
    the parts below and above a plane have the whole area, and lie there."""
    cube = np.array(meshes.box((0, 0, 0), (1, 1, 1)), dtype=float)
    left = below(below(cube, 2, 0.75, 1.0), 2, 0.5, -1.0)
    require_close(areas(left).sum(), 4 * 0.25, 1e-12, "four strips of a cube")
    require_close(areas(below(cube, 0, 1.0, 1.0)).sum(), 6.0, 1e-12, "a plane through a face cuts nothing off")
    require(len(below(cube, 0, -0.1, 1.0)) == 0, "nothing is below the cube")
    triangles = np.random.default_rng(5).uniform(-1.0, 1.0, (200, 3, 3))
    for axis in range(3):
        lower, upper = below(triangles, axis, 0.2, 1.0), below(triangles, axis, 0.2, -1.0)
        require(lower[..., axis].max() < 0.2 + 1e-12 and upper[..., axis].min() > 0.2 - 1e-12, f"axis {axis}")
        require_close(areas(lower).sum() + areas(upper).sum(), areas(triangles).sum(), 1e-12, "both parts together")


def areas(triangles):
    return 0.5 * np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)


def wrapped(ranks):
    """A grain outside a periodic box is drawn inside, of one that is not periodic where it is; the box's edges go from
    corner to corner."""
    places = [(11, 2, 5), (5, 2, 5), (5, 12, 5)]
    columns = spheres(places, 0.3)
    picture = drawn(columns, *FRONT, "--box", sides="pp ff pp", size=(300, 320))
    scale = scale_of(picture, (1, 0), [(5, 2, 5), (1, 2, 5)])
    spots = np.array([middle(cover(picture, KINDS[kind])) for kind in range(3)])
    require_close((spots[0] - spots[1]) / scale, [-4.0, 0.0], 0.02, "x = 11 is at 1", 10.0)
    require_close((spots[2] - spots[1]) / scale, [0.0, -10.0], 0.02, "y = 12 stays", 10.0)
    edges = spot(picture, (118, 118, 118), 8)
    low, high = np.argwhere(edges).min(axis=0)[::-1] + 0.5, np.argwhere(edges).max(axis=0)[::-1] + 0.5
    expected = spots[1] + scale * np.array([[-5.0, 2.0], [5.0, -8.0]])
    require_close([low[0], high[1]], expected[0], 2.5, "lower left corner of the box", 1.0)
    require_close([high[0], low[1]], expected[1], 2.5, "upper right corner of the box", 1.0)


def boxes_and_arrows(ranks):
    """A periodic box is drawn, one with walls is not; arrows where it is sheared. Both as asked for."""
    grey, dark = (161, 161, 161), (118, 118, 118)
    columns = spheres([(5, 5, 5)], 2.0)
    for words, more, box, arrows in (
        ([], {"sides": "pp pp pp"}, True, False),
        ([], {"sides": "pp pp ff"}, False, False),
        (["--no-box"], {"sides": "pp pp pp"}, False, False),
        (["--box"], {"sides": "ff ff ff"}, True, False),
        ([], {"sides": "pp pp pp", "tilts": (0.0, 0.0, 0.0)}, True, False),
        ([], {"sides": "pp pp pp", "tilts": (2.0, 0.0, 0.0)}, True, True),
        (["--arrows", "none"], {"sides": "pp pp pp", "tilts": (2.0, 0.0, 0.0)}, True, False),
        (["--arrows", "xz"], {"sides": "pp pp pp"}, True, True),
        (["--no-box", "--arrows", "xy"], {"sides": "pp pp pp"}, False, True),
    ):
        picture = drawn(columns, *words, size=(480, 400), **more)
        heads = scipy.ndimage.binary_erosion(spot(picture, grey), np.ones((4, 4)))
        found = spot(picture, dark, 1).sum() > 300, heads.sum() > 10
        require(found == (box, arrows), f"{words} {more}: box and arrows {found}, expected {(box, arrows)}")


def contacts_dump(folder, pairs, **more):
    """A dump of contacts (i, j, x_i - x_j, force) with the words id branch fn."""
    names = [f"c_c[{k}]" for k in range(1, 7)]
    rows = [(i, j, *branch, force) for i, j, branch, force in pairs]
    text = snapshot(5, dict(zip(names, map(list, zip(*rows)))), kind="ENTRIES", **more)
    (folder / "contacts.dump").write_text(text)


def chain_pixels(picture):
    """Where something is: chains on white."""
    return np.any(picture < 250, axis=-1)


def chains(ranks):
    """Of four grains two pairs touch, one with half the force: its chain is half as wide. Chains are on the lines
    between the centres, and end there."""
    folder = new_folder()
    places = np.array([(1, 2, 0), (3, 3, 0), (7, 2, 0), (9, 3, 0.0)])
    contacts_dump(folder, [(1, 2, (-2, -1, 0), 4.0), (4, 3, (2, 1, 0), 2.0)])
    words = [*CHAINS, "--contacts", "contacts.dump", "--strongest", 4]
    picture = drawn(spheres(places, 1.0), *words, folder=folder, size=(600, 300))
    shown = chain_pixels(picture)
    columns = np.flatnonzero(shown.any(axis=0))
    gap = int(np.flatnonzero(np.diff(columns) > 1)[0])
    left, right = (
        shown & np.isin(np.arange(shown.shape[1]), part) for part in (columns[: gap + 1], columns[gap + 1 :])
    )
    # the chains are alike but for their widths w and w/2, and ends are round: areas are 2 r L + pi r^2
    length = np.linalg.norm([2.0, 1.0])
    apart = (middle(right.astype(float)) - middle(left.astype(float)))[0] / 6.0  # pixels per length
    colours = [picture[tuple(np.floor(middle(part.astype(float))[::-1]).astype(int))] for part in (left, right)]
    for part, colour, radius, name in zip((left, right), colours, (0.5, 0.25), ("strong", "weak")):
        area, square = moments(cover(picture, colour) * part)
        require_close(area / apart**2, 2 * radius * length + np.pi * radius**2, 0.03, f"area of the {name} chain")
        along = np.linalg.eigh(square)[1][:, 1]
        require_close(abs(along @ [2.0, -1.0]) / length, 1.0, 1e-3, f"direction of the {name} chain")
    require(colours[0][1] < colours[1][1] - 50, f"the stronger one is redder: {colours}")


def chains_across_faces(ranks):
    """A contact through a periodic face is two short chains, from each grain to the face; one with a wall goes on to
    the wall."""
    folder = new_folder()
    box = {"sides": "pp ff ff"}
    contacts_dump(folder, [(1, 2, (1, 0, 0), 1.0), (3, 0, (0, 0.5, 0), 1.0)], **box)
    places = [(0.5, 5, 0), (9.5, 5, 0), (5, 2, 0)]
    words = [*CHAINS, "--contacts", "contacts.dump", "--strongest", 2]
    shown = chain_pixels(drawn(spheres(places, 0.5), *words, folder=folder, size=(500, 260), **box))
    areas = []
    columns = np.flatnonzero(shown.any(axis=0))
    groups = np.split(columns, np.flatnonzero(np.diff(columns) > 1) + 1)
    require(len(groups) == 3, f"{len(groups)} spots in place of three")
    for group in groups:
        areas.append(shown[:, group].sum())
        require(len(group) < 0.09 * (columns[-1] - columns[0]), f"a chain of {len(group)} pixels")
    require_close(areas, [np.mean(areas)] * 3, 0.1, "three chains of half a diameter")


def chains_of_a_run(ranks):
    """Every half begins at a grain's centre and is half as long as the branch; both halves of a contact meet, but for
    edges of the box; forces are those of the dump."""
    packing = dense_packing(1.5, types=2)
    deck = Deck(packing)
    deck.body = ["compute contacts all contact/local", *dump_local("contacts", 30, 10, "contacts")]
    deck.body += [*dump_grains(packing, 10), "run 20"]
    result = run(deck, ranks)
    contacts, snapshot_of = Dump(result.folder / "contacts.dump")[-1], Dump(result.folder / "grains.dump")[-1]
    drawn_grains = drawn_of(snapshot_of)
    found = chains_of(contacts, None, drawn_grains)
    number = len(contacts)
    require(len(found) == 2 * number > 100, f"{len(found)} halves of {number} contacts")
    branch = contacts.vectors("c_contacts[12]", "c_contacts[13]", "c_contacts[14]")
    require_close(found.ends[:number] - found.starts[:number], -0.5 * branch, 1e-9, "halves of i", 1.0)
    require_close(found.ends[number:] - found.starts[number:], 0.5 * branch, 1e-9, "halves of j", 1.0)
    edges = (found.ends[:number] - found.ends[number:]) @ np.linalg.inv(snapshot_of.box.edges)
    require_close(edges, np.round(edges), 1e-4, "they meet, but for edges of the box", 1.0)
    require(np.any(np.round(edges) != 0), "no contact reaches across a face")
    place = {int(one): k for k, one in enumerate(snapshot_of["id"])}
    rows = [place[int(one)] for one in contacts["c_contacts[1]"]]
    require_equal(found.starts[:number], drawn_grains.positions[rows], "they begin at i")
    require_equal(found.forces, np.tile(contacts["c_contacts[19]"], 2), "forces")
    high = found.forces.max()
    require_close(radii(found, high, 2.0).max(), 1.0, 1e-12, "the thickest")
    part = drawn_of(snapshot_of, None, [("x", *np.quantile(drawn_grains.positions[:, 0], [0.2, 0.6]))])
    kept = set(snapshot_of["id"][part.rows])
    both = [i in kept and j in kept for i, j in zip(contacts["c_contacts[1]"], contacts["c_contacts[2]"])]
    require(len(chains_of(contacts, None, part)) == 2 * sum(both) > 0, "contacts of a part of the grains")


def see_through(ranks):
    """Grains around chains let them through; alone they are as opaque as asked for."""
    folder = new_folder()
    contacts_dump(folder, [(1, 2, (-2, 0, 0), 1.0)])
    columns = spheres([(4, 5, 5), (6, 5, 5)], 1.0)
    words = ["--view", 0, 0, "--orthographic", "--contact-columns", "id", "branch", "fn", "--contacts", "contacts.dump"]
    through, hidden = (drawn(columns, *words, *more, folder=folder) for more in ([], ["--opacity", 1]))
    centre = tuple(n // 2 for n in through.shape[:2])
    require(through[centre][0] > through[centre][2] + 60, f"a red chain inside, {through[centre]}")
    require_close(hidden[centre[0], centre[1] - 30], [191] * 3, 1.0, "a grey grain hides it", 1.0)
    half = drawn(spheres([(5, 5, 5)], 1.0), *FRONT, "--opacity", 0.5)
    require(np.all(half[half.shape[0] // 2, half.shape[1] // 2] > np.array(KINDS[0]) + 15), "half opaque before white")


def needs(ranks):
    """Contacts of grains that the dump lacks, and dumps that lack columns."""
    folder = new_folder()
    contacts_dump(folder, [(1, 7, (1, 0, 0), 1.0)])
    (folder / "grains.dump").write_text(snapshot(5, spheres([(1, 1, 1), (3, 1, 1)], 1.0)))
    words = ["grains.dump", "--contacts", "contacts.dump"]
    for more, expected in (
        (["--contact-columns", "id", "branch", "fn"], "grains.dump has no grain with the ID 7"),
        (["--contact-columns", "id", "normal", "fn"], "normal"),
        (["--contact-columns", "id", "point", "fn"], "no column branch_x, branch_y, branch_z; it has id_i"),
        (["--contact-columns", "ids"], "--contact-columns must be of id image"),
        ([], "Dump contacts by"),
    ):
        code, said = tool("render", *words, *more, folder=folder)
        require(code == 1 and expected in said, f"{more}: {code}, {said}")


main(
    {
        "walls": walls,
        "wall-edges": wall_edges,
        "primitives": primitives,
        "cuts": cuts,
        "wall-parts": wall_parts,
        "wrapped": wrapped,
        "boxes-and-arrows": boxes_and_arrows,
        "chains": chains,
        "chains-across-faces": chains_across_faces,
        "chains-of-a-run": chains_of_a_run,
        "see-through": see_through,
        "needs": needs,
    }
)
