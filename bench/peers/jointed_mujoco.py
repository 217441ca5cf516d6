"""MuJoCo (Google DeepMind): a tree of bodies with hinges and sliders, soft bodies as flexes of tets."""

import time

import numpy as np

from jointed_scene import WORLD

TITLE, LICENCE, PACKAGES = "MuJoCo", "Apache-2.0", ("mujoco",)

OPTIONS = {
    # Its grippers of soft parts: model/flex/gripper.xml. An elliptic cone and impratio keep what is held from creeping.
    "cone": "elliptic",
    "impratio": "10",
    # 'Position stiffness is unconditionally stable' (Computation, Numerical Integration), for stiff flexes and servos.
    "integrator": "discrete",
    "solver": "CG",  # model/flex: bag.xml, basket.xml
    "tolerance": "1e-6",  # the same
}
RADIUS = 0.001  # of a flex's surface [m]: model/flex/gripper.xml
VARIANTS = {
    "1 step": {"steps": 1, "threads": 1},  # the largest: a frame; it works in both scenes
    "4 steps": {"steps": 4, "threads": 1, "runs": 1},  # the car gets about as far with two
}
NOTES = (
    "joints in generalised coordinates; `flexcomp` of dimension 3 with `elasticity`, Saint Venant-Kirchhoff tets, nodes of equal "
    'mass; `integrator="discrete"`, `solver="CG"`, `tolerance="1e-6"`, `cone="elliptic"`, `impratio="10"`; motors are `velocity` '
    "actuators with `forcerange`; the tyres' nodes at the rim are pinned to it"
)


def numbers(values):
    return " ".join(f"{value:.9g}" for value in np.ravel(values))


def quaternion(matrix):
    """Of rotations about z alone, which the scenes have."""
    half = np.arctan2(matrix[1, 0], matrix[0, 0]) / 2
    assert np.allclose(matrix[2], [0, 0, 1])
    return np.array([np.cos(half), 0, 0, np.sin(half)])


def slope_of(motor):
    """What a motor exerts for each m/s or rad/s that it lacks: all it may for a hundredth m/s or a twentieth rad/s."""
    return 1e6 if motor.get("force") is None else motor["force"] * (20 if "position" not in motor else 100)


class Writer:
    """The scene in MuJoCo's format."""

    def __init__(self, scene, steps):
        self.scene, self.steps = scene, steps

    def text(self):
        scene = self.scene
        options = " ".join(f'{key}="{value}"' for key, value in OPTIONS.items())
        meshes = [part for part in scene.parts if part.box is None]
        lines = [
            "<mujoco>",
            '<compiler angle="radian"/>',
            f'<option timestep="{scene.step / self.steps!r}" gravity="{numbers(scene.gravity)}" {options}/>',
            '<size memory="1G"/>',
            "<asset>",
            *(
                f'<mesh name="{part.name}" inertia="exact" vertex="{numbers(part.vertices)}" face="{numbers(part.triangles)}"/>'
                for part in meshes
            ),
            "</asset>",
            "<worldbody>",
            *map(self.collider, scene.colliders),
        ]
        joined = {joint.part: joint for joint in scene.joints}
        for part in scene.parts:
            if part.name not in joined or joined[part.name].to == WORLD:
                lines += self.body(part, joined.get(part.name), np.zeros(3), np.eye(3))
        lines += [line for soft in scene.softs if soft.carrier == WORLD for line in self.soft(soft, np.zeros(3))]
        lines += ["</worldbody>", "<actuator>"]
        for joint in scene.joints:
            if joint.motor:
                force = joint.motor.get("force")
                bounds = f'forcerange="{-force} {force}"' if force is not None else ""
                lines.append(f'<velocity joint="{joint.name}" kv="{slope_of(joint.motor)}" {bounds}/>')
        return "\n".join([*lines, "</actuator>", "</mujoco>"])

    def collider(self, collider):
        friction = f'friction="{self.scene.friction(collider)} 0.005 0.0001" contype="3" conaffinity="3"'
        shape, place = collider["shape"], numbers(collider.get("position", [0, 0, 0]))
        if "plane" in shape:
            return f'<geom type="plane" size="10 10 0.1" zaxis="{numbers(shape["plane"])}" {friction}/>'
        if "box" in shape:
            return f'<geom type="box" size="{numbers(np.array(shape["box"]) / 2)}" pos="{place}" {friction}/>'
        assert collider["rotation"] == [90, 0, 0]  # along z, as MuJoCo's capsules are
        return f'<geom type="capsule" size="{shape["capsule"]} {shape["length"] / 2}" pos="{place}" {friction}/>'

    def body(self, part, joint, place, turn):
        """@param place,turn of the body in which it is written"""
        scene = self.scene
        pose = f'pos="{numbers(turn.T @ (part.place - place))}" quat="{numbers(quaternion(turn.T @ part.turn))}"'
        lines = [f'<body name="{part.name}" {pose}>']
        if joint is None:
            lines.append("<freejoint/>")
        else:
            lines.append(self.joint(joint, part))
        lines += [self.inertia(part, soft) for soft in scene.softs if soft.carrier == part.name]
        shape = f'type="mesh" mesh="{part.name}"' if part.box is None else f'type="box" size="{numbers(part.box / 2)}"'
        # Parts meet soft bodies that are not theirs, and the world. Parts of one mechanism meet nothing of it in these scenes.
        bits = "10" if any(soft.carrier != WORLD for soft in scene.softs) else "33"
        meets = f'contype="{bits[0]}" conaffinity="{bits[1]}"'
        friction = f'friction="{scene.softs[0].material["friction"]} 0.005 0.0001"'
        lines.append(f'<geom {shape} mass="{part.mass:.9g}" {friction} {meets}/>')
        for child in scene.joints:
            if child.to == part.name:
                lines += self.body(scene.part(child.part), child, part.place, part.turn)
        for soft in scene.softs:
            if soft.carrier == part.name:
                lines += self.soft(soft, part.place)
        return [*lines, "</body>"]

    @staticmethod
    def inertia(part, soft):
        """Of a part of triangles with the nodes that are glued to it: MuJoCo drops the mass of pinned nodes."""
        corners = part.vertices[part.triangles]
        volumes = np.linalg.det(corners)[:, None, None]  # six times those of tets to the origin
        sums = corners.sum(axis=1)
        moment = (volumes * (corners.swapaxes(1, 2) @ corners + sums[:, :, None] * sums[:, None])).sum(axis=0) / 120
        moment *= 6 * part.mass / volumes.sum()
        masses, points = soft.masses()[soft.glued], (soft.points[soft.glued] - part.place) @ part.turn
        mass, centre = part.mass + masses.sum(), masses @ points / (part.mass + masses.sum())
        moment += (masses[:, None] * points).T @ points - mass * np.outer(centre, centre)
        inertia = np.trace(moment) * np.eye(3) - moment
        full = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        return f'<inertial pos="{numbers(centre)}" mass="{mass:.9g}" fullinertia="{numbers(full)}"/>'

    def joint(self, joint, part):
        axis = part.turn.T @ joint.axis()
        place = part.turn.T @ (joint.ends.mean(axis=0) - part.place)
        kind = "hinge" if joint.is_hinge else "slide"
        text = f'<joint name="{joint.name}" type="{kind}" axis="{numbers(axis)}" pos="{numbers(place)}"'
        if joint.limits:
            text += f' range="{numbers(joint.limits)}"'
        if joint.spring:
            spring = joint.spring
            text += f' stiffness="{spring["stiffness"]}" damping="{spring["damping"]}" springref="{spring["rest"]}"'
        return text + "/>"

    def soft(self, soft, place):
        material = soft.material
        count = len(soft.points)
        # MuJoCo gives each node the same part of it, and drops that of pinned ones.
        mass = (soft.mass() - soft.masses()[soft.glued].sum()) * count / (count - len(soft.glued))
        lines = [
            f'<flexcomp name="{soft.name}" type="direct" dim="3" mass="{mass:.9g}" radius="{RADIUS}"',
            f' point="{numbers(soft.points - place)}" element="{numbers(soft.tets)}">',
            f'<elasticity young="{material["youngs_modulus"]}" poisson="{material["poisson_ratio"]}"',
            f' damping="{material["damping"]}"/>',
            f'<contact selfcollide="none" friction="{material["friction"]} 0.005 0.0001" contype="2" conaffinity="2"/>',
        ]
        if len(soft.glued):
            lines.append(f'<pin id="{numbers(soft.glued)}"/>')
        return [*lines, "</flexcomp>"]


