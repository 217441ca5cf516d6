#include "support/folded.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <memory>
#include <random>

#include "cpu/collision/find_self_collisions.h"
#include "cpu/collision/respond_to_self.h"
#include "gpu/collision_stages.h"
#include "model/corners.h"
#include "support/converted.h"
#include "support/crowd.h"
#include "support/draw_vector.h"
#include "support/parity.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

constexpr double kCell = 0.2;                                    // [m]
const glm::ivec3 kBars[] = {{30, 2, 2}, {9, 3, 1}, {13, 1, 4}};  // cells

class Deformer {
public:
    Deformer(Deformation deformation, double length, unsigned seed)
        : deformation_(deformation), length_(length), random_(seed) {
        turn_ = glm::normalize(glm::dquat(unit_(random_), unit_(random_), unit_(random_), 1.5));
    }

    glm::dvec3 operator()(glm::dvec3 p) {
        const glm::dvec3 noise(unit_(random_), unit_(random_), unit_(random_));
        if (deformation_ == Deformation::affine) p = {2.0 * p.x + p.y, 0.6 * p.y, p.z - 0.5 * p.x};
        if (deformation_ == Deformation::crushed) p = glm::dvec3(p.x, 0.1 * p.y, p.z) + 0.1 * kCell * noise;
        if (deformation_ == Deformation::tangled) p += 2.0 * kCell * noise;
        if (deformation_ == Deformation::flat) p.y = 0.0;
        if (deformation_ == Deformation::rolled) {
            const double radius = length_ / 7.0;  // a little more than once round
            p = {(radius + p.y) * std::sin(p.x / radius), (radius + p.y) * std::cos(p.x / radius), p.z};
        }
        return deformation_ == Deformation::flat ? p : turn_ * p + glm::dvec3(3.0, -1.0, 2.0);
    }

private:
    Deformation deformation_;
    double length_;
    glm::dquat turn_;
    std::mt19937 random_;
    std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

void run_self_detection(gpu::Collision& collision, const gpu::ModelBuffers& model,
                        const gpu::NodeBuffers& nodes) {
    gpu::SelfCollisionBuffers& buffers = collision.self->buffers;
    poison(collision.buffers.face_pairs);
    poison(buffers.fits);
    poison(buffers.restless);
    poison(buffers.is_calm);
    poison(buffers.contact_counts);
    poison(buffers.colliding);
    collision.update_boxes.run(model, collision.buffers, nodes, nodes);
    collision.self->find.run(model, collision.buffers, buffers, nodes);
    collision.self->find.run(model, collision.buffers, buffers, nodes);  // nothing is left of the step before
}

CollisionSettings with_self(CollisionSettings settings) {
    settings.self_collision = true;
    return settings;
}

void poke(Model& model) {
    for (const ModelObject& object : model.objects) {
        for (const std::uint32_t place : {2u, 5u, 8u}) {
            const Face& face = model.faces[object.faces.first + object.faces.count * place / 10];
            const glm::vec3 a(model.positions[face.a]), b(model.positions[face.b]),
                c(model.positions[face.c]);
            model.positions[face.a] -= glm::vec4(0.5f * glm::normalize(glm::cross(b - a, c - a)), 0.0f);
        }
    }
}

}  // namespace

const char* name_of(Deformation deformation) {
    constexpr const char* kNames[] = {"rigid", "affine", "rolled", "crushed", "poked", "tangled", "flat"};
    return kNames[static_cast<std::size_t>(deformation)];
}

Model make_folded(Deformation deformation, unsigned seed) {
    std::vector<Body> bodies;
    for (const glm::ivec3& cells : kBars) {
        Body body = make_body(make_block(cells, kCell * glm::dvec3(cells), 0.2, seed));
        for (glm::dvec3& p : body.mesh.positions) p.z += 5.0 * static_cast<double>(bodies.size());
        if (bodies.empty()) body.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.5 * kCell}};
        body.name = "bar " + std::to_string(bodies.size());
        bodies.push_back(std::move(body));
    }
    Model model = pack_bodies(bodies, {}, {0.0, -9.81, 0.0});
    model.rest_shapes = make_rest_shapes(model);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const ModelObject& object = model.objects[o];
        Deformer deform(deformation, kCell * kBars[o].x, seed);
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
            glm::vec4& p = model.positions[n];
            p = glm::vec4(glm::vec3(deform(glm::dvec3(p))), p.w);
            if (p.w > 0.0f) model.velocities[n] += glm::vec4(draw_vector<glm::vec3>(unit, random), 0.0f);
        }
    }
    if (deformation == Deformation::poked) poke(model);
    return model;
}

SelfContacts find_self_contacts_by_brute_force(const Model& model) {
    const auto triangle = [&](const Face& face) {
        const auto at = [&](std::uint32_t n) { return glm::dvec3(model.positions[n]); };
        return cpu::Triangle<double>{at(face.a), at(face.b), at(face.c)};
    };
    SelfContacts counts(model.faces.size(), 0);
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        for (std::uint32_t g = f + 1; g < model.faces.size(); ++g) {
            const Face &one = model.faces[f], &two = model.faces[g];
            if (one.object != two.object || share_corner(one, two)) continue;
            if (!cpu::triangles_overlap(triangle(one), triangle(two))) continue;
            ++counts[f];
            ++counts[g];
        }
    }
    return counts;
}

namespace {

template <class Real>
class SelfSearch {
public:
    explicit SelfSearch(const Model& model)
        : model_(std::make_shared<const Model>(model)),
          boxes_(model_, BroadPhase::hierarchy),
          collision_(model_, boxes_) {}

