"""Simulators: the same bits as the command line, arrays and how long they live, callbacks, signals, threads."""

import gc
import logging
import os
import signal
import subprocess
import sys
import threading
import weakref

import numpy as np
import pytest

import gelatin
from conftest import falling_ball, same_bits, two_balls


def test_free_fall():
    sim = gelatin.Simulator(falling_ball(height=10.0), backend="cpu")
    sim.advance(60)
    assert sim.frame == 60 and sim.time == pytest.approx(1.0)
    ball = sim["ball"]
    # The first of two parts a step is implicit Euler's, by g h^2 / 2 too low. Each rounds coordinates of up to 10 m to float.
    n, h, rounding = 120, 1 / 120, 10 * 2.0**-24
    assert ball.velocity[1] == pytest.approx(-9.81, abs=n * rounding / h)
    assert ball.center[1] == pytest.approx(10.0 - 9.81 / 2 * (1 + h * h), abs=n * n * rounding)


def test_steps_and_frames_are_the_same(scene):
    scene.simulation.substeps = 3
    by_step, by_frame = (gelatin.Simulator(scene, backend="cpu") for _ in range(2))
    by_step.step(30)
    by_frame.advance(10)
    assert by_step.frame == by_frame.frame == 10
    assert same_bits(by_step.positions, by_frame.positions)


def test_positions_are_a_view_that_nobody_can_write(sim):
    positions = sim.positions
    assert positions.shape == (len(sim.masses), 3) and positions.dtype == np.float32
    assert not positions.flags.owndata and not positions.flags.writeable
    assert sim.positions.ctypes.data == positions.ctypes.data
    with pytest.raises(ValueError):
        positions[0] = 0


def test_a_view_keeps_the_simulator_alive_and_stays_readable(sim, tmp_path):
    before = sim.positions
    kept = before.copy()
    sim.step()
    assert same_bits(before, kept)  # the start of the step
    sim.step()
    # Never memory that is given back: the simulator has two buffers, whatever is done with it.
    buffers = {before.ctypes.data, sim.positions.ctypes.data}
    for change in (sim.step, sim.reset, sim.step, lambda: sim.save_checkpoint(tmp_path / "state"), sim.step):
        change()
        buffers.add(sim.positions.ctypes.data)
    sim.load_checkpoint(tmp_path / "state")
    buffers.add(sim.positions.ctypes.data)
    assert len(buffers) == 2
    view = sim.positions
    now = view.copy()
    del sim, before
    gc.collect()
    assert same_bits(view, now)


def test_the_memory_of_views_is_given_back():
    """A simulator goes with its last array, without a wait for the garbage collector."""
    sim = gelatin.Simulator(falling_ball(), backend="cpu")
    ball, view, gone = sim["ball"], sim["ball"].velocities, weakref.ref(sim)
    del sim
    assert gone() is not None
    del ball
    assert gone() is None
    assert np.isfinite(view).all()


def test_arrays_of_the_mesh():
    sim = gelatin.Simulator(two_balls(), backend="cpu")
    ball, upper = sim["ball"], sim["upper"]
    assert [body.name for body in sim] == ["ball", "upper"]
    assert len(ball) + len(upper) == len(sim.positions)
    assert upper.faces.max() < len(upper) and upper.tets.max() == len(upper) - 1
    assert upper.volume == pytest.approx(upper.rest_volume, rel=1e-5)
    assert upper.mass == pytest.approx(upper.masses.sum(), rel=1e-5)
    assert upper.mass == pytest.approx(1000 * upper.rest_volume, rel=1e-5)
    np.testing.assert_allclose(upper.center, (0.05, 1.7, 0), atol=1e-3)
    # Faces look outwards: by the divergence theorem they enclose the volume.
    a, b, c = upper.rest_positions[upper.faces.T].astype(float)
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(upper.rest_volume, rel=1e-4)
    with pytest.raises(KeyError, match="'ball', 'upper'"):
        sim["lower"]


def test_forces_of_contacts():
    sim = gelatin.Simulator(two_balls(), backend="cpu")
    sim.advance(240)
    forces = sim.contact_forces
    assert forces.shape == sim.positions.shape
    # At rest the floor carries both.
    weight = 9.81 * (sim["ball"].mass + sim["upper"].mass)
    assert sim["ball"].contact_force[1] + sim["upper"].contact_force[1] == pytest.approx(weight, rel=0.2)
    between = sim.statistics()["contact_forces"]
    assert {force["from"] for force in between} <= {"upper", "collider 1"}


