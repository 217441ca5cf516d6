#include "cpu/implicit/attachment_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/disjoint_sets.h"
#include "cpu/contact/tuning.h"
#include "cpu/implicit/joint_rows.h"

namespace gelatin::cpu {

template <class Real>
AttachmentRows<Real>::AttachmentRows(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

template <class Real>
void AttachmentRows<Real>::set(const std::vector<Attachment>& attachments) {
    attachments_ = attachments;
    forces_.resize(attachments_.size());
    axes_.resize(attachments_.size());
    for (std::size_t a = 0; a < attachments_.size(); ++a)
        forces_[a].is_broken = attachments_[a].is_broken ? 1 : 0;
    has_ties_.assign(attachments_.empty() ? 0 : model_->node_count(), 0);
    tied_.clear();
    for (std::uint32_t a = 0; a < attachments_.size(); ++a) {
        const Attachment& attachment = attachments_[a];
        const Range& own = model_->objects[attachment.object].nodes;
        const std::uint32_t to_other =
            attachment.plane == kNoNode
                ? attachment.other
                : static_cast<std::uint32_t>(model_->objects.size()) + attachment.plane;
        if (to_other == kNoNode) continue;
        for (const Tie& tie : attachment.ties)
            for (std::uint32_t k = 0; k < tie.count; ++k) {
                const std::uint32_t node = tie.nodes[k];
                const bool is_own = node >= own.first && node < own.end();
                tied_.push_back({node, is_own ? to_other : attachment.object, a});
                has_ties_[node] = 1;
            }
    }
    std::sort(tied_.begin(), tied_.end(), [](const Tied& a, const Tied& b) { return a.node < b.node; });
}

template <class Real>
std::vector<AttachmentForce> AttachmentRows<Real>::forces(const Nodes<Real>& nodes) const {
    const std::span<const Vec4<Real>> positions = nodes.positions, velocities = nodes.velocities;
    std::vector<AttachmentForce> forces;
    for (std::size_t a = 0; a < forces_.size(); ++a) {
        const Joint& joint = attachments_[a].joint;
        forces.push_back({.force = forces_[a].force,
                          .effort = forces_[a].effort,
                          .is_broken = forces_[a].is_broken != 0,
                          .has_coordinate = joint.has_coordinate()});
        if (!joint.has_coordinate()) continue;
        const Frame own = frame_of(joint.own, positions), other = frame_of(joint.other, positions);
        forces[a].coordinate = coordinate(joint, own, other);
        forces[a].speed = coordinate_speed(joint, own, other, frame_of(joint.own, velocities, false),
                                           frame_of(joint.other, velocities, false));
    }
    return forces;
}

template <class Real>
const Attachment* AttachmentRows<Real>::find_tie(std::uint32_t node, std::uint32_t to) const {
    if (has_ties_[node] == 0) return nullptr;
    auto at = std::lower_bound(tied_.begin(), tied_.end(), node,
                               [](const Tied& tied, std::uint32_t n) { return tied.node < n; });
    for (; at != tied_.end() && at->node == node; ++at)
        if (at->to == to && !is_broken(at->attachment)) return &attachments_[at->attachment];
    return nullptr;
}

template <class Real>
const Attachment* AttachmentRows<Real>::attachment_at(const ContactPair& pair) const {
    if (attachments_.empty()) return nullptr;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t to = pair.side_of(k) == 0 ? pair.other : pair.object;
        if (const Attachment* attachment = find_tie(pair.nodes[k], to)) return attachment;
    }
    return nullptr;
}

template <class Real>
bool AttachmentRows<Real>::is_tied_to_plane(std::uint32_t node, std::uint32_t plane) const {
    return !attachments_.empty() &&
           find_tie(node, static_cast<std::uint32_t>(model_->objects.size()) + plane) != nullptr;
}

template <class Real>
std::vector<std::uint32_t> AttachmentRows<Real>::groups() const {
    DisjointSets sets(model_->body_count());
    for (std::size_t a = 0; a < attachments_.size(); ++a)
        if (const std::uint32_t other = attachments_[a].other;
            !is_broken(a) && other != kNoNode && model_->is_body(other))
            sets.unite(attachments_[a].object, other);
    std::vector<std::uint32_t> groups(model_->body_count());
    for (std::uint32_t o = 0; o < groups.size(); ++o) groups[o] = sets.least(o);
    return groups;
}

template <class Real>
std::vector<std::uint32_t> AttachmentRows<Real>::moved_by(std::span<const MotorTarget> motors) const {
    std::vector<std::uint32_t> moved;
    for (std::size_t a = 0; a < motors.size(); ++a)
        if (motors[a].acts && !is_broken(a) && motors[a].speed != 0.0)
            moved.push_back(attachments_[a].object);
    return moved;
}

// It is like friction that never slides: it holds in all directions, from where its points should be.
template <class Real>
ContactRow<Real> AttachmentRows<Real>::row_of(const Tie& tie, const ContactRow<Real>& blank,
                                              const Start& start) const {
    ContactRow<Real> row = blank;
    row.count = tie.count;
    const bool is_in_space = attachments_[row.attachment].is_in_space;
    const Vec3<Real> origin = is_in_space ? Vec3<Real>(tie.at) : Vec3<Real>(start.positions[tie.nodes[0]]);
    Vec3<Real> apart(0);
    for (std::uint32_t k = 0; k < tie.count; ++k) {
        row.nodes[k] = tie.nodes[k];
        row.weights[k] = static_cast<Real>(tie.weights[k]);
        apart += row.weights[k] * (Vec3<Real>(start.positions[tie.nodes[k]]) - origin);
    }
    row.hold = apart;  // for 1 N/m
    return row;
}

// Of what does not yield but by its nodes. @param shared compliance of its own [m/N] @return 0: none is free
template <class Real>
Real AttachmentRows<Real>::stiffness_of(const ContactRow<Real>& row, std::span<const Real> compliances,
                                        Real shared) const {
    // Of rigid bodies: of a length that steps with them usually have, as energy comes from stiffness that
    // changes.
    constexpr double kPart = tuning::kFrame / tuning::kPartsOfMoving;
    constexpr auto kOfMass = static_cast<Real>(kPart * kPart * tuning::kTied / tuning::kRigidTied);
    Real yield = 0;
    for (std::uint32_t k = 0; k < row.count; ++k) {
        const Real w = row.weights[k], compliance = compliances[row.nodes[k]];
        const ModelObject& object = model_->objects[model_->node_objects[row.nodes[k]]];
        yield +=
            w * w *
            (object.is_rigid && compliance > Real(0) ? kOfMass / static_cast<Real>(object.mass) : compliance);
    }
    return yield > Real(0) ? Real(1) / (yield / static_cast<Real>(tuning::kTied) + shared) : Real(0);
}

template <class Real>
void AttachmentRows<Real>::add(const Start& start, std::vector<ContactRow<Real>>& rows) {
    for (std::uint32_t a = 0; a < attachments_.size(); ++a) {
        const Attachment& attachment = attachments_[a];
        if (is_broken(a) || start.asleep[attachment.object] != 0) continue;
        ContactRow<Real> blank;
        blank.attachment = a;
        blank.object = attachment.other;
        blank.other = attachment.object;
        blank.gap = blank.limit = std::numeric_limits<Real>::max();
        const auto compliance = static_cast<Real>(attachment.compliance);
        for (const Tie& tie : attachment.ties) {
            ContactRow<Real> row = row_of(tie, blank, start);
            row.stiffness =
                stiffness_of(row, start.compliances, compliance * static_cast<Real>(attachment.ties.size()));
            if (!(row.stiffness > Real(0))) continue;
            row.hold *= row.stiffness;
            rows.push_back(row);
        }
        if (attachment.joint.kind == Joint::Kind::none) continue;
        const JointRows<Real> joint(attachment, start.positions, start.expected);
        axes_[a] = static_cast<Real>(joint.scale()) * joint.axis();
        joint.add(
            start.motors.empty() ? MotorTarget() : start.motors[a], forces_[a].last_motor,
            static_cast<double>(start.step), blank,
            [&](const ContactRow<Real>& row) { return stiffness_of(row, start.compliances, compliance); },
            rows);
    }
}

template <class Real>
void AttachmentRows<Real>::note(std::span<const ContactRow<Real>> rows, std::span<const Vec3<Real>> slips,
                                double step, std::span<const std::uint8_t> asleep) {
    for (std::size_t a = 0; a < attachments_.size(); ++a)
        if (!is_broken(a) && asleep[attachments_[a].object] == 0)
            forces_[a] = {.is_broken = forces_[a].is_broken, .last_motor = forces_[a].last_motor};
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const ContactRow<Real>& row = rows[r];
        if (!row.is_tie()) continue;
        const Vec3<Real> force = row.force(slips[r]);
        if (!row.is_couple) forces_[row.attachment].force += glm::dvec3(force);
        if (row.is_along)
            forces_[row.attachment].effort += static_cast<double>(glm::dot(force, axes_[row.attachment]));
        if (!row.is_motor) continue;
        auto& [held, speed, acceleration] = forces_[row.attachment].motor;
        const MotorMemory& last = forces_[row.attachment].last_motor;
        held = -static_cast<double>(glm::dot(force, row.normal));
        speed = static_cast<double>(glm::dot(slips[r] + row.target, row.normal)) / step;
        // How fast it can stop is known when all of its force moves it, and nothing blocks it.
        const double wanted = static_cast<double>(glm::dot(row.target, row.normal)) / step;
        const double most = 0.999 * static_cast<double>(row.limit), least = 0.05 * std::abs(wanted);
        const bool is_enough = std::abs(held) < most;
        const bool goes = std::abs(speed) > least && (speed - last.speed) * (wanted - last.speed) > 0.0;
        acceleration = is_enough || !goes ? last.acceleration : std::abs(speed - last.speed) / step;
    }
}

