"""Means of correlated series, their errors, and where a series is steady."""

import numpy as np

BATCH = 5  # rows that MSER-5 averages first
FEWEST = 10  # batches below which MSER-5 is not asked
KEPT = 5  # batches at the end that are never left out
ROUNDING = 1e-14  # scatter of a constant, over its magnitude


def mean_and_error(values):
    """Mean and its standard error by blocking (Flyvbjerg & Petersen, J. Chem. Phys. 91, 461 (1989)): blocks of 1, 2, 4
    ... rows, at least 8 of them where there are so many rows; the largest error counts. One row, or a
    constant, has no error: 0."""
    error, blocks = 0.0, np.asarray(values)
    if blocks.std() <= ROUNDING * np.abs(blocks).max(initial=0.0):
        return blocks[0], 0.0
    while len(blocks) >= min(8, max(2, len(values))):
        error = max(error, blocks.std(ddof=1) / np.sqrt(len(blocks)))
        blocks = blocks[: len(blocks) // 2 * 2].reshape(-1, 2).mean(axis=1)
    return np.mean(values), error


def steady_start(values):
    """(first row of the steady part, whether there is one) by MSER-5 (White, Simulation 69, 323 (1997)). Rows are
    averaged in batches of five. Of the parts from some batch to the end, the one is taken whose variance over its
    number of batches is smallest. If it begins in the second half, the series is not steady yet, and that half is
    taken. Fewer than 50 rows are taken as they are."""
    values = np.asarray(values, dtype=float)
    batches = values[: len(values) // BATCH * BATCH].reshape(-1, BATCH).mean(axis=1)
    if len(batches) < FEWEST:
        return 0, True
    centred = batches - batches.mean()
    left = np.arange(len(batches), 0, -1)
    sums, squares = (np.cumsum(part[::-1])[::-1] for part in (centred, centred**2))
    scatter = squares - sums**2 / left
    scatter[scatter <= left * (ROUNDING * np.abs(batches).max()) ** 2] = 0.0
    first = int(np.argmin((scatter / left**2)[: len(batches) - KEPT + 1]))
    if 2 * first >= len(batches):
        return len(values) // 2, False
    return BATCH * first, True


def text_of(mean, error):
    """Mean and error as text, the error with two digits."""
    digits = max(0, 1 - int(np.floor(np.log10(error)))) if error > 0 else 3
    return f"{mean:.{digits}f} +- {error:.{digits}f}" if error > 0 else f"{mean:.3g}"
