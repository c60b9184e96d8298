"""Steady means of a run of examples/simple_shear with `measure all`, in the units and normalisations of the paper. Used by the figures
and the summary."""
from functools import cached_property

import numpy as np

from shear_output import Columns, InputError, mean_and_error, read_blocks, read_table

FILES = ["micro.txt", "displacement.txt", "surface.txt", "direction.txt", "correlation.txt", "layering.txt", "memory.txt"]


def fit_decay(distance, correlation):
    """Length l of exp(-x/l) and its standard error, least squares over the points above 0.05."""
    above = correlation > 0.05
    x, c = distance[above], correlation[above]
    if len(x) == 0:
        return 0.0, 0.0
    lengths = np.geomspace(0.01 * x.max(), 100 * x.max(), 400)
    for _ in range(4):
        misfits = ((np.exp(-x / lengths[:, None]) - c) ** 2).sum(axis=1)
        best = misfits.argmin()
        lengths = np.linspace(lengths[max(best - 1, 0)], lengths[min(best + 1, len(lengths) - 1)], 101)
    length = lengths[50]
    slope = np.exp(-x / length) * x / length**2
    error = np.sqrt(misfits.min() / (len(x) - 1) / (slope**2).sum()) if len(x) > 1 else 0.0
    return length, error


def printed_shares(alpha, bins):
    """Shares of the surface in `bins` equal bins of psi by the area element that the paper prints, a sin(psi) sqrt(a^2 cos^2 + c^2 sin^2).
    It is that of the parametric angle; psi is the polar angle, so for alpha other than 1 these are not the areas of the bins."""
    psi = (np.arange(200 * bins) + 0.5) * np.pi / (400 * bins)
    element = np.sin(psi) * np.sqrt(np.cos(psi) ** 2 + (alpha * np.sin(psi)) ** 2)
    return element.reshape(bins, -1).sum(axis=1) / element.sum()


