"""Checks of what callers give. Each problem is one line: the argument, its value, what is allowed."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from .errors import InvalidInput

LARGEST = 2**31 - 1


def shown(value: object) -> str:
    """A value for a message: as Python writes it if that is short, else its type."""
    text = repr(value)
    return text if len(text) <= 60 and text.isprintable() else type(value).__name__


def wrong_type(name: str, value: object, allowed: str) -> TypeError:
    return TypeError(f"{name} = {shown(value)}: must be {allowed}")


def whole_number(name: str, value: Any, least: int = 0) -> int:
    """Raises TypeError for what is no integer, InvalidInput for one that is not allowed."""
    try:
        number = operator.index(value)
    except TypeError:
        raise wrong_type(name, value, f"an integer, {least} or more") from None
    if not least <= number <= LARGEST:
        raise InvalidInput(f"{name} = {number}: must be {f'{least} or more' if number < least else f'at most {LARGEST}'}")
    return number


def number(name: str, value: Any, may_be_zero: bool = True) -> float:
    """Finite. Raises TypeError for what is no number, InvalidInput for one that is not allowed."""
    allowed = f"a finite number{', 0 or more' if may_be_zero else ' above 0'}"
    try:
        found = float(value + 0.0)  # not of a text
    except TypeError:
        raise wrong_type(name, value, allowed) from None
    if not (0.0 < found < float("inf") or (may_be_zero and found == 0.0)):
        raise InvalidInput(f"{name} = {found}: must be {allowed}")
    return found


def numbers(name: str, value: Any, allowed: str) -> npt.NDArray[np.float64]:
    """An array of any shape. Raises TypeError for what is none."""
    try:
        return np.array(value, np.float64)
    except (TypeError, ValueError):
        raise wrong_type(name, value, allowed) from None


def vector(name: str, value: Any) -> npt.NDArray[np.float64]:
    """Shape (3,), finite. Raises TypeError for what is no vector, InvalidInput for another one."""
    allowed = "three finite numbers"
    found = numbers(name, value, allowed)
    if found.shape != (3,) or not np.isfinite(found).all():
        raise InvalidInput(f"{name} = {shown(value)}: must be {allowed}")
    return found


def vectors(name: str, value: Any, *axes: str) -> npt.NDArray[np.float64]:
    """A copy of the shape (*axes, 3), in C's order. Raises TypeError for what is no array of numbers, InvalidInput for another shape."""
    allowed = f"the shape ({', '.join(axes)}, 3)"
    found = numbers(name, value, f"numbers of {allowed}")
    if found.ndim != len(axes) + 1 or found.shape[-1] != 3:
        raise InvalidInput(f"{name} must have {allowed}, not {found.shape}")
    return np.ascontiguousarray(found)


def text(name: str, value: Any) -> str:
    """Raises TypeError for what is no text, InvalidInput for one that UTF-8 does not have."""
    if not isinstance(value, str):
        raise wrong_type(name, value, "a str")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise InvalidInput(f"{name} = {value!a}: must be Unicode, without surrogates") from None
    return value


def path(name: str, value: Any) -> str:
    """Raises TypeError for what is no path, InvalidInput as `text`."""
    try:
        found = os.fsdecode(value)
    except TypeError:
        raise wrong_type(name, value, "a path") from None
    return text(name, found)


def texts(name: str, value: Union[str, Iterable[str]]) -> list[str]:
    """Of a list, or of one text that is given in its place."""
    listed = [value] if isinstance(value, str) else list(value) if isinstance(value, Iterable) else [value]
    if not all(isinstance(element, str) for element in listed):
        raise wrong_type(name, value, "a list of str")
    return [text(name, element) for element in listed]


def check_function(name: str, value: object) -> None:
    if not callable(value):
        raise wrong_type(name, value, "a function")


def path_ending(file: Any, ending: str) -> str:
    """A path. Raises InvalidInput for one of another name, and as `path`."""
    found = path("file", file)
    if os.path.splitext(found)[1].lower() != ending:
        raise InvalidInput(f"file = {found}: must end in {ending}")
    return found
