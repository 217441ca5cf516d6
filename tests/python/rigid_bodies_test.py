"""Rigid bodies: what is read of them, and what programs change."""

import numpy as np
import pytest

import gelatin
from conftest import falling_ball


@pytest.fixture
def scene():
    """A rigid crate that spins about y, and a ball, without gravity."""
    scene = falling_ball()
    scene.simulation.solver = "implicit"
    scene.simulation.gravity = (0, 0, 0)
    scene.add_material("wood", density=600)
    scene.add_rigid("crate", gelatin.Box((0.4, 0.3, 0.2)), material="wood", position=(3, 2, 0), spin=(0, 90, 0))
    return scene


@pytest.fixture
def sim(scene):
    return gelatin.Simulator(scene, backend="cpu")


def test_what_is_read(sim):
    crate, ball = sim["crate"], sim["ball"]
    assert crate.is_rigid and not ball.is_rigid
    assert len(crate.tets) == 0 and len(crate.faces) == 12
    assert crate.mass == pytest.approx(600 * 0.4 * 0.3 * 0.2)
    assert crate.volume == pytest.approx(crate.rest_volume, rel=1e-6)
    assert ball.volume == pytest.approx(ball.rest_volume, rel=1e-5)
    np.testing.assert_allclose(crate.rotation, np.eye(3), atol=1e-6)
    np.testing.assert_allclose(crate.spin, (0, 90, 0), atol=1e-3)
    sim.advance(60)
    np.testing.assert_allclose(crate.rotation, [[0, 0, 1], [0, 1, 0], [-1, 0, 0]], atol=2e-2)
    np.testing.assert_allclose(crate.spin, (0, 90, 0), atol=0.1)
    placed = (crate.rest_positions - (3, 2, 0)) @ crate.rotation.T + crate.center
    np.testing.assert_allclose(crate.positions, placed, atol=1e-5)


def test_a_deformable_body_has_a_rotation(scene):
    scene.objects[0].spin = (0, 0, 45)
    sim = gelatin.Simulator(scene, backend="cpu")
    np.testing.assert_allclose(sim["ball"].spin, (0, 0, 45), atol=1e-2)
    sim.advance(60)
    np.testing.assert_allclose(sim["ball"].rotation[0], (np.sqrt(0.5), -np.sqrt(0.5), 0), atol=2e-2)


def test_positions_become_the_nearest_pose(sim):
    crate = sim["crate"]
    turned = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    arms = crate.positions - crate.center
    crate.set_positions((1.2 * arms) @ turned.T + (0, 5, 0))
    np.testing.assert_allclose(crate.rotation, turned, atol=1e-5)
    np.testing.assert_allclose(crate.positions, arms @ turned.T + (0, 5, 0), atol=1e-5)
    np.testing.assert_allclose(crate.spin, (0, 90, 0), atol=1e-2)


def test_velocity_hold_and_force(sim):
    crate = sim["crate"]
    crate.set_velocity((0, 1, 0))
    np.testing.assert_allclose(crate.spin, 0, atol=1e-3)
    crate.set_force((crate.mass, 0, 0))
    sim.advance(60)
    np.testing.assert_allclose(crate.velocity, (1, 1, 0), atol=1e-3)
    crate.set_force((0, 0, 0))
    hand = crate.hold(np.arange(len(crate)))
    target = crate.center + (0, 0.5, 0)
    hand.target = hand.target + (0, 0.5, 0)
    sim.advance(120)
    assert np.linalg.norm(crate.velocity) < 0.05 and np.linalg.norm(crate.center - target) < 0.05
    hand.release()


def test_pins_are_refused(sim):
    with pytest.raises(gelatin.InvalidInput, match="is rigid"):
        sim["crate"].pin([0])


def test_materials_change(sim):
    crate = sim["crate"]
    mass = crate.mass
    sim.set_material("wood", density=1200)
    assert crate.mass == pytest.approx(2 * mass) and sim["crate"].mass == pytest.approx(2 * mass)
    np.testing.assert_allclose(crate.spin, (0, 90, 0), atol=1e-2)


def test_scenes_of_rigid_bodies_alone(scene):
    del scene.objects[0]
    sim = gelatin.Simulator(scene, backend="cpu")
    assert sim.tets.shape == (0, 4)
    sim.advance(3)
    assert sim.statistics()["volume_ratio"]["crate"] == pytest.approx(1, rel=1e-5)
