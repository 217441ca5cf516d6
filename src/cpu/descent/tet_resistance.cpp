#include "cpu/descent/tet_resistance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <type_traits>
#include <utility>

#include "cpu/elasticity/neo_hookean.h"
#include "cpu/elasticity/volume_ratios.h"
#include "model/elasticity/neo_hookean.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
template <class Real>
TetResistance<Real>::TetResistance(std::shared_ptr<const Model> model, const DescentRows& rows)
    : model_(std::move(model)),
      node_tets_(make_node_tets(model_->node_count(), model_->tets)),
      object_of_(objects_of_nodes(*model_)),
      ratios_(model_->tets.size()),
      is_near_flat_(model_->node_count()),
      any_flat_(rows.batches.size()) {
    if constexpr (std::is_same_v<Real, float>) {
        blocks_ = make_tet_blocks(*model_, rows.nodes, node_tets_, VolumesOf::springs);
        if (!model_->volume_term.is_empty()) volume_bounds_ = VolumeBounds(*model_, blocks_);
    } else if (!model_->volume_term.is_empty()) {
        node_pressures_.resize(model_->node_count());
        bounds_.resize(model_->tets.size());
    }
}

template <class Real>
Real TetResistance<Real>::inverse_six_volumes(std::uint32_t tet) const {
    return Real(1) / (Real(6) * static_cast<Real>(model_->tet_rests[tet].volume));
}

template <class Real>
Real TetResistance<Real>::ratio_of(std::uint32_t tet, const std::vector<Vec4<Real>>& positions) const {
    const glm::uvec4& corners = model_->tets[tet];
    const Vec3<Real> a(positions[corners.x]);
    const Vec3<Real> u = Vec3<Real>(positions[corners.y]) - a, v = Vec3<Real>(positions[corners.z]) - a,
                     w = Vec3<Real>(positions[corners.w]) - a;
    return glm::dot(volume_slope(u, v, inverse_six_volumes(tet)), w);
}

template <class Real>
bool TetResistance<Real>::is_tangled(const ModelObject& object,
                                     const std::vector<Vec4<Real>>& positions) const {
    if constexpr (std::is_same_v<Real, float>) {
        return !volumes_are_within(static_cast<float>(kLeastSound), static_cast<float>(kMostSound), *model_,
                                   object.tets, positions.data(), nullptr);
    }
    for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t) {
        const Real ratio = ratio_of(t, positions);
        if (!(ratio > static_cast<Real>(kLeastSound) && ratio < static_cast<Real>(kMostSound))) return true;
    }
    return false;
}

template <class Real>
void TetResistance<Real>::update(std::size_t index, const DescentRows& rows,
                                 const std::vector<Vec4<Real>>& positions) {
    const DescentBatch& batch = rows.batches[index];
    std::uint8_t& any_flat = any_flat_[index];
    if (any_flat != 0)
        std::fill_n(is_near_flat_.begin() + batch.nodes.first, batch.nodes.count, std::uint8_t(0));
    any_flat = 0;
    constexpr std::uint32_t kTetsATask = 512;
    tbb::parallel_for(0u, (batch.tets.count + kTetsATask - 1) / kTetsATask, [&](std::uint32_t task) {
        const std::uint32_t first = task * kTetsATask;
        update_range({batch.tets.first + first, std::min(kTetsATask, batch.tets.count - first)}, any_flat,
                     positions);
    });
    if (model_->volume_term.is_empty()) return;
    if constexpr (std::is_same_v<Real, float>) {
        volume_bounds_.update(*model_, blocks_, batch, rows.nodes, ratios_);
    } else {
        update_bounds(batch);
    }
}

template <class Real>
void TetResistance<Real>::update_bounds(const DescentBatch& batch) {
    const Model& model = *model_;
    const VolumeTerm& term = model.volume_term;
    for_each_index(batch.nodes, [&](std::uint32_t n) {
        Real volume(0);
        for (std::uint32_t e = node_tets_.starts[n]; e < node_tets_.starts[n + 1]; ++e) {
            const std::uint32_t t = node_tets_.entries[e] / 4;
            volume += Real(0.25) * ratios_[t] * static_cast<Real>(model.tet_rests[t].volume);
        }
        const auto rest = static_cast<Real>(term.nodes[n].x);
        node_pressures_[n] =
            rest > Real(0) ? volume_stress(volume / rest, static_cast<Real>(term.nodes[n].y)) : Real(0);
    });
    for_each_index(batch.tets, [&](std::uint32_t t) {
        const glm::uvec4& tet = model.tets[t];
        Real sum(0);
        for (int k = 0; k < 4; ++k) sum += node_pressures_[tet[k]];
        const auto volume = static_cast<Real>(model.tet_rests[t].volume),
                   modulus = static_cast<Real>(term.tets[t]);
        bounds_[t] = {volume * (Real(0.25) * sum - modulus * ratios_[t]), volume * modulus};
    });
}

