"""How far a command is, as one line on stderr: on a terminal rewritten twice a second, elsewhere a new one now and
then. Nothing of what takes less than five seconds."""

from contextlib import contextmanager
import sys
import threading
import time

SILENT = 5.0  # seconds before the first line
PAUSES = {True: 0.5, False: 30.0}  # between lines, on a terminal and elsewhere


class Line:
    def __init__(self, out=None, clock=time.monotonic):
        self.out, self.clock = out or sys.stderr, clock
        self.terminal = self.out.isatty()
        self.begin = clock()
        self.next = self.begin + SILENT

    def show(self, text):
        """Called as often as one likes."""
        now = self.clock()
        if now >= self.next:
            self.next = now + PAUSES[self.terminal]
            print(
                f"\r\033[K{text}" if self.terminal else text,
                end="" if self.terminal else "\n",
                file=self.out,
                flush=True,
            )

    def end(self):
        if self.terminal:
            print("\r\033[K", end="", file=self.out, flush=True)


def duration(seconds):
    minutes, seconds = divmod(round(seconds), 60)
    return f"{minutes} min {seconds:02d} s" if minutes else f"{seconds} s"


def progress(items, what, line=None):
    """The items, one after the other; says which of how many is at work, and how much time the others will take."""
    items = list(items)
    line = line or Line()
    for done, item in enumerate(items):
        spent = line.clock() - line.begin
        left = f", {duration(spent / done * (len(items) - done))} left" if done else ""
        line.show(f"{what}: {done + 1} of {len(items)}{left}")
        yield item
    line.end()


@contextmanager
def followed(text, line=None):
    """While the block lasts, says on a terminal what text() gives."""
    line = line or Line()
    ended = threading.Event()

    def follow():
        while not ended.wait(PAUSES[True]):
            line.show(text())

    follower = threading.Thread(target=follow, daemon=True)
    if line.terminal:
        follower.start()
    try:
        yield
    finally:
        ended.set()
        if line.terminal:
            follower.join()
        line.end()
