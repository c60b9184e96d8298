"""What commands say on stderr."""

import sys


class InputError(Exception):
    """Input that is missing or is not what it should be; the message says which and why."""


def warn(text):
    print(f"grainscope-tools: {text}", file=sys.stderr, flush=True)
