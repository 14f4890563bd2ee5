"""Weighted sums of neighbours along one axis: what a separable filter is made of."""

import numpy as np


def weighed(values, weights, axis):
    """Weighted sum of neighbours along one axis (a correlation), at every place where all of them exist.

    Parameters
    ----------
    values : 2-D or 3-D array, of a dtype wide enough for the sums: widen it before
    weights : odd number of whole numbers, symmetric (1, 2, 1) or antisymmetric (-1, 0, 1)
    axis : 0 sums down a column, 1 along a row

    Returns
    -------
    array of the same dtype, len(weights) - 1 shorter along `axis`:
    out[i] = weights[0] values[i] + weights[1] values[i + 1] + …
    """
    half = len(weights) // 2
    length = values.shape[axis] - 2 * half

    def neighbour(k):
        return values[(slice(None),) * axis + (slice(k, k + length),)]

    combine = np.subtract if weights[0] == -weights[-1] and weights[0] else np.add
    total = neighbour(half) * values.dtype.type(weights[half]) if weights[half] else None
    for k in range(half):
        weight = weights[-1 - k]
        if weight == 0:
            continue
        # The two neighbours at one distance share a weight: added first, they need one product.
        pair = combine(neighbour(2 * half - k), neighbour(k))
        if weight != 1:
            pair *= values.dtype.type(weight)
        total = pair if total is None else np.add(total, pair, out=total)
    return total
