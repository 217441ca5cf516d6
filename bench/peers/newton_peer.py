"""Newton (the Newton developers) on Warp's CPU device, which runs kernels on one thread."""

import time

from bodies import lumped_masses

TITLE, LICENCE, PACKAGES = "Newton", "Apache-2.0", ("newton", "warp-lang")

VARIANTS = {
    "VBD": {
        "iterations": 10,  # as Gelatin's sweeps; Newton's example softbody_gift has 15 in each of ten substeps
        "margin": 0.01,  # where surfaces begin to press [m]: a fifth of an edge
        # Documented as half to one margin. It is two here: nodes go 5 cm a step, and with one margin B loses momentum faster.
        "gap": 0.02,
        "contact_stiffness": 5e4,  # softbody_gift
        "contact_damping": 0.0,  # as everything else here
    }
}
NOTES = (
    "`SolverVBD` with `add_soft_mesh`: neo-Hookean tets without damping, one step of 1/60 s with 10 iterations, "
    "contact of particles from 1 cm on, found from 3 cm on"
)


class Peer:
    def __init__(self, scene, settings, _job):
        import newton
        import warp

        warp.config.quiet = True
        warp.set_device("cpu")
        self.newton, self.warp, self.scene, self.settings = newton, warp, scene, settings
        self.masses = lumped_masses(scene)
        self.make()
        self.step()  # compiles what is not compiled before a first step
        self.make()

    def make(self):
        newton, scene, settings = self.newton, self.scene, self.settings
        mu, lame = scene.lame()
        builder = newton.ModelBuilder(up_axis=newton.Axis.Y, gravity=tuple(scene.gravity))
        if scene.has_floor:
            builder.add_ground_plane()
        for body in scene.bodies:
            builder.add_soft_mesh(
                pos=(0, 0, 0),
                rot=self.warp.quat_identity(),
                scale=1.0,
                vel=tuple(body.velocity),
                vertices=[self.warp.vec3(*point) for point in scene.points(body)],
                indices=body.tets.ravel().tolist(),
                density=scene.density,
                k_mu=mu,
                k_lambda=lame,
                k_damp=0.0,
                particle_radius=settings["margin"],
            )
        builder.color()
        model = builder.finalize()
        model.soft_contact_ke = settings["contact_stiffness"]
        model.soft_contact_kd = settings["contact_damping"]
        model.soft_contact_mu = scene.friction
        self.solver = newton.solvers.SolverVBD(
            model,
            iterations=settings["iterations"],
            particle_enable_self_contact=True,  # also that of one body with another
            particle_self_contact_margin=settings["margin"],
            particle_self_contact_gap=settings["gap"],
            particle_enable_tile_solve=False,  # for CUDA
        )
        self.states = [model.state(), model.state()]
        self.control = model.control()
        self.pipeline = newton.CollisionPipeline(model)
        self.contacts = self.pipeline.contacts()

    def step(self):
        start = time.perf_counter()
        now, after = self.states
        now.clear_forces()
        self.pipeline.collide(now, self.contacts)
        self.solver.step(now, after, self.control, self.contacts, self.scene.step)
        self.states = [after, now]
        return time.perf_counter() - start

    def positions(self):
        return self.states[0].particle_q.numpy().astype(float)
