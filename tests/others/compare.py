"""Vertices of ours (.pc2, .npy), and what is off against them."""
import sys
import numpy as np


def read_cache(path):
    """Positions by frame and vertex, and the first frame."""
    if path.endswith('.npy'):
        return np.load(path), 0.0
    data = open(path, 'rb').read()
    vertices, = np.frombuffer(data, '<i4', 1, 16)
    first, = np.frombuffer(data, '<f4', 1, 20)
    frames, = np.frombuffer(data, '<i4', 1, 28)
    return np.frombuffer(data, '<f4', frames * vertices * 3, 32).reshape(frames, vertices, 3), float(first)


def ten_of(frames):
    return [round(n * (frames - 1) / 9) for n in range(10)]


def judge(who, off, positions, bar=1e-5):
    """Says how far vertices are off; the exit status is 1 past the bar, in parts of the size."""
    size = float(np.linalg.norm(positions.reshape(-1, 3).max(0) - positions.reshape(-1, 3).min(0)))
    print(f'{who}: at most {off:.1e} m off, {off / size:.1e} of the size')
    sys.stdout.flush()
    return 0 if off <= bar * size else 1
