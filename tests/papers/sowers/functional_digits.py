#!/usr/bin/env python3
"""Digits that tests/papers/sowers/functionals.rs pins, by a route of their own (needs mpmath).

For each component of the law of ξ, (X(2), Y(0), Y(1)) is jointly Gaussian and is conditioned on the readings directly.
"""
from mpmath import mp, mpf, matrix, det, exp, cos, sqrt, pi, ncdf, fsum, nstr

mp.dps = 50
readings = matrix([1, 3])
# X(2) = ξ + W1 + W2, Y(0) = ξ + V1, Y(1) = ξ + W1 + V2, var W = 1, var V = 2
parts = []
for weight, mean, var in [(mpf(1) / 4, -2, 5), (mpf(1) / 2, 1, 1), (mpf(1) / 4, 3, 0)]:
    of_y = matrix([[var + 2, var], [var, var + 3]])
    cross = matrix([[var, var + 1]])
    away = readings - matrix([mean, mean])
    likelihood = exp(-(away.T * of_y ** -1 * away)[0] / 2) / (2 * pi * sqrt(det(of_y)))
    gain = cross * of_y ** -1
    parts.append((weight * likelihood, mean + (gain * away)[0], var + 2 - (gain * cross.T)[0]))
total = fsum(p for p, m, v in parts)


def average(of):
    return nstr(fsum(p * of(m, v) for p, m, v in parts) / total, 32, min_fixed=-100)


print("E X:", average(lambda m, v: m))
print("E X^4:", average(lambda m, v: m ** 4 + 6 * m ** 2 * v + 3 * v ** 2))
print("E exp(X/2):", average(lambda m, v: exp(m / 2 + v / 8)))
print("P(X <= 1):", average(lambda m, v: ncdf((1 - m) / sqrt(v))))
print("P(X <= -9):", average(lambda m, v: ncdf((-9 - m) / sqrt(v))))
print("E cos X:", average(lambda m, v: cos(m) * exp(-v / 2)))
