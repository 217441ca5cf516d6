"""Runs on Dask: a cluster of this machine's own, or one that exists."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import logging
import os
import pickle
import secrets
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .errors import InvalidInput, SystemError
from .sweep_folder import Row, need, write_whole
from .sweep_run import Job, gpus, make_run, write_dead_run
from .sweep_settings import Plan


@contextlib.contextmanager
def connect(cluster: Any, workers: int | None, backend: str, threads: int, dashboard: bool) -> Iterator[Any]:
    """A dask.distributed.Client.

    cluster: address of a scheduler, a cluster or client of Dask's; None: a local one is started, and stopped afterwards.
    """
    distributed = need("distributed")
    if isinstance(cluster, distributed.Client):
        yield cluster
    elif cluster is not None:
        with contextlib.ExitStack() as stack:
            try:
                client = stack.enter_context(distributed.Client(cluster, timeout=20))
            except (OSError, ValueError, TypeError) as problem:
                raise SystemError(f"{cluster}: no scheduler of Dask answers there: {str(problem).splitlines()[0]}") from None
            yield client
    else:
        count = workers or (len(gpus()) or 1 if backend == "gl" else max(1, _processors() // threads))
        with _without_main(), _local_cluster(distributed, count, dashboard) as local, distributed.Client(local) as client:
            yield client


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextlib.contextmanager
def _local_cluster(distributed: Any, workers: int, dashboard: bool) -> Iterator[Any]:
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Port .* is already in use")  # then it has another one, which is printed
        cluster = distributed.LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            dashboard_address="127.0.0.1:8787" if dashboard else None,
            silence_logs=logging.CRITICAL,  # what becomes of runs is in the table
        )
    with cluster:
        yield cluster


@contextlib.contextmanager
def _without_main() -> Iterator[None]:
    """Workers that start meanwhile do not import the script that calls, which would start its sweep once more in each."""
    main = sys.modules["__main__"]
    saved = {name: value for name, value in vars(main).items() if name in ("__file__", "__spec__")}
    vars(main).pop("__file__", None)
    main.__spec__ = None
    try:
        yield
    finally:
        vars(main).update(saved)


def run_on(client: Any, job: Job, plans: list[tuple[Plan, int]]) -> Iterator[Row]:
    """Makes runs, each with its attempt, and gives their rows as they finish."""
    distributed = need("distributed")
    file, token = _write_job(job)
    _check_folder(client, job.folder)
    futures = client.map(
        functools.partial(_run_of_job, file, token),
        [plan for plan, _ in plans],
        [attempt for _, attempt in plans],
        key=[f"gelatin-{token}-{plan.name}-{attempt}" for plan, attempt in plans],
    )
    open_runs = {future.key: (future, plan, attempt) for future, (plan, attempt) in zip(futures, plans)}
    try:
        waiting = distributed.as_completed(futures, with_results=True, raise_errors=False)
        del futures  # so that what has been read is forgotten, here and by the scheduler
        for batch in waiting.batches():
            for future, result in batch:
                _, plan, attempt = open_runs.pop(future.key)
                yield _row_of(result, job, plan, attempt)
    finally:
        if open_runs:
            with contextlib.suppress(Exception):
                client.cancel([future for future, _, _ in open_runs.values()], force=True)


def _row_of(result: Any, job: Job, plan: Plan, attempt: int) -> Row:
    """The row of a run, from what Dask has read: a row, an error as (type, exception, traceback), or that it was cancelled.

    The future is not asked: when its worker has died since, it counts as lost, although its row was read.
    """
    if isinstance(result, dict):
        return result
    if isinstance(result, tuple):
        problem = result[1]
        if type(problem).__name__ == "KilledWorker":
            return write_dead_run(job, plan, attempt)
        raise problem  # not the run's, whose row has its error: of the folder, or of Dask
    raise SystemError("the cluster has gone, or lost its runs; call again to complete what is missing")


def _write_job(job: Job) -> tuple[Path, str]:
    """Where workers read what all runs have in common, whenever they started: a file, and a hash of it.

    Keys of Dask's tasks have the hash: what workers still run for a client that was killed is not run beside them.
    """
    file = job.folder / "job.pickle"
    data = need("cloudpickle").dumps(job)
    write_whole(file, data)
    return file, hashlib.sha256(data).hexdigest()[:12]


@functools.lru_cache(maxsize=2)
def _job_at(file: Path, token: str) -> Job:
    job: Job = pickle.loads(file.read_bytes())
    return job


def _run_of_job(file: Path, token: str, plan: Plan, attempt: int) -> Row:
    return make_run(_job_at(file, token), plan, attempt)


def _check_folder(client: Any, folder: Path) -> None:
    """Every worker sees the folder that this process sees."""
    token = secrets.token_hex(8)
    file = folder / "seen_by_all"
    file.write_text(token)
    try:
        client.wait_for_workers(1)
        for worker, seen in client.run(_sees, file, token).items():
            if not seen:
                raise InvalidInput(f"{folder}: the worker {worker} has no such folder; all machines must share it")
    finally:
        file.unlink(missing_ok=True)


def _sees(file: Path, token: str) -> bool:
    try:
        return file.read_text() == token
    except OSError:
        return False
