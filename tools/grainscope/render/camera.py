# SPDX-License-Identifier: GPL-2.0-or-later
"""Where pictures are seen from: what is up, the direction of the view, and the camera that just sees all there is."""

from dataclasses import dataclass

import numpy as np

from grainscope.errors import InputError

AXES = "xyz"
OPENING = 24.0  # horizontal opening of a perspective camera [degrees]
MARGIN = 1.06  # width of the picture over that of what is in it
DEFAULT_VIEW = (18.0, 16.0)  # azimuth and elevation [degrees]


def upright(up):
    """Rows: the axes of the run that point right, up and to the viewer, seen from the front. Up is the axis `up`, right
    the first of the other two."""
    right = np.eye(3)[AXES.index("y" if up == "x" else "x")]
    top = np.eye(3)[AXES.index(up)]
    return np.array([right, top, np.cross(right, top)])


def direction_of(view, up):
    """Unit vector to the viewer, in the run's axes: `view` is an azimuth (from the front to the right) and an elevation
    in degrees, or three components of a vector to the viewer."""
    if len(view) == 2 and np.all(np.isfinite(view)):
        azimuth, elevation = np.radians(view)
        right, top, front = upright(up)
        level = np.cos(azimuth) * front + np.sin(azimuth) * right
        return np.cos(elevation) * level + np.sin(elevation) * top
    if len(view) == 3 and np.all(np.isfinite(view)) and np.linalg.norm(view) > 0:
        return np.array(view, dtype=float) / np.linalg.norm(view)
    words = " ".join(f"{number:g}" for number in view)
    raise InputError(f"--view must be an azimuth and an elevation, or a vector x y z that is not 0; got '{words}'")


@dataclass
class Camera:
    """The rows of `axes` point right and up in the picture and to the viewer; `target` is in its middle. `width` is
    what the picture spans in the plane through the target, `distance` how far from there the camera is."""

    axes: np.ndarray
    target: np.ndarray
    width: float
    distance: float
    orthographic: bool

    def seen(self, points):
        """Points in the axes of the picture, from its middle."""
        return (points - self.target) @ self.axes.T


def picture_axes(view, up):
    """Rows: right and up in the picture, to the viewer."""
    toward = direction_of(view, up)
    right, top, _ = upright(up)
    level = np.cross(top, toward)
    if np.linalg.norm(level) > 1e-6:
        right = level / np.linalg.norm(level)
    return np.array([right, np.cross(toward, right), toward])


def half_opening_of(orthographic):
    """Its tangent."""
    return 0.0 if orthographic else np.tan(np.radians(0.5 * OPENING)) / MARGIN


def outermost(axes, points, radii, aspect, orthographic):
    """Which spheres decide the camera: of others with these, fitted() makes the same camera from these alone."""
    if not len(points):
        return np.array([], dtype=int)
    u, v, w = axes @ points.T
    half_opening = half_opening_of(orthographic)
    found = [w.argmin(), w.argmax(), (w + radii).argmax()]
    for place, tangent in ((u, half_opening), (v, half_opening / aspect)):
        reach = tangent * w + radii * np.hypot(1.0, tangent)
        found += [(reach + place).argmax(), (reach - place).argmax()]
    return np.unique(found)


def fitted(axes, points, radii, aspect, orthographic):
    """The camera that just sees all spheres. In a perspective picture one at (u, v, w) of radius r is seen where
    |u - u_c| + r sqrt(1 + t^2) <= t (D - w), t the tangent of half the opening; so for v, with the opening upwards."""
    places = points @ axes.T
    w = places[:, 2]
    middle = 0.5 * (w.min() + w.max())
    half_opening = half_opening_of(orthographic)
    centre, halves = [], []
    for k, tangent in ((0, half_opening), (1, half_opening / aspect)):
        reach = tangent * (w - middle) + radii * np.hypot(1.0, tangent)
        above, below = np.max(places[:, k] + reach), np.max(reach - places[:, k])
        centre.append(0.5 * (above - below))
        halves.append(0.5 * (above + below) * (1.0 if k == 0 else aspect))
    half = max(halves)
    target = np.array([*centre, middle]) @ axes
    distance = np.max(w - middle + radii) + half if orthographic else half / half_opening
    return Camera(axes, target, 2.0 * half * MARGIN, distance, orthographic)
