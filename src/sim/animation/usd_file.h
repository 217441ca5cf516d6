#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/animation/animated_surface.h"
#include "sim/animation/animation_file.h"
#include "sim/animation/frame_store.h"

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
    void give_plain_objects_materials();
    std::string head() const;
    void append_object(std::size_t object, const std::string& name, const std::vector<std::string>& materials,
                       FileWriter& out) const;
    void append_tets(std::size_t object, const std::string& name, FileWriter& out) const;
    /// Of the vertices of an object, or, if it is null, of all that the range has.
    void append_samples(const char* name, const FrameStore& store, const Range& range,
                        const AnimatedSurface::Object* object, FileWriter& out) const;
    std::string image_name(std::size_t material, const std::string& name) const;  ///< of the file beside this
    std::string materials_text(const std::vector<std::string>& names) const;

    std::filesystem::path file_;
    const Model& model_;
    AnimationSettings settings_;
    AnimatedSurface surface_;
    std::vector<int> frames_;
    FrameStore points_, velocities_;  // x, y, z of each point [m], [m/s]
    FrameStore nodes_;                // x, y, z of each node [m]
};

}  // namespace gelatin
