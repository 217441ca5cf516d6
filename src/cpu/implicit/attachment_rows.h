#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/contact/contact_pair.h"
#include "cpu/implicit/contact_row.h"
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

    /// If two sides are tied together at one of these nodes, where all nodes were when that was done [m];
    /// else null.
    const std::vector<glm::vec4>* positions_when_tied(const ContactPair& pair) const;
    bool is_tied_to_plane(std::uint32_t node, std::uint32_t plane) const;
    /// Of each body the least one that it is attached to, by others or not.
    std::vector<std::uint32_t> groups() const;
    /// Adds those that are not broken, but for bodies asleep.
    /// @param positions when a step begins [m] @param compliances as in ContactRows::Start
    void add(std::span<const Vec4<Real>> positions, std::span<const Real> compliances,
             std::span<const std::uint8_t> asleep, std::vector<ContactRow<Real>>& rows) const;
    /// What they exert at the end of a step. @param displacements of nodes [m]
    void note(std::span<const ContactRow<Real>> rows, std::span<const Vec3<Real>> displacements,
              std::span<const std::uint8_t> asleep);
    /// Breaks those that exert more than they can.
    void break_overloaded();

private:
    struct State {
        glm::dvec3 force{0.0};  // on its object [N]
        double effort = 0.0;    // [N m] or [N]
        std::uint64_t is_broken = 0;
    };
    // That a node is tied to an object, or to a plane: these have the numbers after objects.
    struct Tied {
        std::uint32_t node, to, attachment;
    };

    const Attachment* find_tie(std::uint32_t node, std::uint32_t to) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> object_of_;
    std::vector<Attachment> attachments_;
    std::vector<State> forces_;
    std::vector<std::uint8_t> has_ties_;  // nodes
    std::vector<Tied> tied_;              // by node
};

}  // namespace gelatin::cpu
