#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/contact/contact_pair.h"
#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/joint_rows.h"
#include "cpu/nodes.h"
#include "model/drive/attachment.h"
#include "model/model.h"

namespace gelatin::cpu {

/// The rows of attachments, one a tie, what these exert, and which are broken.
template <class Real>
class AttachmentRows {
public:
    explicit AttachmentRows(std::shared_ptr<const Model> model);

    /// In place of all that there were. What the first ones exert is known, if it was.
    void set(const std::vector<Attachment>& attachments);
    std::size_t count() const { return attachments_.size(); }
    bool is_broken(std::size_t attachment) const { return forces_[attachment].is_broken != 0; }
    /// @param nodes at present
    std::vector<AttachmentForce> forces(const Nodes<Real>& nodes) const;
    void archive(Archive& archive) { archive.array(forces_); }
    /// What they exert; not which are broken.
    void forget() {
        for (auto& of : forces_) {
            const std::uint64_t is_broken = of.is_broken;
            of = {};
            of.is_broken = is_broken;
        }
    }

    /// What ties one of these nodes to the other side, if anything does and is not broken.
    const Attachment* attachment_at(const ContactPair& pair) const;
    bool is_tied_to_plane(std::uint32_t node, std::uint32_t plane) const;
    /// Of each body the least one that it is attached to, by others or not.
    std::vector<std::uint32_t> groups() const;
    /// Objects of attachments that motors move, or hold against something: they do not rest. Motors at a
    /// speed of 0 do not move them.
    std::vector<std::uint32_t> moved_by(std::span<const MotorTarget> motors) const;
    /// What moves by keyframes waits where what is tied to it cannot follow: where a tie is stretched by more
    /// than the thickness of its object. @param positions where a step ends @param thicknesses of objects [m]
    /// @param is_blocked objects; output: these, too @return whether there are more
    bool block_held(std::span<const Vec4<Real>> positions, std::span<const double> thicknesses,
                    std::vector<std::uint8_t>& is_blocked) const;
    /// When a step begins.
    struct Start {
        std::span<const Vec4<Real>> positions;     ///< [m]
        std::span<const Vec3<Real>> expected;      ///< displacements in the step without forces [m]
        std::span<const Real> compliances;         ///< as in ContactRows::Start
        std::span<const std::uint8_t> asleep;      ///< bodies
        std::span<const MotorTarget> motors = {};  ///< by attachment, or empty
        Real step;                                 ///< its length [s]
    };
    /// Adds those that are not broken, but for bodies asleep.
    void add(const Start& start, std::vector<ContactRow<Real>>& rows);
    /// What they exert at the end of a step. @param slips of rows, s [m] @param step its length [s]
    void note(std::span<const ContactRow<Real>> rows, std::span<const Vec3<Real>> slips, double step,
              std::span<const std::uint8_t> asleep);
    /// Breaks those that would exert more than they can in this step. @return whether there are any
    bool break_pulled();
    /// The step was made.
    void end_step() {
        for (State& state : forces_) state.last_motor = state.motor;
    }

private:
    struct State {
        glm::dvec3 force{0.0};  // on its object [N]
        double effort = 0.0;    // [N m] or [N]
        std::uint64_t is_broken = 0;
        MotorMemory last_motor, motor = {};
    };
    // That a node is tied to an object, or to a plane: these have the numbers after objects.
    struct Tied {
        std::uint32_t node, to, attachment;
    };

    const Attachment* find_tie(std::uint32_t node, std::uint32_t to) const;
    ContactRow<Real> row_of(const Tie& tie, const ContactRow<Real>& blank, const Start& start) const;
    Real stiffness_of(const ContactRow<Real>& row, std::span<const Real> compliances, Real shared) const;

    std::shared_ptr<const Model> model_;
    std::vector<Attachment> attachments_;
    std::vector<State> forces_;
    std::vector<Vec3<Real>> axes_;        // of joints in this step: of a force, what its effort is
    std::vector<std::uint8_t> has_ties_;  // nodes
    std::vector<Tied> tied_;              // by node
};

}  // namespace gelatin::cpu
