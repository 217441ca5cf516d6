#include "sim/color_source.h"

#include <algorithm>
#include <cstring>

namespace gelatin {
namespace {

// Relative to the smallest value; smaller differences are rounding, or irrelevant.
float least_range(const Model& model, Quantity quantity) {
    constexpr float kStrain = 1e-3f, kSpeed = 1e-2f;  // [1], [m/s]
    switch (quantity) {
        case Quantity::stretch:
            return kStrain;
        case Quantity::stress: {
            const auto stiffest = std::max_element(model.shear_moduli.begin(), model.shear_moduli.end());
            return kStrain * (stiffest == model.shear_moduli.end() ? 1.0f : *stiffest);
        }
        case Quantity::speed:
        case Quantity::pressure:  // ContactOverlay's
            break;
    }
    return kSpeed;
}

}  // namespace

ColorSource::ColorSource(const Model& model, Quantity quantity)
    : values_(model, quantity), range_(least_range(model, quantity)) {}

ColorMapView ColorSource::update(const ColorMap& map, const gl::BufferTexture& positions,
                                 const gl::BufferTexture& velocities) {
    values_.run(positions, velocities);
    if (!map.full) follow_values();
    return {.quantity = quantity(),
            .node_values = values_.node_values().id(),
            .tet_values = values_.tet_values().id(),
            .low = values_.least(),
            .full = map.full.value_or(values_.least() + end_)};
}

void ColorSource::follow_values() {
    readback_.begin(values_.histogram().id(), gpu::TetValues::kBins * sizeof(std::uint32_t));
    const bool is_first = end_ == 0.0f;
    if (readback_.pending() < 2 && !is_first) return;
    const std::vector<std::byte> bytes = readback_.take();
    std::vector<std::uint32_t> histogram(gpu::TetValues::kBins);
    std::memcpy(histogram.data(), bytes.data(), bytes.size());
    end_ = range_.follow(high_value(histogram));
}

}  // namespace gelatin
