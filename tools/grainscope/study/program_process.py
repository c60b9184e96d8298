"""A program that ends in order, once, when its time is over, when this process gets a signal, and when it is killed."""

import ctypes
import os
import signal
import subprocess
import sys
import time

PAUSE = 0.1  # seconds between looks at what the program does
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
SIGNAL_OF_PARENT = 1  # PR_SET_PDEATHSIG of Linux


def end_with_parent():
    """What a process calls before it becomes a program: a group of its own, so that Ctrl-C on a terminal reaches its
    parent alone, which then ends it; and, on Linux, a SIGTERM when the parent was killed."""
    library = ctypes.CDLL(None) if sys.platform == "linux" else None

    def prepare():
        os.setpgid(0, 0)
        if library:
            library.prctl(SIGNAL_OF_PARENT, signal.SIGTERM)

    return prepare


class ProgramProcess:
    def __init__(self, command, **options):
        self.asked_to_end = False
        self.earlier = {number: signal.signal(number, self.end) for number in SIGNALS}
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stderr=subprocess.STDOUT,
            preexec_fn=end_with_parent(),
            **options,
        )

    def end(self, *_):
        """A second SIGTERM would end the program at once, without complete files."""
        if not self.asked_to_end:
            self.asked_to_end = True
            os.kill(self.process.pid, signal.SIGTERM)

    def wait(self, must_end):
        """Exit code, and what the program used; asks must_end() whether its time is over."""
        try:
            while True:
                pid, status, usage = os.wait4(self.process.pid, os.WNOHANG)
                if pid:
                    self.process.returncode = os.waitstatus_to_exitcode(status)
                    return self.process.returncode, usage
                if must_end():
                    self.end()
                time.sleep(PAUSE)
        finally:
            for number, handler in self.earlier.items():
                signal.signal(number, handler)
