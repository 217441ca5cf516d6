#include "model/assembly/attachments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <optional>
#include <string_view>
#include <variant>

#include "gelatin/error.h"
#include "mesh/lattice/face_tree.h"
#include "model/assembly/carrier.h"
#include "model/assembly/collider_surface.h"
#include "model/collision/surface_parts.h"
#include "model/region.h"
#include "model/scene/field_path.h"

namespace gelatin {
namespace {

constexpr double kNear = 0.5;            // glued without a region, in median edges of the object
constexpr double kFar = 4.0;             // from what carries a point, in median edges of that
constexpr std::size_t kMostOnLine = 64;  // points

class AttachmentMaker {
public:
    AttachmentMaker(const AttachmentDescription& description, std::size_t index, const Scene& scene,
                    const Model& model, std::span<const glm::vec4> positions)
        : description_(description),
          field_("attachment", index),
          scene_(scene),
          model_(model),
          positions_(positions) {
        made_.name = name_of_attachment(description, index);
        made_.compliance = static_cast<float>(description.compliance);
        if (description.break_force) made_.break_force = static_cast<float>(*description.break_force);
        made_.object = *find(description.object);
        if (!description.to.empty()) find_other();
        own_.emplace(model, made_.object, positions);
        if (made_.other != kNoNode) other_.emplace(model, made_.other, positions);
        // What never moves is in space.
        const bool moves = made_.other != kNoNode && (model.is_body(made_.other) ||
                                                      model.surfaces[made_.other - model.body_count()].moves);
        if (moves && !other_->can_carry())
            fail("to", fmt::format("must not be flat, as '{}' is, and move", other_->name()));
        made_.is_in_space = !moves;
    }

    Attachment make() {
        if (const auto* point = std::get_if<AttachedPoint>(&description_.where)) {
            tie({point->at}, "point");
        } else if (const auto* line = std::get_if<AttachedLine>(&description_.where)) {
            tie(points_on(*line), "line");
            if (are_rigid()) join(Joint::Kind::hinge, frame_on(line->from, line->to));
        } else if (const auto* rail = std::get_if<AttachedRail>(&description_.where)) {
            join(Joint::Kind::slider, frame_on(rail->from, rail->to));
        } else if (const auto* both = std::get_if<AttachedUniversal>(&description_.where)) {
            tie({both->at}, "universal");
            const glm::dvec3 z = glm::normalize(both->of_other), y = glm::normalize(glm::cross(z, both->own));
            join(Joint::Kind::universal, {both->at, {glm::cross(y, z), y, z}});
        } else if (const auto* distance = std::get_if<AttachedDistance>(&description_.where)) {
            keep_distance(*distance);
        } else {
            glue();
        }
        if (made_.joint.has_coordinate()) find_drive();
        return std::move(made_);
    }

private:
    [[noreturn]] void fail(const char* key, const std::string& problem) const {
        throw InvalidInput({scene_.file.string(),
                            description_.line,
                            describe(field_ / key, description_.name),
                            {},
                            problem});
    }

    // Bodies come before colliders' surfaces.
    std::optional<std::uint32_t> find(const std::string& name) const {
        const auto found = std::find_if(model_.objects.begin(), model_.objects.end(),
                                        [&](const ModelObject& object) { return object.name == name; });
        if (found == model_.objects.end()) return {};
        return static_cast<std::uint32_t>(found - model_.objects.begin());
    }

    void find_other() {
        if (const auto object = find(description_.to)) {
            made_.other = *object;
            return;
        }
        std::uint32_t plane = 0;  // planes come first in Model::colliders
        for (std::size_t c = 0; c < scene_.colliders.size(); ++c) {
            const bool is_plane = std::holds_alternative<PlaneCollider>(scene_.colliders[c].shape);
            if (name_of_collider(scene_.colliders[c], c) == description_.to) {
                if (is_plane) made_.plane = plane;
                return;
            }
            if (is_plane) ++plane;
        }
    }

    // Points of a joint, which both sides carry.
    void tie(const std::vector<glm::dvec3>& points, const char* key) {
        const std::vector<CarriedVertex> own = own_->carry(points);
        check_near(*own_, points, own, key);
        std::vector<Tie> ties(points.size());
        for (std::size_t p = 0; p < points.size(); ++p)
            for (int k = 0; k < 4; ++k) add(ties[p], own[p].nodes[k], own[p].weights[k]);
        finish(points, std::move(ties), key);
    }

    bool are_rigid() const { return own_->is_rigid() && (made_.is_in_space || other_->is_rigid()); }

