#pragma once

#include <fmt/format.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "model/scene/names.h"
#include "model/scene/value_checks.h"

namespace gelatin {

/// The parts of validate() for objects and colliders.
void check_objects(const ValueChecks& checks, const Scene& scene);
void check_colliders(const ValueChecks& checks, const Scene& scene);

inline constexpr const char* kNeedsContact = "needs collision.response = \"contact\"";

// Of what a rigid object has not, in files and in code.
inline constexpr const char* kHoldsNoNodes =
    "a rigid body has none: an [[attachment]] holds it, and a [[collider]] follows keyframes";
inline constexpr const char* kHasNoTets = "a rigid body has none: it does not deform, and has no tets";

/// Names of one kind of table: plain and free. Those without one go by their place: "collider 2".
/// @param field of the list @param Item has `name` and `line`
template <class Item>
void check_optional_names(const ValueChecks& checks, const FieldPath& field, const char* kind,
                          const std::vector<Item>& items) {
    std::unordered_map<std::string, int> lines;  // by name
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i].name.empty()) lines.emplace(fmt::format("{} {}", kind, i + 1), items[i].line);
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (items[i].name.empty()) continue;
        checks.check_text(field[i] / "name", items[i].name);
        const auto [taken, is_new] = lines.emplace(items[i].name, items[i].line);
        if (!is_new) checks.fail(field[i] / "name", text_of(items[i].name), name_taken(kind, taken->second));
    }
}

/// A region of an object's pin, handle, load or part, or of an attachment.
void check_region(const ValueChecks& checks, const FieldPath& field, const Region& region);
/// The same of one that a program gives. @throws InvalidInput naming "region"
void check_region(const Region& region);
void check_keyframes(const ValueChecks& checks, const FieldPath& field, const std::vector<Keyframe>& keys);
void check_handle(const ValueChecks& checks, const FieldPath& field, const HandleDescription& handle,
                  bool has_contact);
/// Of a handle or a collider with these keyframes. Only contact holds one up.
void check_when_blocked(const ValueChecks& checks, const FieldPath& field, WhenBlocked when_blocked,
                        bool moves, bool has_contact);
void check_load(const ValueChecks& checks, const FieldPath& field, const LoadDescription& load);

}  // namespace gelatin
