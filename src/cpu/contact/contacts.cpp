#include "cpu/contact/contacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cpu/contact/partial_turn.h"
#include "cpu/contact/planes.h"
#include "model/collision/surface_parts.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Moves of a guess, between which rooms are made anew. With two in a step of 1/60 s, bodies that slide lose
// speed to their rooms; shorter steps need fewer.
constexpr double kMostMoves = 6.0, kMovesASecond = 360.0;
// Of a room: nodes that have come farther are detected again.
constexpr double kUsedRoom = 0.9, kUsedOwnRoom = 0.8;
// Of all objects. So few that have used so much keep to what is left for the rest of a step: all would be
// detected again.
constexpr double kFew = 0.01;
// With what has to be looked at in a body, nodes that have used so much of their rooms in it are.
constexpr double kRestless = 0.4;
// Of a room in its own body: where a node has used more, the map follows.
constexpr double kFollowed = 0.6;
// In joint motions, by the thickness of an object: sweeps and motions that follow make up for less.
constexpr double kKept = 2.0;
// If none has come so far, few of many bodies wait for more. Nor would another look at a body give it much
// more whose map keeps this of all distances.
constexpr double kFreshRoom = 0.3, kFreshMap = 0.8;

// Bodies are clear of themselves where all gaps are more than these times that at which they press.
constexpr double kClear = 1.5;

}  // namespace

template <class Real>
Contacts<Real>::Contacts(std::shared_ptr<const Model> model, const CollisionSettings& collision)
    : model_(std::move(model)),
      surface_(std::make_shared<const ContactSurface>(make_contact_surface(*model_, collision))),
      object_of_(objects_of_nodes(*model_)),
      detection_(model_, surface_),
      aims_(model_, surface_),
      eased_(surface_),
      guard_(model_, surface_->places),
      is_pressed_(model_->objects.size()),
      energies_(model_->objects.size()) {
    if (collision.self_collision.value_or(true)) clear_.emplace(model_, surface_);
    std::vector<Range> places;
    for (const ModelObject& object : model_->objects)
        places.push_back(surface_places(model_->surface_parts, object.faces));
    pieces_ = ObjectPieces(places);
    restart(std::vector<Vec4<Real>>(model_->positions.begin(), model_->positions.end()));
}

template <class Real>
void Contacts<Real>::restart(std::span<const Vec4<Real>> positions) {
    safe_.assign(positions.begin(), positions.end());
    list_.clear();
    if (clear_) {
        clear_->restart();
        list_.own.restart(model_, std::vector<std::uint8_t>(model_->objects.size()));
    }
    detection_.restart();
    aims_.forget();
    eased_.forget();
    is_aimed_ = false;
    longest_ = 0.0;
    std::fill(is_pressed_.begin(), is_pressed_.end(), std::uint8_t(0));
}

template <class Real>
void Contacts<Real>::start() {
    detect(safe_, {}, nullptr);
    eased_.begin(list_, safe_);
    eased_.set(list_.pairs);
}

template <class Real>
void Contacts<Real>::ease(double seconds) {
    if (!eased_.any()) return;
    eased_.grow(seconds);
    eased_.set(list_.pairs);
}

template <class Real>
std::vector<std::uint8_t> Contacts<Real>::find_meeting(std::span<const Vec3<Real>> motions) const {
    std::vector<std::uint8_t> meeting = detection_.find_meeting(safe_, motions);
    for (std::size_t o = 0; o < meeting.size(); ++o) meeting[o] |= is_pressed_[o];
    return meeting;
}

// Of planes; held nodes stay.
template <class Real>
Vec4<Real> Contacts<Real>::outside(const Vec4<Real>& position) const {
    if (model_->colliders.empty() || position.w == Real(0)) return position;
    return Vec4<Real>(outside_planes<Real>(model_->colliders, Vec3<Real>(position)), position.w);
}

template <class Real>
bool Contacts<Real>::are_apart(Real step, const Nodes<Real>& nodes, StageTimer* timer) {
    guard_.begin(nodes.positions);
    find_clear_bodies();
    if (list_.is_valid && !list_.pairs.empty()) return false;
    is_aimed_ = false;
    const Real fastest = greatest_at_nodes([&](std::uint32_t, std::uint32_t n, std::uint32_t) {
        const Vec3<Real> velocity(nodes.velocities[n]);
        return glm::dot(velocity, velocity);
    });
    longest_ = static_cast<double>(step * std::sqrt(fastest));
    detect_where_needed(safe_, {}, 0, timer);
    return list_.pairs.empty();
}

