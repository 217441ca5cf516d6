#include "gpu/support/implicit_scenarios.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "cpu/implicit/elastic_system.h"
#include "cpu/implicit/step_system.h"
#include "gpu/implicit/elastic_system.h"
#include "gpu/implicit/step_system.h"
#include "support/converted.h"
#include "support/elastic_cases.h"
#include "support/parity.h"

namespace gelatin::test {
namespace {

constexpr float kInverseStep = 240.0f;  // [1/s]

struct ElasticResult {
    std::vector<glm::dvec3> forces, diagonals, besides, products;
};

std::vector<glm::dvec3> xyz_of(const std::vector<glm::vec4>& values) {
    std::vector<glm::dvec3> result;
    for (const glm::vec4& value : values) result.emplace_back(value);
    return result;
}

ElasticResult elastic_on_gpu(const Model& model) {
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers at(model.positions, model.velocities);
    gpu::ElasticSystem system(model);
    system.linearise(buffers, at, kInverseStep);
    std::vector<glm::vec4> values;
    for (const cpu::Vec3<float>& d : random_field<float>(model.node_count(), 1)) values.emplace_back(d, 0.0f);
    system.displacements.upload(values);
    const gl::Buffer<glm::vec4> products(poisoned(model.node_count()));
    system.multiply(products);
    gl::barrier(gl::Barrier::buffer_update);
    ElasticResult result;
    system.forces().download(values);
    result.forces = xyz_of(values);
    products.download(values);
    result.products = xyz_of(values);
    std::vector<NodeBlock> blocks(model.node_count());
    system.blocks().download(blocks);
    for (const NodeBlock& block : blocks) {
        result.diagonals.emplace_back(block.diagonal);
        result.besides.emplace_back(block.beside);
    }
    return result;
}

ElasticResult elastic_reference(const Model& model) {
    cpu::ElasticSystem<double> system(std::make_shared<const Model>(model));
    system.linearise(converted<double>(model.positions), converted<double>(model.velocities), kInverseStep);
    const std::vector<cpu::Vec3<double>> d = random_field<double>(model.node_count(), 1);
    for (std::size_t n = 0; n < d.size(); ++n) system.displacements[n] = glm::dvec4(d[n], 0.0);
    for (const ModelObject& body : model.bodies()) system.begin_product(body);
    ElasticResult result;
    result.products.resize(d.size());
    system.multiply({0, model.node_count()}, result.products);
    result.forces = system.forces();
    for (const auto& block : system.diagonal()) {
        result.diagonals.push_back(block.diagonal);
        result.besides.push_back(block.beside);
    }
    return result;
}

// Of the distance of two fields, over a part of the norm of the second; a node that is wrong alone counts.
double error_of(std::span<const glm::dvec3> actual, std::span<const glm::dvec3> expected, double tolerance) {
    double squares = 0.0, worst = 0.0;
    for (std::size_t n = 0; n < expected.size(); ++n) {
        squares += glm::dot(expected[n], expected[n]);
        const double distance = glm::distance(actual[n], expected[n]);
        if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, distance);
    }
    return worst / (tolerance * std::sqrt(squares / static_cast<double>(expected.size())));
}

double elastic_error(const Model& model) {
    const ElasticResult actual = elastic_on_gpu(model), expected = elastic_reference(model);
    return std::max({error_of(actual.forces, expected.forces, 1e-4),
                     error_of(actual.diagonals, expected.diagonals, 1e-5),
                     error_of(actual.besides, expected.besides, 1e-5),
                     error_of(actual.products, expected.products, 1e-5)});
}

// What a system is solved for: bodies that are pushed and pulled at random.
struct SolveCase {
    Model model;
    int iterations;
    float enough;  // [J]
};

struct SolveInput {
    std::vector<glm::vec4> loads, guesses;  // w of loads: m / h^2, 0 where a node is held
};

struct SolveResult {
    std::vector<glm::dvec3> displacements;
    std::uint32_t iterations;
};

SolveInput solve_input(const Model& model) {
    const std::vector<cpu::Vec3<float>> pushes = random_field<float>(model.node_count(), 2),
                                        guesses = random_field<float>(model.node_count(), 3);
    SolveInput input;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const float w = model.positions[n].w, inertia = w > 0.0f ? kInverseStep * kInverseStep / w : 0.0f;
        // Those of a body have much in common.
        input.loads.emplace_back(0.01f * inertia * (glm::vec3(0.5f, -1.0f, 0.2f) + 0.3f * pushes[n]),
                                 inertia);
        input.guesses.emplace_back(0.003f * guesses[n], 0.0f);
    }
    return input;
}

