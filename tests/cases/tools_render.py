# SPDX-License-Identifier: GPL-2.0-or-later
"""grainscope-tools render: places, outlines and colours of grains in pictures, against closed forms of projections."""
import colorsys

import matplotlib
import numpy as np
from scipy.special import gamma
from scipy.spatial.transform import Rotation

from case import main, require, require_close
from pixels import KINDS, cover, drawn, middle, moments, spheres, spot

MARKS = np.array([(-3, -3, -3), (3, -3, -3), (-3, 3, -3), (-3, -3, 3), (3, 3, -3), (3, -3, 3), (-3, 3, 3), (3, 3, 3.0)])


def ellipsoid(semi_axes, turn, marks, radius=0.15, **more):
    """Columns of an ellipsoid of type 1 at the origin and of small spheres of the types above it."""
    places = np.concatenate([np.zeros((1, 3)), marks])
    columns = spheres(places, 0.0)
    del columns["radius"]
    x, y, z, w = turn.as_quat()
    rest = len(marks)
    for name, own, others in zip(("quat1", "quat2", "quat3", "quat4"), (w, x, y, z), (1, 0, 0, 0)):
        columns[name] = [own] + [others] * rest
    for name, own in zip(("shapex", "shapey", "shapez"), semi_axes):
        columns[name] = [own] + [radius] * rest
    return columns | more


def affine_camera(picture, marks, kinds):
    """The matrix (2,4) that takes places to pixels, from the spots of the marks."""
    spots = [middle(cover(picture, KINDS[kind])) for kind in kinds]
    return np.linalg.lstsq(np.column_stack([marks, np.ones(len(marks))]), spots, rcond=None)[0].T


def projective_camera(picture, marks, kinds):
    """The matrix (3,4) that takes places to pixels in a perspective picture."""
    rows = []
    for mark, kind in zip(marks, kinds):
        u, v = middle(cover(picture, KINDS[kind]))
        place = np.append(mark, 1.0)
        rows += [[*place, *np.zeros(4), *(-u * place)], [*np.zeros(4), *place, *(-v * place)]]
    return np.linalg.svd(np.array(rows))[2][-1].reshape(3, 4)


def conic_of(camera, semi_axes, turn):
    """Area and second moments over the area of the outline of an ellipsoid: the camera takes its dual quadric to the
    dual conic of the outline."""
    quadric = np.diag([*np.square(semi_axes), -1.0])
    quadric[:3, :3] = turn.as_matrix() @ quadric[:3, :3] @ turn.as_matrix().T
    dual = camera @ quadric @ camera.T
    dual = dual / -dual[2, 2]
    centre = -dual[:2, 2]
    square = dual[:2, :2] + np.outer(centre, centre)
    return np.pi * np.sqrt(np.linalg.det(square)), square / 4.0


def outline(semi_axes, view, perspective):
    """An ellipsoid between marks that tell where the camera is. Area and moments of its spot are those of the ellipse;
    pixels at its edge count by what is covered."""

    def case(ranks):
        turn = Rotation.from_rotvec([0.7, -0.4, 1.1])
        direction = np.array(view) / np.linalg.norm(view)
        # marks that are beside the ellipsoid in the picture, none behind another
        along = MARKS @ direction
        marks = MARKS[np.linalg.norm(MARKS - np.outer(along, direction), axis=1) > 2.4]
        kinds = range(1, 1 + len(marks))
        require(len(marks) >= 6, f"only {len(marks)} marks")
        words = ["--colour", "type", "--view", *view] + ([] if perspective else ["--orthographic"])
        picture = drawn(ellipsoid(semi_axes, turn, marks), *words, size=(360, 320))
        if perspective:
            camera = projective_camera(picture, marks, kinds)
        else:
            affine = affine_camera(picture, marks, kinds)
            lengths = np.linalg.norm(affine[:, :3], axis=1)
            require_close(lengths[1] / lengths[0], 1.0, 0.005, "pixels are square")
            require_close(affine[:, :3] @ direction / lengths[0], [0.0, 0.0], 0.01, "it is seen from there", 1.0)
            toward = np.cross(affine[0, :3], -affine[1, :3]) / lengths[0] ** 2
            require_close(toward, direction, 0.01, "it is not a mirror image", 1.0)
            camera = np.vstack([affine, [0, 0, 0, 1]])
        area, square = conic_of(camera, semi_axes, turn)
        found_area, found_square = moments(cover(picture, KINDS[0]))
        require_close(found_area, area, 0.012, "area of the outline")
        require_close(found_square, square, 0.015, "second moments of the outline")

    return case


