# SPDX-License-Identifier: GPL-2.0-or-later
"""Grids of compute field by brute force: weights of points in every cell and image, shares of lines, neighbours of
cells. oracle/field.py says what is read how."""
from dataclasses import dataclass
import itertools
import math

import numpy as np

AXES = "xyz"


@dataclass(frozen=True)
class Grid:
    """`cells` along the three axes; `bounds` of each axis or None; `periodic` of the box. about: (axis, c1, c2), then
    cells are (rings, 1, along the axis), and `ring` are the bounds of r."""

    cells: tuple
    frame: str = "box"
    bounds: tuple = (None, None, None)
    kernel: str = "cell"
    width: float = 0.0
    periodic: tuple = (True, True, True)
    about: tuple = ()
    ring: tuple = ()
    dimension: int = 3

    @property
    def number(self):
        return int(np.prod(self.cells))

    @property
    def resolved(self):
        return [k for k in range(3) if self.cells[k] > 1]

    def in_box(self, box):
        return (Rings if self.about else Placed)(self, box)


class Placed:
    """A grid of parallelepipeds in a box."""

    def __init__(self, grid, box):
        self.grid, self.box = grid, box
        edges = box.edges.copy()
        if grid.dimension == 2:
            edges[2, 2] = 1.0
        self.lattice = box.edges
        axes, low, high = edges, np.zeros(3), np.ones(3)
        if grid.frame == "lab":
            axes, low = np.eye(3), box.origin.copy()
            high = low + np.diag(edges)
        for k, bound in enumerate(grid.bounds):
            if bound is not None:
                low[k], high[k] = bound
        self.low, self.high = low, high
        self.corner = (box.origin if grid.frame == "box" else np.zeros(3)) + axes @ low
        self.spans = axes * (high - low)  # edges of the whole grid, in columns
        self.volume = abs(np.linalg.det(self.spans)) / grid.number
        self.open = [not grid.periodic[k] and grid.bounds[k] is None for k in range(3)]
        self.frame_of = None

    # where things are

    def units(self, x):
        """In cells along each axis."""
        return np.linalg.solve(self.spans, (x - self.corner).T).T * self.grid.cells

    def middles(self):
        index = np.array([(i, j, k) for k, j, i in np.ndindex(*self.grid.cells[::-1])])
        return self.corner + ((index + 0.5) / self.grid.cells) @ self.spans.T

    def volumes(self):
        return np.full(self.grid.number, self.volume)

    def corners(self):
        return self.corner + np.array(list(itertools.product((0, 1), repeat=3))) @ self.spans.T

    def shifts(self, x):
        """All images that may reach the grid, in edges of the box."""
        reach = 3.0 * self.grid.width
        inverse = np.linalg.inv(self.lattice)
        room = reach * np.linalg.norm(inverse, axis=1) + 1e-9
        mine, theirs = self.corners() @ inverse.T, x @ inverse.T
        if not len(x):
            return []
        first = np.floor(mine.min(axis=0) - theirs.max(axis=0) - room)
        last = np.ceil(mine.max(axis=0) - theirs.min(axis=0) + room)
        sides = [range(int(first[k]), int(last[k]) + 1) if self.grid.periodic[k] else (0,) for k in range(3)]
        return [np.array(s) for s in itertools.product(*sides)]

    def between(self, axis):
        """Faces of the cells of an axis, in cells."""
        n = self.grid.cells[axis]
        low, high = np.arange(n, dtype=float), np.arange(1, n + 1, dtype=float)
        if self.open[axis]:
            low[0], high[-1] = -np.inf, np.inf
        return low, high

    @staticmethod
    def outer(parts):
        """points x cells, x fastest, of what is given along each axis (points x n)."""
        x, y, z = parts
        return (z[:, :, None, None] * y[:, None, :, None] * x[:, None, None, :]).reshape(len(x), -1)

    def inside(self, u, axis):
        low, high = self.between(axis)
        return ((u[:, axis, None] >= low) & (u[:, axis, None] < high)).astype(float)

    # weights

    def across(self):
        """Projection at right angles to the edges of axes with one cell."""
        alone = [k for k in range(3) if k not in self.grid.resolved]
        if not alone:
            return np.eye(3)
        q, _ = np.linalg.qr(self.spans[:, alone])
        return np.eye(3) - q @ q.T

    def kernel(self, r):
        """phi, normalised in as many dimensions as axes are resolved."""
        d, w = len(self.grid.resolved), self.grid.width
        h = 3.0 * w
        if self.grid.kernel == "lucy":
            factor = {1: 5.0 / (4.0 * h), 2: 5.0 / (math.pi * h**2), 3: 105.0 / (16.0 * math.pi * h**3)}[d]
            q = np.minimum(r / h, 1.0)
            return factor * (1.0 + 3.0 * q) * (1.0 - q) ** 3
        erf, tail = math.erf(3.0 / math.sqrt(2.0)), math.exp(-4.5)
        whole = {
            1: math.sqrt(2.0 * math.pi) * w * erf,
            2: 2.0 * math.pi * w**2 * (1.0 - tail),
            3: 4.0 * math.pi * w**3 * (math.sqrt(0.5 * math.pi) * erf - 3.0 * tail),
        }[d]
        return np.where(r < h, np.exp(-0.5 * (r / w) ** 2), 0.0) / whole

    def measure(self):
        """Of a cell in the resolved axes."""
        across = self.across() @ (self.spans / self.grid.cells)[:, self.grid.resolved]
        return math.sqrt(np.linalg.det(across.T @ across))

    def weights(self, x):
        """points x cells, of points where they are."""
        u = self.units(x)
        if self.grid.kernel == "cell":
            return self.outer([self.inside(u, k) for k in range(3)])
        found = np.zeros((len(x), self.grid.number))
        alone = [k for k in range(3) if k not in self.grid.resolved]
        here = np.flatnonzero(np.prod([self.inside(u, k)[:, 0] for k in alone], axis=0) * np.ones(len(x)) > 0)
        if len(here):
            across = self.across()
            apart = (x[here] @ across.T)[:, None, :] - (self.middles() @ across.T)[None, :, :]
            found[here] = self.kernel(np.linalg.norm(apart, axis=2)) * self.measure()
        return found

    def entries(self, x):
        """(point, shift, cell, weight, position of that image) of all weights that are not 0."""
        found = []
        for shift in self.shifts(x):
            moved = x + self.lattice @ shift
            weights = self.weights(moved)
            point, cell = np.nonzero(weights)
            if len(point):
                found.append((point, np.tile(shift, (len(point), 1)), cell, weights[point, cell], moved[point]))
        if not found:
            return np.zeros(0, int), np.zeros((0, 3), int), np.zeros(0, int), np.zeros(0), np.zeros((0, 3))
        return tuple(np.concatenate(parts) for parts in zip(*found))

    # branches

    def clipped(self, start, end):
        """contacts x cells: share of each line in each cell."""
        u, v = self.units(start), self.units(end)
        first, last = np.zeros((len(u), self.grid.number)), np.ones((len(u), self.grid.number))
        for axis in range(3):
            low, high = self.between(axis)
            a, slope = u[:, axis, None], (v - u)[:, axis, None]
            with np.errstate(divide="ignore", invalid="ignore"):
                one, other = (low - a) / slope, (high - a) / slope
            within = (a >= low) & (a < high)
            enters = np.where(slope == 0.0, np.where(within, -np.inf, np.inf), np.minimum(one, other))
            leaves = np.where(slope == 0.0, np.where(within, np.inf, -np.inf), np.maximum(one, other))
            stretch = [np.ones((len(u), n)) for n in self.grid.cells]
            for bound, fold in ((enters, "first"), (leaves, "last")):
                sides = list(stretch)
                sides[axis] = bound
                whole = self.outer(sides)
                if fold == "first":
                    first = np.maximum(first, whole)
                else:
                    last = np.minimum(last, whole)
        return np.maximum(last - first, 0.0)

    def integrated(self, start, end, points):
        """contacts x cells: means of the weights along each line, by Gauss-Legendre quadrature."""
        nodes, weights = np.polynomial.legendre.leggauss(points)
        found = np.zeros((len(start), self.grid.number))
        for node, weight in zip(0.5 * (nodes + 1.0), 0.5 * weights):
            found += weight * self.weights(start + node * (end - start))
        return found

    def near(self, start, end):
        """Lines that may reach the grid."""
        u = np.stack([self.units(start), self.units(end)])
        reach = 3.0 * self.grid.width * np.linalg.norm(np.linalg.inv(self.spans), axis=1) * self.grid.cells + 1e-9
        low = np.where(self.open, -np.inf, -reach)
        high = np.where(self.open, np.inf, np.array(self.grid.cells) + reach)
        return np.flatnonzero(((u.max(axis=0) >= low) & (u.min(axis=0) <= high)).all(axis=1))

    def shares(self, start, end, points=200, sampled=0):
        """contacts x cells. `sampled`: by so many points of each line, with an error of one share of a point."""
        found = np.zeros((len(start), self.grid.number))
        for shift in self.shifts(np.concatenate([start, end])):
            a, b = start + self.lattice @ shift, end + self.lattice @ shift
            here = self.near(a, b)
            if not len(here):
                continue
            if sampled:
                at = ((np.arange(sampled) + 0.5) / sampled)[:, None]
                found[here] += [self.weights(a[k] + at * (b[k] - a[k])).mean(axis=0) for k in here]
            elif self.grid.kernel == "cell":
                found[here] += self.clipped(a[here], b[here])
            else:
                found[here] += self.integrated(a[here], b[here], points)
        return found

    def dyads(self, start, end, vectors, points=200, sampled=0):
        """cells x 3 x 3 for each of the vectors (contacts x 3): sum of vector_a (end - start)_b share."""
        shares = self.shares(start, end, points, sampled)
        return [np.einsum("ck,ca,cb->kab", shares, f, end - start) for f in vectors]

    # components

    def turned(self, vectors, at):
        """Components in the frame of the grid at these places."""
        return vectors

    def turned_tensors(self, tensors, at):
        return tensors

    # temperature

    def coordinates(self, x):
        """What velocities are fitted against."""
        return x @ self.across().T

    def neighbours(self, cell):
        """(cell, shift in edges of the box) of all up to one step away along each axis with more than one cell, over
        corners too, itself among them."""
        n = np.array(self.grid.cells)
        at = np.array([cell % n[0], cell // n[0] % n[1], cell // (n[0] * n[1])])
        for step in itertools.product(*((-1, 0, 1) if n[k] > 1 else (0,) for k in range(3))):
            over = (at + step) // n
            if all(self.spans_box(k) or not over[k] for k in range(3)):
                x, y, z = (at + step) % n
                yield x + n[0] * (y + n[1] * z), over.astype(float)

    def spans_box(self, axis):
        """Cells of the laboratory are not neighbours across a face whose edge is tilted: their images lie askew."""
        whole = 1.0 if self.grid.frame == "box" else self.box.edges[axis, axis]
        if self.grid.frame == "lab" and np.count_nonzero(self.box.edges[:, axis]) > 1:
            return False
        return self.grid.periodic[axis] and abs(self.high[axis] - self.low[axis] - whole) < 1e-9 * whole

    def moved(self, centroid, shift):
        return centroid + self.across() @ self.lattice @ shift

    def gradients(self, mass, velocity, centroid):
        """G_k of every cell, 3 x 3."""
        found = np.zeros((self.grid.number, 3, centroid.shape[1]))
        for cell in range(self.grid.number):
            near = [(k, shift) for k, shift in self.neighbours(cell) if mass[k] > 0.0]
            if len(near) < 2 or mass[cell] <= 0.0:
                continue
            root = np.sqrt([mass[k] for k, _ in near])[:, None]
            c = np.array([self.moved(centroid[k], shift) for k, shift in near])
            v = np.array([velocity[k] + self.box.rate @ shift for k, shift in near])
            share = root**2 / (root**2).sum()
            c, v = c - (share * c).sum(axis=0), v - (share * v).sum(axis=0)
            found[cell] = np.linalg.lstsq(root * c, root * v, rcond=1e-10)[0].T
        return found


class Rings(Placed):
    """Rings about an axis of the laboratory: components r, t, a."""

    def __init__(self, grid, box):
        self.grid, self.box, self.lattice = grid, box, box.edges
        name, *self.centre = grid.about
        self.axis = AXES.index(name)
        self.others = [k for k in range(3) if k != self.axis]
        bound = grid.bounds[self.axis]
        low, high = bound or (box.origin[self.axis], box.origin[self.axis] + box.edges[self.axis, self.axis])
        self.open = [False, False, not grid.periodic[self.axis] and bound is None]
        self.along = np.linspace(low, high, grid.cells[2] + 1)
        self.radii = np.linspace(*grid.ring, grid.cells[0] + 1)
        self.low, self.high = np.array([0, 0, low]), np.array([0, 0, high])

    def units(self, x):
        r = np.hypot(x[:, self.others[0]] - self.centre[0], x[:, self.others[1]] - self.centre[1])
        inner, outer = self.radii[0], self.radii[-1]
        a = (x[:, self.axis] - self.along[0]) / (self.along[-1] - self.along[0]) * self.grid.cells[2]
        return np.stack([(r - inner) / (outer - inner) * self.grid.cells[0], np.full(len(x), 0.5), a], axis=1)

    def middles(self):
        r, a = (0.5 * (edges[1:] + edges[:-1]) for edges in (self.radii, self.along))
        return np.array([(one, 0.0, other) for other in a for one in r])

    def volumes(self):
        area = math.pi * np.diff(self.radii**2)
        return (np.diff(self.along)[:, None] * area[None, :]).ravel()

    def corners(self):
        found = np.zeros((8, 3))
        reach = self.radii[-1]
        for k, signs in enumerate(itertools.product((-1, 1), repeat=3)):
            found[k, self.others] = np.array(self.centre) + reach * np.array(signs[:2])
            found[k, self.axis] = self.along[0] if signs[2] < 0 else self.along[-1]
        return found

    def near(self, start, end):
        return np.arange(len(start))

    def frame_at(self, x):
        """points x 3 x 3: rows r, t, a. t = a x r."""
        r = np.zeros_like(x)
        r[:, self.others] = x[:, self.others] - self.centre
        r /= np.maximum(np.linalg.norm(r, axis=1), 1e-300)[:, None]
        a = np.tile(np.eye(3)[self.axis], (len(x), 1))
        return np.stack([r, np.cross(a, r), a], axis=1)

    def turned(self, vectors, at):
        return np.einsum("iab,ib->ia", self.frame_at(at), vectors)

    def turned_tensors(self, tensors, at):
        frame = self.frame_at(at)
        return np.einsum("iab,ibc,idc->iad", frame, tensors, frame)

    def in_disc(self, start, end, radius):
        """First and last share of each line nearer to the axis than this."""
        a = start[:, self.others] - self.centre
        d = (end - start)[:, self.others]
        aa, bb, cc = (d * d).sum(1), (a * d).sum(1), (a * a).sum(1) - radius**2
        root = np.sqrt(np.maximum(bb * bb - aa * cc, 0.0))
        with np.errstate(divide="ignore", invalid="ignore"):
            first, last = (-bb - root) / aa, (-bb + root) / aa
        none = (bb * bb <= aa * cc) & (aa > 0.0)
        still = aa == 0.0
        first = np.where(still, np.where(cc < 0.0, 0.0, 1.0), np.where(none, 1.0, first))
        last = np.where(still, np.where(cc < 0.0, 1.0, 0.0), np.where(none, 0.0, last))
        first, last = np.clip(first, 0.0, 1.0), np.clip(last, 0.0, 1.0)
        # a line without a part in the disc has all of itself before it
        none = last <= first
        return np.where(none, 1.0, first), np.where(none, 1.0, last)

    def pieces(self, start, end):
        """(contact, cell, first, last) of all pieces of lines, images included."""
        low, high = self.between(2)
        for shift in self.shifts(np.concatenate([start, end])):
            a, b = start + self.lattice @ shift, end + self.lattice @ shift
            u, v = self.units(a)[:, 2], self.units(b)[:, 2]
            discs = [self.in_disc(a, b, radius) for radius in self.radii]
            for k in range(self.grid.cells[2]):
                slope = v - u
                with np.errstate(divide="ignore", invalid="ignore"):
                    one, other = (low[k] - u) / slope, (high[k] - u) / slope
                within = (u >= low[k]) & (u < high[k])
                enters = np.where(slope == 0.0, np.where(within, 0.0, 1.0), np.minimum(one, other))
                leaves = np.where(slope == 0.0, np.where(within, 1.0, 0.0), np.maximum(one, other))
                for ring in range(self.grid.cells[0]):
                    (hole, end_of_hole), (begin, finish) = discs[ring], discs[ring + 1]
                    # before the hole and after it; one piece where there is no hole
                    for first, last in ((begin, np.minimum(hole, finish)), (np.maximum(end_of_hole, begin), finish)):
                        first, last = np.maximum(first, enters), np.minimum(last, leaves)
                        here = np.flatnonzero(last > first)
                        cell = ring + self.grid.cells[0] * k
                        yield here, cell, first[here], last[here], a[here], b[here]

    def dyads(self, start, end, vectors, points=200, sampled=0):
        found = [np.zeros((self.grid.number, 3, 3)) for _ in vectors]
        if sampled:
            raise ValueError("rings take the components of a piece at its middle, which samples do not know")
        for here, cell, first, last, a, b in self.pieces(start, end):
            middle = a + (0.5 * (first + last))[:, None] * (b - a)
            branch = self.turned(b - a, middle)
            for total, f in zip(found, vectors):
                total[cell] += np.einsum("c,ca,cb->ab", last - first, self.turned(f[here], middle), branch)
        return found

    def shares(self, start, end, points=200, sampled=0):
        if sampled:
            return super().shares(start, end, points, sampled)
        found = np.zeros((len(start), self.grid.number))
        for here, cell, first, last, _, _ in self.pieces(start, end):
            np.add.at(found, (here, cell), last - first)
        return found

    def coordinates(self, x):
        r = np.hypot(x[:, self.others[0]] - self.centre[0], x[:, self.others[1]] - self.centre[1])
        both = np.stack([r, x[:, self.axis]], axis=1)
        return both * np.array([self.grid.cells[0] > 1, self.grid.cells[2] > 1])

    def spans_box(self, axis):
        length = self.box.edges[self.axis, self.axis]
        own = self.along[-1] - self.along[0]
        return axis == 2 and self.grid.periodic[self.axis] and abs(own - length) < 1e-9 * length

    def moved(self, centroid, shift):
        return centroid + np.array([0.0, shift[2] * self.box.edges[self.axis, self.axis]])
