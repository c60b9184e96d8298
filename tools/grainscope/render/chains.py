# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts as force chains: a cylinder for each half of a contact, from a grain's centre half-way to the other's, as
thick as the normal force is large. Halves are short also where a contact reaches across a periodic boundary."""

from dataclasses import dataclass

import numpy as np

from grainscope.contact_columns import named, require_columns
from grainscope.errors import InputError

NEEDED = ("id_i", "id_j", "branch_x", "branch_y", "branch_z", "fn")
THICKEST = 0.5  # radius of the strongest contact's cylinder over the mean radius of the grains
THINNEST = 0.02  # of the weakest, over the strongest's
QUANTILE = 0.99  # of all normal forces, the strongest that is told apart


@dataclass
class Chains:
    """Half contacts: from a grain's centre to where it meets the other, with the normal force."""

    starts: np.ndarray
    ends: np.ndarray
    forces: np.ndarray

    def __len__(self):
        return len(self.forces)


def chains_of(contacts, keywords, drawn):
    """Of a snapshot of contacts those between grains that are drawn, and of these with walls. `keywords` are those of
    the compute contact/local."""
    columns = named(contacts, keywords)
    require_columns(contacts.path, columns, NEEDED, ("id", "branch", "fn"))
    drawn.snapshot.require("id")
    ids = drawn.snapshot["id"].astype(int)
    id_i, id_j = columns["id_i"].astype(int), columns["id_j"].astype(int)
    unknown = np.setdiff1d(np.concatenate([id_i, id_j[id_j != 0]]), ids)
    if len(unknown):
        raise InputError(
            f"{contacts.path}: step {contacts.step}: {drawn.snapshot.path} has no grain with the ID {unknown[0]}"
        )
    place = np.full(int(ids.max(initial=0)) + 1, -1)
    place[ids[drawn.rows]] = np.arange(len(drawn))
    at_wall = id_j == 0
    i, j = place[id_i], np.where(at_wall, 0, place[id_j])
    seen = (i >= 0) & (j >= 0)
    i, j, at_wall = i[seen], j[seen], at_wall[seen]
    branch = np.stack([columns[f"branch_{axis}"] for axis in "xyz"], axis=1)[seen]
    force = columns["fn"][seen]
    first, pair = drawn.positions[i], ~at_wall
    second = drawn.positions[j][pair]
    return Chains(
        np.concatenate([first, second]),
        np.concatenate([first - np.where(at_wall, 1.0, 0.5)[:, None] * branch, second + 0.5 * branch[pair]]),
        np.concatenate([force, force[pair]]),
    )


def strongest(forces):
    """The normal force that is drawn the thickest, of the magnitudes in all snapshots."""
    forces = np.concatenate(forces)
    return float(np.quantile(forces, QUANTILE)) if forces.size else 0.0


def radii(chains, high, grain):
    """Of the cylinders, in proportion to the force up to `high`; `grain` is the mean radius of the grains."""
    share = np.clip(np.abs(chains.forces) / high, THINNEST, 1.0)
    return THICKEST * grain * share