def up_axis(ranks):
    """The axis that is up points up, the first of the others right. Of two spheres behind each other the nearer one is
    seen: the third axis points to the viewer where the three are right-handed in that order, else away."""
    places = np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2.0)])
    origin, x, y, z = KINDS[:4]
    for up, top, right, nearer, behind in (("x", x, y, origin, z), ("y", y, x, z, origin), ("z", z, x, origin, y)):
        picture = drawn(spheres(places, 0.4), "--up", up, "--view", 0, 0, "--orthographic", "--colour", "type")
        require(not spot(picture, behind).any(), f"up {up}: it is seen from behind")
        seen, above, beside = (middle(cover(picture, colour)) for colour in (nearer, top, right))
        require_close(above - seen, [0.0, -np.linalg.norm(above - seen)], 0.02, f"{up} points up", 100.0)
        require_close(beside - seen, [np.linalg.norm(above - seen), 0.0], 0.02, f"to the right, up {up}", 100.0)


def views(ranks):
    """An azimuth turns the viewer from the front to the right, an elevation upwards; a vector points to the viewer."""
    marks = MARKS[[0, 1, 2, 3, 5]]
    for words, up, toward in (
        ((90, 0), "y", (1, 0, 0)),
        ((0, 90), "y", (0, 1, 0)),
        ((180, 0), "z", (0, 1, 0)),
        ((30, 0), "y", (0.5, 0, np.sqrt(0.75))),
        ((0, -30), "z", (0, -np.sqrt(0.75), -0.5)),
        ((1, 2, -2), "z", (1 / 3, 2 / 3, -2 / 3)),
    ):
        # 11 and 3 degrees off, so that no mark is hidden behind another
        picture = drawn(spheres(marks, 0.15), "--view", *words, "--up", up, "--orthographic", "--colour", "type")
        shown = [kind for kind in range(5) if spot(picture, KINDS[kind]).sum() > 0]
        require(len(shown) >= 2, f"--view {words}: marks {shown}")
        spots = np.array([middle(cover(picture, KINDS[kind])) for kind in shown])
        top = np.eye(3)["xyz".index(up)]
        level = np.cross(top, toward)
        if np.linalg.norm(level) < 1e-9:
            level = np.array([1.0, 0.0, 0.0])
        level = level / np.linalg.norm(level)
        rows = np.array([level, -np.cross(toward, level)])
        expected = (marks[shown] - marks[shown][0]) @ rows.T
        found = spots - spots[0]
        scale = np.sum(found * expected) / np.sum(expected**2)
        require(scale > 0, f"--view {words}: found {found}")
        require_close(found, scale * expected, 0.3, f"--view {words}, up {up}", 1.0)


def colour_map(ranks):
    """A grain without light has the colour of its value, also beyond the ends; the bar goes from one end to the other.
    Under light the hue stays."""
    places = [(2.0 * k, 0, 0) for k in range(6)]
    values = np.array([-1.0, 0.0, 0.25, 0.5, 1.0, 3.0])
    columns = spheres(places, 0.9, c_heat=values)
    words = ["--colour", "c_heat", "--range", 0, 1, "--view", 0, 0, "--orthographic"]
    for name in ("viridis", "coolwarm"):
        picture = drawn(columns, *words, "--colormap", name, size=(400, 160), strip=True)
        expected = 255.0 * matplotlib.colormaps[name](np.clip(values, 0.0, 1.0))[:, :3]
        row = picture[(160 - 34) // 2]  # the middle of what is above the strip
        inside = np.flatnonzero(np.any(row < 250, axis=1))
        width = (inside[-1] - inside[0]) / 6.0
        centres = np.round(inside[0] + width * (np.arange(6) + 0.5)).astype(int)
        require_close(row[centres], expected, 1.01, f"{name}: colours at the centres", 1.0)
        bar = picture[160 - 34 + int(0.2 * 34)]
        inside = np.flatnonzero(np.any(bar < 250, axis=1))
        along = (np.arange(inside[0], inside[-1] + 1) - inside[0] + 0.5) / len(inside)
        wanted = 255.0 * matplotlib.colormaps[name](along)[:, :3]
        require_close(bar[inside[2:-2]], wanted[2:-2], 12.0, f"{name}: the bar, to a pixel", 1.0)
    lit = drawn(columns, *words, "--colormap", "viridis", light="plain", size=(400, 160))[63]
    for column, colour in zip(centres, 255.0 * matplotlib.colormaps["viridis"](np.clip(values, 0.0, 1.0))):
        hue, wanted = (colorsys.rgb_to_hsv(*(one[:3] / 255.0))[0] for one in (lit[column], colour))
        require(abs(hue - wanted) < 0.04, f"hue {hue} in the light, {wanted} of the map")


def vectors_and_kinds(ranks):
    """The length of a vector by its name; whole numbers of a few values have colours of their own."""
    places = [(0, 0, 0), (2, 0, 0)]
    columns = spheres(places, 0.9, vx=[3.0, 0.0], vy=[0.0, 6.0], vz=[4.0, 8.0])
    words = ["--view", 0, 0, "--orthographic"]
    picture = drawn(columns, *words, "--colour", "v", "--range", 0, 10)
    for share in (0.5, 1.0):
        colour = np.round(255.0 * np.array(matplotlib.colormaps["viridis"](share)))[:3]
        require(spot(picture, colour).sum() > 1000, f"speed {10 * share}")
    columns["type"] = [7, 3]
    picture = drawn(columns, *words, "--colour", "type")
    left, right = (middle(spot(picture, KINDS[k]).astype(float)) for k in (1, 0))
    require(left[0] < right[0], "the higher type has the second colour")


def alignment(ranks):
    """Of prolate grains the long axis, of oblate ones the flat plane against the axis; spheres are grey."""
    ellipsoids = ((1.0, 0.5, 0.5), (0.5, 1.0, 1.0), (0.6, 0.6, 0.6))
    angle = np.radians(30.0)
    columns = spheres([(3.0 * k, 0, 0) for k in range(3)], 1.0)
    del columns["radius"]
    for k, name in enumerate(("shapex", "shapey", "shapez")):
        columns[name] = [one[k] for one in ellipsoids]
    turned = (np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2))  # about z
    for k, name in enumerate(("quat1", "quat2", "quat3", "quat4")):
        columns[name] = [turned[k]] * 3
    for axis, expected in (("x", (30.0, 60.0)), ("y", (60.0, 30.0)), ("z", (90.0, 0.0))):
        picture = drawn(columns, "--along", axis, "--view", 0, 0)
        spots = []
        for value in expected:
            colour = np.round(255.0 * np.array(matplotlib.colormaps["viridis_r"](value / 90.0)))[:3]
            spots.append(middle(spot(picture, colour).astype(float)))
        spots.append(middle(spot(picture, (191, 191, 191)).astype(float)))
        require(spots[0][0] < spots[1][0] < spots[2][0], f"{axis}: spots at {spots}")


