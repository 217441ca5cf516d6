"""Scenes: every field goes to C++ and back; wrong values are exceptions that name them."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import gelatin
from conftest import falling_ball
from gelatin import _gelatin


def scene_with_everything():
    scene = gelatin.Scene()
    scene.up = "z"
    scene.simulation = gelatin.SimulationSettings("rk4", "divide_and_merge", 50.0, 3, 7, (1.0, 2.0, 3.0), 20, False)
    scene.collision = gelatin.CollisionSettings(
        "boxes", "continuous", "restore", True, 0.1, 0.2, 0.7, [gelatin.MaterialPair("a", "b", 0.1, 2.0, 0.5)]
    )
    scene.add_material(
        "a",
        model="neo_hookean",
        youngs_modulus=1.0,
        density=2.0,
        poisson_ratio=0.3,
        damping=0.1,
        springs=gelatin.SpringKinds(False, True, True),
        friction=0.1,
        thickness=0.01,
        contact_stiffness=3.0,
        restitution=0.2,
        line=5,
    )
    region = gelatin.BoxRegion((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))
    ball = gelatin.SphereRegion((1.0, 0.0, 0.0), 0.5)
    half = gelatin.HalfSpaceRegion((0.0, 1.0, 0.0), 0.25)
    frames = [gelatin.Keyframe(), gelatin.Keyframe(1.0, (1.0, 0.0, 0.0), (0.0, 90.0, 0.0), 2.0)]
    drag = gelatin.Drag((0.1, 0.0, 0.0), (0.0, 5.0, 0.0))
    skeleton = gelatin.Skeleton("arm.glb", 0.1, "flex", 1.0, 2.0, True)
    scene.add(
        "o",
        gelatin.Text("x", 0.3, 2.0, "serif"),
        material="a",
        position=(1.0, 2.0, 3.0),
        rotation=(4.0, 5.0, 6.0),
        scale=2.0,
        velocity=(7.0, 8.0, 9.0),
        spin=(10.0, 11.0, 12.0),
        mesher=gelatin.Mesher("lattice", 1.5, 60.0, 100, 0.1, 0.2),
        start=gelatin.Start((0.5, 0.6, 0.7), 0.1),
        pins=[region, ball, half],
        handles=[gelatin.Handle(half, frames, (1.0, 1.0, 1.0), "smooth", 2.0, drag, "stops", line=4), gelatin.Handle(skeleton=skeleton)],
        loads=[
            gelatin.Load(ball, gelatin.Force((1.0, 0.0, 0.0)), 0.5, 1.5, line=3),
            gelatin.Load(ball, gelatin.Traction((1.0, 0.0, 0.0))),
            gelatin.Load(ball, gelatin.Pressure(5.0)),
        ],
        color=(0.1, 0.2, 0.3),
        parts=[gelatin.Part(region, "a", line=9), gelatin.Part(gelatin.TetAttribute(3), "a")],
        skin=False,
        up="z",
        line=6,
        pins_line=7,
        cavities=[
            gelatin.Cavity(1.0, "constant", 2.0, ball, 3.0, [gelatin.CavityKeyframe(1.0, 2.0, 3.0)], "air", line=8),
        ],
    )
    for shape in (
        gelatin.Sphere(2.0, 3),
        gelatin.Box((1.0, 2.0, 3.0), (4, 5, 6)),
        gelatin.Capsule(0.1, 0.2, 4),
        gelatin.File("a.obj"),
    ):
        scene.add("o", shape, material="a")
    scene.add_rigid("r", gelatin.Box(), "a", mass=2.0, inertia=(1.0, 2.0, 2.5))
    scene.add_collider(gelatin.Plane((1.0, 0.0, 0.0), 0.5))
    scene.colliders.append(
        gelatin.Collider(
            gelatin.Sphere(), (1.0, 2.0, 3.0), (4.0, 5.0, 6.0), 0.7, 0.1, frames, "smooth", (1.0, 0.0, 1.0), (2.0, 0.0, 2.0), "belt", 3.0, "stops", up="x", line=2
        )
    )
    for source in (
        gelatin.AnimationClip("curl"),
        gelatin.AnimationFiles("wave_*.obj", 12.0),
        gelatin.AnimationFrames(np.arange(24.0).reshape(2, 4, 3), 12.0),
        gelatin.AnimationByProgram(),
    ):
        scene.colliders.append(gelatin.Collider(gelatin.File("wave.glb"), animation=gelatin.Animation(source, 1.0, 2.0, True)))
    scene.attachments = [
        gelatin.Attachment("o", "belt", ball, 0.1, 2.0, "hook", line=8),
        gelatin.Attachment("o", where=gelatin.AttachedPoint((1.0, 2.0, 3.0))),
        gelatin.Attachment("o", where=gelatin.AttachedLine((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))),
        gelatin.Attachment("o", "belt"),
        gelatin.Attachment("r", where=gelatin.AttachedRail((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), limits=(-1.0, 2.0)),
        gelatin.Attachment("r", where=gelatin.AttachedUniversal((1.0, 2.0, 3.0), (4.0, 0.0, 0.0), (0.0, 5.0, 0.0))),
        gelatin.Attachment("r", where=gelatin.AttachedDistance((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), spring=gelatin.JointSpring(1.0, 2.0, 3.0)),
        gelatin.Attachment(
            "r",
            where=gelatin.AttachedLine((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)),
            motor=gelatin.JointMotor(1.0, 2.0, 3.0, [gelatin.MotorKeyframe(4.0, 5.0, 6.0, 7.0)]),
        ),
    ]
    scene.camera = gelatin.Camera((1.0, 2.0, 3.0), (4.0, 5.0, 6.0), 40.0)
    scene.file = "scene.toml"
    return scene


def instances_in(value):
    """All dataclasses' instances in a value, itself among them."""
    if dataclasses.is_dataclass(value):
        yield value
        for field in dataclasses.fields(value):
            yield from instances_in(getattr(value, field.name))
    elif isinstance(value, list):
        for element in value:
            yield from instances_in(element)