    // z along the line from one point to another.
    static Frame frame_on(const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 z = glm::normalize(to - from), least = glm::abs(z);
        const int axis = least.x <= least.y && least.x <= least.z ? 0 : least.y <= least.z ? 1 : 2;
        glm::dvec3 x(0.0);
        x[axis] = 1.0;
        x = glm::normalize(x - z[axis] * z);
        return {from, {x, glm::cross(z, x), z}};
    }

    void join(Joint::Kind kind, const Frame& frame) {
        made_.joint.kind = kind;
        made_.joint.own = own_->carry_frame(frame);
        made_.joint.other =
            made_.is_in_space ? CarriedFrame{.at = {frame.point, frame.axes[0], frame.axes[1], frame.axes[2]}}
                              : other_->carry_frame(frame);
        made_.joint.lever = own_->size();
    }

    void keep_distance(const AttachedDistance& distance) {
        made_.joint.kind = Joint::Kind::distance;
        made_.joint.own = own_->carry_point(distance.from);
        check_near(*own_, {distance.from}, own_->carry({distance.from}), "distance");
        if (made_.is_in_space) {
            made_.joint.other.at[0] = distance.to;
        } else {
            made_.joint.other = other_->carry_point(distance.to);
            check_near(*other_, {distance.to}, other_->carry({distance.to}), "distance");
        }
    }

    // Limits, spring and motor, in radians.
    void find_drive() {
        Joint& joint = made_.joint;
        const double unit = unit_of_coordinate(description_);
        const auto* distance = std::get_if<AttachedDistance>(&description_.where);
        joint.rest = distance != nullptr ? glm::distance(distance->from, distance->to) : 0.0;
        joint.is_kept =
            distance != nullptr && !description_.limits && !description_.spring && !description_.motor;
        if (description_.limits) joint.limits = unit * *description_.limits;
        if (!description_.spring) return;
        joint.stiffness = description_.spring->stiffness;
        joint.damping = description_.spring->damping;
        if (description_.spring->rest) joint.rest = unit * *description_.spring->rest;
    }

    // Nodes of the object.
    void glue() {
        const ModelObject& object = model_.objects[made_.object];
        const auto* region = std::get_if<Region>(&description_.where);
        std::vector<std::uint32_t> nodes;
        if (region != nullptr) {
            nodes = find_inside(*region, positions_of_object(object, positions_));
            for (std::uint32_t& n : nodes) n += object.nodes.first;
            if (nodes.empty())
                fail("region",
                     fmt::format("holds no node of '{}' (regions are in world coordinates)", object.name));
        } else {
            nodes = near_nodes();
            if (nodes.empty())
                fail("to",
                     fmt::format(
                         "'{}' has no node within '{}', or at most {:.3g} m from it, half an edge of its "
                         "surface: a region can name some that are farther",
                         object.name, description_.to, kNear * own_->edge()));
        }
        made_.is_firm = nodes.size() >= 3 && !(description_.compliance > 0.0);  // fewer are a joint
        std::vector<glm::dvec3> points;
        std::vector<Tie> ties(nodes.size());
        for (std::size_t p = 0; p < nodes.size(); ++p) {
            points.emplace_back(positions_[nodes[p]]);
            add(ties[p], nodes[p], 1.0);
        }
        finish(points, std::move(ties), region != nullptr ? "region" : "to");
    }

    // Of the object, near what it is attached to, or within it.
    std::vector<std::uint32_t> near_nodes() const {
        const double most = kNear * own_->edge();
        const auto is_near = [&](const glm::dvec3& p) {
            if (other_) return other_->is_near(p, most);
            if (made_.plane == kNoNode) return false;
            const glm::dvec4 plane(model_.colliders[made_.plane].center);
            return glm::dot(glm::dvec3(plane), p) - plane.w <= most;
        };
        const Range own = model_.objects[made_.object].shape_nodes();
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t n = own.first; n < own.end(); ++n)
            if (is_near(glm::dvec3(positions_[n]))) nodes.push_back(n);
        return nodes;
    }

    std::vector<glm::dvec3> points_on(const AttachedLine& line) const {
        const double length = glm::distance(line.from, line.to);
        const auto count =
            std::min(static_cast<std::size_t>(std::ceil(length / own_->edge())) + 1, kMostOnLine);
        std::vector<glm::dvec3> points;
        for (std::size_t p = 0; p < count; ++p)
            points.push_back(
                glm::mix(line.from, line.to, static_cast<double>(p) / static_cast<double>(count - 1)));
        return points;
    }

