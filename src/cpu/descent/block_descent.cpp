#include "cpu/descent/block_descent.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "cpu/collision/colliders.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

template <class Work>
void for_each_node(const Model& model, const Work& work) {
    for_each_index(model.node_count(), [&](std::size_t n) { work(static_cast<std::uint32_t>(n)); });
}

}  // namespace

template <class Real>
BlockDescent<Real>::BlockDescent(std::shared_ptr<const Model> model, const DescentSettings& settings,
                                 std::uint32_t nodes_a_batch)
    : model_(std::move(model)),
      settings_(settings),
      objective_(model_, nodes_a_batch),
      contacts_(*model_),
      sweep_(model_),
      rigid_move_(model_),
      secant_(model_) {
    if (settings_.coarse_level) coarse_.emplace(model_);
    if (coarse_ && coarse_->is_empty()) coarse_.reset();
}

template <class Real>
void BlockDescent<Real>::run(Real step, bool has_earlier, const Nodes<Real>& previous, Nodes<Real>& current,
                             std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls,
                             StageTimer* timer) {
    {
        const TimedStage part(timer, "advance_nodes.start");
        start(step, has_earlier, previous, load_forces, pulls, current);
        take_back_tangled(current.positions);
        if (coarse_ && end_of_run(0) < settings_.iterations) coarse_->begin(step, current.positions);
    }
    for (int first = 0; first < settings_.iterations;) {
        const int end = end_of_run(first);
        make_sweeps(first, end, current.positions, timer);
        if (end < settings_.iterations) {
            const TimedStage part(timer, "advance_nodes.correct");
            coarse_->run(objective_, contacts_, secant_, current.positions);
        }
        first = end;
    }
    const TimedStage part(timer, "advance_nodes.move_bodies");
    finish(step, previous, current);
}

template <class Real>
template <class Visit>
void BlockDescent<Real>::for_batches(const Visit& visit) const {
    tbb::parallel_for(std::size_t(0), objective_.rows().batches.size(), visit);
}

// Bodies that the guess would tangle start where they were: it can hold any energy, which few sweeps would
// not take out again.
template <class Real>
void BlockDescent<Real>::take_back_tangled(Positions& positions) {
    for_each_index(0, model_->objects.size(), 1, [&](std::size_t o) {
        const ModelObject& object = model_->objects[o];
        if (!objective_.is_tangled(object, positions)) return;
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
            if (positions[n].w > Real(0))  // held ones are where their handle takes them
                positions[n] = Vec4<Real>(Vec3<Real>(objective_.step.starts[n]), positions[n].w);
    });
}

// Sweeps from `first` up to `end`, with what comes between them. The bodies of a batch make theirs one after
// the other, while caches hold them; where parts are timed, all bodies make each part at once, with the same
// results.
template <class Real>
void BlockDescent<Real>::make_sweeps(int first, int end, Positions& positions, StageTimer* timer) {
    const auto sweep = [&](std::size_t batch) { sweep_.run(batch, objective_, contacts_, positions); };
    const auto move_bodies = [&](std::size_t batch, bool last) {
        rigid_move_.run(batch, last, objective_, contacts_, positions);
    };
    if (timer == nullptr) {
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
        if (moves_bodies(i))
            time("advance_nodes.move_bodies", [&](std::size_t batch) { move_bodies(batch, is_last(i)); });
    }
}

// Of sweeps that no correction comes between.
template <class Real>
int BlockDescent<Real>::end_of_run(int first) const {
    if (!coarse_) return settings_.iterations;
    const int corrected = (first + kSweepsACorrection - 1) / kSweepsACorrection * kSweepsACorrection;
    return std::min(corrected + 1, settings_.iterations);
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
            return;
        }
        Vec3<Real> acceleration = gravity;
        if (!load_forces.empty()) acceleration += from.w * Vec3<Real>(load_forces[n]);
        target = Vec4<Real>(Vec3<Real>(from) + step * (velocity + step * acceleration),
                            Real(1) / (from.w * step * step));
        if (pulls != nullptr) target = pulls->with_target(n, target, Vec3<Real>(from), step);
        const Real felt = has_earlier && squared > Real(0)
                              ? glm::clamp(glm::dot(gained, gravity) / (step * squared), Real(0), Real(1))
                              : Real(1);
        const Vec3<Real> guess = Vec3<Real>(from) + step * (velocity + step * felt * gravity);
        current.positions[n] = Vec4<Real>(guess, from.w);
    });
    contacts_.begin();
    objective_.begin(step);
}

// Nodes that a collider has stopped go back with restitution times the speed that they would have had without
// it.
template <class Real>
void BlockDescent<Real>::finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current) const {
    const auto least = static_cast<Real>(resting_speed(model_->gravity, static_cast<double>(step)));
    for_each_node(*model_, [&](std::uint32_t n) {
        const Vec4<Real> old = previous.velocities[n];
        current.velocities[n] = old;
        if (current.positions[n].w == Real(0)) return;
        const Vec3<Real> position(current.positions[n]), start(objective_.step.starts[n]);
        Vec3<Real> velocity = (position - start) / step;
        if (contacts_.has_contact(n))
            rebound<Real>(model_->colliders, position,
                          (Vec3<Real>(objective_.step.targets[n]) - start) / step, least, velocity);
        current.velocities[n] = Vec4<Real>(velocity, old.w);
    });
}

template class BlockDescent<float>;
template class BlockDescent<double>;

}  // namespace gelatin::cpu
