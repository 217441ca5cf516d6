#include "cpu/descent/shift_outside.h"

#include <algorithm>

#include "cpu/contact/planes.h"
#include "cpu/descent/tangled_bodies.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// What takes all nodes outside of all planes, one plane after the other.
template <class Real>
Vec3<Real> way_outside(const Model& model, std::span<const Vec4<Real>> nodes) {
    Vec3<Real> way(0);
    for (const Collider& collider : model.colliders) {
        if (collider.kind != 0) continue;
        const Vec3<Real> normal(collider.center);
        const Real height =
            least_height(nodes, normal) + glm::dot(normal, way) - static_cast<Real>(collider.center.w);
        if (height < Real(0)) way -= height * normal;
    }
    return way;
}

}  // namespace

template <class Real>
void shift_outside(const Model& model, const StepObjective<Real>& objective, double depth,
                   std::vector<Vec4<Real>>& positions) {
    if (model.colliders.empty()) return;
    for_each_index(0, model.body_count(), 1, [&](std::size_t o) {
        const ModelObject& object = model.objects[o];
        const std::span<Vec4<Real>> nodes(positions.data() + object.nodes.first, object.nodes.count);
        const auto is_held = [](const Vec4<Real>& p) { return p.w == Real(0); };
        if (std::any_of(nodes.begin(), nodes.end(), is_held)) return;
        const Vec3<Real> way = way_outside<Real>(model, nodes);
        if (!(glm::length(way) > static_cast<Real>(depth))) return;
        const std::vector<Vec4<Real>> guess(nodes.begin(), nodes.end());
        const auto value = [&] { return body_objective<Real>(model, objective, object, positions); };
        for (Vec4<Real>& p : nodes) p = Vec4<Real>(outside_planes<Real>(model.colliders, Vec3<Real>(p)), p.w);
        const double by_node = value();
        for (std::size_t k = 0; k < guess.size(); ++k) nodes[k] = guess[k] + Vec4<Real>(way, Real(0));
        if (!(value() < by_node)) std::copy(guess.begin(), guess.end(), nodes.begin());
    });
}

template void shift_outside<float>(const Model&, const StepObjective<float>&, double,
                                   std::vector<glm::vec4>&);
template void shift_outside<double>(const Model&, const StepObjective<double>&, double,
                                    std::vector<glm::dvec4>&);

}  // namespace gelatin::cpu
