"""Scenes: what is simulated, and how. SI units; `Scene.up` says which axis points up.

A scene is plain data. Nothing is checked until a simulator is made of it, or until `Scene.validate`.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Union, cast

from . import _gelatin
from .arguments import path, texts, wrong_type
from .errors import InvalidInput
from .objects import Attached, Attachment, Camera, Collider, Object, Rigid
from .shapes import File, Plane, Shape, Vector


@dataclass(slots=True)
class SimulationSettings:
    #: four explicit schemes, and an implicit one, stable at any step, whose earlier name was "vbd"
    solver: Literal["explicit_euler", "semi_implicit_euler", "midpoint", "rk4", "implicit", "vbd"] = "implicit"
    #: how spring forces reach the nodes: the paper's two kernels, or one fused with the integration
    forces: Literal["divide_and_merge", "fused"] = "fused"
    #: frames a second of simulated time [1/s], > 0
    frame_rate: float = 60.0
    #: steps a frame, >= 1; None or "auto": the fewest that are stable
    substeps: Union[int, Literal["auto"], None] = None
    #: of "implicit", conjugate-gradient iterations for each linearisation at most; >= 1
    iterations: int = 10
    #: [m/s^2]; None: 9.81 downwards
    gravity: Vector | None = None
    #: length of a run, >= 0
    frames: int = 600
    #: leave steps out while all bodies rest; with contact
    sleep: bool = True


@dataclass(slots=True)
class MaterialPair:
    """How bodies of two materials, or of one, press each other. None: the geometric mean of both materials'."""

    #: name of a material
    first: str
    #: name of a material
    second: str
    #: Coulomb's coefficient, >= 0
    friction: float | None = None
    #: as a factor, > 0
    contact_stiffness: float | None = None
    #: from 0 to 1
    restitution: float | None = None


@dataclass(slots=True)
class CollisionSettings:
    #: how faces that cannot touch are excluded before face is tested against face
    broad_phase: Literal["none", "boxes", "hierarchy", "depth"] = "hierarchy"
    #: whether faces are tested at the end of a step only, or during the whole step
    detection: Literal["discrete", "continuous"] = "discrete"
    #: what happens to objects whose faces touch; None: "contact" with implicit solvers, else "restore"
    response: Literal["restore", "contact"] | None = None
    #: whether objects collide with themselves, too; None: where they have contacts
    self_collision: bool | None = None
    #: find nodes and faces, and pairs of edges, nearer than this [m], > 0; None: off
    proximity_radius: float | None = None
    #: Coulomb's coefficient, >= 0
    friction: float = 0.4
    #: normal speed after a contact relative to before, from 0 to 1
    restitution: float = 0.3
    #: each pair of materials at most once
    pairs: list[MaterialPair] = field(default_factory=list)


@dataclass(slots=True)
class SpringKinds:
    """Which of the paper's springs a material has. At least one."""

    #: the edges of the tets
    structural: bool = True
    #: the opposite corners of two tets that share a face
    shear: bool = False
    #: across a surface edge, and two edges apart inside
    flex: bool = False


@dataclass(slots=True)
class Material:
    name: str
    #: springs between nodes, or linear finite elements
    model: Literal["mass_spring", "neo_hookean"] = "mass_spring"
    #: [Pa], > 0
    youngs_modulus: float = 5e4
    #: [kg/m^3], > 0
    density: float = 1000.0
    #: from 0 to 0.49; for neo_hookean below 0.5
    poisson_ratio: float = 0.25
    #: Kelvin-Voigt relaxation time [s], >= 0
    damping: float = 0.0
    #: for mass_spring; None: springs fitted to each mesh, so that the body has youngs_modulus
    springs: SpringKinds | None = None
    #: Coulomb's coefficient of a body's surface, >= 0; None: the collision settings'
    friction: float | None = None
    #: two surfaces begin to press at the sum of both [m], > 0; None: a twentieth of the body's median edge
    thickness: float | None = None
    #: of contacts, as a factor, > 0
    contact_stiffness: float = 1.0
    #: from 0 to 1; None: the collision settings'
    restitution: float | None = None
    line: int = field(default=0, repr=False)


