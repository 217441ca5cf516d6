"""Trains on random squeezes: predicts the force on a body from the displacements of a few of its nodes.

python random_squeezes.py [SQUEEZES]
"""

import sys

import numpy as np

import gelatin

WORLDS = 32


def scene():
    scene = gelatin.Scene()
    scene.simulation.gravity = (0, 0, 0)
    scene.add_material("jelly", youngs_modulus=2e4, damping=0.05)
    scene.add(
        "block",
        gelatin.Box((0.2, 0.2, 0.2), segments=(4, 4, 4)),
        material="jelly",
        pins=[gelatin.HalfSpaceRegion((0, 1, 0), -0.1 + 1e-6)],
    )
    return scene


def squeeze(batch, forces):
    """Lets one force [N] act on the top of each world's block, and returns all displacements, shape (worlds, nodes, 3)."""
    batch.reset()
    for world, force in zip(batch, forces):
        block = world["block"]
        top = block.rest_positions[:, 1] > 0.1 - 1e-6
        block.set_force(np.where(top[:, None], force / top.sum(), 0.0))
    batch.advance(60)
    return batch.positions - batch.rest_positions


def main(squeezes):
    random = np.random.default_rng(0)
    batch = gelatin.Batch(scene(), WORLDS)
    seen = random.choice(len(batch.masses), 20, replace=False)  # the nodes that a camera sees, say
    displacements, forces = [], []
    while len(forces) < squeezes:
        some = random.uniform(-10, 10, (WORLDS, 3))
        displacements += list(squeeze(batch, some)[:, seen].reshape(WORLDS, -1))
        forces += list(some)
    displacements, forces = np.array(displacements), np.array(forces)

    # Ridge regression. A network of your own may stand here: arrays go to torch and jax by DLPack.
    train = len(forces) * 3 // 4
    x, y = displacements[:train], forces[:train]
    weights = np.linalg.solve(x.T @ x + 1e-9 * np.eye(x.shape[1]), x.T @ y)
    error = np.abs(displacements[train:] @ weights - forces[train:]).mean()
    print(f"{len(forces)} squeezes; mean error on those not seen: {error:.3f} N of up to 10 N")
    assert error < 1.0


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
