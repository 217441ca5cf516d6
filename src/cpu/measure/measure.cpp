#include "cpu/measure/measure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/collision/colliders.h"
#include "cpu/elasticity/elastic_energy.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kChunk = 1024;

struct Chunk {
    std::uint32_t object;
    Range nodes, springs, tets, faces;
};

// Ranges of nodes, springs, neo-Hookean tets and faces of one object each; summed in parallel, added up in
// order.
std::vector<Chunk> make_chunks(const Model& model) {
    std::vector<Chunk> chunks;
    for (std::uint32_t o = 0; o < model.body_count(); ++o) {
        const ModelObject& object = model.objects[o];
        const auto part = [](const Range& range, std::uint32_t offset) {
            return offset < range.count ? Range{range.first + offset, std::min(kChunk, range.count - offset)}
                                        : Range{};
        };
        const std::uint32_t most = std::max(
            {object.nodes.count, object.springs.count, object.neo_hookean_tets.count, object.faces.count});
        for (std::uint32_t offset = 0; offset < most; offset += kChunk) {
            chunks.push_back({o, part(object.nodes, offset), part(object.springs, offset),
                              part(object.neo_hookean_tets, offset), part(object.faces, offset)});
        }
    }
    return chunks;
}

template <class Real>
void add_node(const Model& model, const Nodes<Real>& nodes, std::uint32_t n, bool is_of_shape,
              ObjectMeasure& sums) {
    const glm::dvec3 position(nodes.positions[n]);
    const glm::dvec3 velocity(nodes.velocities[n]);
    if (nodes.positions[n].w > Real(0)) {
        const double mass = 1.0 / static_cast<double>(nodes.positions[n].w);  // as in the integration
        sums.momentum += mass * velocity;
        sums.kinetic_energy += 0.5 * mass * glm::dot(velocity, velocity);
        sums.potential_energy -= mass * glm::dot(glm::dvec3(model.gravity), position);
    }
    if (!is_of_shape) return;
    bool touches = false;
    for (const Collider& collider : model.colliders) {
        const double distance = surface_distance(collider, position).distance;
        sums.deepest_penetration = std::max(sums.deepest_penetration, -distance);
        touches = touches || distance < kContactDistance;
    }
    sums.contacts += touches ? 1 : 0;
}

template <class Real>
ObjectMeasure sum_chunk(const Model& model, const Nodes<Real>& nodes, const Chunk& chunk) {
    const auto position = [&](std::uint32_t n) { return glm::dvec3(nodes.positions[n]); };
    ObjectMeasure sums;
    const std::uint32_t end_of_shape = model.objects[chunk.object].shape_nodes().end();
    for (std::uint32_t n = chunk.nodes.first; n < chunk.nodes.end(); ++n)
        add_node(model, nodes, n, n < end_of_shape, sums);
    sums.elastic_energy =
        elastic_energy<Real>(model, {chunk.nodes, chunk.springs, chunk.tets}, nodes.positions);
    const glm::dvec3 origin = position(model.objects[chunk.object].nodes.first);
    for (std::uint32_t f = chunk.faces.first; f < chunk.faces.end(); ++f) {
        const Face& face = model.faces[f];
        const glm::dvec3 a = position(face.a) - origin, b = position(face.b) - origin,
                         c = position(face.c) - origin;
        sums.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sums;
}

void add(const ObjectMeasure& part, ObjectMeasure& sums) {
    sums.momentum += part.momentum;
    sums.kinetic_energy += part.kinetic_energy;
    sums.elastic_energy += part.elastic_energy;
    sums.potential_energy += part.potential_energy;
    sums.volume += part.volume;
    sums.deepest_penetration = std::max(sums.deepest_penetration, part.deepest_penetration);
    sums.contacts += part.contacts;
}

}  // namespace

template <class Real>
std::vector<ObjectMeasure> measure(const Model& model, const Nodes<Real>& nodes) {
    const std::vector<Chunk> chunks = make_chunks(model);
    std::vector<ObjectMeasure> parts(chunks.size());
    tbb::parallel_for(std::size_t(0), chunks.size(),
                      [&](std::size_t c) { parts[c] = sum_chunk(model, nodes, chunks[c]); });
    std::vector<ObjectMeasure> objects(model.objects.size());
    for (std::size_t c = 0; c < chunks.size(); ++c) add(parts[c], objects[chunks[c].object]);
    return objects;
}

template std::vector<ObjectMeasure> measure<float>(const Model&, const Nodes<float>&);
template std::vector<ObjectMeasure> measure<double>(const Model&, const Nodes<double>&);

}  // namespace gelatin::cpu
