#include "support/proximities.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <ostream>

#include "cpu/proximity/find_proximities.h"
#include "gpu/collision_stages.h"
#include "gpu/measure/measure.h"
#include "support/crowd.h"
#include "support/folded.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

Model moved(Model model, const glm::vec3& displacement) {
    for (glm::vec4& p : model.positions) p += glm::vec4(displacement, 0.0f);
    return model;
}

// Copies of one block, some in the same place, some that touch along faces, edges and corners.
Model make_stack() {
    std::vector<Body> bodies;
    for (const glm::dvec3& place :
         {glm::dvec3(0, 0, 0), {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0.5, 0, 1}}) {
        bodies.push_back(make_body(make_block({4, 4, 4}, {1, 1, 1})));
        for (glm::dvec3& p : bodies.back().mesh.positions) p += place;
    }
    return pack_bodies(bodies, {}, {0.0, 0.0, 0.0});
}

// A crowd some of whose faces have fallen together to edges and points.
Model make_collapsed() {
    Model model = make_crowd(12, 5);
    for (std::size_t f = 0; f < model.faces.size(); f += 7) {
        const Face& face = model.faces[f];
        glm::vec4& b = model.positions[face.b];
        b = glm::vec4(glm::vec3(model.positions[face.a]), b.w);
        glm::vec4& c = model.positions[face.c];
        if (f % 2 == 0) c = glm::vec4(glm::vec3(b), c.w);
    }
    return model;
}

// As crowd.h's poison leaves it.
bool is_poisoned(std::span<const Proximity> proximities) {
    return std::all_of(proximities.begin(), proximities.end(), [](const Proximity& p) {
        const auto words = std::bit_cast<std::array<std::uint32_t, sizeof(Proximity) / 4>>(p);
        return std::all_of(words.begin(), words.end(),
                           [](std::uint32_t word) { return word == 0xDEADBEEFu; });
    });
}

}  // namespace

const std::vector<ProximityScene> kProximityScenes{
    {"two", [] { return make_crowd(2, 3); }, 0.05},
    {"crowd", [] { return make_crowd(17, 2); }, 0.03},
    {"wide", [] { return make_crowd(5, 4); }, 0.4},
    {"far_away",
     [] {
         return moved(make_crowd(9, 6), {300.0f, -2000.0f, 50.0f});
     },
     0.05},
    // More queries than a work group sums up.
    {"far_pairs", [] { return make_far_pairs(81, 5.0); }, 0.01},
    {"stack", make_stack, 0.01},
    {"collapsed", make_collapsed, 0.04},
    {"rolled", [] { return make_folded(Deformation::rolled, 1); }, 0.1},
    {"crushed", [] { return make_folded(Deformation::crushed, 2); }, 0.02},
    {"tangled", [] { return make_folded(Deformation::tangled, 3); }, 0.03},
    {"flat", [] { return make_folded(Deformation::flat, 4); }, 0.02},
};

template <class Real>
FoundProximities find_proximities_on_cpu(const Model& model, const CollisionSettings& settings) {
    const std::vector<cpu::Vec4<Real>> positions(model.positions.begin(), model.positions.end());
    const auto shared = std::make_shared<const Model>(model);
    const double radius = *settings.proximity_radius;
    cpu::Collision<Real> collision(shared, settings.broad_phase, settings.detection,
                                   cpu::BoxMargin<Real>::for_distance(radius));
    cpu::FindProximities<Real> stage(shared, collision, radius, settings.self_collision.value_or(false));
    collision.update_boxes(positions, positions);
    collision.find_object_pairs();
    stage.run(positions);
    FoundProximities found{{}, stage.starts()};
    for (const cpu::Proximity<Real>& p : stage.proximities())
        found.proximities.push_back(
            {p.first, p.second, p.distance, glm::dvec3(p.apart), glm::dvec4(p.weights)});
    return found;
}
template FoundProximities find_proximities_on_cpu<float>(const Model&, const CollisionSettings&);
template FoundProximities find_proximities_on_cpu<double>(const Model&, const CollisionSettings&);

FoundOnGpu find_proximities_on_gpu(const Model& model, const CollisionSettings& settings,
                                   std::optional<std::size_t> capacity) {
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    gpu::Collision collision(model, settings);
    gpu::ProximityBuffers buffers(model, collision.buffers, capacity);
    poison(collision.buffers.face_boxes);
    poison(collision.buffers.face_trees.boxes);
    poison(collision.buffers.pair_rows);
    poison(collision.buffers.object_pairs);
    poison(buffers.starts);
    poison(buffers.proximities);
    poison(buffers.found);
    poison(buffers.searches);
    poison(buffers.near_objects);
    poison(buffers.near_leaves);
    poison(buffers.group_sums);
    for (gpu::ProximityBuffers::Tasks* tasks : {&buffers.node_tasks, &buffers.edge_tasks}) {
        poison(tasks->leaves);
        poison(tasks->hits);
    }
    collision.update_boxes.run(model_buffers, collision.buffers, nodes, nodes);
    if (model.objects.size() > 1) collision.find_object_pairs.run(model_buffers, collision.buffers, nodes);
    for (int run = 0; run < 2; ++run)  // nothing is left of the step before
        collision.near->find.run(model_buffers, collision.buffers, buffers, nodes);
    gpu::Measure measure(model, settings.self_collision.value_or(false));
    measure.begin(model_buffers, nodes, &collision.buffers,
                  collision.self ? &collision.self->buffers : nullptr, &buffers);
    const Measurement measured = measure.end();

    FoundOnGpu found;
    found.measure = measured.proximities.value();
    found.lost_pairs = measured.lost_pairs;
    gl::barrier(gl::Barrier::buffer_update);
    found.starts.resize(buffers.starts.size());
    buffers.starts.download(found.starts);
    std::vector<Proximity> proximities(buffers.proximities.size());
    buffers.proximities.download(proximities);
    found.is_guarded =
        is_poisoned(std::span(proximities)
                        .subspan(std::min<std::size_t>(proximities.size(),
                                                       found.measure.node_face + found.measure.edge_edge)));
    proximities.resize(std::min<std::size_t>(proximities.size(), found.starts.back()));
    for (const Proximity& p : proximities) {
        found.proximities.push_back(
            {p.first, p.second, static_cast<double>(p.distance), glm::dvec3(p.apart), glm::dvec4(p.weights)});
    }
    return found;
}

}  // namespace gelatin::test
