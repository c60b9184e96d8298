# SPDX-License-Identifier: GPL-2.0-or-later
"""Films of all snapshots: frames drawn side by side, put together by ffmpeg (mp4) or Pillow (gif)."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
import importlib.util
import shutil
import subprocess
import tempfile

import matplotlib.image
import numpy as np

from grainscope.errors import InputError
from grainscope.progress import Line, duration
from grainscope.render.scene import run_povray

ENDINGS = (".mp4", ".gif")


def require_writer(path):
    """Refuses what cannot be written before anything is drawn."""
    ending = Path(path).suffix
    if ending not in ENDINGS:
        raise InputError(f"--animate must end in {' or '.join(ENDINGS)}, got '{path}'")
    if ending == ".mp4" and not shutil.which("ffmpeg"):
        raise InputError(
            "--animate: ffmpeg, which makes mp4 films, was not found. On Debian or Ubuntu: "
            "sudo apt-get install ffmpeg; or write a .gif"
        )
    if ending == ".gif" and importlib.util.find_spec("PIL") is None:
        raise InputError(
            "--animate: the Python package PIL, which makes gif films, was not found. On Debian or Ubuntu: "
            "sudo apt-get install python3-pil; or write a .mp4"
        )


def finished(look, step, pixels):
    """A picture with its colour bars."""
    return np.concatenate([pixels, look.strip(step)])


def film(look, sources, path, rate, jobs, line=None):
    """Draws the snapshots of the look, `jobs` at a time, says how far it is, and writes the film."""
    steps = look.steps
    line = line or Line()

    def draw(step):
        return run_povray(look.scene(sources.view(step)), *look.pixels, 1)

    with tempfile.TemporaryDirectory(prefix="grainscope-") as folder:
        with ThreadPoolExecutor(jobs) as pool:
            for number, pixels in enumerate(pool.map(draw, steps), 1):
                frame = finished(look, steps[number - 1], pixels)
                matplotlib.image.imsave(Path(folder, f"{number:06d}.png"), frame)
                left = (line.clock() - line.begin) / number * (len(steps) - number)
                line.show(f"frame {number} of {len(steps)}, {duration(left)} left")
        line.end()
        (write_mp4 if Path(path).suffix == ".mp4" else write_gif)(folder, path, rate)


def write_mp4(folder, path, rate):
    """By H.264, which wants even sizes."""
    command = ["ffmpeg", "-y", "-loglevel", "error", "-framerate", f"{rate:g}", "-i", f"{folder}/%06d.png"]
    command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", path]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise InputError("ffmpeg failed:\n" + "\n".join(done.stderr.splitlines()[-10:]))


def write_gif(folder, path, rate):
    from PIL import Image

    first, *others = [Image.open(name).convert("RGB") for name in sorted(Path(folder).glob("*.png"))]
    first.save(path, save_all=True, append_images=others, duration=1000.0 / rate, loop=0)
