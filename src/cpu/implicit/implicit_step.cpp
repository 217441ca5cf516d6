#include "cpu/implicit/implicit_step.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "cpu/contact/tuning.h"
#include "model/contact/contact_force_sums.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
ImplicitStep<Real>::ImplicitStep(std::shared_ptr<const Model> model, const CollisionSettings& collision,
                                 bool contacts, bool own, int iterations)
    : model_(std::move(model)),
      surface_(std::make_shared<ContactSurface>(make_contact_surface(*model_, collision))),
      contacts_(contacts),
      own_(own),
      rigid_bodies_(model_),
      pairs_(model_, surface_, own),
      rows_(model_, surface_),
      attachments_(model_),
      guard_(model_, surface_),
      restitution_(model_, surface_),
      energy_(model_),
      system_(model_),
      scheme_(model_),
      paces_(model_),
      asleep_(model_->body_count()),
      held_counts_(model_->body_count()),
      compliances_(model_->node_count()),
      expected_(model_->node_count()),
      ends_(model_->node_count()) {
    system_.iterations = iterations;
    set_cavity_drives({});
}

template <class Real>
void ImplicitStep<Real>::restart() {
    energy_.forget();
    forget();
}

template <class Real>
void ImplicitStep<Real>::set_attachments(const std::vector<Attachment>& attachments) {
    attachments_.set(attachments);
    JoinedBodies joined;
    for (const Attachment& attachment : attachments)
        if (attachment.joint.kind != Joint::Kind::distance && attachment.other != kNoNode &&
            joins(*model_, attachment.object, attachment.other))
            joined.insert(std::minmax(attachment.object, attachment.other));
    pairs_.set_joined(std::move(joined));
}

template <class Real>
std::vector<std::uint32_t> ImplicitStep<Real>::set_cavity_drives(std::span<const double> drives) {
    std::vector<std::uint32_t> changed;
    cavity_drives_.resize(model_->cavities.size());
    for (std::size_t c = 0; c < cavity_drives_.size(); ++c) {
        const Cavity& cavity = model_->cavities[c];
        const double drive = drives.empty() ? cavity.drive_at(0.0, {}) : drives[c];
        if (std::exchange(cavity_drives_[c], drive) != drive) changed.push_back(cavity.object);
    }
    return changed;
}

template <class Real>
void ImplicitStep<Real>::forget() {
    rows_.forget();
    attachments_.forget();
    acting_.clear();
    pairs_.forget();
    parts_ = 1;
    scheme_.forget();
    restitution_.forget();
    paces_.forget();
}

template <class Real>
void ImplicitStep<Real>::archive(Archive& archive) {
    scheme_.archive(archive);
    archive.value(parts_);
    paces_.archive(archive);
    archive.array(held_counts_);
    rows_.archive(archive);
    attachments_.archive(archive);
    rigid_bodies_.archive(archive);
    restitution_.archive(archive);
    energy_.archive(archive);
    archive.array(cavity_drives_);
    archive.list(acting_);  // bodies asleep make no step that would find them again
}

template <class Real>
void ImplicitStep<Real>::go_on(const Nodes<Real>& nodes, std::span<const Vec4<Real>> earlier_velocities,
                               Real step) {
    scheme_.go_on(nodes, earlier_velocities, step);
    held_counts_ = count_held(nodes);
}

