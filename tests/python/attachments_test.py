"""What objects are attached to: from the start or from a program, how hard it pulls, and that it breaks."""

import numpy as np
import pytest

import gelatin

LOWER = ("lower", "upper")


def two_boxes(attach=True, **fields):
    """One is held at its top, the other one glued below it: at rest the glue carries the lower one."""
    scene = gelatin.Scene()
    scene.add_material("rubber", youngs_modulus=2e5, density=1000, damping=0.02)
    shape = gelatin.Box((0.4, 0.4, 0.4), segments=(2, 2, 2))
    scene.add("upper", shape, position=(0, 2, 0), pins=[gelatin.HalfSpaceRegion((0, -1, 0), -2.19)])
    scene.add("lower", shape, position=(0, 1.598, 0))
    if attach:
        scene.add_attachment(*LOWER, **fields)
    return scene


def simulate(scene):
    return gelatin.Simulator(scene, backend="cpu")


def test_glue_carries_what_hangs_on_it():
    sim = simulate(two_boxes(name="glue"))
    sim.advance(240)
    weight = 9.81 * sim["lower"].mass
    (glue,) = sim.attachments()
    assert glue["name"] == "glue" and not glue["is_broken"]
    assert glue["force"] == pytest.approx((0, weight, 0), abs=0.02 * weight)
    assert sim.statistics()["attachments"] == sim.attachments()
    assert simulate(two_boxes(attach=False)).attachments() == []


def test_it_breaks():
    weight = 9.81 * simulate(two_boxes())["lower"].mass
    sim = simulate(two_boxes(break_force=0.5 * weight))
    sim.advance(60)
    (glue,) = sim.attachments()
    assert glue["name"] == "attachment 1" and glue["is_broken"]
    assert np.linalg.norm(glue["force"]) > 0.5 * weight
    assert sim["lower"].center[1] < 0
    sim.reset()
    assert not sim.attachments()[0]["is_broken"]


@pytest.mark.parametrize("which", [0, "glue"])
def test_what_is_detached_falls(which):
    sim = simulate(two_boxes(name="glue"))
    sim.advance(300)
    rest, time = sim["lower"].center[1], sim.time
    sim.detach(which)
    sim.advance(30)
    assert sim.attachments()[0]["is_broken"]
    assert rest - sim["lower"].center[1] == pytest.approx(0.5 * 9.81 * (sim.time - time) ** 2, rel=0.05)


def test_programs_attach():
    scene = two_boxes(attach=False)
    sim = simulate(scene)
    assert sim.attach(scene.objects[1], scene.objects[0], name="glue") == 0
    # Where it is then: a joint in space.
    assert sim.attach(gelatin.Attachment("lower", where=gelatin.AttachedPoint((0, 1.5, 0)), name="joint")) == 1
    assert [attachment.name for attachment in sim.scene.attachments] == ["glue", "joint"] and not scene.attachments
    sim.advance(60)
    sim.detach("joint")
    sim.advance(240)
    weight = 9.81 * sim["lower"].mass
    assert sim.attachments()[0]["force"][1] == pytest.approx(weight, rel=0.02)
    sim.reset()
    assert sim.attachments() == [] and sim.scene.attachments == []
    sim.advance(60)
    assert sim["lower"].center[1] < 0


def test_a_name_can_be_used_again(tmp_path):
    sim = simulate(two_boxes(attach=False))
    for _ in range(3):
        sim.attach(*LOWER, name="grip")
        with pytest.raises(gelatin.InvalidInput, match='name = "grip": is taken by another attachment'):
            sim.attach(*LOWER, name="grip")
        sim.advance(2)
        sim.detach("grip")
    assert sim.attach(*LOWER, name="grip") == 3
    for names in [[each["name"] for each in sim.attachments()], [each.name for each in sim.scene.attachments]]:
        assert names[3] == "grip" and names.count("grip") == 1
    assert [each["is_broken"] for each in sim.attachments()] == [True, True, True, False]
    sim.save_checkpoint(tmp_path / "a.ckpt")
    other = simulate(two_boxes(attach=False))
    other.load_checkpoint(tmp_path / "a.ckpt")
    assert other.attachments() == sim.attachments() and other.scene.attachments == sim.scene.attachments
    sim.reset()
    assert sim.attachments() == sim.scene.attachments == []
    # Those of the scene come back with a reset, and keep their names.
    sim = simulate(two_boxes(name="glue"))
    sim.detach("glue")
    with pytest.raises(gelatin.InvalidInput, match="is taken"):
        sim.attach(*LOWER, name="glue")


def test_what_falls_is_caught_where_it_is():
    sim = simulate(two_boxes(attach=False))
    sim.advance(20)
    caught = sim["lower"].center
    sim.attach("lower", where=gelatin.SphereRegion(tuple(caught), 0.25))
    sim.advance(240)
    np.testing.assert_allclose(sim["lower"].center, caught, atol=0.02)


