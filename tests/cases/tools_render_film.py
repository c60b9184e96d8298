# SPDX-License-Identifier: GPL-2.0-or-later
"""grainscope-tools render --animate, and what render refuses."""
import argparse
import io
import os
import shutil
import subprocess
import weakref

import numpy as np
from PIL import Image, ImageSequence

from case import main, require, require_close, require_equal, skip
from dump_files import new_folder, refused, snapshot, tool
from grainscope.progress import Line
from grainscope.render.camera import fitted
from grainscope.render.command import add_arguments, checked
from grainscope.render.film import film
from grainscope.render.look import Look, Sources
import meshes
from pixels import KINDS, STRIP, cover, middle, read, spheres, spot

STEPS = (0, 200, 500, 900, 1000)
SIZE = (200, 180)
WORDS = ["--light", "none", "--colour", "type", "--view", 0, 0, "--orthographic", "--size", *SIZE]


def run_of(name="grains.*.dump"):
    """A folder with a dump of five steps, in which the first of three grains goes from one end to the other."""
    folder = new_folder()
    for step in STEPS:
        columns = spheres([(1 + step / 125, 5, 0), (1, 1, 0), (9, 1, 0)], 0.5)
        path = folder / name.replace("*", str(step))
        path.write_text((path.read_text() if path.exists() else "") + snapshot(step, columns, sides="ff ff ff"))
    return folder


def require_moves(frames, tolerance):
    """The first grain is where it was in the run, against the two that stay, in every frame."""
    require(len(frames) == len(STEPS), f"{len(frames)} frames")
    for step, frame in zip(STEPS, frames):
        require(frame.shape == (SIZE[1], SIZE[0], 3), f"a frame of {frame.shape}")
        frame = frame[: -round(STRIP * SIZE[0])]
        spots = [middle(spot(frame, colour, tolerance).astype(float)) for colour in KINDS[:3]]
        scale = (spots[2] - spots[1])[0] / 8.0
        require_close((spots[0] - spots[1]) / scale, [step / 125, -4.0], 0.05, f"step {step}", 8.0)


def gif(ranks):
    """Frames in the order of steps, whatever that of names; from one file and from several; alone and two at a time."""
    for name, jobs in (("grains.*.dump", 1), ("grains.dump", 2)):
        folder = run_of(name)
        words = [name, *WORDS, "--animate", "film.gif", "--jobs", jobs, "--rate", 5]
        code, said = tool("render", *words, folder=folder)
        require(code == 0 and said.split()[-1] == "film.gif", f"{code}, {said}")
        with Image.open(folder / "film.gif") as film:
            frames = [np.array(frame.convert("RGB")).astype(int) for frame in ImageSequence.Iterator(film)]
            require(film.info["duration"] == 200, f"{film.info['duration']} ms a frame, 5 frames a second")
        require_moves(frames, 30)


def progress(ranks):
    """One line on a terminal, rewritten for each frame, with the time that the others will take. The clock goes on by
    7 s each time that it is looked at: twice a frame."""

    class Terminal(io.StringIO):
        def isatty(self):
            return True

    parser, times, screen = argparse.ArgumentParser(), iter(range(7, 1000, 7)), Terminal()
    add_arguments(parser)
    folder = run_of()
    given = checked(parser.parse_args([*map(str, WORDS), str(folder / "grains.*.dump")]))
    sources = Sources(given)
    film(Look(sources, sources.steps, given), sources, folder / "film.gif", 12.0, 1, Line(screen, lambda: next(times)))
    lines = screen.getvalue().replace("\033[K", "").split("\r")[1:-1]
    expected = [f"frame {k} of 5, {left} s left" for k, left in zip(range(1, 6), (28, 32, 23, 12, 0))]
    require(lines == expected, f"{lines}")