template <class Real>
Real ImplicitStep<Real>::run(const StepInput<Real>& wanted, Real shortest, Nodes<Real>& previous,
                             Nodes<Real>& current, StageTimer* timer) {
    StepInput<Real> input = wanted;
    shorten(input);
    scheme_.begin(previous);
    begin(input, previous);
    for (bool damps = false, has_past = false;;) {
        const bool is_shortest = input.step < Real(2) * shortest;
        const auto divide = [&] {
            damps = false;
            input.step *= Real(0.5);
        };
        {
            const TimedStage part(timer, "advance_nodes.detect");
            predict(input, previous);
            const bool is_found = damps || detect(previous, is_shortest);
            if (is_found) {
                rows_.make({previous.positions, expected_, compliances_, step_, scheme_.last_step()},
                           pairs_.pairs(), attachments_, system_.rows);
                attachments_.add({previous.positions, expected_, compliances_, asleep_, input.motors, step_},
                                 system_.rows);
            }
            if (wake_near(input, previous)) continue;
            parts_ = paces_.count_parts(system_.rows);
            if (is_found && shorten(input)) continue;
            if (!is_found || (!is_shortest && deepest() > static_cast<Real>(tuning::kDeepest))) {
                divide();
                continue;
            }
        }
        {
            const TimedStage part(timer, "advance_nodes.linearise");
            islands_.find<Real>(*model_, system_.rows, previous,
                                !input.load_forces.empty() || input.pulls != nullptr);
            has_past = paces_.choose(islands_, step_, damps || is_shortest, system_.rows, scheme_);
            find_targets(input, previous);
            linearise(input, previous);
        }
        if (!is_shortest && turns_far()) {
            divide();
            continue;
        }
        {
            const TimedStage part(timer, "advance_nodes.solve");
            system_.solve(islands_.of_bodies);
            solve_counts_ += system_.counts;
        }
        if (own_ && is_torn(is_shortest)) {
            divide();
            continue;
        }
        Field on_held;
        const auto gain = [&] {
            return energy_.measure({step_, input.load_forces, input.pulls, on_held, system_.rows,
                                    system_.displacements, islands_, asleep_, previous, current});
        };
        double gained = 0.0;
        {
            const TimedStage part(timer, "advance_nodes.finish");
            finish(input, previous, current);
            paces_.find(system_, asleep_, current);
            if (any_moves(previous, [&](std::uint32_t o) { return model_->is_body(o); }))
                on_held = system_.elastic_forces();
            gained = gain();
        }
        if (has_past && gained > 0.0) {
            damps = true;
            continue;
        }
        const TimedStage part(timer, "advance_nodes.guard");
        std::vector<std::uint32_t> stopped;  // bodies
        const std::vector<Vec4<Real>> before_guard = current.positions;
        const Field solved = system_.displacements;
        if (guard(previous, before_guard, current)) {
            if (hold_blocked(previous)) {
                damps = false;
                continue;
            }
            for (const std::uint32_t o : rigid_bodies_.objects()) {  // joints may be stretched by it
                const Range& nodes = model_->objects[o].nodes;
                for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
                    if (current.positions[n] != before_guard[n])
                        system_.displacements[n] = Vec3<Real>(current.positions[n] - previous.positions[n]);
            }
            gained = gain();
            if (gained > 0.0) {
                stopped = stop_guarded(before_guard, current);
                gained = gain();
            }
        }
        if (!is_shortest && gained > tuning::kSlightly) {
            divide();
            continue;
        }
        is_made_ = std::isfinite(gained);
        if (!is_made_) break;
        if (attachments_.break_pulled()) continue;  // a part with more than they hold was not made
        energy_.settle(islands_, current);
        rows_.remember();
        attachments_.end_step();
        scheme_.end(previous, current);
        const double gravity = glm::length(glm::dvec3(model_->gravity));
        if (restitution_.run({static_cast<double>(input.step), 2.0 * tuning::kFrame * gravity, system_.rows,
                              solved, previous, energy_.before(), energy_.after()},
                             system_.rigid, current))
            energy_.change();
        std::fill(paces_.struck().begin(), paces_.struck().end(), std::uint8_t(0));
        for (const std::uint32_t o : stopped) paces_.struck()[o] = 1;
        break;
    }
    return input.step;
}

template <class Real>
void ImplicitStep<Real>::begin(const StepInput<Real>& input, const Nodes<Real>& previous) {
    if (input.rest_watch != nullptr &&
        !std::equal(asleep_.begin(), asleep_.end(), input.rest_watch->asleep().begin())) {
        asleep_.assign(input.rest_watch->asleep().begin(), input.rest_watch->asleep().end());
        system_.leave_out(asleep_);
    }
    find_released(previous);
    energy_.begin(previous, cavity_drives_);
}

// Bodies asleep that something comes near. @return whether there are any: then the step begins anew
template <class Real>
bool ImplicitStep<Real>::wake_near(const StepInput<Real>& input, Nodes<Real>& previous) {
    bool any = false;
    for (const NearPair<Real>& near : pairs_.pairs())
        for (const std::uint32_t o : {near.pair.object, near.pair.other})
            if (model_->is_body(o) && input.rest_watch != nullptr && input.rest_watch->asleep()[o] != 0) {
                input.rest_watch->wake(o, previous);
                any = true;
            }
    if (any) begin(input, previous);
    return any;
}

