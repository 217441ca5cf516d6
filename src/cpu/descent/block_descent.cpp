#include "cpu/descent/block_descent.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "cpu/collision/colliders.h"
#include "cpu/contact/planes.h"
#include "cpu/descent/wave_times.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// From this part of a guess on, the rest of it changes the objective by less than a hundredth of what the
// part lowers it by. A single sweep does not bring back what is left out of the motion: a hundredth of it in
// each sixteenth of a frame would be a quarter of all energy.
constexpr double kNearlyAll = 0.95;
// Of a node's acceleration in the last step: what the guess of a soft body that others press goes on with.
// With all of it an impact gives a little more back, but guesses are rough and list far more pairs.
constexpr double kKeptAcceleration = 0.5;
// A body is slow, of what gravity adds to its speed in a step.
constexpr double kSlow = 2.0;
// A body is soft where a pressure wave takes more than so many steps through it.
constexpr double kStepsAWave = 8.0;
// Bodies go back from what deforms them at most so often in a step.
constexpr int kMostRounds = 12;
// A step is longer than the last one where it is so many times that.
constexpr double kLonger = 1.5;

template <class Work>
void for_each_node(const Model& model, const Work& work) {
    for_each_index(model.node_count(), [&](std::size_t n) { work(static_cast<std::uint32_t>(n)); });
}

}  // namespace

template <class Real>
BlockDescent<Real>::BlockDescent(std::shared_ptr<const Model> model, const DescentSettings& settings,
                                 std::uint32_t nodes_a_batch, std::unique_ptr<Contacts<Real>> contacts,
                                 DeviceSweeps* device)
    : model_(std::move(model)),
      settings_(settings),
      sweeps_(settings.iterations),
      wave_times_(wave_times(*model_)),
      bodies_(std::move(contacts)),
      objective_(model_, nodes_a_batch),
      contacts_(*model_),
      sweep_(model_),
      rigid_move_(model_),
      joint_move_(model_),
      rebound_(model_, wave_times_),
      tangled_(model_),
      energy_(model_),
      outlooks_(model_->objects.size()),
      device_(bodies_ ? device : nullptr) {
    if (bodies_) landing_.emplace(model_, wave_times_);
    if (settings_.coarse_level) coarse_.emplace(model_);
    if (coarse_ && coarse_->is_empty()) coarse_.reset();
    if (coarse_ || bodies_) secant_.emplace(model_);
    if (settings_.divides_steps) division_.emplace(model_, wave_times_);
    if (settings_.sleeps && bodies_) rest_watch_.emplace(model_, bodies_->thicknesses());
}

template <class Real>
bool BlockDescent<Real>::rests(double step, std::span<const float> load_factors, bool is_pulled,
                               Nodes<Real>& nodes) {
    if (!rest_watch_) return false;
    std::vector<Vec3<Real>> held_at;
    for (const HandleNode& held : model_->handle_nodes)
        held_at.push_back(bodies_->came_from(held.node, Real(0)));
    if (!rest_watch_->rests(step, nodes.positions, load_factors, is_pulled, held_at)) return false;
    for_each_node(*model_, [&](std::uint32_t n) {
        Vec4<Real>&position = nodes.positions[n], &velocity = nodes.velocities[n];
        if (position.w == Real(0)) position = Vec4<Real>(bodies_->came_from(n, Real(0)), Real(0));
        velocity = Vec4<Real>(Vec3<Real>(0), velocity.w);
    });
    return true;
}

