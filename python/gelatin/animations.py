"""What moves the vertices of colliders and the nodes of objects, beside keyframes. SI units."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Union

import numpy as np
import numpy.typing as npt

from .arguments import vectors
from .progress import counted


@dataclass(slots=True)
class AnimationClip:
    """A clip of a glTF file, which is the collider's shape. It moves nodes, bones of skins and morph targets."""

    #: empty: the file's first
    name: str = ""


@dataclass(slots=True)
class AnimationFiles:
    """A sequence of files, one after the other, each with all vertices of the collider's shape in the same order."""

    #: `*` stands for anything in the name of the files; they are taken in the order of the numbers in their names
    pattern: str | os.PathLike[str]
    #: files a second [1/s], > 0
    rate: float = 24.0


@dataclass(slots=True, eq=False, repr=False)
class AnimationFrames:
    """Where the vertices are at even times, in memory; in between they move at even speed. Scene files cannot contain it.

    Copies the frames into an array of float64. Raises TypeError for what is no array of numbers, InvalidInput for another shape.
    """

    #: [m], array of shape (frames, vertices, 3): the vertices of the shape, in its order, before scale, rotation and position
    #: place it
    frames: npt.ArrayLike
    #: frames a second [1/s], > 0
    rate: float = 24.0

    def __post_init__(self) -> None:
        self.frames = vectors("frames", self.frames, "frames", "vertices")

    def __repr__(self) -> str:
        frames, vertices, _ = np.shape(self.frames)
        return f"<gelatin.AnimationFrames: {counted(frames, 'frame')} of {counted(vertices, 'vertex', 'vertices')}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, AnimationFrames):
            return NotImplemented
        return self.rate == other.rate and np.array_equal(np.asarray(self.frames), np.asarray(other.frames))


@dataclass(slots=True)
class AnimationByProgram:
    """A program says where the vertices are, while the scene runs: Simulator.set_collider_vertices."""


@dataclass(slots=True)
class Animation:
    """How the vertices of a collider's shape move, before it is placed in the scene. Nothing that bodies do changes it."""

    source: Union[AnimationClip, AnimationFiles, AnimationFrames, AnimationByProgram] = field(default_factory=AnimationClip)
    #: when it begins [s], >= 0; until then a clip's nodes go from where the file has them to where the clip begins
    start: float = 0.0
    #: as a factor, > 0
    speed: float = 1.0
    #: whether it begins again when it ends; otherwise vertices stay where it ends
    loop: bool = False


@dataclass(slots=True)
class Skeleton:
    """Bones of a glTF file, which move nodes near them, each those to which it is nearest.

    Bones are what is between the joints of skins; where there are no skins, what is between all nodes of the file.
    """

    #: .gltf or .glb; placed as the object is
    file: str | os.PathLike[str]
    #: nodes nearer to a bone than this follow it [m], > 0
    radius: float
    #: which clip moves the bones; empty: the file's first
    clip: str = ""
    #: when it begins [s], >= 0; until then bones go from where the file has them to where the clip begins
    start: float = 0.0
    #: as a factor, > 0
    speed: float = 1.0
    #: whether it begins again when it ends; otherwise bones stay where it ends
    loop: bool = False