def test_checkpoints_have_what_programs_attached(tmp_path):
    scene = two_boxes(attach=False)
    sim, other = simulate(scene), simulate(scene)
    sim.advance(10)
    sim.attach("lower", where=gelatin.AttachedPoint(tuple(sim["lower"].center)), name="joint")
    sim.save_checkpoint(tmp_path / "a.ckpt")
    other.load_checkpoint(tmp_path / "a.ckpt")
    assert [attachment.name for attachment in other.scene.attachments] == ["joint"] and not scene.attachments
    for each in sim, other:
        each.advance(30)
    np.testing.assert_array_equal(other.positions, sim.positions)
    other.reset()
    other.save_checkpoint(tmp_path / "b.ckpt")
    sim.load_checkpoint(tmp_path / "b.ckpt")
    assert sim.attachments() == other.attachments() == sim.scene.attachments == other.scene.attachments == []


def test_opengl_steps_them_too(needs_gl):
    scenes = two_boxes(), two_boxes(attach=False)
    sims = [gelatin.Simulator(scene, backend="gl") for scene in scenes]
    sims[1].attach(*LOWER)
    for sim in sims:
        sim.advance(120)
        weight = 9.81 * sim["lower"].mass
        assert sim.attachments()[0]["force"][1] == pytest.approx(weight, rel=0.02)


def test_what_is_wrong_is_named():
    sim = simulate(two_boxes(name="glue"))
    joint = gelatin.Attachment("lower", where=gelatin.AttachedPoint((0, 1.5, 0)))
    for wrong, error, message in (
        (lambda: sim.attach("lowest", "upper"), gelatin.InvalidInput, "attachment[1].object"),
        (lambda: sim.attach("lower"), gelatin.InvalidInput, "attachment[1]"),
        (lambda: sim.attach(*LOWER, gelatin.SphereRegion((5, 0, 0), 0.1)), gelatin.InvalidInput, "attachment[1].region"),
        (lambda: sim.attach(*LOWER, compliance=-1), gelatin.InvalidInput, "attachment[1].compliance"),
        (lambda: sim.attach("lower", 3), TypeError, "attachment.to = 3"),
        (lambda: sim.attach(joint, "upper"), gelatin.InvalidInput, "object: a gelatin.Attachment says all of it"),
        (lambda: sim.detach(1), gelatin.InvalidInput, "there is no attachment 1"),
        (lambda: sim.detach(-1), gelatin.InvalidInput, "attachment = -1: must be 0 or more"),
        (lambda: sim.detach(0.5), TypeError, "attachment = 0.5: must be an integer"),
        (lambda: sim.detach("glu"), gelatin.InvalidInput, "attachment = 'glu': is not the name of an attachment; there is glue"),
        (lambda: simulate(two_boxes(attach=False)).detach("glue"), gelatin.InvalidInput, "there is none"),
    ):
        with pytest.raises(error) as caught:
            wrong()
        assert message in str(caught.value)
    assert len(sim.attachments()) == len(sim.scene.attachments) == 1


def rail(direction=(0, -1, 0), **fields):
    """A cube that falls along a rail."""
    scene = gelatin.Scene()
    scene.add_material("wood")
    scene.add_rigid("cube", gelatin.Box((0.2, 0.2, 0.2)), position=(0, 2, 0))
    scene.add("jelly", gelatin.Box((0.2, 0.2, 0.2)), position=(2, 2, 0))
    scene.add_attachment("cube", where=gelatin.AttachedRail((0, 2, 0), tuple(np.add((0, 2, 0), direction))), name="rail", **fields)
    scene.add_attachment("cube", where=gelatin.AttachedPoint((0, 2, 0)), name="point")
    scene.add_attachment("jelly", where=gelatin.AttachedLine((2, 2, 0), (2, 2, 0.1)), name="soft hinge")
    return scene


def test_joints_have_a_coordinate():
    scene = rail()
    del scene.attachments[1]
    sim = simulate(scene)
    assert sim.attachments()[0]["joint"] == {"position": pytest.approx(0, abs=1e-6), "speed": 0, "effort": 0}
    assert "joint" not in sim.attachments()[1]
    sim.advance(30)
    joint = sim.attachments()[0]["joint"]
    assert joint["position"] == pytest.approx(0.5 * 9.81 * sim.time**2, rel=0.05)
    assert joint["speed"] == pytest.approx(9.81 * sim.time, rel=0.01)
    assert sim.statistics()["attachments"] == sim.attachments()


@pytest.mark.parametrize("which", [0, "rail"])
def test_motors_are_set(which):
    sim = simulate(rail(motor=gelatin.JointMotor(speed=1.0, force=2.0)))
    sim.set_motor(which, speed=-2.0)
    sim.set_motor(which, position=2, speed=1, force=0)
    sim.set_motor(which, gelatin.JointMotor(speed=1, keyframes=[gelatin.MotorKeyframe(0.5, position=1)]))
    assert sim.scene.attachments[0].motor == gelatin.JointMotor(speed=1.0, force=2.0)  # what it does at the start


