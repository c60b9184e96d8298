"""Picture of the grains of a dump by POV-Ray: true ellipsoids in the sheared box, coloured by how far each is turned
out of the flow (the x axis). The angle is that of the long axis of a prolate grain, of the flat plane of an oblate
one. Spheres are grey."""
from dataclasses import replace
from pathlib import Path
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from grainscope.errors import InputError
from grainscope.grains import read_grains

SCENE = """#version 3.7;
global_settings {{ assumed_gamma 1.0
  radiosity {{ pretrace_start 0.08 pretrace_end 0.01 count 200 error_bound 0.8 recursion_limit 1 nearest_count 12 }} }}
background {{ color rgb 1 }}
camera {{ location {camera} right -x*{aspect} up y sky y angle {angle} look_at {target} }}
light_source {{ {key_light} color rgb 0.85 area_light {across}*x, {across}*z, 17, 17 adaptive 3 circular orient }}
light_source {{ {fill_light} color rgb 0.25 shadowless }}
#declare grain_finish = finish {{ ambient 0 emission 0.05 diffuse 0.75 specular 0.22 roughness 0.03 }}
plane {{ y, {floor} pigment {{ color rgb 1 }} finish {{ ambient 0 emission 0.06 diffuse 0.64 }} }}
#declare edge = texture {{ pigment {{ color rgb 0.18 }} finish {{ ambient 0 diffuse 0.6 }} }}
#declare arrow = texture {{ pigment {{ color rgb 0.35 }} finish {{ ambient 0 diffuse 0.7 }} }}
{box}
{arrows}
{grains}
"""


def angle_to_flow(grains):
    """Angle [deg] in (0, 90) between the flow and each grain's long axis (prolate) or flat plane (oblate); None for
    spheres."""
    sizes = np.sort(grains.semi_axes, axis=1)
    if np.all(sizes[:, 2] - sizes[:, 0] < 1e-9 * sizes[:, 2]):
        return None
    oblate = sizes[:, 1] - sizes[:, 0] > sizes[:, 2] - sizes[:, 1]
    axis = np.where(oblate, np.argmin(grains.semi_axes, axis=1), np.argmax(grains.semi_axes, axis=1))
    along_flow = np.abs(np.take_along_axis(grains.rotations[:, 0, :], axis[:, None], axis=1)[:, 0])
    angle = np.degrees(np.arccos(np.clip(along_flow, 0.0, 1.0)))
    return np.where(oblate, 90.0 - angle, angle)


def with_z_upwards(grains):
    """Turned so that z points up, along the y of the picture, and y to the back."""
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
    a, b, c = grains.edges @ turn.T
    return replace(
        grains,
        positions=grains.positions @ turn.T,
        rotations=turn @ grains.rotations,
        origin=turn @ (grains.origin + grains.edges[1]),
        edges=np.array([a, c, -b]),
    )


def in_the_smallest_box(grains):
    """In a box that just holds them."""
    reach = grains.semi_axes.max(axis=1, keepdims=True)
    low, high = (grains.positions - reach).min(axis=0), (grains.positions + reach).max(axis=0)
    return replace(grains, origin=low, edges=np.diag(high - low))


def wrapped(grains):
    """Positions inside the box, relative to its centre."""
    fractions = (grains.positions - grains.origin) @ np.linalg.inv(grains.edges)
    return (fractions % 1.0 - 0.5) @ grains.edges


def vector(v):
    return "<" + ", ".join(f"{x:.6g}" for x in v) + ">"


def describe_grains(grains, colours):
    """One unit sphere per grain, stretched, turned and moved; POV-Ray wants the images of x, y, z as rows."""
    lines = []
    for position, rotation, axes, colour in zip(wrapped(grains), grains.rotations, grains.semi_axes, colours):
        rows = np.vstack([rotation.T * axes[:, None], position])
        numbers = ", ".join(f"{x:.6g}" for x in rows.ravel())
        lines.append(
            f"sphere "
            f"{{ 0, 1 matrix <{numbers}> pigment {{ color srgb {vector(colour[:3])} }} finish {{ grain_finish }} }}"
        )
    return "\n".join(lines)


def describe_box(grains, radius):
    """The twelve edges of the box and its rounded corners."""
    corner = box_corners(grains)
    lines = [f"sphere {{ {vector(c)}, {radius:.6g} texture {{ edge }} }}" for c in corner.values()]
    for start in corner:
        for k in range(3):
            if start[k] == 0:
                end = tuple(1 if n == k else start[n] for n in range(3))
                lines.append(
                    f"cylinder {{ {vector(corner[start])}, {vector(corner[end])}, {radius:.6g} texture {{ edge }} }}"
                )
    return "\n".join(lines)


def camera_distance(points, direction, angle, aspect):
    """How far back along `direction` (unit, from the target at the origin) a camera of horizontal opening `angle` [deg]
    sees all points."""
    right = np.cross([0.0, 1.0, 0.0], direction)
    right /= np.linalg.norm(right)
    up = np.cross(direction, right)
    half_width = np.tan(np.radians(0.5 * angle))
    across = np.maximum(np.abs(points @ right), np.abs(points @ up) * aspect)
    return np.max(points @ direction + across / half_width)


def box_corners(grains):
    """The eight corners by their place (0 or 1 along each edge), the box centred at the origin."""
    return {place: (np.array(place) - 0.5) @ grains.edges for place in np.ndindex(2, 2, 2)}


