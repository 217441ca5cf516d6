"""The folder of a sweep: rows, as runs finish, and the table that is made of them.

    sweep.json             what all runs have in common
    rows/RUN.json          a finished run; written by the process that made it
    recordings/RUN.gel     what was recorded
    files/RUN.*            what functions write
    errors/RUN.txt         where a function failed
    table.parquet          all rows, made of rows/ again and again
"""

from __future__ import annotations

import fcntl
import importlib
import json
import os
import secrets
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ._gelatin import commit, version
from .errors import InvalidInput, SystemError

Row = dict[str, Any]


def need(module: str) -> Any:
    """A module that only sweeps need. Raises SystemError if it is not installed."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as problem:
        raise SystemError(f"sweeps need the package {problem.name}: pip install '.[sweep]'") from None


def write_row(folder: Path, row: Row) -> None:
    """Completely or not at all. A row that was written survives whatever happens to the process."""
    write_whole(folder / "rows" / f"{row['run']}.json", json.dumps(row).encode())


def read_row(folder: Path, run: str) -> Row | None:
    """None: the run is not finished."""
    file = folder / "rows" / f"{run}.json"
    try:
        row: Row = json.loads(file.read_bytes())
    except FileNotFoundError:
        return None
    except ValueError:
        raise InvalidInput(f"{file}: is damaged; without it, the run is made again") from None
    return row


class Folder:
    """A sweep's folder, which one call uses at a time: `with Folder(out, definition) as folder`.

    definition: what all runs of the folder have in common.

    Raises InvalidInput if the folder has runs of another sweep, or another call is using it.
    """

    def __init__(self, path: Path, definition: dict[str, Any]) -> None:
        self.path = path
        try:
            for part in ("rows", "recordings", "files", "errors"):
                (path / part).mkdir(parents=True, exist_ok=True)
            self._lock = os.open(path / "lock", os.O_CREAT | os.O_RDWR, 0o644)
        except OSError as problem:
            raise SystemError(f"{path}: cannot be used as a folder: {problem.strerror}") from None
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(self._lock)
            raise InvalidInput(f"{path}: another sweep is using this folder") from None
        except OSError:
            pass  # a file system without locks
        try:
            self._define(definition)
        except BaseException:
            os.close(self._lock)
            raise

    def __enter__(self) -> Folder:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._lock)

    def _define(self, definition: dict[str, Any]) -> None:
        file = self.path / "sweep.json"
        if not any((self.path / "rows").glob("*.json")):  # nothing has been run yet
            made_by = {"gelatin": {"version": version(), "commit": commit()}}
            write_whole(file, (json.dumps({**definition, **made_by}, indent=1) + "\n").encode())
            return
        try:
            earlier = json.loads(file.read_text())
        except (OSError, ValueError):
            raise InvalidInput(f"{file}: is no description of a sweep, but there are rows") from None
        for name, value in definition.items():
            if earlier.get(name) != value:
                raise InvalidInput(
                    f"{self.path}: has runs of another sweep: its {name} was {earlier.get(name)!r}, now it is {value!r}; "
                    "another one needs another folder"
                )

    def rows(self) -> dict[str, Row]:
        """All finished runs by name."""
        found = (read_row(self.path, file.stem) for file in (self.path / "rows").glob("*.json"))
        return {row["run"]: row for row in found if row is not None}

    def write_table(self, rows: Iterable[Row]) -> Any:
        """Writes table.parquet, completely or not at all, and returns it as a pyarrow.Table."""
        parquet = need("pyarrow.parquet")
        table = table_of(list(rows))
        partial = self.path / "table.parquet.partial"
        parquet.write_table(table, partial)
        os.replace(partial, self.path / "table.parquet")
        return table

    def remove_partial_files(self) -> None:
        """Those of runs that were killed."""
        for file in self.path.glob("*/*.partial"):
            file.unlink(missing_ok=True)


def table_of(rows: list[Row]) -> Any:
    """A pyarrow.Table: a column for each name that a row has, with null where others lack it."""
    pyarrow = need("pyarrow")
    settings = {key: None for row in rows for key in row["settings"]}
    measured = {key: None for row in rows for key in row["measured"]}
    columns = {"run": [row["run"] for row in rows]}
    columns.update({key: [row["settings"].get(key) for row in rows] for key in settings})
    columns["seed"] = [row["seed"] for row in rows]
    columns.update({key: [row["measured"].get(key) for row in rows] for key in measured if key not in columns})
    for key in ("recording", "error", "warnings", "seconds", "worker"):
        columns[key] = [row[key] for row in rows]
    return pyarrow.table({key: _column(pyarrow, key, values) for key, values in columns.items()})


#: Columns of a known type, even where all values are null.
TYPES = {name: "string" for name in ("run", "recording", "error", "warnings", "worker")}
TYPES.update(seed="int64", seconds="float64")


def _column(pyarrow: Any, name: str, values: list[Any]) -> Any:
    if name in TYPES:
        return pyarrow.array(values, getattr(pyarrow, TYPES[name])())
    try:
        return pyarrow.array(values)
    except (pyarrow.ArrowInvalid, pyarrow.ArrowTypeError):  # of several types: "auto" and 4
        return pyarrow.array([None if value is None else json.dumps(value) for value in values])


def write_whole(file: Path, data: bytes) -> None:
    """Writes a file completely or not at all, also if the machine stops."""
    partial = partial_of(file)
    with open(partial, "wb") as out:
        out.write(data)
        out.flush()
        os.fsync(out.fileno())
    os.replace(partial, file)


def partial_of(file: Path) -> Path:
    """Where to write what becomes a file when it is complete: a name of this call alone."""
    return file.with_name(f"{file.name}.{secrets.token_hex(4)}.partial")
