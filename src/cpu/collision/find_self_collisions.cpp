#include "cpu/collision/find_self_collisions.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kOwnFacesATask = 2048;
constexpr std::size_t kOwnWalksATask = 64;

}  // namespace

template <class Real>
FindSelfCollisions<Real>::FindSelfCollisions(std::shared_ptr<const Model> model, const Collision<Real>& boxes)
    : model_(std::move(model)),
      boxes_(boxes),
      fits_(model_->objects.size()),
      is_object_calm_(model_->objects.size()),
      is_calm_(model_->faces.size()),
      contact_counts_(model_->faces.size()) {}

template <class Real>
void FindSelfCollisions<Real>::run(std::span<const Vec4<Real>> positions) {
    if (any_) std::fill(contact_counts_.begin(), contact_counts_.end(), 0u);
    find_restless(positions);
    // Counts for faces that several threads may find. Two restless faces find one another; one of them
    // counts.
    std::atomic<bool> any = false;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, restless_.size(), kOwnWalksATask), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const std::uint32_t face = restless_[i];
                for_faces_near(face, [&](std::uint32_t other) {
                    if (other < face && !is_calm_[other]) return;
                    if (!touch(positions, face, other)) return;
                    for (const std::uint32_t f : {face, other})
                        std::atomic_ref(contact_counts_[f]).fetch_add(1, std::memory_order_relaxed);
                    any.store(true, std::memory_order_relaxed);
                });
            }
        });
    any_ = any;
}

template <class Real>
void FindSelfCollisions<Real>::find_restless(std::span<const Vec4<Real>> positions) {
    const auto objects = static_cast<std::uint32_t>(model_->objects.size());
    tbb::parallel_for(std::uint32_t(0), objects, [&](std::uint32_t o) {
        is_object_calm_[o] = renew_fit(o, positions);
        if (is_object_calm_[o]) return;
        const Range& faces = model_->objects[o].faces;
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(faces.first, faces.end(), kOwnFacesATask),
                          [&](const auto& range) {
                              for (std::uint32_t f = range.begin(); f < range.end(); ++f)
                                  is_calm_[f] = is_face_calm(f, positions);
                          });
    });
    restless_.clear();
    for (std::uint32_t o = 0; o < objects; ++o) {
        const Range& faces = model_->objects[o].faces;
        for (std::uint32_t f = faces.first; f < faces.end() && !is_object_calm_[o]; ++f)
            if (!is_calm_[f]) restless_.push_back(f);
    }
}

// Any affine map is valid. So the last one is used, displaced with the object, until it no longer explains
// the positions of the nodes.
template <class Real>
bool FindSelfCollisions<Real>::renew_fit(std::uint32_t object, std::span<const Vec4<Real>> positions) {
    AffineFit<Real>& fit = fits_[object];
    const AxisBox<Real>& box = boxes_.bounding_boxes()[object];
    const Vec3<Real> first(positions[model_->objects[object].nodes.first]);
    fit = fit.moved(first, model_->rest_shapes.objects[object], box);
    if (is_calm_all_over(object, positions)) return true;
    fit = fit_rest_shape(*model_, object, positions, box);
    return is_calm_all_over(object, positions);
}

// Faster than face by face.
template <class Real>
bool FindSelfCollisions<Real>::is_calm_all_over(std::uint32_t object,
                                                std::span<const Vec4<Real>> positions) const {
    const RestShapes& rest = model_->rest_shapes;
    const AffineFit<Real>& fit = fits_[object];
    const Real limit = fit.half_stretch * static_cast<Real>(rest.objects[object].inverse_moment_y.w);
    const Range& nodes = model_->objects[object].nodes;
    bool is_calm = true;  // not for NaN
    for (std::uint32_t n = nodes.first; n < nodes.end() && is_calm; ++n)
        is_calm = fit.deviation(Vec3<Real>(positions[n]), Vec3<Real>(rest.offsets[n])) < limit;
    return is_calm;
}

template <class Real>
bool FindSelfCollisions<Real>::is_face_calm(std::uint32_t index,
                                            std::span<const Vec4<Real>> positions) const {
    const RestShapes& rest = model_->rest_shapes;
    const Face& face = model_->faces[index];
    const AffineFit<Real>& fit = fits_[face.object];
    const Real limit = fit.half_stretch * static_cast<Real>(rest.clearances[index]);
    bool is_calm = true;  // not for NaN
    for (const std::uint32_t n : {face.a, face.b, face.c})
        is_calm &= fit.deviation(Vec3<Real>(positions[n]), Vec3<Real>(rest.offsets[n])) < limit;
    return is_calm;
}

template <class Real>
bool FindSelfCollisions<Real>::touch(std::span<const Vec4<Real>> positions, std::uint32_t face,
                                     std::uint32_t other) const {
    const auto triangle = [&](const Face& f) {
        return Triangle<Real>{Vec3<Real>(positions[f.a]), Vec3<Real>(positions[f.b]),
                              Vec3<Real>(positions[f.c])};
    };
    // In a fixed order, so that both faces get the same result.
    const auto [first, second] = std::minmax(face, other);
    return triangles_overlap(triangle(model_->faces[first]), triangle(model_->faces[second]));
}

template class FindSelfCollisions<float>;
template class FindSelfCollisions<double>;

}  // namespace gelatin::cpu
