"""Steady state of a run of examples/simple_shear, in the units and normalisations of the paper: means with errors, and
curves. Used by the figures, the summary and the tables of a study."""

from dataclasses import dataclass

import numpy as np

from grainscope.errors import InputError
from grainscope.fits import fit_decay
from grainscope.grains import read_grains
from grainscope.means import mean_and_error
from grainscope.shear.output import read_blocks, read_table
from grainscope.shear.quantities import MEASURED, SERIES

FILES = [
    "micro.txt",
    "displacement.txt",
    "surface.txt",
    "direction.txt",
    "correlation.txt",
    "layering.txt",
    "memory.txt",
]


def printed_shares(alpha, bins):
    """Shares of the surface in `bins` equal bins of psi by the area element that the paper prints, a sin(psi) sqrt(a^2
    cos^2 + c^2 sin^2). It is that of the parametric angle; psi is the polar angle, so for alpha other than 1 these are
    not the areas of the bins.
    """
    psi = (np.arange(200 * bins) + 0.5) * np.pi / (400 * bins)
    element = np.sin(psi) * np.sqrt(np.cos(psi) ** 2 + (alpha * np.sin(psi)) ** 2)
    return element.reshape(bins, -1).sum(axis=1) / element.sum()


@dataclass
class SteadyRun:
    """Steady state of a run: its parameters, its means as (mean, standard error) by name, and its curves as arrays by
    name and column."""

    name: str
    parameters: dict
    means: dict
    curves: dict

    def __getitem__(self, name):
        if name not in self.means:
            raise InputError(f"{self.name}: no mean '{name}'; there are {', '.join(self.means)}")
        return self.means[name]

    @property
    def alpha(self):
        return self.parameters["alpha"]

    @property
    def mu(self):
        return self.parameters["mu"]

    @property
    def I(self):
        return self.parameters["I"]

    @property
    def r_g(self):
        return (self.alpha - 1) / (self.alpha + 1)

    @property
    def measured_all(self):
        return "lever" in self.means

    @property
    def inertial(self):
        """The inertial number that the mean pressure makes."""
        return self["I_reached"][0]

    def fabric_axes(self):
        """The two eigenvalues whose axes lie in the xy plane, the larger first, and these axes (x, y), pointing to x >
        0."""
        xx, yy, zz, xy, xz, yz = (self[f"F_{c}"][0] for c in ("xx", "yy", "zz", "xy", "xz", "yz"))
        values, vectors = np.linalg.eigh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        in_plane = np.argsort(np.abs(vectors[2]))[:2]
        order = in_plane[np.argsort(-values[in_plane])]
        axes = vectors[:2, order].T
        return values[order], axes * np.where(axes[:, :1] < 0, -1, 1)


def solid_volume_and_area(run):
    """Volume of all grains, and the area of the box across the gradient, which stays what it is."""
    grains = read_grains(run.folder / "grains.dump")
    return 4 / 3 * np.pi * grains.semi_axes.prod(axis=1).sum(), grains.edges[0, 0] * grains.edges[2, 2]


