"""Pictures and films, and OpenGL in several simulators at once."""

import gc
import subprocess
import threading
import zlib

import numpy as np
import pytest

import gelatin
from conftest import falling_ball, same_bits
from gelatin.pictures import png_bytes


def pixels_of_png(data):
    """Those of a PNG file without filters, as this package writes it."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")
    start = data.index(b"IDAT")
    length = int.from_bytes(data[start - 4 : start], "big")
    rows = np.frombuffer(zlib.decompress(data[start + 4 : start + 4 + length]), np.uint8).reshape(height, -1)
    assert not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, 3)


def test_png():
    pixels = np.random.default_rng(1).integers(0, 256, (5, 7, 3), np.uint8)
    assert np.array_equal(pixels_of_png(png_bytes(pixels)), pixels)
    assert np.array_equal(pixels_of_png(png_bytes(pixels[::-1, ::2])), pixels[::-1, ::2])


def test_a_picture_shows_the_body_where_it_is(needs_gl, sim, tmp_path):
    picture = sim.render(160, 90)
    assert picture.shape == (90, 160, 3) and picture.dtype == np.uint8
    assert np.array_equal(sim.render(160, 90), picture)
    sim.advance(30)
    later = sim.render(160, 90)
    changed = (np.abs(later.astype(int) - picture) > 40).any(axis=2)
    assert 0.005 < changed.mean() < 0.7
    # Rows are from the top: the ball, whose camera stays, falls.
    rows = lambda image: np.average(np.arange(90), weights=(np.ptp(image.astype(int), axis=2) > 60).sum(axis=1) + 1e-9)
    assert rows(later) > rows(picture) + 3
    later.save(tmp_path / "picture.png")
    assert np.array_equal(pixels_of_png((tmp_path / "picture.png").read_bytes()), later)
    with pytest.raises(gelatin.InvalidInput, match="picture.jpg: must end in .png"):
        later.save(tmp_path / "picture.jpg")
    with pytest.raises(gelatin.InvalidInput, match="film.avi: must end in .mp4"):
        gelatin.Film(tmp_path / "film.mp4", 64, 36, None).save(tmp_path / "film.avi")
    assert not (tmp_path / "picture.jpg").exists()
    film = gelatin.Film(tmp_path / "picture.png", 64, 36, None)
    for save, name in (later.save, "a.png"), (film.save, "a.mp4"):
        with pytest.raises(gelatin.SystemError, match="missing/.*: cannot be written: No such file or directory"):
            save(tmp_path / "missing" / name)
        (tmp_path / name).mkdir()
        with pytest.raises(gelatin.SystemError, match="cannot be written"):
            save(tmp_path / name)
        assert list((tmp_path / name).iterdir()) == []
    assert sorted(file.name for file in tmp_path.iterdir()) == ["a.mp4", "a.png", "picture.png"]
    assert later._repr_png_() is not None and later[0]._repr_png_() is None


def test_cameras_overlays_and_sizes(needs_gl, sim):
    usual = sim.render(120, 80)
    near = sim.render(120, 80, camera=gelatin.Camera((0, 2, 2), (0, 2, 0)))
    far = sim.render(120, 80, camera=gelatin.Camera((0, 2, 9), (0, 2, 0)))
    colored = sim.render(120, 80, overlays=["speed"])
    assert np.array_equal(sim.render(120, 80, overlays="speed"), colored)
    assert len({picture.tobytes() for picture in (usual, near, far, colored)}) == 4
    assert np.array_equal(sim.render(120, 80), usual)
    assert sim.render(60, 40, quality="high").shape == (40, 60, 3)
    with pytest.raises(gelatin.InvalidInput, match="quality"):
        sim.render(60, 40, quality="best")
    with pytest.raises(gelatin.InvalidInput, match="stres"):
        sim.render(60, 40, overlays=["stres"])
    with pytest.raises(gelatin.InvalidInput):
        sim.render(0, 40)


def test_cameras_are_checked(needs_gl, sim):
    before = sim.render(60, 40, camera=gelatin.Camera((0, 9, 0), (0, 2, 0)))  # straight down
    for camera, error, problem in (
        (gelatin.Camera((0, 2, 0), (0, 2, 0)), gelatin.InvalidInput, "camera.eye = [0, 2, 0]: must not be the target"),
        (gelatin.Camera((0, 2 + 1e-9, 0), (0, 2, 0)), gelatin.InvalidInput, "camera.eye = [0, 2.000000001, 0]: must not be the target"),
        (gelatin.Camera((0, np.nan, 0), (0, 2, 0)), gelatin.InvalidInput, "camera.eye[1] = nan: must be finite"),
        (gelatin.Camera((0, 2, 9), (0, 2, np.inf)), gelatin.InvalidInput, "camera.target[2] = inf: must be finite"),
        (gelatin.Camera((0, 2, 9), (0, 2, 0), 180), gelatin.InvalidInput, "camera.field_of_view = 180: must be greater than 0 and less than 180"),
        (gelatin.Camera((0, 2, 9), "ahead"), TypeError, "camera.target = 'ahead': must be three numbers"),
        ((0, 2, 9), TypeError, "camera = (0, 2, 9): must be a Camera"),
    ):
        for draw in sim.render, lambda **options: gelatin.film(sim, 1, width=60, height=40, camera=options["camera"]):
            with pytest.raises(error) as caught:
                draw(camera=camera)
            assert str(caught.value) == problem
    assert np.array_equal(sim.render(60, 40, camera=gelatin.Camera((0, 9, 0), (0, 2, 0))), before)


def test_pictures_change_no_bit(needs_gl):
    drawn, plain = (gelatin.Simulator(falling_ball(), backend="cpu") for _ in range(2))
    for _ in range(5):
        drawn.advance(3)
        plain.advance(3)
        drawn.render(64, 36)
    assert same_bits(drawn.positions, plain.positions)


def test_several_simulators_with_opengl(needs_gl):
    """Each in its own context, also when one of them goes."""
    sims = [gelatin.Simulator(falling_ball(1.0 + k), backend="gl") for k in range(3)]
    alone = gelatin.Simulator(falling_ball(1.0), backend="gl")
    alone.advance(20)
    picture = alone.render(64, 36)
    for _ in range(20):
        for sim in sims:
            sim.advance(1)
    assert sims[0].backend == "gl" and same_bits(sims[0].positions, alone.positions)
    pictures = [sim.render(64, 36) for sim in sims]
    assert np.array_equal(pictures[0], picture)
    later = sims[0].render(64, 36)  # for which the box of the bodies has arrived, which aims the shadows
    drawn_on_cpu = gelatin.Simulator(falling_ball(), backend="cpu")
    drawn_on_cpu.render(64, 36)
    del sim, sims[1:], alone, drawn_on_cpu
    gc.collect()
    assert np.array_equal(sims[0].render(64, 36), later)
    sims[0].advance(1)


def test_opengl_belongs_to_one_thread(needs_gl, sim):
    sim.render(64, 36)
    errors = []

    def meddle():
        sim.step()  # on the CPU: allowed
        try:
            sim.render(64, 36)
        except RuntimeError as error:
            errors.append(str(error))

    thread = threading.Thread(target=meddle)
    thread.start()
    thread.join()
    assert len(errors) == 1 and "thread" in errors[0]
    sim.render(64, 36)


def test_worlds_of_a_batch_can_be_drawn(needs_gl):
    batch = gelatin.Batch(falling_ball(), 2)
    batch[1].advance(30)
    first, second = batch[0].render(64, 36), batch[1].render(64, 36)
    assert not np.array_equal(first, second)
    sim = gelatin.Simulator(falling_ball(), backend="cpu")
    picture = sim.render(64, 36)
    assert np.array_equal(picture, first)
    del batch
    gc.collect()
    assert np.array_equal(sim.render(64, 36), picture)


def test_films(needs_gl, sim, tmp_path):
    film = gelatin.film(sim, 12, width=64, height=36, progress=True)
    assert sim.frame == 12
    assert film._repr_html_().startswith("<video") and "base64," in film._repr_html_()
    film.save(tmp_path / "film.mp4")
    probe = ["ffprobe", "-v", "error", "-count_frames", "-show_entries"]
    probe += ["stream=width,height,nb_read_frames,r_frame_rate", "-of", "csv=p=0", str(tmp_path / "film.mp4")]
    assert subprocess.run(probe, capture_output=True, text=True, check=True).stdout.strip() == "64,36,60/1,12"
    temporary = film.file
    assert temporary.exists()
    del film
    gc.collect()
    assert not temporary.exists()


def test_what_films_cannot_be(needs_gl, sim, tmp_path, monkeypatch):
    with pytest.raises(gelatin.InvalidInput, match="even"):
        gelatin.film(sim, 1, width=63, height=36)
    with pytest.raises(gelatin.SystemError, match="ffmpeg failed.*missing"):
        gelatin.film(sim, 5, tmp_path / "missing" / "film.mp4", width=64, height=36)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(gelatin.SystemError, match="not installed"):
        gelatin.film(sim, 1, width=64, height=36)
