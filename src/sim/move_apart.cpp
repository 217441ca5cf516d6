#include "sim/move_apart.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "cpu/collision/collision.h"
#include "model/corners.h"

namespace gelatin {
namespace {

// A round moves bodies by this part of the smaller one's size; it doubles every so many rounds.
constexpr double kStep = 0.01;
// Of the areas on both sides: less than this of their sum says nothing.
constexpr double kLeastArea = 0.05;
constexpr int kRoundsADoubling = 20, kMostRounds = 140;
// Of a rigid body's size: contact pushes it out of a plane that it is less deep in.
constexpr double kLeastDepth = 1e-3;

struct ObjectBox {
    glm::dvec3 min{1e300}, max{-1e300};
    glm::dvec3 center() const { return 0.5 * (min + max); }
    double size() const { return glm::length(max - min); }
};

class Mover {
public:
    Mover(std::shared_ptr<const Model> model, std::span<const glm::vec4> positions,
          const JoinedBodies& joined)
        : model_(std::move(model)),
          joined_(joined),
          collision_(model_),
          positions_(positions.begin(), positions.end()),
          moved_(model_->objects.size(), glm::dvec3(0.0)) {}

    // Moves rigid bodies out of planes: pushed out within a step they would fly away. @return whether there
    // are any
    bool leave_planes() {
        bool any = false;
        for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
            if (!model_->objects[o].is_rigid) continue;
            glm::dvec3 displacement(0.0);
            for (const Collider& collider : model_->colliders) {
                if (collider.kind != 0) continue;
                const glm::dvec3 normal(collider.center);
                const double depth = -height_over(collider, o) - glm::dot(normal, displacement);
                if (depth > kLeastDepth * box_of(o).size()) displacement += depth * normal;
            }
            if (displacement == glm::dvec3(0.0)) continue;
            left_planes_.emplace_back(o, displacement);
            move(o, displacement);
            any = true;
        }
        return any;
    }

    // Moves what overlaps a little, if it can be moved. @return false if nothing overlaps
    bool make_round(double step) {
        const std::vector<glm::dvec4> exact(positions_.begin(), positions_.end());
        collision_.update_boxes(exact);
        collision_.find_object_pairs();
        collision_.find_face_collisions(exact);
        std::vector<glm::dvec3> displacements(model_->objects.size(), glm::dvec3(0.0));
        bool any = false;
        for (const cpu::ObjectPair& pair : collision_.pairs()) {
            // Each pair is there twice, once for the faces of either object.
            const bool is_of_colliders = !model_->is_body(pair.object) && !model_->is_body(pair.other);
            if (pair.object > pair.other || is_of_colliders || are_joined(joined_, pair.object, pair.other) ||
                !collision_.collide(pair))
                continue;
            any = true;
            const double first = softness(pair.object), second = softness(pair.other);
            if (first + second == 0.0) continue;
            overlapping_.insert({pair.object, pair.other});
            const double size = std::min(box_of(pair.object).size(), box_of(pair.other).size());
            const glm::dvec3 displacement = step * size / (first + second) * direction(pair);
            displacements[pair.object] += first * displacement;
            displacements[pair.other] -= second * displacement;
        }
        for (std::size_t o = 0; o < displacements.size(); ++o) {
            if (displacements[o] == glm::dvec3(0.0)) continue;
            stop_at_planes(static_cast<std::uint32_t>(o), displacements[o]);
            moved_[o] += displacements[o];
            move(o, displacements[o]);
        }
        return any;
    }

    MovedApart take(std::string_view when) {
        MovedApart result{std::move(positions_), {}};
        for (const auto& [object, by] : left_planes_)
            result.lines.push_back(
                fmt::format("object '{}' is inside a plane {}; it was moved by [{:.3g}, {:.3g}, {:.3g}] m",
                            name(object), when, by.x, by.y, by.z));
        for (const auto& [first, second] : overlapping_) {
            std::string line =
                fmt::format("objects '{}' and '{}' overlap {};", name(first), name(second), when);
            for (const std::uint32_t o : {first, second}) {
                if (moved_[o] == glm::dvec3(0.0)) continue;
                line += fmt::format(" '{}' was moved by [{:.3g}, {:.3g}, {:.3g}] m", name(o), moved_[o].x,
                                    moved_[o].y, moved_[o].z);
            }
            result.lines.push_back(std::move(line));
        }
        return result;
    }

private:
    const std::string& name(std::uint32_t object) const { return model_->objects[object].name; }

