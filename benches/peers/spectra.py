"""Response spectra of one record at 200 periods and 5 damping ratios by pyrotd.

Prints the least time of some repetitions (ms), then PSA (m/s2) at the 200 periods for 5 %.
The end of its transform runs into its start: the values, not the times, are those of the
record with zeros after it, five times as long.
Arguments: file of one value a line (m/s2), time step (s), repetitions.
"""

import sys
import time

import numpy as np
import pyrotd

pyrotd.processes = 1  # one processor, as ours
samples = np.loadtxt(sys.argv[1])
step, repetitions = float(sys.argv[2]), int(sys.argv[3])
periods = np.exp(np.linspace(np.log(0.02), np.log(10.0), 200))
dampings = (0.01, 0.02, 0.05, 0.10, 0.20)


def spectrum(values, damping):
    found = pyrotd.calc_spec_accels(step, values, 1.0 / periods, osc_damping=damping, osc_type="psa")
    return found.spec_accel


least = float("inf")
for _ in range(repetitions):
    start = time.process_time()
    for damping in dampings:
        spectrum(samples, damping)
    least = min(least, time.process_time() - start)
longer = np.concatenate([samples, np.zeros(4 * len(samples))])
print(f"{least * 1e3:.3f}")
print(" ".join(f"{a:.9e}" for a in spectrum(longer, 0.05)))
