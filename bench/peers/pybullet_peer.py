"""PyBullet (Erwin Coumans and others): Bullet's deformable bodies."""

import time

import numpy as np

from bodies import equal_masses

TITLE, LICENCE, PACKAGES = "PyBullet", "zlib", ("pybullet",)

# As in PyBullet's example deformable_torus.py.
BODY = {
    "useNeoHookean": 1,
    "NeoHookeanDamping": 0.01,
    "collisionMargin": 0.006,
    "useSelfCollision": 1,
    "repulsionStiffness": 800,
}
SPARSE_SDF_VOXEL_SIZE = 0.25  # the same

VARIANTS = {  # steps in a frame
    "4 steps": 4,  # of 1/240 s, PyBullet's own time step; forces are explicit, and this is too long for stiff small tets
    "16 steps": 16,  # of 1/960 s; some of its examples of deformable bodies have 1/1000 s
}
NOTES = (
    "`loadSoftBody` in the deformable world: neo-Hookean tets, 4 or 16 steps a frame, the parameters of PyBullet's example "
    "`deformable_torus.py`; nodes of equal mass"
)


def write_vtk(file, points, tets):
    with open(file, "w", encoding="ascii") as out:
        out.write("# vtk DataFile Version 2.0\nbody\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        out.write(f"POINTS {len(points)} double\n")
        np.savetxt(out, points, "%.9g")
        out.write(f"CELLS {len(tets)} {5 * len(tets)}\n")
        np.savetxt(out, np.insert(tets, 0, 4, axis=1), "%d")
        out.write(f"CELL_TYPES {len(tets)}\n" + "10\n" * len(tets))


class Peer:
    def __init__(self, scene, steps, _job):
        import pybullet

        self.bullet, self.steps = pybullet, steps
        self.masses = equal_masses(scene)
        pybullet.connect(pybullet.DIRECT)
        pybullet.resetSimulation(pybullet.RESET_USE_DEFORMABLE_WORLD)
        pybullet.setGravity(*scene.gravity)
        pybullet.setPhysicsEngineParameter(sparseSdfVoxelSize=SPARSE_SDF_VOXEL_SIZE)
        pybullet.setTimeStep(scene.step / self.steps)
        if scene.has_floor:
            # A box, as in PyBullet's plane.urdf: GEOM_PLANE holds deformable bodies from 10 cm above it on.
            floor = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[15, 5, 15])
            pybullet.createMultiBody(0, floor, basePosition=[0, -5, 0])
        mu, lame = scene.lame()
        self.bodies = []
        for k, body in enumerate(scene.bodies):
            write_vtk(f"body_{k}.vtk", scene.points(body), body.tets)
            number = pybullet.loadSoftBody(
                f"body_{k}.vtk",
                mass=scene.mass(body),
                NeoHookeanMu=mu,
                NeoHookeanLambda=lame,
                frictionCoeff=scene.friction,
                **BODY,
            )
            pybullet.resetBaseVelocity(number, body.velocity.tolist(), [0, 0, 0])
            self.bodies.append(number)

    def step(self):
        start = time.perf_counter()
        for _ in range(self.steps):
            self.bullet.stepSimulation()
        return time.perf_counter() - start

    def positions(self):
        flags = self.bullet.MESH_DATA_SIMULATION_MESH
        return np.concatenate([self.bullet.getMeshData(body, -1, flags=flags)[1] for body in self.bodies])
