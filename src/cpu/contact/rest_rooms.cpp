#include "cpu/contact/rest_rooms.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <glm/matrix.hpp>
#include <numeric>
#include <utility>

#include "cpu/contact/least_stretch.h"
#include "cpu/contact/nearest_pairs.h"
#include "cpu/contact/own_boxes.h"

namespace gelatin::cpu {
namespace {

// How far others are looked for, over the thickness of the surface: as far as its median edge is long.
constexpr double kSearched = 20.0;
// Of a gap that an affine map leaves, as much more than half of what it was at the start as both sides may
// use; for rounding a little less.
constexpr double kUsable = 0.98;
// Of the mean square of offsets: flatter bodies have no rooms.
constexpr double kFlat = 1e-6;

// The same whatever the order.
void lower_to(float& value, float least) {
    std::atomic_ref<float> shared(value);
    float seen = shared.load(std::memory_order_relaxed);
    while (least < seen && !shared.compare_exchange_weak(seen, least, std::memory_order_relaxed)) {
    }
}

}  // namespace

template <class Real>
RestRooms<Real>::RestRooms(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      shapes_(model_->body_count()),
      offsets_(model_->surface_parts.nodes.size()),
      apart_(model_->surface_parts.nodes.size()) {
    const SurfaceParts& parts = model_->surface_parts;
    for (std::size_t o = 0; o < shapes_.size(); ++o) {
        const Range& faces = model_->objects[o].faces;
        if (faces.count == 0) continue;
        Shape& shape = shapes_[o];
        const std::uint32_t first = parts.face_starts[faces.first].x;
        shape.places = {first, parts.face_starts[faces.end()].x - first};
        glm::dvec3 middle(0.0);
        for (std::uint32_t s = first; s < shape.places.end(); ++s)
            middle += glm::dvec3(model_->positions[parts.nodes[s]]) / static_cast<double>(shape.places.count);
        glm::dmat3 moment(0.0);
        for (std::uint32_t s = first; s < shape.places.end(); ++s) {
            const glm::dvec3 offset = glm::dvec3(model_->positions[parts.nodes[s]]) - middle;
            offsets_[s] = Vec3<Real>(offset);
            moment += glm::outerProduct(offset, offset);
        }
        const double mean = (moment[0][0] + moment[1][1] + moment[2][2]) / 3.0;
        if (glm::determinant(moment) > kFlat * mean * mean * mean)
            shape.inverse_moment = glm::inverse(moment);
    }
    find_distances(*surface);
}

template <class Real>
void RestRooms<Real>::find_distances(const ContactSurface& surface) {
    OwnBoxes<float> boxes(model_);
    tbb::parallel_for(std::size_t(0), shapes_.size(), [&](std::size_t o) {
        const auto object = static_cast<std::uint32_t>(o);
        const Range& places = shapes_[o].places;
        if (places.count == 0) return;
        const double searched = kSearched * surface.thicknesses[o];
        std::fill_n(apart_.begin() + places.first, places.count, static_cast<float>(searched));
        const auto margin = BoxMargin<float>::for_distance(searched);
        boxes.update(object, [&](std::uint32_t n, AxisBox<float>& box) {
            box.add(glm::vec3(model_->positions[n]), margin);
        });
        const Range range = boxes.leaves_of(object);
        std::vector<std::uint32_t> leaves(range.count);
        std::iota(leaves.begin(), leaves.end(), range.first);
        constexpr std::size_t kLeavesATask = 32;
        tbb::parallel_for(
            std::size_t(0), (leaves.size() + kLeavesATask - 1) / kLeavesATask, [&](std::size_t task) {
                const auto all = [](std::uint32_t) { return true; };
                const auto not_twice = [](std::uint32_t) { return false; };
                typename OwnBoxes<float>::Near near;
                std::vector<ContactPair> waiting;
                const auto wait = [&](const ContactPair& pair) { waiting.push_back(pair); };
                const auto measure = [&] {
                    for_measured<float>(waiting, model_->positions,
                                        [&](std::size_t p, const auto& measured, std::size_t c) {
                                            for (const std::uint32_t n : waiting[p].nodes)
                                                lower_to(apart_[surface.places[n]], measured.gaps[c]);
                                        });
                    waiting.clear();
                };
                const std::size_t first = task * kLeavesATask,
                                  count = std::min(kLeavesATask, leaves.size() - first);
                for_walks(std::span<const std::uint32_t>(leaves).subspan(first, count),
                          [&](std::span<const std::uint32_t> walk) {
                              boxes.find_near(object, walk, not_twice, near);
                              for (const std::uint32_t leaf : walk)
                                  boxes.for_node_pairs(leaf, all, near, wait);
                              measure();
                              for (const std::uint32_t leaf : walk)
                                  boxes.for_edge_pairs(leaf, all, near, wait);
                              measure();
                          });
            });
    });
}

template <class Real>
bool RestRooms<Real>::hold(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const Shape& shape = shapes_[object];
    if (shape.inverse_moment == glm::dmat3(0.0)) return false;
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    const Vec3<Real> first(positions[nodes[shape.places.first]]);
    glm::dvec3 sum(0.0);
    glm::dmat3 moment(0.0);
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) {
        const glm::dvec3 at(Vec3<Real>(positions[nodes[s]]) - first);
        sum += at;
        moment += glm::outerProduct(at, glm::dvec3(offsets_[s]));
    }
    const glm::dmat3 exact = moment * shape.inverse_moment;
    // Of D at the start, linear leaves `least` D; more than half of D is to be left of it.
    const double least = least_stretch(exact);
    if (!(least > 0.5)) return false;
    const auto linear = glm::mat<3, 3, Real>(exact);
    const Vec3<Real> middle = first + Vec3<Real>(sum / static_cast<double>(shape.places.count));
    const auto part = static_cast<Real>(kUsable * 0.5 * (least - 0.5));
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) {
        const Vec3<Real> deviation = Vec3<Real>(positions[nodes[s]]) - middle - linear * offsets_[s];
        const Real room = part * static_cast<Real>(apart_[s]);
        if (!(glm::dot(deviation, deviation) < room * room)) return false;
    }
    return true;
}

template class RestRooms<float>;
template class RestRooms<double>;

}  // namespace gelatin::cpu
