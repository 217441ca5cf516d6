#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/skin.h"

namespace gelatin {

/// What OBJ files say of how a skin looks: the same in every frame.
class ObjLook {
public:
    struct Image {
        std::string name;  ///< of a file
        std::shared_ptr<const std::string> bytes;
    };

    explicit ObjLook(const SurfaceLook& look);

    /// The text of the .mtl file, and the images that it names. Empty where the skin has no materials.
    const std::string& library() const { return library_; }
    const std::vector<Image>& images() const { return images_; }

    /// The lines of some faces: texture coordinates, materials, vertices. Call it in the order of the faces:
    /// coordinates are counted through the file.
    /// @param first of the faces, in the look
    std::string face_lines(std::span<const Face> faces, std::uint32_t first);

private:
    std::string name_of(std::uint32_t material) const;

    const SurfaceLook& look_;  // as long-lived as this
    std::vector<std::string> names_;
    std::string library_;
    std::vector<Image> images_;
    std::uint32_t uv_count_ = 0;
};

}  // namespace gelatin
