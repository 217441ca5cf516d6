"""Newton (the Newton developers) on Warp's CPU device, on one thread: vertex block descent for nodes and bodies."""

import math
import time

import numpy as np

from jointed_scene import WORLD

TITLE, LICENCE, PACKAGES = "Newton", "Apache-2.0", ("newton", "warp-lang")

# Steps and iterations of Newton's example vbd_gripper_soft_grid: 20 and 5. The car is thrown backwards in the first frames.
VARIANTS = {"20 steps": {"steps": 20, "iterations": 5, "threads": 1, "runs": 1, "frames": {"car": 30}}}
CONTACT_STIFFNESS = 5e4  # softbody_gift, proxy_joint_gripper
RADIUS = 0.001  # of a node [m]
CONTACT_GAP = 0.01  # vbd_gripper_soft_grid [m]
DRIVE = 5e5, 5e4  # of a motor without a greatest force [N/m, N s/m]: ten times vbd_gripper_soft_grid, for heavier parts
JOINT = 2e7, 2e6  # proxy_joint_gripper [N/m, N m/rad]
LIMIT = 5e4, 100.0  # proxy_joint_gripper
NOTES = (
    "`SolverVBD` for nodes, bodies and joints: neo-Hookean tets, 20 steps a frame with 5 iterations, contact of whole surfaces; "
    "it has no greatest force of motors, so the script computes each such motor's force before each step; the tyres' nodes are "
    "attached with infinite stiffness"
)