class Measures:
    """The steady state of one run. Pairs are (mean, standard error); blocks that begin before strain `start` are left out."""

    def __init__(self, run, start=None):
        self.run, self.name, self.start = run, run.name, start
        self.alpha, self.mu, self.I = (run.parameters[name] for name in ("alpha", "mu", "I"))
        self.diameter, self.rate, self.target = (run.parameters[name] for name in ("d_eq", "rate", "P_target"))
        missing = [name for name in FILES if not (run.folder / name).exists()]
        if missing:
            raise InputError(f"{run.folder}: no {', '.join(missing)}; an ended run with `-var measure all` writes them")
        self.micro = self.read_micro()

    def read_micro(self):
        micro, _ = read_table(self.run.folder / "micro.txt")
        ends = micro["strain"]
        begins = ends - (np.diff(ends).mean() if len(ends) > 1 else ends[-1] / 16)
        self.kept = np.ones(len(ends), dtype=bool) if self.start is None else begins > self.start - 1e-3
        if not self.kept.any():
            raise InputError(f"{self.run.folder}: no block of micro.txt begins after strain {self.start:g}; "
                             f"the last one begins at {begins[-1]:.2f}")
        return Columns(micro.path, ((name, values[self.kept]) for name, values in micro.items()))

    def blocks(self, name):
        """Columns of a file of tables, one table per block, as arrays (blocks, rows)."""
        columns = read_blocks(self.run.folder / name)
        if len(columns["bin"]) != len(self.kept):
            raise InputError(f"{self.run.folder}: {name} has {len(columns['bin'])} tables, micro.txt {len(self.kept)} rows; "
                             "they must be of one run")
        return Columns(columns.path, ((column, values[self.kept]) for column, values in columns.items()))

    @property
    def r_g(self):
        return (self.alpha - 1) / (self.alpha + 1)

    @cached_property
    def rows(self):
        return self.run.steady(self.start)

    def series(self, name):
        """Mean and error of a column of series.txt."""
        return mean_and_error(self.run[name][self.rows])

    @property
    def pressure(self):
        """P of every block [Pa]."""
        return -(self.micro["n_yy"] + self.micro["t_yy"])

    @property
    def inertial(self):
        """The inertial number that the mean pressure makes."""
        return self.I / np.sqrt(self.pressure.mean() / self.target)

    @property
    def power_normal(self):
        return self.series("W_n")

    @property
    def power_friction(self):
        return self.series("W_t")

    @property
    def flow_over_gradient(self):
        return mean_and_error(self.micro["dv_x"] / self.micro["dv_y"])

    @property
    def flow_over_vorticity(self):
        return mean_and_error(self.micro["dv_x"] / self.micro["dv_z"])

    @property
    def rotational_over_translational(self):
        return mean_and_error(self.micro["E_rot"] / self.micro["E_tr"])

    @property
    def lever(self):
        """|dv| over rate x diameter."""
        return mean_and_error(self.micro["lever"])

    @property
    def spin_fluctuation(self):
        """|dw| over the rate."""
        return mean_and_error(np.sqrt(sum(self.micro[f"dw_{axis}"] ** 2 for axis in "xyz")) / self.rate)

    def stress(self, part, component):
        """A component of a part (n or t) of the contact stress over P."""
        return mean_and_error(self.micro[f"{part}_{component}"] / self.pressure)

    def stress_difference(self, first, second):
        """(sigma_first - sigma_second)/P."""
        total = {c: self.micro[f"n_{c}"] + self.micro[f"t_{c}"] for c in (first, second)}
        return mean_and_error((total[first] - total[second]) / self.pressure)

    @property
    def N1(self):
        return self.stress_difference("xx", "yy")

    @property
    def N2(self):
        return self.stress_difference("yy", "zz")

    @property
    def idle(self):
        """Grains with fewer than two contacts, in percent."""
        return mean_and_error(100 * self.micro["idle"])

    def correlation(self, component="vy"):
        """r [m] and C(r) of vy or wz: ratio of sums over the steady state. Bins without pairs are left out."""
        table = self.blocks("correlation.txt")
        pairs, sums = table["pairs"].sum(axis=0), table[component].sum(axis=0)
        filled = pairs > 0
        return table["r"].mean(axis=0)[filled], sums[filled] / pairs[filled] / self.micro[f"{component}2"].mean()

    def correlation_length(self, component="vy"):
        """l [m] of exp(-r/l), and its error: that of the fit, or from the spread over the blocks if that is larger."""
        length, error = fit_decay(*self.correlation(component))
        table = self.blocks("correlation.txt")
        single = []
        for r, sums, pairs, square in zip(table["r"], table[component], table["pairs"], self.micro[f"{component}2"]):
            filled = pairs > 0
            single.append(fit_decay(r[filled], sums[filled] / pairs[filled] / square)[0])
        return length, max(error, mean_and_error(single)[1])

    def memory(self):
        """Strain and C of the correlation of a grain's dv_y with itself."""
        table = read_blocks(self.run.folder / "memory.txt")
        filled = table["pairs"][-1] > 0
        return table["lag"][-1][filled], table["C"][-1][filled]

    def layering(self):
        """Lag [m] and C over C(0) of the density of centres."""
        table = self.blocks("layering.txt")
        density = table["C"].mean(axis=0)
        return table["lag"].mean(axis=0), density / density[0]

    def fabric(self):
        """Mean fabric tensor (3, 3)."""
        xx, yy, zz, xy, xz, yz = (self.micro[f"F_{c}"].mean() for c in "xx yy zz xy xz yz".split())
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    @property
    def fabric_deviator(self):
        """sqrt(3/2 F':F') of the mean tensor, its error from the blocks."""
        diagonal = sum((self.micro[f"F_{c}"] - 1 / 3) ** 2 for c in ("xx", "yy", "zz"))
        blocks = np.sqrt(1.5 * (diagonal + 2 * sum(self.micro[f"F_{c}"] ** 2 for c in ("xy", "xz", "yz"))))
        deviator = self.fabric() - np.eye(3) / 3
        return np.sqrt(1.5 * (deviator**2).sum()), mean_and_error(blocks)[1]

    def fabric_axes(self):
        """The two eigenvalues whose axes lie in the xy plane, the larger first, and these axes (x, y), pointing to x > 0."""
        values, vectors = np.linalg.eigh(self.fabric())
        in_plane = np.argsort(np.abs(vectors[2]))[:2]
        order = in_plane[np.argsort(-values[in_plane])]
        axes = vectors[:2, order].T
        return values[order], axes * np.where(axes[:, :1] < 0, -1, 1)

    def surface(self):
        """Contacts on the grain by psi, each column one array over the bins: ratios of sums over all contacts of the steady state.
        Densities are over the exact areas; the `printed` ones over those of printed_shares."""
        table = self.blocks("surface.txt")
        contacts, area = table["contacts"].sum(axis=0), table["A"].mean(axis=0)
        power = (table["P_n"] + table["P_t"]).sum(axis=0)
        share = area / area.sum()
        columns = {name: table[f"sum_{name}"].sum(axis=0) / np.maximum(contacts, 1e-300)
                   for name in ("F_n", "F_t", "mobilisation", "sliding")}
        printed = printed_shares(self.alpha, len(area))
        return {"psi": table["psi"][0], "density": contacts / contacts.sum() / share, "inhomogeneity": power / power.sum() / share,
                "printed density": contacts / contacts.sum() / printed, "printed inhomogeneity": power / power.sum() / printed, **columns}

    def directions(self):
        """Contact normals by the angle to the flow: beta, density, F_n/PA_p, F_t/PA_p."""
        table = self.blocks("direction.txt")
        contacts = table["contacts"].sum(axis=0)
        width = 2 * np.pi / contacts.size
        scale = self.pressure.mean() * self.micro["A_p"].mean()
        forces = {name: table[f"sum_{name}"].sum(axis=0) / np.maximum(contacts, 1e-300) / scale for name in ("F_n", "F_t")}
        return {"beta": table["beta"][0], "density": contacts / contacts.sum() / width, **forces}

    def displacement(self, axis):
        """Strain, mean square displacement over d^2, and its straight line, of axis x, y or z."""
        table, _ = read_table(self.run.folder / "displacement.txt")
        strain, squares = table["strain"], table[f"{axis}2"] / self.diameter**2
        slope = 2 * table[f"D_{axis}"][-1] / self.diameter**2
        return strain, squares, squares.mean() + slope * (strain - strain.mean())

    def diffusion(self, axis):
        """D/(rate d^2) of axis x, y or z, and 0: one run gives no error."""
        table, _ = read_table(self.run.folder / "displacement.txt")
        return table[f"D_{axis}"][-1] / self.diameter**2, 0.0
