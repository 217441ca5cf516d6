"""Which runs a sweep has, and the scenes of their settings: keys, draws, one line for what is wrong."""

import numpy as np
import pytest
from conftest import falling_ball

import gelatin
from gelatin.sweep_command import values_of
from gelatin.sweep_settings import Plan, digest, find, plan_runs, scene_with, with_absolute_paths


def test_runs_are_all_combinations():
    plans = plan_runs({"a": [1, 2], "b": np.array([0.5, 0.25])}, [{"c": "x"}, {"c": "y"}], [7, 8])
    assert len(plans) == 16
    assert [(plan.settings, plan.seed) for plan in plans[:3]] == [
        ({"c": "x", "a": 1, "b": 0.5}, 7),
        ({"c": "x", "a": 1, "b": 0.5}, 8),
        ({"c": "x", "a": 1, "b": 0.25}, 7),
    ]
    assert len({plan.name for plan in plans}) == 16
    assert len(plan_runs({"a": [1, 1.0]}, None, None)) == 1  # the same value


def test_names_of_runs_stay():
    """Folders of earlier versions are found again by them."""
    assert Plan({"b": 100000, "a": [1, 2.5], "c": "x", "d": True}, 3).name == Plan({"a": [1, 2.5], "b": 1e5, "c": "x", "d": True}, 3).name
    assert Plan({"material.jelly.youngs_modulus": 1e5}, 3).name == "038bb9d3a5a2"


def test_a_seed_draws_the_same_in_every_combination():
    vary = {"a": [1, 2], "b": gelatin.Between(0.0, 1.0), "c": gelatin.Between(0.0, 1.0)}
    first, second = plan_runs(vary, None, 3), plan_runs({**vary, "d": [0]}, None, [2])
    assert first[0].settings["b"] == first[3].settings["b"]
    assert first[0].settings["b"] != first[0].settings["c"]
    assert second[0].settings["b"] == first[2].settings["b"]


def test_draws_are_between_their_ends():
    numbers = [gelatin.Between(2, 4).draw(seed, "n") for seed in range(100)]
    assert set(numbers) == {2, 3, 4} and all(type(number) is int for number in numbers)
    moduli = np.array([gelatin.Between(1e4, 1e6, log=True).draw(seed, "e") for seed in range(2000)])
    assert moduli.min() >= 1e4 and moduli.max() <= 1e6
    assert abs((moduli < 1e5).mean() - 0.5) < 0.05  # four standard deviations
    places = np.array([gelatin.Between([0, 1.0, 5], [1, 1.0, 6]).draw(seed, "x") for seed in range(100)])
    assert places.shape == (100, 3) and (places[:, 1] == 1).all() and places[:, 2].min() >= 5


@pytest.mark.parametrize(
    "arguments, message",
    [
        (({"a": 3}, None, None), "vary: a: must be a list of values, or a gelatin.Between, not 3"),
        (({"a": "rk4"}, None, None), "vary: a: must be a list of values"),
        (({"a": []}, None, None), "vary: a: has no values"),
        (({"a": [object()]}, None, None), "a: must be a number, a text or a list of these, not object"),
        (({"seed": [1]}, None, None), "vary: seed: is a column of every table"),
        (({"a": gelatin.Between(0, 1)}, None, None), "vary: a: is drawn by seeds, and there are none"),
        (({}, [], None), "samples: is empty"),
        (({}, None, 0), "seeds: 0: must be"),
        (({}, None, [-1]), r"seeds: \[-1\]: must be"),
        (({}, None, "3"), "seeds: '3': must be"),
    ],
)
def test_what_is_no_sweep_is_one_line(arguments, message):
    with pytest.raises(gelatin.InvalidInput, match=message) as caught:
        plan_runs(*arguments)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("ends", [(2, 1), (float("nan"), 1), ("a", "b"), ([0, 1], 2)])