class Peer:
    def __init__(self, scene, settings, _job):
        import mujoco

        self.mujoco, self.scene, self.steps = mujoco, scene, settings["steps"]
        self.model = mujoco.MjModel.from_xml_string(Writer(scene, self.steps).text())
        self.data = mujoco.MjData(self.model)
        self.bodies = [self.model.body(part.name).id for part in scene.parts]
        self.motors = [joint for joint in scene.joints if joint.motor]
        self.places = [self.model.joint(joint.name).qposadr[0] for joint in self.motors]
        self.loads = [self.load_of(joint) for joint in self.motors]
        mujoco.mj_forward(self.model, self.data)
        self.start = self.data.xmat[self.bodies].reshape(-1, 3, 3).copy()

    def load_of(self, joint):
        """The mass that a slider moves, with what is held [kg]."""
        return self.model.body_subtreemass[self.model.body(joint.part).id] + sum(
            soft.mass() for soft in self.scene.softs if soft.carrier == WORLD
        )

    def speeds(self):
        """Of all motors, by the law of Gelatin's (docs/joints.md)."""
        for k, joint in enumerate(self.motors):
            speed, position, force = joint.command(self.data.time)
            if position is not None:
                way = position - self.data.qpos[self.places[k]]
                limit = np.inf if force is None else np.sqrt(force / self.loads[k] * abs(way))
                speed = np.sign(way) * min(speed, abs(way) / self.scene.step, limit)
            yield speed

    def step(self):
        wall, processor = time.perf_counter(), time.process_time()
        for _ in range(self.steps):
            self.data.ctrl[:] = list(self.speeds())
            self.mujoco.mj_step(self.model, self.data)
        return time.perf_counter() - wall, time.process_time() - processor

    def state(self):
        """@return places and rotations of the parts since the start, nodes of the soft bodies"""
        self.mujoco.mj_kinematics(self.model, self.data)
        self.mujoco.mj_comPos(self.model, self.data)
        self.mujoco.mj_flex(self.model, self.data)
        turns = self.data.xmat[self.bodies].reshape(-1, 3, 3) @ self.start.swapaxes(1, 2)
        return self.data.xpos[self.bodies].copy(), turns, self.data.flexvert_xpos.reshape(-1, 3).copy()

    def remark(self):
        count = self.data.warning[self.mujoco.mjtWarning.mjWARN_INERTIA].number
        return f"it warns {count} times that the solve of a step missed its tolerance" if count else ""