// Of which nothing has changed since it was made.
template <class Real>
bool ImplicitStep<Real>::is_asleep(const ContactRow<Real>& row) const {
    return asleep_[model_->is_body(row.other) ? row.other : row.object] != 0;
}

// Whether nodes of a body with self-contact go farther beside it than pairs could be found for: it was hit
// faster than the step can resolve. @param limits whether they go less far instead: what a step of the
// shortest length finds for them means nothing
template <class Real>
bool ImplicitStep<Real>::is_torn(bool limits) {
    std::atomic<bool> is_torn = false;
    for_each_index(0, model_->body_count(), 1, [&](std::size_t o) {
        if (rigid_bodies_.is_rigid(o)) return;
        const Range& nodes = model_->objects[o].nodes;
        const std::span<const Vec3<Real>> moved(&system_.displacements[nodes.first], nodes.count);
        const Vec3<Real> mean =
            std::accumulate(moved.begin(), moved.end(), Vec3<Real>(0)) / static_cast<Real>(nodes.count);
        const auto most =
            static_cast<Real>((limits ? tuning::kDeepest : 2.0 * tuning::kFastest) * surface_->reach(o, o));
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            Vec3<Real>& d = system_.displacements[n];
            const Real found = glm::distance(d, mean);
            if (found <= most || system_.inertia[n] == Real(0)) continue;
            is_torn = true;
            if (limits) d = mean + most / found * (d - mean);
        }
    });
    if (is_torn && limits) system_.find_slips();
    return is_torn && !limits;
}

// What was let go or taken hold of since the last step does not go on with what moved it then.
template <class Real>
void ImplicitStep<Real>::find_released(const Nodes<Real>& previous) {
    const std::vector<std::uint32_t> counts = count_held(previous);
    for (std::size_t o = 0; o < counts.size(); ++o)
        if (counts[o] != held_counts_[o]) paces_.struck()[o] = 1;
    if (counts != held_counts_) energy_.change();
    held_counts_ = counts;
}

// Of bodies.
template <class Real>
std::vector<std::uint32_t> ImplicitStep<Real>::count_held(const Nodes<Real>& nodes) const {
    std::vector<std::uint32_t> counts(model_->body_count());
    for (std::uint32_t n = 0; n < model_->body_node_count(); ++n)
        if (nodes.positions[n].w == Real(0)) ++counts[model_->node_objects[n]];
    return counts;
}

template <class Real>
void ImplicitStep<Real>::stand_still(const Nodes<Real>& previous, Nodes<Real>& current) {
    current = previous;
    energy_.forget();
    acting_.clear();
    std::fill(paces_.struck().begin(), paces_.struck().end(), std::uint8_t(1));
    for (std::uint32_t n = 0; n < model_->node_count(); ++n)
        if (previous.positions[n].w != Real(0))
            current.velocities[n] = Vec4<Real>(Vec3<Real>(0), previous.velocities[n].w);
    scheme_.end(previous, current);
}

// How far contacts would come into each other without forces, in reaches.
template <class Real>
Real ImplicitStep<Real>::deepest() const {
    Real deepest = 0;
    for (const ContactRow<Real>& row : system_.rows) {
        const Real most = row.object == kNoNode ? static_cast<Real>(surface_->thicknesses[row.other])
                                                : static_cast<Real>(surface_->reach(row.object, row.other));
        deepest = std::max(deepest, -row.gap_at(relative<Real>(row, expected_)) / most);
    }
    return deepest;
}

// Of a body with rows, which are linear in how it rotates.
template <class Real>
bool ImplicitStep<Real>::turns_far() const {
    const auto turns = [&](std::uint32_t object) {
        return object != kNoNode && model_->is_body(object) && system_.rigid.is_free(object) &&
               glm::length(system_.rigid.wanted_rotation(object)) > tuning::kMostTurn;
    };
    return std::any_of(system_.rows.begin(), system_.rows.end(),
                       [&](const ContactRow<Real>& row) { return turns(row.object) || turns(row.other); });
}

