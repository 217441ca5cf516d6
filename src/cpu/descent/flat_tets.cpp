#include "cpu/descent/flat_tets.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <limits>
#include <utility>

#include "cpu/elasticity/volume_ratios.h"

namespace gelatin::cpu {

template <class Real>
FlatTets<Real>::FlatTets(std::shared_ptr<const Model> model, const DescentRows& rows)
    : model_(std::move(model)),
      node_tets_(make_node_tets(model_->node_count(), model_->tets)),
      ratios_(model_->tets.size()),
      is_near_(model_->node_count()),
      any_(rows.batches.size()) {}

template <class Real>
bool FlatTets<Real>::is_tangled(const ModelObject& object, const std::vector<Vec4<Real>>& positions) const {
    return !volumes_are_within(static_cast<Real>(kLeastSound), static_cast<Real>(kMostSound), *model_,
                               object.tets, positions.data(), nullptr);
}

template <class Real>
void FlatTets<Real>::update(std::size_t index, const DescentRows& rows,
                            const std::vector<Vec4<Real>>& positions) {
    const DescentBatch& batch = rows.batches[index];
    std::uint8_t& any_flat = any_[index];
    if (any_flat != 0) std::fill_n(is_near_.begin() + batch.nodes.first, batch.nodes.count, std::uint8_t(0));
    any_flat = 0;
    constexpr std::uint32_t kTetsATask = 512;
    tbb::parallel_for(0u, (batch.tets.count + kTetsATask - 1) / kTetsATask, [&](std::uint32_t task) {
        const std::uint32_t first = task * kTetsATask;
        update_range({batch.tets.first + first, std::min(kTetsATask, batch.tets.count - first)}, any_flat,
                     positions);
    });
}

template <class Real>
void FlatTets<Real>::update_range(const Range& tets, std::uint8_t& any_flat,
                                  const std::vector<Vec4<Real>>& positions) {
    const auto least = static_cast<Real>(kFlattest), most = std::numeric_limits<Real>::infinity();
    if (volumes_are_within(least, most, *model_, tets, positions.data(), ratios_.data() + tets.first)) return;
    for (std::uint32_t t = tets.first; t < tets.end(); ++t) {
        if (ratios_[t] >= least) continue;
        std::atomic_ref(any_flat).store(1, std::memory_order_relaxed);
        for (int k = 0; k < 4; ++k)
            std::atomic_ref(is_near_[model_->tets[t][k]]).store(1, std::memory_order_relaxed);
    }
}

template <class Real>
void FlatTets<Real>::add(std::uint32_t node, const std::vector<Vec4<Real>>& positions,
                         NodeTerms<Real>& terms) const {
    if (is_near_[node] == 0 || has_neo_hookean_tets(*model_, node)) return;
    for_each_volume_slope(*model_, node_tets_, node, positions.data(),
                          [&](std::uint32_t tet, const Vec3<Real>& slope, Real ratio) {
                              const TetRest& rest = model_->tet_rests[tet];
                              add_flat_tet(slope, ratio,
                                           static_cast<Real>(rest.volume) * static_cast<Real>(rest.modulus),
                                           terms);
                          });
}

template class FlatTets<float>;
template class FlatTets<double>;

}  // namespace gelatin::cpu
