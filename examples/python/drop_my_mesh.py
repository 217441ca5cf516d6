"""Drops a mesh of your own onto a floor, and writes its surface and a picture.

python drop_my_mesh.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np

import gelatin


def ring(radius=0.5, thickness=0.2, around=32, across=16):
    """A ring about y: vertices [m], shape (n, 3), and triangles, counter-clockwise from outside, shape (m, 3)."""
    u, v = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b = 2 * np.pi * u / around, 2 * np.pi * v / across
    r = radius + thickness * np.cos(b)
    vertices = np.stack([r * np.cos(a), thickness * np.sin(b), r * np.sin(a)], axis=-1).reshape(-1, 3)
    at = lambda i, j: (i % around) * across + j % across
    p, q, s, t = at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)
    triangles = np.stack([p, t, s, p, s, q], axis=-1).reshape(-1, 3)
    return vertices, triangles


def main(folder):
    vertices, triangles = ring()
    scene = gelatin.Scene()
    scene.add_material("rubber", youngs_modulus=1e5)
    scene.add(
        "ring",
        gelatin.Mesh(vertices, triangles),
        material="rubber",
        mesher=gelatin.Mesher(nodes=1000),
        position=(0, 1, 0),
        rotation=(20, 0, 10),
    )
    scene.add_collider(gelatin.Plane())

    sim = gelatin.Simulator(scene)
    sim.run(120)
    body = sim["ring"]
    print(f"after {sim.time:.1f} s: {body}, centre at y = {body.center[1]:.3f} m")

    # The surface of its tets, as Wavefront text.
    lines = [f"v {x} {y} {z}" for x, y, z in body.positions]
    lines += [f"f {a} {b} {c}" for a, b, c in body.faces + 1]
    (folder / "ring.obj").write_text("\n".join(lines) + "\n")
    try:
        sim.render(640, 360).save(folder / "ring.png")
    except gelatin.NoOpenGl as problem:
        print(f"no picture: {problem}")
    assert 0 < body.center[1] < 0.5, "it lies on the floor"


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
