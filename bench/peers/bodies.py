"""A scene as all peers get it: the tets that Gelatin exports, and the numbers of the scene file."""

import base64
import re
import tomllib
import zlib
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


def lumped_masses_of(points, tets, density):
    """[n]: a quarter of each tet's mass at each of its nodes."""
    masses = np.zeros(len(points))
    a, b, c, d = (points[tets[:, k]] for k in range(4))
    np.add.at(masses, tets, density * np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a))[:, None] / 24)
    return masses


def lumped_masses(scene):
    """[n], of all bodies."""
    return np.concatenate([lumped_masses_of(scene.points(body), body.tets, scene.density) for body in scene.bodies])


def equal_masses(scene):
    """[n]: each body's mass in equal parts."""
    return np.concatenate([np.full(body.count(), scene.mass(body) / body.count()) for body in scene.bodies])


def read_array(text, name, kind):
    """A binary array of a VTU file, in base64: 8 bytes of its length, then the values; or blocks that zlib compressed."""
    encoded = re.search(rf'<DataArray [^>]*Name="{name}"[^>]*>\s*([^<\s]*)', text)[1]
    if 'compressor="vtkZLibDataCompressor"' not in text:
        return np.frombuffer(base64.b64decode(encoded)[8:], kind)
    # First the number of blocks, two sizes of a block, and the compressed size of each; these are encoded by themselves.
    count = int(np.frombuffer(base64.b64decode(encoded[:12])[:8], "<u8")[0])
    length = 4 * -(-8 * (3 + count) // 3)
    ends = np.cumsum(np.frombuffer(base64.b64decode(encoded[:length]), "<u8")[3:]).astype(int)
    blocks = base64.b64decode(encoded[length:])
    return np.frombuffer(b"".join(zlib.decompress(blocks[first:end]) for first, end in zip([0, *ends], ends)), kind)


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
