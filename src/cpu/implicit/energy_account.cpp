#include "cpu/implicit/energy_account.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "cpu/contact/tuning.h"
#include "cpu/elasticity/elastic_energy.h"
#include "cpu/implicit/rigid_part.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
EnergyAccount<Real>::EnergyAccount(std::shared_ptr<const Model> model)
    : model_(std::move(model)), before_(model_->body_count(), 0.0) {
    after_ = motions_ = motions_before_ = rounding_ = contacts_before_ = contacts_at_start_ =
        contacts_at_end_ = work_ = debts_ = dues_ = potentials_ = before_;
    momenta_.resize(before_.size());
}

template <class Real>
void EnergyAccount<Real>::forget() {
    is_known_ = false;
    std::fill(contacts_at_end_.begin(), contacts_at_end_.end(), 0.0);
    std::fill(debts_.begin(), debts_.end(), 0.0);
}

template <class Real>
void EnergyAccount<Real>::archive(Archive& archive) {
    archive.array(contacts_at_end_);
    archive.array(debts_);
}

template <class Real>
void EnergyAccount<Real>::begin(const Nodes<Real>& previous, std::span<const double> drives) {
    if (!std::equal(drives_.begin(), drives_.end(), drives.begin(), drives.end())) {
        drives_.assign(drives.begin(), drives.end());
        is_known_ = false;
    }
    if (!is_known_) find_energies(previous);
    before_ = after_;
    motions_before_ = motions_;
    potentials_before_ = potentials_;
    contacts_before_ = contacts_at_end_;
}

template <class Real>
void EnergyAccount<Real>::follow(const Nodes<Real>& nodes) {
    find_energies(nodes);
    for (std::size_t o = 0; o < debts_.size(); ++o)
        debts_[o] = std::max(debts_[o] + after_[o] - before_[o], 0.0);
}

template <class Real>
double EnergyAccount<Real>::in_contacts() const {
    return std::accumulate(contacts_at_end_.begin(), contacts_at_end_.end(), 0.0);
}

template <class Real>
void EnergyAccount<Real>::find_energies(const Nodes<Real>& nodes, std::span<const std::uint8_t> asleep) {
    for_each_index(0, after_.size(), 1, [&](std::size_t o) {
        if (asleep.empty() || asleep[o] == 0) find_energy(o, nodes);
    });
    is_known_ = true;
}

template <class Real>
void EnergyAccount<Real>::find_energy(std::size_t body, const Nodes<Real>& nodes) {
    const glm::dvec3 gravity(model_->gravity);
    const ModelObject& object = model_->objects[body];
    double motion = body_energy<Real>(*model_, object, nodes.positions), potential = 0.0;
    glm::dvec3 momentum(0.0);
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        if (nodes.positions[n].w == Real(0)) continue;
        const glm::dvec3 v(nodes.velocities[n]);
        const auto mass = static_cast<double>(model_->masses[n]);
        momentum += mass * v;
        motion += 0.5 * mass * glm::dot(v, v);
        potential -= mass * glm::dot(gravity, glm::dvec3(nodes.positions[n]));
    }
    double gas = 0.0;
    for (std::uint32_t c = object.cavities.first; c < object.cavities.end(); ++c) {
        const Cavity& cavity = model_->cavities[c];
        gas += cavity.energy(drives_[c], enclosed_volume<Vec4<Real>>(cavity.faces, nodes.positions));
    }
    motions_[body] = motion;
    momenta_[body] = momentum;
    potentials_[body] = potential;
    after_[body] = motion + potential + gas;
    rounding_[body] = tuning::kLeastEnergy * object.mass +
                      tuning::kEnergyRounding * (motion + std::abs(potential) + std::abs(gas));
}