def mp4(ranks):
    if shutil.which("ffmpeg") is None:
        skip("ffmpeg not installed; on Debian: apt-get install ffmpeg")
    folder = run_of()
    words = ["grains.*.dump", *WORDS, "--animate", "film.mp4", "--rate", 5]
    code, said = tool("render", *words, folder=folder)
    require(code == 0 and said.split()[-1] == "film.mp4", f"{code}, {said}")
    subprocess.run(["ffmpeg", "-loglevel", "error", "-i", "film.mp4", "%d.png"], cwd=folder, check=True)
    require_moves([read(folder / f"{number}.png") for number in range(1, len(list(folder.glob("*.png"))) + 1)], 60)


def one_view_at_a_time(ranks):
    """The look of a film reads its snapshots one after the other and keeps none; every second frame reads no others."""
    most = 2  # the one that was looked at before, and this one
    for every in (1, 2):
        parser, kept, read_steps = argparse.ArgumentParser(), [], []
        add_arguments(parser)
        words = [*WORDS, "--animate", "film.gif", "--every", every, run_of() / "grains.*.dump"]
        sources = Sources(checked(parser.parse_args([*map(str, words)])))
        at = sources.grains.at

        def noted(step):
            snapshot = at(step)
            kept.append(weakref.ref(snapshot))
            read_steps.append(step)
            alive = sum(one() is not None for one in kept)
            require(alive <= most, f"{alive} snapshots are kept")
            return snapshot

        sources.grains.at = noted
        Look(sources, sources.steps[::every], sources.arguments)
        require(set(read_steps) == set(STEPS[::every]), f"steps {read_steps} were read")


def same_look(ranks):
    """Camera and colours are those that all grains at once have, with and without perspective."""
    folder = new_folder()
    random = np.random.default_rng(3)
    steps, count = (0, 1, 2), 40
    places, radii = random.uniform(0.0, 10.0, (len(steps), count, 3)), random.uniform(0.2, 1.0, (len(steps), count))
    for step in steps:
        columns = dict(zip("xyz", places[step].T), id=list(range(1, count + 1)), radius=radii[step])
        (folder / f"{step}.dump").write_text(snapshot(step, columns, sides="ff ff ff"))
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    for words in ([], ["--orthographic"]):
        words = [*words, "--colour", "radius", "--animate", "film.gif", folder / "*.dump"]
        given = checked(parser.parse_args([*map(str, words)]))
        sources = Sources(given)
        look = Look(sources, sources.steps, given)
        width, height = look.pixels
        expected = fitted(look.axes, places.reshape(-1, 3), radii.ravel(), width / height, given.orthographic)
        require_equal([look.scale.low, look.scale.high], [radii.min(), radii.max()], "ends of the colour bar")
        # points are projected in blocks of other sizes
        require_close(look.camera.target, expected.target, 1e-14, "target of the camera", 10.0)
        require_close([look.camera.width], [expected.width], 1e-14, "width of the picture")


def one_step(ranks):
    """--step draws that snapshot, else the last is drawn; a film and its frames have one camera."""
    folder = run_of()
    for more, step in ((["--step", 500], 500), ([], 1000)):
        code, said = tool("render", "grains.*.dump", *WORDS, *more, "--output", "one.png", folder=folder)
        require(code == 0, said)
        picture = read(folder / "one.png")[: -round(STRIP * SIZE[0])]
        spots = [middle(cover(picture, colour)) for colour in KINDS[:3]]
        across = (spots[0] - spots[1])[0] / (spots[2] - spots[1])[0]
        require_close(across, step / 1000, 0.01, f"step {step}")
    refused("render", ["grains.*.dump", "--step", 501], "no snapshot of step 501", "0, 200, 500", folder=folder)


def walls_that_move(ranks):
    """A * in the name of a mesh stands for the step."""
    folder = run_of()
    walls = meshes.folder_with(
        **{f"wall{step}": meshes.rectangle((4, 2 + step / 250, 0), (2, 0, 0), (0, 1, 0)) for step in (0, 500, 1000)}
    )
    words = [*WORDS, "--walls", walls / "wall*.stl", "--wall-style", "solid"]
    heights = []
    for step in STEPS:
        code, said = tool("render", "grains.*.dump", *words, "--step", step, "--output", "one.png", folder=folder)
        require(code == 0, said)
        picture = read(folder / "one.png")[: -round(STRIP * SIZE[0])]
        low, right = (middle(cover(picture, colour)) for colour in KINDS[1:3])
        scale = (right - low)[0] / 8.0
        heights.append((low - middle(spot(picture, (197, 203, 212)).astype(float)))[1] / scale)
    expected = [1.5 + step / 250 for step in (0, 0, 500, 500, 1000)]
    require_close(heights, expected, 0.02, "heights of the wall over the lower grains", 5.0)