template <class Real>
void BlockDescent<Real>::follow(Real step, std::span<const std::uint32_t> matched, Nodes<Real>& nodes,
                                StageTimer* timer) {
    if (!bodies_) return;
    for_each_node(*model_, [&](std::uint32_t n) {
        const Vec4<Real>& place = nodes.positions[n];
        const Real inertia = place.w > Real(0) ? Real(1) / (place.w * step * step) : Real(0);
        objective_.step.starts[n] = Vec4<Real>(Vec3<Real>(place), nodes.velocities[n].w);
        objective_.step.targets[n] = Vec4<Real>(Vec3<Real>(place), inertia);
    });
    const Positions shapes = nodes.positions;
    bodies_->follow(step, objective_.step.targets, objective_.step.starts, nodes, timer);
    for (const std::uint32_t o : matched)
        if (!bodies_->is_held(o)) tangled_.move_rigidly(o, shapes, nodes);
    energy_.restart();
}

template <class Real>
void BlockDescent<Real>::run(Real step, bool has_earlier, const Nodes<Real>& previous, Nodes<Real>& current,
                             std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls,
                             StageTimer* timer, int parts) {
    sweeps_ = std::max(1, settings_.iterations / parts);
    const auto start_with = [&](const Contacts<Real>* acting) {
        const TimedStage part(timer, "advance_nodes.start");
        acting_ = acting;
        start(step, has_earlier, previous, load_forces, pulls, current);
        shorten_guess(step, current.positions);
        return landing_ && landing_->begin(static_cast<double>(step), objective_, current.positions);
    };
    if (bodies_) {
        if (has_earlier) {
            bodies_->ease(static_cast<double>(step));
        } else {
            bodies_->start();
        }
        find_outlooks(step, parts > 1, previous);
    }
    // A step is tried with what seems to be enough, and made again with more where it was not.
    for (bool apart = !bodies_ || bodies_->are_apart(step, previous, timer);; apart = false) {
        const bool lands = start_with(apart ? nullptr : bodies_.get());
        if (apart && lands && device_ != nullptr) continue;  // rigid motions on a device know no landing
        if (!apart) {
            bodies_->begin(step, objective_.step.targets, objective_.step.starts, current.positions, timer);
            go_on_to_guess(current.positions, timer);
        }
        make_moves(step, current.positions, timer);
        if (!bodies_) break;
        energy_.begin({static_cast<double>(step), previous, objective_.step.starts, load_forces,
                       pulls != nullptr ? pulls->nodes() : std::span<const std::uint32_t>()},
                      *bodies_);
        keep_energy(current.positions, timer);
        if (apart ? bodies_->end_apart(current.positions, timer)
                  : bodies_->stay_clear(current.positions, timer))
            break;
    }
    const TimedStage part(timer, "advance_nodes.move_bodies");
    if (acting_ != nullptr) bodies_->end(current.positions);
    finish(step, previous, current);
    last_step_ = step;
    slow_down_tangled(previous, load_forces, pulls, current);
}

// From the first guess on.
template <class Real>
void BlockDescent<Real>::make_moves(Real step, Positions& positions, StageTimer* timer) {
    if (device_ != nullptr) {
        const TimedStage part(timer, "advance_nodes.start");
        device_->begin(
            static_cast<double>(step),
            std::vector<glm::vec4>(objective_.step.starts.begin(), objective_.step.starts.end()),
            std::vector<glm::vec4>(objective_.step.targets.begin(), objective_.step.targets.end()));
    }
    if (device_ != nullptr && acting_ == nullptr) {
        const TimedStage part(timer, "advance_nodes.descend");
        device_positions_.assign(positions.begin(), positions.end());
        device_->start_apart(sweeps_, device_positions_);
        take_from_device(positions);
        // Forces are asked for later.
        for_batches([&](std::size_t batch) { objective_.update(batch, TetUpdate::all, positions); });
        return;
    }
    if (coarse_ && end_of_run(0) < sweeps_) {
        const TimedStage part(timer, "advance_nodes.start");
        coarse_->begin(step, positions);
    }
    for (int first = 0; first < sweeps_;) {
        const int end = end_of_run(first);
        if (device_ != nullptr) {
            make_sweeps_on_device(first, end, positions, timer);
        } else {
            make_sweeps(first, end, positions, timer);
        }
        if (end < sweeps_) {
            const TimedStage part(timer, "advance_nodes.correct");
            coarse_->run(objective_, acting_, contacts_, *secant_, positions);
        }
        first = end;
    }
}