def test_every_field_goes_to_c_and_back():
    scene = scene_with_everything()
    assert _gelatin.same(scene) == scene


def test_the_scene_with_everything_has_no_default_anywhere():
    """Otherwise a field that is never transferred could pass the test before this one."""
    left = {}
    for instance in instances_in(scene_with_everything()):
        for field in dataclasses.fields(instance):
            name = f"{type(instance).__name__}.{field.name}"
            has_default = field.default is not dataclasses.MISSING or field.default_factory is not dataclasses.MISSING
            default = field.default_factory() if field.default_factory is not dataclasses.MISSING else field.default
            left[name] = left.get(name, True) and has_default and getattr(instance, field.name) == default
    assert [name for name, is_default in left.items() if is_default] == ["Scene.meshes"]  # see recording_test.py


def test_defaults_are_those_of_c():
    classes = _gelatin.defaults()
    assert len(classes) > 20
    for name, fields in classes.items():
        for field in dataclasses.fields(getattr(gelatin, name)):
            if field.default is not dataclasses.MISSING:
                default = field.default
            elif field.default_factory is not dataclasses.MISSING:
                default = field.default_factory()
            else:
                continue
            if (name, field.name) == ("Handle", "region"):  # C++ has no empty region, and does not use that of a skeleton
                continue
            assert fields[field.name] == default, f"{name}.{field.name}"


def test_words_are_those_of_scene_files(tmp_path):
    file = tmp_path / "words.toml"
    for solver in ("explicit_euler", "semi_implicit_euler", "midpoint", "rk4", "implicit"):
        scene = gelatin.load("scenes/bounce.toml", {"simulation.solver": solver})
        assert scene.simulation.solver == solver
    for key, word in (
        ("simulation.forces", "divide_and_merge"),
        ("collision.broad_phase", "boxes"),
        ("collision.detection", "continuous"),
        ("collision.response", "restore"),
    ):
        scene = gelatin.load("scenes/bounce.toml", {"simulation.solver": "rk4", key: word})
        section, field = key.split(".")
        assert getattr(getattr(scene, section), field) == word
    file.write_text(
        '[[material]]\nname = "m"\nmodel = "neo_hookean"\n'
        '[[object]]\nname = "o"\nmesher = { kind = "lattice" }\nshape = { sphere = 1 }\n'
        'handle = [{ region = { plane = [0, 1, 0], offset = 0 }, interpolation = "smooth", when_blocked = "stops", '
        "  keyframes = [{ time = 0 }, { time = 1, move = [0, 1, 0] }] }]\n"
    )
    scene = gelatin.load(file)
    assert scene.materials[0].model == "neo_hookean"
    assert scene.objects[0].mesher.kind == "lattice"
    assert (scene.objects[0].handles[0].interpolation, scene.objects[0].handles[0].when_blocked) == ("smooth", "stops")


