#include "cpu/collision/respond_to_self.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

#include "model/solver.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kElementsATask = 1024;

template <class Work>
void for_all(std::size_t count, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(count), kElementsATask),
                      [&](const auto& range) {
                          for (std::uint32_t k = range.begin(); k < range.end(); ++k) work(k);
                      });
}

template <class Real>
std::uint32_t count_colliding(const NodeFaces& around, const FindSelfCollisions<Real>& collision,
                              std::uint32_t node) {
    std::uint32_t count = 0;
    for (std::uint32_t k = around.starts[node]; k < around.starts[node + 1]; ++k)
        count += collision.collides(around.faces[k]) ? 1 : 0;
    return count;
}

template <class Real>
FaceLump<Real> make_lump(const Model& model, const FindSelfCollisions<Real>& collision, std::uint32_t f,
                         const Nodes<Real>& previous, const Nodes<Real>& current) {
    const Face& face = model.faces[f];
    FaceLump<Real> lump;
    for (const std::uint32_t n : {face.a, face.b, face.c}) {
        const Vec4<Real>& position = current.positions[n];
        lump.center += Vec3<Real>(position) / Real(3);
        if (position.w == Real(0)) continue;
        const Real shares = static_cast<Real>(count_colliding(model.node_faces, collision, n));
        const Real mass = Real(1) / (position.w * shares);
        lump.mass += mass;
        lump.velocity += mass * Vec3<Real>(current.velocities[n]);
        lump.displacement += mass * Vec3<Real>(position - previous.positions[n]);
    }
    if (lump.mass > Real(0)) {
        lump.velocity /= lump.mass;
        lump.displacement /= lump.mass;
    } else {
        for (const std::uint32_t n : {face.a, face.b, face.c}) {
            lump.velocity += Vec3<Real>(current.velocities[n]) / Real(3);
            lump.displacement += Vec3<Real>(current.positions[n] - previous.positions[n]) / Real(3);
        }
    }
    lump.mass /= static_cast<Real>(collision.contact_count(f));
    const Vec3<Real> a(current.positions[face.a]);
    const Vec3<Real> area =
        glm::cross(Vec3<Real>(current.positions[face.b]) - a, Vec3<Real>(current.positions[face.c]) - a);
    const Real length = glm::length(area);
    if (length > Real(0)) lump.normal = area / length;
    return lump;
}

}  // namespace

template <class Real>
RespondToSelf<Real>::RespondToSelf(std::shared_ptr<const Model> model, const ContactProperties& properties)
    : model_(std::move(model)),
      properties_(properties),
      lumps_(model_->faces.size()),
      responses_(model_->faces.size()) {}

template <class Real>
void RespondToSelf<Real>::run(const FindSelfCollisions<Real>& collision, Real step,
                              const Nodes<Real>& previous, Nodes<Real>& current) {
    if (!collision.any()) return;
    const auto resting = static_cast<Real>(resting_speed(model_->gravity, static_cast<double>(step)));
    for_all(model_->faces.size(), [&](std::uint32_t f) {
        if (collision.collides(f)) lumps_[f] = make_lump(*model_, collision, f, previous, current);
    });
    for_all(model_->faces.size(), [&](std::uint32_t f) {
        if (!collision.collides(f)) return;
        LumpResponse<Real> sum;
        collision.for_contacts(current.positions, f, [&](std::uint32_t other) {
            const LumpResponse<Real> response = self_response(lumps_[f], lumps_[other], properties_, resting);
            sum.velocity += response.velocity;
            sum.displacement += response.displacement;
        });
        const auto count = static_cast<Real>(collision.contact_count(f));
        responses_[f] = {sum.velocity / count, sum.displacement / count};
    });
    const NodeFaces& around = model_->node_faces;
    for_all(current.positions.size(), [&](std::uint32_t n) {
        const std::uint32_t shares = count_colliding(around, collision, n);
        if (shares == 0 || current.positions[n].w == Real(0)) return;
        LumpResponse<Real> sum;
        for (std::uint32_t k = around.starts[n]; k < around.starts[n + 1]; ++k) {
            if (!collision.collides(around.faces[k])) continue;
            sum.velocity += responses_[around.faces[k]].velocity;
            sum.displacement += responses_[around.faces[k]].displacement;
        }
        current.velocities[n] += Vec4<Real>(sum.velocity / static_cast<Real>(shares), 0);
        current.positions[n] += Vec4<Real>(sum.displacement / static_cast<Real>(shares), 0);
    });
}

template class RespondToSelf<float>;
template class RespondToSelf<double>;

}  // namespace gelatin::cpu
