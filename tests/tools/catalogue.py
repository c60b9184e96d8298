# SPDX-License-Identifier: GPL-2.0-or-later
"""Every compute of fabric, surface, direction, fluctuation and correlation, ready to be watched all at once."""
from run import FFTW
from watch import Watched

FABRIC = Watched("fabric", "fabric branch force/normal force/tangential", True, 40)
DIRECTION = Watched("direction", "contact/direction bins 12", array=(12, 9))
SURFACE = Watched("surface", "contact/surface", vector=3, array=(10, 17))
FLUCTUATION = Watched("moving", "fluctuation layers 4", True, 14, (4, 5))
LAYERING = Watched("layers", "layering layers 10", True, 4, (6, 2))
DIRECT = Watched("direct", "velocity/correlation bins 6", True, 5, (6, 4))
MESH = Watched("mesh", "velocity/correlation bins 6 method mesh range 4.037", True, 5, (6, 4))
DISPLACEMENT = Watched("moved", "displacement/shear strain v_strain", True, 8)
MEMORY = Watched("memory", "velocity/memory strain v_strain every 1e-4 lags 3", True, 3, (4, 4))
GRAIN = Watched("grain", "contact/grain", peratom=7)

# Entries of a vector that have one unit, and so one scale.
BLOCKS = {
    "fabric": (21, 1, 18),
    "surface": (1, 1, 1),
    "moving": (3, 3, 2, 1, 1, 2, 2),
    "layers": (1, 1, 1, 1),
    "direct": (2, 1, 1, 1),
    "mesh": (2, 1, 1, 1),
    "moved": (1, 3, 3, 1),
    "memory": (2, 1),
}


def everything(packing):
    surface = [SURFACE] if packing.atom_style == "superquadric" else []
    mesh = [MESH] if FFTW else []
    return [FABRIC, DIRECTION, *surface, FLUCTUATION, LAYERING, DIRECT, *mesh, DISPLACEMENT, MEMORY, GRAIN]


def strain_lines(rate):
    """The variable that displacement and memory ask for."""
    return [f"variable strain equal step*dt*{rate!r}"]
