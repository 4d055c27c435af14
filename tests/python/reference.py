"""What the tests of the Python modules share: both modules, reference files, tolerances. Their mathematics: double."""

import json
import os
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from libins import core, coref

ROOT = Path(__file__).resolve().parents[2]
Array = NDArray[np.float64]
both = pytest.mark.parametrize("ins", [core, coref], ids=["core", "coref"])


def load(name: str) -> Any:
    """A reference file, from the directory in INS_VECTOR_DIR or from the project's own."""
    folder = Path(os.environ.get("INS_VECTOR_DIR", ROOT / "tests/data/vectors"))
    return json.loads((folder / name).read_text(encoding="utf-8"))


def tolerance(ins: ModuleType, double: float, single: float) -> float:
    """Of double from the reference file; of float what its rounding leaves, as measured, times about 2."""
    return double if ins is core else single


def real(ins: ModuleType, values: ArrayLike) -> NDArray[Any]:
    """As the dtype of the module."""
    return np.asarray(values, dtype=ins.real)


def expect(got: ArrayLike, want: ArrayLike, limit: float, what: str, scale: ArrayLike = 1.0) -> None:
    """Every element within limit * scale; NaN is never within."""
    a, b = np.asarray(got, dtype=np.float64), np.asarray(want, dtype=np.float64)
    assert a.shape == b.shape and a.size > 0, f"{what}: shape {a.shape}, wanted {b.shape}"
    error = np.abs(a - b) / scale
    at = np.unravel_index(np.argmax(np.where(np.isnan(error), np.inf, error)), error.shape)
    assert error[at] <= limit, (
        f"{what}: at {at} got {a[at]!r}, want {b[at]!r}, off by {error[at]:.2e}, limit {limit:.0e}"
    )


def same_sign(q: ArrayLike, want: ArrayLike) -> Array:
    """q or -q, whichever is nearer: both are the same rotation."""
    q, want = np.asarray(q, dtype=np.float64), np.asarray(want, dtype=np.float64)
    return np.where(np.sum(q * want, axis=-1, keepdims=True) < 0, -q, q)


def rotation_between(a: ArrayLike, b: ArrayLike) -> Array:
    """Rotation vectors of a b*, in n."""
    a, b = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    w = np.sum(a * b, axis=-1, keepdims=True)
    v = -a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] - np.cross(a[..., 1:], b[..., 1:])
    v, w = np.where(w < 0, -v, v), np.abs(w)
    sine = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.where(sine > 0, 2 * np.arctan2(sine, w) / np.where(sine > 0, sine, 1), 2) * v


def angles_between(a: ArrayLike, b: ArrayLike) -> Array:
    """Angles of a b* [rad]."""
    return np.linalg.norm(rotation_between(a, b), axis=-1)


def wrapped(angle: ArrayLike) -> Array:
    """Into [-pi, pi)."""
    return (np.asarray(angle, dtype=np.float64) + np.pi) % (2 * np.pi) - np.pi
