#include "sim/body_pose.h"

#include <vector>

#include "cpu/implicit/rigid_part.h"
#include "model/nearest_rotation.h"

namespace gelatin {
namespace {

template <class Weight>
BodyPose weighted_pose(const Model& model, const ModelObject& body, std::span<const glm::vec4> positions,
                       const Weight& weight) {
    BodyPose pose;
    double sum = 0.0;
    for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); ++n) {
        pose.pivot += weight(n) * glm::dvec3(model.positions[n]);
        pose.center += weight(n) * glm::dvec3(positions[n]);
        sum += weight(n);
    }
    pose.pivot /= sum;
    pose.center /= sum;
    glm::dmat3 moment(0.0);
    for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); ++n)
        moment += glm::outerProduct(weight(n) * (glm::dvec3(positions[n]) - pose.center),
                                    glm::dvec3(model.positions[n]) - pose.pivot);
    pose.rotation = smallest_nearest_rotation(moment);
    return pose;
}

cpu::RigidPart<float> motion_of(const Range& nodes, const std::vector<glm::vec4>& positions,
                                const std::vector<glm::vec4>& velocities) {
    const auto part = [&](const std::vector<glm::vec4>& all) {
        const auto own = std::span(all).subspan(nodes.first, nodes.count);
        return std::vector<glm::vec4>(own.begin(), own.end());
    };
    return {Range{0, nodes.count}, cpu::Nodes<float>{part(positions), part(velocities)}};
}

// As `before` has it, with what moves displaced.
void set_motions(const ModelObject& body, const State& before, const glm::dvec3& displacement, State& state) {
    const auto set = [&](const std::vector<glm::vec4>& known, std::vector<glm::vec4>& velocities) {
        if (known.empty()) return;
        cpu::RigidPart<float> motion = motion_of(body.nodes, before.positions, known);
        motion.center += displacement;
        for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); ++n)
            velocities[n] = glm::vec4(glm::vec3(motion.at(state.positions[n])), velocities[n].w);
    };
    set(before.velocities, state.velocities);
    set(before.earlier_velocities, state.earlier_velocities);
}

}  // namespace

BodyPose nearest_pose(const Model& model, const ModelObject& body, std::span<const glm::vec4> positions) {
    return weighted_pose(model, body, positions,
                         [&](std::uint32_t n) { return static_cast<double>(model.masses[n]); });
}

BodyPose nearest_pose_of_surface(const Model& model, const ModelObject& body,
                                 std::span<const glm::vec4> positions) {
    const std::vector<std::uint32_t>& starts = model.node_faces.starts;
    return weighted_pose(model, body, positions,
                         [&](std::uint32_t n) { return starts[n] < starts[n + 1] ? 1.0 : 0.0; });
}

void put_rigid(const Model& model, const ModelObject& body, const BodyPose& pose,
               const glm::dvec3& displacement, State& state) {
    const State before = state;
    for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); ++n)
        state.positions[n] =
            glm::vec4(glm::vec3(pose.place(glm::dvec3(model.positions[n]))), state.positions[n].w);
    set_motions(body, before, displacement, state);
}

void move_rigidly(const ModelObject& body, State& state) {
    set_motions(body, State(state), glm::dvec3(0.0), state);
}

}  // namespace gelatin