class Peer:
    def __init__(self, scene, settings, _job):
        import newton
        import warp

        warp.config.quiet = True
        warp.set_device("cpu")
        self.newton, self.warp, self.scene, self.settings = newton, warp, scene, settings
        self.size = scene.step / settings["steps"]
        self.make()
        self.step()  # compiles what is not compiled before a first step
        self.make()

    def pose(self, place, turn=None):
        half = 0.0 if turn is None else np.arctan2(turn[1, 0], turn[0, 0]) / 2  # the scenes rotate about z alone
        return self.warp.transform(self.warp.vec3(*place), self.warp.quat(0.0, 0.0, math.sin(half), math.cos(half)))

    def shape(self, **fields):
        return self.newton.ModelBuilder.ShapeConfig(
            ke=CONTACT_STIFFNESS, kd=0.0, mu=self.scene.softs[0].material["friction"], has_shape_collision=False, **fields
        )

    def make(self):
        newton, scene = self.newton, self.scene
        builder = newton.ModelBuilder(up_axis=newton.Axis.Y, gravity=tuple(scene.gravity))
        for collider in scene.colliders:
            self.add_collider(builder, collider)
        self.bodies = {WORLD: -1}
        for part in scene.parts:
            self.add_part(builder, part)
        moved = {joint.part for joint in scene.joints}
        free = [builder.add_joint_free(child=self.bodies[part.name]) for part in scene.parts if part.name not in moved]
        self.joints = {joint.name: self.add_joint(builder, joint) for joint in scene.joints}
        builder.add_articulation([*free, *self.joints.values()])
        for soft in scene.softs:
            self.add_soft(builder, soft)
        builder.color()
        model = builder.finalize()
        model.soft_contact_ke, model.soft_contact_kd = CONTACT_STIFFNESS, 0.0
        model.soft_contact_mu = scene.softs[0].material["friction"]
        self.solver = newton.solvers.SolverVBD(
            model,
            iterations=self.settings["iterations"],
            particle_enable_self_contact=False,
            particle_enable_tile_solve=False,  # for CUDA
            rigid_joint_linear_ke=JOINT[0],
            rigid_joint_angular_ke=JOINT[1],
            rigid_body_particle_contact_buffer_size=2048,
        )
        self.pipeline = newton.CollisionPipeline(
            model, broad_phase="nxn", soft_contact_gap=CONTACT_GAP, enable_rigid_soft_full_surface_contact=True
        )
        self.contacts = self.pipeline.contacts()
        self.states, self.control = [model.state(), model.state()], model.control()
        self.freedoms, self.targets = model.joint_qd_start.numpy(), model.joint_target_q_start.numpy()
        self.time, self.before = 0.0, {joint.name: 0.0 for joint in scene.joints}
        self.wanted, self.held = dict(self.before), dict(self.before)
        self.inertias = {joint.name: self.inertia(model, joint) for joint in scene.joints}

    def inertia(self, model, joint):
        """Of the part that the joint moves: about its line, or its mass."""
        part, body = self.scene.part(joint.part), self.bodies[joint.part]
        if not joint.is_hinge:
            return part.mass
        axis, arm = part.turn.T @ joint.axis(), np.cross(part.place - joint.ends[0], joint.axis())
        return axis @ model.body_inertia.numpy()[body] @ axis + part.mass * arm @ arm

    def add_collider(self, builder, collider):
        config = self.shape()
        config.mu = self.scene.friction(collider)
        shape, place = collider["shape"], collider.get("position", [0, 0, 0])
        if "plane" in shape:
            builder.add_ground_plane(cfg=config)
        elif "box" in shape:
            x, y, z = np.array(shape["box"]) / 2
            builder.add_shape_box(-1, xform=self.pose(place), hx=x, hy=y, hz=z, cfg=config)
        else:  # along z, as Newton's capsules are
            half = shape["length"] / 2
            builder.add_shape_capsule(-1, xform=self.pose(place), radius=shape["capsule"], half_height=half, cfg=config)

    def add_part(self, builder, part):
        self.bodies[part.name] = body = builder.add_link(xform=self.pose(part.place, part.turn), label=part.name)
        # In the car parts meet nothing; in the gripper they meet the ball.
        meets = all(soft.carrier == WORLD for soft in self.scene.softs)
        if part.box is not None:
            x, y, z = part.box / 2
            config = self.shape(density=float(part.mass / part.box.prod()), has_particle_collision=meets)
            builder.add_shape_box(body, hx=x, hy=y, hz=z, cfg=config)
            return
        a, b, c = (part.vertices[part.triangles[:, k]] for k in range(3))
        density = 6 * part.mass / np.einsum("ij,ij->", a, np.cross(b, c))
        config = self.shape(density=float(density), has_particle_collision=False)
        mesh = self.newton.Mesh(part.vertices, part.triangles.ravel())
        builder.add_shape_mesh(body, mesh=mesh, cfg=config)

    def add_joint(self, builder, joint):
        """Both frames have the scene's axes at the start."""
        middle = joint.ends.mean(axis=0)
        frames = {}
        for side, name in (("parent_xform", joint.to), ("child_xform", joint.part)):
            part = None if name == WORLD else self.scene.part(name)
            frames[side] = self.pose(middle) if part is None else self.pose(part.turn.T @ (middle - part.place), part.turn.T)
        fields = {"target_q": 0.0, "target_ke": 0.0, "target_kd": 0.0, "label": joint.name}
        if joint.limits:
            fields |= dict(zip(("limit_lower", "limit_upper"), joint.limits)) | dict(zip(("limit_ke", "limit_kd"), LIMIT))
        if joint.spring:
            fields |= {"target_q": joint.spring["rest"], "target_ke": joint.spring["stiffness"]}
            fields["target_kd"] = joint.spring["damping"]
        if joint.motor and joint.motor.get("force") is None:
            fields |= {"target_ke": DRIVE[0], "target_kd": DRIVE[1]}
        add = builder.add_joint_revolute if joint.is_hinge else builder.add_joint_prismatic
        return add(self.bodies[joint.to], self.bodies[joint.part], axis=self.warp.vec3(*joint.axis()), **frames, **fields)

    def add_soft(self, builder, soft):
        material = soft.material
        mu = material["youngs_modulus"] / (2 * (1 + material["poisson_ratio"]))
        first = builder.particle_count
        builder.add_soft_mesh(
            pos=(0, 0, 0),
            rot=self.warp.quat_identity(),
            scale=1.0,
            vel=(0, 0, 0),
            vertices=[self.warp.vec3(*point) for point in soft.points],
            indices=soft.tets.ravel().tolist(),
            density=material["density"],
            k_mu=mu,
            k_lambda=2 * mu * material["poisson_ratio"] / (1 - 2 * material["poisson_ratio"]),
            k_damp=material["damping"] * mu,
            particle_radius=RADIUS,
        )
        for node in soft.glued:
            part = self.scene.part(soft.carrier)
            point = part.turn.T @ (soft.points[node] - part.place)
            builder.add_attachment_particle_body(
                first + int(node), self.bodies[soft.carrier], body_point=self.warp.vec3(*point), stiffness=math.inf
            )

    def poses(self):
        """@return places and rotations of the parts since the start"""
        rows = self.states[0].body_q.numpy().astype(float)
        x, y, z, w = rows[:, 3:].T
        turns = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        ).transpose(2, 0, 1)
        return rows[:, :3], turns @ np.array([part.turn.T for part in self.scene.parts])

    def coordinate(self, joint, places, turns):
        names = [part.name for part in self.scene.parts]
        mine, other = names.index(joint.part), None if joint.to == WORLD else names.index(joint.to)
        base = np.eye(3) if other is None else turns[other]
        if joint.is_hinge:
            turn = base.T @ turns[mine]
            twist = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
            return math.atan2(joint.axis() @ twist, (np.trace(turn) - 1) / 2)
        middle = joint.ends[0]
        at = places[mine] + turns[mine] @ (middle - self.scene.parts[mine].place)
        rest = middle if other is None else places[other] + base @ (middle - self.scene.parts[other].place)
        return (base @ joint.axis()) @ (at - rest)

    def drive(self):
        """Targets and forces of the motors, by the law of Gelatin's (docs/joints.md)."""
        forces, targets = self.control.joint_f.numpy(), self.control.joint_target_q.numpy()
        places, turns = self.poses()
        for joint in self.scene.joints:
            if not joint.motor:
                continue
            speed, position, force = joint.command(self.time)
            if force is None:
                way = position - self.wanted[joint.name]
                self.wanted[joint.name] += np.sign(way) * min(abs(way), speed * self.size)
                targets[self.targets[self.joints[joint.name]]] = self.wanted[joint.name]
                continue
            now = self.coordinate(joint, places, turns)
            change = now - self.before[joint.name]
            rate = (change + math.pi) % (2 * math.pi) - math.pi if joint.is_hinge else change
            self.before[joint.name] = now
            if position is not None:
                load = sum(part.mass for part in self.scene.parts) + sum(soft.mass() for soft in self.scene.softs)
                way = position - now
                speed = np.sign(way) * min(speed, abs(way) / self.scene.step, math.sqrt(force / load * abs(way)))
            # Explicit, so it must not exceed what stops the part itself within two steps. The sum holds a load.
            missing = self.inertias[joint.name] / (2 * self.size) * (speed - rate / self.size)
            self.held[joint.name] = np.clip(self.held[joint.name] + missing / 10, -force, force)
            forces[self.freedoms[self.joints[joint.name]]] = np.clip(self.held[joint.name] + missing, -force, force)
        self.control.joint_f.assign(forces)
        self.control.joint_target_q.assign(targets)

    def step(self):
        wall, processor = time.perf_counter(), time.process_time()
        for _ in range(self.settings["steps"]):
            now, after = self.states
            self.drive()
            now.clear_forces()
            self.pipeline.collide(now, self.contacts)
            self.solver.step(now, after, self.control, self.contacts, self.size)
            self.states = [after, now]
            self.time += self.size
        return time.perf_counter() - wall, time.process_time() - processor

    def state(self):
        return *self.poses(), self.states[0].particle_q.numpy().astype(float)