template <class Real>
void Contacts<Real>::find_clear_bodies() {
    if (!clear_) return;
    bool any_pairs = false;
    for (const std::uint32_t o : clear_->find(safe_, [&](std::uint32_t b) { return is_near_itself(b); })) {
        any_pairs |= list_.own.is_found(o);
        list_.own.forget(o, false);
        detection_.forget_own(o);
    }
    if (!any_pairs || !list_.is_valid) return;
    old_pairs_.swap(list_.pairs);
    detection_.run_own({}, safe_, list_);
    take_over_pairs();
    is_aimed_ = false;
}

// At the last aim.
template <class Real>
bool Contacts<Real>::is_near_itself(std::uint32_t object) const {
    if (!list_.is_valid) return false;
    const auto pairs =
        std::span(list_.own_pairs)
            .subspan(list_.own_starts[object], list_.own_starts[object + 1] - list_.own_starts[object]);
    if (aims_.aims().size() != list_.pairs.size()) return !pairs.empty();
    return std::any_of(pairs.begin(), pairs.end(), [&](std::uint32_t p) {
        return !(aims_.aims()[p].gap > Real(kClear) * aims_.reach(list_.pairs[p]));
    });
}

// What is known of other bodies is of where the step led to.
template <class Real>
bool Contacts<Real>::stay_clear(std::span<const Vec4<Real>> positions, StageTimer* timer) {
    if (!clear_) return true;
    const TimedStage part(timer, "advance_nodes.detect_own");
    if (clear_->stay_clear(safe_, positions)) return true;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o)
        if (!clear_->is_clear(o)) list_.own.forget(o, true);
    list_.is_valid = false;
    return false;
}

// Nothing is listed. So whatever way the nodes have taken, it can be exchanged for the straight one from
// where they were: nothing meets there if all stay in their rooms.
template <class Real>
bool Contacts<Real>::end_apart(std::span<const Vec4<Real>> positions, StageTimer* timer) {
    if (!stay_clear(positions, timer)) return false;
    guard_.begin(positions);
    const auto reaches = [&] {
        const TimedStage part(timer, "advance_nodes.guess");
        return guard_.reaches(list_, aims_, safe_, positions);
    };
    if (!reaches()) {
        set_longest(positions, safe_);
        if (guard_.lacks_room()) detect(safe_, positions, timer);
        look_at_restless(safe_, positions, timer);
        if (!list_.pairs.empty() || !reaches()) return false;
    }
    guard_.go(list_, positions, false, safe_);
    std::fill(is_pressed_.begin(), is_pressed_.end(), std::uint8_t(0));
    std::fill(energies_.begin(), energies_.end(), 0.0);
    aims_.forget();
    return true;
}

// Nodes that a handle has are where it has them: what bodies keep of their way is not forgotten.
template <class Real>
void Contacts<Real>::follow(Real step, std::span<const Vec4<Real>> targets,
                            std::span<const Vec4<Real>> starts, Nodes<Real>& nodes, StageTimer* timer) {
    std::vector<Vec4<Real>> positions;
    are_apart(step, nodes, timer);
    do {
        positions = nodes.positions;
        begin(step, targets, starts, positions, timer);
    } while (!stay_clear(positions, timer));
    safe_ = positions;
    for_each_index(positions.size(), [&](std::size_t n) {
        if (positions[n].w != Real(0)) nodes.positions[n] = positions[n];
    });
}

