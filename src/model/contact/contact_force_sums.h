#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// Sums the forces of contacts up, by node and by pair of objects.
class ContactForceSums {
public:
    explicit ContactForceSums(const Model& model) {
        forces_.normal.assign(model.node_count(), glm::dvec3(0.0));
        forces_.friction = forces_.normal;
    }

    void add_to_node(std::uint32_t node, const glm::dvec3& normal, const glm::dvec3& friction) {
        forces_.normal[node] += normal;
        forces_.friction[node] += friction;
    }

    /// On `object`, from the other one or a plane.
    void add(std::uint32_t object, std::uint32_t other, bool is_plane, const glm::dvec3& normal,
             const glm::dvec3& friction) {
        const bool turned = !is_plane && other < object;
        const auto key = turned ? std::tuple(other, false, object) : std::tuple(object, is_plane, other);
        const double sign = turned ? -1.0 : 1.0;
        ContactForces::Between& sum = between_[key];
        sum.normal += sign * normal;
        sum.friction += sign * friction;
        ++sum.points;
    }

    ContactForces take() {
        for (auto& [key, sum] : between_) {
            std::tie(sum.object, sum.is_plane, sum.other) = key;
            forces_.between.push_back(sum);
        }
        return std::move(forces_);
    }

private:
    ContactForces forces_;
    std::map<std::tuple<std::uint32_t, bool, std::uint32_t>, ContactForces::Between> between_;
};

}  // namespace gelatin
