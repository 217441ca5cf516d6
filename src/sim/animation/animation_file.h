#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "gelatin/simulator.h"
#include "model/model.h"

namespace gelatin {

/// All frames of what is drawn in one file, which other programs play: glTF (.glb), USD (.usda), point caches
/// (.pc2, .mdd) for an OBJ file of the first frame. Frames wait on disk, so that memory does not grow with
/// their number; nothing is left of them if this process is killed.
class AnimationFile {
public:
    virtual ~AnimationFile() = default;
    /// Frames in order; all have the nodes of the model. @throws SystemError
    virtual void write(const HostFrame& frame) = 0;
    /// Writes the file, completely or not at all. @pre it has a frame @throws SystemError; InvalidInput if
    /// the format cannot have so much
    virtual void finish() = 0;
};

struct AnimationSettings {
    double frame_rate = 60.0;       ///< of the simulation [1/s]
    std::vector<glm::vec3> colors;  ///< of objects without materials, linear RGB, shape [Model::objects]
    Axis up = Axis::y;              ///< of the scene
    std::vector<AttachmentDescription> attachments = {};  ///< of the scene
};

/// The endings of files for make_animation_file, with their points.
const std::vector<std::string>& animation_endings();

/// @param model must outlive it
/// @throws InvalidInput for another ending
std::unique_ptr<AnimationFile> make_animation_file(const std::filesystem::path& file, const Model& model,
                                                   const AnimationSettings& settings);

}  // namespace gelatin
