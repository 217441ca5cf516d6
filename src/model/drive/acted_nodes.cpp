#include "model/drive/acted_nodes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

namespace gelatin {

void ActedNodes::set_pulls(std::vector<Pull> pulls) {
    pulls_ = std::move(pulls);
    update();
}

void ActedNodes::move_pull(std::size_t pull, const glm::dvec3& target) {
    pulls_[pull].target = target;
    update();
}

void ActedNodes::set_forces(std::span<const glm::vec3> forces) {
    forces_.assign(forces.begin(), forces.end());
    update();
}

void ActedNodes::update() {
    for (const std::uint32_t n : nodes_) by_node_[n] = {};
    nodes_.clear();
    if (by_node_.empty() && !(pulls_.empty() && forces_.empty())) by_node_.resize(node_count_);
    for (std::uint32_t n = 0; n < forces_.size(); ++n) {
        if (forces_[n] == glm::vec3(0.0f)) continue;
        by_node_[n].force = glm::vec4(forces_[n], 0.0f);
        nodes_.push_back(n);
    }
    for (const Pull& pull : pulls_) add(pull);
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
}

// Two springs are one between their places, with the sum of their stiffnesses and of their dampings.
void ActedNodes::add(const Pull& pull) {
    const auto time = static_cast<float>(pull.damping_time);
    for (const Pull::Node& held : pull.nodes) {
        NodeActions& node = by_node_[held.node];
        const glm::vec3 place = glm::vec3(pull.target) + held.arm;
        const float before = node.spring.w, stiffness = before + held.stiffness;
        if (before == 0.0f) {
            node.spring = glm::vec4(place, stiffness);
            node.force.w = time;
        } else {
            const float part = held.stiffness / stiffness;
            node.spring = glm::vec4(glm::mix(glm::vec3(node.spring), place, part), stiffness);
            node.force.w += part * (time - node.force.w);
        }
        nodes_.push_back(held.node);
    }
}

}  // namespace gelatin
