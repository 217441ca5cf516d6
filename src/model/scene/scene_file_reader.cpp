#include "model/scene/scene_file_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <sstream>

namespace gelatin {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row.back();
}

// Scalars as TOML writes them; long lists and tables shortened, since a message is one line.
std::string show(const toml::node& node) {
    if (node.is_table()) return "{...}";
    if (const toml::array* array = node.as_array()) {
        constexpr std::size_t kShown = 6;
        std::string text = "[";
        for (std::size_t i = 0; i < array->size() && i < kShown; ++i) {
            text += (i > 0 ? ", " : "") + show((*array)[i]);
        }
        return text + (array->size() > kShown ? ", ...]" : "]");
    }
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());  // shortest
    std::ostringstream stream;
    stream << toml::toml_formatter{node, toml::format_flags::none};
    return stream.str();
}

const char* kind_of(const toml::node& node) {
    if (node.is_string()) return "a string";
    if (node.is_integer()) return "a whole number";
    if (node.is_floating_point()) return "a fraction";
    if (node.is_boolean()) return "true or false";
    if (node.is_array()) return "a list";
    if (node.is_table()) return "a table";
    return "a date or time";
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
    std::optional<std::string> nearest;
    std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(name, candidate);
        if (distance < least && distance < candidate.size()) {
            least = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
    const auto nearest = nearest_name(name, candidates);
    return nearest ? fmt::format(" (did you mean \"{}\"?)", *nearest) : "";
}

std::string join_names(const std::vector<std::string>& names, const char* last) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? fmt::format(" {} ", last) : ", ";
        text += names[i];
    }
    return text;
}

std::string describe(const toml::parse_error& error) {
    std::string text = fmt::format("is not TOML: {}", error.description());
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    return text;
}

InputProblem problem_at(const toml::node& node, const std::string& file, const std::string& field,
                        const std::string& problem) {
    const toml::source_region& source = node.source();
    const std::string origin = source.path ? *source.path : file;
    const bool is_override = origin.compare(0, kOverridePrefix.size(), kOverridePrefix) == 0;
    const int line = is_override ? 0 : static_cast<int>(source.begin.line);
    return {origin, line, field, node.is_table() ? "" : show(node), problem};
}

int TableReader::line() const {
    return static_cast<int>(table_->source().begin.line);
}

std::string TableReader::field(std::string_view key) const {
    if (path_.empty() || key.empty()) return path_ + std::string(key);
    return path_ + "." + std::string(key);
}

void TableReader::fail_at(const toml::node& node, std::string_view key, const std::string& problem) const {
    throw InvalidInput(problem_at(node, *file_, field(key), problem));
}

void TableReader::fail(std::string_view key, const std::string& problem) const {
    const toml::node* node = table_->get(key);
    fail_at(node != nullptr ? *node : *table_, key, problem);
}

const toml::node* TableReader::find(const char* key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    return table_->get(key);
}

void TableReader::require(std::initializer_list<const char*> keys) {
    for (const char* key : keys) {
        if (find(key) != nullptr) continue;
        // A misspelt key is missing too; the slip is the better message.
        for (auto&& [name, node] : *table_) {
            if (nearest_name(name.str(), {key})) {
                fail(name.str(), fmt::format("unknown key (did you mean \"{}\"?)", key));
            }
        }
        fail("", fmt::format("needs \"{}\"", key));
    }
}

std::string TableReader::require_one_of(const std::vector<std::string>& keys) {
    std::vector<std::string> present;
    for (const std::string& key : keys) {
        if (has(key)) present.push_back(key);
    }
    if (present.size() == 1) {
        find(present.front().c_str());
        return present.front();
    }
    const std::string wanted = "must have exactly one of " + join_names(keys, "or");
    if (!present.empty()) fail("", wanted + ", has " + join_names(present));
    for (auto&& [name, node] : *table_) {
        const std::string hint = suggestion(name.str(), keys);
        if (!hint.empty()) fail(name.str(), "unknown key" + hint);
    }
    fail("", wanted);
}

double TableReader::number(const toml::node& node, std::string_view key, const Limit& limit) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) fail_at(node, key, fmt::format("must be a number, is {}", kind_of(node)));
    if (!std::isfinite(*value)) fail_at(node, key, "must be finite");
    if (!limit.holds(*value)) fail_at(node, key, fmt::format("must be {}", limit.allowed));
    // Beyond these, squares leave the range of the solvers' floats.
    if (*value != 0.0 && (std::abs(*value) > 1e15 || std::abs(*value) < 1e-15)) {
        fail_at(node, key, "must be 0 or of a magnitude from 1e-15 to 1e15");
    }
    return *value;
}

int TableReader::whole_number(const toml::node& node, std::string_view key, const Limit& limit) const {
    const toml::value<std::int64_t>* integer = node.as_integer();
    if (integer == nullptr) fail_at(node, key, fmt::format("must be a whole number, is {}", kind_of(node)));
    const std::int64_t value = integer->get();
    constexpr std::int64_t kMost = std::numeric_limits<int>::max();
    if (!limit.holds(static_cast<double>(value)))
        fail_at(node, key, fmt::format("must be {}", limit.allowed));
    if (value < -kMost || value > kMost) fail_at(node, key, fmt::format("must be at most {}", kMost));
    return static_cast<int>(value);
}

