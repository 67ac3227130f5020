"""Jacobians that scipy's `least_squares` (trf, its own tolerances) takes for twenty decays of 20 values from each of four starts:
the decays of `solver/tests/spared.rs`."""

import numpy as np
from scipy.optimize import least_squares

state = 1


def number():
    global state
    state = (state * 6364136223846793005 + 1) % 2**64
    return (state >> 11) / 2**53 - 0.5


t = 0.2 * np.arange(20)
for start in ([1, 1], [5, 3], [1, 0], [0.1, 5]):
    jacobians = 0
    for _ in range(20):
        a = 2 + number()
        b = 0.8 + number()
        y = a * np.exp(-b * t) + 0.05 * np.array([number() for _ in range(20)])
        found = least_squares(
            lambda x: x[0] * np.exp(-x[1] * t) - y,
            start,
            jac=lambda x: np.stack([np.exp(-x[1] * t), -x[0] * t * np.exp(-x[1] * t)], 1),
        )
        jacobians += found.njev
    print(start, jacobians)
