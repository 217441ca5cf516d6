#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/scene/field_path.h"

namespace gelatin {

/// Finds the fields of a scene in the document that it was read from. Refers to both.
class ScenePlaces {
public:
    /// @param object_tables of each object, the index of the [[object]] or [[rigid]] table that it or its
    ///   original is in
    ScenePlaces(const toml::table& document, const Scene& scene, std::vector<std::size_t> object_tables)
        : document_(document), scene_(scene), object_tables_(std::move(object_tables)) {}

    /// @throws InvalidInput with the file and line of the field, or of the table where it should be
    [[noreturn]] void report(const FieldPath& field, const std::string& value,
                             const std::string& problem) const;

private:
    FieldPath path_in_file(const FieldPath& field) const;

    const toml::table& document_;
    const Scene& scene_;
    std::vector<std::size_t> object_tables_;
};

}  // namespace gelatin
