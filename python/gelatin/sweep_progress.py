"""How far a sweep is, on stderr."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable
from typing import Any

from .progress import counted
from .sweep_folder import Row

#: How often the table is written while runs go on [s].
TABLE_INTERVAL = 30.0


class Progress:
    """A line that changes on a terminal; elsewhere a line after every tenth of the runs."""

    def __init__(self, runs: int, done: int, is_shown: bool) -> None:
        self.is_shown = is_shown
        self._runs = runs
        self._done_before = done
        self._done = done
        self._failed = 0
        self._began = self._table_written = self._shown = time.monotonic()
        if done:
            self._print(f"{done} of {counted(runs, 'run')} are done already")

    def show_dashboard(self, client: Any) -> None:
        link = getattr(client, "dashboard_link", None)
        self._began = time.monotonic()  # a cluster takes seconds to start
        workers = len(client.nthreads())
        self._print(f"{counted(workers, 'worker')}" + (f"; dashboard: {link}" if link else ""))

    def update(self, row: Row) -> None:
        self._done += 1
        self._failed += row["error"] is not None
        if not self.is_shown:
            return
        now = time.monotonic()
        if sys.stderr.isatty():
            if now - self._shown > 0.1 or self._done == self._runs:
                self._shown = now
                sys.stderr.write("\r\x1b[K" + self._text(now) + ("\n" if self._done == self._runs else ""))
                sys.stderr.flush()
        elif self._done * 10 // self._runs > (self._done - 1) * 10 // self._runs:
            self._print(self._text(now))

    def is_time_for_table(self) -> bool:
        if time.monotonic() - self._table_written < TABLE_INTERVAL:
            return False
        self._table_written = time.monotonic()
        return True

    def finish(self, rows: Iterable[Row]) -> None:
        failed = sum(row["error"] is not None for row in rows)
        if failed:
            self._print(f"{failed} of {counted(self._runs, 'run')} failed: the column error says why")

    def _text(self, now: float) -> str:
        rate = (self._done - self._done_before) / max(now - self._began, 1e-9)
        failed = f", {self._failed} failed" if self._failed else ""
        left = f", {_duration((self._runs - self._done) / rate)} left" if self._done < self._runs else ""
        return f"{self._done} of {counted(self._runs, 'run')}{failed}, {rate:.3g} runs/s{left}"

    def _print(self, text: str) -> None:
        if self.is_shown:
            print(text, file=sys.stderr, flush=True)


def _duration(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.0f} s"
    minutes = seconds / 60
    return f"{minutes:.0f} min" if minutes < 90 else f"{minutes / 60:.1f} h"