template <class Real>
void Contacts<Real>::begin(Real step, std::span<const Vec4<Real>> targets, std::span<const Vec4<Real>> starts,
                           std::span<Vec4<Real>> positions, StageTimer* timer) {
    guess_.resize(positions.size());
    for_each_index(positions.size(), [&](std::size_t n) {
        guess_[n] = outside(positions[n]);
        positions[n] = Vec4<Real>(Vec3<Real>(safe_[n]), guess_[n].w);
    });
    aims_.begin(step, targets, starts);
    guard_.begin(positions);
    set_longest(guess_, positions);
    if (!is_aimed_ || !list_.is_valid || used_room(positions) > Real(kUsedRoom)) {
        detect_where_needed(positions, guess_, 0, timer);
        aim(positions, AimFor::guess, timer);
    }
    // Rooms are made anew, and bodies looked at where they lack room in themselves, once before each move.
    // Few of many bodies keep to rooms that are hardly used.
    bool is_fresh = false, is_looked_at = false;
    std::size_t most_lacking = used_room(positions) < Real(kFreshRoom) ? few_objects() : 0;
    const int most_moves =
        static_cast<int>(std::clamp(kMovesASecond * static_cast<double>(step), 1.0, kMostMoves));
    for (int moves = 0;;) {
        {
            const TimedStage part(timer, "advance_nodes.guess");
            guard_.drift(list_, aims_, guess_, positions);
            ends_ = guess_;
            const bool is_free =
                guard_.plan(list_, aims_, positions, ends_, Closeness::guess, Movers::objects, {}, is_fresh);
            const std::size_t lacking = guard_.count_kept();
            if (!is_fresh && lacking > 0 && lacking <= most_lacking) {
                is_fresh = true;
                continue;
            }
            const bool needs_more =
                (guard_.lacks_room() && !is_fresh) || (!is_looked_at && any_restless(positions));
            if (is_free || !needs_more) {
                guard_.go(list_, ends_, false, positions);
                ++moves;
                is_fresh = is_looked_at = false;
                most_lacking = 0;
                if (is_free || moves == most_moves) break;
            }
        }
        const bool lacks_room = guard_.lacks_room() && !is_fresh;
        if (lacks_room) detect(positions, guess_, timer);
        const bool looks = look_at_restless(positions, ends_, timer);
        is_fresh |= lacks_room;
        is_looked_at = true;
        if (lacks_room || looks) aim(positions, AimFor::guess, timer);
    }
}

template <class Real>
bool Contacts<Real>::plan_rest(std::span<const Vec4<Real>> positions, std::span<Vec3<Real>> displacements,
                               StageTimer* timer) {
    bool any = false;
    for (std::size_t o = 0; o < model_->objects.size(); ++o) any |= guard_.part(o) < Real(1);
    if (!any) return false;
    const auto plan = [&] {
        const TimedStage part(timer, "advance_nodes.guess");
        ends_ = guess_;
        guard_.plan(list_, aims_, positions, ends_, Closeness::guess, Movers::nodes);
    };
    plan();
    if (look_at_restless(positions, ends_, timer)) {
        aim(positions, AimFor::guess, timer);
        plan();
    }
    for_each_index(positions.size(), [&](std::size_t n) {
        displacements[n] = guard_.part(n) * (Vec3<Real>(ends_[n]) - Vec3<Real>(positions[n]));
    });
    return true;
}

template <class Real>
void Contacts<Real>::go_on(std::span<const Real> parts, std::span<Vec4<Real>> positions) {
    guard_.shorten(list_, aims_, positions, ends_, parts);
    guard_.go(list_, ends_, false, positions);
}

// Of pairs as they are, with both sides under way.
template <class Real>
std::vector<Work> Contacts<Real>::works(std::span<const Vec4<Real>> positions,
                                        std::span<const Vec3<Real>> displacements) const {
    std::vector<Work> works(model_->objects.size());
    for (const Press<Real>& press : aims_.presses()) {
        const ContactPair& pair = list_.pairs[press.pair];
        std::array<Real, 2> changes{};  // of the gap, by side [m]
        for (std::size_t k = 0; k < 4; ++k) {
            const Real along = glm::dot(press.normal, displacements[pair.nodes[k]]);
            const Real weight = press.weights[static_cast<int>(k)];
            changes[pair.side_of(k)] += pair.side_of(k) == 0 ? -weight * along : weight * along;
        }
        const Real gap = aims_.gap(pair, press, positions);
        const Real here = contact_force(gap, press.reach, press.stiffness);
        const Real ahead = contact_force(gap + changes[0] + changes[1], press.reach, press.stiffness);
        for (std::size_t side = 0; side < 2; ++side) {
            Work& work = works[side == 0 ? pair.object : pair.other];
            work.here += static_cast<double>(here * changes[side]);
            work.ahead += static_cast<double>(ahead * changes[side]);
        }
    }
    return works;
}

