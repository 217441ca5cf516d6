"""Batches: each world has the bits of a simulator of its own."""

import gc

import numpy as np
import pytest

import gelatin
from conftest import falling_ball, same_bits, two_balls
from simulator_test import exploding_bar


def test_worlds_have_the_bits_of_simulators_of_their_own(tmp_path):
    """Also where they are in different states, so that their steps are divided differently."""
    batch = gelatin.Batch(two_balls(), 5)
    alone = [gelatin.Simulator(two_balls(), backend="cpu") for _ in range(5)]
    for world, sim in enumerate(alone):
        for _ in range(7 * world):
            sim.step()
        batch[world].step(7 * world)
    batch.advance(40)
    for sim in alone:
        sim.advance(40)
    assert batch.positions.shape == (5, len(alone[0].positions), 3)
    for world, sim in enumerate(alone):
        assert same_bits(batch.positions[world], sim.positions)
        assert same_bits(batch.velocities[world], sim.velocities)
        assert same_bits(batch.contact_forces[world], sim.contact_forces)
        assert batch.times[world] == sim.time and batch.frames[world] == sim.frame
    assert not same_bits(batch.positions[0], batch.positions[1])


def test_sixty_four_worlds_of_a_ball_that_is_thrown():
    """Of a few hundred nodes, each with a speed of its own, into the floor."""
    scene = gelatin.Scene()
    scene.add_material("jelly", youngs_modulus=2e4)
    scene.add("ball", gelatin.Sphere(radius=0.5, frequency=7), material="jelly", position=(0, 0.6, 0))
    scene.add_collider(gelatin.Plane())
    batch = gelatin.Batch(scene, 64)
    alone = [gelatin.Simulator(scene, backend="cpu") for _ in range(64)]
    assert 500 < len(alone[0].positions) < 700
    for k, (world, sim) in enumerate(zip(batch, alone)):
        for each in (world, sim):
            each["ball"].set_velocity((0.1 * k, -2.0, 0.0))
    batch.advance(10)
    for sim in alone:
        sim.advance(10)
    for k, sim in enumerate(alone):
        assert same_bits(batch.positions[k], sim.positions) and same_bits(batch.velocities[k], sim.velocities)
    assert sim["ball"].contact_force[1] > 0


@pytest.mark.parametrize("solver", ["semi_implicit_euler", "implicit"])
def test_worlds_that_begin_alike_stay_alike(solver):
    scene = falling_ball(0.7)
    scene.simulation.solver = solver
    batch = gelatin.Batch(scene, 3)
    batch.advance(30)
    sim = gelatin.Simulator(scene, backend="cpu")
    sim.advance(30)
    assert all(same_bits(world, sim.positions) for world in batch.positions)


def test_masked_reset():
    batch = gelatin.Batch(falling_ball(), 3)
    start = batch.positions[0].copy()
    batch.advance(10)
    fallen = batch.positions[0].copy()
    batch.reset(np.array([False, True, False]))
    assert batch.frames.tolist() == [10, 0, 10]
    assert same_bits(batch.positions[1], start) and same_bits(batch.positions[2], fallen)
    batch.advance(10)
    assert same_bits(batch.positions[1], fallen)
    batch.reset()
    assert batch.frames.tolist() == [0, 0, 0]
    with pytest.raises(ValueError, match=r"shape \(3,\)"):
        batch.reset([True, False])
    with pytest.raises(ValueError, match="of bool"):
        batch.reset([0, 2, 1])


def test_a_world_that_diverges_leaves_the_others_alone():
    batch = gelatin.Batch(exploding_bar(), 3)
    alone = gelatin.Simulator(exploding_bar(), backend="cpu")
    with pytest.raises(gelatin.Diverged) as caught:
        alone.step(10**6)
    step = caught.value.step
    batch[1].step(200)  # ahead of the others
    with pytest.raises(gelatin.Diverged, match=f"^world 1: .*step {step} ") as caught:
        batch.step(step - 100)
    assert caught.value.object == "bar"
    assert batch.diverged.tolist() == [False, True, False]
    assert np.rint(batch.times / batch.step_size).astype(int).tolist() == [step - 100, step, step - 100]
    batch.step(10)  # the one that diverged stands still
    assert np.rint(batch.times / batch.step_size).astype(int).tolist() == [step - 90, step, step - 90]
    batch.reset(batch.diverged)
    assert not batch.diverged.any() and batch.times[1] == 0


def test_worlds_are_simulators():
    batch = gelatin.Batch(two_balls(), 2)
    world = batch[1]
    world.advance(3)
    assert batch.frames.tolist() == [0, 3]
    assert world["upper"].positions.shape == batch.positions[1, batch.nodes("upper")].shape
    view, now = world.positions, world.positions.copy()
    assert not view.flags.owndata
    del batch, world
    gc.collect()
    assert same_bits(view, now)
    assert len(list(gelatin.Batch(falling_ball(), 4))) == 4
    with pytest.raises(IndexError):
        gelatin.Batch(falling_ball(), 2)[2]
    with pytest.raises(gelatin.InvalidInput, match="1 or more"):
        gelatin.Batch(falling_ball(), 0)


def test_messages_come_once(caplog):
    scene = exploding_bar()  # for which a warning says how stiff its springs are
    gelatin.Simulator(scene, backend="cpu")
    once = len(caplog.records)
    caplog.clear()
    gelatin.Batch(scene, 8)
    assert once > 0 and len(caplog.records) == once


def test_worlds_call_back_and_record(tmp_path):
    batch = gelatin.Batch(two_balls(), 2)
    called = []
    batch[0].on_frame(lambda world: called.append(world.frame))
    steps = []
    batch[1].on_step(lambda world: steps.append(world.time))
    with batch[0].record(tmp_path / "run.gel"):
        batch.advance(3)
    assert called == [1, 2, 3] and len(steps) == 3 * batch.substeps
    assert gelatin.play(tmp_path / "run.gel").frames == [0, 1, 2, 3]


def test_knows_of_worlds_that_diverged_by_themselves():
    batch = gelatin.Batch(exploding_bar(), 2)
    with pytest.raises(gelatin.Diverged):
        batch[1].step(10**6)
    time = batch[1].time
    assert batch.diverged.tolist() == [False, True]
    batch.step(2)
    assert batch[1].time == time and batch[0].time > 0
    batch.reset(np.array([False, True]))
    assert not batch.diverged.any()
