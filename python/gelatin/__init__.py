"""Gelatin: soft bodies. SI units, `Scene.up` says which axis is up.

>>> import gelatin
>>> scene = gelatin.Scene()
>>> scene.add_material("jelly", youngs_modulus=2e4)
>>> scene.add("ball", gelatin.Sphere(radius=0.5), material="jelly", position=(0, 2, 0))
>>> scene.add_collider(gelatin.Plane())
>>> sim = gelatin.Simulator(scene)
>>> sim.advance(60)
>>> sim["ball"].positions
"""

from ._gelatin import commit, version
from .animations import Animation, AnimationByProgram, AnimationClip, AnimationFiles, AnimationFrames, Skeleton
from .batch import Batch
from .bodies import Body
from .errors import Diverged, Error, GlError, InvalidInput, NoOpenGl, SystemError
from .hands import Hand
from .objects import (
    Attached,
    AttachedDistance,
    AttachedLine,
    AttachedPoint,
    AttachedRail,
    AttachedUniversal,
    Attachment,
    Camera,
    Cavity,
    CavityKeyframe,
    Collider,
    Drag,
    Force,
    Handle,
    JointMotor,
    JointSpring,
    Keyframe,
    Load,
    Mesher,
    MotorKeyframe,
    Object,
    Part,
    Pressure,
    Rigid,
    Start,
    TetAttribute,
    Traction,
)
from .pictures import Film, Picture, film
from .scene import CollisionSettings, Material, MaterialPair, Scene, SimulationSettings, SpringKinds, load
from .shapes import (
    Box,
    BoxRegion,
    Capsule,
    File,
    HalfSpaceRegion,
    Mesh,
    Plane,
    Region,
    Shape,
    Sphere,
    SphereRegion,
    Text,
)
from .recording import Recorder
from .simulator import Player, Simulator, play
from .sweep_run import Run
from .sweep_settings import Between
from .sweeps import sweep

__version__ = version()
__all__ = [
    "Animation",
    "AnimationByProgram",
    "AnimationClip",
    "AnimationFiles",
    "AnimationFrames",
    "Attached",
    "AttachedDistance",
    "AttachedLine",
    "AttachedPoint",
    "AttachedRail",
    "AttachedUniversal",
    "Attachment",
    "Batch",
    "Between",
    "Body",
    "Box",
    "BoxRegion",
    "Camera",
    "Capsule",
    "Cavity",
    "CavityKeyframe",
    "Collider",
    "CollisionSettings",
    "Diverged",
    "Drag",
    "Error",
    "File",
    "Film",
    "Force",
    "GlError",
    "HalfSpaceRegion",
    "Hand",
    "Handle",
    "InvalidInput",
    "JointMotor",
    "JointSpring",
    "Keyframe",
    "Load",
    "Material",
    "MaterialPair",
    "Mesh",
    "Mesher",
    "MotorKeyframe",
    "NoOpenGl",
    "Object",
    "Part",
    "Picture",
    "Plane",
    "Player",
    "Pressure",
    "Recorder",
    "Region",
    "Rigid",
    "Run",
    "Scene",
    "Shape",
    "SimulationSettings",
    "Simulator",
    "Skeleton",
    "Sphere",
    "SphereRegion",
    "SpringKinds",
    "Start",
    "SystemError",
    "TetAttribute",
    "Text",
    "Traction",
    "commit",
    "film",
    "load",
    "play",
    "sweep",
    "version",
]