// @return whether the part was too long
template <class Real>
bool ImplicitStep<Real>::shorten(StepInput<Real>& input) const {
    const Real longest = input.divided / static_cast<Real>(parts_);
    if (!(longest > Real(0)) || input.step < Real(1.01) * longest) return false;  // but for rounding
    input.step = longest;
    return true;
}

// Where nodes are expected, without forces but gravity and loads; and what is asked about them.
template <class Real>
void ImplicitStep<Real>::predict(const StepInput<Real>& input, const Nodes<Real>& previous) {
    const Real step = step_ = input.step, least = std::max(step, static_cast<Real>(tuning::kFrame));
    for_each_index(model_->node_count(), [&](std::size_t n) {
        const Vec3<Real> x(previous.positions[n]), v(previous.velocities[n]);
        const bool is_held = previous.positions[n].w == Real(0);
        expected_[n] = step * v;
        if (!is_held) expected_[n] += step * step * acceleration(input, previous, n);
        // What is calm is carried by what it touches.
        const bool is_carried =
            model_->is_body(model_->node_objects[n]) && paces_.is_calm(model_->node_objects[n]);
        ends_[n] = Vec4<Real>(x + (is_carried ? step * v : expected_[n]), previous.positions[n].w);
        compliances_[n] = is_held ? Real(0) : compliance(n, previous.positions[n].w, least);
    });
}

// 1 / h of a node in contacts.
template <class Real>
Real ImplicitStep<Real>::compliance(std::size_t n, Real inverse_mass, Real step) const {
    if (model_->objects[model_->node_objects[n]].is_rigid)
        return surface_->places[n] == kNoNode ? Real(0)
                                              : step * step / static_cast<Real>(surface_->bearing[n]);
    return Real(1) /
           (Real(1) / (inverse_mass * step * step) + static_cast<Real>(surface_->stiffness[n]) / Real(3));
}

template <class Real>
Vec3<Real> ImplicitStep<Real>::acceleration(const StepInput<Real>& input, const Nodes<Real>& previous,
                                            std::size_t n) const {
    const Vec3<Real> gravity(model_->gravity);
    return input.load_forces.empty() ? gravity
                                     : gravity + previous.positions[n].w * Vec3<Real>(input.load_forces[n]);
}

template <class Real>
void ImplicitStep<Real>::find_targets(const StepInput<Real>& input, const Nodes<Real>& previous) {
    for_each_index(model_->node_count(), [&](std::size_t n) {
        if (previous.positions[n].w == Real(0)) {
            system_.inertia[n] = Real(0);
            system_.loads[n] = Vec3<Real>(0);
            system_.displacements[n] = expected_[n];
            return;
        }
        const Real h = scheme_.of(model_->node_objects[n]).step;
        system_.inertia[n] = Real(1) / (previous.positions[n].w * h * h);
        system_.displacements[n] = scheme_.target(previous, n, acceleration(input, previous, n));
    });
}