template <class Real>
void TetResistance<Real>::update_range(const Range& tets, std::uint8_t& any_flat,
                                       const std::vector<Vec4<Real>>& positions) {
    const auto least = static_cast<Real>(kFlattest), most = std::numeric_limits<Real>::infinity();
    if constexpr (std::is_same_v<Real, float>) {
        if (volumes_are_within(least, most, *model_, tets, positions.data(), ratios_.data())) return;
    } else {
        for (std::uint32_t t = tets.first; t < tets.end(); ++t) ratios_[t] = ratio_of(t, positions);
    }
    for (std::uint32_t t = tets.first; t < tets.end(); ++t) {
        if (ratios_[t] >= least) continue;
        std::atomic_ref(any_flat).store(1, std::memory_order_relaxed);
        for (int k = 0; k < 4; ++k)
            std::atomic_ref(is_near_flat_[model_->tets[t][k]]).store(1, std::memory_order_relaxed);
    }
}

template <class Real>
VolumeBound<Real> TetResistance<Real>::volume_bound(std::uint32_t tet) const {
    return bounds_.empty() ? VolumeBound<Real>() : bounds_[tet];
}

template <class Real>
void TetResistance<Real>::add(std::uint32_t node, const std::vector<Vec4<Real>>& positions,
                              const StepStart<Real>& start, NodeTerms<Real>& terms) const {
    if (has_neo_hookean_tets(*model_, node)) return add_neo_hookean_tets(node, positions, start, terms);
    add_flat_tets(node, positions, terms);
    if (bounds_.empty()) return;
    for_each_tet(node, positions, [&](std::uint32_t tet, const Vec3<Real>& slope, Real ratio) {
        add_tet_volume(slope, ratio, volume_bound(tet), terms);
    });
}

template <class Real>
void TetResistance<Real>::add_flat_tets(std::uint32_t node, const std::vector<Vec4<Real>>& positions,
                                        NodeTerms<Real>& terms) const {
    if (is_near_flat_[node] == 0 || has_neo_hookean_tets(*model_, node)) return;
    for_each_tet(node, positions, [&](std::uint32_t tet, const Vec3<Real>& slope, Real ratio) {
        const TetRest& rest = model_->tet_rests[tet];
        add_flat_tet(slope, ratio, static_cast<Real>(rest.volume) * static_cast<Real>(rest.modulus), terms);
    });
}

// Calls work(tet, dJ/dx, J) for each tet of the node.
template <class Real>
template <class Work>
void TetResistance<Real>::for_each_tet(std::uint32_t node, const std::vector<Vec4<Real>>& positions,
                                       const Work& work) const {
    const Vec3<Real> position(positions[node]);
    for (std::uint32_t e = node_tets_.starts[node]; e < node_tets_.starts[node + 1]; ++e) {
        const std::uint32_t tet = node_tets_.entries[e] / 4, corner = node_tets_.entries[e] % 4;
        std::array<Vec3<Real>, 3> face;
        for (std::size_t k = 0; k < 3; ++k)
            face[k] = positions[model_->tets[tet][kOppositeCorners[corner][k]]];
        const Vec3<Real> slope = volume_slope(face[1] - face[0], face[2] - face[0], inverse_six_volumes(tet));
        work(tet, slope, glm::dot(position - face[0], slope));
    }
}

template <class Real>
void TetResistance<Real>::add_neo_hookean_tets(std::uint32_t node, const std::vector<Vec4<Real>>& positions,
                                               const StepStart<Real>& start, NodeTerms<Real>& terms) const {
    const NodeTets& corners = model_->neo_hookean_corners;
    const ModelObject& object = model_->objects[object_of_[node]];
    const std::uint32_t first_tet = object.tets.first - object.neo_hookean_tets.first;
    for (std::uint32_t e = corners.starts[node]; e < corners.starts[node + 1]; ++e) {
        const NeoHookeanTet& tet = model_->neo_hookean_tets[corners.entries[e] / 4];
        const TetModuli<Real> moduli = tet_moduli<Real>(tet);
        const Vec3<Real> g = shape_gradient<Real>(tet, corners.entries[e] % 4);
        const Mat3<Real> f = gradient_of(tet, at_corners(tet, positions.data()));
        const TetAtCorner<Real> at_corner = tet_at_corner<Real>(g, f);
        add_neo_hookean(at_corner, moduli, volume_bound(first_tet + corners.entries[e] / 4), terms);
        terms.force += opening_force(g, at_corner.squares, moduli.mu);
        const Real damping_time = mean_damping_time(tet, start.nodes);
        if (damping_time > Real(0)) {
            const Mat3<Real> before = gradient_of(tet, at_corners(tet, start.nodes));
            add_viscosity(g, f, before, moduli, damping_time * start.inverse_step, terms);
        }
    }
}

template class TetResistance<float>;
template class TetResistance<double>;

}  // namespace gelatin::cpu