template <class Real>
template <class Visit>
void BlockDescent<Real>::for_batches(const Visit& visit) const {
    tbb::parallel_for(std::size_t(0), objective_.rows().batches.size(), visit);
}

// Of bodies that press others. Slow ones stay: a guess that presses them together would topple stacks. Others
// go on as they do; in short steps soft ones also with what bends them, which sweeps that are that few hardly
// find.
template <class Real>
void BlockDescent<Real>::find_outlooks(Real step, bool is_part, const Nodes<Real>& previous) {
    const double gained = static_cast<double>(step) * glm::length(glm::dvec3(model_->gravity));
    const double fast = kSlow * gained;
    slow_way_ = static_cast<double>(step) * (fast + gained);
    tbb::parallel_for(std::size_t(0), model_->body_count(), [&](std::size_t o) {
        outlooks_[o] = {bodies_->was_pressed(o) || contacts_.objects[o] != 0};
        if (!outlooks_[o].is_pressed) return;
        glm::dvec3 momentum(0.0);
        double mass = 0.0;
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const auto own = static_cast<double>(model_->masses[n]);
            momentum += own * glm::dvec3(previous.velocities[n]);
            mass += own;
        }
        if (glm::length(momentum) < fast * mass) return;
        outlooks_[o] = {true, Real(1), is_part && is_soft(o, step) ? Real(kKeptAcceleration) : Real(0)};
    });
}

template <class Real>
bool BlockDescent<Real>::is_soft(std::size_t object, Real step) const {
    return wave_times_[object] > kStepsAWave * static_cast<double>(step);
}

// Sweeps from `first` up to `end`, with what comes between them. The bodies of a batch make theirs one after
// the other, while caches hold them; where parts are timed, or bodies meet, all bodies make each part at
// once, with the same results.
template <class Real>
void BlockDescent<Real>::make_sweeps(int first, int end, Positions& positions, StageTimer* timer) {
    const auto sweep = [&](std::size_t batch) {
        sweep_.run(batch, objective_, acting_, contacts_, positions);
    };
    const auto move_bodies = [&](std::size_t batch, bool last) {
        rigid_move_.run(batch, last, objective_, contacts_, nullptr, landing_ ? &*landing_ : nullptr,
                        positions, positions);
    };
    if (timer == nullptr && acting_ == nullptr) {
        for_batches([&](std::size_t batch) {
            for (int i = first; i < end; ++i) {
                objective_.update(batch, tet_update_before(i), positions);
                sweep(batch);
                if (moves_bodies(i)) move_bodies(batch, is_last(i));
            }
        });
        return;
    }
    const auto time = [&](const char* name, const auto& work) {
        const TimedStage part(timer, name);
        for_batches(work);
    };
    for (int i = first; i < end; ++i) {
        if (const TetUpdate update = tet_update_before(i); update != TetUpdate::none)
            time("advance_nodes.update_tets",
                 [&](std::size_t batch) { objective_.update(batch, update, positions); });
        time("advance_nodes.descend", sweep);
        if (moves_bodies(i) && acting_ != nullptr) move_together(is_last(i), positions, timer);
        if (moves_bodies(i) && acting_ == nullptr)
            time("advance_nodes.move_bodies", [&](std::size_t batch) { move_bodies(batch, is_last(i)); });
    }
}

// The same, with sweeps on a device: those between two aims at a time. What follows on the host needs the
// tets as well, which it looks at meanwhile.
template <class Real>
void BlockDescent<Real>::make_sweeps_on_device(int first, int end, Positions& positions, StageTimer* timer) {
    for (int next = first; next < end;) {
        const int begin = next++;
        while (next < end && !moves_bodies(next - 1)) ++next;
        {
            const TimedStage part(timer, "advance_nodes.descend");
            device_positions_.assign(positions.begin(), positions.end());
            bodies_->write_limits(device_limits_);
            const TetUpdate update = tet_update_before(begin);
            device_->start(next - begin, update, device_limits_, device_positions_);
            for_batches([&](std::size_t batch) { objective_.update(batch, update, positions); });
            take_from_device(positions);
        }
        if (moves_bodies(next - 1)) move_together(is_last(next - 1), positions, timer);
    }
}

