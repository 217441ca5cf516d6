#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "model/model.h"
#include "model/solver.h"
#include "sim/value_range.h"

namespace gelatin {

/// What contacts exert on the nodes of bodies, for a renderer: from a solver that finds it, uploaded once a
/// picture. A solver that does not find it is reported once.
class ContactOverlay {
public:
    explicit ContactOverlay(std::shared_ptr<const Model> model);

    /// Reads the solver's present forces, for the functions below.
    void read(Solver& solver);

    /// Arrows of all forces; empty: there are none.
    std::optional<ArrowView> arrows(const ForceArrows& shown);
    ColorMapView pressures(const ColorMap& map);

private:
    std::shared_ptr<const Model> model_;
    float body_size_;  // mean [m]
    bool is_reported_ = false;
    std::vector<glm::vec4> forces_;       // [N]; shape [nodes]
    std::vector<float> pressures_;        // [Pa]; shape [nodes]
    std::vector<std::uint32_t> pressed_;  // nodes
    CalmRange force_range_, pressure_range_;
    gl::Buffer<glm::vec4> uploaded_forces_;
    gl::Buffer<std::uint32_t> uploaded_nodes_;
    gl::Buffer<float> node_values_, tet_values_;
};

/// The area of the surface that belongs to each node [m^2]: a third of its faces'; 0 inside. Shape [nodes].
std::vector<float> surface_areas(const Model& model, std::span<const glm::vec4> positions);

}  // namespace gelatin
