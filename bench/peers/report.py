"""The comparison as Markdown."""

import datetime
import importlib.metadata
import os
import platform
import subprocess

import numpy as np

TITLES = {
    "A": "three balls fall on a floor and on each other",
    "B": "two balls meet head on, without gravity",
}

EXPLANATION = """\
- **mean**, **median**, **worst**: wall-clock milliseconds of a frame of 1/60 s, of the step alone.
- **relative**: the time of these frames, divided by that of Gelatin's first row for the same frames.
- **volume**: the smallest of a body in any frame, relative to its volume at rest.
- **crossings**: pairs of an edge of one body's surface and a face of another's that it passes through, counted in double
  precision after each frame: the most in a frame, at the end, and the number of frames with any.
- **below the floor**: the greatest depth of a node [mm].
- **momentum**: along x at the end, by the mean velocities of the last frame [kg m/s]; and the greatest change of the vector in
  any frame.
- **loading**: building the scene [s]. Newton compiles its kernels then, if the machine has not done so before.
"""


def row(cells):
    return "| " + " | ".join(cells) + " |\n"


def milliseconds(seconds):
    return f"{1000 * seconds:,.1f}" if seconds < 0.1 else f"{1000 * seconds:,.0f}"


def relative(outcome, reference):
    """How many times as long it takes as the reference, over the frames that both did."""
    frames = min(len(outcome.times), len(reference.times))
    if outcome is reference or not frames or reference.peer != "gelatin":
        return ""
    ratio = outcome.times[:frames].sum() / reference.times[:frames].sum()
    return f"{ratio:.1f}" if ratio < 10 else f"{ratio:.0f}"


def cells_of(outcome, reference, frames, has_floor):
    if not len(outcome.times):
        return ["0"] + [""] * (9 if has_floor else 10)
    times, crossings = outcome.times, outcome.crossings
    cells = [f"{len(times)}" + (f" of {frames}" if len(times) < frames else "")]
    cells += [milliseconds(value) for value in (times.mean(), np.median(times), times.max())]
    cells += [relative(outcome, reference), f"{outcome.smallest_volume:.3f}"]
    if has_floor:
        cells.append(f"{max(0.0, -1000 * outcome.lowest):.1f}")
    else:
        change = np.linalg.norm(outcome.momentum - outcome.first_momentum, axis=1).max()
        cells += [f"{outcome.momentum[-1, 0]:.2f}", f"{change:,.0f}" if change >= 10 else f"{change:.2g}"]
    cells += [f"{crossings.max():,}", f"{crossings[-1]:,}", f"{np.count_nonzero(crossings)}"]
    return cells + [f"{outcome.loading:.1f}"] if outcome.peer != "gelatin" else cells + [""]


def table(name, scene, frames, outcomes, modules):
    nodes = " + ".join(f"{body.count():,}" for body in scene.bodies)
    text = f"## Scene {name}: {TITLES[name]}\n\n"
    text += f"{nodes} nodes; {scene.youngs_modulus / 1000:g} kPa, Poisson's ratio {scene.poisson_ratio}, "
    text += f"{scene.density} kg/m^3; {frames} frames of 1/60 s.\n\n"
    physics = ["below the floor"] if scene.has_floor else ["momentum", "its change"]
    head = ["", "frames", "mean", "median", "worst", "relative", "volume", *physics]
    head += ["crossings, most", "at the end", "frames with any", "loading [s]"]
    text += row(head) + row(["---"] * len(head))
    for outcome in outcomes:
        title = f"{modules[outcome.peer].TITLE}, {outcome.variant}"
        text += row([title, *cells_of(outcome, outcomes[0], frames, scene.has_floor)])
    problems = [f"- {modules[o.peer].TITLE}, {o.variant}: {o.problem}.\n" for o in outcomes if o.problem]
    return text + ("\n" + "".join(problems) if problems else "")


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return models[0] if models else platform.machine()


def describe(options, modules, results):
    """@param results [(name, scene, frames, outcomes)]"""
    program = subprocess.run([options.gelatin, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    text = "# Peers on the same work\n\n"
    text += f"{datetime.date.today()}; {program}; {processor()}, {os.cpu_count()} processors, one thread; {platform.system()}, "
    text += f"Python {platform.python_version()}. Command: `bench/peers/run.py`.\n"
    text += f"{options.note}\n" if options.note else ""
    text += "\n| | version | licence | settings |\n| --- | --- | --- | --- |\n"
    for module in modules.values():
        versions = []
        for package in module.PACKAGES:
            try:
                versions.append(f"{package} {importlib.metadata.version(package)}")
            except importlib.metadata.PackageNotFoundError:
                versions.append(f"{package}: not installed")
        text += row([module.TITLE, ", ".join(versions) or program, module.LICENCE, module.NOTES])
    for result in results:
        text += "\n" + table(*result, modules)
    return text + "\n## Columns\n\n" + EXPLANATION