// Bodies move rigidly, but for nodes that are held or would end in a plane. Where rooms are in the way they
// are made anew: small bodies would be no faster than these let them.
template <class Real>
void Contacts<Real>::move(std::span<const Vec4<Real>> targets, double near, std::span<Vec4<Real>> ends,
                          std::span<Vec4<Real>> positions, Turning turning, StageTimer* timer) {
    std::vector<std::uint8_t> is_rigid(model_->objects.size());
    for_each_index(0, is_rigid.size(), 1, [&](std::size_t o) {
        is_rigid[o] = guard_.is_held(o) ? 0 : 1;
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const Vec4<Real> end = outside(ends[n]);
            if (end == ends[n]) continue;
            ends[n] = end;
            is_rigid[o] = 0;
        }
    });
    const auto plan = [&](bool is_final) {
        guard_.plan(list_, aims_, positions, ends, Closeness::motion, Movers::objects, is_rigid, is_final);
    };
    plan(false);
    if (lacks_room_for(targets, near, ends)) {
        detect(positions, ends, timer);
        aim(positions, AimFor::guess, timer);
    }
    if (guard_.lacks_room()) plan(true);
    if (turning == Turning::in_part && turn_in_part(positions, is_rigid, ends)) plan(true);
    guard_.go(list_, ends, true, positions);
}

// @param is_rigid input; output: not those whose ends have changed @return whether any have
template <class Real>
bool Contacts<Real>::turn_in_part(std::span<const Vec4<Real>> positions, std::span<std::uint8_t> is_rigid,
                                  std::span<Vec4<Real>> ends) const {
    std::vector<std::uint8_t> turns(model_->body_count());
    for_each_index(0, turns.size(), 1, [&](std::size_t o) {
        const auto part = static_cast<double>(guard_.part(o));
        if (is_rigid[o] == 0 || part == 0.0 || part == 1.0) return;
        if (!cpu::turn_in_part(*model_, static_cast<std::uint32_t>(o), part, positions, ends)) return;
        turns[o] = 1;
        is_rigid[o] = 0;
    });
    return std::find(turns.begin(), turns.end(), 1) != turns.end();
}

// Whether rooms keep more than a few objects that go nearly where they would if nothing pressed them. Others
// may be on their way round what they have met.
template <class Real>
bool Contacts<Real>::lacks_room_for(std::span<const Vec4<Real>> targets, double near,
                                    std::span<const Vec4<Real>> ends) const {
    std::size_t lacking = 0;
    for (std::uint32_t o = 0; o < model_->objects.size(); ++o) {
        if (!(guard_.kept(o) > Real(kKept) * aims_.thickness(o))) continue;
        const Range& nodes = model_->objects[o].nodes;
        glm::dvec3 sum(0.0);
        double mass = 0.0;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const auto own = static_cast<double>(model_->masses[n]);
            sum += own * glm::dvec3(Vec3<Real>(ends[n]) - Vec3<Real>(targets[n]));
            mass += own;
        }
        if (glm::length(sum) <= mass * (near + static_cast<double>(aims_.thickness(o)))) ++lacking;
    }
    return lacking > few_objects();
}

template <class Real>
void Contacts<Real>::renew(std::span<const Vec4<Real>> positions, StageTimer* timer) {
    detect_where_needed(positions, {}, few_objects(), timer);
    aim(positions, AimFor::sweeps, timer);
}

template <class Real>
std::size_t Contacts<Real>::few_objects() const {
    return static_cast<std::size_t>(kFew * static_cast<double>(model_->objects.size()));
}

template <class Real>
void Contacts<Real>::detect_where_needed(std::span<const Vec4<Real>> positions,
                                         std::span<const Vec4<Real>> ends, std::size_t few,
                                         StageTimer* timer) {
    const auto lack_room = [&] {
        if (!(used_room(positions) > Real(kUsedRoom))) return false;
        const auto lacks = [](Real used) { return used > Real(kUsedRoom); };
        return static_cast<std::size_t>(std::count_if(greatest_.begin(), greatest_.end(), lacks)) > few;
    };
    if (!list_.is_valid || lack_room()) detect(positions, ends, timer);
    if (!clear_) return;
    detect_own(
        positions, [&](std::uint32_t o) { return uses_own_room(o, positions); },
        [&](std::uint32_t o) {
            return restless_places(o, [&](std::uint32_t place, std::uint32_t node) {
                return list_.own.used_by(place, Vec3<Real>(positions[node]));
            });
        },
        timer);
}

// The motion of the node that goes farthest.
template <class Real>
void Contacts<Real>::set_longest(std::span<const Vec4<Real>> ends, std::span<const Vec4<Real>> positions) {
    const Real longest = greatest_at_nodes([&](std::uint32_t, std::uint32_t n, std::uint32_t) {
        const Vec3<Real> motion = Vec3<Real>(ends[n]) - Vec3<Real>(positions[n]);
        return glm::dot(motion, motion);
    });
    longest_ = std::sqrt(static_cast<double>(longest));
}

