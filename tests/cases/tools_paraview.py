# SPDX-License-Identifier: GPL-2.0-or-later
"""What ParaView itself makes of the files of convert: sizes, orientations, volumes, lines, and what its pictures show.
Skipped where there is no ParaView."""
import math
import os
from pathlib import Path
import shutil
import subprocess

import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial.transform import Rotation

from case import main, require, require_close, skip
from deck import Deck, dump_grains, dump_local
from dump_files import converted, new_folder, snapshot
from packing import dense_packing, tilted
from run import run

LOOK = Path(__file__).resolve().parents[1] / "tools" / "paraview_look.py"
SHAPES = np.array(
    [(1.0, 1.0, 1.5), (1.4, 1.4, 0.5), (0.6, 1.0, 1.6), (0.5, 0.5, 0.5), (2.0, 0.3, 0.3), (0.2, 1.5, 1.5)]
)
PLACES = np.array([(3.0, 3, 0), (8, 3, 2), (13, 3, 4), (3, 9, 1), (8, 9, 3), (13, 9, 5)])
SHOWN = 6.0  # half the height of the picture; its middle is at x = 8, y = 6
LEVEL = 3


def seen_by_paraview(folder, time):
    """A screen of its own is started for it, as pvbatch of Debian cannot draw without one."""
    lacking = [name for name in ("pvbatch", "Xvfb") if shutil.which(name) is None]
    if lacking:
        skip(f"{' and '.join(lacking)} not installed; on Debian: apt-get install paraview python3-paraview xvfb")
    ours, theirs = os.pipe()
    screen = subprocess.Popen(
        ["Xvfb", "-displayfd", str(theirs), "-screen", "0", "1024x768x24", "-noreset", "-nolisten", "tcp"],
        pass_fds=[theirs],
        stderr=subprocess.DEVNULL,
    )
    os.close(theirs)
    try:
        with os.fdopen(ours) as number:
            display = f":{number.readline().strip()}"
        done = subprocess.run(
            ["pvbatch", str(LOOK), str(folder), str(time)],
            env=dict(os.environ, DISPLAY=display),
            capture_output=True,
            text=True,
        )
    finally:
        screen.terminate()
        screen.wait()
    require(done.returncode == 0, f"pvbatch ended with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return dict(np.load(folder / "seen.npz"))


def ellipsoids():
    """Columns of a dump of ellipsoids side by side, seen from z, and their rotations."""
    turns = Rotation.random(len(SHAPES), random_state=4)
    (i, j, k, w), (x, y, z), (a, b, c) = turns.as_quat().T, PLACES.T, SHAPES.T
    columns = {"id": list(range(1, 7)), "type": [1] * 6, "x": x, "y": y, "z": z}
    columns |= {"quat1": w, "quat2": i, "quat3": j, "quat4": k, "shapex": a, "shapey": b, "shapez": c}
    return columns, turns.as_matrix()


def share_off(picture, inside):
    """The share of the pixels that should show a grain, or should not, and do the opposite."""
    pixels = plt.imread(picture)[..., :3]
    require(pixels.shape[:2] == inside.shape, f"{picture}: {pixels.shape}")
    blue = (pixels[..., 2] > 0.9) & (pixels[..., 0] < 0.5)
    return np.count_nonzero(blue != inside) / np.count_nonzero(inside)


def middles(height=300, width=400):
    """x and y of the middles of the pixels."""
    size = 2.0 * SHOWN / height
    x = 8.0 + (np.arange(width) + 0.5 - 0.5 * width) * size
    y = 6.0 - (np.arange(height) + 0.5 - 0.5 * height) * size
    return np.stack(np.meshgrid(x, y), axis=-1)


def grains(ranks):
    """Tensor glyphs and surfaces lie on the ellipsoids and reach as far as they; pictures show them and 3D glyphs where
    their outlines are, which are known ellipses; surfaces lack of 4/3 pi abc what a mesh of this level lacks."""
    columns, turns = ellipsoids()
    folder = new_folder()
    later = dict(columns, x=PLACES[:, 0] + 0.5)
    text = [snapshot(step, one, (16.0, 12.0, 9.0), (1.0, 0.0, 0.0)) for step, one in ((0, columns), (10, later))]
    (folder / "grains.dump").write_text("".join(text))
    converted("grains.dump", "--to", "vtk", "--mesh", LEVEL, "--dt", "0.1", folder=folder)
    seen = seen_by_paraview(folder / "vtk", 1.0)
    for kind in ("grains", "surfaces", "box"):
        require_close(seen[f"{kind} times"], [0.0, 1.0], 0.0, f"times of {kind}")
    centres = PLACES + [0.5, 0.0, 0.0]
    require_close(seen["grains points"], centres, 1e-15, "centres")
    require_close(seen["grains point semi_axes"], SHAPES, 1e-15, "semi-axes")
    spread = np.einsum("nij,nj,nkj->nik", turns, SHAPES**2, turns)
    for kind, bound in (("glyphs", 2e-3), ("surfaces", 2e-2)):
        points = seen[f"{kind} points"].reshape(6, -1, 3) - centres[:, None]
        local = np.einsum("nji,npj->npi", turns, points) / SHAPES[:, None]
        require_close(np.linalg.norm(local, axis=2), np.ones(local.shape[:2]), 1e-5, f"{kind} lie on the ellipsoids")
        reach = np.sqrt(np.einsum("nii->ni", spread))
        require_close(
            np.abs(points).max(axis=1) / reach, np.ones((6, 3)), bound, f"{kind} reach as far as the ellipsoids"
        )
    from_middle = middles() - centres[:, None, None, :2]
    outline = np.linalg.inv(spread[:, :2, :2])
    inside = (np.einsum("nhwi,nij,nhwj->nhw", from_middle, outline, from_middle) < 1).any(axis=0)
    for picture in ("glyphs", "representation", "surfaces"):
        off = share_off(folder / "vtk" / f"{picture}.png", inside)
        require(off < 0.01, f"{off:.1%} of the pixels of {picture}.png differ from the outlines")
    lacks = 1.0 - seen["surfaces volume"] / (4.0 / 3.0 * math.pi * SHAPES.prod(axis=1).sum())
    require(0.008 < lacks < 0.009, f"surfaces lack {lacks:.3%} of 4/3 pi abc")  # 0.86 % at level 3, for any ellipsoid


def contacts(ranks):
    """Lines of a run's contacts: as many as rows, as long as branches, thicker with the force."""
    packing = tilted(dense_packing(1.5, (1.0, 0.8)), 0.3)
    deck = Deck(packing, surface="ellipsoid", extra="tangential_damping off")
    deck.body = ["compute contacts all contact/local", *dump_local("contacts", 30, 10, "contacts")]
    deck.body += [*dump_grains(packing, 10), "run 10"]
    result = run(deck, ranks)
    converted("grains.dump", "--to", "vtk", "--contacts", "contacts.dump", folder=result.folder)
    seen = seen_by_paraview(result.folder / "vtk", 10.0)
    rows = result.dump("contacts.dump")[1][1]
    require(int(seen["contacts cells"]) == len(rows["c_contacts[1]"]) > 100, f"{seen['contacts cells']} lines")
    lines = seen["contacts points"].reshape(-1, 3, 3)
    branches = np.transpose([rows[f"c_contacts[{k}]"] for k in (12, 13, 14)])
    require_close(lines[:, 0] - lines[:, 2], branches, 1e-12, "branches")
    require_close(seen["contacts cell fn"], rows["c_contacts[19]"], 1e-15, "fn")
    tubes = seen["tubes points"].reshape(len(lines), -1, 3)
    axis = branches / np.linalg.norm(branches, axis=1, keepdims=True)
    ends = tubes - lines[:, :1]
    radii = np.linalg.norm(ends - (ends @ axis[:, :, None]) * axis[:, None], axis=2).min(axis=1)
    order = np.argsort(rows["c_contacts[19]"])
    require(radii[order[-20:]].mean() > 1.5 * radii[order[:20]].mean(), "strong contacts have thicker tubes")
    drawn = (plt.imread(result.folder / "vtk" / "contacts.png")[..., 0] < 0.5).mean()
    require(0.02 < drawn < 0.9, f"the picture of the contacts shows them on {drawn:.1%} of its pixels")


main({"grains": grains, "contacts": contacts})
