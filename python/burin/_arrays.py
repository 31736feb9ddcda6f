"""Arrays as the library takes them, checked as far as it cannot: types, shapes, numbers that would not fit."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._core import UsageError

Floats = npt.NDArray[np.float32]
Integers = npt.NDArray[np.int32]


def floats(name: str, values: Any, columns: int, rows: Optional[int] = None) -> Floats:
    """(rows, columns) numbers in single precision; one column: (rows,)."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub" or array.dtype.itemsize > 8:
        raise UsageError(f"{name}: must be real numbers, not {array.dtype}")
    shape = (array.size,) if columns == 1 else (len(array) if array.ndim else 0, columns)
    if array.shape != shape or (rows is not None and shape[0] != rows):
        wanted = f"({'N' if rows is None else rows},{'' if columns == 1 else f' {columns}'})"
        raise UsageError(f"{name}: must have the shape {wanted}, not {array.shape}")
    with np.errstate(over="ignore"):
        return np.ascontiguousarray(array, np.float32)


def integers(name: str, values: Any) -> Integers:
    """Integers of 32 bits, of the same shape."""
    array = np.asarray(values)
    if array.size == 0:
        return np.zeros(array.shape, np.int32)
    if array.dtype.kind not in "iu":
        raise UsageError(f"{name}: must be integers, not {array.dtype}")
    limits = np.iinfo(np.int32)
    if array.dtype.itemsize > 4 or array.dtype == np.uint32:
        for bad in (array.min(), array.max()):
            if not limits.min <= int(bad) <= limits.max:
                raise UsageError(f"{name}: {bad} does not fit into 32 bits")
    return np.ascontiguousarray(array, np.int32)


def middle_of(points: Any) -> Optional[npt.NDArray[np.float64]]:
    """Where to put the origin of points whose double precision would be lost; None: nothing would."""
    array = np.asarray(points)
    if array.dtype != np.float64 or array.ndim != 2 or array.size == 0 or not np.all(np.isfinite(array)):
        return None
    low, high = array.min(axis=0), array.max(axis=0)
    middle = low + (high - low) / 2
    far = float(np.abs(middle).max()) > 16 * float((high - low).max())
    return middle if far else None


def matrix(name: str, values: Any) -> list[float]:
    """16 numbers, row by row, of a (4, 4) or (3, 4) matrix that takes columns; None: all 0."""
    if values is None:
        return [0.0] * 16
    array = np.asarray(values)
    if array.dtype.kind not in "fiu" or array.shape not in ((4, 4), (3, 4)):
        raise UsageError(f"{name}: must be a matrix of real numbers of the shape (4, 4) or (3, 4)")
    if not np.any(array):
        raise UsageError(f"{name}: is all 0")
    full = np.eye(4)
    full[: array.shape[0]] = array
    return [float(x) for x in full.ravel()]
