#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The values that colours show of tets and nodes: shaders/sim/view/find_tet_values.comp,
/// average_tet_values.comp. For both backends, since only pictures need it.
class TetValues {
public:
    /// Values are counted by the upper bits of their difference from `least`, a float: one bin for each
    /// sixteenth.
    static constexpr int kBinShift = packing::kBinShift;
    static constexpr std::size_t kBins = packing::kBins;

    /// @pre quantity is not Quantity::pressure, which is that of contacts
    TetValues(const Model& model, Quantity quantity);

    Quantity quantity() const { return quantity_; }
    /// The smallest possible value: 1 for stretches, 0 for all others.
    float least() const { return quantity_ == Quantity::stretch ? 1.0f : 0.0f; }

    /// Computes all values. Ends with the barriers that drawing and copies need.
    /// @param positions xyz [m] @param velocities xyz [m/s], of all nodes as texels
    void run(const gl::BufferTexture& positions, const gl::BufferTexture& velocities);

    const gl::Buffer<float>& tet_values() const { return tet_values_; }
    const gl::Buffer<float>& node_values() const { return node_values_; }
    const gl::Buffer<std::uint32_t>& histogram() const { return histogram_; }

private:
    Quantity quantity_;
    gl::Program tet_program_, node_program_;
    gl::TexelTable<glm::uvec4> tets_;
    gl::TexelTable<glm::vec4> rest_positions_;
    gl::TexelTable<glm::vec2> materials_;
    gl::TexelTable<std::uint32_t> node_tets_, slice_starts_;
    gl::Buffer<float> tet_values_, node_values_;
    gl::BufferTexture tet_value_texels_;
    gl::Buffer<std::uint32_t> histogram_;
};

}  // namespace gelatin::gpu
