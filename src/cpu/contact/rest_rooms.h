#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// How far nodes may be from an affine image of their body's shape at the start, before parts of the body
/// could press each other that have no node in common. Of bodies that hardly bend that shows with a look at
/// each node that they do not meet themselves.
template <class Real>
class RestRooms {
public:
    RestRooms(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// Whether all surface nodes of a body are in their rooms, so that all gaps are more than half of what
    /// they were at the start. May be called for several bodies at once.
    bool hold(std::uint32_t object, std::span<const Vec4<Real>> positions) const;

private:
    struct Shape {
        Range places;  // of surface nodes
        // Of their places at the start, which are from their middle [1/m^2]; 0: too flat.
        glm::dmat3 inverse_moment{0.0};
    };
    void find_distances(const ContactSurface& surface);

    std::shared_ptr<const Model> model_;
    std::vector<Shape> shapes_;  // by object
    // By surface node [m]: at the start, from the middle; how far what it is in is from what else is near:
    // two features are at least the mean of their nodes' distances apart.
    std::vector<Vec3<Real>> offsets_;
    std::vector<float> apart_;
};

}  // namespace gelatin::cpu
