#include "cpu/descent/joint_move.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cpu/descent/island_system.h"
#include "cpu/descent/rigid_motion.h"
#include "cpu/descent/rigid_nodes.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Longest rotation of a step.
constexpr double kMostRotation = 1.0;

template <class Real>
IslandSystem::Body make_body(std::uint32_t object, const Range& nodes, const StepObjective<Real>& objective,
                             const ColliderContacts<Real>& colliders, std::span<const Vec4<Real>> positions) {
    IslandSystem::Body body(object);
    const glm::dvec3 first(positions[nodes.first]);
    RigidSums sums = sum_rigid_nodes(
        positions.subspan(nodes.first, nodes.count),
        std::span<const Vec4<Real>>(objective.step.targets).subspan(nodes.first, nodes.count), first);
    const glm::dvec3 center = sums.arm / sums.stiffness;
    body.origin = first + center;
    body.stiffness = sums.stiffness;
    sums.square.add_outer(-sums.stiffness, center);  // round the centre of mass
    sums.moment -= glm::cross(center, sums.force);
    sums.arm = glm::dvec3(0.0);
    body.force = motion(sums.force, sums.moment);
    body.matrix = inertia_matrix(sums);
    if (colliders.objects[object] == 0) return body;
    const auto add = [&](const Motion& row, double stiffness, double force) {
        body.matrix += stiffness * row * row.transpose();
        body.force += force * row;
    };
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const ColliderContact<Real>& contact = colliders.nodes[n];
        if (contact.along == Real(0)) continue;
        const glm::dvec3 r = glm::dvec3(positions[n]) - body.origin, normal(contact.normal);
        const auto across = static_cast<double>(contact.across);
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 axis(0.0);
            axis[k] = 1.0;
            add(along(r, axis), across, static_cast<double>(contact.force[k]));
        }
        add(along(r, normal), static_cast<double>(contact.along) - across, 0.0);
    }
    return body;
}

// @param numbers of bodies within their islands; kNoNode: held
template <class Real>
IslandSystem::Touch make_touch(const ContactPair& pair, const ContactAims<Real>& aims,
                               const Press<Real>& press, const std::vector<std::uint32_t>& numbers,
                               std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                               const IslandSystem& island) {
    IslandSystem::Touch touch;
    touch.bodies = {numbers[pair.object], numbers[pair.other]};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t side = pair.side_of(k);
        const auto weight = static_cast<double>(press.weights[static_cast<int>(k)]);
        const glm::dvec3 position(positions[pair.nodes[k]]);
        touch.arms[side] += weight * position;
        if (touch.bodies[side] == kNoNode)
            touch.carried += (side == 0 ? -weight : weight) * (glm::dvec3(ends[pair.nodes[k]]) - position);
    }
    for (std::size_t side = 0; side < 2; ++side)
        if (touch.bodies[side] != kNoNode) touch.arms[side] -= island.bodies[touch.bodies[side]].origin;
    touch.normal = glm::dvec3(press.normal);
    touch.gap = static_cast<double>(aims.gap(pair, press, positions));
    touch.reach = static_cast<double>(press.reach);
    touch.stiffness = static_cast<double>(press.stiffness);
    touch.friction = static_cast<double>(press.friction);
    touch.hold = glm::dvec3(aims.hold(pair, press, positions));
    return touch;
}

}  // namespace

template <class Real>
JointMove<Real>::JointMove(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

template <class Real>
void JointMove<Real>::run(bool is_last, const Contacts<Real>& contacts, const StepObjective<Real>& objective,
                          const ColliderContacts<Real>& colliders, const PlaneLanding<Real>& landing,
                          std::span<const Vec4<Real>> positions, std::span<Vec4<Real>> ends) const {
    const ContactList<Real>& list = contacts.list();
    const std::size_t objects = model_->objects.size();
    std::vector<IslandSystem> islands(list.shifts.size());
    std::vector<std::uint32_t> numbers(objects, kNoNode);  // of bodies within their islands
    std::vector<std::uint8_t> waits(islands.size());
    for (std::uint32_t o = 0; o < objects; ++o) {
        const std::uint32_t i = list.islands[o];
        if (list.is_alone[i] != 0) waits[i] = 1;
        // The last sweep has left nodes outside colliders: bodies that touch one do not move after it.
        const bool stays = contacts.is_held(o) || (is_last && colliders.objects[o] != 0);
        islands[i].is_held |= list.is_fixed[i] != 0 || stays;
        if (stays) continue;
        numbers[o] = static_cast<std::uint32_t>(islands[i].bodies.size());
        islands[i].bodies.emplace_back(o);
    }
    const std::vector<Press<Real>>& presses = contacts.aims().presses();
    std::vector<std::vector<std::uint32_t>> own(islands.size());  // presses of each island
    for (std::uint32_t k = 0; k < presses.size(); ++k) {
        const ContactPair& pair = list.pairs[presses[k].pair];
        if (!pair.is_own() && waits[list.island_of(pair)] == 0) own[list.island_of(pair)].push_back(k);
    }
    tbb::parallel_for(std::size_t(0), islands.size(), [&](std::size_t i) {
        IslandSystem& island = islands[i];
        if (waits[i] != 0 || island.bodies.empty()) return;
        tbb::parallel_for(std::size_t(0), island.bodies.size(), [&](std::size_t k) {
            IslandSystem::Body& body = island.bodies[k];
            body = make_body<Real>(body.object, model_->objects[body.object].nodes, objective, colliders,
                                   positions);
        });
        for (const IslandSystem::Body& body : island.bodies)
            island.is_outside_touched |= colliders.objects[body.object] != 0;
        const auto bodies_of = [&](std::uint32_t press) {
            const ContactPair& pair = list.pairs[presses[press].pair];
            return std::pair(pair.object, pair.other);
        };
        std::stable_sort(own[i].begin(), own[i].end(),
                         [&](std::uint32_t a, std::uint32_t b) { return bodies_of(a) < bodies_of(b); });
        island.touches.resize(own[i].size());
        for_each_index(0, own[i].size(), 64, [&](std::size_t k) {
            const Press<Real>& press = presses[own[i][k]];
            island.touches[k] = make_touch<Real>(list.pairs[press.pair], contacts.aims(), press, numbers,
                                                 positions, ends, island);
        });
        const std::vector<Motion> motions = island.find_motions([&](std::size_t k, Motion& motion) {
            const IslandSystem::Body& body = island.bodies[k];
            return landing.land(body.object, objective, positions, body.origin, motion);
        });
        if (!std::all_of(motions.begin(), motions.end(), [](const Motion& m) { return m.allFinite(); }))
            return;
        tbb::parallel_for(std::size_t(0), motions.size(), [&](std::size_t k) {
            const Motion& m = motions[k];
            glm::dvec3 rotation(m(3), m(4), m(5));
            const double length = glm::length(rotation);
            if (length > kMostRotation) rotation *= kMostRotation / length;
            const Range& nodes = model_->objects[island.bodies[k].object].nodes;
            move_rigid_nodes({island.bodies[k].origin, {m(0), m(1), m(2)}, cayley_rotation(rotation)},
                             ends.subspan(nodes.first, nodes.count));
        });
    });
}

template class JointMove<float>;
template class JointMove<double>;

}  // namespace gelatin::cpu
