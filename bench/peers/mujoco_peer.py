"""MuJoCo (Google DeepMind): each body a flex of tets with all degrees of freedom."""

import time

import numpy as np

TITLE, LICENCE, PACKAGES = "MuJoCo", "Apache-2.0", ("mujoco",)

VARIANTS = {
    "flex": {
        # The integrator for stiff flexes: 'position stiffness is unconditionally stable' (Computation, Numerical Integration).
        "integrator": "discrete",
        # With "Newton", MuJoCo's default, a frame of B takes about a second, and A needs tens of seconds once two balls meet.
        "solver": "CG",
        "tolerance": 1e-6,  # MuJoCo's own models of flexes: model/flex
        "radius": 0.001,  # of the surface [m]: model/flex/sphere_full.xml
        "memory": "2G",
    }
}
NOTES = (
    "`flexcomp` of dimension 3 with `dof=\"full\"`, Saint Venant-Kirchhoff tets, `integrator=\"discrete\"`, `solver=\"CG\"`, one step "
    "of 1/60 s; nodes of equal mass"
)


def numbers(values):
    return " ".join(f"{value:.9g}" for value in np.ravel(values))


def describe(scene, settings):
    """The scene in MuJoCo's format."""
    friction = f'friction="{scene.friction} 0.005 0.0001"'
    lines = [
        "<mujoco>",
        f'<option timestep="{scene.step!r}" gravity="{numbers(scene.gravity)}" integrator="{settings["integrator"]}"',
        f' solver="{settings["solver"]}" tolerance="{settings["tolerance"]}"/>',
        f'<size memory="{settings["memory"]}"/>',
        "<worldbody>",
    ]
    if scene.has_floor:
        lines.append(f'<geom type="plane" size="5 5 0.1" zaxis="0 1 0" {friction}/>')
    for k, body in enumerate(scene.bodies):
        lines += [
            f'<flexcomp name="body {k}" type="direct" dim="3" mass="{scene.mass(body):.9g}" radius="{settings["radius"]}"',
            f' point="{numbers(scene.points(body))}" element="{numbers(body.tets)}">',
            f'<elasticity young="{scene.youngs_modulus}" poisson="{scene.poisson_ratio}"/>',
            f'<contact selfcollide="none" {friction}/>',
            "</flexcomp>",
        ]
    return "\n".join([*lines, "</worldbody>", "</mujoco>"])


class Peer:
    def __init__(self, scene, settings, _job):
        import mujoco

        self.mujoco = mujoco
        self.model = mujoco.MjModel.from_xml_string(describe(scene, settings))
        self.data = mujoco.MjData(self.model)
        owners = self.model.flex_vertbodyid  # each node is a body of MuJoCo
        self.masses = self.model.body_mass[owners]
        # Each has three slide joints along the axes, whose positions begin at 0.
        self.start = scene.positions
        self.places = self.model.jnt_qposadr[self.model.body_jntadr[owners]][:, None] + np.arange(3)
        for body in scene.bodies:
            first = self.model.body_dofadr[owners[body.nodes]]
            self.data.qvel[first[:, None] + np.arange(3)] = body.velocity
        mujoco.mj_forward(self.model, self.data)

    def step(self):
        start = time.perf_counter()
        self.mujoco.mj_step(self.model, self.data)
        return time.perf_counter() - start

    def positions(self):
        return self.start + self.data.qpos[self.places]  # flexvert_xpos is that of the start of the step
