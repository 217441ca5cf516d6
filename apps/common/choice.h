#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gelatin/error.h"
#include "model/scene/names.h"

namespace gelatin {

/// The value that `name` stands for. @throws InvalidInput naming the option, what is allowed and the nearest
/// choice.
template <class Meaning>
Meaning choose(const std::string& option, const std::string& name,
               const std::vector<std::pair<std::string, Meaning>>& choices) {
    std::vector<std::string> names;
    for (const auto& [choice, meaning] : choices) {
        if (choice == name) return meaning;
        names.push_back(choice);
    }
    throw InvalidInput({{}, 0, option, name, "must be " + join_names(names, "or") + suggestion(name, names)});
}

}  // namespace gelatin