template <class Real>
void ImplicitStep<Real>::linearise(const StepInput<Real>& input, const Nodes<Real>& previous) {
    velocities_ = previous.velocities;
    for_each_index(velocities_.size(), [&](std::size_t n) {
        velocities_[n].w = std::max(velocities_[n].w, scheme_.of(model_->node_objects[n]).damping);
    });
    system_.elastic.linearise(previous.positions, velocities_, Real(1) / input.step, cavity_drives_);
    const double fall =
        tuning::kHardly * static_cast<double>(input.step) * glm::length(glm::dvec3(model_->gravity));
    const double rounding =
        tuning::kRoundings * static_cast<double>(std::numeric_limits<Real>::epsilon() / input.step);
    std::vector<double> energies(model_->body_count(), 0.0), of_islands = energies;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        const ModelObject& object = model_->objects[o];
        const std::uint32_t island = islands_.of_bodies[o];
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
            const glm::dvec3 v = glm::dvec3(previous.velocities[n]) - islands_.velocities[island],
                             x(previous.positions[n]);
            energies[o] += 0.5 * static_cast<double>(model_->masses[n]) *
                           (glm::dot(v, v) + fall * fall + rounding * rounding * glm::dot(x, x));
        }
        of_islands[island] += energies[o];
    }
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        const std::uint32_t island = islands_.of_bodies[o];
        const double share = model_->objects[o].mass / islands_.masses[island];
        system_.enough[o] = tuning::kTolerance * (energies[o] + tuning::kNearly * share * of_islands[island]);
    }
    // A hand pulls like inertia does, to a place of its own.
    if (input.pulls != nullptr)
        for (const std::uint32_t n : input.pulls->nodes()) {
            if (system_.inertia[n] == Real(0)) continue;
            const Vec3<Real> x(previous.positions[n]);
            const Vec4<Real> both = input.pulls->with_target(
                n, Vec4<Real>(x + system_.displacements[n], system_.inertia[n]), x, input.step);
            system_.displacements[n] = Vec3<Real>(both) - x;
            system_.inertia[n] = both.w;
        }
    system_.rigid.begin(previous.positions, system_.inertia);
    system_.loads = system_.elastic.forces();
    system_.rigid.follow_rotation(previous.positions, system_.inertia, system_.displacements, system_.loads);
    for (ContactRow<Real>& row : system_.rows)
        if (row.is_point()) row.target = -system_.rigid.added_by_rotation(row);
    // Where what is free is wanted is also what its solve starts from. What is held goes on as it goes.
    for_each_index(model_->node_count(), [&](std::size_t n) {
        system_.loads[n] += system_.inertia[n] * system_.displacements[n];
        if (system_.inertia[n] > Real(0) && !system_.rigid.is_free(model_->node_objects[n]))
            system_.displacements[n] = input.step * Vec3<Real>(previous.velocities[n]);
    });
    for (const std::uint32_t o : rigid_bodies_.objects())
        if (system_.rigid.is_free(o)) system_.rigid.make_rigid(o, system_.inertia, system_.displacements);
}

// Where objects meet that go farther beside each other than anything that a step could find out about, it is
// left to shorter steps.
template <class Real>
bool ImplicitStep<Real>::detect(const Nodes<Real>& previous, bool is_shortest, bool own) {
    if (!contacts_) return true;
    const Paths<Real> paths{
        .from = previous.positions, .to = ends_, .velocities = previous.velocities, .step = step_};
    pairs_.begin(paths, own, asleep_);
    if (!is_shortest && pairs_.fastest_approach(paths) > static_cast<Real>(tuning::kFastest)) return false;
    pairs_.run(paths);
    return true;
}

template <class Real>
bool ImplicitStep<Real>::follow(const Nodes<Real>& from, Nodes<Real>& nodes) {
    for_each_index(ends_.size(), [&](std::size_t n) {
        ends_[n] = nodes.positions[n];
        expected_[n] = Vec3<Real>(ends_[n]) - Vec3<Real>(from.positions[n]);
        compliances_[n] = ends_[n].w > Real(0) ? Real(1) : Real(0);
    });
    detect(from, true, false);
    if (guard(from, std::vector(nodes.positions), nodes)) return false;
    energy_.begin(from, cavity_drives_);
    energy_.follow(nodes);
    forget();
    return true;
}

// Where a solver wants nodes beyond the paths that pairs were found for, or the guard moves them there, pairs
// of the new paths are found: those that may cross, since none of them is to press any more.
template <class Real>
bool ImplicitStep<Real>::guard(const Nodes<Real>& previous, const std::vector<Vec4<Real>>& wanted,
                               Nodes<Real>& current) {
    const Paths<Real> paths{.from = previous.positions,
                            .to = ends_,
                            .nearness = static_cast<Real>(tuning::kLeastOfReach),
                            .velocities = previous.velocities,
                            .step = step_};
    blocked_.clear();
    bool has_changed = false;
    std::size_t checked = 0;
    for (std::uint32_t k = 0; k < tuning::kMostRounds; ++k) {
        const std::vector<std::uint32_t> strays =
            guard_.run(paths, pairs_.pairs(), compliances_, current.positions, blocked_, checked);
        if (attachments_.block_held(current.positions, surface_->thicknesses, blocked_)) {
            current.positions = wanted;
            checked = 0;
            has_changed = true;
            continue;
        }
        const bool has_lost = pairs_.find_lost(current.positions);
        has_changed = has_changed || guard_.has_changed();
        if (!contacts_ || (strays.empty() && !has_lost)) return has_changed;
        for (const std::uint32_t n : strays) ends_[n] = current.positions[n];
        checked = pairs_.update(paths, strays);
    }
    for_each_index(ends_.size(), [&](std::size_t n) {  // nothing moves
        if (previous.positions[n].w != Real(0)) current.positions[n] = previous.positions[n];
    });
    return true;
}