SolveResult solve_on_gpu(const SolveCase& at) {
    const Model& model = at.model;
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    gpu::StepSystem system(model);
    const SolveInput input = solve_input(model);
    system.loads.upload(input.loads);
    system.displacements.upload(input.guesses);
    system.enough.upload(std::vector<float>(model.objects.size(), at.enough));
    system.iterations = at.iterations;
    system.elastic.linearise(buffers, nodes, kInverseStep);
    system.solve(nodes);
    SolveResult result;
    result.iterations = 0;
    for (const SolveState& state : system.states()) result.iterations += state.iterations;
    std::vector<glm::vec4> values(model.node_count());
    system.displacements.download(values);
    result.displacements = xyz_of(values);
    return result;
}

SolveResult solve_reference(const SolveCase& at) {
    const auto model = std::make_shared<const Model>(at.model);
    const SolveInput input = solve_input(*model);
    const std::vector<glm::dvec4> positions = converted<double>(model->positions);
    cpu::StepSystem<double> system(model);
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        system.inertia[n] = input.loads[n].w;
        system.loads[n] = glm::dvec3(input.loads[n]);
        system.displacements[n] = glm::dvec3(input.guesses[n]);
    }
    std::fill(system.enough.begin(), system.enough.end(), static_cast<double>(at.enough));
    system.iterations = at.iterations;
    system.elastic.linearise(positions, converted<double>(model->velocities), kInverseStep);
    system.rigid.begin(positions, system.inertia);
    std::vector<std::uint32_t> islands(model->body_count());  // a body each
    std::iota(islands.begin(), islands.end(), 0u);
    system.solve(islands);
    return {system.displacements, static_cast<std::uint32_t>(system.counts.iterations)};
}

double solve_error(const SolveCase& at) {
    const SolveResult actual = solve_on_gpu(at), expected = solve_reference(at);
    return actual.iterations == expected.iterations
               ? error_of(actual.displacements, expected.displacements, 1e-3)
               : std::numeric_limits<double>::infinity();
}

}  // namespace

Scenarios elastic_system_scenarios() {
    Scenarios scenarios;
    for (const ElasticCase& at : elastic_cases()) {
        for (const float extent : {0.003f, 0.03f}) {
            Model model = at.model;
            shake_nodes(model, extent);
            scenarios.push_back({at.name + (extent > 0.01f ? "_shaken" : ""),
                                 [model = std::move(model)] { return elastic_error(model); }});
        }
    }
    // Nearly a point.
    Model small = make_elastic_block(MaterialModel::neo_hookean, 0.3);
    for (glm::vec4& p : small.positions) p = glm::vec4(0.05f * glm::vec3(p), p.w);
    scenarios.push_back({"collapsed", [small = std::move(small)] { return elastic_error(small); }});
    return scenarios;
}

Scenarios step_system_scenarios() {
    Scenarios scenarios;
    for (const ElasticCase& at : elastic_cases()) {
        Model model = at.model;
        shake_nodes(model, 0.003f);
        scenarios.push_back({at.name, [model] { return solve_error({model, 3, 0.0f}); }});
        scenarios.push_back({at.name + "_to_the_end", [model] { return solve_error({model, 30, 1e-5f}); }});
    }
    return scenarios;
}

bool solves_repeat() {
    const SolveCase at{elastic_cases().back().model, 10, 0.0f};
    return solve_on_gpu(at).displacements == solve_on_gpu(at).displacements;
}

void run_implicit_programs() {
    solve_on_gpu({make_elastic_block(MaterialModel::mass_spring, 0.4), 2, 0.0f});
    for (const ElasticCase& at : elastic_cases()) elastic_on_gpu(at.model);
}

}  // namespace gelatin::test
