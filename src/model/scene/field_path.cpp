#include "model/scene/field_path.h"

#include <fmt/format.h>

#include <algorithm>

namespace gelatin {

bool is_plain_name(std::string_view name) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    return !name.empty() && std::none_of(name.begin(), name.end(), is_control);
}

std::string describe(const FieldPath& path, std::string_view name) {
    std::string text;
    for (const FieldStep& step : path.steps()) {
        const bool is_first = text.empty();
        if (!is_first) text += '.';
        text += step.key;
        if (is_first && step.index && is_plain_name(name)) {
            text += fmt::format(".{}", name);
        } else if (step.index) {
            text += fmt::format("[{}]", *step.index);
        }
    }
    return text;
}

}  // namespace gelatin