// What is blocked waits: else bodies would be pressed and carried by it as if it moved.
// @return whether it was to move: then the part is made again
template <class Real>
bool ImplicitStep<Real>::hold_blocked(Nodes<Real>& previous) const {
    const auto is_blocked = [&](std::uint32_t object) { return blocked_[object] != 0; };
    if (!any_moves(previous, is_blocked)) return false;
    for (const HandleNode& held : model_->handle_nodes)
        if (is_blocked(model_->node_objects[held.node]))
            previous.velocities[held.node] = Vec4<Real>(Vec3<Real>(0), previous.velocities[held.node].w);
    return true;
}

// Nodes that the guard has stopped are no faster than they went: else they press on what stopped them in each
// part after it, and elements take up energy without end. Islands that nothing holds keep their momentum
// and angular momentum.
// @param wanted positions before the guard @return bodies whose velocities have changed
template <class Real>
std::vector<std::uint32_t> ImplicitStep<Real>::stop_guarded(std::span<const Vec4<Real>> wanted,
                                                            Nodes<Real>& current) const {
    std::vector<RigidSums> sums(model_->body_count());  // by island, with momenta for forces
    std::vector<std::uint8_t> is_stopped(sums.size());  // islands
    for (std::uint32_t n = 0; n < model_->body_node_count(); ++n) {
        const Vec4<Real> x = current.positions[n];
        if (x.w == Real(0)) continue;
        const Vec3<Real> change = Vec3<Real>(x - wanted[n]) / step_;
        current.velocities[n] += Vec4<Real>(change, 0);
        const double mass = 1.0 / static_cast<double>(x.w);
        const std::uint32_t island = islands_.of_bodies[model_->node_objects[n]];
        sums[island].add(glm::dvec3(x), mass, mass * glm::dvec3(change));
        if (change != Vec3<Real>(0)) is_stopped[island] = 1;
    }
    std::vector<std::uint32_t> stopped;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        const std::uint32_t island = islands_.of_bodies[o];
        if (is_stopped[island] == 0) continue;
        stopped.push_back(o);
        if (islands_.are_held[island] != 0) continue;
        const RigidInertia inertia(sums[island]);
        const Twist lost = inertia.twist(sums[island].force, sums[island].moment);
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            current.velocities[n] -=
                Vec4<Real>(Vec3<Real>(lost.at(glm::dvec3(current.positions[n]) - inertia.center)), 0);
    }
    rigid_bodies_.keep_velocities(current);
    return stopped;
}

// Rotations that linear systems have found become true ones. And momentum and angular momentum of free
// bodies, of which these schemes and what was not solved would lose some in each step, change by what acts on
// them, of those that are attached to each other together.
template <class Real>
void ImplicitStep<Real>::finish(const StepInput<Real>& input, const Nodes<Real>& previous,
                                Nodes<Real>& current) {
    Field& d = system_.displacements;
    rows_.note(system_.rows, d, asleep_);
    attachments_.note(system_.rows, system_.slips(), static_cast<double>(step_), asleep_);
    // Of all but elements and gravity, and of what acts between bodies whose momenta change together: what a
    // row exerts on both sides cancels there, also where their points are apart.
    Field forces(d.size(), Vec3<Real>(0));
    const std::vector<std::uint32_t> groups = attachments_.groups();
    const auto acts_within = [&](const ContactRow<Real>& row) {
        return row.object != kNoNode && system_.rigid.is_free(row.object) &&
               system_.rigid.is_free(row.other) && groups[row.object] == groups[row.other];
    };
    for (std::size_t n = 0; n < input.load_forces.size(); ++n) forces[n] = Vec3<Real>(input.load_forces[n]);
    std::erase_if(acting_, [&](const Acting& acting) { return !is_asleep(acting.row); });
    for (std::size_t r = 0; r < system_.rows.size(); ++r) {
        const ContactRow<Real>& row = system_.rows[r];
        const bool is_joint = row.is_tie() && row.normal != Vec3<Real>(0);
        const Vec3<Real> s = is_joint ? system_.slips()[r] : slip<Real>(row, d), force = row.force(s);
        for (std::uint32_t k = 0; k < row.count && !acts_within(row); ++k)
            forces[row.nodes[k]] += row.weights[k] * force;
        const Vec3<Real> normal = row.pressing(s) * row.normal;
        if (force != Vec3<Real>(0)) acting_.push_back({row, normal, force - normal});
    }
    if (input.pulls != nullptr)
        for (const std::uint32_t n : input.pulls->nodes()) {
            const Vec4<Real> x = previous.positions[n];
            forces[n] +=
                input.pulls->force_at_end(n, Vec4<Real>(Vec3<Real>(x) + d[n], x.w), Vec3<Real>(x), step_);
        }
    system_.rigid.rotate(previous.positions, system_.inertia, d);
    for_each_index(d.size(), [&](std::size_t n) {
        const Vec4<Real> x = previous.positions[n];
        current.positions[n] = Vec4<Real>(Vec3<Real>(x) + d[n], x.w);
    });
    rigid_bodies_.move(previous.positions, d, current.positions);
    for (ContactRow<Real>& row : system_.rows) {  // displacements have it now
        row.turned = Vec3<Real>(0);
        if (row.is_point()) row.target = Vec3<Real>(0);
    }
    for_each_index(d.size(), [&](std::size_t n) {
        const Vec4<Real> x = previous.positions[n], v = previous.velocities[n];
        if (x.w == Real(0)) {
            current.velocities[n] = v;
            return;
        }
        current.velocities[n] = Vec4<Real>(scheme_.velocity(previous, n, d[n]), v.w);
    });
    rigid_bodies_.keep_velocities(current);
    scheme_.keep_momenta(system_.rigid, groups, forces, current);
}

