"""Means of correlated series, and their errors."""

import numpy as np


def mean_and_error(values):
    """Mean and its standard error by blocking: blocks of 1, 2, 4 ... rows, at least 8 of them where there are so many
    rows; the largest error counts. One row has no error: 0."""
    error, blocks = 0.0, np.asarray(values)
    while len(blocks) >= min(8, max(2, len(values))):
        error = max(error, blocks.std(ddof=1) / np.sqrt(len(blocks)))
        blocks = blocks[: len(blocks) // 2 * 2].reshape(-1, 2).mean(axis=1)
    return np.mean(values), error