template <class Real>
void BlockDescent<Real>::take_from_device(Positions& positions) {
    device_->finish(device_positions_, device_contacts_);
    positions.assign(device_positions_.begin(), device_positions_.end());
    for (std::size_t o = 0; o < contacts_.objects.size(); ++o)
        contacts_.objects[o] = device_contacts_.objects[o] != 0 ? 1 : 0;
    for (std::size_t n = 0; n < contacts_.nodes.size(); ++n) {
        const gelatin::ColliderContact& contact = device_contacts_.nodes[n];
        contacts_.nodes[n] = {};
        if (contact.force.w > 0.0f)
            contacts_.nodes[n] = {Vec3<Real>(contact.force), Vec3<Real>(contact.normal),
                                  Real(contact.force.w), Real(contact.normal.w)};
    }
}

// Of bodies that others were in the way of, each node goes on to the guess as far as others let it, and the
// body makes the part of that at which the objective is least. Of soft ones in short steps, in which inertia
// decides, that is all or nearly all.
template <class Real>
void BlockDescent<Real>::go_on_to_guess(Positions& positions, StageTimer* timer) {
    if (bodies_->plan_rest(positions, secant_->displacements, timer)) {
        std::vector<Real> parts(model_->objects.size(), Real(1));
        const TimedStage part(timer, "advance_nodes.guess");
        std::vector<std::uint8_t> wanted(positions.size());
        for_each_node(*model_, [&](std::uint32_t n) {
            const bool moves = secant_->displacements[n] != Vec3<Real>(0);
            wanted[n] = moves && !outlooks_[contacts_.object_of[n]].is_soft() ? 1 : 0;
        });
        secant_->find_forces(objective_, contacts_, nullptr, positions, wanted);
        secant_->look_ahead(objective_, contacts_, nullptr, positions, wanted);
        const std::vector<Work> of_contacts = bodies_->works(positions, secant_->displacements);
        tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t o) {
            if (outlooks_[o].is_soft()) return;
            Work work = secant_->work(o);
            work.here += of_contacts[o].here;
            work.ahead += of_contacts[o].ahead;
            const double least = secant_->part(work, 1.0);
            parts[o] = least > kNearlyAll ? Real(1) : static_cast<Real>(least);
        });
        bodies_->go_on(parts, positions);
    }
    bodies_->renew(positions, timer);
}

// All bodies as rigid ones, those of an island together. Held nodes that others were in the way of go on:
// what they press has yielded since.
template <class Real>
void BlockDescent<Real>::move_together(bool last, Positions& positions, StageTimer* timer, Turning turning) {
    {
        const TimedStage part(timer, "advance_nodes.move_bodies");
        ends_ = positions;
        for_each_node(*model_, [&](std::uint32_t n) {
            if (ends_[n].w == Real(0)) ends_[n] = objective_.step.targets[n];
        });
        for_batches([&](std::size_t batch) {
            rigid_move_.run(batch, last, objective_, contacts_, bodies_.get(), &*landing_, positions, ends_);
        });
        joint_move_.run(last, *bodies_, objective_, contacts_, *landing_, positions, ends_);
        bodies_->move(objective_.step.targets, slow_way_, ends_, positions, turning, timer);
    }
    if (!last) bodies_->renew(positions, timer);
}

