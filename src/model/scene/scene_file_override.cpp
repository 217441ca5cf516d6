#include "model/scene/scene_file_override.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>
#include <vector>

#include "model/scene/scene_file_reader.h"

namespace gelatin {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& problem) {
    throw InvalidInput({std::string(kOverridePrefix) + text, 0, {}, {}, problem});
}

bool is_bare_word(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        constexpr std::string_view kPunctuation = "_-+./: ";
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               kPunctuation.find(c) != std::string_view::npos;
    });
}

// The override as a TOML document of its own: a chain of tables with the value at its end.
toml::table parse_override(const std::string& text) {
    const std::string source = std::string(kOverridePrefix) + text;
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        fail(text, "must be key=value, as in simulation.frames=100");
    if (text.find('\n') != std::string::npos) fail(text.substr(0, text.find('\n')), "must be one line");
    const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
    try {
        return toml::parse(text, source);
    } catch (const toml::parse_error& error) {
        if (!is_bare_word(value)) fail(text, describe(error));
    }
    try {
        return toml::parse(fmt::format("{} = \"{}\"", key, value), source);
    } catch (const toml::parse_error& error) {
        fail(text, describe(error));
    }
}

// The element called `key`, by name or index.
toml::node& element(toml::array& array, const std::string& path, const std::string& key,
                    const std::string& text) {
    std::vector<std::string> names;
    for (toml::node& candidate : array) {
        const toml::table* table = candidate.as_table();
        const std::string name = table != nullptr ? (*table)["name"].value_or(std::string()) : std::string();
        if (name == key) return candidate;
        if (!name.empty()) names.push_back(name);
    }
    std::size_t index = array.size();
    const auto [end, status] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (status == std::errc() && end == key.data() + key.size() && index < array.size()) return array[index];
    fail(text, fmt::format("no {} is called \"{}\"{}; there are {}, numbered from 0", path, key,
                           suggestion(key, names), array.size()));
}

// Moves what `from` holds to where it belongs below `into`. Moving keeps a node's source, copying would lose
// it.
void merge(toml::table& into, toml::table& from, const std::string& path, const std::string& text) {
    for (auto&& [toml_key, value] : from) {
        const toml::key& key = toml_key;  // a name that lambdas may capture
        const std::string name(key.str());
        const std::string place = path.empty() ? name : path + "." + name;
        toml::node* target = into.get(name);
        toml::table* step = value.as_table();
        const bool is_last = step == nullptr || step->is_inline() || target == nullptr;
        if (is_last) {
            value.visit([&](auto& node) { into.insert_or_assign(key, std::move(node)); });
            continue;
        }
        if (toml::array* array = target->as_array()) {
            for (auto&& [choice, rest] : *step) {
                const std::string chosen(choice.str());
                target = &element(*array, place, chosen, text);
                toml::table* deeper = rest.as_table();
                if (deeper == nullptr || deeper->is_inline() || !target->is_table()) {
                    fail(text, fmt::format("must name a key of {}.{}", place, chosen));
                }
                merge(*target->as_table(), *deeper, place + "." + chosen, text);
            }
        } else if (target->is_table()) {
            merge(*target->as_table(), *step, place, text);
        } else {
            fail(text, fmt::format("{} is a value, not a table", place));
        }
    }
}

}  // namespace

void apply_override(toml::table& scene, const std::string& text) {
    toml::table change = parse_override(text);
    merge(scene, change, "", text);
}

}  // namespace gelatin
