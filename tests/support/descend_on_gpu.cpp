#include "support/descend_on_gpu.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <random>

#include "cpu/descent/block_descent.h"
#include "cpu/drive/sum_loads.h"
#include "gpu/descent/block_descent.h"
#include "gpu/drive/sum_loads.h"
#include "support/crowd.h"
#include "support/parity.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

const std::vector<glm::vec4>& start_of(const Model& model, const Descent& descent) {
    return descent.positions.empty() ? model.positions : descent.positions;
}

}  // namespace

// By 120 degrees about the diagonal the axes change places.
std::vector<glm::vec4> rotated_start(const Model& model) {
    std::vector<glm::vec4> positions = model.positions;
    for (const ModelObject& object : model.objects) {
        glm::vec3 middle(0.0f);
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
            middle += glm::vec3(positions[n]) / static_cast<float>(object.nodes.count);
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
            const glm::vec3 r = glm::vec3(positions[n]) - middle;
            positions[n] = glm::vec4(middle + glm::vec3(r.z, r.x, r.y), positions[n].w);
        }
    }
    return positions;
}

NodeArrays descend_on_gpu(const Model& model, const Descent& descent) {
    NodeArrays arrays{poisoned(model.node_count()), poisoned(model.node_count())};
    const bool has_earlier = !descent.earlier_velocities.empty();
    std::copy(descent.earlier_velocities.begin(), descent.earlier_velocities.end(),
              arrays.velocities.begin());
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers previous(start_of(model, descent), model.velocities),
        current(arrays.positions, arrays.velocities);
    gpu::BlockDescent program(model, descent.settings);
    std::optional<gpu::SumLoads> loads;
    if (!model.loads.empty()) loads.emplace(model).run(previous);
    program.run(buffers, loads ? &*loads : nullptr, previous, current, descent.step, has_earlier);
    gl::barrier(gl::Barrier::buffer_update);
    current.positions.download(arrays.positions);
    current.velocities.download(arrays.velocities);
    return arrays;
}

double worst_descent_error(const Model& model, const Descent& descent, const NodeArrays& actual) {
    const std::vector<glm::vec4>& positions = start_of(model, descent);
    const cpu::Nodes<double> start{{positions.begin(), positions.end()},
                                   {model.velocities.begin(), model.velocities.end()}};
    cpu::Nodes<double> expected = start;
    std::vector<glm::dvec4> loads(model.loads.empty() ? 0 : model.node_count(), glm::dvec4(0.0));
    if (!loads.empty()) {
        const std::vector<float> factors(model.loads.spans.size(), 1.0f);
        cpu::sum_loads<double>(model.loads, factors, start.positions, loads);
    }
    const bool has_earlier = !descent.earlier_velocities.empty();
    if (has_earlier)
        expected.velocities = {descent.earlier_velocities.begin(), descent.earlier_velocities.end()};
    cpu::BlockDescent<double>(std::make_shared<const Model>(model), descent.settings)
        .run(descent.step, has_earlier, start, expected, loads);
    StepBounds bounds = rounding_bounds(model, SolverKind::semi_implicit_euler, descent.step);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        bounds.position[n] *= descent.settings.iterations;
        bounds.velocity[n] += bounds.position[n] / descent.step;
    }
    return worst_error(model, bounds, expected, actual.positions, actual.velocities);
}

