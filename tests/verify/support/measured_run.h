#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "gelatin/simulator.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/overlaps.h"

namespace gelatin::test {

inline SimulatorOptions on_cpu() {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    return options;
}

/// A scene that runs, and what is measured of it.
class MeasuredRun {
public:
    explicit MeasuredRun(const Scene& scene, const SimulatorOptions& options = on_cpu())
        : simulator_(scene, options) {}

    void advance(double seconds) {
        const double end = simulator_.time() + seconds - 1e-6;
        while (simulator_.time() < end) simulator_.advance_frame();
    }
    Simulator& simulator() { return simulator_; }
    const Model& model() const { return model_of(simulator_); }
    double mass(std::size_t object) const { return simulator_.object(object).mass; }
    FrameStatistics statistics() {
        simulator_.begin_statistics();
        return simulator_.take_statistics();
    }
    double energy() {
        const FrameStatistics now = statistics();
        return now.kinetic_energy + now.elastic_energy + now.potential_energy;
    }
    glm::dvec3 force(std::size_t attachment) const {
        const AttachmentStatus status = simulator_.attachments()[attachment];
        return {status.force[0], status.force[1], status.force[2]};
    }
    bool is_broken(std::size_t attachment) const { return simulator_.attachments()[attachment].is_broken; }
    JointStatus joint(std::size_t attachment) const {
        return simulator_.attachments()[attachment].joint.value();
    }
    // Of mass.
    glm::dvec3 center(std::size_t object) const { return mean(object, simulator_.positions()); }
    glm::dvec3 velocity(std::size_t object) const { return mean(object, simulator_.velocities()); }
    double fastest(std::size_t object) const {
        double most = 0.0;
        for_nodes(object, [&](std::uint32_t n) {
            most = std::max(most, static_cast<double>(glm::length(glm::vec3(simulator_.velocities()[n]))));
        });
        return most;
    }
    glm::dvec3 momentum() const {
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = 0; n < model().body_node_count(); ++n) sum += momentum_of(n);
        return sum;
    }
    glm::dvec3 angular_momentum() const {  // about the origin
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = 0; n < model().body_node_count(); ++n)
            sum += glm::cross(glm::dvec3(simulator_.positions()[n]), momentum_of(n));
        return sum;
    }
    std::size_t overlaps() const {
        const auto positions = simulator_.positions();
        return count_overlaps(model(), std::vector<cpu::Vec4<float>>(positions.begin(), positions.end()),
                              Overlaps::between);
    }
    // The largest change of a distance of two of its nodes, as a part of it.
    double strain(std::size_t object) const {
        double most = 0.0;
        const std::uint32_t first = model().objects[object].nodes.first;
        for_nodes(object, [&](std::uint32_t n) {
            if (n == first) return;
            const auto apart = [&](const auto& positions) {
                return glm::distance(glm::dvec3(positions[n]), glm::dvec3(positions[first]));
            };
            most = std::max(most, std::abs(apart(simulator_.positions()) / apart(model().positions) - 1.0));
        });
        return most;
    }

private:
    template <class Visit>
    void for_nodes(std::size_t object, const Visit& visit) const {
        const Range& nodes = model().objects[object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) visit(n);
    }
    glm::dvec3 momentum_of(std::uint32_t node) const {
        return static_cast<double>(model().masses[node]) * glm::dvec3(simulator_.velocities()[node]);
    }
    glm::dvec3 mean(std::size_t object, std::span<const glm::vec4> values) const {
        glm::dvec3 sum(0.0);
        double mass = 0.0;
        for_nodes(object, [&](std::uint32_t n) {
            const auto m = static_cast<double>(model().masses[n]);
            sum += m * glm::dvec3(values[n]);
            mass += m;
        });
        return sum / mass;
    }

    Simulator simulator_;
};

}  // namespace gelatin::test