def test_statistics_are_those_of_the_command_line(sim):
    sim.advance(5)
    statistics = sim.statistics()
    speeds = (sim.velocities.astype(float) ** 2).sum(axis=1)
    assert statistics["kinetic_energy"] == pytest.approx((0.5 * sim.masses * speeds).sum(), rel=1e-5)
    assert statistics["frame"] == 5 and set(statistics["volume_ratio"]) == {"ball"}


def test_numpy_takes_it_by_dlpack(sim):
    sim.advance(2)
    taken = np.from_dlpack(sim.positions)
    assert same_bits(taken, sim.positions)
    assert taken.ctypes.data == sim.positions.ctypes.data


def test_callbacks(sim):
    sim.scene.simulation.substeps = 2
    sim = gelatin.Simulator(sim.scene, backend="cpu")
    plain = gelatin.Simulator(sim.scene, backend="cpu")
    steps, frames = [], []

    @sim.on_step
    def note_step(s):
        steps.append(s.time)

    @sim.on_frame
    def note_frame(s):
        frames.append(s.frame)

    sim.advance(3)
    assert frames == [1, 2, 3]
    assert steps == pytest.approx([sim.step_size * (k + 1) for k in range(6)])
    sim.step()
    assert frames == [1, 2, 3] and len(steps) == 7
    sim.remove_callback(note_step)
    sim.step()
    assert frames == [1, 2, 3, 4] and len(steps) == 7
    plain.advance(4)
    assert same_bits(sim.positions, plain.positions)
    with pytest.raises(ValueError):
        sim.remove_callback(note_step)


def test_an_exception_of_a_callback_ends_the_steps(sim):
    @sim.on_frame
    def stop(s):
        if s.frame == 3:
            raise StopIteration("enough")

    with pytest.raises(StopIteration, match="enough"):
        sim.advance(100)
    assert sim.frame == 3


def test_run_goes_to_the_end_of_the_scene(scene):
    scene.simulation.frames = 12
    sim = gelatin.Simulator(scene, backend="cpu")
    sim.advance(5)
    sim.run(progress=True)
    assert sim.frame == 12
    sim.run()
    assert sim.frame == 12


def test_checkpoints_continue(sim, tmp_path):
    sim.advance(10)
    sim.save_checkpoint(tmp_path / "state")
    sim.advance(10)
    other = gelatin.Simulator(sim.scene, backend="cpu")
    other.load_checkpoint(tmp_path / "state")
    assert other.frame == 10
    other.advance(10)
    np.testing.assert_allclose(other.positions, sim.positions, atol=1e-5)
    (tmp_path / "state").write_bytes(b"nonsense")
    with pytest.raises(gelatin.InvalidInput, match="state"):
        other.load_checkpoint(tmp_path / "state")
    with pytest.raises(OSError):
        sim.save_checkpoint(tmp_path / "missing" / "state")


def test_reset(sim):
    start = sim.positions.copy()
    sim.advance(20)
    sim.reset()
    assert sim.frame == 0 and same_bits(sim.positions, start)


def exploding_bar():
    """A bar crushed to a line, with steps that are stable for its shape at rest alone."""
    scene = gelatin.Scene()
    scene.simulation.solver = "semi_implicit_euler"
    scene.simulation.gravity = (0, 0, 0)
    scene.add_material("m", youngs_modulus=1e5)
    start = gelatin.Start(scale=(1, 0, 0), scatter=0.02)
    scene.add("bar", gelatin.Box((2, 0.1, 0.1), (20, 1, 1)), material="m", start=start)
    return scene


