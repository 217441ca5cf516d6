"""One run of a sweep, in whichever process makes it."""

from __future__ import annotations

import contextlib
import fcntl
import functools
import logging
import os
import socket
import tempfile
import threading
import time
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Union

import numpy as np

from .errors import Error, InvalidInput, NoOpenGl
from .scene import Scene
from .shapes import Mesh
from .simulator import Simulator
from .sweep_folder import Row, partial_of, read_row, write_row
from .sweep_settings import RESERVED, Plan, digest, plain, scene_with
from .sweep_statistics import Statistics


class Run:
    """One run, as a function that is swept gets it."""

    def __init__(self, plan: Plan, folder: Path) -> None:
        #: twelve hexadecimal digits, the same whenever these settings are run with this seed
        self.name = plan.name
        #: the values of this run
        self.settings = plan.settings
        #: None: the sweep has no seeds
        self.seed = plan.seed
        #: of the whole sweep
        self.folder = folder

    def __getitem__(self, key: str) -> Any:
        """A setting. Raises KeyError."""
        if key not in self.settings:
            raise KeyError(f"there is no setting '{key}'; there are {', '.join(self.settings)}")
        return self.settings[key]

    @functools.cached_property
    def random(self) -> np.random.Generator:
        """Random numbers of this seed: the same in each run that has it. Raises InvalidInput for a sweep without seeds."""
        if self.seed is None:
            raise InvalidInput("random numbers need seeds: gelatin.sweep(..., seeds=10)")
        return np.random.default_rng(self.seed)

    def file(self, name: str) -> Path:
        """Where to write a file of this run: `files/RUN.NAME` in the sweep's folder. Return it, and the table has its path."""
        return self.folder / "files" / f"{self.name}.{name}"


@dataclass
class Job:
    """What all runs of a call have in common."""

    #: a scene, the path of a scene file, or a function
    subject: Union[Scene, str, Callable[[Run], Union[Mapping[str, Any], None]]]
    folder: Path
    #: of the scene without changes
    digest: str
    frames: int | None
    #: every how many frames are recorded; 0: none
    record: int
    what: Sequence[str]
    measure: Callable[[Simulator], Mapping[str, Any]] | None
    backend: Literal["auto", "gl", "cpu"]
    #: how far seeds displace nodes, by the cube root of the body's volume
    scatter: float
    #: processors for each run; None: all
    threads: int | None


def make_run(job: Job, plan: Plan, attempt: int) -> Row:
    """Makes a run, whatever comes of it, and writes its row before it returns it.

    A run that is finished already is not made again: its worker died after writing the row, and Dask has lost the result.
    """
    done = read_row(job.folder, plan.name)
    if done is not None and done["attempt"] >= attempt:
        return done
    began = time.monotonic()
    warnings: list[str] = []
    row: Row = {"run": plan.name, "settings": plan.settings, "seed": plan.seed, "measured": {}}
    row.update({"recording": None, "error": None, "attempt": attempt})
    try:
        limit_threads(job.threads)
        with _collected(warnings):
            if callable(job.subject):
                row["measured"] = _columns(job.subject(Run(plan, job.folder)), plan, job.folder)
            else:
                _simulate(job, plan, row)
    except Exception as problem:
        row["error"] = _one_line(problem)
        if not isinstance(problem, Error):
            (job.folder / "errors" / f"{plan.name}.txt").write_text(traceback.format_exc())
    row["warnings"] = "; ".join(warnings) or None
    row["seconds"] = time.monotonic() - began
    row["worker"] = f"{socket.gethostname()}:{os.getpid()}"
    write_row(job.folder, row)
    return row


@contextlib.contextmanager
def _collected(texts: list[str]) -> Iterator[None]:
    """Gelatin's warnings go to a list, each once, instead of to the log, where nobody could say of which run they are."""
    handler = logging.Handler(logging.WARNING)
    handler.emit = lambda record: texts.append(record.getMessage()) if record.getMessage() not in texts else None  # type: ignore[method-assign]
    logger = logging.getLogger("gelatin")
    propagated, logger.propagate = logger.propagate, False
    logger.addHandler(handler)
    try:
        yield
    finally:
        logger.removeHandler(handler)
        logger.propagate = propagated


def write_dead_run(job: Job, plan: Plan, attempt: int) -> Row:
    """The row of a run whose processes died, written by another one."""
    done = read_row(job.folder, plan.name)
    if done is not None and done["attempt"] >= attempt:
        return done
    row: Row = {"run": plan.name, "settings": plan.settings, "seed": plan.seed, "measured": {}, "recording": None}
    row.update(error="WorkerDied: each process that made this run died: killed, or out of memory", warnings=None)
    row.update(attempt=attempt, seconds=None, worker=None)
    write_row(job.folder, row)
    return row


