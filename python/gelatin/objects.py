"""Objects of a scene, what holds, loads and attaches them, and colliders. SI units; `Scene.up` says which axis points up."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, Union

from .animations import Animation, Skeleton
from .shapes import Plane, Region, Shape, Vector


@dataclass(slots=True)
class Mesher:
    """How a surface is filled with tets. One of nodes, max_volume and cell_size at most."""

    #: "auto": by TetGen, or by the lattice where that fails or would be finer than wanted
    kind: Literal["auto", "tetgen", "lattice"] = "auto"
    #: of TetGen: largest radius-edge ratio of a tet, > 1
    quality: float = 2.0
    #: of TetGen's process [s], > 0
    time_limit: float = 120.0
    #: within 20%, from 10 to 1000000
    nodes: int | None = None
    #: of a tet [m^3], > 0
    max_volume: float | None = None
    #: of the lattice: edge of its cells at the surface [m], > 0
    cell_size: float | None = None


@dataclass(slots=True)
class Keyframe:
    """The placement of a handle or collider at one time, relative to the start."""

    #: [s], >= 0
    time: float = 0.0
    #: displacement of the pivot [m]
    move: Vector = (0.0, 0.0, 0.0)
    #: rotation about x, then y, then z [degrees]; 720 is two full rotations
    turn: Vector = (0.0, 0.0, 0.0)
    #: about the pivot, > 0
    scale: float = 1.0


@dataclass(slots=True)
class Drag:
    """A displacement in addition to a handle's keyframes, which it approaches as fast as its body can follow."""

    #: [m]
    move: Vector = (0.0, 0.0, 0.0)
    #: rotation about x, then y, then z [degrees]
    turn: Vector = (0.0, 0.0, 0.0)


@dataclass(slots=True)
class Handle:
    """Nodes that follow keyframes, bones, or both. They are at rest before the first keyframe and after the last."""

    #: which nodes; None: those near the bones of `skeleton`. One of the two is given.
    region: Region | None = None
    #: in ascending order of time; the first is the start; none: a pin
    keyframes: list[Keyframe] = field(default_factory=list)
    #: point about which it rotates and scales [m]; None: its nodes' centre
    pivot: Vector | None = None
    interpolation: Literal["linear", "smooth"] = "linear"
    #: time from which the nodes are free [s], > 0
    release: float | None = None
    drag: Drag = field(default_factory=Drag)
    #: what happens while bodies leave it no room: the time of its keyframes and its skeleton goes on, or stands still
    when_blocked: Literal["goes_on", "stops"] = "goes_on"
    line: int = field(default=0, repr=False)
    #: in place of a region: bones hold the nodes near them, and move them in addition to the keyframes
    skeleton: Skeleton | None = None


@dataclass(slots=True)
class Force:
    """A force, distributed over the region's nodes by mass."""

    #: [N]
    sum: Vector = (0.0, 0.0, 0.0)


@dataclass(slots=True)
class Traction:
    """A stress on the rest area of faces whose three nodes are in the region."""

    #: [Pa]
    stress: Vector = (0.0, 0.0, 0.0)


@dataclass(slots=True)
class Pressure:
    """A pressure inwards, perpendicular to the faces whose three nodes are in the region."""

    #: [Pa]
    pressure: float = 0.0


@dataclass(slots=True)
class Load:
    """A force, a traction or a pressure on a region of an object."""

    region: Region
    kind: Force | Traction | Pressure
    #: when it begins [s], >= 0; None: at once (`from` in scene files)
    start: float | None = None
    #: when it ends [s]; None: never
    until: float | None = None
    line: int = field(default=0, repr=False)


@dataclass(slots=True)
class TetAttribute:
    """Tets that have this number in their file."""

    number: int


@dataclass(slots=True)
class Part:
    """A part of an object with its own material."""

    #: a region selects the tets whose centroid is in it
    where: Union[Region, TetAttribute]
    #: name of a material
    material: str
    line: int = field(default=0, repr=False)


@dataclass(slots=True)
class Start:
    """The deformation of an object at the start; pinned nodes stay at rest."""

    #: along the world's axes, about the centre of mass, >= 0; 0 flattens it
    scale: Vector = (1.0, 1.0, 1.0)
    #: then a random displacement of each coordinate by up to this [m], >= 0
    scatter: float = 0.0