def test_divergence_is_an_exception_with_its_place():
    sim = gelatin.Simulator(exploding_bar(), backend="cpu")
    with pytest.raises(gelatin.Diverged) as caught:
        sim.advance(10000)
    error = caught.value
    assert error.object == "bar" and 0 <= error.node < len(sim["bar"])
    assert error.step > 0 and f"step {error.step} " in str(error)
    assert error.time == pytest.approx(error.step * sim.step_size) and error.frame == sim.frame + 1
    assert isinstance(error, ArithmeticError)
    with pytest.raises(gelatin.Diverged):
        sim.step()
    sim.reset()
    sim.advance(2)
    assert sim.frame == 2


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda sim: sim.step("a"), "count = 'a': must be an integer, 0 or more"),
        (lambda sim: sim.step(-1), "count = -1: must be 0 or more"),
        (lambda sim: sim.advance(1.0), "frames = 1.0: must be an integer, 0 or more"),
        (lambda sim: sim.advance(2**62), f"frames = {2**62}: must be at most 2147483647"),
        (lambda sim: sim.run(1.5), "frames = 1.5: must be an integer, 0 or more"),
        (lambda sim: sim.run(1.5, progress=True), "frames = 1.5: must be an integer, 0 or more"),
        (lambda sim: sim.on_frame(3), "callback = 3: must be a function"),
        (lambda sim: sim.on_step(None), "callback = None: must be a function"),
        (lambda sim: sim.render("wide", 36), "width = 'wide': must be an integer, 0 or more"),
        (lambda sim: sim.render(64, 36, quality=3), "quality = 3: must be a str"),
        (lambda sim: sim.render(64, 36, overlays=3), "overlays = 3: must be a list of str"),
        (lambda sim: sim.record("run.gel", every=0), "every = 0: must be 1 or more"),
        (lambda sim: sim.load_checkpoint("run.gel", "last"), "frame = 'last': must be an integer, 0 or more"),
        (lambda sim: sim.set_material("jelly", density="a"), "material.density = 'a': must be a number"),
        (lambda sim: gelatin.Simulator(sim.scene, backend=3), "backend = 3: must be a str"),
        (lambda sim: gelatin.Simulator(sim.scene, gl_device="a"), "gl_device = 'a': must be an integer, 0 or more"),
        (lambda sim: gelatin.Simulator(3), "scene = 3: must be a Scene"),
        (lambda sim: gelatin.Batch(sim.scene, "two"), "worlds = 'two': must be an integer, 1 or more"),
        (lambda sim: gelatin.Batch(sim.scene, 1).step(0.5), "count = 0.5: must be an integer, 0 or more"),
        (lambda sim: gelatin.Batch(sim.scene, 1).run(0.5), "frames = 0.5: must be an integer, 0 or more"),
        (lambda sim: gelatin.film(sim, 1.5), "frames = 1.5: must be an integer, 0 or more"),
        (lambda sim: gelatin.film(sim, 1, "film.avi"), "file = film.avi: must end in .mp4"),
    ],
)
def test_wrong_arguments_are_one_line(sim, call, message):
    with pytest.raises((TypeError, gelatin.InvalidInput)) as caught:
        call(sim)
    assert str(caught.value) == message
    assert sim.frame == 0


def test_singular_forms():
    sim = gelatin.Simulator(falling_ball(), backend="cpu")
    assert f"{sim!r}".startswith("<gelatin.Simulator: 1 body, ")
    assert f"{gelatin.Batch(falling_ball(), 1)!r}".startswith("<gelatin.Batch: 1 world of ")
    assert "2 bodies" in f"{gelatin.Simulator(two_balls(), backend='cpu')!r}"


def test_wrong_calls(scene):
    with pytest.raises(gelatin.InvalidInput, match='"cuda".*"auto", "gl" or "cpu"'):
        gelatin.Simulator(scene, backend="cuda")
    scene.objects[0].scale = -2
    with pytest.raises(gelatin.InvalidInput, match="object.ball.scale.*greater than 0") as caught:
        gelatin.Simulator(scene)
    assert caught.value.field == "object.ball.scale"


def test_ctrl_c_ends_a_long_call():
    sim = gelatin.Simulator(falling_ball(), backend="cpu")
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        sim.step(10**9)
    step = round(sim.time / sim.step_size)
    sim.step()  # after a whole step, from which it goes on
    assert round(sim.time / sim.step_size) == step + 1


def test_other_threads_run_while_it_steps_but_not_in_it():
    sim = gelatin.Simulator(falling_ball(), backend="cpu")
    refused, counted, done = [], [0], threading.Event()

    def meddle():
        while not done.is_set():
            counted[0] += 1
            try:
                sim.step()
            except RuntimeError as error:
                refused.append(str(error))

    thread = threading.Thread(target=meddle)
    frame = sim.frame
    with pytest.raises(RuntimeError, match="in use by another thread"):
        thread.start()
        while True:
            sim.step(200)
    done.set()
    thread.join()
    assert counted[0] > 0 and sim.frame > frame


def test_messages_go_to_logging(caplog, capfd):
    with caplog.at_level(logging.WARNING, logger="gelatin"):
        gelatin.Simulator(exploding_bar(), backend="cpu")
    assert [(record.name, record.levelname) for record in caplog.records] == [("gelatin", "WARNING")]
    assert "springs give" in caplog.text and "%" not in caplog.text
    assert "springs give" not in capfd.readouterr().err


def test_importing_loads_no_opengl():
    """The CPU backend works where there is no OpenGL at all."""
    program = (
        "import gelatin; scene = gelatin.load('scenes/bounce.toml'); sim = gelatin.Simulator(scene, 'cpu'); sim.step();"
        "maps = open('/proc/self/maps').read();"
        "assert 'libGL' not in maps and 'libEGL' not in maps and 'libOpenGL' not in maps, maps"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