    SelfContacts find(const Model& now) {
        const auto positions = converted<Real>(now.positions);
        boxes_.update_boxes(positions, positions);
        collision_.run(positions);
        SelfContacts counts;
        for (std::uint32_t f = 0; f < model_->faces.size(); ++f)
            counts.push_back(collision_.contact_count(f));
        return counts;
    }
    std::size_t restless_count() const { return collision_.restless_count(); }

private:
    std::shared_ptr<const Model> model_;
    cpu::Collision<Real> boxes_;
    cpu::FindSelfCollisions<Real> collision_;
};

}  // namespace

template <class Real>
SelfContacts find_self_contacts_on_cpu(const Model& model, std::size_t* restless) {
    SelfSearch<Real> search(model);
    const SelfContacts contacts = search.find(model);
    if (restless != nullptr) *restless = search.restless_count();
    return contacts;
}
template SelfContacts find_self_contacts_on_cpu<float>(const Model&, std::size_t*);
template SelfContacts find_self_contacts_on_cpu<double>(const Model&, std::size_t*);

template <class Real>
SelfContacts find_self_contacts_on_cpu_after(const Model& before, const Model& model) {
    SelfSearch<Real> search(model);
    search.find(before);
    return search.find(model);
}
template SelfContacts find_self_contacts_on_cpu_after<float>(const Model&, const Model&);
template SelfContacts find_self_contacts_on_cpu_after<double>(const Model&, const Model&);

namespace {

std::uint32_t count_of(const gpu::Collision& collision, std::uint32_t slot) {
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<Dispatch> dispatches(collision.buffers.dispatches.size());
    collision.buffers.dispatches.download(dispatches);
    return dispatches[slot].count;
}

SelfContacts download_contacts(const gpu::Collision& collision) {
    gl::barrier(gl::Barrier::buffer_update);
    SelfContacts counts(collision.self->buffers.contact_counts.size());
    collision.self->buffers.contact_counts.download(counts);
    return counts;
}

}  // namespace

SelfContacts find_self_contacts_on_gpu(const Model& model, std::uint32_t* restless) {
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    gpu::Collision collision(model, with_self({}));
    run_self_detection(collision, model_buffers, nodes);
    if (restless != nullptr) *restless = count_of(collision, dispatch_slots::kRestless);
    return download_contacts(collision);
}

SelfContacts find_self_contacts_on_gpu_after(const Model& before, const Model& model, std::uint32_t* fitted) {
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers nodes_before(before.positions, before.velocities),
        nodes(model.positions, model.velocities);
    gpu::Collision collision(model, with_self({}));
    run_self_detection(collision, model_buffers, nodes_before);
    for (const gpu::NodeBuffers* now : {&nodes_before, &nodes}) {
        collision.update_boxes.run(model_buffers, collision.buffers, *now, *now);
        collision.self->find.run(model_buffers, collision.buffers, collision.self->buffers, *now);
    }
    if (fitted != nullptr) *fitted = count_of(collision, dispatch_slots::kFits);
    return download_contacts(collision);
}

template <class Real>
cpu::Nodes<Real> respond_to_self_on_cpu(const Model& model, const CollisionSettings& settings, double step) {
    cpu::Nodes<Real> nodes{converted<Real>(model.positions), converted<Real>(model.velocities)};
    const cpu::Nodes<Real> previous{converted<Real>(positions_before(model, step)), nodes.velocities};
    const auto shared = std::make_shared<const Model>(model);
    cpu::Collision<Real> boxes(shared, BroadPhase::hierarchy);
    cpu::FindSelfCollisions<Real> collision(shared, boxes);
    boxes.update_boxes(nodes.positions, nodes.positions);
    collision.run(nodes.positions);
    cpu::RespondToSelf<Real> response(shared, {settings.friction, settings.restitution});
    response.run(collision, static_cast<Real>(step), previous, nodes);
    return nodes;
}
template cpu::Nodes<float> respond_to_self_on_cpu(const Model&, const CollisionSettings&, double);
template cpu::Nodes<double> respond_to_self_on_cpu(const Model&, const CollisionSettings&, double);

NodeArrays respond_to_self_on_gpu(const Model& model, const CollisionSettings& settings, double step) {
    NodeArrays arrays{poisoned(model.node_count()), poisoned(model.node_count())};
    std::copy(model.positions.begin(), model.positions.end(), arrays.positions.begin());
    std::copy(model.velocities.begin(), model.velocities.end(), arrays.velocities.begin());
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers current(arrays.positions, arrays.velocities);
    const gpu::NodeBuffers previous(positions_before(model, step), model.velocities);
    gpu::Collision collision(model, with_self(settings));
    run_self_detection(collision, model_buffers, current);
    collision.self->respond.run(model_buffers, collision.buffers, collision.self->buffers, previous, current,
                                step);
    gl::barrier(gl::Barrier::buffer_update);
    current.positions.download(arrays.positions);
    current.velocities.download(arrays.velocities);
    return arrays;
}

double worst_self_response_error(const Model& model, const CollisionSettings& settings, double step,
                                 const NodeArrays& actual) {
    constexpr double kEps = 6e-8, kSpeed = 5.0, kReach = 12.0;  // [m/s], [m]
    const double velocity_bound = 256 * kEps * kSpeed,
                 position_bound = step * velocity_bound + 4 * kEps * kReach;
    const cpu::Nodes<double> expected = respond_to_self_on_cpu<double>(model, settings, step);
    return worst_node_error(expected, actual, position_bound, velocity_bound);
}

}  // namespace gelatin::test
