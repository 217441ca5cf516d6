#include "picture/shown.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>

#include "gelatin/recording.h"
#include "model/assembly/collider_surface.h"
#include "model/model.h"
#include "picture/surroundings.h"
#include "render/collider_props.h"
#include "render/up_axis.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

using render::Bounds;
using render::ViewAngles;

constexpr float kSteep = 0.1f;  // least upward part of the normal of a plane on which bodies stand
// How far bodies are followed, and what is under them is shown: in sizes of the largest body, or of all that
// the first frame shows, whichever is more.
struct Reach {
    float of_body, of_all;
};
constexpr Reach kOverGround{40.0f, 4.0f};  // where something is under them
constexpr Reach kOverNothing{5.0f, 1.0f};

constexpr float kBeside = 0.25f;  // in sizes of what is shown: how much of colliders is shown beside bodies
constexpr float kWholly = 2.0f;   // in the same: colliders not larger than this are shown wholly
constexpr float kWide = 70.0f;    // vertical field of view, from near [degrees]
constexpr float kSeen = 0.75f;    // of the bodies, which is enough
constexpr float kHardlySeen = 0.5f;  // less than this is seen from afar: only then from near
constexpr float kClearlyMore = 0.1f;

float largest(const glm::vec3& size) {
    return std::max({size.x, size.y, size.z});
}

Bounds inflated(const Bounds& bounds, float by) {
    return {bounds.min - by, bounds.max + by};
}

bool meet(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

Bounds common(const Bounds& a, const Bounds& b) {
    return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

Bounds both(Bounds a, const Bounds& b) {
    a.add(b.min);
    a.add(b.max);
    return a;
}

bool is_finite(const Bounds& bounds) {
    const glm::vec3 size = bounds.size();
    return std::isfinite(size.x + size.y + size.z);
}

Bounds bounds_of(std::span<const glm::vec3> points) {
    Bounds bounds{points[0], points[0]};
    for (const glm::vec3& p : points) bounds.add(p);
    return bounds;
}

std::span<const glm::vec3> part(const std::vector<glm::vec3>& nodes, const Range& range) {
    return std::span(nodes).subspan(range.first, range.count);
}

std::vector<glm::vec3> nodes_of(const Simulator& simulator) {
    std::vector<glm::vec3> nodes;
    for (const glm::vec4& p : simulator.positions())
        nodes.push_back(render::to_y_up(glm::vec3(p), simulator.scene().up));
    return nodes;
}

// Of each collider that is neither a plane nor a surface, three corners for each face.
std::vector<std::vector<glm::vec3>> solids(const Scene& scene) {
    std::vector<ColliderDescription> colliders = solid_colliders(scene);
    std::erase_if(colliders, [](const auto& c) { return std::holds_alternative<PlaneCollider>(c.shape); });
    std::vector<std::vector<glm::vec3>> all;
    for (const SurfaceMesh& solid : render::make_collider_props(colliders, {}, scene.up).props) {
        std::vector<glm::vec3>& corners = all.emplace_back();
        for (const glm::uvec3& face : solid.faces)
            for (int k = 0; k < 3; ++k)
                corners.push_back(render::to_y_up(glm::vec3(solid.positions[face[k]]), scene.up));
    }
    return all;
}

/// From where bodies are seen: the usual view first, then from other sides and heights, at last from near,
/// inside a room.
std::vector<ViewAngles> views() {
    std::vector<ViewAngles> all;
    for (const float field_of_view : {ViewAngles().field_of_view, kWide})
        for (const float elevation : {15.0f, 35.0f, 60.0f})
            for (const float azimuth : {27.0f, -27.0f, 63.0f, -63.0f, 117.0f, -117.0f, 153.0f, -153.0f})
                all.push_back({azimuth, elevation, field_of_view});
    return all;
}

}  // namespace

Shown::Shown(const Simulator& simulator) : simulator_(simulator) {
    const Model& model = model_of(simulator);
    const Scene& scene = simulator.scene();
    for (const ColliderDescription& collider : scene.colliders) {
        const auto* plane = std::get_if<PlaneCollider>(&collider.shape);
        if (plane == nullptr) continue;
        const glm::vec3 normal = render::to_y_up(glm::vec3(plane->normal), scene.up);
        if (normal.y > kSteep) planes_.push_back({normal, static_cast<float>(plane->offset)});
    }
    for (std::size_t o = model.body_count(); o < model.objects.size(); ++o)
        colliders_.push_back({model.objects[o].nodes, {}, {}});
    for (const std::vector<glm::vec3>& solid : solids(scene))
        colliders_.push_back({{}, bounds_of(solid), bounds_of(solid)});
    add();
}

Shown Shown::of_all(Simulator& simulator) {
    const Recording* const recording = simulator.recording();
    if (recording == nullptr || simulator.scene().camera) return Shown(simulator);
    const std::size_t present = recording->index_of(simulator.frame());
    simulator.show_recorded(0);
    Shown shown(simulator);
    for (std::size_t k = 1; k < recording->frame_count(); ++k) {
        simulator.show_recorded(k);
        shown.add();
    }
    simulator.show_recorded(present);
    return shown;
}

void Shown::add() {
    const Model& model = model_of(simulator_);
    last_ = nodes_of(simulator_);
    const bool is_first = first_.empty();
    if (is_first) first_ = last_;
    for (FiniteCollider& collider : colliders_) {
        if (collider.nodes.count == 0) continue;
        collider.now = bounds_of(part(last_, collider.nodes));
        collider.all = is_first ? collider.now : both(collider.all, collider.now);
    }
    std::vector<Bounds> bodies;
    for (const ModelObject& body : model.bodies())
        if (const Bounds bounds = bounds_of(part(last_, body.shape_nodes())); is_finite(bounds))
            bodies.push_back(bounds);
    follow(std::move(bodies));
}

// Not into the distance: the others would become tiny.
void Shown::follow(std::vector<Bounds> bodies) {
    if (bodies.empty()) return;
    if (!home_)
        for (const Bounds& body : bodies) size_ = std::max(size_, largest(body.size()));
    std::vector<bool> is_over_ground;
    for (Bounds& body : bodies) {
        const std::optional<float> ground = ground_under(body);
        is_over_ground.push_back(ground.has_value());
        if (ground && body.min.y - *ground <= kOverGround.of_body * size_)
            body.min.y = std::min(body.min.y, *ground);
    }
    if (!home_) home_ = std::reduce(bodies.begin(), bodies.end(), bodies.front(), both);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const Reach& far = is_over_ground[b] ? kOverGround : kOverNothing;
        const Bounds reach =
            inflated(*home_, std::max(far.of_body * size_, far.of_all * largest(home_->size())));
        if (!meet(bodies[b], reach)) continue;
        const Bounds shown = common(bodies[b], reach);
        bodies_ = bodies_ ? both(*bodies_, shown) : shown;
    }
}

