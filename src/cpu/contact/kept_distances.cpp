// As in advance_nodes_simd.cpp: a tet a lane, compiled once for each instruction set.
#include "cpu/contact/kept_distances.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <glm/matrix.hpp>
#include <utility>

#include "cpu/contact/moment_between.h"
#include "cpu/scalars.h"
#include "model/collision/box_tree.h"
#include "model/nearest_rotation.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/contact/kept_distances.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/float_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

#include "cpu/contact/kept_distances.inl"

HWY_FLATTEN bool blocks_keep(std::span<const TetColumns<float>> blocks, const glm::mat3& turn, float part,
                             std::span<const glm::vec4> positions) {
    const Lanes d;
    const auto row = [&](int k) HWY_ATTR {
        return Vec3Lanes(FloatLanes(turn[k].x), FloatLanes(turn[k].y), FloatLanes(turn[k].z));
    };
    const Mat3Lanes r(row(0), row(1), row(2));
    const FloatLanes least(part);
    const Vector zero = hn::Zero(d);
    for (const TetColumns<float>& block : blocks) {
        for (std::size_t first = 0; first < TetColumns<float>::kCount; first += kLanes) {
            const auto corner = [&](std::size_t k) HWY_ATTR {
                return load_columns(
                    d, [&](std::size_t l) HWY_ATTR { return &positions[block.nodes[k][first + l]].x; });
            };
            const auto inverse = [&](std::size_t k)
                                     HWY_ATTR { return FloatLanes(hn::LoadU(d, &block.inverses[k][first])); };
            const Columns a = corner(0);
            const Mat3Lanes edges(difference(corner(1), a), difference(corner(2), a),
                                  difference(corner(3), a));
            const auto column = [&](std::size_t j) HWY_ATTR {
                return edges * Vec3Lanes(inverse(3 * j), inverse(3 * j + 1), inverse(3 * j + 2));
            };
            const Minors<FloatLanes> of = minors(r, Mat3Lanes(column(0), column(1), column(2)), least);
            const LaneMask keep = hn::And(hn::Gt(of.first.v, zero),
                                          hn::And(hn::Gt(of.second.v, zero), hn::Gt(of.third.v, zero)));
            if (!hn::AllTrue(d, keep)) return false;
        }
    }
    return true;
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {
namespace {

#include "cpu/contact/kept_distances.inl"  // NOLINT(readability-duplicate-include): for doubles

HWY_EXPORT(blocks_keep);

bool all_keep(std::span<const TetColumns<float>> blocks, const glm::mat3& turn, float part,
              std::span<const glm::vec4> positions) {
    return HWY_DYNAMIC_DISPATCH(blocks_keep)(blocks, turn, part, positions);
}

template <class Real>
bool tet_keeps(const TetColumns<Real>& block, std::size_t c, const glm::mat<3, 3, Real>& turn, Real part,
               std::span<const Vec4<Real>> positions) {
    const auto corner = [&](std::size_t k) { return Vec3<Real>(positions[block.nodes[k][c]]); };
    const Vec3<Real> a = corner(0);
    const glm::mat<3, 3, Real> edges(corner(1) - a, corner(2) - a, corner(3) - a);
    glm::mat<3, 3, Real> gradient;
    for (std::size_t j = 0; j < 3; ++j)
        gradient[static_cast<int>(j)] =
            edges *
            Vec3<Real>(block.inverses[3 * j][c], block.inverses[3 * j + 1][c], block.inverses[3 * j + 2][c]);
    const Minors<Real> of = minors(turn, gradient, part);
    return of.first > Real(0) && of.second > Real(0) && of.third > Real(0);
}

bool all_keep(std::span<const TetColumns<double>> blocks, const glm::dmat3& turn, double part,
              std::span<const glm::dvec4> positions) {
    for (const TetColumns<double>& block : blocks)
        for (std::size_t c = 0; c < TetColumns<double>::kCount; ++c)
            if (!tet_keeps(block, c, turn, part, positions)) return false;
    return true;
}

// Of a body, in the positions at the start. Tets of a block are neighbours, so the boxes round blocks are
// small.
template <class Real>
std::vector<TetColumns<Real>> make_columns(const Model& model, const Range& tets) {
    constexpr std::size_t kCount = TetColumns<Real>::kCount;
    std::vector<glm::dvec3> centers(tets.count);
    for (std::uint32_t t = 0; t < tets.count; ++t)
        for (int k = 0; k < 4; ++k)
            centers[t] += 0.25 * glm::dvec3(model.positions[model.tets[tets.first + t][k]]);
    const std::vector<std::uint32_t> order = box_tree_order(centers);
    std::vector<TetColumns<Real>> blocks((tets.count + kCount - 1) / kCount);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        for (std::size_t c = 0; c < kCount; ++c) {
            const std::size_t index = std::min<std::size_t>(b * kCount + c, tets.count - 1);
            const glm::uvec4& tet = model.tets[tets.first + order[index]];
            const auto corner = [&](int k) { return glm::dvec3(model.positions[tet[k]]); };
            const glm::dvec3 a = corner(0);
            const glm::dmat3 inverse = glm::inverse(glm::dmat3(corner(1) - a, corner(2) - a, corner(3) - a));
            for (std::size_t k = 0; k < 4; ++k) blocks[b].nodes[k][c] = tet[static_cast<int>(k)];
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 3; ++k)
                    blocks[b].inverses[3 * j + k][c] =
                        static_cast<Real>(inverse[static_cast<int>(j)][static_cast<int>(k)]);
        }
    }
    return blocks;
}

}  // namespace

