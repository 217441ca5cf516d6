"""Runs that are recorded, and played again."""

from __future__ import annotations

import os
from types import TracebackType
from typing import TYPE_CHECKING

from . import _gelatin
from .arguments import path, whole_number

if TYPE_CHECKING:
    from .simulator import Simulator


class Recorder:
    """Records frames of a simulator while a `with` block runs: what `Simulator.record` returns."""

    def __init__(self, simulator: Simulator, file: str | os.PathLike[str], every: int) -> None:
        self._every = whole_number("every", every, least=1)
        self._simulator = simulator
        self._writer = _gelatin.record(path("file", file), simulator._core)
        self._written = -1
        self._write()

    def __enter__(self) -> Recorder:
        self._simulator.on_frame(self._write_if_due)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._simulator.remove_callback(self._write_if_due)
        if kind is None and self._simulator.frame > self._written:
            self._write()  # the last one, from which a run can continue
        self._writer.finish()

    def _write_if_due(self, simulator: Simulator) -> None:
        if simulator.frame % self._every == 0:
            self._write()

    def _write(self) -> None:
        if self._written != self._simulator.frame:
            self._writer.write(self._simulator._core)
            self._written = self._simulator.frame