@pytest.mark.parametrize("file", sorted(Path("scenes").glob("*.toml")), ids=lambda file: file.stem)
def test_loaded_scenes_go_through(file):
    scene = gelatin.load(file)
    assert _gelatin.same(scene) == scene
    scene.validate()


def test_overrides():
    by_dict = gelatin.load("scenes/bounce.toml", {"simulation.frames": 7, "simulation.gravity": (0, -1, 0)})
    by_list = gelatin.load("scenes/bounce.toml", ["simulation.frames=7", "simulation.gravity=[0,-1,0]"])
    assert by_dict == by_list
    assert by_dict.simulation.frames == 7 and by_dict.simulation.gravity == (0, -1, 0)
    assert gelatin.load("scenes/bounce.toml", "simulation.frames=7").simulation.frames == 7
    with pytest.raises(TypeError, match="overrides = 7: must be a list of str"):
        gelatin.load("scenes/bounce.toml", 7)


def test_overrides_take_what_programs_have(tmp_path):
    file = tmp_path / "a.toml"
    file.write_text('[[material]]\nname = "jelly"\n[[object]]\nname = "ball"\nshape = { sphere = 0.1 }\n')
    changed = gelatin.load(
        file,
        {
            "object.ball.position": [np.float32(1), np.int64(2), 3],
            "object.ball.name": "\N{GRINNING FACE}",
            "simulation.frame_rate": np.float64(50),
        },
    )
    assert changed.objects[0].position == (1, 2, 3) and changed.objects[0].name == "\N{GRINNING FACE}"
    assert changed.simulation.frame_rate == 50
    with pytest.raises(gelatin.InvalidInput, match="frame_rate = nan"):
        gelatin.load(file, {"simulation.frame_rate": float("nan")})
    with pytest.raises(TypeError, match="simulation.frame_rate"):
        gelatin.load(file, {"simulation.frame_rate": {"a": 1}})



