# SPDX-License-Identifier: GPL-2.0-or-later
"""What is drawn of each snapshot, and what all pictures of a film share: camera, colours, thickness of force chains."""

from dataclasses import dataclass
from functools import lru_cache

import matplotlib
import numpy as np

from grainscope.dumps import Dump
from grainscope.errors import InputError
from grainscope.render.camera import AXES, DEFAULT_VIEW, fitted, outermost, picture_axes, upright
from grainscope.render.chains import Chains, chains_of, radii, strongest
from grainscope.render.colours import GREY, Scale, decisive, scale_of, strip, strip_height, values_of
from grainscope.render.drawn import Drawn, drawn_of
from grainscope.render.scene import Scene, box_edges, corners_by_place
from grainscope.render.walls import AllWalls
from grainscope.selection import Condition

EDGE, ARROW = 0.003, 0.005  # radii over the width of the picture
FORCES = matplotlib.colors.ListedColormap(matplotlib.colormaps["YlOrRd"](np.linspace(0.25, 1.0, 256)))
SEE_THROUGH = 0.15  # opacity of grains around force chains


@dataclass
class View:
    """What is drawn of one snapshot."""

    drawn: Drawn
    chains: Chains
    triangles: np.ndarray

    @property
    def box(self):
        return self.drawn.snapshot.box

    @property
    def step(self):
        return self.drawn.snapshot.step