// Others may be in the way of bodies that go back: they all move on together, and are looked at again.
template <class Real>
void BlockDescent<Real>::keep_energy(Positions& positions, StageTimer* timer) {
    for (int round = 0;; ++round) {
        {
            const TimedStage part(timer, "advance_nodes.keep_energy");
            energy_.measure(positions);
            if (round == kMostRounds || !energy_.plan(acting_, positions, ends_)) return;
        }
        if (acting_ != nullptr) {
            bodies_->move(objective_.step.targets, slow_way_, ends_, positions, Turning::in_part, timer);
            bodies_->renew(positions, timer);
            move_together(true, positions, timer, Turning::in_part);
        } else {
            for_each_node(*model_, [&](std::uint32_t n) {
                const Vec3<Real> end(ends_[n]);
                positions[n] = Vec4<Real>(outside_planes<Real>(model_->colliders, end), positions[n].w);
            });
        }
    }
}

// Of sweeps that no correction comes between.
template <class Real>
int BlockDescent<Real>::end_of_run(int first) const {
    if (!coarse_) return sweeps_;
    const int corrected = (first + kSweepsACorrection - 1) / kSweepsACorrection * kSweepsACorrection;
    return std::min(corrected + 1, sweeps_);
}

// As the last step went on: with as much of gravity as was felt in it, from none, where a body rests, to all,
// where it falls (Chen et al. 2024, 3.7). Without a last step as in free fall. Nodes that are inside a
// collider are put outside first, which is no motion and gives them no speed. Held nodes are where their
// handle takes them.
template <class Real>
void BlockDescent<Real>::start(Real step, bool has_earlier, const Nodes<Real>& previous,
                               std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls,
                               Nodes<Real>& current) {
    const Vec3<Real> gravity(model_->gravity);
    const Real squared = glm::dot(gravity, gravity);
    const Real earlier_step = last_step_ > Real(0) ? last_step_ : step;
    for_each_node(*model_, [&](std::uint32_t n) {
        const Vec3<Real> velocity(previous.velocities[n]);
        const Vec3<Real> gained = velocity - Vec3<Real>(current.velocities[n]);
        Vec4<Real> from = previous.positions[n];
        if (from.w > Real(0)) {
            Vec4<Real> none(0);
            resolve_colliders<Real>(model_->colliders, Real(0), from, none);
        }
        objective_.step.starts[n] = Vec4<Real>(Vec3<Real>(from), previous.velocities[n].w);
        Vec4<Real>& target = objective_.step.targets[n];
        if (contacts_.has_contact(n)) contacts_.nodes[n] = {};  // of the last step
        if (from.w == Real(0)) {
            target = Vec4<Real>(Vec3<Real>(from) + step * velocity, Real(0));
            current.positions[n] = target;
            // Bodies may have been in the way of what a handle moves.
            if (bodies_)
                objective_.step.starts[n] = Vec4<Real>(bodies_->came_from(n, step), previous.velocities[n].w);
            return;
        }
        Vec3<Real> acceleration = gravity;
        if (!load_forces.empty()) acceleration += from.w * Vec3<Real>(load_forces[n]);
        target = Vec4<Real>(Vec3<Real>(from) + step * (velocity + step * acceleration),
                            Real(1) / (from.w * step * step));
        if (pulls != nullptr) target = pulls->with_target(n, target, Vec3<Real>(from), step);
        const Real felt =
            has_earlier && squared > Real(0)
                ? glm::clamp(glm::dot(gained, gravity) / (earlier_step * squared), Real(0), Real(1))
                : Real(1);
        Vec3<Real> guess = Vec3<Real>(from) + step * (velocity + step * felt * gravity);
        if (const Outlook& outlook = outlooks_[contacts_.object_of[n]]; outlook.is_pressed) {
            guess = Vec3<Real>(from) + step * (outlook.velocity * velocity);
            if (has_earlier) guess += step * step / earlier_step * (outlook.acceleration * gained);
        }
        current.positions[n] = Vec4<Real>(guess, from.w);
    });
    contacts_.begin();
    objective_.begin(step, acting_);
}

