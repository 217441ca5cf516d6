"""Runs the jobs one after the other and measures what they leave behind."""

import importlib
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import measures
import report
from bodies import read_scene

HERE = Path(__file__).resolve().parent
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "LP_NUM_THREADS"), "1")


@dataclass
class Outcome:
    """What a peer did in a scene."""

    peer: str
    variant: str
    problem: str = ""  # why it stopped before the last frame
    loading: float | None = None  # [s]
    times: np.ndarray = field(default_factory=lambda: np.empty(0))  # of each frame [s]
    smallest_volume: float = np.nan  # of a body, relative to its volume at rest
    lowest: float = np.nan  # height of the lowest node [m]
    first_momentum: np.ndarray | None = None  # [kg m/s]
    momentum: np.ndarray | None = None  # of each frame
    crossings: np.ndarray = field(default_factory=lambda: np.empty(0, int))  # of each frame


def export_scene(name, options):
    """@return the scene file and the VTU file of its start"""
    file, folder = HERE / f"scene_{name.lower()}.toml", options.work / "meshes" / name
    command = [options.gelatin, "run", file, "--frames", "0", "--quiet", "--backend", "cpu", "--export", folder]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"run.py: error: {file.name}: {done.stderr.strip()}")
    return file, folder / "frame_000000.vtu"


def run_job(job, folder, time_limit, program="worker.py"):
    """@return why the worker stopped early, or nothing"""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "job.json").write_text(json.dumps(job), encoding="utf-8")
    with open(folder / "log.txt", "w", encoding="utf-8") as log:
        worker = subprocess.Popen(
            [sys.executable, HERE / program, "job.json"],
            cwd=folder,
            stdout=log,
            stderr=log,
            env=os.environ | ONE_THREAD,
            start_new_session=True,
        )
        try:
            code = worker.wait(time_limit)
        except subprocess.TimeoutExpired:
            last = max((file.stat().st_mtime for file in folder.glob("times.txt")), default=time.time() - time_limit)
            waited = time.time() - last
            os.killpg(worker.pid, signal.SIGKILL)
            worker.wait()
            return f"stopped after {time_limit} s, the last {waited:.0f} s of them without a frame"
        except BaseException:  # Ctrl-C: the worker is in a session of its own
            os.killpg(worker.pid, signal.SIGKILL)
            raise
    if code < 0:
        return f"killed by {signal.Signals(-code).name}"
    lines = (folder / "log.txt").read_text(encoding="utf-8", errors="replace").strip().splitlines()
    return (lines or ["failed"])[-1] if code else ""


def measure(scene, folder, outcome):
    """Reads what the worker has written, of all frames that are complete."""
    if not (folder / "times.txt").exists():
        return
    outcome.loading = float((folder / "loading.txt").read_text(encoding="ascii"))
    times = (folder / "times.txt").read_text(encoding="ascii").split("\n")[:-1]  # the last line may be half a line
    outcome.times = np.array(times, float)
    size = scene.positions.size
    states = np.fromfile(folder / "states.bin", float, count=size * (len(times) + 1)).reshape(-1, *scene.positions.shape)
    if not len(times):
        return
    meter = measures.Measure(scene, np.load(folder / "masses.npy"))
    outcome.smallest_volume = min(min(meter.volume_ratios(state)) for state in states[1:])
    outcome.lowest = states[1:, :, 1].min()
    outcome.first_momentum = meter.first_momentum()
    outcome.momentum = np.array([meter.momentum(*pair) for pair in zip(states, states[1:])])
    outcome.crossings = np.array([meter.crossings(state) for state in states[1:]])


def compare(options, install):
    """Prints the report, and writes it to `options.report`. @param install returns why it cannot install a package"""
    measures.check()
    if options.check:
        print("the counter of crossings passes its test")
        return
    modules = {name: importlib.import_module(f"{name}_peer") for name in options.peers}
    missing = {name: " ".join(filter(None, map(install, module.PACKAGES))) for name, module in modules.items()}
    results = []
    for name in options.scenes:
        file, mesh = export_scene(name, options)
        scene = read_scene(file, mesh)
        frames = min(scene.frames, options.frames or scene.frames)
        outcomes = []
        for peer, module in modules.items():
            for number, variant in enumerate(module.VARIANTS):
                outcome = Outcome(peer, variant, missing[peer] and f"cannot be installed: {missing[peer]}")
                outcomes.append(outcome)
                if outcome.problem:
                    continue
                print(f"{name}: {module.TITLE}, {variant}", file=sys.stderr, flush=True)
                job = {"peer": peer, "variant": variant, "scene": str(file), "mesh": str(mesh)}
                job |= {"frames": frames, "gelatin": str(options.gelatin)}
                folder = options.work / "runs" / f"{name}-{peer}-{number}"
                if not (options.reuse and (folder / "problem.txt").exists()):
                    problem = run_job(job, folder, options.time_limit)
                    (folder / "problem.txt").write_text(problem, encoding="utf-8")
                outcome.problem = (folder / "problem.txt").read_text(encoding="utf-8")
                measure(scene, folder, outcome)
        results.append((name, scene, frames, outcomes))
    text = report.describe(options, modules, results)
    print(text, end="")
    if options.report:
        options.report.write_text(text, encoding="utf-8")