class Sources:
    """The files that pictures are made of."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.grains = Dump(arguments.dump)
        self.contacts = Dump(arguments.contacts) if arguments.contacts else None
        self.walls = AllWalls(arguments.walls, arguments.primitive, arguments.cut)
        self.condition = Condition(arguments.where) if arguments.where else None
        self.steps = self.grains.steps
        self.notes = self.grains.notes + (self.contacts.notes if self.contacts else [])
        self.view = lru_cache(maxsize=1)(self._view)  # a picture has one, which is read once

    def _view(self, step):
        snapshot = self.grains.at(step)
        drawn = drawn_of(snapshot, self.condition, self.arguments.cut)
        chains = None
        if self.contacts:
            chains = chains_of(self.contacts.at(step), self.arguments.contact_columns, drawn)
        return View(drawn, chains, self.walls.triangles(step, snapshot.box))


class Overview:
    """What must be known of all views before the first is drawn; of each view only sums and forces are kept."""

    def __init__(self):
        self.grains, self.sizes = 0, 0.0  # their number, and the sum of their mean radii
        self.flat, self.are_spheres = True, True
        self.forces = []
        self._tilts = dict.fromkeys(("xy", "xz", "yz"), 0.0)

    def add(self, view):
        drawn, edges = view.drawn, view.box.edges
        self.grains += len(drawn)
        self.sizes += np.cbrt(np.prod(drawn.semi_axes, axis=1)).sum()
        self.flat = self.flat and drawn.lie_flat
        self.are_spheres = self.are_spheres and bool(drawn.are_spheres.all())
        if view.chains is not None:
            self.forces.append(np.abs(view.chains.forces))
        for plane in self._tilts:
            flow, gradient = map(AXES.index, plane)
            self._tilts[plane] = max(self._tilts[plane], abs(edges[gradient][flow]) / edges[gradient][gradient])

    def shear_plane(self):
        """The plane xy, xz or yz, flow and gradient, in which boxes are tilted the most; None where none is."""
        plane = max(self._tilts, key=self._tilts.get)
        return plane if self._tilts[plane] > 0.0 else None


class Look:
    """What all pictures of these steps share. Views are read one at a time: for an overview, for the colours and the
    camera, and when they are drawn."""

    def __init__(self, sources, steps, arguments):
        self.arguments, self.steps = arguments, steps
        periodic = sources.view(steps[0]).box.periodic
        all_views = Overview()
        for step in steps:
            all_views.add(sources.view(step))
        if not all_views.grains:
            self._refuse(sources.view(steps[-1]).drawn.snapshot)
        self.flat = all_views.flat
        self.with_box = arguments.box
        if self.with_box is None:
            self.with_box = all(periodic[: 2 if self.flat else 3])
        self.plane = all_views.shear_plane() if arguments.arrows is None else arguments.arrows
        if self.plane == "none" or (arguments.arrows is None and not self.with_box):
            self.plane = None
        self.force_scale = None
        if arguments.contacts:
            high = arguments.strongest or strongest(all_views.forces) or 1.0
            self.force_scale = Scale("normal force", FORCES, 0.0, high)
            self.grain = all_views.sizes / all_views.grains
        self.colour = self._column_of_colours(all_views)
        self.noted = arguments.animate is not None
        self.pixels = self._pixels()
        self.top = upright(arguments.up)[1]
        self.axes = picture_axes(arguments.view or ((0.0, 0.0) if self.flat else DEFAULT_VIEW), arguments.up)
        self.scale, self.camera = self._scale_and_camera(map(sources.view, steps))
        self.scales = [scale for scale in (self.scale, self.force_scale) if scale is not None]

    def _refuse(self, snapshot):
        chosen = [f"--where '{self.arguments.where}'"] if self.arguments.where else []
        chosen += [f"--cut {axis} {low:g} {high:g}" for axis, low, high in self.arguments.cut]
        raise InputError(
            f"{snapshot.path}: no grain to draw of the {snapshot.rows} of step {snapshot.step}"
            + (f" with {' and '.join(chosen)}" if chosen else "")
        )

    def _column_of_colours(self, all_views):
        """None where grains are grey."""
        name = self.arguments.colour
        if self.arguments.only_contacts or (name is None and self.arguments.contacts):
            return None
        name = name or "alignment"
        return None if name == "alignment" and all_views.are_spheres else name

    def _along(self):
        return self.arguments.along or (self.plane or "x")[0]

    def _pixels(self):
        """Width and height without the colour bars."""
        width, height = self.arguments.size
        if self.colour or self.force_scale or self.noted:
            height -= strip_height(width)
        if height < 1:
            raise InputError(f"--size: {self.arguments.size[1]} pixels are too low for a width of {width}")
        return width, height

    def _scale_and_camera(self, views):
        aspect, orthographic = self.pixels[0] / self.pixels[1], self.arguments.orthographic or self.flat
        values, seen = [], []
        for view in views:
            if self.colour:
                values.append(decisive(values_of(view.drawn, self.colour, self._along())))
            points, sizes = (np.concatenate(parts) for parts in zip(*self._seen(view)))
            outer = outermost(self.axes, points, sizes, aspect, orthographic)
            seen.append((points[outer], sizes[outer]))
        camera = fitted(self.axes, *map(np.concatenate, zip(*seen)), aspect, orthographic)
        return self._scale_of(np.concatenate(values)) if self.colour else None, camera

    def _scale_of(self, values):
        label, along = self.arguments.label, self._along()
        if self.colour == "alignment" and label is None and self.plane:
            label = "angle to the flow"
        return scale_of(values, self.colour, along, self.arguments.range, self.arguments.colormap, label)

    def _seen(self, view):
        """Points, and radii of what is about them."""
        drawn = view.drawn
        sizes = drawn.reach if not self.arguments.only_contacts else np.zeros(len(drawn))
        yield drawn.positions, sizes
        if view.chains is not None:
            yield view.chains.ends, radii(view.chains, self.force_scale.high, self.grain)
        corners = view.triangles.reshape(-1, 3)
        yield corners, np.zeros(len(corners))
        if self.with_box:
            yield view.box.corners(), np.zeros(8)
        arrows = self._arrows(view).reshape(-1, 3)
        yield arrows, np.zeros(len(arrows))

    def _arrows(self, view):
        """Ends (tail, tip) of the arrows of the flow: along it beyond the far edge of the box, against it at the near
        one."""
        if not self.plane:
            return np.empty((0, 2, 3))
        flow, gradient = map(AXES.index, self.plane)
        third = 3 - flow - gradient
        near = int(self.axes[2][third] > 0)
        corners, arrows = corners_by_place(view.box), []
        length = 0.3 * np.linalg.norm(view.box.edges[flow]) * np.eye(3)[flow]
        gap = 1.6 * view.drawn.reach.max(initial=0.0) * np.eye(3)[gradient]
        for side, sign in ((1, 1.0), (0, -1.0)):
            place = [0, 0, 0]
            place[gradient], place[third] = side, near if side == 0 else 1 - near
            start = corners[tuple(place)]
            place[flow] = 1
            middle = 0.5 * (start + corners[tuple(place)]) + sign * gap
            arrows.append((middle - 0.5 * sign * length, middle + 0.5 * sign * length))
        return np.array(arrows)

    def scene(self, view):
        """POV-Ray's text."""
        arguments, width = self.arguments, self.camera.width
        scene = Scene(self.camera, self.pixels[0] / self.pixels[1], arguments.light, self.top)
        if not arguments.only_contacts:
            scene.add_grains(view.drawn, self._colours(view.drawn), self._opacity())
        if view.chains is not None:
            colours = self.force_scale.colours(np.abs(view.chains.forces))
            thickness = radii(view.chains, self.force_scale.high, self.grain)
            scene.add_cylinders(view.chains.starts, view.chains.ends, thickness, colours)
        scene.add_walls(view.triangles, arguments.wall_style, EDGE / 2 * width)
        if self.with_box:
            scene.add_lines(box_edges(corners_by_place(view.box)), EDGE * width)
        if self.plane:
            scene.add_arrows(self._arrows(view), ARROW * width)
        seen = np.concatenate([points - sizes[:, None] * self.top for points, sizes in self._seen(view)])
        if not self.flat:
            scene.add_floor(seen[np.argmin(seen @ self.top)] - 0.02 * width * self.top)
        return scene.text()

    def _colours(self, drawn):
        if self.scale is None:
            return np.tile(GREY, (len(drawn), 1))
        return self.scale.colours(values_of(drawn, self.colour, self._along()))

    def _opacity(self):
        if self.arguments.opacity is not None:
            return self.arguments.opacity
        return SEE_THROUGH if self.arguments.contacts else 1.0

    def strip(self, step):
        """Colour bars and, in films, the step, as rows of pixels."""
        return strip(self.scales, self.pixels[0], f"step {step}" if self.noted else "")
