"""When a run that has only so much time must end: at the end of the last part that fits into it."""

import time

MARGIN = 1.25  # the next part may take longer than the last one by this factor


class PartClock:
    """Measures the parts of a run by the moments at which it writes restart files. With `seconds` None there is no
    end."""

    def __init__(self, seconds, clock=time.monotonic):
        self.clock = clock
        self.part_began = clock()
        self.deadline = None if seconds is None else self.part_began + seconds
        self.newest = None
        self.ended = False

    def must_end(self, newest):
        """Asked again and again with a sign of the newest restart file: whether the time is over, or a part has ended
        and the next one would not end in time."""
        if self.deadline is None or self.ended:
            return self.ended
        now = self.clock()
        if self.newest is None:  # the files that an earlier attempt left
            self.newest = newest
        if newest != self.newest:
            last, self.part_began, self.newest = now - self.part_began, now, newest
            self.ended = now + MARGIN * last > self.deadline
        self.ended = self.ended or now >= self.deadline
        return self.ended
