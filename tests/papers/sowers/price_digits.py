#!/usr/bin/env python3
"""Digits of the price of linearity that tests/papers/sowers/price.rs pins, by a route of their own (needs mpmath; four minutes).

X = Q*ξ is estimated from y = ξ + noise of covariance R*⁻¹, which tells as much of ξ as all readings. The densities of y are those
of Gaussian laws, and E‖E[X|y] − (best affine function of y)‖² and E‖X − E[X|y]‖² are plain integrals over y, done by quadrature on a line
and by the trapezoidal rule in a plane (its results for two steps are printed, to see how many digits agree). Printed are both.
"""
from mpmath import mp, mpf, matrix, det, exp, fsum, pi, quad, sqrt

mp.dps = 30


def line(law, noise):
    mean = fsum(w * m for w, m, v in law)
    spread = fsum(w * (v + (m - mean) ** 2) for w, m, v in law)

    def integrand(y):
        densities = [w * exp(-(y - m) ** 2 / (2 * (v + noise))) / sqrt(2 * pi * (v + noise)) for w, m, v in law]
        best = [m + v / (v + noise) * (y - m) for w, m, v in law]
        affine = mean + spread / (spread + noise) * (y - mean)
        return fsum(p * (x - affine) for p, x in zip(densities, best)) ** 2 / fsum(densities)

    def error(y):
        densities = [w * exp(-(y - m) ** 2 / (2 * (v + noise))) / sqrt(2 * pi * (v + noise)) for w, m, v in law]
        parts = [(m + v / (v + noise) * (y - m), v * noise / (v + noise)) for w, m, v in law]
        mean = fsum(p * x for p, (x, v) in zip(densities, parts)) / fsum(densities)
        return fsum(p * (v + (x - mean) ** 2) for p, (x, v) in zip(densities, parts))

    far = [60, 200, 1000, 5000, 20000]
    places = [-y for y in reversed(far)] + list(range(-40, 41, 2)) + far
    return quad(integrand, places), quad(error, places)


def plane(law, information, response, reach, step):
    noise = information ** -1
    mean = sum((w * m for w, m, v in law), matrix(2, 1))
    spread = sum((w * (v + (m - mean) * (m - mean).T) for w, m, v in law), matrix(2, 2))
    parts = [(w, m, (v + noise) ** -1, det(v + noise), v * (v + noise) ** -1) for w, m, v in law]
    gain = spread * (spread + noise) ** -1
    total, error = mpf(0), mpf(0)
    for i in range(-int(reach / step), int(reach / step) + 1):
        for j in range(-int(reach / step), int(reach / step) + 1):
            y = matrix([i * step, j * step])
            densities = [w * exp(-((y - m).T * inverse * (y - m))[0] / 2) / (2 * pi * sqrt(d))
                         for w, m, inverse, d, g in parts]
            whole = fsum(densities)
            if whole < mpf(10) ** -28:
                continue
            estimates = [response * (m + g * (y - m)) for w, m, inverse, d, g in parts]
            best = sum((p * x for p, x in zip(densities, estimates)), matrix(2, 1)) / whole
            for p, x, (w, m, inverse, d, g) in zip(densities, estimates, parts):
                spread = response * (g * noise) * response.T
                error += p * (spread[0, 0] + spread[1, 1] + (x - best)[0] ** 2 + (x - best)[1] ** 2)
            away = matrix(2, 1)
            for p, (w, m, inverse, d, g) in zip(densities, parts):
                away += p * (m + g * (y - m) - mean - gain * (y - mean))
            away = response * away
            total += (away[0] ** 2 + away[1] ** 2) / whole
    return total * step * step, error * step * step


third, zero = mpf(1) / 3, matrix(2, 2)
print("1/3 N(0, 3) + 2/3 delta(1), R* = 1/2:", line([(third, 0, 3), (2 * third, 1, 0)], mpf(2)))
print("1/4 N(-2, 5) + 1/2 N(1, 1) + 1/4 delta(3), R* = 3/2:",
      line([(mpf(1) / 4, -2, 5), (mpf(1) / 2, 1, 1), (mpf(1) / 4, 3, 0)], mpf(2) / 3))
print("1/2 delta(0) + 1/2 N(0, 1000000), R* = 1/2:", line([(mpf(1) / 2, 0, 0), (mpf(1) / 2, 0, 1000000)], mpf(2)))
seen, response = matrix([[2, 1], [1, 1]]), matrix([[1, 0], [1, 1]])
atoms = [(third, matrix([0, 0]), zero), (third, matrix([1, 0]), zero), (third, matrix([0, 3]), zero)]
slab = [(mpf(1) / 2, matrix([0, 0]), zero), (mpf(1) / 2, matrix([0, 0]), matrix([[1, 0], [0, 1]]))]
for name, law in [("three atoms in the plane", atoms), ("spike and slab in the plane", slab)]:
    for step in (mpf(1) / 6, mpf(1) / 8):
        print(name + ":", plane(law, seen, response, 20, step))
