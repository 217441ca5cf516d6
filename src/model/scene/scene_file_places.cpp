#include "model/scene/scene_file_places.h"

#include <string_view>

#include "model/scene/scene_file_reader.h"

namespace gelatin {
namespace {

// Null where the file is silent.
const toml::node* find(const toml::node& node, const FieldStep& step) {
    const toml::table* table = node.as_table();
    const toml::node* child = table != nullptr ? table->get(step.key) : nullptr;
    if (child == nullptr || !step.index) return child;
    const toml::array* array = child->as_array();
    return array != nullptr ? array->get(*step.index) : nullptr;
}

}  // namespace

FieldPath ScenePlaces::path_in_file(const FieldPath& field) const {
    FieldPath path;
    for (const FieldStep& step : field.steps()) {
        const std::string_view key = step.key;
        const bool is_object = path.steps().empty() && (key == "object" || key == "rigid");
        path = path / step.key;
        if (step.index) path = path[is_object ? object_tables_[*step.index] : *step.index];
    }
    return path;
}

void ScenePlaces::report(const FieldPath& field, const std::string& value, const std::string& problem) const {
    const std::string file = scene_.file.string();
    if (field.steps().empty()) throw InvalidInput({file, 0, {}, {}, problem});
    const FieldPath path = path_in_file(field);
    const toml::node* section = find(document_, path.steps().front());
    const toml::node* node = &document_;
    for (const FieldStep& step : path.steps()) {
        const toml::node* next = find(*node, step);
        if (next == nullptr) break;
        node = next;
    }
    const toml::table* table = section != nullptr ? section->as_table() : nullptr;
    const std::string name = table != nullptr ? (*table)["name"].value_or(std::string()) : std::string();
    InputProblem found = problem_at(*node, file, describe(path, name), problem);
    // What a copy has is not always what its original's table says.
    const bool is_copy = table != nullptr && table->contains("copies");
    if (is_copy && found.value != value) found.problem = value + " " + problem;
    throw InvalidInput(found);
}

}  // namespace gelatin
