"""Makes measured.csv: a synthetic force history, as a load cell might record it.

Two floors of 25 t and 40 t meet at 0.8 m/s. The force is that of Hunt and
Crossley, F = k d^1.5 (1 + y v / v0), with k = 2.75e9 N/m^1.5 and the y that
returns a restitution of 0.65. Integrated here by classical Runge-Kutta with
steps of 1 us, sampled every 0.2 ms from 5.13 ms before first contact; each
sample is multiplied by 1 + 0.02 z, z standard normal, seed 20250101.

    python3 make_measured.py > measured.csv
"""

import math
import random

MASS = 25e3 * 40e3 / 65e3
STIFFNESS = 2.75e9
APPROACH = 0.8
RESTITUTION = 0.65
BEFORE = 5.13e-3
SAMPLING = 2e-4
DURATION = 45e-3
STEP = 1e-6


def damping_factor(e):
    """The y of y (1 + e) = ln((1 + y) / (1 - y e)), by bisection."""
    low, high = 1e-6, 1 / e - 1e-12
    for _ in range(200):
        y = 0.5 * (low + high)
        if y * (1 + e) > math.log((1 + y) / (1 - y * e)):
            low = y
        else:
            high = y
    return y


FACTOR = damping_factor(RESTITUTION)


def force(d, v):
    if d <= 0:
        return 0.0
    return STIFFNESS * d**1.5 * (1 + FACTOR * v / APPROACH)


def rate(d, v):
    return v, -force(d, v) / MASS


def history():
    """Force at every step after first contact."""
    d, v, forces = 0.0, APPROACH, [0.0]
    for _ in range(round((DURATION - BEFORE) / STEP) + 1):
        a = rate(d, v)
        b = rate(d + STEP / 2 * a[0], v + STEP / 2 * a[1])
        c = rate(d + STEP / 2 * b[0], v + STEP / 2 * b[1])
        e = rate(d + STEP * c[0], v + STEP * c[1])
        d += STEP / 6 * (a[0] + 2 * b[0] + 2 * c[0] + e[0])
        v += STEP / 6 * (a[1] + 2 * b[1] + 2 * c[1] + e[1])
        forces.append(force(d, v))
    return forces


def main():
    forces = history()
    noise = random.Random(20250101)
    print("# SYNTHETIC: made by make_measured.py, not measured")
    print("# Hunt-Crossley, k = 2.75e9 N/m^1.5, restitution 0.65, 25 t against 40 t at 0.8 m/s")
    print("# each sample times 1 + 0.02 z, seed 20250101; first contact at 5.13 ms")
    print("time_ms,force_kN")
    for i in range(round(DURATION / SAMPLING) + 1):
        after = i * SAMPLING - BEFORE
        value = 0.0 if after <= 0 else forces[round(after / STEP)]
        value *= 1 + 0.02 * noise.gauss(0, 1)
        print(f"{i * SAMPLING * 1e3:.1f},{value / 1e3:.2f}")


main()
