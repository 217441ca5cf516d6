"""Two scenes with joints, on Gelatin and on peers that have joints and soft bodies, by turns; and the report."""

import datetime
import importlib
import importlib.metadata
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np

import comparison
import report
from jointed_measures import METERS
from jointed_scene import read_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"
PEERS = ["gelatin", "mujoco", "newton"]

EXPLANATION = """\
- **runs**: how many there were. What takes minutes has one.
- **wall**, **processor**: milliseconds a frame of 1/60 s, of the steps alone: the mean of a run's frames, the median of the
  runs. Gelatin's processor time is that of all its threads.
- **joint opens**: the greatest distance in any frame between where both bodies carry a point of a joint; of a slider across
  its axis.
- **rises**, **is carried**: how far the ball's centre of mass moves up and along x from when the lift begins (1.5 s) to when
  the fingers open (6 s).
- **slips**: the greatest displacement of that centre in the palm meanwhile, sideways and down. It **is dropped** if it slips
  down by 0.1 m.
- **car gets**: along x at the end. It **climbs the kerb** when all four wheels are on it.
- **tyre leaves its rim**: the greatest distance of a node that is glued to a rim from where the rim carries it.
"""


class Outcome:
    """What a peer did in a scene, in all its runs."""

    def __init__(self, peer, module, variant):
        self.peer, self.module, self.variant, self.settings = peer, module, variant, module.VARIANTS[variant]
        self.problem, self.remark, self.loading = "", "", None
        self.wall, self.processor, self.rows = [], [], None  # [s] a frame, of each run; what was measured in the first

    def read(self, folder):
        if not (folder / "frames.txt").exists():
            return
        lines = (folder / "frames.txt").read_text(encoding="ascii").split("\n")[:-1]  # the last one may be half a line
        if not lines:
            return
        rows = np.array([json.loads(line) for line in lines])
        self.wall.append(rows[:, 0].mean())
        self.processor.append(rows[:, 1].mean())
        if self.rows is None:
            self.rows = rows[:, 2:]
            self.loading = float((folder / "loading.txt").read_text(encoding="ascii"))
        if (folder / "remark.txt").exists():
            self.remark = (folder / "remark.txt").read_text(encoding="utf-8")


def export_scene(name, options):
    """@return the scene file and the VTU file of its start"""
    file, folder = SCENES / f"{name}.toml", options.work / "meshes" / name
    command = [options.gelatin, "run", file, "--frames", "0", "--quiet", "--backend", "cpu", "--export", folder]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"run.py: error: {file.name}: {done.stderr.strip()}")
    return file, folder / "frame_000000.vtu"


def run_scene(name, modules, options):
    """@return the number of frames, and all outcomes; engines take turns"""
    file, mesh = export_scene(name, options)
    scene = read_scene(file, mesh)
    frames = min(scene.frames, options.frames or scene.frames)
    outcomes = [Outcome(peer, module, variant) for peer, module in modules.items() for variant in module.VARIANTS]
    for turn in range(options.runs):
        for number, outcome in enumerate(outcomes):
            if outcome.problem or turn >= outcome.settings.get("runs", options.runs):
                continue
            print(f"{name}, run {turn + 1}: {outcome.module.TITLE}, {outcome.variant}", file=sys.stderr, flush=True)
            job = {"peer": outcome.peer, "variant": outcome.variant, "scene": str(file), "mesh": str(mesh)}
            job |= {"gelatin": str(options.gelatin), "measured": turn == 0}
            job["frames"] = min(frames, outcome.settings.get("frames", {}).get(name, frames))
            folder = options.work / "runs" / f"{name}-{outcome.peer}-{number}-{turn}"
            if not (options.reuse and (folder / "problem.txt").exists()):
                problem = comparison.run_job(job, folder, options.time_limit, "jointed_worker.py")
                (folder / "problem.txt").write_text(problem, encoding="utf-8")
            outcome.problem = (folder / "problem.txt").read_text(encoding="utf-8")
            outcome.read(folder)
    return scene, frames, outcomes


def table(name, scene, frames, outcomes):
    meter = METERS[name](scene)
    nodes = " + ".join(f"{len(soft.points):,}" for soft in scene.softs)
    tets = " + ".join(f"{len(soft.tets):,}" for soft in scene.softs)
    material = scene.softs[0].material
    text = f"## `scenes/{name}.toml`: {meter.TITLE}\n\n{len(scene.parts)} rigid bodies, {len(scene.joints)} joints; "
    text += f"{nodes} nodes and {tets} tets of {material['youngs_modulus'] / 1000:g} kPa, "
    text += f"Poisson's ratio {material['poisson_ratio']}, {material['density']} kg/m^3; {frames} frames.\n\n"
    head = ["", "threads", "frames", "runs", "wall [ms]", "processor [ms]", *meter.HEAD, "loading [s]"]
    text += report.row(head) + report.row(["---"] * len(head))
    notes = []
    for outcome in outcomes:
        title = f"{outcome.module.TITLE}, {outcome.variant}"
        threads = str(outcome.settings["threads"])
        if outcome.problem:
            notes.append(f"- {title}: {outcome.problem}.\n")
        if outcome.remark:
            notes.append(f"- {title}: {outcome.remark}.\n")
        if outcome.rows is None:
            text += report.row([title, threads, "0", *[""] * (len(head) - 3)])
            continue
        done = len(outcome.rows)
        cells, _ = meter.summary(np.arange(1, done + 1) * scene.step, outcome.rows)
        times = [f"{1000 * np.median(values):.1f}" for values in (outcome.wall, outcome.processor)]
        count = f"{done}" if done == frames else f"{done} of {frames}"
        loading = "" if outcome.peer == "gelatin" else f"{outcome.loading:.1f}"
        text += report.row([title, threads, count, str(len(outcome.wall)), *times, *cells, loading])
    return text + ("\n" + "".join(notes) if notes else "")


def version_of(module, program):
    return ", ".join(f"{package} {importlib.metadata.version(package)}" for package in module.PACKAGES) or program


def compare(options, install):
    """Prints the report, and writes it to `options.report`. @param install returns why it cannot install a package"""
    modules, missing = {}, []
    for peer in options.peers:
        module = importlib.import_module(f"jointed_{peer}")
        problem = " ".join(filter(None, map(install, module.PACKAGES)))
        if problem:
            missing.append(f"- {module.TITLE} cannot be installed: {problem}\n")
        else:
            modules[peer] = module
    program = subprocess.run([options.gelatin, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    results = [(name, *run_scene(name, modules, options)) for name in options.scenes]
    text = "# Peers on scenes with joints\n\n"
    text += f"{datetime.date.today()}; {program}; {report.processor()}, {os.cpu_count()} processors; {platform.system()}, "
    text += f"Python {platform.python_version()}. "
    text += f"Command: `bench/peers/run.py --joints`, at most {options.runs} runs by turns.\n"
    text += f"{options.note}\n" if options.note else ""
    text += "\n| | version | licence | settings |\n| --- | --- | --- | --- |\n"
    for module in modules.values():
        text += report.row([module.TITLE, version_of(module, program), module.LICENCE, module.NOTES])
    text += "\n" + "".join(missing) if missing else ""
    for result in results:
        text += "\n" + table(*result)
    text += "\n## Columns\n\n" + EXPLANATION
    print(text, end="")
    if options.report:
        options.report.write_text(text, encoding="utf-8")
