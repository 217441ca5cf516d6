#include "cpu/descent/rest_watch.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Nodes that have kept to their places for so long rest [s]. Whatever swings that slowly moves farther.
constexpr double kRestTime = 0.5;
// A place, as a part of the thickness of the body's surface: a 2000th of its median edge.
constexpr double kPlace = 0.01;

}  // namespace

template <class Real>
RestWatch<Real>::RestWatch(std::shared_ptr<const Model> model, std::span<const double> thicknesses)
    : model_(std::move(model)), thicknesses_(thicknesses.begin(), thicknesses.end()) {}

template <class Real>
void RestWatch<Real>::archive(Archive& archive) {
    archive.list(places_);
    archive.value(time_);
    archive.list(load_factors_);
    if (!places_.empty() && places_.size() != model_->node_count()) archive.fail();
}

template <class Real>
bool RestWatch<Real>::rests(double step, std::span<const Vec4<Real>> positions,
                            std::span<const float> load_factors, bool is_pulled,
                            std::span<const Vec3<Real>> held_at) {
    const bool is_new = places_.empty();
    const bool is_driven = is_new || is_pulled ||
                           load_factors_ != std::vector<float>(load_factors.begin(), load_factors.end()) ||
                           moves_handle(positions, held_at);
    if (!is_driven && time_ >= kRestTime) return true;
    if (is_driven || time_ == 0.0 || leaves_place(positions)) {
        time_ = 0.0;
        places_.assign(positions.begin(), positions.end());
        load_factors_.assign(load_factors.begin(), load_factors.end());
    }
    time_ += step;
    return false;
}

// Ahead of where the last step left what it holds, or lets go of it.
template <class Real>
bool RestWatch<Real>::moves_handle(std::span<const Vec4<Real>> positions,
                                   std::span<const Vec3<Real>> held_at) const {
    const auto most = static_cast<Real>(
        kPlace * *std::min_element(thicknesses_.begin(),
                                   thicknesses_.begin() + static_cast<std::ptrdiff_t>(model_->body_count())));
    for (std::size_t h = 0; h < held_at.size(); ++h) {
        const std::uint32_t n = model_->handle_nodes[h].node;
        if (positions[n].w != places_[n].w) return true;
        const Vec3<Real> moved = Vec3<Real>(positions[n]) - held_at[h];
        if (positions[n].w == Real(0) && glm::dot(moved, moved) > most * most) return true;
    }
    return false;
}

template <class Real>
bool RestWatch<Real>::leaves_place(std::span<const Vec4<Real>> positions) const {
    std::atomic<bool> leaves = false;
    for_each_index(0, model_->body_count(), 1, [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        const Real most = static_cast<Real>(kPlace * thicknesses_[o]);
        for (std::uint32_t n = nodes.first; n < nodes.end() && !leaves; ++n) {
            const Vec3<Real> way = Vec3<Real>(positions[n]) - Vec3<Real>(places_[n]);
            if (glm::dot(way, way) > most * most) leaves = true;
        }
    });
    return leaves;
}

template class RestWatch<float>;
template class RestWatch<double>;

}  // namespace gelatin::cpu
