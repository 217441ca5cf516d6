#include "support/crowd.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <memory>
#include <random>

#include "cpu/collision/respond.h"
#include "cpu/collision/triangle_overlap.h"
#include "gpu/collision_stages.h"
#include "gpu/view/mark_faces.h"
#include "model/collision/face_collision_words.h"
#include "support/converted.h"
#include "support/draw_vector.h"
#include "support/parity.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

template <class T>
std::vector<T> contents(const gl::Buffer<T>& buffer) {
    std::vector<T> values(buffer.size());
    buffer.download(values);
    return values;
}

void run_detection(gpu::Collision& collision, const gpu::ModelBuffers& model,
                   const gpu::NodeBuffers& previous, const gpu::NodeBuffers& nodes) {
    gpu::CollisionBuffers& buffers = collision.buffers;
    poison(buffers.face_boxes);
    poison(buffers.face_trees.boxes);
    if (collision.cull_by_depth) {
        poison(collision.cull_by_depth->face_views);
        poison(collision.cull_by_depth->object_views);
    }
    poison(buffers.pair_rows);
    poison(buffers.object_pairs);
    poison(buffers.candidates);
    poison(buffers.face_pairs);
    poison(buffers.face_collisions);
    collision.update_boxes.run(model, buffers, previous, nodes);
    collision.find_object_pairs.run(model, buffers, nodes);
    collision.find_face_collisions.run(model, buffers, previous, nodes);
}

cpu::Triangle<double> triangle(const Model& model, const Face& face) {
    const auto at = [&](std::uint32_t n) { return glm::dvec3(model.positions[n]); };
    return {at(face.a), at(face.b), at(face.c)};
}

template <class Real>
cpu::Collision<Real> detect_on_cpu(const Model& model, const CollisionSettings& settings,
                                   const std::vector<cpu::Vec4<Real>>& previous,
                                   const std::vector<cpu::Vec4<Real>>& positions) {
    cpu::Collision<Real> collision(std::make_shared<const Model>(model), settings.broad_phase,
                                   settings.detection);
    collision.update_boxes(positions, previous);
    collision.find_object_pairs();
    collision.find_face_collisions(positions, previous);
    return collision;
}

}  // namespace

Model make_crowd(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto vector = [&] { return draw_vector<glm::dvec3>(unit, random); };
    const double reach = 0.15 + 0.3 * (std::cbrt(count) - 1.0);
    std::vector<Body> bodies;
    for (int i = 0; i < count; ++i) {
        const glm::ivec3 cells(1 + i % 3, 1 + i % 4, 2 + i % 2);
        Body body =
            make_body(make_block(cells, 0.3 * glm::dvec3(cells), 0.2, seed + static_cast<unsigned>(i)));
        body.name = "block " + std::to_string(i);
        const glm::dquat turn = draw_rotation(unit, random);
        const glm::dvec3 place = reach * vector();
        for (glm::dvec3& p : body.mesh.positions) p = turn * (p - 0.15 * glm::dvec3(cells)) + place;
        body.velocity = 2.0 * vector();
        if (i == 0) body.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, place.x}};
        bodies.push_back(std::move(body));
    }
    Model model = pack_bodies(bodies, {}, {0.0, -9.81, 0.0});
    for (glm::vec4& v : model.velocities) v += glm::vec4(0.5 * vector(), 0.0);
    for (std::size_t n = 0; n < model.positions.size(); ++n) {
        if (model.positions[n].w == 0.0f)
            model.velocities[n] = glm::vec4(0.0f, 0.0f, 0.0f, model.velocities[n].w);
    }
    return model;
}

void move_pinned(Model& model, const glm::vec3& velocity) {
    for (std::size_t n = 0; n < model.positions.size(); ++n) {
        if (model.positions[n].w == 0.0f) model.velocities[n] = glm::vec4(velocity, model.velocities[n].w);
    }
}