def said_without(programs, *words):
    """Exit code and messages where these programs are not on PATH."""
    folder, hidden, before = run_of(), new_folder(), os.environ["PATH"]
    for name in ("povray", "ffmpeg"):
        if name not in programs and shutil.which(name):
            (hidden / name).symlink_to(shutil.which(name))
    os.environ["PATH"] = str(hidden)
    try:
        code, said = tool("render", "grains.*.dump", *words, folder=folder)
    finally:
        os.environ["PATH"] = before
    left = [path.name for path in folder.iterdir() if not path.name.startswith("grains.")]
    require(not left, f"it wrote {left}")
    return code, said


def missing_programs(ranks):
    """One sentence, before anything is drawn."""
    for programs, words, expected in (
        (["povray"], [], "sudo apt-get install povray"),
        (["povray"], ["--animate", "film.gif"], "sudo apt-get install povray"),
        (["ffmpeg"], ["--animate", "film.mp4"], "sudo apt-get install ffmpeg"),
    ):
        code, said = said_without(programs, *words)
        require(code == 1 and expected in said and "\n" not in said, f"without {programs}: {code}, {said}")


def refusals(ranks):
    """Each option's, with the word that was received; nothing is written."""
    folder = run_of()
    (folder / "bad.stl").write_text("solid bad\nendsolid bad\n")
    for words, expected in (
        (["--view", 1], "--view must be an azimuth and an elevation, or a vector x y z that is not 0; got '1'"),
        (["--view", 0, 0, 0], "--view must be an azimuth and an elevation"),
        (["--view", "nan", 0], "--view must be an azimuth and an elevation"),
        (["--size", 200, 31], "--size must be at least 32 32, got 200 31"),
        (["--size", 1000, 80, "--colour", "type"], "--size: 80 pixels are too low for a width of 1000"),
        (["--jobs", 0], "--jobs must be at least 1, got 0"),
        (["--cut", "w", 0, 1], "--cut must begin with x, y or z, got 'w 0 1'"),
        (["--cut", "xy", 0, 1], "--cut must begin with x, y or z, got 'xy 0 1'"),
        (["--cut", "x", 0, "one"], "--cut must be an axis and two numbers, got 'x 0 one'"),
        (["--cut", "x", 2, 1], "--cut x: the first number must be below the second, got 'x 2 1'"),
        (["--cut", "x", 90, 91], "no grain to draw of the 3 of step 1000 with --cut x 90 91"),
        (["--where", "type == 7"], "no grain to draw of the 3 of step 1000 with --where 'type == 7'"),
        (["--where", "kind == 1"], "no column kind; it has id type x y z radius"),
        (["--where", "type = 1"], "--where: '=' has no meaning"),
        (["--colour", "heat"], "no column heat; it has id type x y z radius"),
        (["--range", 1, 1], "--range: the first number must be below the second, got 1 1"),
        (["--range", "-1e-3", "-2e-3"], "got -0.001 -0.002"),
        (["--colormap", "rainbows"], "--colormap must be one of matplotlib's, got 'rainbows'"),
        (["--opacity", 0], "--opacity must be above 0 and at most 1, got 0"),
        (["--opacity", 1.5], "--opacity must be above 0 and at most 1, got 1.5"),
        (["--walls", "none.stl"], "none.stl: No such file or directory"),
        (["--walls", "bad.stl"], "bad.stl: neither a whole ASCII STL file"),
        (["--walls", "none*.stl"], "--walls none*.stl: no file"),
        (["--primitive", "zball", 1], "got 'zball 1'"),
        (["--primitive", "zplane"], "--primitive must be xplane, yplane or zplane with a coordinate"),
        (["--primitive", "zcylinder", 1, 0, "0a"], "--primitive: numbers must follow zcylinder"),
        (["--primitive", "zcylinder", -1, 0, 0], "--primitive: the radius must be above 0, got 'zcylinder -1 0 0'"),
        (["--primitive", "zcylinder", 1, 0, 0, 2, 1], "--primitive: the first end must be below the second"),
        (["--contacts", "none.dump"], "none.dump: No such file"),
        (["--only-contacts"], "--only-contacts needs --contacts"),
        (["--contact-columns", "id"], "--contact-columns needs --contacts"),
        (["--strongest", 0], "--strongest must be above 0, got 0"),
        (["--contacts", "c", "--only-contacts", "--colour", "type"], "--colour is for grains, which --only-contacts"),
        (["--output", "a.jpg"], "--output must end in .png, got 'a.jpg'"),
        (["--output", "none/a.png"], "No such file or directory"),
        (["--animate", "a.avi"], "--animate must end in .mp4 or .gif, got 'a.avi'"),
        (["--every", 2], "--every is for films: give --animate"),
        (["--animate", "a.gif", "--every", 0], "--every must be at least 1, got 0"),
        (["--animate", "a.gif", "--step", 0], "--animate draws all snapshots; leave out --step and --scene"),
        (["--animate", "a.gif", "--rate", 0], "--rate must be above 0, got 0"),
    ):
        refused("render", ["grains.*.dump", "--light", "none", *words], expected, folder=folder)
    left = sorted(path.name for path in folder.iterdir() if not path.name.startswith("grains."))
    require(left == ["bad.stl"], f"it wrote {left}")
    code, said = tool("render", "grains.*.dump", "--light", "bright", folder=folder)
    require(code == 2 and "'bright'" in said, f"{code}, {said}")
    columns = spheres([(1, 1, 1)], 1.0)
    for change, expected in (
        ({"radius": None}, "no column radius"),
        ({"radius": [-1.0]}, "sizes must be above 0, got -1"),
        ({"shapex": [1.0], "shapey": [2.0], "shapez": [1.0]}, "no column quat1, quat2, quat3, quat4"),
    ):
        data = {name: values for name, values in (columns | change).items() if values is not None}
        (folder / "bad.dump").write_text(snapshot(0, data))
        refused("render", ["bad.dump"], "bad.dump", expected, folder=folder)


