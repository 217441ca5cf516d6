#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/stage_timer.h"
#include "cpu/contact/clear_bodies.h"
#include "cpu/contact/contact_aims.h"
#include "cpu/contact/contact_list.h"
#include "cpu/contact/detect_contacts.h"
#include "cpu/contact/eased_reaches.h"
#include "cpu/contact/guarded_move.h"
#include "cpu/nodes.h"
#include "cpu/object_pieces.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Of forces by displacements, with those at the start and those at the end of them [J].
struct Work {
    double here = 0.0, ahead = 0.0;
};

/// How bodies make a part of a rotation.
enum class Turning {
    straight,  ///< nodes go straight to where it ends: bodies get smaller
    in_part,   ///< by that part of its angle, in shape
};

/// The contacts of bodies in the steps of vertex block descent (docs/contact.md): which pairs are near,
/// aimed at where the nodes are, and the guard of every move.
template <class Real>
class Contacts {
public:
    Contacts(std::shared_ptr<const Model> model, const CollisionSettings& collision);

    /// Forgets what was, because nodes were set from outside. @pre no faces of two bodies overlap there
    void restart(std::span<const Vec4<Real>> positions);

    /// Begins a run, where nothing has moved yet: what is nearer than it presses is eased apart.
    void start();
    /// Goes on with that: another `seconds` have gone by.
    void ease(double seconds);

    /// Whether the object pressed another one when the last step ended.
    bool was_pressed(std::size_t object) const { return is_pressed_[object] != 0; }

    /// By body: whether it pressed another object when the last step ended, or may do so on these motions of
    /// bodies [m]. @pre list() is valid
    std::vector<std::uint8_t> find_meeting(std::span<const Vec3<Real>> motions) const;

    /// Where a held node is when a step begins: where the last one ended; of a belt, from where its velocity
    /// would take it there [m].
    Vec3<Real> came_from(std::uint32_t node, Real step) const {
        const std::size_t o = object_of_[node], bodies = model_->body_count();
        const Vec3<Real> place(safe_[node]);
        return o < bodies ? place : place - step * Vec3<Real>(model_->surfaces[o - bodies].velocity);
    }

    /// Goes to where bodies were put between steps, as far as that is safe.
    /// @param targets and starts as for begin(), of where they were put
    /// @param nodes input: so; output: where they are
    void follow(Real step, std::span<const Vec4<Real>> targets, std::span<const Vec4<Real>> starts,
                Nodes<Real>& nodes, StageTimer* timer);

    /// Whether a step of `step` seconds may be tried without contacts, since nothing is near anything else.
    /// @param nodes that it begins with
    bool are_apart(Real step, const Nodes<Real>& nodes, StageTimer* timer);
    /// Ends a step that was made so. @param positions where it leads
    /// @return false if bodies may have met on the way: then it has to be made again, with contacts
    bool end_apart(std::span<const Vec4<Real>> positions, StageTimer* timer);

    /// Begins a step: goes from where the last one ended as far to a first guess as that is safe. Before
    /// sweeps, renew() has to follow.
    /// @param targets as in StepState; they and `starts` must stay where they are until the end of the step
    /// @param positions input: the guess; output: where the sweeps begin
    void begin(Real step, std::span<const Vec4<Real>> targets, std::span<const Vec4<Real>> starts,
               std::span<Vec4<Real>> positions, StageTimer* timer);

    /// Finds how far the nodes of bodies that others kept from the guess of begin() may go on to it.
    /// @param displacements output [m], shape [nodes]
    /// @return false if nothing is behind
    bool plan_rest(std::span<const Vec4<Real>> positions, std::span<Vec3<Real>> displacements,
                   StageTimer* timer);
    /// Goes on so. @param parts of the displacements that objects make, if others let them
    void go_on(std::span<const Real> parts, std::span<Vec4<Real>> positions);

    /// Moves all bodies to `ends`, as far as that is safe. Aims are out of date after it.
    /// @param targets where nodes would go if nothing pressed them [m]
    /// @param near where rooms keep an object that goes to its target by this or its thickness, they are made
    /// anew [m]
    /// @param ends input; output: outside of planes, and other than they were where bodies turn in part
    void move(std::span<const Vec4<Real>> targets, double near, std::span<Vec4<Real>> ends,
              std::span<Vec4<Real>> positions, Turning turning, StageTimer* timer);

    /// Aims at the present positions for sweeps, and detects before if nodes have come far.
    void renew(std::span<const Vec4<Real>> positions, StageTimer* timer);

    /// Whether no body that is clear of itself has met itself in the step. @param positions where it leads
    /// @return false if one may have: then the step has to be made again
    bool stay_clear(std::span<const Vec4<Real>> positions, StageTimer* timer);
    void end(std::span<const Vec4<Real>> positions);

