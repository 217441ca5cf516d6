"""Many worlds in one process: finds the speed at which a thrown ball lands in a bin, trying many at once.

python many_worlds.py [WORLDS]
"""

import sys
import time

import numpy as np

import gelatin

DISTANCE = 2.0  # of the bin's middle [m]


def scene():
    scene = gelatin.Scene()
    scene.add_material("jelly", youngs_modulus=1e5)
    scene.add("ball", gelatin.Sphere(0.15, frequency=3), material="jelly", position=(0, 1.0, 0))
    scene.add_collider(gelatin.Plane())
    return scene


def throw(batch, speeds):
    """Throws each world's ball at its speed along x [m/s]; returns how far each has come when it lands [m]."""
    batch.reset()
    for world, speed in zip(batch, speeds):
        world["ball"].set_velocity((speed, 0, 0))
    landed = np.full(len(batch), np.nan)
    while np.isnan(landed).any():
        batch.step()
        lowest = batch.positions[:, :, 1].min(axis=1)
        middle = batch.positions[:, :, 0].mean(axis=1)
        landed = np.where(np.isnan(landed) & (lowest < 0.01), middle, landed)
    return landed


def main(worlds):
    batch = gelatin.Batch(scene(), worlds)
    low, high = 0.0, 10.0
    start = time.perf_counter()
    for attempt in range(4):
        speeds = np.linspace(low, high, worlds)
        distances = throw(batch, speeds)
        best = np.abs(distances - DISTANCE).argmin()
        print(f"{speeds[best]:.4f} m/s lands at {distances[best]:.4f} m")
        width = (high - low) / worlds
        low, high = max(0.0, speeds[best] - width), speeds[best] + width
    print(f"{4 * worlds} throws in {time.perf_counter() - start:.2f} s")
    # It falls freely from 1 m until its lower side touches the floor.
    flight = np.sqrt(2 * (1.0 - 0.15) / 9.81)
    assert abs(distances[best] - DISTANCE) < 0.02
    assert abs(speeds[best] - DISTANCE / flight) < 0.1 * DISTANCE / flight


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 64)
