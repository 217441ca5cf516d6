"""What programs change between steps: positions, velocities, forces, pins, materials, hands."""

import numpy as np
import pytest

import gelatin
from conftest import falling_ball, same_bits, two_balls


@pytest.fixture
def floating():
    """A ball without gravity, of two in a scene, so that it does not begin with the first node."""
    scene = two_balls()
    scene.simulation.gravity = (0, 0, 0)
    scene.objects[1].position = (0, 5, 0)
    return gelatin.Simulator(scene, backend="cpu")


def test_velocity_of_the_whole_and_of_each_node(floating):
    upper = floating["upper"]
    upper.set_velocity((0, 0, 2))
    assert (upper.velocities == (0, 0, 2)).all()
    assert not floating["ball"].velocities.any()
    start = upper.center
    floating.advance(30)
    np.testing.assert_allclose(upper.center - start, (0, 0, 2 * floating.time), atol=1e-3)
    spin = np.cross((0, 1, 0), upper.positions - upper.center)
    upper.set_velocity(spin)
    np.testing.assert_allclose(upper.velocities, spin, rtol=1e-6)


def test_positions(floating):
    upper = floating["upper"]
    moved = upper.positions + np.float32((1, 2, 3))
    upper.set_positions(moved)
    assert same_bits(upper.positions, moved)
    np.testing.assert_allclose(floating["ball"].positions, floating["ball"].rest_positions, atol=1e-6)


def test_force_on_the_whole_moves_it_as_newton_says(floating):
    upper = floating["upper"]
    upper.set_force((0, 0, 30))
    floating.advance(30)
    np.testing.assert_allclose(upper.velocity, (0, 0, 30 * floating.time / upper.mass), rtol=1e-3, atol=1e-4)
    upper.set_force((0, 0, 0))
    before = upper.velocity
    floating.advance(10)
    np.testing.assert_allclose(upper.velocity, before, atol=1e-3)


def test_pins_hold_and_release(sim):
    ball = sim["ball"]
    top = ball.nodes_in(gelatin.HalfSpaceRegion((0, -1, 0), -2.3))
    assert 0 < len(top) < len(ball) and (ball.positions[top, 1] >= 2.3).all()
    before, view = ball.positions[top], sim.positions
    ball.pin(top)
    sim.advance(60)
    np.testing.assert_allclose(ball.positions[top], before, atol=1e-6)
    assert ball.center[1] > 1.5
    assert np.isfinite(view).all()  # of the solver before: its memory is not given back
    ball.unpin()
    sim.advance(60)
    assert ball.center[1] < 1.0


def test_nodes_are_given_as_regions_indices_or_masks(sim):
    ball = sim["ball"]
    for region in (
        gelatin.BoxRegion((-0.2, 1.8, -0.2), (0.2, 2.2, 0.2)),
        gelatin.SphereRegion((0, 2, 0), 0.2),
        gelatin.HalfSpaceRegion((1, 0, 0), -0.1),
    ):
        chosen = ball._indices(region)
        mask = np.zeros(len(ball), bool)
        mask[chosen] = True
        assert 0 < len(chosen) < len(ball)
        assert np.array_equal(ball._indices(mask), chosen) and np.array_equal(ball._indices(chosen.tolist()), chosen)
    inside = np.linalg.norm(ball.positions - np.float32((0, 2, 0)), axis=1) <= 0.2
    assert np.array_equal(ball._indices(gelatin.SphereRegion((0, 2, 0), 0.2)), np.flatnonzero(inside))
    for wrong in ([-1], [len(ball)], [0.5], np.zeros(3, bool), [[1]]):
        with pytest.raises(gelatin.InvalidInput, match="nodes must be"):
            ball.pin(wrong)


def test_a_material_becomes_stiffer():
    def sag(change):
        scene = falling_ball(0.6)
        scene.materials[0].damping = 0.1
        sim = gelatin.Simulator(scene, backend="cpu")
        change(sim)
        sim.advance(240)
        return np.ptp(sim["ball"].positions[:, 1])

    soft = sag(lambda sim: None)
    stiff = sag(lambda sim: sim.set_material("jelly", youngs_modulus=2e5))
    assert stiff > soft + 0.05
    sim = gelatin.Simulator(falling_ball(), backend="cpu")
    sim.set_material("jelly", youngs_modulus=1e5)
    sim.set_material("jelly", friction=0.1)
    assert (sim.scene.materials[0].youngs_modulus, sim.scene.materials[0].friction) == (1e5, 0.1)
    with pytest.raises(gelatin.InvalidInput, match="no material 'wood'"):
        sim.set_material("wood", density=1)
    with pytest.raises(gelatin.InvalidInput, match="density"):
        sim.set_material("jelly", density=-1)
    assert sim.scene.materials[0].density == 1000


def test_two_hands_carry_a_body_and_feel_its_weight():
    sim = gelatin.Simulator(falling_ball(2.0, damping=0.05), backend="cpu")
    ball = sim["ball"]
    left = ball.hold(gelatin.HalfSpaceRegion((1, 0, 0), -0.3))
    right = ball.hold(gelatin.HalfSpaceRegion((-1, 0, 0), -0.3))
    sim.advance(240)
    weight = 9.81 * ball.mass
    assert left.force[1] + right.force[1] == pytest.approx(weight, rel=0.02)
    assert left.force[1] == pytest.approx(weight / 2, rel=0.1)
    assert ball.center[1] > 1.8
    for hand in (left, right):
        hand.target = hand.target + (0, 0, 1)
    sim.advance(240)
    assert ball.center[2] == pytest.approx(1.0, abs=0.02)
    left.release()
    left.release()  # twice is as good as once
    assert not left.force.any()
    right.release()
    sim.advance(120)
    assert ball.center[1] < 1.0
    with pytest.raises(gelatin.InvalidInput, match="no node to hold"):
        ball.hold([])