// Whether its rooms in itself were not enough for a plan, and would be larger after a look.
template <class Real>
bool Contacts<Real>::is_restless(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const OwnRooms<Real>& own = list_.own;
    return guard_.lacks_own_room(object) &&
           (own.used(object, positions) > Real(kFreshRoom) || !own.keeps(object, Real(kFreshMap)));
}

template <class Real>
bool Contacts<Real>::any_restless(std::span<const Vec4<Real>> positions) const {
    if (!guard_.lacks_own_room()) return false;
    bool any = false;
    for (std::uint32_t o = 0; o < model_->body_count() && !any; ++o) any = is_restless(o, positions);
    return any;
}

// At what keeps them from `ends`. @return whether there were any
template <class Real>
bool Contacts<Real>::look_at_restless(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                                      StageTimer* timer) {
    if (!guard_.lacks_own_room()) return false;
    const auto places_of = [&](std::uint32_t o) {
        if (!list_.own.keeps(o, Real(kFreshMap))) return std::vector<std::uint32_t>();  // a new map is better
        return restless_places(o, [&](std::uint32_t place, std::uint32_t node) {
            return std::max(list_.own.used_by(place, Vec3<Real>(positions[node])),
                            guard_.used_at_end(o, list_, place, Vec3<Real>(ends[node])));
        });
    };
    return detect_own(
        positions, [&](std::uint32_t o) { return is_restless(o, positions); }, places_of, timer);
}

// Surface nodes of a body that use much of their rooms. @param uses(place, node): the part of its room
template <class Real>
template <class Uses>
std::vector<std::uint32_t> Contacts<Real>::restless_places(std::uint32_t object, const Uses& uses) const {
    std::vector<std::uint32_t> places;
    const Range& all = list_.own.places(object);
    for (std::uint32_t s = all.first; s < all.end(); ++s)
        if (uses(s, model_->surface_parts.nodes[s]) > Real(kRestless)) places.push_back(s);
    return places;
}

// The map follows. What it does not explain is looked at again.
template <class Real>
bool Contacts<Real>::uses_own_room(std::uint32_t object, std::span<const Vec4<Real>> positions) {
    OwnRooms<Real>& own = list_.own;
    if (!(own.used(object, positions) > Real(kFollowed))) return false;
    own.follow(object, own.fitted(object, positions));
    return own.used(object, positions) > Real(kUsedOwnRoom);
}

// Looks at bodies that meet themselves. @param is_one(object) whether at this one
// @param places_of(object) at which surface nodes, with what is near them; none: at all
// @return whether it looked at any
template <class Real>
template <class IsOne, class PlacesOf>
bool Contacts<Real>::detect_own(std::span<const Vec4<Real>> positions, const IsOne& is_one,
                                const PlacesOf& places_of, StageTimer* timer) {
    const TimedStage part(timer, "advance_nodes.detect_own");
    std::vector<OwnLook> looks(model_->body_count());
    std::vector<std::uint8_t> looks_at(looks.size());
    for_each_index(0, looks.size(), 1, [&](std::size_t k) {
        const auto o = static_cast<std::uint32_t>(k);
        looks_at[o] = list_.own.meets_itself(o) && (!list_.own.is_found(o) || is_one(o)) ? 1 : 0;
        looks[o].object = o;
        if (looks_at[o] != 0 && list_.own.is_found(o)) looks[o].places = places_of(o);
    });
    std::erase_if(looks, [&](const OwnLook& look) { return looks_at[look.object] == 0; });
    if (looks.empty()) return false;
    old_pairs_.swap(list_.pairs);
    detection_.run_own(looks, positions, list_);
    take_over_pairs();
    return true;
}

template <class Real>
void Contacts<Real>::end(std::span<const Vec4<Real>> positions) {
    aims_.end(list_, positions);
    safe_.assign(positions.begin(), positions.end());
    std::fill(is_pressed_.begin(), is_pressed_.end(), std::uint8_t(0));
    std::fill(energies_.begin(), energies_.end(), 0.0);
    for (std::size_t k = 0; k < aims_.presses().size(); ++k) {
        const Real energy = aims_.energy(k);
        if (!(energy > Real(0))) continue;
        const ContactPair& pair = list_.pairs[aims_.presses()[k].pair];
        const bool are_bodies = model_->is_body(pair.object) && model_->is_body(pair.other);
        for (const std::uint32_t o : {pair.object, pair.other})
            energies_[o] += (are_bodies ? 0.5 : 1.0) * static_cast<double>(energy);
        if (!pair.is_own()) is_pressed_[pair.object] = is_pressed_[pair.other] = 1;
    }
}

