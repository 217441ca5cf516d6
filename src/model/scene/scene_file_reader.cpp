#include "model/scene/scene_file_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <sstream>
#include <type_traits>

namespace gelatin {
namespace {

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

int TableReader::line_of(const char* key) {
    const toml::node* node = find(key);
    return node != nullptr ? problem_at(*node, *file_, {}, {}).line : 0;
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

std::vector<std::string> TableReader::present_of(const std::vector<std::string>& keys) const {
    std::vector<std::string> present;
    for (const std::string& key : keys) {
        if (table_->contains(key)) present.push_back(key);
    }
    return present;
}

std::string TableReader::require_one_of(const std::vector<std::string>& keys) {
    const std::vector<std::string> present = present_of(keys);
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

std::string TableReader::at_most_one_of(const std::vector<std::string>& keys) {
    for (const std::string& key : keys) find(key.c_str());
    const std::vector<std::string> present = present_of(keys);
    if (present.size() > 1) {
        fail("",
             fmt::format("must have at most one of {}, has {}", join_names(keys, "or"), join_names(present)));
    }
    return present.empty() ? std::string() : present.front();
}

double TableReader::number(const toml::node& node, std::string_view key) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) fail_at(node, key, fmt::format("must be a number, is {}", kind_of(node)));
    return *value;
}

int TableReader::whole_number(const toml::node& node, std::string_view key) const {
    const toml::value<std::int64_t>* integer = node.as_integer();
    if (integer == nullptr) fail_at(node, key, fmt::format("must be a whole number, is {}", kind_of(node)));
    const std::int64_t value = integer->get();
    constexpr std::int64_t kMost = std::numeric_limits<int>::max();
    if (value > kMost) fail_at(node, key, fmt::format("must be at most {}", kMost));
    if (value < -kMost) fail_at(node, key, fmt::format("must be at least {}", -kMost));
    return static_cast<int>(value);
}

const toml::array& TableReader::list_of(std::size_t count, const toml::node& node, const char* key) const {
    const toml::array* array = node.as_array();
    if (array == nullptr)
        fail_at(node, key, fmt::format("must be a list of {} numbers, is {}", count, kind_of(node)));
    if (array->size() != count) {
        fail_at(node, key, fmt::format("must be a list of {} numbers, has {}", count, array->size()));
    }
    return *array;
}

template <class Vector>
void TableReader::read_numbers(const char* key, Vector& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::array& array = list_of(static_cast<std::size_t>(Vector::length()), *node, key);
    for (int i = 0; i < Vector::length(); ++i) {
        const toml::node& element = array[static_cast<std::size_t>(i)];
        const std::string place = fmt::format("{}[{}]", key, i);
        if constexpr (std::is_integral_v<typename Vector::value_type>) {
            value[i] = whole_number(element, place);
        } else {
            value[i] = number(element, place);
        }
    }
}

void TableReader::read(const char* key, double& value) {
    if (const toml::node* node = find(key)) value = number(*node, key);
}

void TableReader::read(const char* key, std::optional<double>& value) {
    if (const toml::node* node = find(key)) value = number(*node, key);
}

void TableReader::read(const char* key, int& value) {
    if (const toml::node* node = find(key)) value = whole_number(*node, key);
}

void TableReader::read(const char* key, std::optional<int>& value) {
    if (const toml::node* node = find(key)) value = whole_number(*node, key);
}

void TableReader::read(const char* key, bool& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    if (!node->is_boolean()) fail(key, fmt::format("must be true or false, is {}", kind_of(*node)));
    value = node->as_boolean()->get();
}

void TableReader::read(const char* key, std::optional<bool>& value) {
    if (find(key) != nullptr) read(key, value.emplace());
}

void TableReader::read(const char* key, std::string& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const toml::value<std::string>* text = node->as_string();
    if (text == nullptr) fail(key, fmt::format("must be a string, is {}", kind_of(*node)));
    value = text->get();
}

void TableReader::read_name(const char* key, std::string& name) {
    read(key, name);
    if (has(key) && name.empty()) fail(key, "must not be empty");
}

void TableReader::read(const char* key, glm::dvec2& value) {
    read_numbers(key, value);
}

void TableReader::read(const char* key, glm::dvec3& value) {
    read_numbers(key, value);
}

void TableReader::read(const char* key, glm::ivec3& value) {
    read_numbers(key, value);
}

void TableReader::read_direction(const char* key, glm::dvec3& value) {
    read(key, value);
    const double length = glm::length(value);
    if (std::isnormal(length)) value /= length;
}

void TableReader::check(const char* key, const Limit& limit) const {
    const toml::node* node = table_->get(key);
    if (node == nullptr) return;
    const auto check_one = [&](const toml::node& element, std::string_view place) {
        if (const auto problem = problem_of(*element.value<double>(), limit))
            fail_at(element, place, *problem);
    };
    const toml::array* array = node->as_array();
    if (array == nullptr) return check_one(*node, key);
    for (std::size_t i = 0; i < array->size(); ++i) check_one((*array)[i], fmt::format("{}[{}]", key, i));
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

std::pair<std::string, std::string> TableReader::read_two_texts(const char* key) {
    const toml::node* node = find(key);
    const toml::array* array = node != nullptr ? node->as_array() : nullptr;
    if (array == nullptr || array->size() != 2 || !array->is_homogeneous(toml::node_type::string))
        fail(key, "must be a list of two names");
    return {(*array)[0].value_or(std::string()), (*array)[1].value_or(std::string())};
}

std::pair<glm::dvec3, glm::dvec3> TableReader::read_two_points(const char* key, const char* points) {
    const toml::node* node = find(key);
    const toml::array* array = node != nullptr ? node->as_array() : nullptr;
    if (array == nullptr || array->size() != 2 || !array->is_homogeneous<toml::array>())
        fail(key, fmt::format("must be two {}: [[x, y, z], [x, y, z]]", points));
    const auto read_point = [&](const toml::array& numbers) {
        glm::dvec3 point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::optional<double> x =
                numbers.size() == 3 ? numbers[axis].value<double>() : std::nullopt;
            if (!x) fail(key, three_numbers_each(points));
            point[static_cast<int>(axis)] = *x;
        }
        return point;
    };
    const glm::dvec3 first = read_point(*(*array)[0].as_array());
    return {first, read_point(*(*array)[1].as_array())};
}

std::optional<TableReader> TableReader::table(const char* key) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_table()) {
        const std::string form = path_.empty() ? fmt::format("[{}]", key) : fmt::format("{} = {{...}}", key);
        fail(key, node->is_array_of_tables() ? "must be one table: write " + form
                                             : fmt::format("must be a table, is {}", kind_of(*node)));
    }
    return TableReader(*node->as_table(), field(key), *file_);
}

std::vector<TableReader> TableReader::tables(const char* key) {
    std::vector<TableReader> readers;
    const toml::node* node = find(key);
    if (node == nullptr) return readers;
    if (node->is_table()) {
        const std::string form =
            path_.empty() ? fmt::format("[[{}]]", key) : fmt::format("{} = [{{...}}]", key);
        fail(key, "must be a list of tables: write " + form);
    }
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

void TableReader::refuse(const std::vector<std::string>& keys, const std::string& problem) const {
    const std::vector<std::string> present = present_of(keys);
    if (!present.empty()) fail(present.front(), problem);
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
