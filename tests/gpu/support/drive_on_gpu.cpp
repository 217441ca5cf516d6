#include "gpu/support/drive_on_gpu.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "cpu/drive/apply_kinematics.h"
#include "cpu/drive/sum_loads.h"
#include "gpu/drive/apply_kinematics.h"
#include "gpu/drive/sum_loads.h"
#include "support/parity.h"

namespace gelatin::test {
namespace {

constexpr double kEps = std::numeric_limits<float>::epsilon();
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

NodeArrays apply_kinematics_on_gpu(const Model& model, std::span<const HandleMotion> motions,
                                   std::span<const NodeMotion> animated) {
    NodeArrays arrays{poisoned(model.node_count()), poisoned(model.node_count())};
    std::copy(model.positions.begin(), model.positions.end(), arrays.positions.begin());
    std::copy(model.velocities.begin(), model.velocities.end(), arrays.velocities.begin());
    const gpu::NodeBuffers nodes(arrays.positions, arrays.velocities);
    gpu::ApplyKinematics(model).run(motions, animated, nodes);
    gl::barrier(gl::Barrier::buffer_update);
    nodes.positions.download(arrays.positions);
    nodes.velocities.download(arrays.velocities);
    return arrays;
}

double worst_kinematics_error(const Model& model, std::span<const HandleMotion> motions,
                              std::span<const NodeMotion> animated, const NodeArrays& actual) {
    cpu::Nodes<double> expected{{model.positions.begin(), model.positions.end()},
                                {model.velocities.begin(), model.velocities.end()}};
    cpu::apply_kinematics<double>(model, motions, animated, expected);
    std::vector<bool> is_held(model.node_count(), false);
    double reach = 0.0, speed = 0.0;
    for (const HandleNode& held : model.handle_nodes) {
        if (motions[held.handle].center.w == 0.0f) continue;
        is_held[held.node] = true;
        reach = std::max(reach, glm::length(glm::dvec3(expected.positions[held.node])) +
                                    glm::length(glm::dvec3(held.arm)));
        speed = std::max(speed, glm::length(glm::dvec3(expected.velocities[held.node])) +
                                    glm::length(glm::dvec3(motions[held.handle].velocity)));
    }
    double worst = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const glm::vec4 &position = actual.positions[n], &velocity = actual.velocities[n];
        const glm::dvec3 p = glm::dvec3(expected.positions[n]) - glm::dvec3(position),
                         v = glm::dvec3(expected.velocities[n]) - glm::dvec3(velocity);
        if (static_cast<double>(position.w) != expected.positions[n].w ||
            velocity.w != model.velocities[n].w || !std::isfinite(glm::length(p) + glm::length(v)))
            return kNever;
        if (!is_held[n] && glm::length(p) + glm::length(v) > 0.0) return kNever;
        if (!is_held[n]) continue;
        worst =
            std::max({worst, glm::length(p) / (16.0 * kEps * reach), glm::length(v) / (16.0 * kEps * speed)});
    }
    return worst;
}

std::vector<glm::vec4> sum_loads_on_gpu(const Model& model, std::span<const float> factors) {
    gpu::SumLoads loads(model);
    loads.set_factors(factors);
    loads.run(gpu::NodeBuffers(model.positions, model.velocities));
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<glm::vec4> forces(model.positions.size());
    loads.forces().download(forces);
    return forces;
}

double worst_load_error(const Model& model, std::span<const float> factors,
                        const std::vector<glm::vec4>& actual) {
    const std::vector<glm::dvec4> positions(model.positions.begin(), model.positions.end());
    std::vector<glm::dvec4> expected(model.node_count(), glm::dvec4(0.0));
    cpu::sum_loads<double>(model.loads, factors, positions, expected);
    std::vector<double> bounds(model.node_count(), 0.0);
    for (const LoadedNode& loaded : model.loads.nodes) {
        const glm::dvec3 x(positions[loaded.node]);
        for (std::uint32_t e = loaded.first; e < loaded.end; ++e) {
            const NodeLoad& load = model.loads.entries[e];
            const double edge = std::max(glm::distance(glm::dvec3(positions[load.b]), x),
                                         glm::distance(glm::dvec3(positions[load.c]), x));
            bounds[loaded.node] +=
                16.0 * kEps *
                (glm::length(glm::dvec3(load.force)) +
                 std::abs(static_cast<double>(load.force.w)) * edge * (edge + glm::length(x)));
        }
    }
    double worst = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const double error = glm::distance(glm::dvec3(actual[n]), glm::dvec3(expected[n]));
        if (!std::isfinite(error) || (bounds[n] == 0.0 && error > 0.0)) return kNever;
        if (bounds[n] > 0.0) worst = std::max(worst, error / bounds[n]);
    }
    return worst;
}

}  // namespace gelatin::test