// Each of two bodies has half.
template <class Real>
void EnergyAccount<Real>::find_contacts(const Step& step) {
    std::fill(contacts_at_start_.begin(), contacts_at_start_.end(), 0.0);
    for (std::size_t o = 0; o < contacts_at_end_.size(); ++o)
        if (step.asleep[o] == 0) contacts_at_end_[o] = 0.0;
    for (const ContactRow<Real>& row : step.rows) {
        const Vec3<Real> s = slip<Real>(row, step.displacements);
        const auto start = static_cast<double>(row.energy(Vec3<Real>(0))),
                   end = static_cast<double>(row.energy(s));
        // Rigid bodies are tied so stiffly that, as places are rounded, so is what a load is held with.
        const bool is_stiff = row.is_tie() && model_->objects[row.other].is_rigid;
        const double rounding = is_stiff ? tuning::kEnergyRounding *
                                               glm::length(glm::dvec3(step.current.positions[row.nodes[0]])) *
                                               static_cast<double>(glm::length(row.force(s)))
                                         : 0.0;
        const bool is_first = row.object != kNoNode && model_->is_body(row.object),
                   is_second = model_->is_body(row.other);
        const double share = is_first && is_second ? 0.5 : 1.0;
        for (const auto& [counts, body] :
             {std::pair(is_first, row.object), std::pair(is_second, row.other)}) {
            if (!counts) continue;
            contacts_at_start_[body] += share * start;
            contacts_at_end_[body] += share * end;
            rounding_[body] += rounding;
        }
    }
}

// By held nodes and belts on what a contact presses, and by motors and dampers [J].
template <class Real>
double EnergyAccount<Real>::work_on_rows(const Step& step, const ContactRow<Real>& row) const {
    Vec3<Real> moved(0);  // as much as s by what is held
    for (std::uint32_t k = 0; k < row.count; ++k)
        if (step.previous.positions[row.nodes[k]].w == Real(0))
            moved += row.weights[k] * step.displacements[row.nodes[k]];
    const auto belt = [&](std::uint32_t object) {
        if (row.is_tie()) return Vec3<Real>(0);
        return step.length * Vec3<Real>(model_->surfaces[object - model_->body_count()].velocity);
    };
    if (row.object != kNoNode && !model_->is_body(row.object)) moved -= belt(row.object);
    if (!model_->is_body(row.other)) moved += belt(row.other);
    if (moved == Vec3<Real>(0) && !row.drives) return 0.0;
    const Vec3<Real> s = slip<Real>(row, step.displacements), force = row.force(s);
    double work = -static_cast<double>(glm::dot(force, moved));
    if (row.drives) {
        const Vec3<Real> way = s + row.target;
        work += static_cast<double>(
            std::max({glm::dot(row.force(-row.target), way), glm::dot(force, way), Real(0)}));
    }
    return work;
}

template <class Real>
void EnergyAccount<Real>::find_work(const Step& step) {
    std::fill(work_.begin(), work_.end(), 0.0);
    for (const ContactRow<Real>& row : step.rows)
        work_[model_->is_body(row.other) ? row.other : row.object] += work_on_rows(step, row);
    const auto dot = [](const Vec3<Real>& a, const Vec3<Real>& b) {
        return glm::dot(glm::dvec3(a), glm::dvec3(b));
    };
    const bool acts_on_nodes = !step.loads.empty() || !step.on_held.empty();
    for (std::size_t o = 0; acts_on_nodes && o < work_.size(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const Vec3<Real>& d = step.displacements[n];
            if (!step.loads.empty()) work_[o] += dot(Vec3<Real>(step.loads[n]), d);
            if (!step.on_held.empty() && step.previous.positions[n].w == Real(0))
                work_[o] -= dot(step.on_held[n], d);
        }
    }
    if (step.pulls == nullptr) return;
    for (const std::uint32_t n : step.pulls->nodes()) {
        const Vec4<Real> x = step.previous.positions[n];
        const Vec3<Real>& d = step.displacements[n];
        const auto force = [&](const Vec4<Real>& at) {
            return step.pulls->force_at_end(n, at, Vec3<Real>(x), step.length);
        };
        work_[model_->node_objects[n]] +=
            std::max({dot(force(x), d), dot(force(Vec4<Real>(Vec3<Real>(x) + d, x.w)), d), 0.0});
    }
}

