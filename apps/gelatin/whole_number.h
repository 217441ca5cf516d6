#pragma once

#include <CLI/CLI.hpp>

#include <charconv>
#include <string>

#include <fmt/core.h>

namespace gelatin {

/// Checks that an option is a whole number, `least` or larger.
inline CLI::Validator at_least(int least) {
    const auto problem_of = [least](const std::string& text) -> std::string {
        int value = 0;
        const char* const end = text.data() + text.size();
        const auto [last, status] = std::from_chars(text.data(), end, value);
        if (status == std::errc() && last == end && value >= least) return {};
        return fmt::format("must be a whole number from {} on, not {}", least, text);
    };
    return CLI::Validator([problem_of](std::string& text) { return problem_of(text); }, {});
}

}  // namespace gelatin