// The highest of what is under the middle of a body: planes, and the tops of what has an end, or what is
// around it.
std::optional<float> Shown::ground_under(const Bounds& body) const {
    const glm::vec3 middle = body.center();
    std::optional<float> ground;
    const auto note = [&](float height) {
        if (height <= middle.y) ground = std::max(ground.value_or(height), height);
    };
    for (const Plane& plane : planes_)
        note((plane.offset - plane.normal.x * middle.x - plane.normal.z * middle.z) / plane.normal.y);
    for (const FiniteCollider& collider : colliders_) {
        const Bounds& box = collider.now;
        if (box.min.x > body.max.x || box.max.x < body.min.x || box.min.z > body.max.z ||
            box.max.z < body.min.z)
            continue;
        note(box.max.y <= middle.y ? box.max.y : box.min.y);
    }
    return ground;
}

Bounds Shown::bodies() const {
    return render::from_y_up(bodies_.value_or(Bounds{glm::vec3(-0.5f), glm::vec3(0.5f)}),
                             simulator_.scene().up);
}

// With the parts of colliders that are near the bodies.
Bounds Shown::with_colliders() const {
    Bounds shown = *bodies_;
    const float size = largest(bodies_->size());
    const Bounds near = inflated(*bodies_, kBeside * size);
    for (const FiniteCollider& collider : colliders_) {
        if (!meet(collider.all, near)) continue;
        const bool is_small = largest(collider.all.size()) <= kWholly * size;
        shown = both(shown, is_small ? collider.all : common(collider.all, near));
    }
    return shown;
}

LineOfSight Shown::sight_of(const std::vector<glm::vec3>& nodes) const {
    const Model& model = model_of(simulator_);
    LineOfSight sight(part(nodes, {0, model.body_node_count()}));
    for (std::size_t o = model.body_count(); o < model.objects.size(); ++o) {
        std::vector<glm::vec3> corners;
        const Range& faces = model.objects[o].faces;
        for (std::uint32_t f = faces.first; f < faces.end(); ++f)
            for (const std::uint32_t n : {model.faces[f].a, model.faces[f].b, model.faces[f].c})
                corners.push_back(nodes[n]);
        sight.add_surface(std::move(corners));
    }
    for (std::vector<glm::vec3>& solid : solids(simulator_.scene())) sight.add_surface(std::move(solid));
    return sight;
}

render::Camera Shown::camera(float aspect) const {
    const Scene& scene = simulator_.scene();
    if (scene.camera) return camera_of(*scene.camera);
    if (!bodies_) return {};
    const Bounds whole = with_colliders();
    const LineOfSight first = sight_of(first_), last = sight_of(last_);
    render::Camera best;
    float most = -1.0f;
    for (const ViewAngles& angles : views()) {
        const bool is_near = angles.field_of_view == kWide;
        if (is_near && most >= kHardlySeen) break;
        const render::Camera camera = render::frame_bounds(is_near ? *bodies_ : whole, aspect, angles);
        const float seen = std::min(first.seen_from(camera.eye), last.seen_from(camera.eye));
        if (seen <= most + kClearlyMore) continue;
        best = camera;
        most = seen;
        if (seen >= kSeen) break;
    }
    return render::from_y_up(best, scene.up);
}

}  // namespace gelatin
