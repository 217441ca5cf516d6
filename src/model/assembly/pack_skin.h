#pragma once

#include <cstdint>
#include <span>

#include "model/assembly/object_mesh.h"
#include "model/model.h"

namespace gelatin {

/// Appends a body's own surface to model.skin; with its materials, unless the body has a colour of its own.
/// @pre the model's last object is the body
/// @param scale of the body, relative to the shape @param new_index of each node of its tets, from the
/// object's first
void append_skin(const ShapeSkin& shape, double scale, std::span<const std::uint32_t> new_index,
                 Model& model);

/// Appends the boundary of the model's object `o`, as it is: nodes of faces in ascending order, and the
/// faces.
void append_hull(const Model& model, std::size_t o, Skin& skin);

/// Completes a skin that has all its points and faces: the surface to draw, and the look of faces without
/// one.
void finish_skin(const Model& model, Skin& skin);

/// The skin of a model that has none: all that it draws and exports is hulls. Without a surface to draw.
Skin make_hulls(const Model& model);

}  // namespace gelatin
