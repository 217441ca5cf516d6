#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/surface_polygons.h"

namespace gelatin {

class TextScanner;

/// The materials that an OBJ file names, from its MTL files.
class ObjMaterials {
public:
    /// Keeps references.
    ObjMaterials(const std::filesystem::path& obj_file, Notes& notes) : obj_file_(obj_file), notes_(notes) {}

    /// Reads what an `mtllib` statement names: one or several files.
    void read_libraries(std::string_view names);
    /// The number of the material that a `usemtl` statement names, for `polygon_materials`.
    std::uint32_t number_of(std::string_view name);

    /// Replaces these numbers, which faces have, by indices into the materials that faces use. Leaves a file
    /// without MTL files no materials.
    void finish(SurfacePolygons& polygons);

private:
    struct Definition {
        SurfaceMaterial material;
        std::filesystem::path folder;  // of its MTL file
    };
    void read_library(const std::string& name);
    void define(TextScanner& scanner, const std::filesystem::path& folder);
    std::string read_image(const Definition& definition) const;

    const std::filesystem::path& obj_file_;
    Notes& notes_;
    std::map<std::string, Definition> definitions_;
    std::vector<std::string> used_;  // names, by number
    std::map<std::string, std::uint32_t> numbers_;
    Definition* current_ = nullptr;  // that the statements of an MTL file are about
    bool has_library_ = false, lacks_library_ = false;
};

}  // namespace gelatin
