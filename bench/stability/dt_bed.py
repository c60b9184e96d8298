#!/usr/bin/python3
"""Whether walls limit the time step of a bed: doc/stability_time_step.md.

Grains at rest in a box with a floor and four side walls, these of the grains' material or 200 times stiffer. By the
linear theory on the network of all contacts: the limit of the time step, with and without the contacts with walls, and
these contacts' share in the mode that reaches it. Rows that are in the csv file are not made again.
"""
import argparse
import math
import pathlib

import numpy as np

from dt_network import Network
from dt_tools import YOUNG, Runner, Table, rayleigh_time

ALPHAS, STIFFER = (0.33, 1.0, 3.0), 200
LAWS = tuple((e, damping) for damping in ("off", "on") for e in ("0.1", "0.5", "0.99"))


class Bed(Network):
    """A network some of whose contacts are with walls, which do not move; or without these."""

    def __init__(self, stem, alpha, walls=True):
        super().__init__(stem, alpha)
        self.walls = self.j < 0
        self.to_j[self.walls] = 0.0
        self.largest = [self.overlap[kind].max() / (2 * alpha ** (1 / 3)) for kind in (~self.walls, self.walls)]
        if not walls:
            for name in ("i", "j", "normal", "overlap", "stiffness", "to_i", "to_j", "walls"):
                setattr(self, name, getattr(self, name)[~self.walls])

    def laws(self, e, tangential_damping):
        """The effective mass at a wall is the grain's own."""
        stiffness, damping = super().laws(e, tangential_damping)
        return stiffness, damping * np.where(self.walls, math.sqrt(2), 1.0)[:, None, None]

    def share_of_walls(self, stiffness, damping, dt):
        law = dt**2 * stiffness + 2 * dt * damping
        q = self.stiffest(law)
        moves = np.einsum("cab,cb->ca", self.to_i, q[self.i]) - np.einsum("cab,cb->ca", self.to_j, q[self.j])
        parts = np.einsum("ca,cab,cb->c", moves, law, moves)
        return parts[self.walls].sum() / parts.sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("dt_map.work"), help="scratch folder")
    arguments = parser.parse_args()
    runner = Runner(arguments.binary, arguments.work)
    results = (
        "all",
        "grains_only",
        "share_of_walls",
        "largest_between_grains",
        "largest_at_walls",
        "contacts",
        "walls",
    )
    table = Table("dt_bed", 4, ("alpha", "wall", "e", "damping", *results))
    for alpha, wall in ((a, w) for a in ALPHAS for w in ("alike", "stiff")):
        missing = [law for law in LAWS if not table.has(f"{alpha:g}", wall, *law)]
        if not missing:
            continue
        stem = runner.work / f"bed-{alpha:g}-{wall}"
        if not stem.with_name(stem.name + ".grains").exists():
            young = YOUNG * (STIFFER if wall == "stiff" else 1)
            output = runner.output("in.dt_bed", alpha=f"{alpha:g}", young=young, out=stem)
            if "ERROR" in output:
                raise SystemExit(output[-2000:])
        bed, inside, unit = Bed(stem, alpha), Bed(stem, alpha, walls=False), rayleigh_time(alpha)
        for e, damping in missing:
            laws = bed.laws(float(e), damping == "on")
            dt = bed.limit(*laws)
            without = inside.limit(*inside.laws(float(e), damping == "on"))
            table.add(
                *(f"{alpha:g}", wall, e, damping, dt / unit, without / unit, bed.share_of_walls(*laws, dt)),
                *(*bed.largest, len(bed.i), bed.walls.sum()),
            )


if __name__ == "__main__":
    main()
