# SPDX-License-Identifier: GPL-2.0-or-later
"""grainscope-tools plot: means and errors of series whose own are known, where a series is steady, what is read of each
kind of file, what is drawn, and what is refused."""
import os
from pathlib import Path
import re

import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection, PolyCollection
import numpy as np
from scipy.signal import lfilter

from case import main, require, require_close, require_equal
from command import asked, require_refused
from deck import Deck, thermo
from grainscope.means import mean_and_error, steady_start, text_of
from grainscope.plot import draw, measured
from grainscope.tables import read_series
from packing import dense_packing
from run import run

MEAN, SIGMA, TAU = 3.0, 0.7, 10.0  # of a correlated series, the last in rows
STRESS = "compute stress all stress/contact"


def scratch(name):
    return Path(os.environ["GRAINSCOPE_SCRATCH"]) / name


def written(name, columns, header="# TimeStep {}"):
    """A file with these columns after the steps."""
    rows = np.column_stack([100.0 * np.arange(len(next(iter(columns.values())))), *columns.values()])
    lines = [f"{row[0]:.0f} " + " ".join(f"{value:.17g}" for value in row[1:]) for row in rows]
    scratch(name).write_text("\n".join(["# title", header.format(" ".join(columns)), *lines]) + "\n")
    return scratch(name)


def correlated(series, rows):
    """Gaussian series whose correlation falls by exp(-1/TAU) from row to row, stationary from the first row on."""
    noise = np.random.default_rng(7).normal(size=(series, rows))
    kept = np.exp(-1.0 / TAU)
    noise[:, 1:] *= np.sqrt(1.0 - kept**2)
    return MEAN + SIGMA * lfilter([1.0], [1.0, -kept], noise, axis=1)


def variance_of_mean(rows):
    """Of so many rows of such a series, exactly: the double sum over its correlations."""
    lags = np.arange(1, rows)
    return SIGMA**2 / rows**2 * (rows + 2.0 * ((rows - lags) * np.exp(-lags / TAU)).sum())


