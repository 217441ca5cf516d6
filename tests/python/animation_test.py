"""Colliders whose vertices move: by frames, by files, by clips, by programs; and bones that move nodes."""

import importlib.machinery
import importlib.util
from pathlib import Path

import numpy as np
import pytest
from conftest import same_bits

import gelatin

CORNERS = 0.2 * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
TRIANGLES = [
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
    (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
]  # fmt: skip
RATE, PUSHED = 60, 24  # frames a second, frames of the push
LEFT_OF_BALL = (-0.7, 0, 0)


def places_of_piston():
    """A box that moves by 0.4 along x, and becomes wider across, shape (frames, 8, 3): at no even speed."""
    share = 0.5 - 0.5 * np.cos(np.linspace(0, np.pi, PUSHED + 1))[:, None, None]
    return CORNERS * (1 + share * (0, 0.5, 0.5)) + share * (0.4, 0, 0)


def ball_beside(animation, shape=None, **fields):
    """A soft ball without gravity, 0.2 m to the right of the piston."""
    scene = gelatin.Scene()
    scene.simulation.gravity = (0, 0, 0)
    scene.simulation.frame_rate = RATE
    scene.add_material("jelly", youngs_modulus=2e4, damping=0.02)
    scene.add("ball", gelatin.Sphere(0.3, frequency=3))
    fields = {"position": LEFT_OF_BALL, "name": "piston", **fields}
    scene.add_collider(shape or gelatin.Mesh(CORNERS, TRIANGLES), animation=animation, **fields)
    return scene


def pushed_by_frames():
    return ball_beside(gelatin.Animation(gelatin.AnimationFrames(places_of_piston(), rate=RATE)))


def simulate(scene):
    return gelatin.Simulator(scene, backend="cpu")


def run_program(sim, frames=PUSHED):
    """Sets the vertices of each frame at its begin."""
    for places in places_of_piston()[1 : frames + 1]:
        sim.set_collider_vertices("piston", places)
        sim.advance()


@pytest.fixture(scope="module")
def pushed():
    """Where the nodes of the ball are after frames in memory have pushed it."""
    sim = simulate(pushed_by_frames())
    sim.advance(PUSHED)
    return sim.positions.copy()


@pytest.fixture(scope="module")
def gltf_files(tmp_path_factory):
    """A folder with arm.glb and tentacle.glb."""
    folder = tmp_path_factory.mktemp("gltf")
    loader = importlib.machinery.SourceFileLoader("make_animated_meshes", "scripts/make_animated_meshes")
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    module.make_arm(folder / "arm.glb")
    module.make_tentacle(folder / "tentacle.glb")
    return folder


def test_frames_push_a_ball(pushed):
    """Its nearest node was at -0.3, and the piston's face ends at -0.1."""
    assert pushed[:, 0].min() > -0.1
    rests = ball_beside(None)
    sim = simulate(rests)
    sim.advance(PUSHED)
    np.testing.assert_allclose(sim.positions, sim.rest_positions, atol=1e-6)


def first_contact(**fields):
    """The frame at whose end the piston presses the ball."""
    scene = pushed_by_frames()
    for name, value in fields.items():
        setattr(scene.colliders[0].animation, name, value)
    sim = simulate(scene)
    while not sim.contact_forces.any():
        sim.advance()
        assert sim.frame < 100
    return sim.frame


def test_the_face_is_where_the_frames_have_it():
    reach = np.flatnonzero(LEFT_OF_BALL[0] + places_of_piston()[:, :, 0].max(axis=1) > -0.3)[0]
    assert abs(first_contact() - reach) <= 1  # contacts begin a little before
    assert abs(first_contact(start=0.2) - (reach + 0.2 * RATE)) <= 1
    assert abs(first_contact(speed=0.5) - 2 * reach) <= 2


@pytest.mark.parametrize("loop", [False, True])
def test_a_loop_begins_again(loop):
    """There and back, and there once more: against a ball that is held behind."""
    there = places_of_piston()
    frames = gelatin.AnimationFrames(np.concatenate([there, there[-2::-1]]), RATE)
    scene = ball_beside(gelatin.Animation(frames, loop=loop))
    scene.objects[0].pins = [gelatin.HalfSpaceRegion((-1, 0, 0), -0.1)]
    sim = simulate(scene)
    pressed = []
    for _ in range(3 * PUSHED):
        sim.advance()
        pressed.append(bool(sim.contact_forces.any()))
    assert pressed[PUSHED - 1] and not pressed[2 * PUSHED - 1]
    assert pressed[-1] == loop


def test_a_program_does_the_same(pushed):
    sim = simulate(ball_beside(gelatin.Animation(gelatin.AnimationByProgram())))
    run_program(sim)
    np.testing.assert_allclose(sim.positions, pushed, atol=1e-4)
    half = simulate(ball_beside(gelatin.Animation(gelatin.AnimationByProgram())))
    run_program(half, PUSHED // 2)
    half.advance(PUSHED // 2)  # the piston stays where it is
    assert np.abs(half.positions - pushed).max() > 0.02


def test_vertices_may_be_of_other_kinds(pushed):
    class Tensor:
        """As those of torch: an array by a call of numpy's."""

        def __init__(self, values):
            self.values = values

        def __array__(self, dtype=None, copy=None):
            return np.array(self.values, dtype)

    sims = [simulate(ball_beside(gelatin.Animation(gelatin.AnimationByProgram()))) for _ in range(4)]
    kinds = (lambda v: v, lambda v: v.tolist(), lambda v: Tensor(v), lambda v: np.asfortranarray(v))
    for sim, kind in zip(sims, kinds):
        for places in places_of_piston()[1:]:
            sim.set_collider_vertices("piston", kind(places))
            sim.advance()
        assert same_bits(sim.positions, sims[0].positions)
    np.testing.assert_allclose(sim.positions, pushed, atol=1e-4)


def test_reset_puts_them_back():
    sim, fresh = (simulate(ball_beside(gelatin.Animation(gelatin.AnimationByProgram()))) for _ in range(2))
    run_program(sim)
    assert sim["ball"].center[0] > 0.1
    sim.reset()
    sim.advance(3)
    np.testing.assert_allclose(sim.positions, sim.rest_positions, atol=1e-6)
    sim.reset()
    for each in (sim, fresh):
        run_program(each)
    assert same_bits(sim.positions, fresh.positions)


def test_each_world_of_a_batch_has_its_own(pushed):
    batch = gelatin.Batch(ball_beside(gelatin.Animation(gelatin.AnimationByProgram())), 2)
    for places in places_of_piston()[1:]:
        batch[1].set_collider_vertices("piston", places)
        batch.advance()
    np.testing.assert_allclose(batch.positions[0], batch.rest_positions, atol=1e-6)
    np.testing.assert_allclose(batch.positions[1], pushed, atol=1e-4)


def test_opengl_moves_them_too(needs_gl, pushed):
    sim = gelatin.Simulator(ball_beside(gelatin.Animation(gelatin.AnimationByProgram())), backend="gl")
    run_program(sim)
    np.testing.assert_allclose(sim.positions, pushed, atol=2e-3)


def test_files_do_the_same(tmp_path, pushed):
    """Their names have numbers without zeros in front."""
    faces = "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in TRIANGLES)
    for k, places in enumerate(places_of_piston()):
        (tmp_path / f"piston_{k}.obj").write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in places.tolist()) + faces)
    files = gelatin.AnimationFiles(tmp_path / "piston_*.obj", rate=RATE)
    sim = simulate(ball_beside(gelatin.Animation(files), gelatin.File(tmp_path / "piston_0.obj")))
    sim.advance(PUSHED)
    np.testing.assert_allclose(sim.positions, pushed, atol=1e-4)
    (tmp_path / "piston_7.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.raises(gelatin.InvalidInput, match="piston_7.obj: vertices = 3: must be 8, as in the first file"):
        simulate(ball_beside(gelatin.Animation(files), gelatin.File(tmp_path / "piston_0.obj")))


def test_a_clip_moves_the_shape_of_its_file(gltf_files):
    """The tentacle bends to +x, to where the ball is, and pushes it away."""

    def push(**fields):
        shape = gelatin.File(gltf_files / "tentacle.glb")
        sim = simulate(ball_beside(gelatin.Animation(**fields), shape, position=(-0.7, -0.9, 0), name="tentacle"))
        sim.advance(90)
        return sim["ball"].center

    assert np.linalg.norm(push(source=gelatin.AnimationClip("curl"))) > 0.1
    np.testing.assert_allclose(push(start=3.0), 0, atol=1e-4)  # it has not begun
    with pytest.raises(gelatin.InvalidInput, match="wave: is not there: it has 'curl'"):
        push(source=gelatin.AnimationClip("wave"))


def arm_with(handle):
    """A beam of flesh along y, from -0.6 to 0.6."""
    scene = gelatin.Scene()
    scene.simulation.gravity = (0, 0, 0)
    scene.add_material("flesh", youngs_modulus=2e4, damping=0.02)
    scene.add("arm", gelatin.Box((0.3, 1.2, 0.3)), mesher=gelatin.Mesher("lattice", cell_size=0.1), handles=[handle])
    return scene


def about_z(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def test_bones_move_the_nodes_near_them(gltf_files):
    """At 1.2 s the clip has turned the shoulder by -30 degrees, and the elbow by 100."""
    sim = simulate(arm_with(gelatin.Handle(skeleton=gelatin.Skeleton(gltf_files / "arm.glb", radius=0.08))))
    arm = sim["arm"]
    rest = arm.rest_positions.astype(float)
    near = np.hypot(rest[:, 0], rest[:, 2]) < 0.07
    upper, lower = near & (np.abs(rest[:, 1] + 0.25) < 0.2), near & (np.abs(rest[:, 1] - 0.25) < 0.2)
    assert upper.sum() >= 3 and lower.sum() >= 3
    sim.advance(72)
    shoulder = np.array([0, -0.5, 0])
    elbow = shoulder + about_z(-30) @ (0, 0.5, 0)
    np.testing.assert_allclose(arm.positions[upper], shoulder + (rest[upper] - shoulder) @ about_z(-30).T, atol=1e-3)
    np.testing.assert_allclose(arm.positions[lower], elbow + rest[lower] @ about_z(70).T, atol=1e-3)
    assert sim.holding_forces.any()
    with pytest.raises(gelatin.InvalidInput, match="skeleton"):
        simulate(arm_with(gelatin.Handle(skeleton=gelatin.Skeleton(gltf_files / "arm.glb", radius=1e-4))))


def test_bones_move_in_addition_to_keyframes(gltf_files):
    skeleton = gelatin.Skeleton(gltf_files / "arm.glb", 0.08, "flex", start=10.0)  # it has not begun
    keyframes = [gelatin.Keyframe(), gelatin.Keyframe(0.5, move=(0, 0, 0.2))]
    sim = simulate(arm_with(gelatin.Handle(None, keyframes, skeleton=skeleton)))
    rest = sim.rest_positions.astype(float)
    near = (np.hypot(rest[:, 0], rest[:, 2]) < 0.07) & (np.abs(rest[:, 1]) < 0.5)
    sim.advance(30)
    np.testing.assert_allclose(sim.positions[near], rest[near] + (0, 0, 0.2), atol=1e-3)


def test_animations_and_skeletons_of_scene_files(tmp_path):
    file = tmp_path / "moving.toml"
    file.write_text(
        '[[material]]\nname = "m"\n[[object]]\nname = "a"\nshape = { sphere = 1 }\n'
        'handle = [{ skeleton = { file = "arm.glb", radius = 0.1, clip = "flex", start = 1, speed = 2, loop = true } }]\n'
        '[[collider]]\nname = "clip"\nshape = { file = "a.glb" }\nanimation = { clip = "curl", start = 1, speed = 2, loop = true }\n'
        '[[collider]]\nshape = { file = "a.glb" }\nanimation = {}\n'
        '[[collider]]\nname = "files"\nshape = { file = "a_1.obj" }\nanimation = { files = "a_*.obj", rate = 30 }\n'
        '[[collider]]\nshape = { sphere = 1 }\nposition = [0, 9, 0]\nanimation = { by_program = true }\n'
    )
    scene = gelatin.load(file, {"collider.clip.animation.speed": 3, "object.a.handle.0.skeleton.radius": 0.2})
    (handle,) = scene.objects[0].handles
    assert handle.region is None
    assert handle.skeleton == gelatin.Skeleton(str(tmp_path / "arm.glb"), 0.2, "flex", 1.0, 2.0, True)
    assert [collider.animation for collider in scene.colliders] == [
        gelatin.Animation(gelatin.AnimationClip("curl"), 1.0, 3.0, True),
        gelatin.Animation(),
        gelatin.Animation(gelatin.AnimationFiles(str(tmp_path / "a_*.obj"), 30.0)),
        gelatin.Animation(gelatin.AnimationByProgram()),
    ]
    assert gelatin._gelatin.same(scene) == scene


def test_frames_are_converted_once():
    given = places_of_piston().astype(np.float32)
    frames = gelatin.AnimationFrames(given, 30)
    given[:] = 0
    assert frames.frames.dtype == np.float64 and frames.frames.shape == (PUSHED + 1, 8, 3)
    assert frames == gelatin.AnimationFrames(places_of_piston().astype(np.float32).tolist(), 30.0)
    assert frames != gelatin.AnimationFrames(given, 30.0) and frames != gelatin.AnimationFrames(frames.frames, 24.0)
    assert repr(frames) == f"<gelatin.AnimationFrames: {PUSHED + 1} frames of 8 vertices>"
    scene = ball_beside(gelatin.Animation(frames))
    assert gelatin._gelatin.same(scene) == scene


@pytest.mark.parametrize(
    "frames, error, message",
    [
        (CORNERS, gelatin.InvalidInput, "frames must have the shape (frames, vertices, 3), not (8, 3)"),
        (np.zeros((5, 8, 2)), gelatin.InvalidInput, "frames must have the shape (frames, vertices, 3), not (5, 8, 2)"),
        (None, gelatin.InvalidInput, "frames must have the shape (frames, vertices, 3), not ()"),
        ([[(0, 0, 0)], [(0, 0)]], TypeError, "frames = [[(0, 0, 0)], [(0, 0)]]: must be numbers of the shape (frames, vertices, 3)"),
        ("waves", TypeError, "frames = 'waves': must be numbers of the shape (frames, vertices, 3)"),
    ],
)
def test_frames_of_a_wrong_shape_are_named(frames, error, message):
    with pytest.raises(error) as caught:
        gelatin.AnimationFrames(frames)
    assert str(caught.value) == message
    scene = pushed_by_frames()
    scene.colliders[0].animation.source.frames = frames  # a scene is plain data: this is found later
    with pytest.raises(error) as caught:
        scene.validate()
    assert str(caught.value) == f"collider.piston.animation.source.{message}"


def test_wrong_animations_are_named(tmp_path):
    by_frames, by_program = gelatin.AnimationFrames(places_of_piston()), gelatin.AnimationByProgram()
    invalid = gelatin.InvalidInput
    lost = places_of_piston()
    lost[3, 2] = (1, np.nan, 1)
    for change, error, message in (
        (lambda a: setattr(a, "source", gelatin.AnimationClip("wave")), invalid, 'animation.clip = "wave": needs a shape from a .gltf or .glb file'),
        (lambda a: setattr(a, "source", gelatin.AnimationFiles(tmp_path / "a_*.obj")), invalid, "needs a shape from a file"),
        (lambda a: setattr(a, "source", gelatin.AnimationFrames(np.zeros((0, 8, 3)))), invalid, "animation.frames: must be one or more"),
        (lambda a: setattr(a, "source", gelatin.AnimationFrames(places_of_piston()[:, 1:])), invalid, "its animation has 7"),
        (lambda a: setattr(a, "source", gelatin.AnimationFrames(lost)), invalid, "animation.frames[3] = [1, nan, 1]: vertex 2 must be finite"),
        (lambda a: setattr(a.source, "rate", 0), invalid, "animation.rate = 0: must be greater than 0"),
        (lambda a: setattr(a, "start", -1), invalid, "animation.start = -1: must be 0 or more"),
        (lambda a: setattr(a, "speed", 0), invalid, "animation.speed = 0: must be greater than 0"),
        (lambda a: setattr(a, "loop", "yes"), TypeError, "collider.piston.animation.loop = 'yes': must be True or False"),
        (
            lambda a: setattr(a, "source", places_of_piston()),
            TypeError,
            "collider.piston.animation.source = ndarray: must be one of AnimationClip, AnimationFiles, AnimationFrames, AnimationByProgram",
        ),
    ):
        scene = ball_beside(gelatin.Animation(by_frames))
        change(scene.colliders[0].animation)
        with pytest.raises(error) as caught:
            simulate(scene)
        assert message in str(caught.value) and "\n" not in str(caught.value)
        by_frames.rate = 24.0
    with pytest.raises(TypeError, match="collider.piston.animation = <.*>: must be an Animation"):
        ball_beside(by_frames).validate()
    plane = ball_beside(None)
    plane.colliders[0] = gelatin.Collider(gelatin.Plane(), animation=gelatin.Animation(by_program))
    with pytest.raises(invalid, match="animation: a plane does not move"):
        plane.validate()


def test_wrong_vertices_are_named():
    sim = simulate(ball_beside(gelatin.Animation(gelatin.AnimationByProgram())))
    moved, invalid = places_of_piston()[1], gelatin.InvalidInput
    broken = np.where(np.arange(8)[:, None] == 3, np.nan, moved)
    by_frames = simulate(pushed_by_frames())
    for wrong, error, message in (
        (lambda: sim.set_collider_vertices("piston", moved[1:]), invalid, "collider 'piston': 7 vertices: its shape has 8"),
        (lambda: sim.set_collider_vertices("pistol", moved), invalid, "there is no collider 'pistol' that a program moves"),
        (lambda: sim.set_collider_vertices("ball", moved), invalid, "there is no collider 'ball' that a program moves"),
        (lambda: by_frames.set_collider_vertices("piston", moved), invalid, "there is no collider 'piston' that a program moves"),
        (lambda: sim.set_collider_vertices("piston", moved[:, :2]), invalid, "vertices must have the shape (vertices, 3), not (8, 2)"),
        (lambda: sim.set_collider_vertices("piston", (0, 0, 0)), invalid, "vertices must have the shape (vertices, 3), not (3,)"),
        (lambda: sim.set_collider_vertices("piston", broken), invalid, "collider 'piston': vertices[3] = [nan, nan, nan]: must be finite"),
        (lambda: sim.set_collider_vertices("piston", "up"), TypeError, "vertices = 'up': must be numbers of the shape (vertices, 3)"),
        (lambda: sim.set_collider_vertices(0, moved), TypeError, "collider = 0: must be a str"),
    ):
        with pytest.raises(error) as caught:
            wrong()
        assert str(caught.value) == message
    sim.advance(3)  # what was refused has moved nothing
    np.testing.assert_allclose(sim.positions, sim.rest_positions, atol=1e-6)


def test_colliders_without_a_name_go_by_their_place(pushed):
    sim = simulate(ball_beside(gelatin.Animation(gelatin.AnimationByProgram()), name=""))
    for places in places_of_piston()[1:]:
        sim.set_collider_vertices("collider 1", places)
        sim.advance()
    np.testing.assert_allclose(sim.positions, pushed, atol=1e-4)


def test_wrong_handles_are_named(tmp_path):
    region = gelatin.HalfSpaceRegion((0, 1, 0), 0)
    skeleton = gelatin.Skeleton(tmp_path / "arm.glb", 0.1)
    for handle, error, message in (
        (gelatin.Handle(), gelatin.InvalidInput, "object.arm.handles[0]: must have exactly one of region or skeleton"),
        (gelatin.Handle(region, skeleton=skeleton), gelatin.InvalidInput, "object.arm.handles[0]: must have exactly one of region or skeleton, has both"),
        (
            gelatin.Handle(3),
            TypeError,
            "object.arm.handles[0].region = 3: must be one of BoxRegion, SphereRegion, HalfSpaceRegion",
        ),
        (gelatin.Handle(skeleton="arm.glb"), TypeError, "object.arm.handles[0].skeleton = 'arm.glb': must be a Skeleton"),
        (gelatin.Handle(skeleton=gelatin.Skeleton("arm.obj", 0.1)), gelatin.InvalidInput, '.skeleton.file = "arm.obj": must end in .gltf or .glb'),
        (gelatin.Handle(skeleton=gelatin.Skeleton("arm.glb", 0)), gelatin.InvalidInput, ".skeleton.radius = 0: must be greater than 0"),
        (gelatin.Handle(skeleton=skeleton), gelatin.InvalidInput, "arm.glb"),  # there is no such file
    ):
        with pytest.raises(error) as caught:
            simulate(arm_with(handle))
        assert message in str(caught.value)
    arm_with(gelatin.Handle(region)).validate()


def test_a_recipe_of_the_cookbook(tmp_path, monkeypatch, needs_gl):
    """The wave lifts the balls, and lets them down again."""
    page = Path("docs/cookbook.md").read_text(encoding="utf-8")
    recipe = page[page.index("## A collider that a program moves") :]
    program = recipe[recipe.index("```python\n") + len("```python\n") :]
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(compile(program[: program.index("```")], "docs/cookbook.md", "exec"), names)
    assert (tmp_path / "waves.png").stat().st_size > 1000
    heights = [body.center[1] for body in names["simulator"]]
    assert min(heights) > 0.0 and np.ptp(heights) > 0.05
