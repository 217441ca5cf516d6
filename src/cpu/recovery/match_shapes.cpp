#include "cpu/recovery/match_shapes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "cpu/elasticity/volume_ratios.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {
namespace {

double trace(const glm::dmat3& m) {
    return m[0][0] + m[1][1] + m[2][2];
}

}  // namespace

template <class Real>
ShapeMatcher<Real>::ShapeMatcher(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      shapes_(make_match_shapes(*model_)),
      inverted_(model_->objects.size()),
      lost_for_(model_->body_count()) {
    forget();
}

template <class Real>
std::vector<std::uint32_t> ShapeMatcher<Real>::run(Nodes<Real>& nodes, double elapsed) {
    count_inverted_tets(nodes.positions);
    std::vector<std::uint32_t> lost;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        if (static_cast<float>(inverted_[o]) > shapes_.objects[o].inverse_y.w)
            lost.push_back(o);
        else
            lost_for_[o] = 0.0f;
    }
    std::vector<std::uint8_t> is_matched(lost.size());
    tbb::parallel_for(std::size_t(0), lost.size(), [&](std::size_t k) {
        is_matched[k] = match(lost[k], nodes, static_cast<float>(elapsed)) ? 1 : 0;
    });
    std::size_t k = 0;
    std::erase_if(lost, [&](std::uint32_t) { return is_matched[k++] == 0; });
    return lost;
}

template <class Real>
void ShapeMatcher<Real>::count_inverted_tets(const std::vector<Vec4<Real>>& positions) {
    std::fill(inverted_.begin(), inverted_.end(), 0u);
    constexpr std::uint32_t kTetsATask = 512;
    const auto tet_count = static_cast<std::uint32_t>(model_->tets.size());
    tbb::parallel_for(0u, (tet_count + kTetsATask - 1) / kTetsATask, [&](std::uint32_t task) {
        const Range tets{task * kTetsATask, std::min(kTetsATask, tet_count - task * kTetsATask)};
        constexpr Real kAny = std::numeric_limits<Real>::infinity();
        if (volumes_are_within(Real(0), kAny, *model_, tets, positions.data(), nullptr)) return;
        for (std::uint32_t t = tets.first; t < tets.end(); ++t) {
            const glm::uvec4& tet = model_->tets[t];
            const Vec3<Real> a(positions[tet.x]);
            const Vec3<Real> u = Vec3<Real>(positions[tet.y]) - a, v = Vec3<Real>(positions[tet.z]) - a,
                             w = Vec3<Real>(positions[tet.w]) - a;
            if (glm::dot(glm::cross(u, v), w) > Real(0)) continue;
            std::atomic_ref(inverted_[model_->node_objects[tet.x]]).fetch_add(1, std::memory_order_relaxed);
        }
    });
}

template <class Real>
bool ShapeMatcher<Real>::match(std::uint32_t object, Nodes<Real>& nodes, float elapsed) {
    const Range& range = model_->objects[object].nodes;
    const auto is_held = [](const Vec4<Real>& position) { return position.w == Real(0); };
    const auto first = nodes.positions.begin() + range.first;
    if (std::all_of(first, first + range.count, is_held)) return false;
    const glm::dvec3 origin(nodes.positions[range.first]);
    glm::dmat3 moment(0.0);  // m x X^T
    glm::dvec3 center(0.0), momentum(0.0), spin(0.0);
    double square = 0.0;
    for (std::uint32_t n = range.first; n < range.end(); ++n) {
        const glm::vec4& rest = shapes_.offsets[n];
        const auto m = static_cast<double>(rest.w);
        const glm::dvec3 x = glm::dvec3(nodes.positions[n]) - origin, v(nodes.velocities[n]);
        moment += m * glm::outerProduct(x, glm::dvec3(rest));
        center += m * x;
        momentum += m * v;
        spin += m * glm::cross(x, v);
        square += m * glm::dot(x, x);
    }
    const RestMoment& rest = shapes_.objects[object];
    const auto mass = static_cast<double>(rest.inverse_x.w);
    const glm::dmat3 inverse(glm::dvec3(rest.inverse_x), glm::dvec3(rest.inverse_y),
                             glm::dvec3(rest.inverse_z));
    center /= mass;
    square -= mass * glm::dot(center, center);
    const glm::dmat3 affine = moment * inverse, squares = glm::transpose(affine) * affine;
    const double sum = trace(squares), products = 0.5 * (sum * sum - trace(squares * squares));
    const bool is_lost = !(products > kThinnest * sum * sum &&
                           trace(affine * glm::transpose(moment)) > kLeastExplained * square);
    lost_for_[object] = is_lost ? lost_for_[object] + elapsed : 0.0f;
    if (!(lost_for_[object] > kPatience)) return false;

    const glm::dmat3 rotation = nearest_rotation(moment), square_at_rest = glm::inverse(inverse);
    const glm::dmat3 inertia = trace(square_at_rest) * glm::dmat3(1.0) - square_at_rest;
    const glm::dvec3 velocity = momentum / mass;
    spin -= glm::cross(center, momentum);
    spin = rotation * (glm::inverse(inertia) * (glm::transpose(rotation) * spin));
    for (std::uint32_t n = range.first; n < range.end(); ++n) {
        Vec4<Real>&position = nodes.positions[n], &velocity_of_node = nodes.velocities[n];
        if (position.w == Real(0)) continue;
        const glm::dvec3 r = rotation * glm::dvec3(shapes_.offsets[n]);
        position = Vec4<Real>(Vec3<Real>(origin + center + r), position.w);
        velocity_of_node = Vec4<Real>(Vec3<Real>(velocity + glm::cross(spin, r)), velocity_of_node.w);
    }
    return true;
}

template class ShapeMatcher<float>;
template class ShapeMatcher<double>;

}  // namespace gelatin::cpu
