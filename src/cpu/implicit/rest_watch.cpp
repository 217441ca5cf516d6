#include "cpu/implicit/rest_watch.h"

#include <algorithm>
#include <utility>

#include "cpu/contact/tuning.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
RestWatch<Real>::RestWatch(std::shared_ptr<const Model> model, std::span<const double> thicknesses)
    : model_(std::move(model)),
      thicknesses_(thicknesses.begin(), thicknesses.end()),
      times_(model_->body_count()),
      asleep_(model_->body_count()),
      islands_(model_->body_count()) {}

template <class Real>
void RestWatch<Real>::restart() {
    places_.clear();
    std::fill(times_.begin(), times_.end(), 0.0);
    std::fill(asleep_.begin(), asleep_.end(), std::uint8_t(0));
}

template <class Real>
void RestWatch<Real>::archive(Archive& archive) {
    archive.list(places_);
    archive.array(times_);
    archive.array(asleep_);
    archive.array(islands_);
    archive.list(load_factors_);
    if (!places_.empty() && places_.size() != model_->node_count()) archive.fail();
}

template <class Real>
bool RestWatch<Real>::begin(const Drive& drive) {
    if (places_.empty()) {
        places_.assign(drive.positions.begin(), drive.positions.end());
        load_factors_.assign(drive.load_factors.begin(), drive.load_factors.end());
    }
    if (!std::equal(load_factors_.begin(), load_factors_.end(), drive.load_factors.begin(),
                    drive.load_factors.end())) {
        load_factors_.assign(drive.load_factors.begin(), drive.load_factors.end());
        for (std::uint32_t o = 0; o < times_.size(); ++o) wake(o);
    }
    if (drive.pulls != nullptr)
        for (const std::uint32_t n : drive.pulls->nodes())
            if (model_->node_objects[n] < times_.size()) wake(model_->node_objects[n]);
    for (const std::uint32_t o : drive.moved) wake(o);
    const bool moves_colliders = wake_moved(drive);
    for_each_index(0, times_.size(), 1, [&](std::size_t o) {
        if (asleep_[o] != 0) return;
        const Range& nodes = model_->objects[o].nodes;
        if (times_[o] == 0.0 ||
            leaves_place(nodes, static_cast<Real>(tuning::kSleepPlace * thicknesses_[o]), drive.positions)) {
            times_[o] = 0.0;
            std::copy_n(drive.positions.begin() + nodes.first, nodes.count, places_.begin() + nodes.first);
        }
        times_[o] += drive.step;
    });
    return !moves_colliders &&
           std::all_of(asleep_.begin(), asleep_.end(), [](auto sleeps) { return sleeps != 0; });
}

// Whose handle is ahead of where the last step left what it holds, or lets go of it.
// @return whether this is so of a collider
template <class Real>
bool RestWatch<Real>::wake_moved(const Drive& drive) {
    const auto most = static_cast<Real>(
        tuning::kSleepPlace *
        *std::min_element(thicknesses_.begin(),
                          thicknesses_.begin() + static_cast<std::ptrdiff_t>(times_.size())));
    bool moves_colliders = false;
    for (std::size_t h = 0; h < drive.held_at.size(); ++h) {
        const std::uint32_t n = model_->handle_nodes[h].node;
        const Vec3<Real> moved = Vec3<Real>(drive.positions[n]) - drive.held_at[h];
        const bool is_released = drive.positions[n].w != places_[n].w;
        if (!is_released && !(drive.positions[n].w == Real(0) && glm::dot(moved, moved) > most * most))
            continue;
        if (model_->node_objects[n] < times_.size()) {
            wake(model_->node_objects[n]);
        } else {
            moves_colliders = true;
        }
    }
    return moves_colliders;
}

template <class Real>
bool RestWatch<Real>::leaves_place(const Range& nodes, Real most,
                                   std::span<const Vec4<Real>> positions) const {
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const Vec3<Real> way = Vec3<Real>(positions[n]) - Vec3<Real>(places_[n]);
        if (glm::dot(way, way) > most * most) return true;
    }
    return false;
}

template <class Real>
void RestWatch<Real>::end(std::span<const std::uint32_t> islands) {
    std::vector<std::uint8_t> are_restless(asleep_.size());
    for (std::size_t o = 0; o < asleep_.size(); ++o)
        if (times_[o] < tuning::kSleepTime) are_restless[islands[o]] = 1;
    for (std::size_t o = 0; o < asleep_.size(); ++o) {
        if (asleep_[o] != 0 || are_restless[islands[o]] != 0) continue;
        asleep_[o] = 1;
        islands_[o] = islands[o];
    }
}

template <class Real>
void RestWatch<Real>::wake(std::uint32_t body) {
    times_[body] = 0.0;
    if (asleep_[body] == 0) return;
    for (std::size_t o = 0; o < asleep_.size(); ++o) {
        if (asleep_[o] == 0 || islands_[o] != islands_[body]) continue;
        asleep_[o] = 0;
        times_[o] = 0.0;
    }
}

template <class Real>
void RestWatch<Real>::wake(std::uint32_t body, Nodes<Real>& nodes) {
    release(nodes);
    wake(body);
    hold(nodes);
}

template <class Real>
template <class Visit>
void RestWatch<Real>::for_nodes_asleep(const Visit& visit) const {
    for_each_index(0, asleep_.size(), 1, [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; asleep_[o] != 0 && n < nodes.end(); ++n) visit(n);
    });
}

template <class Real>
void RestWatch<Real>::hold(Nodes<Real>& nodes) const {
    for_nodes_asleep([&](std::uint32_t n) {
        nodes.positions[n].w = Real(0);
        nodes.velocities[n] = Vec4<Real>(Vec3<Real>(0), nodes.velocities[n].w);
    });
}

template <class Real>
void RestWatch<Real>::release(Nodes<Real>& nodes) const {
    for_nodes_asleep([&](std::uint32_t n) { nodes.positions[n].w = places_[n].w; });
}

template class RestWatch<float>;
template class RestWatch<double>;

}  // namespace gelatin::cpu
