#pragma once

#include <optional>
#include <vector>

#include "gelatin/simulator.h"
#include "model/range.h"
#include "picture/line_of_sight.h"
#include "render/camera.h"

namespace gelatin {

/// What a picture or a film shows of a scene: bodies where they are in its frames, and what is under them.
/// From that it chooses the camera (docs/decisions/0057-camera-and-up-axis.md).
class Shown {
public:
    /// The present frame. @param simulator must outlive this
    explicit Shown(const Simulator& simulator);

    /// All frames of what plays a recording without a camera of its own, else the present one.
    static Shown of_all(Simulator& simulator);

    /// Also the present frame.
    void add();

    /// The bodies, down to what is under them [m], in the scene's coordinates.
    render::Bounds bodies() const;

    /// The scene's own camera, or one that has all bodies in the picture, with what is under and beside them,
    /// from a side from which colliders do not hide them.
    /// @param aspect width divided by height of the picture
    render::Camera camera(float aspect) const;

private:
    struct Plane {
        glm::vec3 normal;  // upwards, not level
        float offset;
    };
    /// A collider that has an end.
    struct FiniteCollider {
        Range nodes;              // of a surface; none: it rests
        render::Bounds now, all;  // at present, in all frames [m]
    };

    void follow(std::vector<render::Bounds> bodies);
    std::optional<float> ground_under(const render::Bounds& body) const;
    render::Bounds with_colliders() const;
    LineOfSight sight_of(const std::vector<glm::vec3>& nodes) const;

    // All with y up.
    const Simulator& simulator_;
    std::vector<Plane> planes_;
    std::vector<FiniteCollider> colliders_;
    std::vector<glm::vec3> first_, last_;   // nodes of the first and of the last frame [m]
    float size_ = 0.0f;                     // of the largest body of the first frame [m]
    std::optional<render::Bounds> home_;    // the bodies of the first frame, with what is under them
    std::optional<render::Bounds> bodies_;  // of all frames
};

}  // namespace gelatin
