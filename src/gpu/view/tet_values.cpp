#include "gpu/view/tet_values.h"

#include <numeric>

#include "model/elasticity/node_tets.h"

namespace gelatin::gpu {
namespace {

gl::Defines defines(Quantity quantity) {
    switch (quantity) {
        case Quantity::stretch:
            return {"STRETCH"};
        case Quantity::stress:
            return {"STRESS"};
        case Quantity::speed:
        case Quantity::pressure:  // not of tets
            break;
    }
    return {"SPEED"};
}

std::vector<glm::vec2> materials_of(const Model& model) {
    std::vector<glm::vec2> materials;
    for (std::size_t t = 0; t < model.tets.size(); ++t)
        materials.emplace_back(model.tet_rests[t].volume, model.shear_moduli[t]);
    return materials;
}

}  // namespace

TetValues::TetValues(const Model& model, Quantity quantity)
    : quantity_(quantity),
      tet_program_(gl::Program::compute("sim/view/find_tet_values.comp", defines(quantity))),
      node_program_(gl::Program::compute("sim/view/average_tet_values.comp", defines(quantity))),
      tets_(model.tets, gl::TexelFormat::rgba32ui),
      rest_positions_(model.positions, gl::TexelFormat::rgba32f),
      materials_(materials_of(model), gl::TexelFormat::rg32f),
      tet_values_(model.tets.size()),
      node_values_(model.positions.size()),
      tet_value_texels_(tet_values_, gl::TexelFormat::r32f),
      histogram_(kBins) {
    std::vector<std::uint32_t> rows(model.node_count());
    std::iota(rows.begin(), rows.end(), 0u);
    const NodeTetSlices slices = pack_node_tets(rows, make_node_tets(model.node_count(), model.tets));
    node_tets_ = {slices.entries, gl::TexelFormat::r32ui};
    slice_starts_ = {slices.slice_starts, gl::TexelFormat::r32ui};

    tet_program_.bind("tets", tets_);
    tet_program_.bind("rest_positions", rest_positions_);
    tet_program_.bind("tet_materials", materials_);
    tet_program_.bind("TetValues", tet_values_);
    tet_program_.bind("Histogram", histogram_);
    node_program_.bind("tet_values", tet_value_texels_);
    node_program_.bind("node_tets", node_tets_);
    node_program_.bind("slice_starts", slice_starts_);
    node_program_.bind("tet_materials", materials_);
    node_program_.bind("NodeValues", node_values_);
    if (quantity != Quantity::speed) return;
    node_program_.bind("rest_positions", rest_positions_);
    node_program_.bind("Histogram", histogram_);
}

void TetValues::run(const gl::BufferTexture& positions, const gl::BufferTexture& velocities) {
    histogram_.fill(0);
    tet_program_.bind("positions", positions);
    tet_program_.bind("velocities", velocities);
    tet_program_.set("tet_count", static_cast<std::uint32_t>(tet_values_.size()));
    tet_program_.set("least", least());
    tet_program_.dispatch(tet_values_.size());
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);

    node_program_.bind("velocities", velocities);
    node_program_.set("node_count", static_cast<std::uint32_t>(node_values_.size()));
    node_program_.dispatch(node_values_.size());
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::buffer_update | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
