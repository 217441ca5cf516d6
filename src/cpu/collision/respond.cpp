#include "cpu/collision/respond.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vector>

#include "model/solver.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kNodesATask = 1024;

// The input of all stages of a response.
template <class Real>
struct Contacts {
    const Model& model;
    const Collision<Real>& collision;
    const Nodes<Real>& nodes;
    std::vector<std::uint32_t> shares{};  // colliding faces of each node, over all objects that it touches

    void count_shares() {
        shares.assign(model.node_count(), 0);
        for_nodes_in_pairs([this](std::uint32_t n, const Range& row) {
            for (std::uint32_t p = row.first; p < row.end(); ++p)
                shares[n] += colliding_faces(n, collision.pairs()[p]);
        });
    }

    // work(node, its object's row of pairs)
    template <class Work>
    void for_nodes_in_pairs(const Work& work) const {
        const auto objects = static_cast<std::uint32_t>(model.objects.size());
        tbb::parallel_for(std::uint32_t(0), objects, [&](std::uint32_t o) {
            const Range row = collision.row(o);
            if (row.count == 0) return;
            const Range& range = model.objects[o].nodes;
            tbb::parallel_for(tbb::blocked_range<std::uint32_t>(range.first, range.end(), kNodesATask),
                              [&](const auto& part) {
                                  for (std::uint32_t n = part.begin(); n < part.end(); ++n) work(n, row);
                              });
        });
    }

    std::uint32_t colliding_faces(std::uint32_t node, const ObjectPair& pair) const {
        const NodeFaces& around = model.node_faces;
        std::uint32_t count = 0;
        for (std::uint32_t k = around.starts[node]; k < around.starts[node + 1]; ++k) {
            count += collision.collides(pair, around.faces[k]) ? 1 : 0;
        }
        return count;
    }

    // work(node, share of its mass [kg]; 0 if it is pinned) for each corner of the pair's colliding faces.
    template <class Work>
    void for_corners(const ObjectPair& pair, const Work& work) const {
        const Range& faces = model.objects[pair.object].faces;
        for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
            if (!collision.collides(pair, f)) continue;
            const Face& face = model.faces[f];
            for (const std::uint32_t n : {face.a, face.b, face.c}) {
                const Real inverse_mass = nodes.positions[n].w;
                work(n, inverse_mass > Real(0) ? Real(1) / (inverse_mass * static_cast<Real>(shares[n]))
                                               : Real(0));
            }
        }
    }

    Vec3<Real> area_normal(const Face& face) const {
        const Vec3<Real> a(nodes.positions[face.a]);
        return Real(0.5) *
               glm::cross(Vec3<Real>(nodes.positions[face.b]) - a, Vec3<Real>(nodes.positions[face.c]) - a);
    }
};

template <class Real>
ContactPatch<Real> sum_patch(const Contacts<Real>& contacts, const ObjectPair& pair) {
    ContactPatch<Real> patch;
    const Range& faces = contacts.model.objects[pair.object].faces;
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
        if (!contacts.collision.collides(pair, f)) continue;
        const Real weight = contacts.collision.contact(pair, f) == FaceContact::enters
                                ? Real(1)
                                : static_cast<Real>(kWeightOfOthers);
        patch.area_normal += weight * contacts.area_normal(contacts.model.faces[f]);
    }
    contacts.for_corners(pair, [&](std::uint32_t n, Real mass) {
        const Vec3<Real> velocity(contacts.nodes.velocities[n]);
        if (mass == Real(0)) {
            ++patch.pinned;
            patch.held += velocity;
        }
        patch.mass += mass;
        patch.momentum += mass * velocity;
    });
    return patch;
}

template <class Real>
ApproachSums<Real> sum_approach(const Contacts<Real>& contacts, const ObjectPair& pair,
                                const ContactPlane<Real>& plane) {
    ApproachSums<Real> sums;
    contacts.for_corners(pair, [&](std::uint32_t n, Real mass) {
        const Vec3<Real> velocity(contacts.nodes.velocities[n]);
        const Real approach = glm::dot(velocity - plane.velocity, plane.normal);
        if (approach <= Real(0)) return;
        sums.mass += mass;
        sums.momentum += mass * velocity;
        sums.impulse += mass * approach;
    });
    return sums;
}

