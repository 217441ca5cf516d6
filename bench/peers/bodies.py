"""A scene as all peers get it: the tets that Gelatin exports, and the numbers of the scene file."""

import base64
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass
class Body:
    nodes: slice  # in Scene.positions
    tets: np.ndarray  # [t, 4], indices into the body's own nodes; positive volume
    velocity: np.ndarray  # at the start [m/s]

    def count(self):
        return self.nodes.stop - self.nodes.start


@dataclass
class Scene:
    file: Path
    positions: np.ndarray  # at the start, at rest, of all bodies [n, 3] [m]
    bodies: list[Body]
    step: float  # the time between two frames [s]
    sweeps: int
    frames: int
    gravity: np.ndarray  # [m/s^2]
    has_floor: bool  # the plane y = 0
    friction: float
    density: float  # [kg/m^3]
    youngs_modulus: float  # [Pa]
    poisson_ratio: float

    def lame(self):
        """Lame's parameters mu and lambda [Pa]."""
        mu = self.youngs_modulus / (2 * (1 + self.poisson_ratio))
        return mu, 2 * mu * self.poisson_ratio / (1 - 2 * self.poisson_ratio)

    def points(self, body):
        return self.positions[body.nodes]

    def mass(self, body):
        return self.density * volume(self.points(body), body.tets)


def volume(positions, tets):
    """Of a body's tets together [m^3]."""
    a, b, c, d = (positions[tets[:, k]] for k in range(4))
    return np.einsum("ij,ij->", b - a, np.cross(c - a, d - a)) / 6


def lumped_masses(scene):
    """[n]: a quarter of each tet's mass at each of its nodes."""
    masses = np.zeros(len(scene.positions))
    for body in scene.bodies:
        a, b, c, d = (scene.points(body)[body.tets[:, k]] for k in range(4))
        quarter = scene.density * np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 24
        np.add.at(masses[body.nodes], body.tets, quarter[:, None])
    return masses


def equal_masses(scene):
    """[n]: each body's mass in equal parts."""
    return np.concatenate([np.full(body.count(), scene.mass(body) / body.count()) for body in scene.bodies])


def read_array(text, name, kind):
    """A binary array of a VTU file: 8 bytes of its length, then the values, in base64."""
    found = re.search(rf'<DataArray [^>]*Name="{name}"[^>]*>\s*([^<\s]*)', text)
    return np.frombuffer(base64.b64decode(found[1])[8:], kind)


def read_points(file):
    return read_array(file.read_text(), "Points", "<f4").reshape(-1, 3).astype(float)


def read_scene(file, frame):
    """@param frame the VTU file of frame 0 of this scene file; it has the nodes of an object in a row"""
    description = tomllib.loads(file.read_text())
    simulation, material = description["simulation"], description["material"][0]
    text = frame.read_text()
    tets = read_array(text, "connectivity", "<i8").reshape(-1, 4)
    owners = read_array(text, "object", "<i4")
    bodies = []
    for k, body in enumerate(description["object"]):
        own = tets[owners == k]
        first = int(own.min())
        bodies.append(
            Body(slice(first, int(own.max()) + 1), own - first, np.array(body.get("velocity", [0, 0, 0]), float))
        )
    return Scene(
        file=file,
        positions=read_points(frame),
        bodies=bodies,
        step=1 / simulation["frame_rate"],
        sweeps=simulation["iterations"],
        frames=simulation["frames"],
        gravity=np.array(simulation.get("gravity", [0, -9.81, 0]), float),
        has_floor="collider" in description,
        friction=description["collision"]["friction"],
        density=material["density"],
        youngs_modulus=material["youngs_modulus"],
        poisson_ratio=material["poisson_ratio"],
    )
