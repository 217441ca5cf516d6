#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "sim/animation/animated_surface.h"
#include "sim/animation/animation_file.h"
#include "sim/animation/frame_store.h"

namespace gelatin {

class GltfContent;

/// One binary glTF 2.0 file: a mesh for each object, whose frames are morph targets that one animation
/// shows in turn. Materials and textures are in it. Objects that do not move have no targets.
class GltfFile : public AnimationFile {
public:
    GltfFile(std::filesystem::path file, const Model& model, AnimationSettings settings);

    void write(const HostFrame& frame) override;
    void finish() override;

private:
    std::vector<float> points(const AnimatedSurface::Object& object, std::size_t frame) const;
    bool moves(const AnimatedSurface::Object& object) const;
    std::optional<int> add_mesh(std::size_t object, bool moves, GltfContent& content) const;
    void add_animation(const std::vector<int>& moving, GltfContent& content) const;

    std::filesystem::path file_;
    AnimationSettings settings_;
    AnimatedSurface surface_;
    std::vector<double> times_;  // of frames [s]
    FrameStore frames_;          // x, y, z of each point [m]
};

}  // namespace gelatin