    // A tet that is small beside its distance would throw the point about.
    void check_near(const Carrier& carrier, const std::vector<glm::dvec3>& points,
                    const std::vector<CarriedVertex>& carried, const char* key) const {
        if (carrier.is_rigid()) return;
        const double most = kFar * carrier.edge();
        for (std::size_t p = 0; p < points.size(); ++p) {
            const glm::dvec4& w = carried[p].weights;
            const bool is_inside = std::min(std::min(w.x, w.y), std::min(w.z, w.w)) >= 0.0;
            if (is_inside || carrier.is_near(points[p], most)) continue;
            fail(key,
                 fmt::format(
                     "[{:.4g}, {:.4g}, {:.4g}] is farther than {:.3g} m from '{}', four edges of its surface",
                     points[p].x, points[p].y, points[p].z, most, carrier.name()));
        }
    }

    // Adds what the points are attached to.
    void finish(const std::vector<glm::dvec3>& points, std::vector<Tie> ties, const char* key) {
        if (made_.is_in_space) {
            for (std::size_t p = 0; p < ties.size(); ++p) ties[p].at = glm::vec3(points[p]);
        } else {
            const std::vector<CarriedVertex> carried = other_->carry(points);
            check_near(*other_, points, carried, key);
            for (std::size_t p = 0; p < ties.size(); ++p)
                for (int k = 0; k < 4; ++k) add(ties[p], carried[p].nodes[k], -carried[p].weights[k]);
        }
        made_.ties = std::move(ties);
    }

    static void add(Tie& tie, std::uint32_t node, double weight) {
        if (weight == 0.0) return;
        tie.nodes[tie.count] = node;
        tie.weights[tie.count++] = static_cast<float>(weight);
    }

    const AttachmentDescription& description_;
    FieldPath field_;
    const Scene& scene_;
    const Model& model_;
    std::span<const glm::vec4> positions_;
    std::optional<Carrier> own_, other_;
    Attachment made_;
};

}  // namespace

double unit_of_coordinate(const AttachmentDescription& description) {
    return std::holds_alternative<AttachedLine>(description.where) ? glm::radians(1.0) : 1.0;
}

MotorTarget motor_at(const AttachmentDescription& description, const JointMotor& motor, double time) {
    JointMotor now = motor;
    for (const MotorKeyframe& keyframe : motor.keyframes) {
        if (keyframe.time > time) break;
        if (keyframe.speed) now.speed = keyframe.speed;
        if (keyframe.position) now.position = keyframe.position;
        if (keyframe.force) now.force = keyframe.force;
    }
    const double unit = unit_of_coordinate(description);
    MotorTarget target;
    target.acts = true;
    target.force = now.force.value_or(Joint::kNoLimit);
    target.speed = unit * now.speed.value_or(Joint::kNoLimit);
    if (now.position) target.position = unit * *now.position;
    return target;
}

std::string name_of_attachment(const AttachmentDescription& description, std::size_t index) {
    return description.name.empty() ? fmt::format("attachment {}", index + 1) : description.name;
}

Attachment make_attachment(const AttachmentDescription& description, std::size_t index, const Scene& scene,
                           const Model& model, std::span<const glm::vec4> positions) {
    Attachment made = AttachmentMaker(description, index, scene, model, positions).make();
    made.positions = std::make_shared<const std::vector<glm::vec4>>(positions.begin(), positions.end());
    return made;
}

JoinedBodies joined_bodies(const Scene& scene, const Model& model) {
    std::map<std::string_view, std::uint32_t> objects;  // by name
    for (std::uint32_t o = 0; o < model.objects.size(); ++o) objects.emplace(model.objects[o].name, o);
    JoinedBodies joined;
    for (const AttachmentDescription& attachment : scene.attachments) {
        if (std::holds_alternative<AttachedDistance>(attachment.where)) continue;
        const auto object = objects.find(attachment.object), other = objects.find(attachment.to);
        if (object != objects.end() && other != objects.end() && joins(model, object->second, other->second))
            joined.insert(std::minmax(object->second, other->second));
    }
    return joined;
}

std::vector<Attachment> make_attachments(const Scene& scene, const Model& model,
                                         std::span<const glm::vec4> positions) {
    std::vector<Attachment> attachments;
    for (std::size_t a = 0; a < scene.attachments.size(); ++a) {
        attachments.push_back(AttachmentMaker(scene.attachments[a], a, scene, model, positions).make());
        attachments[a].positions =
            a > 0 ? attachments[0].positions
                  : std::make_shared<const std::vector<glm::vec4>>(positions.begin(), positions.end());
    }
    return attachments;
}

}  // namespace gelatin