const toml::array& TableReader::three(const toml::node& node, const char* key) const {
    const toml::array* array = node.as_array();
    if (array == nullptr)
        fail_at(node, key, fmt::format("must be a list of 3 numbers, is {}", kind_of(node)));
    if (array->size() != 3) {
        fail_at(node, key, fmt::format("must be a list of 3 numbers, has {}", array->size()));
    }
    return *array;
}

void TableReader::read(const char* key, double& value, const Limit& limit) {
    if (const toml::node* node = find(key)) value = number(*node, key, limit);
}

void TableReader::read(const char* key, std::optional<double>& value, const Limit& limit) {
    if (const toml::node* node = find(key)) value = number(*node, key, limit);
}

void TableReader::read(const char* key, int& value, const Limit& limit) {
    if (const toml::node* node = find(key)) value = whole_number(*node, key, limit);
}

void TableReader::read(const char* key, bool& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    if (!node->is_boolean()) fail(key, fmt::format("must be true or false, is {}", kind_of(*node)));
    value = node->as_boolean()->get();
}

void TableReader::read(const char* key, std::string& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::value<std::string>* text = node->as_string();
    if (text == nullptr) fail(key, fmt::format("must be a string, is {}", kind_of(*node)));
    if (text->get().empty()) fail(key, "must not be empty");
    // Names go into one-line messages and exported files.
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (std::any_of(text->get().begin(), text->get().end(), is_control)) {
        fail(key, "must not have line breaks or other control characters");
    }
    value = text->get();
}

void TableReader::read(const char* key, glm::dvec3& value, const Limit& limit) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::array& array = three(*node, key);
    for (int i = 0; i < 3; ++i) {
        value[i] = number(array[static_cast<std::size_t>(i)], fmt::format("{}[{}]", key, i), limit);
    }
}

void TableReader::read(const char* key, glm::ivec3& value, const Limit& limit) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::array& array = three(*node, key);
    for (int i = 0; i < 3; ++i) {
        value[i] = whole_number(array[static_cast<std::size_t>(i)], fmt::format("{}[{}]", key, i), limit);
    }
}

void TableReader::read_direction(const char* key, glm::dvec3& value) {
    glm::dvec3 direction = value;
    read(key, direction);
    const double length = glm::length(direction);
    if (length == 0.0) fail(key, "must not be zero: a direction");
    value = direction / length;
}

std::vector<std::string> TableReader::read_names(const char* key, const std::vector<std::string>& names) {
    const toml::node* node = find(key);
    const toml::array* array = node != nullptr ? node->as_array() : nullptr;
    if (array == nullptr) fail(key, fmt::format("must be a list of names: {}", join_names(names)));
    if (array->empty()) fail(key, fmt::format("must name at least one of {}", join_names(names, "or")));
    std::vector<std::string> found;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const toml::node& element = (*array)[i];
        const std::string place = fmt::format("{}[{}]", key, i);
        const std::string name = element.value_or(std::string());
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            fail_at(element, place,
                    fmt::format("must be {}{}", join_names(names, "or"), suggestion(name, names)));
        }
        if (std::find(found.begin(), found.end(), name) != found.end())
            fail_at(element, place, "is there twice");
        found.push_back(name);
    }
    return found;
}

std::optional<TableReader> TableReader::table(const char* key) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_table()) {
        fail(key, node->is_array_of_tables() ? fmt::format("must be one table: write [{}]", key)
                                             : fmt::format("must be a table, is {}", kind_of(*node)));
    }
    return TableReader(*node->as_table(), field(key), *file_);
}

std::vector<TableReader> TableReader::tables(const char* key) {
    std::vector<TableReader> readers;
    const toml::node* node = find(key);
    if (node == nullptr) return readers;
    if (node->is_table()) fail(key, fmt::format("must be a list of tables: write [[{}]]", key));
    const toml::array* array = node->as_array();
    if (array == nullptr) fail(key, fmt::format("must be a list of tables, is {}", kind_of(*node)));
    for (std::size_t i = 0; i < array->size(); ++i) {
        const toml::node& element = (*array)[i];
        const std::string place = fmt::format("{}[{}]", key, i);
        if (!element.is_table())
            fail_at(element, place, fmt::format("must be a table, is {}", kind_of(element)));
        readers.emplace_back(*element.as_table(), field(place), *file_);
    }
    return readers;
}

void TableReader::fail_choice(const char* key, const std::string& name,
                              const std::vector<std::string>& names) const {
    fail(key, fmt::format("must be {}{}", join_names(names, "or"), suggestion(name, names)));
}

void TableReader::finish() const {
    const toml::key* first = nullptr;
    for (auto&& [key, node] : *table_) {
        const bool known = std::find(known_.begin(), known_.end(), key.str()) != known_.end();
        if (!known && (first == nullptr || key.source().begin < first->source().begin)) first = &key;
    }
    if (first == nullptr) return;
    const std::string hint = suggestion(first->str(), known_);
    fail(first->str(),
         hint.empty() ? "unknown key; known here are " + join_names(known_) : "unknown key" + hint);
}

}  // namespace gelatin
