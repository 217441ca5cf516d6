"""Bars of progress, where the package tqdm is installed, and numbers in texts."""

from __future__ import annotations

from collections.abc import Iterable


def frames_with_bar(frames: int) -> Iterable[int]:
    """0, 1, ... frames - 1, with a bar in notebooks and terminals."""
    try:
        from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]
    except ImportError:
        return range(frames)
    bar: Iterable[int] = tqdm(range(frames), unit="frame")
    return bar


def counted(count: int, what: str, plural: str = "") -> str:
    """ "1 run", "2 runs"; "1 body", "2 bodies"."""
    return f"{count} {what if count == 1 else plural or what + 's'}"