template <class Real>
bool AttachmentRows<Real>::block_held(std::span<const Vec4<Real>> positions,
                                      std::span<const double> thicknesses,
                                      std::vector<std::uint8_t>& is_blocked) const {
    bool any = false;
    for (std::size_t a = 0; a < attachments_.size(); ++a) {
        const Attachment& attachment = attachments_[a];
        if (is_broken(a) || attachment.compliance > 0.0f || attachment.is_in_space) continue;
        for (const Tie& tie : attachment.ties) {
            const Vec3<Real> origin(positions[tie.nodes[0]]);
            Vec3<Real> apart(0);
            for (std::uint32_t k = 0; k < tie.count; ++k)
                apart += static_cast<Real>(tie.weights[k]) * (Vec3<Real>(positions[tie.nodes[k]]) - origin);
            if (!(static_cast<double>(glm::length(apart)) > thicknesses[attachment.object])) continue;
            for (std::uint32_t k = 0; k < tie.count; ++k) {
                if (positions[tie.nodes[k]].w != Real(0)) continue;
                std::uint8_t& blocked = is_blocked[model_->node_objects[tie.nodes[k]]];
                any = any || blocked == 0;
                blocked = 1;
            }
        }
    }
    return any;
}

template <class Real>
bool AttachmentRows<Real>::break_pulled() {
    bool any = false;
    for (std::size_t a = 0; a < attachments_.size(); ++a) {
        if (is_broken(a) ||
            !(glm::length(forces_[a].force) > static_cast<double>(attachments_[a].break_force)))
            continue;
        forces_[a].is_broken = 1;
        any = true;
    }
    return any;
}

template class AttachmentRows<float>;
template class AttachmentRows<double>;

}  // namespace gelatin::cpu