template <class Real>
std::vector<ContactResponse<Real>> plan_responses(const Contacts<Real>& contacts,
                                                  const ContactProperties& properties, Real still_speed) {
    const Collision<Real>& collision = contacts.collision;
    const std::vector<ObjectPair>& pairs = collision.pairs();
    std::vector<ContactPatch<Real>> patches(pairs.size());
    std::vector<ContactPlane<Real>> planes(pairs.size());
    std::vector<ApproachSums<Real>> approaches(pairs.size());
    std::vector<ContactResponse<Real>> responses(pairs.size());
    const auto for_pairs = [&](const auto& work) {
        tbb::parallel_for(std::size_t(0), pairs.size(), [&](std::size_t p) { work(p, pairs[p]); });
    };
    for_pairs([&](std::size_t p, const ObjectPair& pair) { patches[p] = sum_patch(contacts, pair); });
    for_pairs([&](std::size_t p, const ObjectPair& pair) {
        planes[p] = contact_plane(patches[p], patches[pair.mirror],
                                  collision.bounding_boxes()[pair.other].center() -
                                      collision.bounding_boxes()[pair.object].center());
        approaches[p] = sum_approach(contacts, pair, planes[p]);
    });
    for_pairs([&](std::size_t p, const ObjectPair& pair) {
        responses[p] =
            contact_response(planes[p], approaches[p], approaches[pair.mirror], properties, still_speed);
    });
    return responses;
}

// A node that touches several objects responds to each in proportion to its number of colliding faces. It
// returns along the normal only, relative to the contact. If it were held in all directions in a frame at
// rest, its velocity would grow without motion.
template <class Real>
void respond_at_node(const Contacts<Real>& contacts, const std::vector<ContactResponse<Real>>& responses,
                     std::uint32_t node, const Range& row, Real step, const Vec4<Real>& previous_position,
                     Nodes<Real>& current) {
    const std::uint32_t shares = contacts.shares[node];
    if (shares == 0 || current.positions[node].w == Real(0)) return;
    const Vec3<Real> velocity(current.velocities[node]);
    const Vec3<Real> displacement(current.positions[node] - previous_position);
    Vec3<Real> change(0), way_back(0);
    for (std::uint32_t p = row.first; p < row.end(); ++p) {
        const std::uint32_t faces = contacts.colliding_faces(node, contacts.collision.pairs()[p]);
        const ContactResponse<Real>& response = responses[p];
        const Real approach = glm::dot(velocity - response.velocity, response.normal);
        if (faces == 0 || approach <= Real(0)) continue;
        const Real share = static_cast<Real>(faces) / static_cast<Real>(shares);
        change += share * (response.slowing - response.factor * approach * response.normal);
        const Real advance = glm::dot(displacement - step * response.velocity, response.normal);
        way_back -= share * std::max(advance, Real(0)) * response.normal;
    }
    current.positions[node] += Vec4<Real>(way_back, 0);
    current.velocities[node] += Vec4<Real>(change, 0);
}

}  // namespace

template <class Real>
void respond(const Model& model, const Collision<Real>& collision, const ContactProperties& properties,
             Real step, const Nodes<Real>& previous, Nodes<Real>& current) {
    const std::vector<ObjectPair>& pairs = collision.pairs();
    if (std::none_of(pairs.begin(), pairs.end(),
                     [&](const ObjectPair& pair) { return collision.collide(pair); })) {
        return;
    }
    Contacts<Real> contacts{model, collision, current};
    contacts.count_shares();
    const auto responses = plan_responses(
        contacts, properties, static_cast<Real>(resting_speed(model.gravity, static_cast<double>(step))));
    contacts.for_nodes_in_pairs([&](std::uint32_t n, const Range& row) {
        respond_at_node(contacts, responses, n, row, step, previous.positions[n], current);
    });
}

template void respond<float>(const Model&, const Collision<float>&, const ContactProperties&, float,
                             const Nodes<float>&, Nodes<float>&);
template void respond<double>(const Model&, const Collision<double>&, const ContactProperties&, double,
                              const Nodes<double>&, Nodes<double>&);

}  // namespace gelatin::cpu