def test_reset_forgets_what_programs_changed():
    changed, plain = (gelatin.Simulator(falling_ball(), backend="cpu") for _ in range(2))
    ball = changed["ball"]
    ball.pin([0, 1])
    hand = ball.hold([5, 6, 7])
    ball.set_force((0, 100, 0))
    changed.advance(5)
    changed.reset()
    assert not hand.force.any()
    changed.advance(10)
    plain.advance(10)
    assert same_bits(changed.positions, plain.positions)


def test_wrong_values_are_named(sim):
    ball = sim["ball"]
    with pytest.raises(gelatin.InvalidInput, match=r"velocity must have the shape \(3,\) or"):
        ball.set_velocity((1, 2))
    with pytest.raises(gelatin.InvalidInput, match=r"positions must have the shape"):
        ball.set_positions(np.zeros((3, 3)))
    with pytest.raises(gelatin.InvalidInput):
        ball.set_velocity((np.nan, 0, 0))
    for wrong, message in (
        (lambda: ball.set_velocity("fast"), "velocity = 'fast': must be numbers of the shape (3,) or "),
        (lambda: ball.set_force([(0, 1), (0,)]), "force = [(0, 1), (0,)]: must be numbers of the shape (3,) or "),
        (lambda: ball.pin([[1], [1, 2]]), "nodes must be a region, indices below "),
        (lambda: ball.nodes_in(3), "region = 3: must be a BoxRegion, a SphereRegion or a HalfSpaceRegion"),
        (lambda: ball.hold([1], stiffness="soft"), "stiffness = 'soft': must be a finite number above 0"),
        (lambda: ball.hold([1], stiffness=0), "stiffness = 0.0: must be a finite number above 0"),
        (lambda: ball.hold([1], damping_time=-1), "damping_time = -1.0: must be a finite number, 0 or more"),
        (lambda: setattr(hand, "target", (0, 1)), "target = (0, 1): must be three finite numbers"),
        (lambda: setattr(hand, "target", "up"), "target = 'up': must be three finite numbers"),
        (lambda: setattr(hand, "target", (0, np.nan, 0)), "target = (0, nan, 0): must be three finite numbers"),
    ):
        hand = ball.hold([0, 1])
        target = hand.target
        with pytest.raises((TypeError, gelatin.InvalidInput)) as caught:
            wrong()
        assert str(caught.value).startswith(message)
        assert (hand.target == target).all()
        hand.release()  # what was refused holds nothing
        assert not sim._hands
    assert not sim.velocities.any()


def test_meshes_in_memory():
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    triangles = [
        (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
        (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
    ]  # fmt: skip
    scene = gelatin.Scene()
    scene.add_material("jelly")
    scene.add("cube", gelatin.Mesh(corners, triangles), material="jelly", mesher=gelatin.Mesher(nodes=200))
    tets = gelatin.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], tets=[(0, 1, 2, 3)], attributes=[7])
    scene.add("tet", tets, material="jelly", position=(3, 0, 0), parts=[gelatin.Part(gelatin.TetAttribute(7), "jelly")])
    sim = gelatin.Simulator(scene, backend="cpu")
    assert sim["cube"].volume == pytest.approx(1.0, rel=1e-4)
    assert len(sim["tet"]) == 4 and sim["tet"].volume == pytest.approx(1 / 6, rel=1e-4)
    assert gelatin._gelatin.same(scene) == scene


@pytest.mark.parametrize(
    "mesh, error, message",
    [
        (gelatin.Mesh([[0, 0]], [[0, 0, 0]]), gelatin.InvalidInput, r"shape.vertices.*\(n, 3\)"),
        (gelatin.Mesh([[0, 0, 0]], [[0, 0]]), gelatin.InvalidInput, r"shape.triangles.*\(n, 3\)"),
        (gelatin.Mesh([[0, 0, 0]], [[0, 0, -1]]), gelatin.InvalidInput, "shape.triangles.*-1.*index"),
        (gelatin.Mesh([[0, 0, 0]], [[0.5, 0, 1]]), TypeError, "object.mesh.shape.triangles = .*: must be an array of integers"),
        (gelatin.Mesh([["a", "b", "c"]], [[0, 0, 0]]), TypeError, "object.mesh.shape.vertices = .*: must be an array of numbers"),
        (gelatin.Mesh([[0, 0, 0]], [[0, 1, 2]]), gelatin.InvalidInput, "."),
        (gelatin.Mesh([[0, 0, np.nan]], [[0, 0, 0]]), gelatin.InvalidInput, "."),
        (gelatin.Mesh([]), gelatin.InvalidInput, "."),
    ],
)
def test_wrong_meshes_are_named(mesh, error, message):
    scene = gelatin.Scene()
    scene.add_material("jelly")
    scene.add("mesh", mesh, material="jelly")
    with pytest.raises(error, match=message):
        gelatin.Simulator(scene, backend="cpu")
