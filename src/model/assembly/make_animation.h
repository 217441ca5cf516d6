#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gelatin/error.h"
#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "model/drive/handle_animation.h"

namespace gelatin {

/// How a description moves the vertices of a surface that was made of a shape. Places nothing yet: map and
/// offset are those of the shape.
/// @throws InvalidInput for files that cannot be read, or do not have the shape's vertices
HandleAnimation make_animation(const AnimationDescription& description, const Shape& shape,
                               const SurfaceMesh& surface);

/// An error in a file, said of the field of a scene that names the file.
InvalidInput said_of(const std::filesystem::path& scene, int line, const std::string& field,
                     const InvalidInput& error);

/// An error of a shape's mesh. Who makes meshes does not know which object wants a file that is not there, or
/// a text that a font does not have: that is said of `field`.
/// @param field of the scene, of the shape
InvalidInput said_of_shape(const std::filesystem::path& scene, int line, const std::string& field,
                           const Shape& shape, const InvalidInput& error);

/// The bones of a skeleton where an object is placed.
class BodySkeleton {
public:
    /// @throws InvalidInput as above
    /// @param object where the skeleton is placed
    BodySkeleton(const SkeletonDescription& skeleton, const ObjectDescription& object, Axis scene_up);

    struct Held {
        std::vector<std::uint32_t> nodes;  ///< ascending
        HandleAnimation animation;         ///< of these; arms are from the origin of the scene
    };
    /// The nodes that are near a bone. Each is held by the nearest. @param positions of all [m]
    Held hold(const std::vector<glm::dvec3>& positions) const;

private:
    // From the place of a joint to that of the next one, or of itself where there is none.
    struct Bone {
        std::uint32_t joint, next;
        glm::dvec3 from, to;
    };
    void find_bones();

    VertexMotion motion_;  // without vertices
    std::vector<Bone> bones_;
    double radius_;  // in the coordinates of the file
    glm::dmat3 map_;
    glm::dvec3 offset_;
};

}  // namespace gelatin