    // 0 for what stays.
    double softness(std::uint32_t object) const {
        if (!model_->is_body(object)) return 0.0;
        const Range& nodes = model_->objects[object].nodes;
        const auto own = std::span(model_->positions).subspan(nodes.first, nodes.count);
        if (std::any_of(own.begin(), own.end(), [](const glm::vec4& p) { return p.w == 0.0f; })) return 0.0;
        return 1.0 / model_->objects[object].mass;
    }

    void move(std::size_t object, const glm::dvec3& displacement) {
        const Range& nodes = model_->objects[object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            positions_[n] += glm::vec4(glm::vec3(displacement), 0.0f);
    }

    double height_over(const Collider& plane, std::uint32_t object) const {
        const Range nodes = model_->objects[object].shape_nodes();
        float least = std::numeric_limits<float>::infinity();
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            least = std::min(least, glm::dot(glm::vec3(plane.center), glm::vec3(positions_[n])));
        return static_cast<double>(least - plane.center.w);
    }

    // It goes no deeper into a plane than it is.
    void stop_at_planes(std::uint32_t object, glm::dvec3& displacement) const {
        for (const Collider& collider : model_->colliders) {
            if (collider.kind != 0) continue;
            const glm::dvec3 normal(collider.center);
            const double height = height_over(collider, object);
            const double approach = -glm::dot(normal, displacement);
            displacement += std::max(0.0, approach - std::max(0.0, height)) * normal;
        }
    }

    ObjectBox box_of(std::uint32_t object) const {
        ObjectBox box;
        const Range nodes = model_->objects[object].shape_nodes();
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            box.min = glm::min(box.min, glm::dvec3(positions_[n]));
            box.max = glm::max(box.max, glm::dvec3(positions_[n]));
        }
        return box;
    }

    // Twice the sum of the area vectors of an object's faces that overlap the other, and their mean place.
    struct Patch {
        glm::dvec3 area{0.0}, place{0.0};
    };
    Patch patch_of(const cpu::ObjectPair& pair) const {
        Patch patch;
        double total = 0.0;
        const Range& faces = model_->objects[pair.object].faces;
        for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
            if (!collision_.collides(pair, f)) continue;
            const auto corners = corners_of(model_->faces[f]);
            const glm::dvec3 a(positions_[corners[0]]), b(positions_[corners[1]]), c(positions_[corners[2]]);
            const glm::dvec3 area = glm::cross(b - a, c - a);
            patch.area += area;
            patch.place += glm::length(area) * (a + b + c) / 3.0;
            total += glm::length(area);
        }
        if (total > 0.0) patch.place /= total;
        return patch;
    }

    // In which the first object leaves the second: against its own faces, along the other's, of which those
    // of a sheet may point to either side.
    glm::dvec3 direction(const cpu::ObjectPair& pair) const {
        const Patch own = patch_of(pair), others = patch_of(collision_.pairs()[pair.mirror]);
        const glm::dvec3 apart = box_of(pair.object).center() - others.place;
        glm::dvec3 along = others.area;
        if (!model_->is_body(pair.other) && glm::dot(along, apart) < 0.0) along = -along;
        const glm::dvec3 difference = along - own.area;
        if (glm::length(difference) > kLeastArea * (glm::length(along) + glm::length(own.area)))
            return glm::normalize(difference);
        return glm::length(apart) > 0.0 ? glm::normalize(apart) : glm::dvec3(0.0, 1.0, 0.0);
    }

    std::shared_ptr<const Model> model_;
    const JoinedBodies& joined_;
    cpu::Collision<double> collision_;
    std::vector<glm::vec4> positions_;
    std::vector<glm::dvec3> moved_;  // by object [m]
    std::vector<std::pair<std::uint32_t, glm::dvec3>> left_planes_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> overlapping_;
};

}  // namespace

std::optional<MovedApart> move_apart(const std::shared_ptr<const Model>& model,
                                     std::span<const glm::vec4> positions, const JoinedBodies& joined,
                                     std::string_view when) {
    Mover mover(model, positions, joined);
    const bool any_left = mover.leave_planes();
    if (!mover.make_round(kStep) && !any_left) return std::nullopt;
    for (int round = 1; round < kMostRounds; ++round)
        if (!mover.make_round(kStep * std::exp2(round / kRoundsADoubling))) break;
    return mover.take(when);
}

}  // namespace gelatin