@dataclass(slots=True)
class Scene:
    """What is simulated. Build one in code, or load one with `gelatin.load`.

    >>> scene = gelatin.Scene()
    >>> scene.add_material("jelly", youngs_modulus=2e4)
    >>> scene.add("ball", gelatin.Sphere(radius=0.5), material="jelly", position=(0, 2, 0))
    >>> scene.add_collider(gelatin.Plane())
    """

    #: where it came from; empty if it was made in code
    file: str | os.PathLike[str] = ""
    simulation: SimulationSettings = field(default_factory=SimulationSettings)
    collision: CollisionSettings = field(default_factory=CollisionSettings)
    materials: list[Material] = field(default_factory=list)
    objects: list[Object] = field(default_factory=list)
    colliders: list[Collider] = field(default_factory=list)
    attachments: list[Attachment] = field(default_factory=list)
    #: None: chosen so that pictures show the whole scene
    camera: Camera | None = None
    #: the shapes' meshes, if the scene is a recording's; None: they are made of the shapes
    meshes: _gelatin.SceneMeshes | None = field(default=None, repr=False, compare=False)
    #: "y" or "z": which way gravity does not pull, what is up in pictures, and how shapes stand
    up: Literal["y", "z"] = "y"

    def add_material(self, name: str, **fields: Any) -> Material:
        """Adds a material. `fields` are those of `gelatin.Material`."""
        material = Material(name, **fields)
        self.materials.append(material)
        return material

    def add(
        self,
        name: str,
        shape: Union[Shape, str, os.PathLike[str]],
        *,
        material: Union[str, Material, None] = None,
        **fields: Any,
    ) -> Object:
        """Adds an object. `shape` may be the path of a mesh; `fields` are those of `gelatin.Object`.

        material: its name, or itself; None: the scene's only one.
        """
        if isinstance(shape, (str, os.PathLike)):
            shape = File(shape)
        if material is None:
            material = self.materials[0] if len(self.materials) == 1 else ""
        if isinstance(material, Material):
            material = material.name
        added = Object(name, shape, material, **fields)
        self.objects.append(added)
        return added

    def add_rigid(
        self,
        name: str,
        shape: Union[Shape, str, os.PathLike[str]],
        material: Union[str, Material, None] = None,
        *,
        mass: float | None = None,
        inertia: Vector | None = None,
        **fields: Any,
    ) -> Object:
        """Adds a rigid body: an object with `rigid`, as of [[rigid]] in scene files. Other arguments are those of `add`.

        mass: [kg], > 0; None: by the density of its material.
        inertia: about the centre of mass, along the axes of the shape before it is rotated [kg m^2], each > 0, and none more
            than both others together; None: as for an even density.

        `validate` raises InvalidInput for other values, for a mesher, start, parts, pins or handles, which a rigid body has
        not, and for another solver than "implicit".
        """
        return self.add(name, shape, material=material, rigid=Rigid(mass, inertia), **fields)

    def add_collider(self, shape: Union[Plane, Shape, str, os.PathLike[str], None] = None, **fields: Any) -> Collider:
        """Adds a collider, with the scene's friction and restitution where `fields` does not say.

        `shape` may be the path of a mesh; None: the level plane through the origin. `fields` are those of
        `gelatin.Collider`.
        """
        if shape is None:
            shape = Plane((0.0, 0.0, 1.0)) if self.up == "z" else Plane()
        if isinstance(shape, (str, os.PathLike)):
            shape = File(shape)
        fields.setdefault("friction", self.collision.friction)
        fields.setdefault("restitution", self.collision.restitution)
        collider = Collider(shape, **fields)
        self.colliders.append(collider)
        return collider

    def add_attachment(
        self,
        object: Union[str, Object],
        to: Union[str, Object, Collider] = "",
        where: Attached | None = None,
        **fields: Any,
    ) -> Attachment:
        """Attaches an object to another one, to a collider, or to where it is in space. `fields` are those of `gelatin.Attachment`.

        object: its name, or itself.
        to: a name, or an object or collider itself, which must have a name; empty: space.
        where: which points; None: those within `to`, or near it.
        """
        attachment = attachment_of(object, to, where, **fields)
        self.attachments.append(attachment)
        return attachment

    def validate(self) -> None:
        """Checks every value, as a simulator does by itself.

        Raises InvalidInput, naming the field, its value and what is allowed; TypeError for a value of a wrong type.
        """
        _gelatin.validate(self)


def attachment_of(
    object: Union[str, Object],
    to: Union[str, Object, Collider] = "",
    where: Attached | None = None,
    **fields: Any,
) -> Attachment:
    """As Scene.add_attachment, but of no scene."""
    if isinstance(to, Collider) and not to.name:
        raise InvalidInput("to: a collider without a name: gelatin.Collider.name names it")
    return Attachment(
        object.name if isinstance(object, Object) else object,
        to.name if isinstance(to, (Object, Collider)) else to,
        where,
        **fields,
    )


def load(
    file: str | os.PathLike[str],
    overrides: Union[Mapping[str, Any], str, Iterable[str]] = (),
) -> Scene:
    """Reads and checks a scene file.

    overrides: values to change before the check, as {"material.jelly.youngs_modulus": 1e5} or as
        ["material.jelly.youngs_modulus=1e5"], or one such text, with the keys of docs/scene-files.md.

    Raises InvalidInput, naming file, line, key, value and what is allowed.
    """
    if isinstance(overrides, Mapping):
        overrides = [f"{key}={_toml(key, value)}" for key, value in overrides.items()]
    return cast(Scene, _gelatin.load(path("file", file), texts("overrides", overrides)))


def _toml(key: str, value: Any) -> str:
    """Numbers, truth values, texts, paths and lists of these in TOML, of which texts are written as in JSON."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(key, each) for each in value) + "]"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, (bool, int, float)):
        return str(value).lower() if isinstance(value, bool) else repr(value)
    raise wrong_type(key, value, "a number, a truth value, a text, a path or a list of these")
