"""Processor time of one call, on one thread, and its unit: a pair of transforms."""

import multiprocessing
import os
import time
from concurrent.futures import ProcessPoolExecutor


def alone(function, *arguments):
    """The value of a call in a process of its own, on one thread."""
    for name in ("OMP", "OPENBLAS", "MKL", "NUMBA"):
        os.environ[f"{name}_NUM_THREADS"] = "1"
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as process:
        return process.submit(function, *arguments).result()


def pair(n: int) -> float:
    """Processor seconds of one rfft2 and irfft2 of n x n by pyfftw, planned with MEASURE, one thread."""
    import pyfftw

    points, waves = pyfftw.zeros_aligned((n, n)), pyfftw.zeros_aligned((n, n // 2 + 1), complex)
    axes = {"axes": (0, 1), "flags": ("FFTW_MEASURE", "FFTW_DESTROY_INPUT")}
    forward = pyfftw.FFTW(points, waves, **axes)
    backward = pyfftw.FFTW(waves, points, direction="FFTW_BACKWARD", **axes)
    points[:] = 1.0
    return least(lambda: (forward.execute(), backward.execute()), n)


def least(call, n: int) -> float:
    """Least processor seconds of a call on n x n points, over about a second."""
    times = []
    while len(times) < 5 or (sum(times) < 1.0 and len(times) < 200):
        started = time.process_time()
        for _ in range(max(1, (256 // n) ** 2)):
            call()
        times.append((time.process_time() - started) / max(1, (256 // n) ** 2))
    return min(times)
