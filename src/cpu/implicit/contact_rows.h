#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/archive.h"
#include "cpu/implicit/attachment_rows.h"
#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/find_pairs.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Makes the contacts of a step, of pairs and of planes, and knows what each held when the last step ended.
template <class Real>
class ContactRows {
public:
    /// When a step begins.
    struct Start {
        std::span<const Vec4<Real>> positions;  ///< [m]
        std::span<const Vec3<Real>> expected;   ///< displacements without forces of elements and contacts [m]
        std::span<const Real> compliances;  ///< 1 / h of contacts, 0 for held nodes [m/N]; all shape [nodes]
        Real step, last_step;               ///< lengths [s]
    };

    ContactRows(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// @param pairs that were found for the step @param attachments near their ties bodies press later
    /// @param rows output
    void make(const Start& start, std::span<const NearPair<Real>> pairs,
              const AttachmentRows<Real>& attachments, std::vector<ContactRow<Real>>& rows);
    /// What contacts hold now, which remember() makes what they held before. @param displacements of nodes
    /// [m] @param asleep bodies whose contacts, which have no rows, hold what they held
    void note(std::span<const ContactRow<Real>> rows, std::span<const Vec3<Real>> displacements,
              std::span<const std::uint8_t> asleep);
    void remember() { std::swap(memory_, noted_); }
    void forget() { memory_.clear(); }
    void archive(Archive& archive) { archive.list(memory_); }

private:
    // What a contact passes on to the next step.
    struct Memory {
        std::uint64_t key;
        std::uint32_t object, other;
        Vec3<Real> hold;
        Real limit, reach, ease;
    };

    void add(const Start& start, ContactRow<Real> row, Real weight, Real first, Real second,
             std::vector<ContactRow<Real>>& rows);
    Real gap_in(const std::vector<glm::vec4>& positions, const ContactPair& pair) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<Memory> memory_, noted_;  // by key
    std::vector<std::uint32_t> new_rows_;
    // Of the contacts of two objects that the last step had, the least gap, as a part of the reach.
    std::map<std::pair<std::uint32_t, std::uint32_t>, Real> nearest_gaps_;
};

}  // namespace gelatin::cpu
