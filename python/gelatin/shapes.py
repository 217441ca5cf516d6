"""Shapes of objects and colliders, and regions of space. SI units, `Scene.up` says which axis is up."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
import numpy.typing as npt

#: Three numbers: a tuple, a list or an array of shape (3,).
Vector = Sequence[float]


@dataclass(slots=True)
class Sphere:
    """A ball about the origin."""

    #: [m], > 0
    radius: float = 0.5
    #: number of pieces of each edge of an icosahedron, >= 1: 20 frequency^2 faces
    frequency: int = 10


@dataclass(slots=True)
class Box:
    """A box about the origin."""

    #: along x, y and z [m], > 0
    size: Vector = (1.0, 1.0, 1.0)
    #: quads along each edge, >= 1
    segments: Sequence[int] = (1, 1, 1)


@dataclass(slots=True)
class Capsule:
    """A cylinder along the up axis with hemispheres at its ends."""

    #: [m], > 0
    radius: float = 0.25
    #: of the straight part [m], > 0
    length: float = 0.5
    #: rings on a hemisphere, >= 2
    frequency: int = 8


@dataclass(slots=True)
class Text:
    """Letters, as solids."""

    text: str
    #: along z [m], > 0
    depth: float = 0.2
    #: em height [m], > 0
    size: float = 1.0
    #: a fontconfig pattern, or a font file
    font: str = "DejaVu Sans:bold"


@dataclass(slots=True)
class File:
    """A surface or a tet mesh from a file. A relative path is relative to the scene's file, or to the working folder."""

    file: str | os.PathLike[str]


class Mesh:
    """A mesh in memory: a surface, or tets. Treated as the same mesh in a file; scene files cannot contain it.

    vertices: [m], array of shape (vertices, 3).
    triangles: of a surface, which is repaired and filled with tets: vertices, counter-clockwise from outside; shape (triangles, 3).
    tets: used as they are: shape (tets, 4), none of them flat. Instead of triangles.
    attributes: of the tets, integers for TetAttribute, shape (tets,).
    """

    __slots__ = ("vertices", "triangles", "tets", "attributes")

    def __init__(
        self,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike = (),
        tets: npt.ArrayLike = (),
        attributes: npt.ArrayLike = (),
    ) -> None:
        self.vertices = vertices
        self.triangles = triangles
        self.tets = tets
        self.attributes = attributes

    def __repr__(self) -> str:
        vertices, triangles, tets = (len(np.asarray(part)) for part in (self.vertices, self.triangles, self.tets))
        return f"<gelatin.Mesh: {vertices} vertices, {triangles} triangles, {tets} tets>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mesh):
            return NotImplemented

        def same(a: npt.NDArray[Any], b: npt.NDArray[Any]) -> bool:
            return a.size == b.size == 0 or np.array_equal(a, b)

        return all(same(np.asarray(getattr(self, name)), np.asarray(getattr(other, name))) for name in self.__slots__)


Shape = Union[Sphere, Box, Capsule, Text, File, Mesh]


@dataclass(slots=True)
class Plane:
    """An infinite plane; only colliders can be one."""

    #: unit, towards the free side
    normal: Vector = (0.0, 1.0, 0.0)
    #: normal . x on the plane [m]
    offset: float = 0.0


@dataclass(slots=True)
class BoxRegion:
    """What lies in a box, in world coordinates at the start."""

    #: lower corner [m]
    min: Vector
    #: upper corner [m]
    max: Vector


@dataclass(slots=True)
class SphereRegion:
    """What lies in a sphere, in world coordinates at the start."""

    #: [m]
    center: Vector
    #: [m]
    radius: float


@dataclass(slots=True)
class HalfSpaceRegion:
    """What lies behind a plane, in world coordinates at the start: normal . x <= offset."""

    #: unit
    normal: Vector
    #: [m]
    offset: float


Region = Union[BoxRegion, SphereRegion, HalfSpaceRegion]