def test_ends_that_are_none(ends):
    with pytest.raises(gelatin.InvalidInput, match="Between: "):
        gelatin.Between(*ends)
    with pytest.raises(gelatin.InvalidInput, match="greater than 0 with log"):
        gelatin.Between(0, 1, log=True)


def scene_with_names():
    scene = falling_ball()
    ball = scene.objects[0]
    ball.handles.append(gelatin.Handle(gelatin.HalfSpaceRegion((0, 1, 0), 1.6), [gelatin.Keyframe(), gelatin.Keyframe(1.0)]))
    ball.loads.append(gelatin.Load(gelatin.SphereRegion((0, 2, 0), 0.2), gelatin.Pressure(5.0)))
    scene.add_rigid("crate", gelatin.Box(), mass=2.0)
    ball.handles.append(gelatin.Handle(skeleton=gelatin.Skeleton("arm.glb", 0.1)))
    scene.colliders[0].name = "floor"
    scene.add_collider("tentacle.glb", name="tentacle", position=(9, 0, 0), animation=gelatin.Animation(gelatin.AnimationClip("curl")))
    scene.add_collider("a.obj", name="sea", position=(9, 9, 0), animation=gelatin.Animation(gelatin.AnimationFiles("wave_*.obj")))
    scene.add_attachment("ball", "floor", gelatin.AttachedPoint((0.0, 0.0, 0.0)), name="joint")
    motor = gelatin.JointMotor(1.0, keyframes=[gelatin.MotorKeyframe(1.0, 2.0)])
    hinge = gelatin.AttachedLine((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    scene.add_attachment("crate", "", hinge, name="hinge", limits=(-1.0, 1.0), spring=gelatin.JointSpring(1.0), motor=motor)
    return scene


@pytest.mark.parametrize(
    "key, value, read",
    [
        ("simulation.gravity", [0, -1, 0], lambda s: s.simulation.gravity),
        ("material.jelly.youngs_modulus", 1e5, lambda s: s.materials[0].youngs_modulus),
        ("object.ball.position", [1, 2, 3], lambda s: s.objects[0].position),
        ('object."ball".shape.sphere', 0.25, lambda s: s.objects[0].shape.radius),
        ("object.0.mesher.quality", 1.5, lambda s: s.objects[0].mesher.quality),
        ("object.ball.handle.0.keyframes.1.move", [0, 1, 0], lambda s: s.objects[0].handles[0].keyframes[1].move),
        ("object.ball.load.0.pressure", 7.0, lambda s: s.objects[0].loads[0].kind.pressure),
        ("object.ball.load.0.from", 0.5, lambda s: s.objects[0].loads[0].start),
        ("rigid.crate.mass", 3.0, lambda s: s.objects[1].rigid.mass),
        ("rigid.0.inertia", [1, 1, 1], lambda s: s.objects[1].rigid.inertia),
        ("rigid.crate.position", [1, 2, 3], lambda s: s.objects[1].position),
        ("collider.floor.friction", 0.9, lambda s: s.colliders[0].friction),
        ("object.ball.handle.1.skeleton.radius", 0.2, lambda s: s.objects[0].handles[1].skeleton.radius),
        ("object.ball.handle.1.skeleton.clip", "wave", lambda s: s.objects[0].handles[1].skeleton.clip),
        ("collider.tentacle.animation.clip", "wave", lambda s: s.colliders[1].animation.source.name),
        ("collider.tentacle.animation.speed", 2.0, lambda s: s.colliders[1].animation.speed),
        ("collider.sea.animation.files", "surge_*.obj", lambda s: s.colliders[2].animation.source.pattern),
        ("collider.sea.animation.rate", 30.0, lambda s: s.colliders[2].animation.source.rate),
        ("attachment.joint.compliance", 0.5, lambda s: s.attachments[0].compliance),
        ("attachment.0.point", [0, 1, 0], lambda s: s.attachments[0].where.at),
        ("attachment.hinge.limits", [0, 90], lambda s: s.attachments[1].limits),
        ("attachment.hinge.spring.stiffness", 5.0, lambda s: s.attachments[1].spring.stiffness),
        ("attachment.hinge.motor.speed", 90.0, lambda s: s.attachments[1].motor.speed),
        ("attachment.hinge.motor.keyframes.0.speed", 3.0, lambda s: s.attachments[1].motor.keyframes[0].speed),
    ],
)
def test_keys_are_those_of_scene_files(key, value, read):
    scene = scene_with_names()
    before = read(scene)
    assert read(scene_with(scene, {key: value})) == value
    assert read(scene) == before != value


@pytest.mark.parametrize("of_file", [False, True], ids=["scene", "file"])
@pytest.mark.parametrize(
    "key, message",
    [
        ("simulaton.frames", 'a scene has no "simulaton"; it has simulation, collision'),
        ("material.jely.density", 'there is no material "jely"; there are jelly'),
        ("material.jelly.densty", 'material.jelly has no "densty"; it has model, youngs_modulus, density'),
        ("material.jelly", "must name a value, as material.jelly.model does; below it are model, youngs"),
        ("object.ball.mesher", "must name a value, as object.ball.mesher.kind does"),
        ("object.1.scale", 'there is no object "1"; there are ball'),
        ("simulation.frames.x", "simulation.frames is a value, it has no keys"),
        ("material.jelly.density", "density = -1.*greater than 0"),
    ],
)
def test_wrong_settings_are_one_line(key, message, of_file, tmp_path):
    source = falling_ball()
    if of_file:
        source = str(tmp_path / "ball.toml")
        (tmp_path / "ball.toml").write_text(
            '[[material]]\nname = "jelly"\n[[object]]\nname = "ball"\nshape = { sphere = 0.5, frequency = 4 }\nposition = [0, 2, 0]\n'
        )
    with pytest.raises(gelatin.InvalidInput, match=message) as caught:
        scene_with(source, {key: -1})
    assert "\n" not in str(caught.value) and "--set" not in str(caught.value)


def test_objects_and_rigid_bodies_are_told_apart():
    scene = scene_with_names()
    for key, message in (
        ("object.crate.scale", 'there is no object "crate"; there are ball'),
        ("rigid.ball.scale", 'there is no rigid "ball"; there are crate'),
        ("rigid", "must name a value, as rigid.crate does; below it are crate"),
        ("object.ball.mass", "this object has no mass"),
    ):
        with pytest.raises(gelatin.InvalidInput, match=message):
            find(scene, key)
    with pytest.raises(gelatin.InvalidInput, match=r"the scene has no \[\[rigid\]\]"):
        find(falling_ball(), "rigid.crate.mass")


def test_every_key_leads_to_a_field():
    """Of all that a scene of these parts has, so that a renamed field cannot leave a key behind."""
    scene = scene_with_names()
    for key in ("object.ball.load.0.traction", "object.ball.load.0.force"):
        with pytest.raises(gelatin.InvalidInput, match="this load is a pressure"):
            find(scene, key)
    joint = scene.attachments[0]
    for where, key in (
        (gelatin.SphereRegion((0, 2, 0), 0.2), "region.sphere"),
        (gelatin.AttachedLine((0, 0, 0), (0, 0, 1)), "line.end"),
        (gelatin.AttachedRail((0, 0, 0), (0, 0, 1)), "rail.start"),
        (gelatin.AttachedUniversal((0, 0, 0), (0, 0, 1), (1, 0, 0)), "universal.point"),
        (gelatin.AttachedUniversal((0, 0, 0), (0, 0, 1), (1, 0, 0)), "universal.of_other"),
        (gelatin.AttachedDistance((0, 0, 0), (0, 0, 1)), "distance.end"),
        (gelatin.AttachedPoint((0, 0, 0)), "point"),
    ):
        joint.where = where
        owner, field = find(scene, f"attachment.joint.{key}")
        assert owner is where and hasattr(where, field)
    for where in (None, gelatin.AttachedLine((0, 0, 0), (0, 0, 1))):
        joint.where = where
        with pytest.raises(gelatin.InvalidInput, match="this attachment has no point"):
            find(scene, "attachment.joint.point")
    for shape, key in (
        (gelatin.Box(), "box"),
        (gelatin.Capsule(), "capsule"),
        (gelatin.Text("a"), "text"),
        (gelatin.File("a.obj"), "file"),
        (gelatin.Sphere(), "sphere"),
    ):
        scene.objects[0].shape = shape
        owner, field = find(scene, f"object.ball.shape.{key}")
        assert owner is shape and hasattr(shape, field)
    scene.collision.pairs.append(gelatin.MaterialPair("jelly", "jelly"))
    assert find(scene, "collision.pair.0.friction") == (scene.collision.pairs[0], "friction")
    assert find(scene, "collider.floor.shape.plane") == (scene.colliders[0].shape, "normal")


def test_a_digest_tells_scenes_apart(tmp_path):
    mesh = tmp_path / "a.obj"
    mesh.write_text("v 0 0 0\n")
    scene, other = falling_ball(), falling_ball()
    assert digest(scene) == digest(other)
    other.objects[0].line, other.materials[0].density = 5, np.float32(1000)
    assert digest(scene) == digest(other)
    other.materials[0].density = 1001
    assert digest(scene) != digest(other)
    scene.objects[0].shape = gelatin.File(mesh)
    before = digest(scene)
    mesh.write_text("v 0 0 1\n")
    assert digest(scene) != before


def test_a_digest_has_what_moves_vertices(tmp_path):
    scene = falling_ball()
    scene.objects[0].handles = [gelatin.Handle(skeleton=gelatin.Skeleton(tmp_path / "arm.glb", 0.1))]
    scene.add_collider(animation=gelatin.Animation(gelatin.AnimationFiles(tmp_path / "wave_*.obj")))
    scene.add_collider(animation=gelatin.Animation(gelatin.AnimationFrames(np.zeros((2, 4, 3)))))
    digests = [digest(scene)]

    def is_new():
        digests.append(digest(scene))
        return digests.count(digests[-1]) == 1

    assert not is_new()
    for name in ("arm.glb", "wave_1.obj", "wave_2.obj"):
        (tmp_path / name).write_text("a")
        assert is_new(), name
    scene.colliders[2].animation.source.frames[1, 2, 0] = 1.0
    assert is_new()
    scene.colliders[2].animation.source.rate = 30.0
    assert is_new()


def test_files_are_found_from_any_folder(tmp_path):
    scene = scene_with_names()
    scene.file = tmp_path / "scene.toml"
    moved = with_absolute_paths(scene)
    assert moved.objects[0].handles[1].skeleton.file == str(tmp_path / "arm.glb")
    assert moved.colliders[1].shape.file == str(tmp_path / "tentacle.glb")
    assert moved.colliders[2].animation.source.pattern == str(tmp_path / "wave_*.obj")
    assert scene.objects[0].handles[1].skeleton.file == "arm.glb"


@pytest.mark.parametrize(
    "text, values",
    [
        ("1e4,1e5", [1e4, 1e5]),
        ("3", [3]),
        ("rk4,implicit", ["rk4", "implicit"]),
        ('"a, b",true', ["a, b", True]),
        ("[0, 1, 0],[0,2.5,0]", [[0, 1, 0], [0, 2.5, 0]]),
        ("1e4..1e6", gelatin.Between(1e4, 1e6)),
        ("1..5", gelatin.Between(1, 5)),
        ("1e4..1e6:log", gelatin.Between(1e4, 1e6, log=True)),
        ("[0,1,0]..[0,2,0]", gelatin.Between([0, 1, 0], [0, 2, 0])),
    ],
)
def test_values_of_the_command_line(text, values):
    assert values_of(text) == values