def scene_file(ranks):
    """--scene keeps POV-Ray's scene: a sphere for each grain, placed in units of the picture's width."""
    folder = run_of()
    code, said = tool("render", "grains.*.dump", *WORDS, "--scene", "scene.pov", folder=folder)
    require(code == 0 and (folder / "grains.png").exists(), said)
    text = (folder / "scene.pov").read_text()
    rows = [line.split("<")[1].split(">")[0].split(",") for line in text.splitlines() if line.startswith("sphere")]
    rows = np.array(rows, dtype=float).reshape(3, 4, 3)
    require_close(rows[:, :3], np.broadcast_to(rows[0, 0, 0] * np.eye(3), (3, 3, 3)), 1e-12, "three equal spheres")
    places = rows[:, 3] / rows[0, 0, 0] * 0.5
    require_close(places[1:] - places[0], [[-8, -4, 0], [0, -4, 0]], 1e-5, "places, to their radius")
    shutil.copy(folder / "grains.png", folder / "first.png")
    code, said = tool("render", "grains.*.dump", *WORDS, folder=folder)
    require_equal(read(folder / "grains.png"), read(folder / "first.png"), "the same picture twice")


main(
    {
        "gif": gif,
        "progress": progress,
        "mp4": mp4,
        "one-view-at-a-time": one_view_at_a_time,
        "same-look": same_look,
        "one-step": one_step,
        "walls-that-move": walls_that_move,
        "missing-programs": missing_programs,
        "refusals": refusals,
        "scene-file": scene_file,
    }
)