template <class Real>
KeptDistances<Real>::KeptDistances(std::shared_ptr<const Model> model, const ContactSurface& surface)
    : model_(std::move(model)), shapes_(model_->objects.size()) {
    for (std::size_t o = 0; o < shapes_.size(); ++o)
        if (surface.is_convex[o] != 0) shapes_[o].tets = make_columns<Real>(*model_, model_->objects[o].tets);
}

template <class Real>
AxisBox<Real> KeptDistances<Real>::box_of(std::uint32_t object, const LostTets& lost) const {
    AxisBox<Real> box;
    for (std::size_t c = 0; c < TetColumns<Real>::kCount; ++c) {
        if ((lost.columns >> c & 1u) == 0) continue;
        for (const auto& corners : shapes_[object].tets[lost.block].nodes)
            box.add(Vec3<Real>(glm::vec3(model_->positions[corners[c]])));
    }
    return box;
}

template <class Real>
std::vector<LostTets> KeptDistances<Real>::find_lost_tets(std::uint32_t object, Real part,
                                                          std::span<const Vec4<Real>> from,
                                                          std::span<const Vec4<Real>> to) {
    Shape& shape = shapes_[object];
    if (keeps(shape, part, from) && keeps(shape, part, to)) return {};
    shape.turn = nearest_turn(object, to);
    std::vector<LostTets> lost = find_more_lost(object, part, {}, from);
    const std::vector<LostTets> more = find_more_lost(object, part, lost, to);
    lost.insert(lost.end(), more.begin(), more.end());
    return lost;
}

template <class Real>
std::vector<LostTets> KeptDistances<Real>::find_more_lost(std::uint32_t object, Real part,
                                                          std::span<const LostTets> known,
                                                          std::span<const Vec4<Real>> positions) const {
    const Shape& shape = shapes_[object];
    std::vector<std::uint8_t> columns(shape.tets.size());
    all_blocks(shape, [&](std::span<const TetColumns<Real>> blocks, std::size_t first) {
        if (all_keep(blocks, shape.turn, part, positions)) return true;
        for (std::size_t k = 0; k < blocks.size(); ++k) {
            if (all_keep(blocks.subspan(k, 1), shape.turn, part, positions)) continue;
            for (std::size_t c = 0; c < TetColumns<Real>::kCount; ++c)
                if (!tet_keeps(blocks[k], c, shape.turn, part, positions))
                    columns[first + k] = static_cast<std::uint8_t>(columns[first + k] | 1u << c);
        }
        return true;
    });
    for (const LostTets& tets : known)
        columns[tets.block] = static_cast<std::uint8_t>(columns[tets.block] & ~tets.columns);
    std::vector<LostTets> more;
    for (std::uint32_t b = 0; b < columns.size(); ++b)
        if (columns[b] != 0) more.push_back({b, columns[b]});
    return more;
}

template <class Real>
bool KeptDistances<Real>::keeps(const Shape& shape, Real part, std::span<const Vec4<Real>> positions) const {
    return all_blocks(shape, [&](std::span<const TetColumns<Real>> blocks, std::size_t) {
        return all_keep(blocks, shape.turn, part, positions);
    });
}

template <class Real>
template <class Visit>
bool KeptDistances<Real>::all_blocks(const Shape& shape, const Visit& visit) {
    constexpr std::size_t kBlocksATask = 64;
    const std::size_t tasks = (shape.tets.size() + kBlocksATask - 1) / kBlocksATask;
    std::atomic<bool> all = true;
    tbb::parallel_for(std::size_t(0), tasks, [&](std::size_t task) {
        if (!all.load(std::memory_order_relaxed)) return;
        const std::size_t first = task * kBlocksATask;
        const std::size_t count = std::min(kBlocksATask, shape.tets.size() - first);
        if (!visit(std::span<const TetColumns<Real>>(shape.tets).subspan(first, count), first)) all = false;
    });
    return all;
}

template <class Real>
glm::mat<3, 3, Real> KeptDistances<Real>::nearest_turn(std::uint32_t object,
                                                       std::span<const Vec4<Real>> positions) const {
    const auto at_start = [&](std::uint32_t n) { return glm::vec3(model_->positions[n]); };
    const auto now = [&](std::uint32_t n) { return Vec3<Real>(positions[n]); };
    const glm::dmat3 moment = moment_between(model_->objects[object].nodes, at_start, now).moment;
    return glm::mat<3, 3, Real>(nearest_rotation(moment));
}

template class KeptDistances<float>;
template class KeptDistances<double>;

}  // namespace gelatin::cpu
#endif