Model make_far_pairs(int count, double extent, unsigned seed) {
    constexpr double kSide = 0.05, kDistance = 0.99 * kSide;  // of the centres: their inner spheres overlap
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto vector = [&] { return draw_vector<glm::dvec3>(unit, random); };
    std::vector<Body> bodies;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place = 0.5 * extent * vector(), apart = kDistance * glm::normalize(vector());
        for (const glm::dvec3& center : {place, place + apart}) {
            Body cube = make_body(make_block({1, 1, 1}, glm::dvec3(kSide)));
            cube.name = "cube " + std::to_string(bodies.size());
            const glm::dquat turn = draw_rotation(unit, random);
            for (glm::dvec3& p : cube.mesh.positions) p = center + turn * (p - 0.5 * kSide);
            bodies.push_back(std::move(cube));
        }
    }
    return pack_bodies(bodies, {}, {0.0, 0.0, 0.0});
}

FaceCollisions find_collisions_by_brute_force(const Model& model) {
    FaceCollisions found;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        for (std::uint32_t g = 0; g < model.faces.size(); ++g) {
            const std::uint32_t other = model.faces[g].object;
            if (other == model.faces[f].object) continue;
            if (!found.empty() && found.back().face == f && found.back().other == other) continue;
            if (cpu::triangles_overlap(triangle(model, model.faces[f]), triangle(model, model.faces[g])))
                found.push_back({f, other, cpu::FaceContact::enters});
        }
    }
    return found;
}

