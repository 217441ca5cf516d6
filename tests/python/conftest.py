"""What the tests of the Python module share. They run in the repository's root, with the CPU backend where nothing is said."""

import os

import numpy as np
import pytest

import gelatin


def falling_ball(height=2.0, **material):
    """A ball of a few hundred nodes above a floor."""
    scene = gelatin.Scene()
    scene.add_material("jelly", **{"youngs_modulus": 2e4, **material})
    scene.add("ball", gelatin.Sphere(radius=0.5, frequency=4), material="jelly", position=(0, height, 0))
    scene.add_collider(gelatin.Plane())
    return scene


def two_balls():
    """One falls onto the other."""
    scene = falling_ball(0.6)
    scene.add("upper", gelatin.Sphere(radius=0.4, frequency=4), material="jelly", position=(0.05, 1.7, 0))
    return scene


@pytest.fixture
def scene():
    return falling_ball()


@pytest.fixture
def sim(scene):
    return gelatin.Simulator(scene, backend="cpu")


@pytest.fixture
def needs_gl():
    """Skips where there is no OpenGL, but not where there has to be."""
    try:
        gelatin.Simulator(falling_ball(), backend="gl")
    except gelatin.NoOpenGl:
        if os.environ.get("GELATIN_REQUIRE_GL") == "1":
            raise
        pytest.skip("there is no OpenGL")


def same_bits(a, b):
    return np.array_equal(np.ascontiguousarray(a).view(np.uint32), np.ascontiguousarray(b).view(np.uint32))
