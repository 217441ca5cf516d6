#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gelatin {

/// What a file says of how some of its faces look.
struct SurfaceMaterial {
    std::string name;
    glm::vec3 color{1.0f};   ///< linear RGB, by which the image is multiplied
    std::string image_name;  ///< the image's file, or what messages call it; empty: no image
    std::shared_ptr<const std::string> image = {};  ///< bytes of a PNG or JPEG file; null: no image
};

/// How the faces of a surface look; empty: all alike.
struct SurfaceLook {
    static constexpr std::uint32_t kNone = ~0u;

    std::vector<SurfaceMaterial> materials;
    std::vector<std::uint32_t> face_materials;         ///< indices into materials, or kNone; shape [faces]
    std::vector<std::array<glm::vec2, 3>> corner_uvs;  ///< (0, 0): the image's lower left; shape [faces]

    bool is_empty() const { return materials.empty(); }
};

}  // namespace gelatin