def known_error(ranks):
    """The squared error over the exact variance of the mean, averaged over series. The error is the largest of those by
    n = 8, 16, 32 ... blocks. Squared, each of them has the expectation (v(block) - v(all))/(n - 1), v being the exact
    variance of the mean of so many rows; the mean of the largest is at least the largest of these. At most it is that
    plus the root of the sum of their variances (Aven 1985), which are 2/(n - 1) of the square of the expectation for
    independent blocks: 2/7 + 2/15 + ... < 4/7. Shorter blocks are correlated, but there are so many that they add less
    than is left. To both bounds come three standard deviations of the average over series."""
    series, rows = 200, 16384
    found = correlated(series, rows)
    exact = variance_of_mean(rows)
    squares = np.array([mean_and_error(values)[1] ** 2 for values in found]) / exact
    means = np.array([mean_and_error(values)[0] for values in found])
    scatter = ((means - MEAN) ** 2).mean() / exact
    require(abs(scatter - 1.0) < 3.0 * np.sqrt(2.0 / series), f"means scatter by {scatter:.2f} of the exact variance")
    blocks = [rows // size for size in 2 ** np.arange(12) if rows // size >= 8]
    least = max((variance_of_mean(rows // n) - exact) / (n - 1) for n in blocks) / exact
    spread = np.sqrt(4.0 / 7.0)
    slack = 3.0 * spread / np.sqrt(series)
    require(
        least - slack < squares.mean() < least * (1.0 + spread) + slack,
        f"squared errors are {squares.mean():.3f} of the exact variance; {least:.3f} to {least * (1 + spread):.3f}",
    )


def constants(ranks):
    """They have no error, whatever rounding makes of their mean; a scatter just above rounding is one."""
    for value in (0.0, 0.1, 1000.3, -1.0 / 3.0, 1e-30):
        for rows in (1, 7, 1000):
            found = mean_and_error(np.full(rows, value))
            require(found == (value, 0.0), f"{rows} rows of {value}: {found}")
    require(text_of(*mean_and_error(np.full(1000, 0.1))) == "0.1", "a constant as text")
    error = mean_and_error(1.0 + 1e-12 * np.where(np.arange(64) % 2, 1.0, -1.0))[1]
    require_close(error, 1e-12 / np.sqrt(63.0), 1e-3, "error of a small scatter")


def steady_parts(ranks):
    """Series whose steady part is known."""
    wiggle = np.where(np.arange(400) % 2, 1.0, -1.0)
    jump = np.where(np.arange(400) < 37, 10.0, 0.0) + wiggle
    cases = {
        "a jump in row 37, which batch 8 is the first without": (jump, (40, True)),
        "nothing but wiggles": (wiggle, (0, True)),
        "a ramp: n rows of it have the scatter n/12 after batching, which falls to the end": (
            np.arange(400.0),
            (200, False),
        ),
        "a jump beyond the middle": (np.where(np.arange(400) < 300, 10.0, 0.0) + wiggle, (200, False)),
        "a constant that is no round number": (np.full(400, 0.1), (0, True)),
        "49 rows": (np.arange(49.0), (0, True)),
        "50 rows": (np.arange(50.0), (25, False)),
    }
    for what, (values, expected) in cases.items():
        found = steady_start(values)
        require(found == expected, f"{what}: {found}, expected {expected}")


def files_of_the_program(ranks):
    """Default header, and names of title2 with and without '#': the numbers that thermo printed, in the six digits of
    the file."""
    names = ["c_stress[1]", "c_stress[26]", "v_twice"]
    deck = Deck(dense_packing(), body=[STRESS, "variable twice equal 2*c_stress[2]", *thermo(1, *names)])
    for name, title in (("plain", ""), ("named", 'title2 "# step xx mu twice[Pa]"'), ("bare", 'title2 "step xx mu t"')):
        deck.body += [f"fix {name} all ave/time 1 1 1 {' '.join(names)} file {name}.txt {title}"]
    result = run(Deck(deck.packing, [*deck.body, "run 8"]), ranks)
    (expected,) = result.thermo()
    for name, columns in (
        ("plain", ["TimeStep", *names]),
        ("named", ["step", "xx", "mu", "twice"]),
        ("bare", ["step", "xx", "mu", "t"]),
    ):
        found, units = read_series(result.file(f"{name}.txt"))
        require(list(found) == columns, f"columns {list(found)}, expected {columns}")
        require(units["twice"] == "Pa" if name == "named" else not any(units.values()), f"units {units}")
        for column, one in zip(columns[1:], names):
            require_close(found[column], expected[one], 1e-5, f"{name}: {column}")
        require_equal(found[columns[0]], expected["step"], f"{name}: steps")


def picture(ranks):
    """A panel for each column, a line for each file; means and errors over the rows that are said to be steady."""
    wiggle = np.where(np.arange(400) % 2, 1.0, -1.0)
    a = written("a.txt", {"x": np.where(np.arange(400) < 37, 10.0, 5.0) + wiggle, "y": np.arange(400.0)})
    b = written("b.txt", {"x": 7.0 + wiggle, "y": np.arange(400.0) ** 2})
    series = {str(path): read_series(path)[0] for path in (a, b)}
    means = measured(series, ["x"], "TimeStep", None)
    require(list(means["mean"]) == [5.0, 7.0] and list(means["begin"]) == [4000.0, 0.0], f"{means}")
    require(list(means["rows"]) == [360, 400] and list(means["note"]) == ["", ""], f"{means}")
    figure = draw(series, ["x"], "TimeStep", means, {})
    (axis,) = figure.axes
    require([text.get_text() for text in figure.legends[0].get_texts()] == list(series), "legend")
    for line, columns in zip(axis.lines, series.values()):
        require_equal(line.get_xdata(), columns["TimeStep"], "steps")
        require_equal(line.get_ydata(), columns["x"], "values")
    lines = [one for one in axis.collections if isinstance(one, LineCollection)]
    bands = [one for one in axis.collections if isinstance(one, PolyCollection)]
    for line, band, mean in zip(lines, bands, means.itertuples()):
        require_equal(line.get_segments()[0], [[mean.begin, mean.mean], [mean.end, mean.mean]], "mean")
        low, high = band.get_paths()[0].get_extents().intervaly
        require_close([low, high], [mean.mean - mean.error, mean.mean + mean.error], 1e-12, "band of the error")
    plt.close(figure)
    late = measured(series, ["y"], "TimeStep", 39000.0)
    require(list(late["rows"]) == [10, 10] and late["mean"][0] == np.mean(np.arange(390, 400)), f"{late}")


def not_finite(ranks):
    """Rows that are not finite do not count; a column of them has no mean."""
    values = 5.0 + np.where(np.arange(60) % 2, 1.0, -1.0)
    values[:2] = np.nan
    path = written("a.txt", {"x": values, "y": np.full(60, np.nan)})
    means = measured({path: read_series(path)[0]}, ["x", "y"], "TimeStep", None)
    require(list(means["rows"]) == [58] and means["mean"][0] == 5.0 and means["begin"][0] == 200.0, f"{means}")


def command_line(ranks):
    """What is printed of a series whose mean is known; a row that the run has not ended; words that are refused."""
    values = correlated(1, 4096)[0]
    a, b = written("a.txt", {"v_mu": values, "v_phi": values}), written("b.txt", {"v_mu": values})
    with a.open("a") as file:
        file.write("409600 3.1 2")  # of 2.99, say: as many numbers as the others, but not all digits
    code, said = asked("plot", a, b, "v_mu", "--output", scratch("a.pdf"))
    require(code == 0 and scratch("a.pdf").read_bytes().startswith(b"%PDF"), said)
    require("a.txt: the last row is incomplete and left out" in said, said)
    rows = re.findall(r"v_mu +(\S+) \+- (\S+) +\d+ +(\d+)", said)
    require(len(rows) == 2 and "steady part: by MSER-5" in said and "by blocking" in said, said)
    for mean, error, kept in rows:
        require(abs(float(mean) - MEAN) < 5.0 * np.sqrt(variance_of_mean(4096)), said)
        require_close(float(error), mean_and_error(values[-int(kept) :])[1], 0.05, "error")  # two digits are printed
    code, said = asked("plot", a, "--against", "v_phi", "v_mu", "--from", 3, "--output", scratch("b.png"))
    require(
        code == 0
        and "steady part: from 3 on;" in said
        and "from v_phi" in said
        and "v_phi " not in said.splitlines()[2],
        said,
    )
    for words, expected in (
        ([scratch("none.txt")], ("none.txt", "No such file")),
        ([a, "v_mu_eff"], ("no column 'v_mu_eff'; nearest: v_mu;", "v_phi")),
        ([a, b, "v_phi"], ("b.txt", "no column 'v_phi'", "it has TimeStep, v_mu")),
        ([a, "--against", "strain"], ("no column 'strain'",)),
        ([a, "--from", "1e9"], ("--from must leave at least two rows", "got 1e+09", "0 to 409500")),
        ([a, "--output", "a.jpg"], ("--output must end in .png, .pdf, .svg, got 'a.jpg'",)),
        ([a, "--output", scratch("none/a.png")], ("No such file or directory",)),
        ([written("twice.txt", {"x": values}, "# step x x")], ("got 'x' twice",)),
        ([written("few.txt", {"x": values}, "# step x y")], ("row 1 has 2 values, the header names 3 columns",)),
        ([written("many.txt", {f"x{k}": values[:9] for k in range(31)})], ("at most 30, got 31",)),
    ):
        require_refused(["plot", *words], *expected)
    scratch("table.txt").write_text("# t\n# TimeStep Number-of-rows\n# Row a b\n0 2\n1 3 4\n2 5 6\n")
    require_refused(["plot", scratch("table.txt")], "drawn by `rows`")
    scratch("field.csv").write_text("# step 0\n# cells 1 1 1\nx,y,z\n0,0,0\n")
    require_refused(["plot", scratch("field.csv")], "drawn by `rows`")
    scratch("word.txt").write_text("# step x\n1 2\n2 two\n")
    require_refused(["plot", scratch("word.txt")], "word.txt", "'two'")
    scratch("empty.txt").write_text("# t\n# TimeStep a\n")
    require_refused(["plot", scratch("empty.txt")], "at least one row")
    scratch("binary.txt").write_bytes(bytes(range(128, 256)))
    require_refused(["plot", scratch("binary.txt")], "not a text file")


main(
    {
        "known-error": known_error,
        "constants": constants,
        "steady-parts": steady_parts,
        "files-of-the-program": files_of_the_program,
        "picture": picture,
        "not-finite": not_finite,
        "command-line": command_line,
    }
)
