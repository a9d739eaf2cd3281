"""What the tests of the Python module share."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import redmap
from numpy.typing import NDArray

Rows = NDArray[np.float32]
ROOT = Path(__file__).resolve().parents[2]


def floats(rows: list[Any]) -> Rows:
    return np.array(rows, np.float32)


def indices(rows: list[Any]) -> NDArray[np.uint32]:
    return np.array(rows, np.uint32)


def unit(rows: Rows) -> Rows:
    return np.asarray(rows / np.linalg.norm(rows, axis=1, keepdims=True), np.float32)


def directions(count: int, seed: int) -> Rows:
    """Random unit vectors, all over the sphere."""
    return unit(np.random.default_rng(seed).normal(size=(count, 3)).astype(np.float32))


def upper_directions(normals: Rows, seed: int) -> Rows:
    """Random unit vectors on the outer side of `normals`."""
    found = directions(len(normals), seed)
    return np.where((found * normals).sum(1, keepdims=True) < 0, -found, found)


def two_paints(places: redmap.Places, to_light: Rows, to_viewer: Rows) -> Rows:
    """Two dull paints, one above the other."""
    cosine = np.clip((places.normal * to_light).sum(1, keepdims=True), 0, None)
    seen = (places.normal * to_viewer).sum(1, keepdims=True) > 0
    paint = np.where(places.position[:, 1:2] > 0, [[0.8, 0.1, 0.1]], [[0.1, 0.2, 0.7]])
    return np.asarray(paint * cosine * seen / np.pi, np.float32)


@pytest.fixture(scope="session")
def noise_map() -> redmap.ReductionMap:
    return redmap.bake(redmap.sphere(), redmap.shader("noise"), size=64)
