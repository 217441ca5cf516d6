"""Gelatin, by its command line: the frames that `gelatin run` exports, and the times of a run that exports none."""

import json
import resource
import subprocess
from pathlib import Path

import numpy as np

from bodies import read_points

TITLE, LICENCE, PACKAGES = "Gelatin", "MIT", ()
VARIANTS = {"one thread": {"threads": 1}, "two threads": {"threads": 2}}
NOTES = (
    "the scene files as they are: implicit steps, at least four parts a frame where rigid bodies are joined; springs (ball) or "
    "neo-Hookean tets (tyres); `--backend cpu`"
)


def run(command):
    """@return the processor time that it took [s]"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(word) for word in command], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Peer:
    """A timed run with nothing to write, one of no frame, which only loads, and one that writes each frame."""

    def __init__(self, scene, settings, job):
        self.scene, self.frame = scene, 0
        command = [job["gelatin"], "run", scene.file, "--quiet", "--backend", "cpu", "--threads", settings["threads"]]
        whole = run([*command, "--frames", job["frames"], "--stats", "stats.json"])
        loading = run([*command, "--frames", 0, "--stats", "start.json"])
        if job["measured"]:
            run([*command, "--frames", job["frames"], "--export", "frames", "--every", 1])
        timing = json.loads(Path("stats.json").read_text(encoding="utf-8"))["timing"]
        # Frames are the steps and their statistics.
        self.times = (np.array(timing["frame_ms"]["each"]) - timing["stages"]["measure"]["median"]) / 1000
        self.processor = (whole - loading) / job["frames"]
        self.start = self.points() if job["measured"] else None

    def points(self):
        return read_points(Path(f"frames/frame_{self.frame:06}.vtu"))

    def step(self):
        """Processor time is known of all frames together: each gets its part."""
        self.frame += 1
        return self.times[self.frame - 1], self.processor

    def state(self):
        points = self.points()
        places, turns = zip(*(self.pose(part, points) for part in self.scene.parts))
        return np.array(places), np.array(turns), np.concatenate([points[soft.nodes] for soft in self.scene.softs])

    def pose(self, part, points):
        """The rigid motion nearest to that of the part's nodes."""
        before, now = self.start[part.nodes], points[part.nodes]
        u, _, v = np.linalg.svd((before - before.mean(axis=0)).T @ (now - now.mean(axis=0)))
        turn = v.T @ np.diag([1, 1, np.linalg.det(u @ v)]) @ u.T
        return now.mean(axis=0) + turn @ (part.place - before.mean(axis=0)), turn