def test_motors_that_are_wrong_are_named():
    sim = simulate(rail())
    invalid = gelatin.InvalidInput
    motor = gelatin.JointMotor(1, keyframes=[gelatin.MotorKeyframe(1, speed=2), gelatin.MotorKeyframe(1, speed=3)])
    for wrong, error, message in (
        (lambda: sim.set_motor("rial", speed=1), invalid, "attachment = 'rial': is not the name of an attachment; there is rail, point, soft hinge"),
        (lambda: sim.set_motor(3, speed=1), invalid, "there is no attachment 3: there are 3, from 0"),
        (lambda: sim.set_motor(-1, speed=1), invalid, "attachment = -1: must be 0 or more"),
        (lambda: sim.set_motor(0.5, speed=1), TypeError, "attachment = 0.5: must be an integer, 0 or more"),
        (lambda: sim.set_motor("rail"), invalid, "attachment.rail.motor: needs a speed or a position"),
        (lambda: sim.set_motor("rail", speed="fast"), TypeError, "motor.speed = 'fast': must be a number"),
        (lambda: sim.set_motor("rail", 3), TypeError, "motor = 3: must be a JointMotor"),
        (lambda: sim.set_motor("rail", motor, speed=1), invalid, "motor: a gelatin.JointMotor says all of it: no other argument is allowed"),
        (lambda: sim.set_motor("rail", speed=1, force=-1), invalid, "attachment.rail.motor.force = -1: must be 0 or more"),
        (
            lambda: sim.set_motor("rail", position=1, speed=0),
            invalid,
            "attachment.rail.motor.speed = 0: must be greater than 0 where there is a position",
        ),
        (
            lambda: sim.set_motor("rail", motor),
            invalid,
            "attachment.rail.motor.keyframes[1].time = 1: must be greater than that of the keyframe before, 1",
        ),
        (lambda: sim.set_motor("point", speed=1), invalid, "attachment.point.motor: needs a line, a rail or a distance"),
        (
            lambda: sim.set_motor(2, speed=1),
            invalid,
            "attachment.soft hinge.motor: at a line both sides must be rigid, and 'jelly' is deformable",
        ),
    ):
        with pytest.raises(error) as caught:
            wrong()
        assert str(caught.value) == message


def test_bodies_and_regions():
    scene = two_boxes()
    sim = simulate(scene)
    assert "lower" in sim and sim["lower"] in sim and "roof" not in sim and sim["lower"] == sim["lower"] != sim["upper"]
    assert sim["lower"] not in simulate(scene) and len({sim["lower"], sim["lower"]}) == 1
    body = sim["lower"]
    everything = body.nodes_in(gelatin.BoxRegion((-9, -9, -9), (9, 9, 9)))
    np.testing.assert_array_equal(everything, np.arange(len(body)))
    height = float(body.center[1]) + 0.013
    below = body.nodes_in(gelatin.HalfSpaceRegion((0, 1, 0), height))
    np.testing.assert_array_equal(below, np.flatnonzero(body.positions[:, 1] <= height))
    assert 0 < len(below) < len(body)
    for region, problem in (
        (gelatin.HalfSpaceRegion((0, 0, 0), 1), "region.plane"),
        (gelatin.HalfSpaceRegion((0, 2, 0), 0.4), "region.plane.*of length 1"),
        (gelatin.SphereRegion((0, 1, 0), float("nan")), "region.radius"),
        (gelatin.SphereRegion((0, 1, 0), -1), "region.radius"),
    ):
        for use in body.nodes_in, body.pin, body.hold:
            with pytest.raises(gelatin.InvalidInput, match=problem):
                use(region)
    with pytest.raises(TypeError, match="center"):
        body.nodes_in(gelatin.SphereRegion((0, 1), 1))


def test_hands_can_become_stiffer():
    sim = simulate(two_boxes())
    hand = sim["lower"].hold([0], stiffness=100.0)
    hand.target = hand.target + (0.1, 0, 0)
    soft = hand.force[0]
    hand.stiffness = 1000.0
    assert hand.force[0] == pytest.approx(10 * soft)
    sim.advance(1)
    other = simulate(two_boxes())
    stiff = other["lower"].hold([0], stiffness=1000.0, damping_time=hand.damping_time)
    stiff.target = stiff.target + (0.1, 0, 0)
    other.advance(1)
    np.testing.assert_allclose(sim.positions, other.positions, atol=1e-6)
    with pytest.raises(gelatin.InvalidInput, match="stiffness"):
        hand.stiffness = -1.0
    assert hand.stiffness == 1000.0
