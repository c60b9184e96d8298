# SPDX-License-Identifier: GPL-2.0-or-later
"""The one deck builder: a packing and its material in, LIGGGHTS input lines out."""
from dataclasses import dataclass, field
import math

from packing import DENSITY, SKIN, Packing, number, numbers

YOUNG = 5e6
POISSON = 0.3


def rayleigh_time(smallest=1.0, young=YOUNG):
    shear_modulus = young / (2.0 * (1.0 + POISSON))
    return math.pi * smallest / (0.8766 + 0.163 * POISSON) * math.sqrt(DENSITY / shear_modulus)


@dataclass
class Material:
    """Per type, or per pair of types in row-major order."""

    young: tuple = (YOUNG,)
    restitution: tuple = (0.5,)
    friction: tuple = (0.4,)
    rolling: tuple = (0.1,)
    cohesion: tuple = (1e4,)
    poisson: tuple = (POISSON,)

    def lines(self, types):
        def pairs(values):
            values = values if len(values) == types * types else values * (types * types)
            return f"peratomtypepair {types} {numbers(values)}"

        def singles(values):
            values = values if len(values) == types else values * types
            return f"peratomtype {numbers(values)}"

        yield f"fix young all property/global youngsModulus {singles(self.young)}"
        yield f"fix poisson all property/global poissonsRatio {singles(self.poisson)}"
        yield f"fix restitution all property/global coefficientRestitution {pairs(self.restitution)}"
        yield f"fix friction all property/global coefficientFriction {pairs(self.friction)}"
        yield f"fix rolling all property/global coefficientRollingFriction {pairs(self.rolling)}"
        yield f"fix cohesion all property/global cohesionEnergyDensity {pairs(self.cohesion)}"
        yield "fix speed all property/global characteristicVelocity scalar 1.0"


@dataclass
class Deck:
    """`body` is what a test is about: lines after the set-up, with their own `run` commands."""

    packing: Packing
    body: list = field(default_factory=list)
    pair: str = "gran/insitu"
    normal: str = "hertz"
    tangential: str = "history"
    cohesion: str = "off"
    rolling: str = "off"
    extra: str = ""
    surface: str = "superquadric"  # of atom_style superquadric
    material: Material = field(default_factory=Material)
    timestep: float = 0.0
    contact_distance_factor: float = 1.05
    processors: str = ""
    boundary: str = "p p p"
    units: str = "si"

    def model(self):
        cohesion = "" if self.cohesion == "off" else f" cohesion {self.cohesion}"
        rolling = "" if self.rolling == "off" else f" rolling_friction {self.rolling}"
        surface = f" surface {self.surface}" if self.packing.atom_style == "superquadric" else ""
        extra = f" {self.extra}" if self.extra else ""
        return f"model {self.normal} tangential {self.tangential}{cohesion}{rolling}{surface}{extra}"

    def dt(self):
        return self.timestep or 0.1 * rayleigh_time(
            min(min(g.semi_axes) for g in self.packing.grains), max(self.material.young)
        )

    def header(self):
        if self.packing.dimension == 2:
            yield "dimension 2"
        yield from (
            "atom_style " + self.packing.atom_style,
            "atom_modify map array",
            "boundary " + self.boundary,
            "newton off",
            "communicate single vel yes",
            "units " + self.units,
        )
        if self.processors:
            yield "processors " + self.processors

    def physics(self):
        """What a deck also says after read_restart."""
        yield f"neighbor {number(SKIN)} bin"
        yield f"neigh_modify delay 0 contact_distance_factor {number(self.contact_distance_factor)}"
        yield from self.material.lines(self.packing.types)
        yield f"pair_style {self.pair} {self.model()}"
        yield "pair_coeff * *"
        yield f"timestep {number(self.dt())}"
        yield "fix integrate all nve/" + (
            "sphere" if self.packing.atom_style == "sphere" else "superquadric integration_scheme 1"
        )
        if self.packing.dimension == 2:
            yield "fix plane all enforce2d"
        yield "thermo_style custom step"
        yield "thermo_modify format float %.17g lost error norm no"

    def lines(self):
        yield from self.header()
        yield from self.packing.lines()
        yield from self.physics()
        yield from self.body

    def text(self):
        return "\n".join(self.lines()) + "\n"

    def restarted(self, file, body):
        """The deck that continues from a restart file."""
        lines = [*self.header(), f"read_restart {file}", *self.physics(), *body]
        return "\n".join(lines) + "\n"


GRAIN_COLUMNS = "id type x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz mass radius density"
SPHEROID_COLUMNS = GRAIN_COLUMNS + " shapex shapey shapez quat1 quat2 quat3 quat4"


def thermo(every, *quantities):
    """Thermo output of what is asked, always at %.17g."""
    return [
        f"thermo_style custom step {' '.join(quantities)}",
        "thermo_modify format float %.17g lost error norm no",
        f"thermo {every}",
    ]


def box_columns():
    return ("vol", "lx", "ly", "lz", "xy", "xz", "yz", "xlo", "ylo", "zlo")


def dump_grains(packing, every, name="grains", columns=None):
    columns = columns or (SPHEROID_COLUMNS if packing.atom_style == "superquadric" else GRAIN_COLUMNS)
    formats = " ".join("%d" if c in ("id", "type", "ix", "iy", "iz") else "%.17g" for c in columns.split())
    return [f"dump {name} all custom {every} {name}.dump {columns}", f'dump_modify {name} sort id format "{formats}"']


def dump_local(compute, width, every, name):
    columns = " ".join(f"c_{compute}[{k}]" for k in range(1, width + 1))
    formats = " ".join(["%.17g"] * width)
    return [f"dump {name} all local {every} {name}.dump {columns}", f'dump_modify {name} format "{formats}"']


def shear(rate):
    return f"fix shear all deform 1 xy erate {number(rate)} remap v"
