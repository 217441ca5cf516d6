"""Runs are recorded and played."""

import copy
import pickle

import numpy as np
import pytest

import gelatin
from conftest import falling_ball


def test_a_recording_plays_the_run(tmp_path):
    file = tmp_path / "run.gel"
    simulator = gelatin.Simulator(falling_ball(), backend="cpu")
    simulator.advance(3)
    kept = {}
    with simulator.record(file, every=2):
        for _ in range(9):
            simulator.advance()
            kept[simulator.frame] = simulator.positions.copy()
    player = gelatin.play(file)
    assert player.frames == [3, 4, 6, 8, 10, 12]
    assert player.frame == 3
    for frame in (12, 4, 8):
        player.show(frame)
        assert player.frame == frame
        np.testing.assert_array_equal(player.positions, kept[frame])
    player.reset()
    player.advance(2)
    assert player.frame == 6
    np.testing.assert_array_equal(player["ball"].positions, kept[6])
    assert player.scene.objects[0].name == "ball"
    assert player.statistics()["kinetic_energy"] > 0
    with pytest.raises(gelatin.InvalidInput, match="is not recorded; there are 6 from 3 to 12"):
        player.show(5)
    with pytest.raises(TypeError, match="frame = 5.5: must be an integer, 0 or more"):
        player.show(5.5)
    with pytest.raises(gelatin.InvalidInput, match="plays a recording"):
        player["ball"].set_velocity((0, 1, 0))


def test_a_recording_is_of_one_run(tmp_path):
    file = tmp_path / "run.gel"
    simulator = gelatin.Simulator(falling_ball(), backend="cpu")
    with pytest.raises(gelatin.InvalidInput, match="frame = 1: must be after frame 4, which is recorded"):
        with simulator.record(file):
            simulator.advance(4)
            simulator.reset()
            simulator.advance(1)
    assert gelatin.play(file).frames == [0, 1, 2, 3, 4]
    with simulator.record(file):
        simulator.advance(2)
        simulator.reset()  # after the last frame: there is nothing to add
    assert gelatin.play(file).frames == [1, 2, 3]


def test_a_run_continues_from_a_frame(tmp_path):
    file = tmp_path / "run.gel"
    simulator = gelatin.Simulator(falling_ball(), backend="cpu")
    with simulator.record(file):
        simulator.advance(10)
    last = simulator.positions.copy()
    simulator.load_checkpoint(file, 4)
    assert simulator.frame == 4
    simulator.advance(6)
    np.testing.assert_allclose(simulator.positions, last, atol=5e-4)  # a part by implicit Euler's scheme
    simulator.load_checkpoint(file)
    assert simulator.frame == 10


def test_meshes_in_memory_are_in_the_recording(tmp_path):
    file = tmp_path / "run.gel"
    scene = falling_ball()
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1 / 3)]
    scene.objects[0].shape = gelatin.Mesh(vertices=corners, tets=[(0, 1, 2, 3)])
    simulator = gelatin.Simulator(scene, backend="cpu")
    with simulator.record(file):
        simulator.advance(6)
    player = gelatin.play(file)
    np.testing.assert_array_equal(player.scene.objects[0].shape.vertices, corners)
    player.show(6)
    np.testing.assert_array_equal(player.positions, simulator.positions)


def test_a_run_continues_without_the_files_of_its_scene(tmp_path):
    file = tmp_path / "run.gel"
    mesh = tmp_path / "wedge.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    scene = falling_ball()
    scene.objects[0].shape = gelatin.File(mesh)
    simulator = gelatin.Simulator(scene, backend="cpu")
    with simulator.record(file):
        simulator.advance(8)
    mesh.unlink()
    player = gelatin.play(file)
    player.show(8)
    np.testing.assert_array_equal(player.positions, simulator.positions)
    later = gelatin.Simulator(copy.deepcopy(player.scene), backend="cpu")
    later.load_checkpoint(file, 5)
    later.advance(3)
    np.testing.assert_allclose(later.positions, simulator.positions, atol=5e-4)
    assert pickle.loads(pickle.dumps(player.scene)).meshes is None
    with pytest.raises(TypeError, match="meshes = 3: must be of a recording's scene, or None"):
        gelatin.Simulator(gelatin.Scene(meshes=3), backend="cpu")


def test_what_is_no_recording_is_refused(tmp_path):
    file = tmp_path / "run.gel"
    file.write_text("something else")
    with pytest.raises(gelatin.InvalidInput, match="is not a recording of Gelatin"):
        gelatin.play(file)
    with pytest.raises(gelatin.SystemError, match="run.gel: cannot be written: No such file or directory"):
        gelatin.Simulator(falling_ball(), backend="cpu").record(tmp_path / "none" / "run.gel")


def test_callbacks_of_a_player_are_called_for_recorded_frames(tmp_path):
    scene = falling_ball()
    scene.simulation.substeps = 3
    simulator = gelatin.Simulator(scene, backend="cpu")
    with simulator.record(tmp_path / "run.gel"):
        simulator.advance(4)
    player = gelatin.play(tmp_path / "run.gel")
    frames, steps = [], []
    player.on_frame(lambda sim: frames.append(sim.frame))
    player.on_step(lambda sim: steps.append(sim.frame))
    player.advance(1)
    assert player.frame == 1
    player.step(2)
    assert player.frame == 3
    player.run()
    assert frames == steps == [1, 2, 3, 4]
