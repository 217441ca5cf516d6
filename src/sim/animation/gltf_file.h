#pragma once

#include <filesystem>
#include <vector>

#include "sim/animation/animated_surface.h"
#include "sim/animation/animation_file.h"

namespace gelatin {

/// One binary glTF 2.0 file: a mesh for each object, whose frames are morph targets that one animation
/// shows in turn. Materials and textures are in it. Objects that do not move have no targets.
class GltfFile : public AnimationFile {
public:
    GltfFile(std::filesystem::path file, const Model& model, AnimationSettings settings);

    void write(const HostFrame& frame) override;
    void finish() override;

private:
    std::filesystem::path file_;
    AnimationSettings settings_;
    AnimatedSurface surface_;
    std::vector<double> times_;               // of frames [s]
    std::vector<std::vector<float>> points_;  // x, y, z of each point [m], by frame
};

}  // namespace gelatin