@dataclass(slots=True)
class Rigid:
    """What a rigid object has where its shape and the density of its material do not say it."""

    #: [kg], > 0; None: by density
    mass: float | None = None
    #: about the centre of mass, along the axes of the shape before it is rotated [kg m^2]: each > 0, and none more than
    #: both others together; None: as for an even density
    inertia: Vector | None = None


@dataclass(slots=True)
class CavityKeyframe:
    """What a cavity has at one time: linear in between, constant before the first and after the last."""

    #: [s], >= 0
    time: float = 0.0
    #: above the ambient pressure, of a constant law [Pa]
    pressure: float | None = None
    #: of a sealed gas, as a factor, > 0
    amount: float | None = None


@dataclass(slots=True)
class Cavity:
    """Gas in a hollow of a deformable object. For the solver "implicit"."""

    #: above the ambient pressure, while the hollow has the volume that it has at rest [Pa]
    pressure: float = 0.0
    #: "sealed": p_absolute V stays what it is; "constant": a regulated pressure
    law: Literal["sealed", "constant"] = "sealed"
    #: of a sealed gas, as a factor of what has this pressure, > 0
    amount: float = 1.0
    #: which hollow: the one whose surface has all of its nodes in the region; None: the only one
    region: Region | None = None
    #: pressure outside [Pa], > 0
    ambient: float = 101325.0
    #: in ascending order of time
    keyframes: list[CavityKeyframe] = field(default_factory=list)
    #: in statistics; empty: "cavity 1", by its place in the object
    name: str = ""
    line: int = field(default=0, repr=False)


@dataclass(slots=True)
class Object:
    """One body of a scene: deformable, or with `rigid` a rigid one.

    A rigid object is of the shape's closed surface, for the solver "implicit". Of its material density, friction, thickness,
    contact_stiffness and restitution count; it has no mesher, start, parts, pins and handles.
    """

    name: str
    shape: Shape
    #: name of a material
    material: str
    #: [m]
    position: Vector = (0.0, 0.0, 0.0)
    #: about x, then y, then z [degrees]
    rotation: Vector = (0.0, 0.0, 0.0)
    #: > 0, applied first
    scale: float = 1.0
    #: [m/s]
    velocity: Vector = (0.0, 0.0, 0.0)
    #: angular velocity about the centre of mass [degrees/s]
    spin: Vector = (0.0, 0.0, 0.0)
    mesher: Mesher = field(default_factory=Mesher)
    start: Start = field(default_factory=Start)
    #: nodes in any of these stay where they are
    pins: list[Region] = field(default_factory=list)
    #: those that move share no node with each other or a pin
    handles: list[Handle] = field(default_factory=list)
    loads: list[Load] = field(default_factory=list)
    #: linear RGB from 0 to 1; None: one of a palette
    color: Vector | None = None
    #: later ones win
    parts: list[Part] = field(default_factory=list)
    #: draw and export the shape's own surface, where it is not the boundary of the tets
    skin: bool = True
    #: the axis of the shape that points up in the scene before it is rotated; None: the scene's for boxes, meshes and
    #: files; "y" for glTF files and the other shapes
    up: Literal["x", "y", "z"] | None = None
    #: None: the object is deformable
    rigid: Rigid | None = None
    #: with different names, of different hollows
    cavities: list[Cavity] = field(default_factory=list)
    line: int = field(default=0, repr=False)
    pins_line: int = field(default=0, repr=False)


@dataclass(slots=True)
class Collider:
    """What bodies cannot enter. With contact every shape but a plane is a rigid surface with two sides."""

    shape: Union[Plane, Shape]
    #: [m]; this, rotation and scale are not for planes
    position: Vector = (0.0, 0.0, 0.0)
    #: about x, then y, then z [degrees]
    rotation: Vector = (0.0, 0.0, 0.0)
    #: Coulomb's coefficient, >= 0
    friction: float = 0.4
    #: normal speed after a contact relative to before, from 0 to 1
    restitution: float = 0.3
    #: in ascending order of time; the first is the start; none: it rests
    keyframes: list[Keyframe] = field(default_factory=list)
    interpolation: Literal["linear", "smooth"] = "linear"
    #: about which it rotates and scales [m]; None: its position
    pivot: Vector | None = None
    #: of the surface within itself, as of a belt [m/s]
    surface_velocity: Vector = (0.0, 0.0, 0.0)
    #: in messages and statistics; no two colliders have the same; empty: "collider 1", by its place in the scene
    name: str = ""
    #: > 0, applied first
    scale: float = 1.0
    #: what happens while bodies leave it no room: the time of its keyframes and its animation goes on, or stands still
    when_blocked: Literal["goes_on", "stops"] = "goes_on"
    #: as of objects; not for planes
    up: Literal["x", "y", "z"] | None = None
    #: how its vertices move, in addition to keyframes; None: its shape does not change; with contact, and not for planes
    animation: Animation | None = None
    line: int = field(default=0, repr=False)