def in_two_dimensions(ranks):
    """Grains at one z are seen from the front without perspective: x to the right, y up, to one scale."""
    places = np.array([(0, 0, 0.5), (4, 0, 0.5), (0, 3, 0.5), (4, 3, 0.5)])
    picture = drawn(spheres(places, [0.5, 0.5, 0.5, 0.25]), "--colour", "type")
    spots = np.array([middle(cover(picture, KINDS[k])) for k in range(4)])
    scale = (spots[1] - spots[0])[0] / 4.0
    expected = scale * (places[:, :2] - places[0, :2]) * [1, -1]
    require_close(spots - spots[0], expected, 0.1, "centres", 1.0)
    for kind, radius in ((0, 0.5), (3, 0.25)):
        area = moments(cover(picture, KINDS[kind]))[0]
        require_close(area, np.pi * (radius * scale) ** 2, 0.015, f"area of the disc of radius {radius}")


def superquadrics(ranks):
    """Seen along z the outline is |x/a|^n2 + |y/b|^n2 = 1, whose area is 4 a b G(1 + 1/n2)^2/G(1 + 2/n2); along y
    |x/a|^n1 + |z/c|^n1 = 1. The box of the camera is that of the corners, so that marks give the scale."""
    n1, n2, axes = 3.0, 8.0, (1.0, 0.6, 0.8)
    marks = np.array([(-2, -2, -2), (2, -2, 2), (-2, 2, 2), (2.0, 2, -2)])
    blockiness = {"blockiness1": [n1] + [2.0] * 4, "blockiness2": [n2] + [2.0] * 4}
    columns = ellipsoid(axes, Rotation.identity(), marks, **blockiness)
    for view, exponent, sizes in (((0, 0, 1), n2, axes[:2]), ((0, -1, 0), n1, axes[::2])):
        words = ["--view", *view, "--up", "y" if view[2] else "z", "--orthographic", "--colour", "type"]
        picture = drawn(columns, *words, size=(300, 340))
        camera = affine_camera(picture, marks, range(1, 5))
        scale = np.linalg.norm(camera[0, :3])
        area = 4.0 * np.prod(sizes) * gamma(1 + 1 / exponent) ** 2 / gamma(1 + 2 / exponent)
        found = moments(cover(picture, KINDS[0]))[0]
        require_close(found, area * scale**2, 0.012, f"area seen along {view}")


main(
    {
        "outline-prolate": outline((0.8, 0.8, 2.0), (0.3, 0.4, 1.0), False),
        "outline-triaxial": outline((0.6, 1.1, 1.9), (1.0, -0.7, 0.35), False),
        "outline-in-perspective": outline((1.9, 1.9, 0.7), (0.4, 0.9, 0.3), True),
        "up-axis": up_axis,
        "views": views,
        "colour-map": colour_map,
        "vectors-and-kinds": vectors_and_kinds,
        "alignment": alignment,
        "two-dimensions": in_two_dimensions,
        "superquadrics": superquadrics,
    }
)
