"""Values of parameters, checked where users call: errors say the parameter, what it must be and what was given."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable, Iterable
from typing import Any, Optional

import numpy as np

from ._core import UsageError


def refused(name: str, wanted: str, value: Any) -> UsageError:
    given = repr(value)
    return UsageError(f"{name}: must be {wanted}, not {given if len(given) <= 80 else given[:77] + '...'}")


def whole(name: str, value: Any, bits: int = 32) -> int:
    """An integer that fits: signed, or unsigned of 64 bits. 640.0 is one, too."""
    try:
        is_float = isinstance(value, (float, np.floating)) and float(value).is_integer()
        number = int(value) if is_float else operator.index(value)
    except TypeError:
        raise refused(name, "a whole number", value) from None
    low, high = (0, 2**64) if bits == 64 else (-(2**31), 2**31)
    if not low <= number < high:
        raise refused(name, f"a whole number from {low} to {high - 1}", value)
    return number


def _are_finite(values: Any, shape: tuple[int, ...]) -> bool:
    try:
        array = np.asarray(values)
        return array.shape == shape and array.dtype.kind in "fiu" and bool(np.all(np.isfinite(array)))
    except (TypeError, ValueError):  # such as lists of several lengths
        return False


def real(name: str, value: Any) -> float:
    """A finite number."""
    if not _are_finite(value, ()):
        raise refused(name, "a finite number", value)
    return float(value)


def reals(name: str, values: Any, count: int, wanted: str) -> list[float]:
    """As many finite numbers."""
    if not _are_finite(values, (count,)):
        raise refused(name, wanted, values)
    return [float(value) for value in values]


def wholes(name: str, values: Any, count: int, wanted: str) -> list[int]:
    """As many integers."""
    try:
        numbers = [whole(name, value) for value in values]
    except (TypeError, UsageError):
        numbers = []
    if len(numbers) != count:
        raise refused(name, wanted, values)
    return numbers


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise refused(name, "a text (str)", value)
    try:
        is_right = "\0" not in value and value.encode() is not None
    except UnicodeEncodeError:
        is_right = False
    if not is_right:
        raise refused(name, "a text of UTF-8 without NUL characters", value)
    return value


def text_or_none(name: str, value: Any) -> Optional[str]:
    return None if value is None else text(name, value)


def texts(name: str, values: Any) -> list[str]:
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise refused(name, "a list of texts (str)", values)
    return [text(name, value) for value in values]


def function(name: str, value: Any) -> Callable[..., Any]:
    if not callable(value):
        raise refused(name, "a function", value)
    return value  # type: ignore[no-any-return]


def path(name: str, value: Any) -> str:
    """The name of a file or folder."""
    if not isinstance(value, (str, os.PathLike)):
        raise refused(name, "a file's name (str or os.PathLike)", value)
    return text(name, os.fspath(value))