def _simulate(job: Job, plan: Plan, row: Row) -> None:
    assert not callable(job.subject)
    if isinstance(job.subject, str) and _digest_of_file(job.subject) != job.digest:
        raise InvalidInput(f"{job.subject}: has changed since the sweep began")
    scene = scene_with(job.subject, plan.settings)
    frames = scene.simulation.frames if job.frames is None else job.frames
    sim = Simulator(scene, job.backend, gl_device=_own_gpu() if job.backend == "gl" else None)
    if plan.seed is not None and job.scatter > 0:
        scatter_nodes(sim, Run(plan, job.folder).random, job.scatter)
    statistics = Statistics(job.what)
    try:
        if job.record:
            _record(job, plan, row, lambda: statistics.follow(sim, frames), sim)
        else:
            statistics.follow(sim, frames)
    finally:
        row["measured"] = statistics.columns()  # of a run that fails, too
    if job.measure is not None:
        row["measured"].update(_columns(job.measure(sim), plan, job.folder))


def _record(job: Job, plan: Plan, row: Row, follow: Callable[[], None], sim: Simulator) -> None:
    """Records a run; of one that fails, what came before."""
    file = job.folder / "recordings" / f"{plan.name}.gel"
    partial = partial_of(file)
    try:
        with sim.record(partial, every=job.record):
            follow()
    finally:
        if partial.exists():
            os.replace(partial, file)
            row["recording"] = f"recordings/{file.name}"


def scatter_nodes(sim: Simulator, random: np.random.Generator, amount: float) -> None:
    """Displaces the free nodes at random, each coordinate by up to `amount` times the cube root of the body's volume."""
    for body in sim:
        reach = amount * body.rest_volume ** (1 / 3)
        body.set_positions(body.positions + random.uniform(-reach, reach, (len(body), 3)).astype(np.float32))


def _columns(returned: Mapping[str, Any] | None, plan: Plan, folder: Path) -> dict[str, Any]:
    """What a user's function returned, as values for the table. Paths are relative to the folder."""
    if not isinstance(returned, (Mapping, type(None))):
        raise InvalidInput(f"the function must return a dict of columns, or None, not {type(returned).__name__}")
    columns: dict[str, Any] = {}
    for name, value in (returned or {}).items():
        if not isinstance(name, str) or name in RESERVED or name in plan.settings:
            raise InvalidInput(f"{name!r}: is the name of another column, or no name")
        if isinstance(value, Path):
            value = value.relative_to(folder) if value.is_relative_to(folder) else value
        columns[name] = plain(value, name)
    return columns


def _one_line(problem: BaseException) -> str:
    text = " ".join(str(problem).split())
    return f"{type(problem).__name__}: {text}" if text else type(problem).__name__


@functools.lru_cache(maxsize=8)
def _digest_at(path: str, changed: int, size: int) -> str:
    return digest(scene_with(path, {}))


def _digest_of_file(path: str) -> str:
    status = os.stat(path)
    return _digest_at(path, status.st_mtime_ns, status.st_size)


# Processors and GPUs


def one_tet() -> Scene:
    """What takes no time to simulate."""
    scene = Scene()
    scene.add_material("m", model="neo_hookean")
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    scene.add("tet", Mesh(vertices, tets=[[0, 1, 2, 3]]), material="m")
    return scene


_threads_are_limited = threading.Event()


def limit_threads(threads: int | None) -> None:
    """Has the simulators of this process use so many processors together; None: all. The first call counts.

    The library counts those that the process may use when it first simulates, and never again.
    """
    if threads is None or _threads_are_limited.is_set() or not hasattr(os, "sched_setaffinity"):
        return
    _threads_are_limited.set()
    allowed = os.sched_getaffinity(0)
    process = os.getpid()
    os.sched_setaffinity(process, set(sorted(allowed)[:threads]))
    try:
        Simulator(one_tet(), "cpu").step(1)
    finally:
        os.sched_setaffinity(process, allowed)


@functools.lru_cache(maxsize=None)
def gpus() -> list[int]:
    """The EGL devices of this machine that are GPUs."""
    found = []
    for device in range(64):
        try:
            name = Simulator(one_tet(), "gl", gl_device=device).device
        except (NoOpenGl, InvalidInput):
            break
        if not any(driver in name.lower() for driver in ("llvmpipe", "softpipe", "swrast")):
            found.append(device)
    return found


@functools.lru_cache(maxsize=None)
def _own_gpu() -> int | None:
    """A GPU that no other worker of this machine has, as long as there is one; None: the driver's choice."""
    for device in gpus():
        file = os.open(Path(tempfile.gettempdir()) / f"gelatin_gpu_{device}_{os.getuid()}.lock", os.O_CREAT | os.O_RDWR, 0o644)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)  # until the process ends
        except OSError:
            os.close(file)
            continue
        return device
    return gpus()[os.getpid() % len(gpus())] if gpus() else None
