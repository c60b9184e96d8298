# SPDX-License-Identifier: GPL-2.0-or-later
"""A ball on the neck of two others that are held fast, or on two points: the law of `model hertz tangential history`,
its motion by the classical Runge-Kutta method. Both contacts are mirror images of each other, so that one is enough."""
from dataclasses import dataclass
import math

POISSON = 0.3
DENSITY = 1000.0


@dataclass
class Neck:
    """Others of radius 1 that touch; with `points` two points, 2 apart, of a wall."""

    radius: float  # of the ball
    friction: float
    points: bool = False
    restitution: float = 0.5
    young: float = 5e6
    gravity: float = 1.25
    angle: float = 10.0  # where it is let go, in degrees from the top

    @property
    def others(self):
        return 0.0 if self.points else 1.0

    @property
    def rim(self):
        """Distance from the axis through the others' centres where it touches both."""
        return math.sqrt((self.radius + self.others) ** 2 - 1.0)

    def rayleigh_time(self):
        shear = self.young / (2.0 * (1.0 + POISSON))
        return math.pi * self.radius * math.sqrt(DENSITY / shear) / (0.163 * POISSON + 0.8766)

    def start(self):
        angle = math.radians(self.angle)
        return self.rim * math.sin(angle), self.rim * math.cos(angle)

    def _contact(self, y, z, vy, vz, spin):
        """None where there is none: normal from the other to the ball, its distance, lever, k_t, normal force, gamma_t,
        tangential velocity."""
        a, mass = self.radius, 4.0 / 3.0 * math.pi * self.radius**3 * DENSITY
        distance = math.sqrt(1.0 + y * y + z * z)
        overlap = a + self.others - distance
        if overlap <= 0.0:
            return None
        # effective mass and radius; a point is a wall
        m, radius = (mass, a) if self.points else (mass / (1.0 + a**3), a / (1.0 + a))
        log = math.log(self.restitution)
        damping = -2.0 * math.sqrt(5.0 / 6.0) * log / math.hypot(log, math.pi)
        young = self.young / (2.0 * (1.0 - POISSON**2))
        shear = self.young / (4.0 * (2.0 - POISSON) * (1.0 + POISSON))
        root = math.sqrt(radius * overlap)
        k_t = 8.0 * shear * root
        nx, ny, nz = 1.0 / distance, y / distance, z / distance
        vn = vy * ny + vz * nz
        force = 4.0 / 3.0 * young * root * overlap - damping * math.sqrt(2.0 * young * root * m) * vn
        lever = a - 0.5 * overlap
        u = (-vn * nx, vy - vn * ny + lever * spin * nz, vz - vn * nz - lever * spin * ny)
        return (nx, ny, nz), distance, lever, k_t, force, damping * math.sqrt(k_t * m), u

    def _rate(self, state, slides):
        y, z, vy, vz, spin, *spring = state
        contact = self._contact(y, z, vy, vz, spin)
        if contact is None:
            return (vy, vz, 0.0, -self.gravity, 0.0, 0.0, 0.0, 0.0)
        n, distance, lever, k_t, force, gamma_t, u = contact
        vn = vy * n[1] + vz * n[2]
        if slides:
            by = self.friction * abs(force) / math.sqrt(sum(s * s for s in spring))
            f = [-by * s for s in spring]
        else:
            f = [-k_t * s - gamma_t * v for s, v in zip(spring, u)]
        mass = 4.0 / 3.0 * math.pi * self.radius**3 * DENSITY
        turning = (-vn * n[0], vy - vn * n[1], vz - vn * n[2])  # distance x the rate of n
        along = sum(s * t for s, t in zip(spring, turning)) / distance  # the spring stays across n
        return (
            vy,
            vz,
            2.0 * (force * n[1] + f[1]) / mass,
            2.0 * (force * n[2] + f[2]) / mass - self.gravity,
            -2.0 * lever * (n[1] * f[2] - n[2] * f[1]) / (0.4 * mass * self.radius**2),
            *(v - along * k for v, k in zip(u, n)),
        )

    def leaves_at(self, steps):
        """The angle of the last step with contact, in degrees, and its number; so many steps in a Rayleigh time.
        Friction is cut after each."""
        dt, taken = self.rayleigh_time() / steps, 0
        state = [*self.start(), *([0.0] * 6)]
        slides, last = False, (0.0, 0)
        while state[1] > -self.rim:
            k1 = self._rate(state, slides)
            k2 = self._rate([x + 0.5 * dt * k for x, k in zip(state, k1)], slides)
            k3 = self._rate([x + 0.5 * dt * k for x, k in zip(state, k2)], slides)
            k4 = self._rate([x + dt * k for x, k in zip(state, k3)], slides)
            state = [x + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d) for x, a, b, c, d in zip(state, k1, k2, k3, k4)]
            contact, taken, slides = self._contact(*state[:5]), taken + 1, False
            if contact is None:
                state[5:] = 0.0, 0.0, 0.0
                if math.hypot(*state[:2]) > 1.02 * self.rim:
                    break
                continue
            last = math.degrees(math.atan2(state[0], state[1])), taken
            n, _, _, k_t, force, *_ = contact
            along = sum(s * k for s, k in zip(state[5:], n))
            spring = [s - along * k for s, k in zip(state[5:], n)]
            length, limit = math.sqrt(sum(s * s for s in spring)), self.friction * abs(force) / k_t
            slides = length > limit
            state[5:] = [s * limit / length for s in spring] if slides else spring
        return last
