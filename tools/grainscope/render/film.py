# SPDX-License-Identifier: GPL-2.0-or-later
"""Films of all snapshots: frames drawn side by side, put together by ffmpeg (mp4) or Pillow (gif)."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
import importlib.util
import shutil
import subprocess
import sys
import tempfile
import time

import matplotlib.image
import numpy as np

from grainscope.errors import InputError
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


def picture(look, view, threads):
    """The pixels of one snapshot, colour bars included."""
    pixels = run_povray(look.scene(view), *look.pixels, threads)
    return finished(look, view.step, pixels)


def finished(look, step, pixels):
    return np.concatenate([pixels, look.strip(step)])


def film(look, sources, path, rate, jobs):
    """Draws every snapshot, `jobs` at a time, and writes the film."""
    steps = sources.steps
    with tempfile.TemporaryDirectory(prefix="grainscope-") as folder:
        progress = Progress(len(steps))

        def draw(number):
            pixels = run_povray(look.scene(sources.view(steps[number])), *look.pixels, 1)
            matplotlib.image.imsave(Path(folder, f"{number:06d}.png"), finished(look, steps[number], pixels))
            progress.advance()

        with ThreadPoolExecutor(jobs) as pool:
            for _ in pool.map(draw, range(len(steps))):
                pass
        progress.end()
        (write_mp4 if Path(path).suffix == ".mp4" else write_gif)(folder, len(steps), path, rate)


class Progress:
    """One line on stderr: which frame of how many, and the time that is left."""

    def __init__(self, frames):
        self.frames, self.done, self.start = frames, 0, time.monotonic()
        self.ending = "\r" if sys.stderr.isatty() else "\n"

    def advance(self):
        self.done += 1
        left = (time.monotonic() - self.start) / self.done * (self.frames - self.done)
        text = f"frame {self.done} of {self.frames}, {left // 60:.0f} min {left % 60:02.0f} s left"
        print(f"{text:<50}", end=self.ending, file=sys.stderr, flush=True)

    def end(self):
        if self.ending == "\r":
            print(file=sys.stderr)


def write_mp4(folder, frames, path, rate):
    """By H.264, which wants even sizes."""
    command = ["ffmpeg", "-y", "-loglevel", "error", "-framerate", f"{rate:g}", "-i", f"{folder}/%06d.png"]
    command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", path]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise InputError("ffmpeg failed:\n" + "\n".join(done.stderr.splitlines()[-10:]))


def write_gif(folder, frames, path, rate):
    from PIL import Image

    pictures = [Image.open(Path(folder, f"{number:06d}.png")).convert("RGB") for number in range(frames)]
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=1000.0 / rate, loop=0)