def test_vectors_may_be_arrays():
    scene = scene_with_everything()
    scene.objects[0].position = np.array([1, 2, 3], dtype=np.float32)
    scene.objects[1].shape.frequency = np.int64(3)
    same = _gelatin.same(scene)
    assert same.objects[0].position == (1.0, 2.0, 3.0)
    assert same.objects[1].shape.frequency == 3


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda s: setattr(s.materials[0], "density", "heavy"), "material.a.density = 'heavy': must be a number"),
        (lambda s: setattr(s.simulation, "frames", 2.5), "simulation.frames = 2.5: must be an integer"),
        (lambda s: setattr(s.simulation, "substeps", 2.5), 'simulation.substeps = 2.5: must be "auto" or an integer'),
        (lambda s: setattr(s.simulation, "substeps", "many"), "simulation.substeps = 'many': must be \"auto\" or an integer"),
        (lambda s: setattr(s.objects[0], "position", (1, 2)), "object.o.position = (1, 2): must be three numbers"),
        (lambda s: setattr(s.objects[0], "position", "abc"), "object.o.position = 'abc': must be three numbers"),
        (lambda s: setattr(s.objects[0], "position", (1, 2, "x")), "object.o.position[2] = 'x': must be a number"),
        (lambda s: setattr(s.objects[0], "position", np.zeros((9, 9))), "object.o.position = ndarray: must be three numbers"),
        (lambda s: setattr(s.objects[0], "shape", 3), "object.o.shape = 3: must be one of Sphere, Box, Capsule, Text, File, Mesh"),
        (lambda s: setattr(s.objects[1].shape, "radius", None), "object.o.shape.radius = None: must be a number"),
        (lambda s: setattr(s.objects[0], "pins", "top"), "object.o.pins = 'top': must be a list"),
        (lambda s: s.objects[0].pins.append(3), "object.o.pins[3] = 3: must be one of BoxRegion, SphereRegion, HalfSpaceRegion"),
        (lambda s: setattr(s.objects[5].rigid, "mass", "much"), "object.r.rigid.mass = 'much': must be a number"),
        (lambda s: setattr(s.objects[5].rigid, "inertia", 3), "object.r.rigid.inertia = 3: must be three numbers"),
        (lambda s: setattr(s.objects[5], "rigid", True), "object.r.rigid = True: must be a Rigid"),
        (lambda s: setattr(s.objects[0], "skin", "no"), "object.o.skin = 'no': must be True or False"),
        (lambda s: setattr(s.colliders[0], "position", ()), "colliders[0].position = (): must be three numbers"),
        (lambda s: setattr(s.colliders[1], "position", ()), "collider.belt.position = (): must be three numbers"),
        (lambda s: setattr(s.attachments[1], "to", None), "attachments[1].to = None: must be a str"),
        (
            lambda s: setattr(s.attachments[0], "where", 3),
            "attachment.hook.where = 3: must be one of None, BoxRegion, SphereRegion, HalfSpaceRegion, AttachedPoint, AttachedLine, "
            "AttachedRail, AttachedUniversal, AttachedDistance",
        ),
        (lambda s: setattr(s.attachments[0], "limits", 3), "attachment.hook.limits = 3: must be two numbers"),
        (lambda s: setattr(s.attachments[0], "limits", (1, 2, 3)), "attachment.hook.limits = (1, 2, 3): must be two numbers"),
        (lambda s: setattr(s.attachments[0], "limits", (1, "x")), "attachment.hook.limits[1] = 'x': must be a number"),
        (lambda s: setattr(s.attachments[0], "spring", 3), "attachment.hook.spring = 3: must be a JointSpring"),
        (lambda s: setattr(s.attachments[0], "motor", {}), "attachment.hook.motor = {}: must be a JointMotor"),
        (lambda s: setattr(s.attachments[7].motor.keyframes[0], "speed", "x"), "attachments[7].motor.keyframes[0].speed = 'x': must be a number"),
        (lambda s: setattr(s, "camera", 3), "camera = 3: must be a Camera"),
        (lambda s: setattr(s.objects[0], "name", 3), "objects[0].name = 3: must be a str"),
    ],
)
def test_wrong_types_are_named(change, message):
    scene = scene_with_everything()
    change(scene)
    with pytest.raises(TypeError) as caught:
        _gelatin.same(scene)
    assert str(caught.value) == message


def test_unknown_words_are_named():
    scene = scene_with_everything()
    scene.simulation.solver = "vdb"
    with pytest.raises(gelatin.InvalidInput, match='simulation.solver.*"vdb".*"midpoint"') as caught:
        _gelatin.same(scene)
    assert caught.value.field == "simulation.solver"


def test_substeps_may_be_automatic_by_name(scene):
    scene.simulation.substeps = "auto"
    assert gelatin.Simulator(scene, backend="cpu").substeps == gelatin.Simulator(falling_ball(), backend="cpu").substeps


def test_misspelled_fields_are_refused():
    with pytest.raises(TypeError):
        gelatin.Scene().add_material("jelly", youngs_moduluss=1)
    with pytest.raises(AttributeError):
        gelatin.Material("jelly").youngs_moduluss = 1


