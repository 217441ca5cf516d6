"""Gelatin, by its command line: the frames that `gelatin run` exports, and the times of a run that exports none."""

import json
import subprocess
from pathlib import Path

import numpy as np

from bodies import lumped_masses, read_points

TITLE, LICENCE, PACKAGES = "Gelatin", "MIT", ()

# Options of `gelatin run`. Without any, steps in which bodies meet are divided (docs/contact.md).
VARIANTS = {
    "springs": [],
    "springs, one step a frame": ["--set", "simulation.substeps=1"],
    "neo-Hookean tets": ["--set", "material.jelly.model=neo_hookean"],
}
NOTES = "implicit steps; `--backend cpu --threads 1`"


class Peer:
    """Two runs with the same numbers. One is timed, with nothing to write. The other writes each frame."""

    def __init__(self, scene, options, job):
        self.masses = lumped_masses(scene)
        command = [job["gelatin"], "run", str(scene.file), "--frames", str(job["frames"]), "--quiet"]
        command += ["--backend", "cpu", "--threads", "1", *options]
        subprocess.run([*command, "--stats", "stats.json"], check=True)
        subprocess.run([*command, "--export", "frames", "--every", "1"], check=True)
        with open("stats.json", encoding="utf-8") as file:
            timing = json.load(file)["timing"]
        # Frames are the steps and their statistics.
        measuring = timing["stages"]["measure"]["median"]
        self.times = (np.array(timing["frame_ms"]["each"]) - measuring) / 1000
        self.frame = 0
        # The same nodes, but their order depends on the material's model.
        self.order = np.empty(len(scene.positions), int)
        self.order[np.lexsort(scene.positions.T)] = np.lexsort(self.positions_as_exported().T)

    @staticmethod
    def file(frame):
        return f"frames/frame_{frame:06}.vtu"

    def step(self):
        self.frame += 1
        return self.times[self.frame - 1]

    def positions_as_exported(self):
        return read_points(Path(self.file(self.frame)))

    def positions(self):
        return self.positions_as_exported()[self.order]