template <class Real>
ContactForces ImplicitStep<Real>::contact_forces() const {
    ContactForceSums sums(*model_);
    for (const Acting& acting : acting_) {
        const ContactRow<Real>& row = acting.row;
        if (row.is_tie()) continue;
        const glm::dvec3 normal(acting.normal), friction(acting.friction);
        if (row.object == kNoNode) {
            sums.add(row.other, row.plane(), true, normal, friction);
        } else if (row.object != row.other) {
            sums.add(row.other, row.object, false, normal, friction);
        }
        for (std::uint32_t k = 0; k < row.count; ++k) {
            const auto weight = static_cast<double>(row.weights[k]);
            sums.add_to_node(row.nodes[k], weight * normal, weight * friction);
        }
    }
    return sums.take();
}

// Whether a held node moves whose object counts.
template <class Real>
template <class Counts>
bool ImplicitStep<Real>::any_moves(const Nodes<Real>& previous, const Counts& counts) const {
    return std::any_of(model_->handle_nodes.begin(), model_->handle_nodes.end(), [&](const HandleNode& held) {
        return previous.positions[held.node].w == Real(0) && counts(model_->node_objects[held.node]) &&
               Vec3<Real>(previous.velocities[held.node]) != Vec3<Real>(0);
    });
}

template <class Real>
void ImplicitStep<Real>::find_forces_on_held(const StepInput<Real>& input, const Nodes<Real>& previous,
                                             std::vector<glm::dvec3>& forces) {
    if (scheme_.last_step() == Real(0)) return forces.clear();
    const Field elastic = system_.elastic_forces();
    forces.resize(elastic.size());
    for_each_index(elastic.size(), [&](std::size_t n) {
        if (model_->node_objects[n] >= asleep_.size() || asleep_[model_->node_objects[n]] == 0)
            forces[n] = elastic[n];
    });
    for (const Acting& acting : acting_)
        for (std::uint32_t k = 0; k < acting.row.count && !is_asleep(acting.row); ++k)
            forces[acting.row.nodes[k]] +=
                static_cast<double>(acting.row.weights[k]) * glm::dvec3(acting.normal + acting.friction);
    if (input.pulls != nullptr)
        for (const std::uint32_t n : input.pulls->nodes()) {
            const Vec4<Real> x = previous.positions[n];
            const Vec4<Real> end(Vec3<Real>(x) + system_.displacements[n], x.w);
            forces[n] += glm::dvec3(input.pulls->force_at_end(n, end, Vec3<Real>(x), step_));
        }
}

template class ImplicitStep<float>;
template class ImplicitStep<double>;

}  // namespace gelatin::cpu
