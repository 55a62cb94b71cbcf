#!/usr/bin/env python3
"""The numbers in reference.csv: complex principal components of a small motion, computed the plain way with NumPy and SciPy.

Where src/analysis works with the frames x frames matrix S S^T alone, this continues every column of the data, transforms
each with SciPy's FFT and takes the SVD of the complex data. Usage: tests/analysis/reference.py > tests/analysis/reference.csv
"""
import numpy as np
from scipy.signal import hilbert

FRAMES, VERTICES, FPS = 105, 20, 60.0
ORDER_MAX, LEAST_POWER = 32, 1e-9


def noise(count):
    """A linear congruential generator, in [-0.5, 0.5); the test has the same."""
    state, values = 1, []
    for _ in range(count):
        state = (1664525 * state + 1013904223) % 2**32
        values.append(state / 2**32 - 0.5)
    return np.array(values)


def motion():
    """Two damped oscillations whose amplitude and phase vary from column to column, an offset, and noise."""
    t = np.arange(FRAMES)[:, None] / FPS
    j = np.arange(3 * VERTICES)[None, :]
    first = (1 + 0.5 * np.sin(0.7 * j)) * np.exp(-0.4 * t) * np.cos(2 * np.pi * 1.3 * t + 1.1 * np.sin(0.9 * j))
    second = 0.3 * np.cos(1.3 * j) * np.exp(-0.9 * t) * np.cos(2 * np.pi * 4.1 * t + 0.8 * j)
    return j + first + second + 0.02 * noise(FRAMES * 3 * VERTICES).reshape(FRAMES, -1)


def predictor(s):
    """Burg's method on all columns at once, with steps of an eighth of the mean period: the errors of the data themselves."""
    omega = np.arccos(np.sum(s[1:] * s[:-1]) / np.sum((s[1:] ** 2 + s[:-1] ** 2) / 2))
    q = int(np.clip(np.pi / (4 * omega), 1, FRAMES // 8))
    a, forward, backward = np.array([1.0]), s, s
    for m in range(1, ORDER_MAX + 1):
        forward, backward = forward[q:], backward[:-q]
        left = np.sum(forward**2 + backward**2)
        if m * q > 2 * FRAMES // 3 or not left > 2 * LEAST_POWER * np.sum(s**2):
            break
        k = -2 * np.sum(forward * backward) / left
        padded = np.append(a, 0)
        a = padded + k * padded[::-1]
        forward, backward = forward + k * backward, backward + k * forward
    return a, q


def analytic(s):
    a, q = predictor(s)
    p, before = len(a) - 1, FRAMES // 2
    after = FRAMES - before
    x = np.zeros((2 * FRAMES, s.shape[1]))
    x[before : before + FRAMES] = s
    for t in range(before + FRAMES, 2 * FRAMES):
        x[t] = -sum(a[i] * x[t - i * q] for i in range(1, p + 1))
    for t in range(before - 1, -1, -1):
        x[t] = -sum(a[i] * x[t + i * q] for i in range(1, p + 1))
    fade = lambda count: 0.5 + 0.5 * np.cos(np.pi * (np.arange(count) + 0.5) / count)
    x[:before] *= fade(before)[::-1, None]
    x[before + FRAMES :] *= fade(after)[:, None]
    return hilbert(x, axis=0)[before : before + FRAMES]


def main():
    s = motion()
    s = s - s.mean(axis=0)
    u, sigma, vh = np.linalg.svd(analytic(s), full_matrices=False)
    print("what,index,re,im")
    for i, value in enumerate(sigma[:8] ** 2):
        print(f"value,{i},{value:.17g},0")
    print(f"total,0,{np.sum(sigma**2):.17g},0")
    mu = np.linalg.svd(s, compute_uv=False) ** 2
    print(f"pca1,0,{mu[0] / mu.sum():.17g},0")
    print(f"pca2,0,{(mu[0] + mu[1]) / mu.sum():.17g},0")
    for k in range(2):
        scale = np.max(np.abs(u[:, k]))
        shape = (scale * sigma[k] * vh[k]).reshape(VERTICES, 3)
        turn = np.exp(-0.5j * np.angle(np.sum(shape[:, 1] ** 2)))  # d = (0, 1, 0)
        if np.real(np.sum(shape[:, 1] * turn)) < 0:
            turn = -turn
        for n, number in enumerate((shape * turn).ravel()):
            print(f"shape{k},{n},{number.real:.17g},{number.imag:.17g}")


main()
