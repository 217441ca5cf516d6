#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/animation/animated_surface.h"
#include "sim/animation/animation_file.h"

namespace gelatin {

/// A text file of Universal Scene Description: a Mesh for each object with time samples of its points and
/// velocities; materials with their images in files beside it; for bodies also their tets, a TetMesh of
/// purpose "guide". Time codes are frames.
class UsdFile : public AnimationFile {
public:
    UsdFile(std::filesystem::path file, const Model& model, AnimationSettings settings);

    void write(const HostFrame& frame) override;
    void finish() override;

private:
    std::string object_text(std::size_t object, const std::string& name,
                            const std::vector<std::string>& materials) const;
    std::string tets_text(std::size_t object) const;
    std::string image_name(std::size_t material, const std::string& name) const;  ///< of the file beside this
    std::string materials_text(const std::vector<std::string>& names) const;

    std::filesystem::path file_;
    const Model& model_;
    AnimationSettings settings_;
    AnimatedSurface surface_;
    std::vector<int> frames_;
    // By object, with a line for each frame:
    std::vector<std::string> points_, velocities_, nodes_;
};

}  // namespace gelatin