class Blocks:
    """The files of `measure all`, without the parts of the run that begin before strain `start`."""

    def __init__(self, run, start):
        missing = [name for name in FILES if not (run.folder / name).exists()]
        if missing:
            raise InputError(f"{run.folder}: no {', '.join(missing)}; an ended run with `-var measure all` writes them")
        self.run, self.start = run, start
        self.diameter, self.rate = run.parameters["d_eq"], run.parameters["rate"]
        micro, _ = read_table(run.folder, "micro.txt")
        ends = micro["strain"]
        begins = ends - (np.diff(ends).mean() if len(ends) > 1 else ends[-1] / 16)
        self.kept = np.ones(len(ends), dtype=bool) if start is None else begins > start - 1e-3
        if not self.kept.any():
            raise InputError(
                f"{run.folder}: no part of micro.txt begins after strain {start:g}; the last one begins at "
                f"{begins[-1]:.2f}"
            )
        self.micro = {name: values[self.kept] for name, values in micro.items()}
        self.pressure = -(self.micro["n_yy"] + self.micro["t_yy"])

    def tables(self, name):
        """Columns of a file of tables, one table per part of the run, as arrays (parts, rows)."""
        columns = read_blocks(self.run.folder, name)
        if len(columns["bin"]) != len(self.kept):
            raise InputError(
                f"{self.run.folder}: {name} has {len(columns['bin'])} tables, micro.txt {len(self.kept)} rows; "
                "they must be of one run"
            )
        return {column: values[self.kept] for column, values in columns.items()}

    def micro_means(self):
        micro, pressure = self.micro, self.pressure
        stress = {name: micro[name] / pressure for name in MEASURED if name[:2] in ("n_", "t_")}
        total = {c: stress[f"n_{c}"] + stress[f"t_{c}"] for c in ("xx", "yy", "zz")}
        fabric = {name: micro[name] for name in MEASURED if name.startswith("F_")}
        rows = {
            **stress,
            **fabric,
            "N1": total["xx"] - total["yy"],
            "N2": total["yy"] - total["zz"],
            "instant_n": micro["instant_n"],
            "instant_t": micro["instant_t"],
            "dv_x/dv_y": micro["dv_x"] / micro["dv_y"],
            "dv_x/dv_z": micro["dv_x"] / micro["dv_z"],
            "E_rot/E_tr": micro["E_rot"] / micro["E_tr"],
            "lever": micro["lever"],
            "spin_fluctuation": np.sqrt(sum(micro[f"dw_{axis}"] ** 2 for axis in "xyz")) / self.rate,
            "idle": 100 * micro["idle"],
            "layering": micro["layering"],
        }
        return {name: mean_and_error(values) for name, values in rows.items()} | {
            "fabric_deviator": self.fabric_deviator()
        }

    def fabric_deviator(self):
        """sqrt(3/2 F':F') of the mean tensor, its error from the parts."""

        def deviator(fabric):
            diagonal = sum((fabric[f"F_{c}"] - 1 / 3) ** 2 for c in ("xx", "yy", "zz"))
            return np.sqrt(1.5 * (diagonal + 2 * sum(fabric[f"F_{c}"] ** 2 for c in ("xy", "xz", "yz"))))

        mean = {name: values.mean() for name, values in self.micro.items() if name.startswith("F_")}
        return deviator(mean), mean_and_error(deviator(self.micro))[1]

    def correlation(self, component, table):
        """C(r) of vy or wz: ratio of sums over the steady state. Bins without pairs are left out."""
        pairs, sums = table["pairs"].sum(axis=0), table[component].sum(axis=0)
        filled = pairs > 0
        return (
            table["r"].mean(axis=0)[filled] / self.diameter,
            sums[filled] / pairs[filled] / self.micro[f"{component}2"].mean(),
        )

    def correlation_length(self, component, table):
        """l of exp(-r/l), and its error: that of the fit, or from the spread over the parts that tell a length, if that
        is larger."""
        length, error = fit_decay(*self.correlation(component, table))
        single = []
        for r, sums, pairs, square in zip(table["r"], table[component], table["pairs"], self.micro[f"{component}2"]):
            filled = pairs > 0
            single.append(fit_decay(r[filled] / self.diameter, sums[filled] / pairs[filled] / square)[0])
        single = np.array(single)
        return length, max(error, mean_and_error(single[np.isfinite(single)])[1])

    def memory(self):
        table = read_blocks(self.run.folder, "memory.txt")
        filled = table["pairs"][-1] > 0
        return {"lag": table["lag"][-1][filled], "vy": table["C"][-1][filled]}

    def layering(self):
        table = self.tables("layering.txt")
        density = table["C"].mean(axis=0)
        return {"y": table["lag"].mean(axis=0) / self.diameter, "C": density / density[0]}

    def surface(self):
        """Contacts on the grain by psi: ratios of sums over all contacts of the steady state. Densities are over the
        exact areas; the `printed` ones over those of printed_shares."""
        table = self.tables("surface.txt")
        contacts, area = table["contacts"].sum(axis=0), table["A"].mean(axis=0)
        power = (table["P_n"] + table["P_t"]).sum(axis=0)
        share, printed = area / area.sum(), printed_shares(self.run.parameters["alpha"], len(area))
        columns = {
            name: table[f"sum_{name}"].sum(axis=0) / np.maximum(contacts, 1e-300)
            for name in ("F_n", "F_t", "mobilisation", "sliding")
        }
        return {
            "psi": table["psi"][0],
            "density": contacts / contacts.sum() / share,
            "inhomogeneity": power / power.sum() / share,
            "printed density": contacts / contacts.sum() / printed,
            "printed inhomogeneity": power / power.sum() / printed,
            **columns,
        }

    def directions(self):
        table = self.tables("direction.txt")
        contacts = table["contacts"].sum(axis=0)
        width = 2 * np.pi / contacts.size
        scale = self.pressure.mean() * self.micro["A_p"].mean()
        forces = {
            name: table[f"sum_{name}"].sum(axis=0) / np.maximum(contacts, 1e-300) / scale for name in ("F_n", "F_t")
        }
        return {"beta": table["beta"][0], "density": contacts / contacts.sum() / width, **forces}

    def displacement(self):
        """Mean square displacements, and half their slopes with errors from the slopes of four parts of the strain."""
        table, _ = read_table(self.run.folder, "displacement.txt")
        reached = table["step"] * self.run.parameters["dt"] * self.rate
        rows = reached > (0 if self.start is None else self.start - 1e-3)
        strain = table["strain"][rows]
        curves, slopes = {"strain": strain}, {}
        for axis in ("y", "z"):
            squares = curves[f"{axis}2"] = table[f"{axis}2"][rows] / self.diameter**2
            quarters = [
                np.polyfit(x, y, 1)[0] / 2
                for x, y in zip(np.array_split(strain, 4), np.array_split(squares, 4))
                if len(x) > 2
            ]
            error = np.std(quarters, ddof=1) / np.sqrt(len(quarters)) if len(quarters) > 1 else 0.0
            slopes[f"D_{axis}"] = (np.polyfit(strain, squares, 1)[0] / 2 if len(strain) > 1 else 0.0, error)
        return curves, slopes