template <class Real>
FaceCollisions find_collisions_on_cpu(const Model& model, const CollisionSettings& settings, double step) {
    const cpu::Collision<Real> collision = detect_on_cpu<Real>(
        model, settings, converted<Real>(positions_before(model, step)), converted<Real>(model.positions));
    FaceCollisions found;
    for (const cpu::ObjectPair& pair : collision.pairs()) {
        const Range& faces = model.objects[pair.object].faces;
        for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
            if (collision.collides(pair, f)) found.push_back({f, pair.other, collision.contact(pair, f)});
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}
template FaceCollisions find_collisions_on_cpu<float>(const Model&, const CollisionSettings&, double);
template FaceCollisions find_collisions_on_cpu<double>(const Model&, const CollisionSettings&, double);

FaceCollisions find_collisions_on_gpu(const Model& model, const CollisionSettings& settings, double step) {
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    const gpu::NodeBuffers previous(positions_before(model, step), model.velocities);
    gpu::Collision collision(model, settings);
    run_detection(collision, model_buffers, previous, nodes);
    gl::barrier(gl::Barrier::buffer_update);

    const gpu::CollisionBuffers& buffers = collision.buffers;
    const std::vector<ObjectPair> pairs = contents(buffers.object_pairs);
    const std::vector<std::uint32_t> words = contents(buffers.face_collisions);
    FaceCollisions found;
    for (const PairRow& row : contents(buffers.pair_rows)) {
        for (std::uint32_t p = row.first_pair; p < row.first_pair + row.pair_count; ++p) {
            const Range& faces = model.objects[pairs[p].object].faces;
            for (std::uint32_t k = 0; k < faces.count; ++k) {
                const auto touch = cpu::FaceContact(
                    words[pairs[p].first_word + k / kFacesAWord] >> (2 * (k % kFacesAWord)) & 3u);
                if (touch != cpu::FaceContact::none)
                    found.push_back({faces.first + k, pairs[p].other, touch});
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::uint32_t> mark_faces_on_gpu(const Model& model, const CollisionSettings& settings) {
    constexpr std::uint32_t kPoison = 0xDEADBEEF;
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    gpu::Collision collision(model, settings);
    run_detection(collision, model_buffers, nodes, nodes);
    gpu::Collision::Self* self = collision.self ? &*collision.self : nullptr;
    if (self) self->find.run(model_buffers, collision.buffers, self->buffers, nodes);
    std::vector<std::uint32_t> marks(model.faces.size() + kGuard, kPoison);
    const gl::Buffer<std::uint32_t> buffer{std::span<const std::uint32_t>(marks)};
    gpu::MarkFaces(model).run(model_buffers, collision.buffers, self ? &self->buffers : nullptr, buffer);
    gl::barrier(gl::Barrier::buffer_update);
    buffer.download(marks);
    const auto end = marks.begin() + static_cast<std::ptrdiff_t>(model.faces.size());
    if (std::any_of(end, marks.end(), [](std::uint32_t mark) { return mark != kPoison; })) return {};
    marks.erase(end, marks.end());
    return marks;
}

std::vector<glm::vec4> positions_before(const Model& model, double step) {
    std::vector<glm::vec4> positions = model.positions;
    for (std::size_t n = 0; n < positions.size(); ++n)
        positions[n] -= static_cast<float>(step) * glm::vec4(glm::vec3(model.velocities[n]), 0.0f);
    return positions;
}

template <class Real>
cpu::Nodes<Real> respond_on_cpu(const Model& model, const CollisionSettings& settings, double step) {
    cpu::Nodes<Real> nodes{converted<Real>(model.positions), converted<Real>(model.velocities)};
    const cpu::Nodes<Real> previous{converted<Real>(positions_before(model, step)), nodes.velocities};
    const cpu::Collision<Real> collision =
        detect_on_cpu<Real>(model, settings, previous.positions, nodes.positions);
    cpu::respond(model, collision, {settings.friction, settings.restitution}, static_cast<Real>(step),
                 previous, nodes);
    return nodes;
}
template cpu::Nodes<float> respond_on_cpu(const Model&, const CollisionSettings&, double);
template cpu::Nodes<double> respond_on_cpu(const Model&, const CollisionSettings&, double);

NodeArrays respond_on_gpu(const Model& model, const CollisionSettings& settings, double step) {
    NodeArrays arrays{poisoned(model.node_count()), poisoned(model.node_count())};
    std::copy(model.positions.begin(), model.positions.end(), arrays.positions.begin());
    std::copy(model.velocities.begin(), model.velocities.end(), arrays.velocities.begin());
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers current(arrays.positions, arrays.velocities);
    const gpu::NodeBuffers previous(positions_before(model, step), model.velocities);
    gpu::Collision collision(model, settings);
    run_detection(collision, model_buffers, previous, current);
    collision.respond.run(model_buffers, collision.buffers, previous, current, step);
    gl::barrier(gl::Barrier::buffer_update);
    current.positions.download(arrays.positions);
    current.velocities.download(arrays.velocities);
    return arrays;
}

double worst_node_error(const cpu::Nodes<double>& expected, const NodeArrays& actual, double position_bound,
                        double velocity_bound) {
    double worst = 0.0;
    for (std::size_t n = 0; n < expected.positions.size(); ++n) {
        const double position =
                         glm::distance(glm::dvec3(actual.positions[n]), glm::dvec3(expected.positions[n])),
                     velocity =
                         glm::distance(glm::dvec3(actual.velocities[n]), glm::dvec3(expected.velocities[n]));
        if (!std::isfinite(position + velocity)) return std::numeric_limits<double>::infinity();
        worst = std::max({worst, position / position_bound, velocity / velocity_bound});
    }
    return worst;
}

double worst_response_error(const Model& model, const CollisionSettings& settings, double step,
                            const NodeArrays& actual) {
    constexpr double kEps = 6e-8, kSpeed = 5.0, kReach = 4.0;  // [m/s], [m]
    const double velocity_bound = 128 * kEps * kSpeed,
                 position_bound = step * velocity_bound + 4 * kEps * kReach;
    const cpu::Nodes<double> expected = respond_on_cpu<double>(model, settings, step);
    return worst_node_error(expected, actual, position_bound, velocity_bound);
}

}  // namespace gelatin::test
