# SPDX-License-Identifier: GPL-2.0-or-later
"""The scene that POV-Ray draws: text, in the axes of the picture and with a size near 1, whatever the run's units."""

from pathlib import Path
import shutil
import subprocess
import tempfile

import matplotlib.image
import numpy as np

from grainscope.errors import InputError
from grainscope.render.camera import OPENING
from grainscope.render.walls import edges_of

LIGHTS = {
    "soft": """global_settings {{ assumed_gamma 1.0
  radiosity {{ pretrace_start 0.08 pretrace_end 0.01 count 200 error_bound 0.8 recursion_limit 1 nearest_count 12 }} }}
light_source {{ {key} color rgb 0.85 area_light {across}, {along}, 17, 17 adaptive 3 circular orient }}
light_source {{ {fill} color rgb 0.25 shadowless }}
#declare grain_finish = finish {{ ambient 0 emission 0.05 diffuse 0.75 specular 0.22 roughness 0.03 }}
#declare line_finish = finish {{ ambient 0 diffuse 0.65 }}""",
    "plain": """global_settings {{ assumed_gamma 1.0 }}
light_source {{ {key} color rgb 0.75 }}
light_source {{ {fill} color rgb 0.35 shadowless }}
#declare grain_finish = finish {{ ambient 0 emission 0.22 diffuse 0.7 specular 0.22 roughness 0.03 }}
#declare line_finish = finish {{ ambient 0 emission 0.2 diffuse 0.65 }}""",
    "none": """global_settings {{ assumed_gamma 1.0 }}
#declare grain_finish = finish {{ ambient 0 diffuse 0 emission 1 }}
#declare line_finish = grain_finish""",
}
FLOOR = "plane {{ {normal}, {height} pigment {{ color rgb 1 }} finish {{ ambient 0 emission 0.06 diffuse 0.64 }} }}"
STEEPEST_FLOOR = 0.9  # sine of the elevation up to which a floor is drawn
EDGE, ARROW, WALL = "0.18, 0.18, 0.18", "0.35, 0.35, 0.35", "0.55, 0.60, 0.66"


def vector(v):
    return "<" + ", ".join(f"{x:.7g}" for x in v) + ">"


def pigment(colour, opacity=1.0):
    return f"pigment {{ color srgbt <{colour[0]:.5f}, {colour[1]:.5f}, {colour[2]:.5f}, {1.0 - opacity:.5g}> }}"


