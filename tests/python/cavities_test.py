"""Gas in hollows: in scenes, while they run, and in statistics."""

import numpy as np
import pytest

import gelatin


def hollow_box(size=0.4, wall=0.08):
    """A box with a hollow, as a surface of two boxes."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    outside = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    inside = [(a + 8, c + 8, b + 8) for a, b, c in outside]
    vertices = np.concatenate([0.5 * size * corners, (0.5 * size - wall) * corners])
    return gelatin.Mesh(vertices, triangles=np.array(outside + inside))


def scene_of(*cavities, count=1):
    scene = gelatin.Scene()
    scene.add_material("rubber", model="neo_hookean", youngs_modulus=1e6, damping=0.05)
    for k in range(count):
        scene.add(f"box {k + 1}", hollow_box(), mesher=gelatin.Mesher("lattice", nodes=1500), position=(k, 0, 0), cavities=list(cavities))
    scene.simulation.gravity = (0, 0, 0)
    return scene


def simulate(scene):
    return gelatin.Simulator(scene, backend="cpu")


def test_a_pressure_inflates():
    sim = simulate(scene_of(gelatin.Cavity(2e4, law="constant", name="air")))
    (start,) = sim.cavities()
    assert start["name"] == "air" and start["object"] == "box 1" and start["pressure"] == 2e4
    assert start["volume"] == pytest.approx(0.24**3, rel=0.06)  # the lattice rounds edges
    sim.advance(60)
    assert sim.cavities()[0]["volume"] > 1.05 * start["volume"]
    assert sim.statistics()["cavities"] == sim.cavities()


def test_keyframes_of_a_sealed_gas():
    keyframes = [gelatin.CavityKeyframe(0.0, amount=1.0), gelatin.CavityKeyframe(0.5, amount=1.4)]
    sim = simulate(scene_of(gelatin.Cavity(keyframes=keyframes)))
    start = sim.cavities()[0]["volume"]
    sim.advance(60)
    (now,) = sim.cavities()
    assert (now["pressure"] + 101325) * now["volume"] == pytest.approx(1.4 * 101325 * start, rel=1e-5)


def test_programs_set_it():
    sim = simulate(scene_of(gelatin.Cavity(law="constant", name="air"), count=2))
    sim.set_cavity("air", object="box 2", pressure=1e4)
    sim.set_cavity(0, pressure=2e4)
    sim.advance(10)
    assert [cavity["pressure"] for cavity in sim.cavities()] == [2e4, 1e4]
    for name, what in (("air", "is the name of 2 cavities"), ("water", "is the name of no cavity")):
        with pytest.raises(gelatin.InvalidInput, match=what):
            sim.set_cavity(name, pressure=1.0)
    with pytest.raises(gelatin.InvalidInput, match="is in 'box 1', not in 'box 2'"):
        sim.set_cavity(0, object="box 2", pressure=1.0)
    with pytest.raises(gelatin.InvalidInput, match="needs a pressure"):
        sim.set_cavity(0)
    with pytest.raises(gelatin.InvalidInput, match="only for law"):
        sim.set_cavity(0, pressure=1.0, amount=2.0)
    sim.reset()
    assert sim.cavities()[0]["pressure"] == 0.0


def test_errors():
    with pytest.raises(gelatin.InvalidInput, match="it has none"):
        scene = gelatin.Scene()
        scene.add_material("rubber")
        scene.add("ball", gelatin.Sphere(0.3), cavities=[gelatin.Cavity()])
        simulate(scene)
    with pytest.raises(gelatin.InvalidInput, match="law"):
        simulate(scene_of(gelatin.Cavity(law="open")))