template <class Real>
std::vector<std::uint32_t> Contacts<Real>::held_up(std::span<const HandlePose> poses,
                                                   std::span<const Vec4<Real>> positions) const {
    const double reach =
        static_cast<double>(*std::max_element(surface_->thicknesses.begin(), surface_->thicknesses.end()));
    std::vector<std::uint8_t> are_late(poses.size());
    for (const HandleNode& held : model_->handle_nodes) {
        const Vec4<Real>& position = positions[held.node];
        if (position.w != Real(0)) continue;  // it is released
        const glm::dvec3 place = poses[held.handle].place(glm::dvec3(held.arm));
        if (glm::distance(place, glm::dvec3(position)) > reach) are_late[held.handle] = 1;
    }
    std::vector<std::uint32_t> handles;
    for (std::uint32_t h = 0; h < are_late.size(); ++h)
        if (are_late[h] != 0) handles.push_back(h);
    return handles;
}

// Bodies that are held, or press a collider: these take no part in what their islands do.
template <class Real>
std::vector<std::uint8_t> Contacts<Real>::find_staying(std::span<const Vec4<Real>> positions) const {
    std::vector<std::uint8_t> stays(model_->objects.size());
    for (std::size_t o = 0; o < stays.size(); ++o) stays[o] = guard_.is_held(o) ? 1 : 0;
    for (const Press<Real>& press : aims_.presses()) {
        const ContactPair& pair = list_.pairs[press.pair];
        if (model_->is_body(pair.object) && model_->is_body(pair.other)) continue;
        if (aims_.gap(pair, press, positions) < press.reach) stays[pair.object] = stays[pair.other] = 1;
    }
    return stays;
}

template <class Real>
void Contacts<Real>::detect(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                            StageTimer* timer) {
    const TimedStage part(timer, "advance_nodes.detect");
    const std::vector<std::uint8_t> stays = find_staying(positions);
    old_pairs_.swap(list_.pairs);
    if (ends.empty()) {
        detection_.run(positions, {.longest = longest_}, list_);
    } else {
        detection_.run(positions, {ends, guard_.mean_motions(positions, ends), stays, longest_}, list_);
    }
    take_over_pairs();
}

// What is known of those that were listed before.
template <class Real>
void Contacts<Real>::take_over_pairs() {
    if (eased_.any()) eased_.set(list_.pairs);
    aims_.carry_over(old_pairs_, list_);
}

template <class Real>
void Contacts<Real>::aim(std::span<const Vec4<Real>> positions, AimFor use, StageTimer* timer) {
    const TimedStage part(timer, "advance_nodes.aim");
    aims_.run(list_, positions, use);
    is_aimed_ = true;
}

// The greatest of value(place, node, object) over all surface nodes, at least 0.
template <class Real>
template <class Value>
Real Contacts<Real>::greatest_at_nodes(const Value& value) {
    greatest_.assign(model_->objects.size(), Real(0));
    const auto greatest_of = [&](const ObjectPieces::Piece& piece) {
        Real greatest = 0;
        for (std::uint32_t place = piece.range.first; place < piece.range.end(); ++place)
            greatest = std::max(greatest, value(place, model_->surface_parts.nodes[place], piece.object));
        return greatest;
    };
    pieces_.gather<Real>(greatest_, greatest_of, [](Real& a, Real b) { a = std::max(a, b); });
    return *std::max_element(greatest_.begin(), greatest_.end());
}

// The largest part of a room that a node has used.
template <class Real>
Real Contacts<Real>::used_room(std::span<const Vec4<Real>> positions) {
    return greatest_at_nodes([&](std::uint32_t place, std::uint32_t node, std::uint32_t object) {
        const Vec3<Real> moved = list_.moved(place, object, Vec3<Real>(positions[node]));
        return list_.beside_way(place, moved) / list_.rooms[place];
    });
}

template class Contacts<float>;
template class Contacts<double>;

}  // namespace gelatin::cpu
