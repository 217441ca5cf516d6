#include "support/contact_scenes.h"

#include "cpu/measure/measure.h"
#include "model/assembly/build_model.h"
#include "model/drive/handles.h"
#include "support/overlaps.h"
#include "support/test_models.h"

namespace gelatin::test {

std::vector<Block> violent_blocks(RandomMaker& random, int most_bodies) {
    std::vector<Block> blocks;
    const int bodies = random.integer(2, most_bodies);
    for (int k = 0; k < bodies; ++k) {
        Block block;
        const bool is_thin = random.integer(0, 2) == 0;
        block.size = is_thin ? glm::dvec3(0.4, 0.02, 0.4) : glm::dvec3(0.2, 0.25, 0.2);
        block.cells = is_thin ? glm::ivec3(4, 1, 4) : glm::ivec3(2, 3, 2);
        block.place = {random.uniform(-0.05, 0.05), 0.4 * k, random.uniform(-0.05, 0.05)};
        block.velocity = random.point(random.magnitude(0.1, 100.0));
        block.velocity.y -= 5.0 * k;
        block.youngs_modulus = random.magnitude(1e3, 1e9);
        blocks.push_back(block);
    }
    return blocks;
}

std::shared_ptr<const Model> make_blocks(const std::vector<Block>& blocks, const glm::dvec3& gravity,
                                         const std::vector<ColliderDescription>& colliders) {
    std::vector<Body> bodies;
    unsigned seed = 0;
    for (const Block& block : blocks) {
        Body body = make_body(make_block(block.cells, block.size, 0.15, ++seed));
        for (glm::dvec3& p : body.mesh.positions) p += block.place;
        body.velocity = block.velocity;
        body.pins = block.pins;
        body.handles = block.handles;
        body.material.youngs_modulus = block.youngs_modulus;
        body.material.poisson_ratio = block.poisson_ratio;
        body.material.model = block.model;
        body.material.friction = block.friction;
        if (block.model == MaterialModel::neo_hookean) body.material.springs.reset();
        bodies.push_back(std::move(body));
    }
    Scene scene;
    scene.collision.response = CollisionResponse::contact;
    scene.colliders = colliders;
    return std::make_shared<const Model>(
        pack_bodies(bodies, solid_colliders(scene), gravity, make_collider_surfaces(scene)));
}

ViolentScene violent_scene(unsigned seed) {
    RandomMaker random(seed);
    std::vector<Block> blocks = violent_blocks(random, 4);
    for (Block& block : blocks) {
        block.poisson_ratio = random.integer(0, 1) == 0 ? 0.25 : 0.4;
        if (random.integer(0, 2) == 0) block.model = MaterialModel::neo_hookean;
    }
    ColliderDescription ground;
    ground.shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.1};
    if (random.integer(0, 1) == 0) {
        ground.shape = BoxShape{{4.0, 0.2, 4.0}};
        ground.position = {0.0, -0.2, 0.0};
    }
    // Drawn in this order.
    return {make_blocks(blocks, {0, -9.81, 0}, {ground}), kFrame / random.integer(1, 16),
            random.integer(1, 60), random.integer(0, 1) == 0};
}

void advance(Solver& solver, const Model& model, int number, double step) {
    solver.advance({step, handle_motions(model.handles, number * step, step)});
}

template <class Real>
BodySums sum_bodies(const Model& model, const cpu::Nodes<Real>& nodes) {
    BodySums sums;
    for (const ObjectMeasure& object : cpu::measure(model, nodes)) {
        sums.kinetic += object.kinetic_energy;
        sums.potential += object.potential_energy;
        sums.elastic += object.elastic_energy;
        sums.momentum += object.momentum;
    }
    return sums;
}

template <class Real>
testing::AssertionResult stays_apart(cpu::CpuSolver<Real>& solver, const Model& model, int steps, double step,
                                     double most_energy) {
    for (int number = 0; number < steps; ++number) {
        advance(solver, model, number, step);
        const std::size_t overlaps = count_overlaps(model, solver.nodes().positions);
        if (overlaps > 0) return testing::AssertionFailure() << overlaps << " overlaps after step " << number;
        const double energy = sum_bodies(model, solver.nodes()).sum();
        if (!(energy <= most_energy))
            return testing::AssertionFailure()
                   << energy << " J after step " << number << ", at most " << most_energy;
    }
    return testing::AssertionSuccess();
}

template BodySums sum_bodies<float>(const Model&, const cpu::Nodes<float>&);
template BodySums sum_bodies<double>(const Model&, const cpu::Nodes<double>&);
template testing::AssertionResult stays_apart<float>(cpu::CpuSolver<float>&, const Model&, int, double,
                                                     double);
template testing::AssertionResult stays_apart<double>(cpu::CpuSolver<double>&, const Model&, int, double,
                                                      double);

}  // namespace gelatin::test
