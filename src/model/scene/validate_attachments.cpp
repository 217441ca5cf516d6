#include "model/scene/validate_attachments.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "model/scene/names.h"
#include "model/scene/validate_bodies.h"
#include "model/scene/validate_joints.h"

namespace gelatin {
namespace {

// "there is a, b and c"; of many names only how many there are.
std::string those_there(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 12;
    if (names.empty()) return "there is none";
    if (names.size() > kMost) return fmt::format("there are {}", names.size());
    return "there is " + join_names(names);
}

class AttachmentCheck {
public:
    AttachmentCheck(const ValueChecks& checks, const Scene& scene) : checks_(checks), scene_(scene) {
        for (const ObjectDescription& object : scene.objects) objects_.emplace(object.name, &object);
        for (const ColliderDescription& collider : scene.colliders)
            if (!collider.name.empty()) colliders_.insert(collider.name);
    }

    void run(const FieldPath& field, const AttachmentDescription& attachment) const {
        if (!is_implicit(scene_.simulation.solver))
            checks_.fail(field, "", "needs simulation.solver = \"implicit\"");
        check_object(field / "object", attachment.object);
        if (!attachment.to.empty()) check_to(field / "to", attachment);
        check_where(field, attachment);
        check_joint(checks_, field, attachment, deformable_side(attachment));
        checks_.check(field / "compliance", attachment.compliance, kNotNegative);
        checks_.check(field / "break_force", attachment.break_force, kPositive);
    }

private:
    void check_object(const FieldPath& field, const std::string& name) const {
        if (objects_.contains(name)) return;
        std::vector<std::string> names;
        for (const ObjectDescription& object : scene_.objects) names.push_back(object.name);
        checks_.fail(field, text_of(name),
                     fmt::format("no such object{}; {}", suggestion(name, names), those_there(names)));
    }

    // A name of an object and of colliders is the object's.
    void check_to(const FieldPath& field, const AttachmentDescription& attachment) const {
        const std::string& name = attachment.to;
        if (name == attachment.object || (!objects_.contains(name) && !colliders_.contains(name))) {
            const std::vector<std::string> names = names_but(attachment.object);
            checks_.fail(field, text_of(name),
                         fmt::format("must be another object's name or a collider's{}; {}",
                                     suggestion(name, names), those_there(names)));
        }
    }

    void check_where(const FieldPath& field, const AttachmentDescription& attachment) const {
        if (const auto* region = std::get_if<Region>(&attachment.where))
            check_region(checks_, field / "region", *region);
        if (const auto* point = std::get_if<AttachedPoint>(&attachment.where))
            checks_.check(field / "point", point->at);
        if (std::holds_alternative<std::monostate>(attachment.where) && attachment.to.empty())
            checks_.fail(field, "",
                         "needs \"to\", or one of region, point, line, rail, universal and distance");
    }

    // The name of the first side that is one; empty: none is.
    std::string_view deformable_side(const AttachmentDescription& attachment) const {
        for (const std::string* name : {&attachment.object, &attachment.to}) {
            const auto object = objects_.find(*name);
            if (object != objects_.end() && !object->second->rigid) return object->first;
        }
        return {};
    }

    // All that an attachment of `object` may be to.
    std::vector<std::string> names_but(const std::string& object) const {
        std::vector<std::string> names;
        for (const ObjectDescription& other : scene_.objects)
            if (other.name != object) names.push_back(other.name);
        for (const ColliderDescription& collider : scene_.colliders) {
            const std::string& name = collider.name;
            if (!name.empty() && !objects_.contains(name)) names.push_back(name);
        }
        return names;
    }

    const ValueChecks& checks_;
    const Scene& scene_;
    std::unordered_map<std::string_view, const ObjectDescription*> objects_;
    std::unordered_set<std::string_view> colliders_;  // names
};

}  // namespace

void check_attachments(const ValueChecks& checks, const Scene& scene) {
    if (scene.attachments.empty()) return;
    const AttachmentCheck check(checks, scene);
    for (std::size_t a = 0; a < scene.attachments.size(); ++a)
        check.run(FieldPath("attachment", a), scene.attachments[a]);
    check_optional_names(checks, FieldPath("attachment"), "attachment", scene.attachments);
}

}  // namespace gelatin