@dataclass(slots=True)
class AttachedPoint:
    """A ball joint. The point moves with what is there of both sides."""

    #: [m], at the start
    at: Vector


@dataclass(slots=True)
class AttachedLine:
    """A hinge: all points of a line segment."""

    #: one of its ends [m], at the start
    start: Vector
    #: the other one
    end: Vector


@dataclass(slots=True)
class AttachedRail:
    """A slider: the object does not rotate beside the other side, and moves along a direction. Both sides are rigid.

    How far it has moved is the joint's coordinate.
    """

    #: a point on it [m], at the start
    start: Vector
    #: another one: in its direction the coordinate grows
    end: Vector


@dataclass(slots=True)
class AttachedUniversal:
    """A universal joint: a point that is kept, and two axes that stay perpendicular. Both sides are rigid."""

    #: [m], at the start
    at: Vector
    #: the axis that moves with the object, at the start; of any length
    own: Vector
    #: the one that moves with the other side; within 1 degree of perpendicular
    of_other: Vector


@dataclass(slots=True)
class AttachedDistance:
    """A rod or a rope between two points. Their distance is the joint's coordinate.

    Without limits, spring and motor it stays what it is.
    """

    #: on the object [m], at the start
    start: Vector
    #: on the other side, another point
    end: Vector


Attached = Union[Region, AttachedPoint, AttachedLine, AttachedRail, AttachedUniversal, AttachedDistance]


@dataclass(slots=True)
class JointSpring:
    """Pulls a joint to where it rests. Its stiffness or its damping is greater than 0."""

    #: [N m/rad] of a line, else [N/m], >= 0
    stiffness: float = 0.0
    #: [N m s/rad] of a line, else [N s/m], >= 0
    damping: float = 0.0
    #: [degrees] of a line, else [m]; None: where the joint is at the start
    rest: float | None = None


@dataclass(slots=True)
class MotorKeyframe:
    """From a time on, until the next one: what a motor does otherwise. What is None stays as it was."""

    #: [s], >= 0
    time: float = 0.0
    #: as of JointMotor
    speed: float | None = None
    #: as of JointMotor
    position: float | None = None
    #: as of JointMotor
    force: float | None = None


@dataclass(slots=True)
class JointMotor:
    """Moves a joint at a speed, or to a position; at least one of them is given. It holds it there, too."""

    #: [degrees/s] of a line, else [m/s]; where there is a position, it goes there no faster than that, which is > 0
    speed: float | None = None
    #: [degrees] of a line, else [m]
    position: float | None = None
    #: the greatest [N m] of a line, else [N], >= 0; None: whatever it takes
    force: float | None = None
    #: in ascending order of time
    keyframes: list[MotorKeyframe] = field(default_factory=list)


@dataclass(slots=True)
class Attachment:
    """Keeps points of an object where they are in another one, in a collider, or in space. For the solver "implicit".

    Where it is glued, surfaces do not press each other.
    """

    #: name of an object
    object: str
    #: another object's name, or a collider's; empty: where it is in space
    to: str = ""
    #: which points: of a region, the object's nodes in it; None: those within what it is attached to, or nearer to it
    #: than half of its median edge
    where: Attached | None = None
    #: of the whole attachment [m/N], >= 0; 0: as stiff as the bodies
    compliance: float = 0.0
    #: at which it breaks [N], > 0; None: never
    break_force: float | None = None
    #: in messages; empty: "attachment 1", by its place in the scene
    name: str = ""
    line: int = field(default=0, repr=False)
    #: least and greatest coordinate of a joint [degrees] of a line, from -180 to 180, else [m]; the start is among them. Limits,
    #: spring and motor are for AttachedRail, AttachedDistance, and AttachedLine between rigid sides.
    limits: tuple[float, float] | None = None
    spring: JointSpring | None = None
    motor: JointMotor | None = None


@dataclass(slots=True)
class Camera:
    """From where pictures are taken."""

    #: [m]
    eye: Vector
    #: [m]
    target: Vector
    #: vertical [degrees]
    field_of_view: float = 35.0