def flow_arrows(grains):
    """Ends (tail, tip) of two arrows: along +x above the upper back edge of the box, along -x below its lower front
    edge."""
    gap = np.array([0, 1.6 * grains.semi_axes.max(), 0])
    corner = box_corners(grains)
    length = 0.3 * grains.edges[0]
    upper = 0.5 * (corner[0, 1, 0] + corner[1, 1, 0]) + gap
    lower = 0.5 * (corner[0, 0, 1] + corner[1, 0, 1]) - gap
    return [(upper - 0.5 * length, upper + 0.5 * length), (lower + 0.5 * length, lower - 0.5 * length)]


def describe_arrows(arrows, radius):
    lines = []
    for tail, tip in arrows:
        neck = tail + 0.8 * (tip - tail)
        lines.append(f"cylinder {{ {vector(tail)}, {vector(neck)}, {radius:.6g} texture {{ arrow }} }}")
        lines.append(f"cone {{ {vector(neck)}, {2.8 * radius:.6g}, {vector(tip)}, 0 texture {{ arrow }} }}")
    return "\n".join(lines)


def describe_scene(grains, colours, aspect, bare=False):
    """The scene around a box centred at the origin: camera in front (+z), above and to the right, a white floor, a soft
    light."""
    size = np.linalg.norm(np.diag(grains.edges))
    arrows = [] if bare else flow_arrows(grains)
    seen = np.array(list(box_corners(grains).values()) + [end for arrow in arrows for end in arrow])
    direction = np.array([0.30, 0.27, 0.91]) / np.linalg.norm([0.30, 0.27, 0.91])
    angle, margin = 24, 1.12
    return SCENE.format(
        aspect=aspect,
        angle=angle,
        target=vector([0, 0, 0]),
        camera=vector(camera_distance(margin * seen, direction, angle, aspect) * direction),
        key_light=vector(size * np.array([-5, 11, 6])),
        across=3.8 * size,
        fill_light=vector(size * np.array([2.5, 1.0, 2.5])),
        floor=seen[:, 1].min() - 0.02 * size,
        box="" if bare else describe_box(grains, 0.003 * size),
        arrows=describe_arrows(arrows, 0.005 * size),
        grains=describe_grains(grains, colours),
    )


def run_povray(scene, width, height, threads):
    """The rendered scene as an array of pixels."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "scene.pov").write_text(scene)
        command = [
            "povray",
            "+Iscene.pov",
            "+Oscene.png",
            f"+W{width}",
            f"+H{height}",
            "+A0.1",
            "+AM2",
            "+R3",
            "-D",
            "-GA",
            f"+WT{threads}",
        ]
        try:
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        except FileNotFoundError:
            raise InputError("povray was not found. On Debian or Ubuntu: sudo apt-get install povray") from None
        if done.returncode != 0:
            raise InputError("povray failed:\n" + "\n".join(done.stderr.splitlines()[-15:]))
        return plt.imread(Path(folder, "scene.png"))[..., :3]


def save_with_legend(pixels, colormap, path, label):
    """The picture with a colour bar at its lower edge."""
    height, width = pixels.shape[:2]
    figure = plt.figure(figsize=(width / 100, height / 100), dpi=100)
    figure.figimage(pixels, zorder=-1)
    if colormap is not None:
        axis = figure.add_axes([0.05, 0.10, 0.20, 0.016])
        scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, 90), colormap)
        bar = figure.colorbar(scale, cax=axis, orientation="horizontal", ticks=[0, 30, 60, 90])
        bar.ax.set_xticklabels(["0°", "30°", "60°", "90°"])
        bar.outline.set_visible(False)
        bar.ax.tick_params(length=0, labelsize=0.011 * width)
        bar.set_label(label, fontsize=0.012 * width)
    figure.savefig(path, dpi=100)
    plt.close(figure)


def add_arguments(parser):
    parser.add_argument(
        "dump",
        help="text dump with columns id x y z quat1-4 shapex-z, of spheres x y z radius (the last snapshot is drawn)",
    )
    parser.add_argument("--output", default="grains.png", metavar="FILE", help="the picture (default: grains.png)")
    parser.add_argument("--width", type=int, default=1600, help="in pixels; the height is 3/4 of it (default: 1600)")
    parser.add_argument("--colormap", default="viridis_r", help="a matplotlib colormap (default: viridis_r)")
    parser.add_argument("--threads", type=int, default=2, help="for POV-Ray (default: 2)")
    parser.add_argument("--up", choices=("y", "z"), default="y", help="what is up in the picture (default: y)")
    parser.add_argument("--bare", action="store_true", help="the grains alone, without box and arrows of the flow")
    parser.add_argument("--scene", metavar="FILE", help="also keep the POV-Ray scene here")


def run(arguments):
    if arguments.width < 100:
        raise InputError(f"--width must be at least 100, got {arguments.width}")
    if arguments.colormap not in plt.colormaps():
        raise InputError(f"--colormap must be one of matplotlib's, got '{arguments.colormap}'")
    grains = read_grains(arguments.dump)
    angles = angle_to_flow(grains)
    if arguments.up == "z":
        grains = with_z_upwards(grains)
    if arguments.bare:
        grains = in_the_smallest_box(grains)
    colormap = None if angles is None else plt.get_cmap(arguments.colormap)
    colours = np.full((len(grains.positions), 3), 0.75) if angles is None else colormap(angles / 90.0)
    scene = describe_scene(grains, colours, 4 / 3, arguments.bare)
    if arguments.scene:
        Path(arguments.scene).write_text(scene)
    pixels = run_povray(scene, arguments.width, arguments.width * 3 // 4, arguments.threads)
    label = "angle to x" if arguments.bare else "angle to the flow"
    save_with_legend(pixels, colormap, arguments.output, label)
    print(arguments.output)
