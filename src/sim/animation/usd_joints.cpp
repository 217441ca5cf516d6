#include "sim/animation/usd_joints.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <variant>
#include <vector>

namespace gelatin {
namespace {

// One prim; bodies' prims do not move, so local places are those in the world.
class UsdJoint {
public:
    explicit UsdJoint(const AttachmentDescription& attachment) : attachment_(attachment) {
        std::visit([&](const auto& where) { set(where); }, attachment.where);
        if (attachment.break_force) add("float physics:breakForce = {}", *attachment.break_force);
    }

    // @param other empty: the world
    std::string text(std::size_t number, const std::string& object, const std::string& other) const {
        std::string text = fmt::format("        def {} \"joint_{}\"", type_, number);
        if (!schemas_.empty())
            text += fmt::format(" (\n            prepend apiSchemas = [{}]\n        )",
                                fmt::join(schemas_, ", "));
        text += "\n        {\n";
        if (!other.empty()) text += fmt::format("            rel physics:body0 = <{}>\n", other);
        text += fmt::format("            rel physics:body1 = <{}>\n", object);
        for (const auto& [side, place] : {std::pair(0, place0_), std::pair(1, place1_)})
            text += fmt::format(
                "            point3f physics:localPos{0} = ({1}, {2}, {3})\n"
                "            quatf physics:localRot{0} = ({4}, {5}, {6}, {7})\n",
                side, place.x, place.y, place.z, rotation_.w, rotation_.x, rotation_.y, rotation_.z);
        for (const std::string& line : lines_) text += "            " + line + "\n";
        return text + "        }\n";
    }

private:
    template <class... Values>
    void add(const char* format, const Values&... values) {
        lines_.push_back(fmt::format(fmt::runtime(format), values...));
    }
    void set_places(const glm::dvec3& place) { place0_ = place1_ = place; }

    void set(std::monostate) { type_ = "PhysicsFixedJoint"; }
    void set(const Region&) { type_ = "PhysicsFixedJoint"; }
    void set(const AttachedPoint& point) {
        type_ = "PhysicsSphericalJoint";
        set_places(point.at);
    }
    void set(const AttachedLine& line) {
        type_ = "PhysicsRevoluteJoint";
        set_axis(line.from, line.to);
        // Its drives are in degrees throughout.
        set_drive("angular", glm::radians(1.0));
    }
    void set(const AttachedRail& rail) {
        type_ = "PhysicsPrismaticJoint";
        set_axis(rail.from, rail.to);
        set_drive("linear", 1.0);
    }
    // x is the axis of the object, z that of the other side.
    void set(const AttachedUniversal& universal) {
        type_ = "PhysicsJoint";
        set_places(universal.at);
        const glm::dvec3 z = glm::normalize(universal.of_other),
                         y = glm::normalize(glm::cross(z, universal.own));
        rotation_ = glm::dquat(glm::dmat3(glm::cross(y, z), y, z));
        for (const char* locked : {"transX", "transY", "transZ", "rotY"}) {
            schemas_.push_back(fmt::format("\"PhysicsLimitAPI:{}\"", locked));
            add("float limit:{}:physics:low = 1", locked);
            add("float limit:{}:physics:high = -1", locked);
        }
    }
    void set(const AttachedDistance& distance) {
        type_ = "PhysicsDistanceJoint";
        place0_ = distance.to;
        place1_ = distance.from;
        const double length = glm::distance(distance.from, distance.to);
        const bool is_free = attachment_.spring || attachment_.motor;
        if (!attachment_.limits && is_free) return;
        const glm::dvec2 limits = attachment_.limits.value_or(glm::dvec2(length));
        add("float physics:minDistance = {}", limits.x);
        add("float physics:maxDistance = {}", limits.y);
    }

    void set_axis(const glm::dvec3& from, const glm::dvec3& to) {
        set_places(from);
        rotation_ = glm::rotation(glm::dvec3(0.0, 0.0, 1.0), glm::normalize(to - from));
        add("uniform token physics:axis = \"Z\"");
        if (!attachment_.limits) return;
        add("float physics:lowerLimit = {}", attachment_.limits->x);
        add("float physics:upperLimit = {}", attachment_.limits->y);
    }
    // A spring or, in place of it, a motor. @param unit [rad], or 1: of stiffness and damping
    void set_drive(const char* name, double unit) {
        const auto drive = [&](const char* key, double value) {
            add("float drive:{}:physics:{} = {}", name, key, value);
        };
        if (!attachment_.spring && !attachment_.motor) return;
        schemas_.push_back(fmt::format("\"PhysicsDriveAPI:{}\"", name));
        constexpr double kStiff = 1e6;  // of what has no stiffness of its own
        if (const auto& motor = attachment_.motor) {
            if (motor->position) {
                drive("stiffness", kStiff);
                drive("targetPosition", *motor->position);
            }
            if (motor->speed && !motor->position) drive("targetVelocity", *motor->speed);
            drive("damping", kStiff);
            if (motor->force) drive("maxForce", *motor->force);
        } else {
            drive("stiffness", unit * attachment_.spring->stiffness);
            drive("damping", unit * attachment_.spring->damping);
            drive("targetPosition", attachment_.spring->rest.value_or(0.0));
        }
    }

    const AttachmentDescription& attachment_;
    const char* type_ = nullptr;
    glm::dvec3 place0_{0.0}, place1_{0.0};
    glm::dquat rotation_{1.0, 0.0, 0.0, 0.0};
    std::vector<std::string> schemas_, lines_;
};

}  // namespace

std::string usd_joints(std::span<const AttachmentDescription> attachments,
                       const std::map<std::string, std::string>& paths) {
    std::string text;
    for (std::size_t a = 0; a < attachments.size(); ++a) {
        const auto object = paths.find(attachments[a].object), other = paths.find(attachments[a].to);
        if (object == paths.end() || (other == paths.end() && !attachments[a].to.empty())) continue;
        text +=
            UsdJoint(attachments[a]).text(a + 1, object->second, other == paths.end() ? "" : other->second);
    }
    return text.empty() ? text : "    def Scope \"joints\"\n    {\n" + text + "    }\n";
}

}  // namespace gelatin