template <class Real>
double EnergyAccount<Real>::measure(const Step& step) {
    find_energies(step.current, step.asleep);
    find_contacts(step);
    find_work(step);
    const std::size_t bodies = after_.size();
    std::vector<double> gained(bodies, 0.0), motions = gained, slacks = gained;
    std::vector<glm::dvec3> momenta(bodies, glm::dvec3(0.0));
    owed_ = vibrations_ = of_bodies_ = gained;
    for (std::size_t o = 0; o < bodies; ++o) {
        if (step.asleep[o] != 0) continue;
        const std::uint32_t island = step.islands.of_bodies[o];
        const double fallen =
            step.islands.are_held[island] != 0 ? 0.0 : potentials_[o] - potentials_before_[o];
        const double gain = after_[o] + contacts_at_end_[o] - before_[o] - work_[o] - fallen;
        owed_[island] += debts_[o] + gain - contacts_before_[o];
        gained[island] += gain - contacts_at_start_[o];
        slacks[island] += rounding_[o];
        motions[island] += motions_before_[o];
        momenta[island] += momenta_[o];
    }
    // What nothing holds moves on as a whole, and falls, as it does.
    for (std::size_t i = 0; i < bodies; ++i) {
        const double mass = step.islands.masses[i];
        if (step.islands.are_held[i] == 0 && mass > 0.0) {
            const glm::dvec3& v = step.islands.velocities[i];
            const double before = 0.5 * mass * glm::dot(v, v),
                         gain = 0.5 * glm::dot(momenta[i], momenta[i]) / mass - before;
            owed_[i] -= gain;
            gained[i] -= gain;
            motions[i] = std::max(motions[i] - before, 0.0);
        }
        slacks[i] += 2.0 * tuning::kHardly * motions[i];
    }
    for (std::size_t i = 0; i < bodies; ++i) {
        dues_[i] = std::max(owed_[i] - slacks[i], 0.0);
        gained[i] = std::max(gained[i] - slacks[i], 0.0);
    }
    find_vibrations(step, [&](std::uint32_t island) { return dues_[island] > 0.0 || gained[island] > 0.0; });
    double most = 0.0;
    for (std::size_t i = 0; i < bodies; ++i) {
        const double beyond = gained[i] - vibrations_[i];
        if (!std::isfinite(beyond)) return std::numeric_limits<double>::infinity();
        if (beyond > 0.0) most = std::max(most, beyond / (beyond + motions[i]));
    }
    return most;
}

template <class Real>
template <class Counts>
void EnergyAccount<Real>::find_vibrations(const Step& step, const Counts& counts) {
    parts_.resize(step.current.positions.size());
    for_each_index(0, of_bodies_.size(), 1, [&](std::size_t o) {
        if (!counts(step.islands.of_bodies[o])) return;
        const Range& nodes = model_->objects[o].nodes;
        const RigidPart<Real> rigid(nodes, step.current);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const Vec4<Real> x = step.current.positions[n];
            if (x.w == Real(0)) continue;
            parts_[n] = Vec3<Real>(step.current.velocities[n]) - Vec3<Real>(rigid.at(x));
            of_bodies_[o] += 0.5 * static_cast<double>(model_->masses[n] * glm::dot(parts_[n], parts_[n]));
        }
    });
    for (std::size_t o = 0; o < of_bodies_.size(); ++o)
        vibrations_[step.islands.of_bodies[o]] += of_bodies_[o];
}

template <class Real>
void EnergyAccount<Real>::settle(const Islands& islands, Nodes<Real>& current) {
    for_each_index(0, after_.size(), 1, [&](std::size_t o) {
        const std::uint32_t island = islands.of_bodies[o];
        double left = std::max(owed_[island], 0.0);
        if (dues_[island] > 0.0 && vibrations_[island] > 0.0) {
            const double part = std::min(dues_[island] / vibrations_[island], 1.0);
            const auto factor = static_cast<Real>(1.0 - std::sqrt(1.0 - part));
            const Range& nodes = model_->objects[o].nodes;
            for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
                if (current.positions[n].w != Real(0))
                    current.velocities[n] -= Vec4<Real>(factor * parts_[n], 0);
            find_energy(o, current);
            left -= part * vibrations_[island];
        }
        debts_[o] = model_->objects[o].mass / islands.masses[island] * left;
    });
}

template class EnergyAccount<float>;
template class EnergyAccount<double>;

}  // namespace gelatin::cpu
