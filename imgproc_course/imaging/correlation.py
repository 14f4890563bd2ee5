"""Correlation along one axis: the building block of a separable filter."""

import numpy as np


def correlate1d(values, kernel, axis):
    """response[i] = kernel[0] values[i] + kernel[1] values[i + 1] + …, as scipy's, but without a border.

    A correlation does not flip the kernel; a convolution does. For a symmetric kernel (1, 2, 1) both give the
    same result, for an antisymmetric one (-1, 0, 1) the sign changes. Another kernel is not accepted. The
    dtype of the values must be wide enough for the sums: widen it first.
    """
    half = len(kernel) // 2
    length = values.shape[axis] - 2 * half

    def neighbour(k):
        return values[(slice(None),) * axis + (slice(k, k + length),)]

    combine = np.subtract if kernel[0] == -kernel[-1] and kernel[0] else np.add
    response = neighbour(half) * values.dtype.type(kernel[half]) if kernel[half] else None
    for k in range(half):
        weight = kernel[-1 - k]
        if weight == 0:
            continue
        # The two neighbours at the same distance share a weight: added first, they need one product.
        pair = combine(neighbour(2 * half - k), neighbour(k))
        if weight != 1:
            pair *= values.dtype.type(weight)
        response = pair if response is None else np.add(response, pair, out=response)
    return response
