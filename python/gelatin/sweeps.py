"""Many runs: a scene with varied settings, or a function over samples, on the processors and machines that there are."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from numbers import Real
from pathlib import Path
from typing import Any, Literal, Union

from .arguments import wrong_type
from .errors import InvalidInput
from .scene import Scene, load
from .simulator import Simulator
from .sweep_cluster import connect, run_on
from .sweep_folder import Folder, Row, need
from .sweep_progress import Progress
from .sweep_run import Job, Run, make_run
from .sweep_settings import Plan, digest, is_drawn, plan_runs, scene_with, with_absolute_paths
from .sweep_statistics import chosen_statistics

#: How far seeds displace nodes where they decide nothing else, by the cube root of a body's volume.
SCATTER = 1e-4


def sweep(
    subject: Union[Scene, str, os.PathLike[str], Callable[[Run], Union[Mapping[str, Any], None]]],
    vary: Mapping[str, Any] | None = None,
    *,
    out: Union[str, os.PathLike[str]],
    samples: Iterable[Mapping[str, Any]] | None = None,
    seeds: Union[int, Iterable[int], None] = None,
    frames: int | None = None,
    record: int = 1,
    what: Sequence[str] | None = None,
    measure: Callable[[Simulator], Mapping[str, Any]] | None = None,
    backend: Literal["auto", "gl", "cpu"] = "cpu",
    scatter: float | None = None,
    cluster: Any = None,
    workers: int | None = None,
    threads: int = 1,
    retry_failed: bool = False,
    progress: bool = True,
) -> Any:
    """Makes all runs that the folder `out` does not have yet, and returns its table, a pyarrow.Table: a row for each run.

    >>> table = gelatin.sweep("scene.toml", {"material.jelly.youngs_modulus": [1e4, 1e5, 1e6]}, seeds=10, out="runs")
    >>> table.to_pandas()

    subject: what is run: a Scene, the path of a scene file; or a function, which gets a Run and returns a dict of columns.
    vary: the values of each setting, all combinations of which are run; or a Between, which each seed draws. Settings of
        scenes are the keys of docs/scene-files.md, as `object.ball.position`. Those of functions have any names.
    out: a folder, which all machines share. It has table.parquet, recordings and what functions write.
    samples: settings of one run each, in place of combinations, or to combine with those of `vary`.
    seeds: how many, or a list. Each combination is run with each seed, which decides draws, a function's `run.random`, and `scatter`.
    frames: length of each run; None: the scene's.
    record: every how many frames are recorded; 0: none.
    what: names of statistics, which docs/sweeps.md lists; None: all.
    measure: more columns, of each simulator at the end of its run.
    backend: with "gl" each worker has a GPU of its own.
    scatter: seeds displace each coordinate of free nodes at random by up to this times the cube root of the body's volume;
        None: 1e-4 where seeds decide nothing else, otherwise 0.
    cluster: address of a scheduler of Dask, or a Cluster or Client of its; None: a local one is started.
    workers: of the local cluster; None: as many as processors, or as GPUs. 0: this process makes the runs, one after the other.
    threads: processors for each run, which runs of the same worker share.
    retry_failed: makes runs again whose rows have an error.
    progress: shows the progress and the dashboard's address on stderr.

    Runs that fail are rows with the column `error`. Rows are written as runs finish, so that after a crash, of whatever, the
    same call makes what is missing.

    Raises InvalidInput before anything is run, for settings that there are not, values that are not allowed, and a folder with
    runs of another sweep; SystemError for a package or a cluster that is not there.
    """
    need("pyarrow")
    listed = None if samples is None else list(samples) if isinstance(samples, Iterable) else [samples]
    if listed is not None and not all(isinstance(sample, Mapping) for sample in listed):
        raise wrong_type("samples", samples, "a list of dicts")
    plans = plan_runs(vary or {}, listed, seeds)
    if scatter is None:
        scatter = SCATTER if seeds is not None and not callable(subject) and not is_drawn(vary or {}, listed) else 0.0
    _check_numbers(frames=frames, record=record, workers=workers, threads=threads, scatter=scatter)
    if threads < 1:
        raise InvalidInput(f"threads: {threads}: must be 1 or more")
    path = Path(out).absolute()
    job = _job(subject, path, frames, record, chosen_statistics(what), measure, backend, scatter)
    job.threads = None if workers == 0 else threads
    if not callable(job.subject):
        for plan in plans:
            scene_with(job.subject, plan.settings)
    with Folder(path, _definition(job)) as folder:
        rows = folder.rows()
        missing = [(plan, attempt) for plan in plans if (attempt := _next_attempt(rows.get(plan.name), retry_failed))]
        bar = Progress(len(plans), len(plans) - len(missing), progress)
        try:
            if missing:
                for row in _run_all(job, missing, bar, cluster, workers, threads):
                    rows[row["run"]] = row
                    bar.update(row)
                    if bar.is_time_for_table():
                        folder.write_table(_in_order(rows, plans))
            folder.remove_partial_files()
        finally:
            if rows:
                table = folder.write_table(_in_order(rows, plans))
        bar.finish(rows[plan.name] for plan in plans)
        return table


def _run_all(
    job: Job, missing: list[tuple[Plan, int]], bar: Progress, cluster: Any, workers: int | None, threads: int
) -> Iterator[Row]:
    if workers == 0:
        yield from (make_run(job, plan, attempt) for plan, attempt in missing)
        return
    with connect(cluster, workers, job.backend, threads, bar.is_shown) as client:
        bar.show_dashboard(client)
        yield from run_on(client, job, missing)


def _job(
    subject: Any,
    folder: Path,
    frames: int | None,
    record: int,
    what: list[str],
    measure: Callable[[Simulator], Mapping[str, Any]] | None,
    backend: Literal["auto", "gl", "cpu"],
    scatter: float,
) -> Job:
    if isinstance(subject, (str, os.PathLike)):
        subject = os.path.abspath(os.fspath(subject))
        of_scene = digest(load(subject))
    elif isinstance(subject, Scene):
        subject.validate()
        subject = with_absolute_paths(subject)
        of_scene = digest(subject)
    elif callable(subject):
        of_scene = ""
    else:
        raise InvalidInput(f"subject: must be a Scene, a scene file or a function, not {type(subject).__name__}")
    return Job(subject, folder, of_scene, frames, record, what, measure, backend, scatter, None)


def _definition(job: Job) -> dict[str, Any]:
    """What two calls for the same folder must have in common."""
    if callable(job.subject):
        return {"function": getattr(job.subject, "__qualname__", type(job.subject).__qualname__)}
    return {"scene": job.digest, "frames": job.frames, "backend": job.backend, "scatter": job.scatter}


def _check_numbers(**numbers: float | None) -> None:
    for name, value in numbers.items():
        if value is not None and not isinstance(value, Real):
            raise wrong_type(name, value, "a number, 0 or more")
        if value is not None and value < 0:
            raise InvalidInput(f"{name}: {value}: must be 0 or more")


def _next_attempt(row: Row | None, retry_failed: bool) -> int:
    """1 for the first one; 0: the run is done."""
    if row is None:
        return 1
    return int(row["attempt"]) + 1 if retry_failed and row["error"] is not None else 0


def _in_order(rows: dict[str, Row], plans: list[Plan]) -> list[Row]:
    """Those of this call first, in its order, then those of earlier ones."""
    names = [plan.name for plan in plans]
    order = [*names, *sorted(rows.keys() - set(names))]
    return [rows[name] for name in order if name in rows]
