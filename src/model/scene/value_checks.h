#pragma once

#include <string>
#include <string_view>

#include "model/scene/limits.h"
#include "model/scene/validation.h"
#include "model/scene/value_text.h"

namespace gelatin {

/// The checks of one value that the checks of sections and bodies are made of.
class ValueChecks {
public:
    explicit ValueChecks(const ReportProblem& report) : report_(&report) {}

    void fail(const FieldPath& field, const std::string& value, const std::string& problem) const {
        (*report_)(field, value, problem);
    }

    void check(const FieldPath& field, double value, const Limit& limit = kAnyNumber) const {
        if (const auto problem = problem_of(value, limit)) fail(field, text_of(value), *problem);
    }
    void check(const FieldPath& field, int value, const Limit& limit) const {
        if (const auto problem = problem_of(value, limit)) fail(field, text_of(value), *problem);
    }
    void check(const FieldPath& field, const glm::dvec3& v, const Limit& limit = kAnyNumber) const {
        for (int k = 0; k < 3; ++k) check(field[static_cast<std::size_t>(k)], v[k], limit);
    }
    void check(const FieldPath& field, const glm::ivec3& v, const Limit& limit) const {
        for (int k = 0; k < 3; ++k) check(field[static_cast<std::size_t>(k)], v[k], limit);
    }
    template <class Value>
    void check(const FieldPath& field, const std::optional<Value>& value,
               const Limit& limit = kAnyNumber) const {
        if (value) check(field, *value, limit);
    }

    void check_direction(const FieldPath& field, const glm::dvec3& v) const;
    void check_text(const FieldPath& field, std::string_view text) const;

private:
    const ReportProblem* report_;
};

}  // namespace gelatin