// Bodies that others press, or that meet themselves, cannot get to a part of a guess that tangles them: what
// they would make of it crumples them. Others may vibrate so fast, after shorter steps, that a guess for a
// longer one holds many times the energy that they have.
template <class Real>
void BlockDescent<Real>::shorten_guess(Real step, Positions& positions) {
    const bool is_longer = last_step_ > Real(0) && step > static_cast<Real>(kLonger) * last_step_;
    std::vector<GuessLimit> limits(model_->objects.size(), GuessLimit::all);
    for (std::size_t o = 0; o < model_->body_count(); ++o) {
        const bool is_kept_off =
            acting_ != nullptr && (acting_->was_pressed(o) || acting_->list().own.meets_itself(o));
        if (!division_ || is_kept_off) continue;
        limits[o] = is_longer && !is_soft(o, step) ? GuessLimit::energy : GuessLimit::part;
    }
    tangled_.shorten_guess(objective_, limits, positions);
}

// Restitution: of bodies that meet others, as rigid ones; else nodes that a collider has stopped go back with
// restitution times the speed that they would have had without it.
template <class Real>
void BlockDescent<Real>::finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current) {
    const auto least = static_cast<Real>(resting_speed(model_->gravity, static_cast<double>(step)));
    for_each_node(*model_, [&](std::uint32_t n) {
        const Vec4<Real> old = previous.velocities[n];
        current.velocities[n] = old;
        if (current.positions[n].w == Real(0)) return;
        const Vec3<Real> position(current.positions[n]), start(objective_.step.starts[n]);
        Vec3<Real> velocity = (position - start) / step;
        if (!bodies_ && contacts_.has_contact(n))
            rebound<Real>(model_->colliders, position,
                          (Vec3<Real>(objective_.step.targets[n]) - start) / step, least, velocity);
        current.velocities[n] = Vec4<Real>(velocity, old.w);
    });
    if (!bodies_) return;
    energy_.end(acting_, current.positions, current.velocities);
    rebound_.run({static_cast<double>(step), static_cast<double>(least), previous.velocities,
                  objective_.step.starts, current.positions},
                 *bodies_, contacts_, current.velocities);
}

// Bodies without contacts come out of it by themselves.
template <class Real>
void BlockDescent<Real>::slow_down_tangled(const Nodes<Real>& previous,
                                           std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls,
                                           Nodes<Real>& current) {
    if (!bodies_) return;
    std::vector<std::uint32_t> objects;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        if (!tangled_.was_tangled(o) || bodies_->is_held(o)) continue;
        const auto is_own = [&](std::uint32_t n) { return contacts_.object_of[n] == o; };
        if (pulls == nullptr || std::none_of(pulls->nodes().begin(), pulls->nodes().end(), is_own))
            objects.push_back(o);
    }
    if (objects.empty()) return;
    tangled_.slow_down({objective_.step.starts, current.positions, previous.velocities, load_forces,
                        contact_forces(current.positions)},
                       objects, current.velocities);
}

template <class Real>
std::vector<glm::dvec3> BlockDescent<Real>::forces_on_held(const Positions& positions,
                                                           const Pulls<Real>* pulls) const {
    if (last_step_ == Real(0)) return {};
    std::vector<Vec3<Real>> of_elements(positions.size());
    objective_.find_held_forces(positions, of_elements);
    std::vector<glm::dvec3> forces(of_elements.begin(), of_elements.end());
    if (bodies_) {
        const ContactForces contacts = contact_forces(positions);
        for_each_node(*model_,
                      [&](std::uint32_t n) { forces[n] += contacts.normal[n] + contacts.friction[n]; });
    }
    if (pulls != nullptr)
        for (const std::uint32_t n : pulls->nodes())
            forces[n] += glm::dvec3(
                pulls->force_at_end(n, positions[n], Vec3<Real>(objective_.step.starts[n]), last_step_));
    return forces;
}

template class BlockDescent<float>;
template class BlockDescent<double>;

}  // namespace gelatin::cpu
