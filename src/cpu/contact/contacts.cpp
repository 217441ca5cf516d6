#include "cpu/contact/contacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Moves of a guess, between which rooms are made anew. With two, bodies that slide lose speed to their rooms.
constexpr int kMostMoves = 6;
// Of a room: nodes that have come farther are detected again.
constexpr double kUsedRoom = 0.9;

}  // namespace

template <class Real>
Contacts<Real>::Contacts(std::shared_ptr<const Model> model, double friction)
    : model_(std::move(model)),
      surface_(std::make_shared<const ContactSurface>(make_contact_surface(*model_))),
      object_of_(objects_of_nodes(*model_)),
      detection_(model_, surface_),
      aims_(model_, surface_, friction),
      guard_(model_, surface_->places),
      is_pressed_(model_->objects.size()) {
    restart(std::vector<Vec4<Real>>(model_->positions.begin(), model_->positions.end()));
}

template <class Real>
void Contacts<Real>::restart(std::span<const Vec4<Real>> positions) {
    safe_.assign(positions.begin(), positions.end());
    list_.clear();
    aims_.forget();
    std::fill(is_pressed_.begin(), is_pressed_.end(), std::uint8_t(0));
}

template <class Real>
void Contacts<Real>::begin(Real step, std::span<const Vec4<Real>> targets, std::span<const Vec4<Real>> starts,
                           std::span<Vec4<Real>> positions, StageTimer* timer) {
    guess_.assign(positions.begin(), positions.end());
    for (std::size_t n = 0; n < positions.size(); ++n)
        positions[n] = Vec4<Real>(Vec3<Real>(safe_[n]), guess_[n].w);
    aims_.begin(step, targets, starts);
    guard_.begin(positions);
    Real longest = 0;
    for (const std::uint32_t n : model_->surface_parts.nodes) {
        const Vec3<Real> motion = Vec3<Real>(guess_[n]) - Vec3<Real>(positions[n]);
        longest = std::max(longest, glm::dot(motion, motion));
    }
    longest_ = std::sqrt(static_cast<double>(longest));
    bool is_fresh = !list_.is_valid || used_room(positions) > Real(kUsedRoom);
    if (is_fresh) detect(positions, timer);
    for (int moves = 0; moves < kMostMoves;) {
        aim(positions, timer);
        const TimedStage part(timer, "advance_nodes.guess");
        const bool is_free = guard_.plan(list_, aims_, positions, guess_, Closeness::guess);
        if (is_free || is_fresh) {
            guard_.go(list_, guess_, false, positions);
            ++moves;
            is_fresh = false;
            if (is_free) break;
        }
        detect(positions, timer);
        is_fresh = true;
    }
    renew(positions, timer);
}

template <class Real>
void Contacts<Real>::move(std::span<const Vec4<Real>> ends, std::span<Vec4<Real>> positions) {
    guard_.plan(list_, aims_, positions, ends, Closeness::motion);
    guard_.go(list_, ends, true, positions);
}

template <class Real>
void Contacts<Real>::renew(std::span<const Vec4<Real>> positions, StageTimer* timer) {
    if (used_room(positions) > Real(kUsedRoom)) detect(positions, timer);
    aim(positions, timer);
}

template <class Real>
void Contacts<Real>::end(std::span<const Vec4<Real>> positions) {
    aims_.end(list_, positions);
    safe_.assign(positions.begin(), positions.end());
    std::fill(is_pressed_.begin(), is_pressed_.end(), std::uint8_t(0));
    for (const Press<Real>& press : aims_.presses()) {
        const ContactPair& pair = list_.pairs[press.pair];
        if (aims_.gap(pair, press, positions) < press.reach)
            is_pressed_[pair.object] = is_pressed_[pair.other] = 1;
    }
}

template <class Real>
void Contacts<Real>::detect(std::span<const Vec4<Real>> positions, StageTimer* timer) {
    const TimedStage part(timer, "advance_nodes.detect");
    std::swap(old_list_, list_);
    detection_.run(positions, longest_, list_);
    aims_.carry_over(old_list_, list_);
}

template <class Real>
void Contacts<Real>::aim(std::span<const Vec4<Real>> positions, StageTimer* timer) {
    const TimedStage part(timer, "advance_nodes.aim");
    aims_.run(list_, positions);
}

// The largest part of a room that a node has used.
template <class Real>
Real Contacts<Real>::used_room(std::span<const Vec4<Real>> positions) const {
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    Real most = 0;
    for (std::size_t s = 0; s < nodes.size(); ++s) {
        const Vec3<Real> moved =
            list_.moved(static_cast<std::uint32_t>(s), object_of_[nodes[s]], Vec3<Real>(positions[nodes[s]]));
        most = std::max(most, glm::dot(moved, moved) / (list_.rooms[s] * list_.rooms[s]));
    }
    return std::sqrt(most);
}

template class Contacts<float>;
template class Contacts<double>;

}  // namespace gelatin::cpu
