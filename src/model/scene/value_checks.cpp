#include "model/scene/value_checks.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace gelatin {

void ValueChecks::check_direction(const FieldPath& field, const glm::dvec3& v) const {
    check(field, v);
    const double length = glm::length(v);
    if (length == 0.0) fail(field, text_of(v), "must not be zero: a direction");
    if (!(std::abs(length - 1.0) <= 1e-6)) fail(field, text_of(v), "must be of length 1");
}

void ValueChecks::check_text(const FieldPath& field, std::string_view text) const {
    if (text.empty()) fail(field, text_of(text), "must not be empty");
    if (!is_plain_name(text))
        fail(field, text_of(text), "must not have line breaks or other control characters");
}

}  // namespace gelatin