class Scene:
    """Collects what is seen by a camera; `text` is POV-Ray's."""

    def __init__(self, camera, aspect, light, top):
        self.camera, self.aspect, self.light = camera, aspect, light
        self.unit = 1.0 / camera.width
        self.top = camera.axes @ top
        self.parts = []

    def _place(self, points):
        return self.unit * self.camera.seen(points)

    def add_grains(self, drawn, colours, opacity):
        """A unit sphere or superquadric each, stretched, turned and moved: POV-Ray takes the images of x, y, z as
        rows."""
        end = "finish { grain_finish }" + (" no_shadow" if opacity < 1.0 else "") + " }"
        rotations = self.camera.axes @ drawn.rotations
        data = zip(self._place(drawn.positions), rotations, self.unit * drawn.semi_axes, drawn.exponents, colours)
        for position, rotation, axes, (n1, n2), colour in data:
            round_one = n1 == 2.0 and n2 == 2.0
            shape = "sphere { 0, 1" if round_one else f"superellipsoid {{ <{2.0 / n2:.7g}, {2.0 / n1:.7g}>"
            rows = np.vstack([rotation.T * axes[:, None], position])
            numbers = ", ".join(f"{x:.7g}" for x in rows.ravel())
            self.parts.append(f"{shape} matrix <{numbers}> {pigment(colour, opacity)} {end}")

    def add_cylinders(self, starts, ends, radii, colours, finish="grain_finish"):
        """With round starts."""
        for start, end, radius, colour in zip(self._place(starts), self._place(ends), self.unit * radii, colours):
            look = f"{pigment(colour)} finish {{ {finish} }} }}"
            self.parts.append(f"sphere {{ {vector(start)}, {radius:.7g} {look}")
            if np.linalg.norm(end - start) > 1e-6:
                self.parts.append(f"cylinder {{ {vector(start)}, {vector(end)}, {radius:.7g} {look}")

    def add_lines(self, lines, radius, colour=EDGE):
        look = f"pigment {{ color rgb <{colour}> }} finish {{ line_finish }} }}"
        for start, end in self._place(lines.reshape(-1, 3)).reshape(-1, 2, 3):
            self.parts.append(f"cylinder {{ {vector(start)}, {vector(end)}, {radius * self.unit:.7g} {look}")
            self.parts += [f"sphere {{ {vector(one)}, {radius * self.unit:.7g} {look}" for one in (start, end)]

    def add_arrows(self, arrows, radius):
        look = f"pigment {{ color rgb <{ARROW}> }} finish {{ line_finish }} }}"
        radius = radius * self.unit
        for tail, tip in self._place(arrows.reshape(-1, 3)).reshape(-1, 2, 3):
            neck = tail + 0.8 * (tip - tail)
            self.parts.append(f"cylinder {{ {vector(tail)}, {vector(neck)}, {radius:.7g} {look}")
            self.parts.append(f"cone {{ {vector(neck)}, {2.8 * radius:.7g}, {vector(tip)}, 0 {look}")

    def add_walls(self, triangles, style, radius):
        if not len(triangles):
            return
        if style != "wire":
            self._add_mesh(triangles, 0.0 if style == "solid" else 0.78)
        self.add_lines(edges_of(triangles, 0.1 if style == "wire" else 30.0), radius, WALL)

    def _add_mesh(self, triangles, transmit):
        self.parts.append("mesh {")
        for corners in self._place(triangles.reshape(-1, 3)).reshape(-1, 3, 3):
            self.parts.append(f"triangle {{ {', '.join(map(vector, corners))} }}")
        self.parts.append(
            f"pigment {{ color rgbt <{WALL}, {transmit}> }} finish {{ line_finish }} double_illuminate"
            + (" no_shadow }" if transmit else " }")
        )

    def add_floor(self, lowest):
        """Below a point; not where it would hide things or be seen from straight above."""
        if self.light == "soft" and 0.0 < self.top[2] < STEEPEST_FLOOR:
            height = (self._place(lowest[None]) @ self.top)[0]
            self.parts.append(FLOOR.format(normal=vector(self.top), height=f"{height:.7g}"))

    def text(self):
        camera = self.camera
        height, distance = 1.0 / self.aspect, camera.distance * self.unit
        length = 1.0 if camera.orthographic else 0.5 / np.tan(np.radians(0.5 * OPENING))
        kind = "orthographic " if camera.orthographic else ""
        view = f"{kind}location {distance:.9g}*z direction {-length:.9g}*z right x up {height:.9g}*y"
        right = np.array([1.0, 0.0, 0.0])  # level in every picture
        front = np.cross(right, self.top)
        lights = LIGHTS[self.light].format(
            key=vector(-5.0 * right + 11.0 * self.top + 6.0 * front),
            fill=vector(2.5 * right + self.top + 2.5 * front),
            across=vector(3.8 * right),
            along=vector(3.8 * front),
        )
        return "\n".join(
            ["#version 3.7;", lights, "background { color rgb 1 }", f"camera {{ {view} }}", *self.parts, ""]
        )


def corners_by_place(box):
    """The corners of a box by their place, 0 or 1 along each edge."""
    return dict(zip(np.ndindex(2, 2, 2), box.corners()))


def box_edges(corners):
    """The twelve edges between corners, which are given by their place."""
    steps = [(start, axis) for start in corners for axis in range(3) if start[axis] == 0]
    ends = [tuple(1 if k == axis else start[k] for k in range(3)) for start, axis in steps]
    return np.array([(corners[start], corners[end]) for (start, _), end in zip(steps, ends)])


def require_povray():
    if not shutil.which("povray"):
        raise InputError(
            "POV-Ray, which draws the pictures, was not found. On Debian or Ubuntu: sudo apt-get install povray; "
            "elsewhere: https://www.povray.org/download"
        )


def run_povray(text, width, height, threads):
    """The picture as an array (height, width, 3) of numbers from 0 to 1."""
    with tempfile.TemporaryDirectory(prefix="grainscope-") as folder:
        Path(folder, "scene.pov").write_text(text)
        command = ["povray", "+Iscene.pov", "+Oscene.png", f"+W{width}", f"+H{height}", "+A0.1", "+AM2", "+R3"]
        command += ["-D", "-GA", f"+WT{threads}"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise InputError("povray failed:\n" + "\n".join(done.stderr.splitlines()[-15:]))
        return matplotlib.image.imread(Path(folder, "scene.png"))[..., :3]