def test_a_wrong_value_has_the_text_and_the_place_of_the_command_line(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text('[[material]]\nname = "m"\ndensity = -1\n')
    with pytest.raises(gelatin.InvalidInput) as caught:
        gelatin.load(file)
    error = caught.value
    assert isinstance(error, ValueError) and isinstance(error, gelatin.Error)
    assert (error.file, error.line) == (str(file), 3)
    assert error.value == "-1" and "density" in error.field
    assert "greater than 0" in str(error)


def test_add_takes_paths_and_materials():
    scene = gelatin.Scene()
    jelly = scene.add_material("jelly")
    scene.collision.friction = 0.9
    assert scene.add("crate", "scenes/meshes/crate.obj", material=jelly).shape == gelatin.File("scenes/meshes/crate.obj")
    assert scene.objects[0].material == "jelly"
    assert scene.add("ball", gelatin.Sphere()).material == "jelly"
    assert scene.add_collider().friction == 0.9
    assert scene.add_collider(friction=0.1).friction == 0.1
    scene.add_material("rubber")
    scene.add("other", gelatin.Sphere())
    with pytest.raises(gelatin.InvalidInput, match='object.other: needs "material": one of jelly or rubber'):
        scene.validate()


def test_rigid_bodies_are_added_as_objects_are():
    scene = gelatin.Scene()
    wood = scene.add_material("wood")
    crate = scene.add_rigid("crate", "scenes/meshes/crate.obj", wood, mass=3, position=(0, 2, 0), color=(1, 0, 0))
    assert crate == gelatin.Object(
        "crate", gelatin.File("scenes/meshes/crate.obj"), "wood", position=(0, 2, 0), color=(1, 0, 0), rigid=gelatin.Rigid(mass=3)
    )
    assert scene.add_rigid("stone", gelatin.Sphere()).rigid == gelatin.Rigid()
    assert scene.add_rigid("plate", gelatin.Box(), material="wood", inertia=np.ones(3)).material == "wood"
    assert scene.add("ball", gelatin.Sphere()).rigid is None
    assert scene.objects[0] is crate and len(scene.objects) == 4
    scene.add_attachment(crate, "stone", gelatin.AttachedPoint((0.0, 1.0, 0.0)))
    scene.validate()
    with pytest.raises(TypeError):
        scene.add_rigid("other", gelatin.Sphere(), weight=3)


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda s: setattr(s.objects[0].rigid, "mass", 0), "rigid.crate.mass = 0: must be greater than 0"),
        (lambda s: setattr(s.objects[0].rigid, "inertia", (1, 1, 3)), "rigid.crate.inertia[2] = 3: must be at most the sum of the other two, 2"),
        (lambda s: setattr(s.objects[0], "scale", -1), "rigid.crate.scale = -1: must be greater than 0"),
        (lambda s: setattr(s.simulation, "solver", "rk4"), 'rigid.crate: needs simulation.solver = "implicit"'),
        (
            lambda s: s.objects[0].pins.append(gelatin.SphereRegion((0, 0, 0), 1)),
            "rigid.crate.pins: a rigid body has none: an [[attachment]] holds it, and a [[collider]] follows keyframes",
        ),
        (
            lambda s: setattr(s.objects[0].mesher, "nodes", 100),
            "rigid.crate.mesher: a rigid body has none: it does not deform, and has no tets",
        ),
    ],
)
def test_wrong_values_of_rigid_bodies_are_named(change, message):
    scene = gelatin.Scene()
    scene.add_material("wood")
    scene.add_rigid("crate", gelatin.Box())
    change(scene)
    with pytest.raises(gelatin.InvalidInput) as caught:
        scene.validate()
    assert str(caught.value) == message


def test_rigid_bodies_of_files(tmp_path):
    file = tmp_path / "rigid.toml"
    file.write_text(
        '[[material]]\nname = "m"\n[[rigid]]\nname = "a"\nshape = { sphere = 1 }\n[[object]]\nname = "b"\nshape = { sphere = 1 }\n'
        '[[rigid]]\nname = "c"\nshape = { sphere = 1 }\nmass = 5\n'
    )
    scene = gelatin.load(file, {"rigid.a.mass": 2, "rigid.c.inertia": (1, 1, 1)})
    assert [(o.name, o.rigid, o.line) for o in scene.objects] == [
        ("a", gelatin.Rigid(2.0), 3),
        ("b", None, 6),
        ("c", gelatin.Rigid(5.0, (1.0, 1.0, 1.0)), 9),
    ]
    assert _gelatin.same(scene) == scene


def test_attachments_are_added_by_names_or_by_what_has_them():
    scene = gelatin.Scene()
    scene.add_material("jelly")
    ball = scene.add("ball", gelatin.Sphere())
    scene.add("beam", gelatin.Box())
    post = scene.add_collider(gelatin.Sphere(), name="post")
    joint = gelatin.AttachedPoint((0.0, 1.0, 0.0))
    assert scene.add_attachment(ball, "beam", joint, break_force=5.0) == gelatin.Attachment("ball", "beam", joint, break_force=5.0)
    assert scene.add_attachment("beam", ball).to == "ball"
    assert scene.add_attachment("beam", post).to == "post"
    assert scene.add_attachment("ball", where=joint).to == ""
    assert len(scene.attachments) == 4
    scene.validate()
    scene.attachments[0].to = "bean"
    with pytest.raises(gelatin.InvalidInput, match=r"attachment\[0\].to .*did you mean .beam.*there is beam and post"):
        scene.validate()
    with pytest.raises(gelatin.InvalidInput, match="a collider without a name"):
        scene.add_attachment(ball, scene.add_collider())