def measured_all(run, start):
    """Means and curves of the files of `measure all`."""
    blocks = Blocks(run, start)
    correlation = blocks.tables("correlation.txt")
    r, vy = blocks.correlation("vy", correlation)
    displacement, diffusion = blocks.displacement()
    means = (
        blocks.micro_means() | {f"l_{c}": blocks.correlation_length(c, correlation) for c in ("vy", "wz")} | diffusion
    )
    curves = {
        "correlation": {"r": r, "vy": vy, "wz": blocks.correlation("wz", correlation)[1]},
        "memory": blocks.memory(),
        "layering": blocks.layering(),
        "surface": blocks.surface(),
        "direction": blocks.directions(),
        "displacement": displacement,
    }
    return means, curves


def steady_run(run, start=None):
    """The steady state of a run, from strain `start` on."""
    rows = run.steady(start)
    means = {name: mean_and_error(run[name][rows]) for name in SERIES}
    pressure, error = means["P"]
    reached = run.parameters["I"] / np.sqrt(pressure)
    means["I_reached"] = reached, 0.5 * reached * error / pressure
    volume, area = solid_volume_and_area(run)
    height, error = mean_and_error(volume / area / run["phi"][rows])
    means["L_y"] = height / run.parameters["d_eq"], error / run.parameters["d_eq"]
    curves = {}
    if run.measured_all:
        more, curves = measured_all(run, start)
        means |= {name: pair for name, pair in more.items() if np.isfinite(pair).all()}
    return SteadyRun(run.name, dict(run.parameters), means, curves)