double degenerate_descent_error(int iterations) {
    constexpr double kStep = 0.01;
    Net net;
    net.positions = {{0, 1, 0}, {0, 1, 0}, {1, 1, 0}, {5, 5, 5}};
    net.velocities = {{1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    net.masses = {1.0, 2.0, 3.0, 4.0};
    net.springs = {{0, 1, 0.5f, 100.0f}, {1, 2, 0.5f, 100.0f}};
    net.gravity = {0.0, -9.81, 0.0};
    const Model model = make_model(net);
    const cpu::Nodes<double> start{{model.positions.begin(), model.positions.end()},
                                   {model.velocities.begin(), model.velocities.end()}};
    cpu::Nodes<double> expected = start;
    cpu::BlockDescent<double>(std::make_shared<const Model>(model), {iterations})
        .run(kStep, false, start, expected);
    const NodeArrays actual = descend_on_gpu(model, {kStep, {iterations}});
    // Positions are up to 5 m, and springs move nodes by some centimetres.
    constexpr double kLargest = 1e-6;
    double error = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const glm::dvec3 off(glm::dvec3(actual.positions[n]) - glm::dvec3(expected.positions[n]));
        const glm::dvec3 faster(glm::dvec3(actual.velocities[n]) - glm::dvec3(expected.velocities[n]));
        error =
            std::max({error, glm::length(off) / kLargest, kStep * glm::length(faster) / (2.0 * kLargest)});
        if (!(glm::length(off) < 1.0)) return std::numeric_limits<double>::infinity();
    }
    return error;
}

double sliding_descent_error() {
    Body body = make_body(make_block({5, 4, 5}, {0.3, 0.24, 0.3}, 0.2));
    body.material.youngs_modulus = 1e5;
    ColliderDescription floor;
    floor.shape = PlaneCollider{{0.0, 1.0, 0.0}, 0.0};
    floor.friction = 0.1;
    const Model model = pack_bodies({body}, {floor}, {3.0, -9.0, 1.0});
    Descent descent{1.0 / 60.0, {4}, {}, model.positions};
    for (glm::vec4& p : descent.positions) p.y *= 0.98f;
    // Bounds of many digits more than the little that a block slides in a step; parity has 3e-5 of them.
    constexpr double kOfBounds = 1e-3;
    return worst_descent_error(model, descent, descend_on_gpu(model, descent)) / kOfBounds;
}

Model make_bodies_to_descend(double damping_time, double poisson_ratio, MaterialModel model_of_most,
                             bool driven) {
    constexpr unsigned kSeed = 1;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    Material jelly;
    jelly.youngs_modulus = 2e4;
    jelly.damping = damping_time;
    jelly.model = model_of_most;
    jelly.poisson_ratio = poisson_ratio;
    std::vector<Body> bodies;
    const auto add = [&](glm::ivec3 cells, glm::dvec3 place) -> Body& {
        Body body = make_body(make_block(cells, 0.1 * glm::dvec3(cells), 0.2, kSeed), jelly);
        for (glm::dvec3& p : body.mesh.positions) p += place;
        body.velocity = {unit(random), unit(random), unit(random)};
        return bodies.emplace_back(std::move(body));
    };
    Body& large = add({5, 6, 7}, {0.0, 1.0, 0.0});
    if (driven) {
        large.loads = {{HalfSpaceRegion{{0.0, 1.0, 0.0}, 1.2}, ForceLoad{{500.0, 2000.0, 0.0}}},
                       {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01}, PressureLoad{2e3}}};
    }
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 1.05};
    Body& small = add({3, 2, 2}, {1.0, 1.0, 0.0});
    small.material.model = MaterialModel::mass_spring;
    if (driven) small.handles = {handle};
    add({4, 2, 2}, {0.0, 1.0, 1.0}).pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.05}};
    Body& landing = add({3, 3, 3}, {-1.0, -0.01, 0.0});
    landing.velocity = {2.0, -1.0, 0.5};
    landing.spin = {5.0, -20.0, 8.0};
    ColliderDescription floor, ball;
    floor.shape = PlaneCollider{};
    floor.friction = 0.2;
    floor.restitution = 0.9;
    ball.shape = SphereShape{0.3};
    ball.position = {-0.85, 0.4, 0.0};
    Model model = pack_bodies(bodies, {floor, ball}, {0.0, -9.81, 0.0});
    for (const std::size_t shaken : {0, 1}) {
        const Range& nodes = model.objects[shaken].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const float x = unit(random), y = unit(random), z = unit(random);
            model.positions[n] += 0.06f * glm::vec4(x, y, z, 0.0f);
        }
    }
    for (const HandleNode& held : model.handle_nodes) {
        if (!model.handles[held.handle].is_pin)
            model.velocities[held.node] += glm::vec4(0.5f, -1.0f, 0.7f, 0.0f);
    }
    return model;
}

}  // namespace gelatin::test