def test_attachments_of_files(tmp_path):
    file = tmp_path / "attached.toml"
    file.write_text(
        '[[material]]\nname = "m"\n[[object]]\nname = "a"\nshape = { sphere = 1 }\n[[object]]\nname = "b"\nshape = { sphere = 1 }\n'
        '[[attachment]]\nobject = "a"\nto = "b"\n[[attachment]]\nname = "hinge"\nobject = "b"\nline = [[0, 1, 0], [0, 1, 2]]\n'
    )
    glue, hinge = gelatin.load(file, {"attachment.hinge.compliance": 0.5}).attachments
    assert glue == gelatin.Attachment("a", "b", line=9)
    assert hinge == gelatin.Attachment("b", "", gelatin.AttachedLine((0.0, 1.0, 0.0), (0.0, 1.0, 2.0)), 0.5, None, "hinge", 12)


def test_joints_of_files(tmp_path):
    file = tmp_path / "joints.toml"
    file.write_text(
        '[[material]]\nname = "m"\n[[rigid]]\nname = "a"\nshape = { sphere = 1 }\n[[rigid]]\nname = "b"\nshape = { sphere = 1 }\n'
        '[[attachment]]\nname = "hinge"\nobject = "a"\nto = "b"\nline = [[0, 1, 0], [0, 1, 2]]\nlimits = [0, 90]\nspring = { stiffness = 3 }\n'
        'motor = { speed = 5, keyframes = [{ time = 1, force = 2 }] }\n'
        '[[attachment]]\nobject = "a"\nuniversal = { point = [0, 1, 0], own = [1, 0, 0], of_other = [0, 0, 1] }\n'
        '[[attachment]]\nobject = "a"\nrail = [[0, 1, 0], [0, 2, 0]]\n[[attachment]]\nobject = "b"\ndistance = [[0, 1, 0], [0, 3, 0]]\n'
    )
    hinge, universal, rail, rod = gelatin.load(file, {"attachment.hinge.motor.speed": 90, "attachment.hinge.limits": [-5, 90]}).attachments
    assert hinge.limits == (-5.0, 90.0) and hinge.spring == gelatin.JointSpring(3.0)
    assert hinge.motor == gelatin.JointMotor(90.0, keyframes=[gelatin.MotorKeyframe(1.0, force=2.0)])
    assert universal.where == gelatin.AttachedUniversal((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    assert rail.where == gelatin.AttachedRail((0.0, 1.0, 0.0), (0.0, 2.0, 0.0))
    assert rod.where == gelatin.AttachedDistance((0.0, 1.0, 0.0), (0.0, 3.0, 0.0))
    assert rod.limits is None and rod.spring is None and rod.motor is None


@pytest.mark.parametrize(
    "fields, message",
    [
        ({"limits": (10, 20)}, "attachment.hinge.limits = [10, 20]: must include 0, where the joint is at the start"),
        ({"spring": gelatin.JointSpring()}, "attachment.hinge.spring: needs a stiffness or a damping above 0"),
        ({"motor": gelatin.JointMotor(force=3)}, "attachment.hinge.motor: needs a speed or a position"),
        ({"motor": gelatin.JointMotor(3), "to": "jelly"}, "attachment.hinge.motor: at a line both sides must be rigid, and 'jelly' is deformable"),
        ({"where": gelatin.AttachedPoint((0, 0, 0)), "limits": (0, 1)}, "attachment.hinge.limits = [0, 1]: needs a line, a rail or a distance"),
    ],
)
def test_wrong_values_of_joints_are_named(fields, message):
    scene = gelatin.Scene()
    scene.add_material("m")
    scene.add_rigid("door", gelatin.Box())
    scene.add("jelly", gelatin.Box())
    scene.add_attachment("door", **{"where": gelatin.AttachedLine((0, 0, 0), (0, 1, 0)), "name": "hinge", **fields})
    with pytest.raises(gelatin.InvalidInput) as caught:
        scene.validate()
    assert str(caught.value) == message
