"""Makes a training set: random squeezes of one mesh, with states, contact forces and pictures.

python make_squeezes.py [SQUEEZES] [FOLDER] [MESH]

On all processors of this machine. Called again, it makes what is missing. squeezes.py loads what it has made.
"""

import sys
from pathlib import Path

import numpy as np

import gelatin
from squeezes import Squeezes

FRAMES, EVERY = 48, 8  # of a squeeze; each eighth frame is kept
PICTURE = (128, 128)  # width and height [pixels]
CAMERA = gelatin.Camera(eye=(0, 1.2, 2.4), target=(0, 0, 0))
GAP = 0.6  # between the plates and the middle at the start [m]
SETTINGS = {
    "rotation": gelatin.Between([-30, -180, -30], [30, 180, 30]),  # of the body [degrees]
    "depth": gelatin.Between(0.2, 0.35),  # how far each plate moves [m]
    "youngs_modulus": gelatin.Between(2e4, 2e5, log=True),  # [Pa]
}


def scene_of(run, mesh):
    """The body without weight between two plates, which close on it."""
    scene = gelatin.Scene()
    scene.simulation.gravity = (0, 0, 0)
    scene.camera = CAMERA
    scene.add_material("jelly", youngs_modulus=run["youngs_modulus"], damping=0.02)
    mesher = gelatin.Mesher(nodes=600)
    scene.add("body", mesh, material="jelly", mesher=mesher, rotation=run["rotation"])
    end = FRAMES / scene.simulation.frame_rate
    for side in (-1, 1):
        closing = [gelatin.Keyframe(), gelatin.Keyframe(time=end, move=(-side * run["depth"], 0, 0))]
        plate = gelatin.Box((0.1, 1.4, 1.4))
        scene.add_collider(plate, position=(side * (GAP + 0.05), 0, 0), keyframes=closing, interpolation="smooth", friction=0.5)
    return scene


def squeeze(run, mesh):
    """One squeeze: its arrays go into a file, its numbers into the table."""
    sim = gelatin.Simulator(scene_of(run, mesh), backend="cpu")
    positions, forces = [], []
    for _ in range(FRAMES // EVERY):
        sim.advance(EVERY)
        positions.append(sim.positions.copy())
        forces.append(sim.contact_forces.copy())
    try:
        picture = sim.render(*PICTURE, quality="fast")
    except gelatin.NoOpenGl:
        picture = np.zeros((*PICTURE[::-1], 3), np.uint8)
    file = run.file("npz")
    np.savez_compressed(file, positions=np.array(positions), contact_forces=np.array(forces), picture=picture)
    presses = [np.linalg.norm(force[force[:, 0] > 0].sum(axis=0)) for force in forces]  # of the left plate
    return {"data": file, "force": max(presses), "extent": np.ptp(sim.positions[:, 0])}


def main(squeezes, folder, mesh):
    mesh = Path(mesh).absolute()  # workers have other working folders

    def squeeze_mesh(run):
        return squeeze(run, mesh)

    table = gelatin.sweep(squeeze_mesh, SETTINGS, seeds=squeezes, out=folder)
    failed = table["error"].drop_null().to_pylist()
    assert not failed, failed[0]

    first = Squeezes(folder)[0]
    for name, value in first.items():
        print(f"{name}: shape {value.shape}, {value.dtype}")
    assert np.isfinite(first["contact_forces"]).all()
    force, modulus = np.array(table["force"]), np.array(table["youngs_modulus"])
    print(f"{len(force)} squeezes, with forces from {force.min():.1f} N to {force.max():.1f} N")
    if len(force) >= 20:
        stiff = modulus > np.median(modulus)
        assert force[stiff].mean() > force[~stiff].mean(), "stiffer bodies press more"


if __name__ == "__main__":
    arguments = sys.argv[1:]
    main(
        int(arguments[0]) if arguments else 1000,
        arguments[1] if len(arguments) > 1 else "squeezes",
        arguments[2] if len(arguments) > 2 else "scenes/meshes/ring.obj",
    )
