"""What callers give is checked: each problem is one line of this package's own, with the argument, its value and what is allowed."""

import inspect
import math

import numpy as np
import pytest

import gelatin
from conftest import falling_ball

WRONG = [None, "wrong", ["a", "b"], 3, -1, 2**70, 1.5, {"a": 1}, math.nan, b"\xff", "\udcff", "a\nb", np.zeros((2, 2)), 1j, (), [None], object()]
LARGE = {"count", "frames", "width", "height", "worlds"}
# What other arguments have.
GOOD = {
    "attachment": 0,
    "callback": print,
    "cavity": 0,
    "collider": "sea",
    "count": 1,
    "file": "a.ckpt",
    "force": (0, 0, 0),
    "frame": 0,
    "frames": 1,
    "name": "jelly",
    "nodes": [0],
    "object": "ball",
    "positions": (0, 2, 0),
    "region": gelatin.SphereRegion((0, 2, 0), 1),
    "scene": falling_ball(),
    "velocity": (0, 0, 0),
    "vertices": [(0, 0, 0)],
    "where": gelatin.AttachedPoint((0, 2, 0)),
    "world": 0,
    "worlds": 1,
}


def setters(cls):
    for name, member in inspect.getmembers(cls):
        if isinstance(member, property) and member.fset is not None:
            yield name, lambda of, value, name=name: setattr(of, name, value)


def calls(function):
    """Each argument with each wrong value."""
    parameters = inspect.signature(function).parameters.values()
    usual = {each.name: GOOD[each.name] for each in parameters if each.name in GOOD}
    for each in parameters:
        if each.kind is each.VAR_KEYWORD:
            continue
        for value in WRONG:
            if each.name not in LARGE or not isinstance(value, int) or value < 3:
                yield each.name, {**usual, each.name: value}


def problem_of(call):
    """The text of what it raises."""
    try:
        call()
    except (gelatin.Error, TypeError, ValueError, KeyError, IndexError) as error:
        return str(error)
    return ""


def test_no_message_is_of_cpp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = falling_ball()
    scene.add_attachment("ball", where=gelatin.AttachedPoint((0, 2, 0)), name="hook")
    sim = gelatin.Simulator(scene, backend="cpu")
    with sim.record("run.gel"):
        sim.advance(1)
    batch = gelatin.Batch(scene, 1)
    picture = np.zeros((4, 4, 3), np.uint8).view(gelatin.Picture)
    seen = 0
    for of in sim, sim["ball"], sim["ball"].hold([0]), batch, gelatin.play("run.gel"), picture, gelatin:
        cls = type(of)
        own = gelatin.Picture.__dict__ if cls is gelatin.Picture else dir(cls if of is not gelatin else of)
        functions = [getattr(of, name) for name in own if not name.startswith("_") and callable(getattr(of, name, None))]
        if of is gelatin:
            functions = [gelatin.load, gelatin.play, gelatin.Simulator, gelatin.Batch]
        for function in functions:
            for argument, arguments in calls(function):
                text = problem_of(lambda: function(**arguments))
                assert not any(mark in text for mark in ("incompatible function", "std::", "gelatin::", "_gelatin")), (function, argument, text)
                seen += text != ""
                sim._step_callbacks.clear()
                sim._frame_callbacks.clear()
        if of is not gelatin:
            for name, change in setters(cls):
                for value in WRONG:
                    text = problem_of(lambda: change(of, value))
                    assert "incompatible function" not in text and "std::" not in text, (name, value, text)
    assert seen > 500


def test_messages_name_the_argument(tmp_path, sim):
    scene = falling_ball()
    for call, error, message in (
        (lambda: gelatin.Simulator(None), TypeError, "scene = None: must be a Scene"),
        (lambda: gelatin.Batch(None, 1), TypeError, "scene = None: must be a Scene"),
        (lambda: gelatin.load(3), TypeError, "file = 3: must be a path"),
        (lambda: gelatin.load("a\udcff"), gelatin.InvalidInput, "file = 'a\\udcff': must be Unicode, without surrogates"),
        (lambda: gelatin.load("a.toml", ["\udcff"]), gelatin.InvalidInput, "overrides = '\\udcff': must be Unicode, without surrogates"),
        (lambda: gelatin.play(None), TypeError, "file = None: must be a path"),
        (lambda: sim.record(1.5), TypeError, "file = 1.5: must be a path"),
        (lambda: sim.save_checkpoint([]), TypeError, "file = []: must be a path"),
        (lambda: sim.load_checkpoint(None), TypeError, "file = None: must be a path"),
        (lambda: sim.set_cavity(0, pressure="high"), TypeError, "pressure = 'high': must be a number"),
        (lambda: sim.set_cavity(0, amount=[1]), TypeError, "amount = [1]: must be a number"),
        (lambda: gelatin.Simulator(scene, "a\nb"), gelatin.InvalidInput, 'backend = "a\\nb": must be "auto", "gl" or "cpu"'),
    ):
        with pytest.raises(error) as caught:
            call()
        assert str(caught.value) == message
    sim.save_checkpoint(bytes(tmp_path / "a.ckpt"))
    assert (tmp_path / "a.ckpt").exists()