    /// Handles with nodes that are farther from where their poses have them than surfaces reach.
    std::vector<std::uint32_t> held_up(std::span<const HandlePose> poses,
                                       std::span<const Vec4<Real>> positions) const;

    const ContactList<Real>& list() const { return list_; }
    const ContactAims<Real>& aims() const { return aims_; }
    /// Of a body's surface [m], and the least of all bodies'.
    double thickness(std::size_t object) const { return surface_->thicknesses[object]; }
    std::span<const double> thicknesses() const { return surface_->thicknesses; }
    /// What contacts held when the last step ended: of each pair of bodies half for each, of a
    /// body with itself or a collider all [J].
    double energy(std::size_t object) const { return energies_[object]; }
    bool is_held(std::size_t object) const { return guard_.is_held(object); }
    double restitution(std::uint32_t object, std::uint32_t other) const {
        return surface_->touch(object, other).restitution;
    }

    /// The work of contacts by displacements of nodes, for each object.
    std::vector<Work> works(std::span<const Vec4<Real>> positions,
                            std::span<const Vec3<Real>> displacements) const;

    /// For sweeps on a device. @param limits output: of the last aim
    void write_limits(ContactLimits& limits) const { aims_.nodes().write(list_, limits); }

    /// Whether contacts add terms to a node.
    bool presses(std::uint32_t node) const { return aims_.nodes().presses(node); }
    void add(std::uint32_t node, const Vec3<Real>& position, NodeTerms<Real>& terms) const {
        aims_.nodes().add(node, position, terms);
    }
    /// Where a node may go (NodeContacts::limited).
    Vec3<Real> limited(std::uint32_t node, const Vec3<Real>& from, const Vec3<Real>& to,
                       const NodeTerms<Real>& all) const {
        return aims_.nodes().limited(list_, node, from, to, all);
    }
    Real allowed_part(const Range& nodes, std::span<const Vec4<Real>> positions,
                      std::span<const Vec3<Real>> displacements, Real part) const {
        return aims_.nodes().allowed_part(list_, nodes, positions, displacements, part);
    }

private:
    Vec4<Real> outside(const Vec4<Real>& position) const;
    void find_clear_bodies();
    bool is_near_itself(std::uint32_t object) const;
    // @param few objects that may be short of room
    void detect_where_needed(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                             std::size_t few, StageTimer* timer);
    std::size_t few_objects() const;
    void set_longest(std::span<const Vec4<Real>> ends, std::span<const Vec4<Real>> positions);
    bool lacks_room_for(std::span<const Vec4<Real>> targets, double near,
                        std::span<const Vec4<Real>> ends) const;
    bool turn_in_part(std::span<const Vec4<Real>> positions, std::span<std::uint8_t> is_rigid,
                      std::span<Vec4<Real>> ends) const;
    std::vector<std::uint8_t> find_staying(std::span<const Vec4<Real>> positions) const;
    bool is_restless(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    bool any_restless(std::span<const Vec4<Real>> positions) const;
    bool look_at_restless(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                          StageTimer* timer);
    // @param ends where nodes are expected to go; empty: nowhere
    void detect(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends, StageTimer* timer);
    bool uses_own_room(std::uint32_t object, std::span<const Vec4<Real>> positions);
    template <class IsOne, class PlacesOf>
    bool detect_own(std::span<const Vec4<Real>> positions, const IsOne& is_one, const PlacesOf& places_of,
                    StageTimer* timer);
    template <class Uses>
    std::vector<std::uint32_t> restless_places(std::uint32_t object, const Uses& uses) const;
    void take_over_pairs();
    void aim(std::span<const Vec4<Real>> positions, AimFor use, StageTimer* timer);
    template <class Value>
    Real greatest_at_nodes(const Value& value);
    Real used_room(std::span<const Vec4<Real>> positions);

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::optional<ClearBodies<Real>> clear_;  // of themselves; none: bodies may pass through themselves
    std::vector<std::uint32_t> object_of_;    // by node
    DetectContacts<Real> detection_;
    ContactList<Real> list_;
    std::vector<ContactPair> old_pairs_;
    ContactAims<Real> aims_;
    EasedReaches<Real> eased_;
    GuardedMove<Real> guard_;
    bool is_aimed_ = false;  // at some positions of this step or the last one
    double longest_ = 0.0;   // motion of a node in this step's guess [m]
    std::vector<Vec4<Real>> safe_, guess_, ends_;
    std::vector<std::uint8_t> is_pressed_;  // by object
    std::vector<double> energies_;          // of contacts, by object [J]
    ObjectPieces pieces_;                   // of surface nodes
    std::vector<Real> greatest_;            // of something, by object
};

}  // namespace gelatin::cpu
