#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/gltf_document.h"
#include "mesh/ignored.h"
#include "mesh/surface_polygons.h"

namespace gelatin {

/// The materials of a glTF file: base colours, which are linear, and their images.
class GltfMaterials {
public:
    /// Keeps a reference. @throws InvalidInput
    explicit GltfMaterials(GltfDocument& document);

    /// Of a primitive, for `polygon_materials`; SurfaceLook::kNone.
    std::uint32_t index_of(const GltfDocument::Json& primitive, const std::string& what) const;
    /// Which set of texture coordinates a material's image needs.
    std::size_t uv_set(std::uint32_t material) const;

    /// Gives the polygons the materials that they use, and the indices of these.
    void finish(SurfacePolygons& polygons, Notes& notes, Ignored& ignored);

private:
    struct Look {
        SurfaceMaterial material = {};
        std::size_t uv_set = 0;
        std::optional<std::size_t> image = {};  // its index
        bool lacks_image = false, has_transform = false;
    };
    void read(const GltfDocument::Json& from, const char* color_key, const char* texture_key,
              const std::string& what, Look& look) const;
    void load(Look& look, Notes& notes);

    GltfDocument& document_;
    std::vector<Look> looks_;
};

}  // namespace gelatin
