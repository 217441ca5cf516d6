#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gelatin {

/// The candidate closest to `name` by edit distance, if it is close enough to be a typing error.
std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// " (did you mean "x"?)" for the nearest candidate, else "".
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b and c".
std::string join_names(const std::vector<std::string>& names, const char* last = "and");

/// "is taken by the object on line 3". @param line of the one that has the name; 0: it is in no file
std::string name_taken(const char* kind, int line);

}  // namespace gelatin
