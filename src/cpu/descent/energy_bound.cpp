#include "cpu/descent/energy_bound.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

#include "cpu/descent/rigid_inertia.h"
#include "cpu/elasticity/elastic_energy.h"
#include "model/for_each_index.h"
#include "model/lumped_masses.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {
namespace {

// Of an energy, what is too little to go back for. It is owed.
constexpr double kLittle = 1e-3;
// How often the part that bodies keep of what deforms them is corrected.
constexpr int kMostTries = 4;

}  // namespace

template <class Real>
EnergyBound<Real>::EnergyBound(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      masses_(lumped_masses(*model_)),
      accounts_(model_->body_count()),
      is_open_(model_->body_count()) {}

template <class Real>
void EnergyBound<Real>::restart() {
    std::fill(accounts_.begin(), accounts_.end(), Account{});
}

template <class Real>
void EnergyBound<Real>::begin_parts(const Contacts<Real>& contacts) {
    for (std::size_t o = 0; o < accounts_.size(); ++o)
        accounts_[o].credit = std::min(accounts_[o].credit, contacts.energy(o));
}

template <class Real>
void EnergyBound<Real>::begin(const Start& start, const Contacts<Real>& contacts) {
    length_ = start.length;
    starts_ = start.starts;
    load_forces_ = start.load_forces;
    tbb::parallel_for(std::size_t(0), accounts_.size(), [&](std::size_t o) {
        const ModelObject& object = model_->objects[o];
        const auto is_own = [&](std::uint32_t n) {
            return n >= object.nodes.first && n < object.nodes.end();
        };
        is_open_[o] = contacts.is_held(o) || std::any_of(start.pulled.begin(), start.pulled.end(), is_own);
        if (is_open_[o] != 0) {
            accounts_[o] = {};
            return;
        }
        Account& account = accounts_[o];
        account.elastic_then =
            account.is_known ? account.elastic : body_energy<Real>(*model_, object, start.nodes.positions);
        account.kinetic_then = 0.0;
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
            const glm::dvec3 velocity(start.nodes.velocities[n]);
            account.kinetic_then +=
                0.5 * static_cast<double>(model_->masses[n]) * glm::dot(velocity, velocity);
        }
    });
}

// The account with what the body has at `positions`.
template <class Real>
typename EnergyBound<Real>::Account EnergyBound<Real>::at(std::uint32_t object,
                                                          std::span<const Vec4<Real>> positions) const {
    Account account = accounts_[object];
    double square = 0.0;
    account.work = 0.0;
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 way = glm::dvec3(positions[n]) - glm::dvec3(starts_[n]);
        const auto mass = static_cast<double>(model_->masses[n]);
        square += mass * glm::dot(way, way);
        account.work += mass * glm::dot(glm::dvec3(model_->gravity), way);
        if (!load_forces_.empty()) account.work += glm::dot(glm::dvec3(load_forces_[n]), way);
    }
    account.kinetic_now = 0.5 * square / (length_ * length_);
    account.elastic_now = body_energy<Real>(*model_, model_->objects[object], positions);
    return account;
}

template <class Real>
void EnergyBound<Real>::measure(std::span<const Vec4<Real>> positions) {
    for_each_index(0, accounts_.size(), 1, [&](std::size_t o) {
        if (is_open_[o] == 0) accounts_[o] = at(static_cast<std::uint32_t>(o), positions);
    });
}

// Bodies of islands, or each by itself, but for those that something unknown moves: a hand, held nodes, or a
// collider near one of them.
template <class Real>
std::vector<typename EnergyBound<Real>::Group> EnergyBound<Real>::closed_groups(
    const Contacts<Real>* acting) const {
    const std::size_t bodies = accounts_.size();
    if (acting == nullptr) {
        std::vector<Group> groups;
        for (std::uint32_t o = 0; o < bodies; ++o)
            if (is_open_[o] == 0) groups.push_back({o});
        return groups;
    }
    const ContactList<Real>& list = acting->list();
    std::vector<Group> groups(list.shifts.size());
    std::vector<std::uint8_t> is_open(groups.size());
    for (std::uint32_t o = 0; o < bodies; ++o) {
        groups[list.islands[o]].push_back(o);
        if (is_open_[o] != 0) is_open[list.islands[o]] = 1;
    }
    const auto moves = [](const RigidSurface& surface) {
        return surface.moves || surface.velocity != glm::vec3(0.0f);
    };
    if (std::any_of(model_->surfaces.begin(), model_->surfaces.end(), moves))
        for (const ContactPair& pair : list.pairs)
            if (pair.other >= bodies && moves(model_->surfaces[pair.other - bodies]))
                is_open[list.island_of(pair)] = 1;
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (is_open[i] != 0) groups[i].clear();
    std::erase_if(groups, [](const Group& group) { return group.empty(); });
    return groups;
}

// Where the step ends.
template <class Real>
double EnergyBound<Real>::most_energy(const Group& group) const {
    double most = 0.0;
    for (const std::uint32_t o : group)
        most += accounts_[o].before() + accounts_[o].credit + accounts_[o].work;
    return most;
}

// In steps of this length contacts hold weights with (g h)^2 / 2 a mass: bodies settle by as much.
template <class Real>
double EnergyBound<Real>::settling(const Group& group) const {
    const double gained = length_ * glm::length(glm::dvec3(model_->gravity));
    double mass = 0.0;
    for (const std::uint32_t o : group) mass += masses_[o];
    return 0.5 * mass * gained * gained;
}

template <class Real>
double EnergyBound<Real>::little(const Group& group) const {
    double before = 0.0;
    for (const std::uint32_t o : group) before += accounts_[o].before();
    return kLittle * before + settling(group);
}

template <class Real>
bool EnergyBound<Real>::plan(const Contacts<Real>* acting, std::span<const Vec4<Real>> positions,
                             std::vector<Vec4<Real>>& ends) const {
    std::vector<Group> groups = closed_groups(acting);
    std::erase_if(groups, [&](const Group& group) {
        double now = 0.0;
        for (const std::uint32_t o : group) now += accounts_[o].now();
        return now <= most_energy(group) + little(group);
    });
    if (groups.empty()) return false;
    ends.assign(positions.begin(), positions.end());
    std::vector<std::uint8_t> moves(groups.size());
    for_each_index(0, groups.size(), 1,
                   [&](std::size_t i) { moves[i] = move_back(groups[i], positions, ends) ? 1 : 0; });
    return std::find(moves.begin(), moves.end(), 1) != moves.end();
}

// The energy grows with nearly the square of the part that bodies keep of what deforms them.
template <class Real>
bool EnergyBound<Real>::move_back(const Group& group, std::span<const Vec4<Real>> positions,
                                  std::vector<Vec4<Real>>& ends) const {
    Group deformed;
    std::vector<std::vector<glm::dvec3>> motions;
    double others = -most_energy(group), of_deformed = 0.0;  // of the excess
    for (const std::uint32_t o : group) {
        const Account& account = accounts_[o];
        if (account.elastic_now > account.elastic_then) {
            deformed.push_back(o);
            motions.push_back(rigid_motion(o, positions));
            others += account.work;
            of_deformed += account.now() - account.work;
        } else {
            others += account.now();
        }
    }
    if (deformed.empty()) return false;
    const auto excess_with = [&](double part) {
        double excess = others;
        for (std::size_t k = 0; k < deformed.size(); ++k) {
            const Range& nodes = model_->objects[deformed[k]].nodes;
            for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
                const glm::dvec3& rigid = motions[k][n - nodes.first];
                const glm::dvec3 end = rigid + part * (glm::dvec3(positions[n]) - rigid);
                ends[n] = Vec4<Real>(Vec3<Real>(end), positions[n].w);
            }
            const Account account = at(deformed[k], ends);
            excess += account.now() - account.work;
        }
        return excess;
    };
    const double enough = little(group), least = excess_with(0.0);
    double part = 1.0, excess = others + of_deformed;
    for (int k = 0; k < kMostTries && least < 0.0; ++k) {
        part *= std::sqrt(least / (least - excess));
        excess = excess_with(part);
        if (excess <= enough) return true;
    }
    excess_with(0.0);
    return true;
}

// Of the shape that the body had when the step began, nearest to its nodes.
template <class Real>
std::vector<glm::dvec3> EnergyBound<Real>::rigid_motion(std::uint32_t object,
                                                        std::span<const Vec4<Real>> positions) const {
    const Range& nodes = model_->objects[object].nodes;
    glm::dvec3 center_then(0.0), center(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const double part = static_cast<double>(model_->masses[n]) / masses_[object];
        center_then += part * glm::dvec3(starts_[n]);
        center += part * glm::dvec3(positions[n]);
    }
    glm::dmat3 moment(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        moment += static_cast<double>(model_->masses[n]) *
                  glm::outerProduct(glm::dvec3(positions[n]) - center, glm::dvec3(starts_[n]) - center_then);
    const glm::dmat3 rotation = nearest_rotation(moment);
    std::vector<glm::dvec3> ends;
    ends.reserve(nodes.count);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        ends.push_back(center + rotation * (glm::dvec3(starts_[n]) - center_then));
    return ends;
}

template <class Real>
void EnergyBound<Real>::end(const Contacts<Real>* acting, std::span<const Vec4<Real>> positions,
                            std::span<Vec4<Real>> velocities) {
    for (Account& account : accounts_) {
        account.is_known = true;
        account.elastic = account.elastic_now;
    }
    for (const Group& group : closed_groups(acting)) {
        double motion = 0.0, kinetic = 0.0, elastic = 0.0, before = 0.0;
        for (const std::uint32_t o : group) {
            motion += accounts_[o].kinetic_then + accounts_[o].work;
            kinetic += accounts_[o].kinetic_now;
            elastic += accounts_[o].elastic_now;
            before += accounts_[o].before();
        }
        const double left = most_energy(group) - elastic;
        const double most = std::max(left, std::min(motion, kinetic));
        if (kinetic > most + little(group)) {
            slow_down(group, most, positions, velocities);
            kinetic = most;
        }
        const double lost = left - kinetic, owed = std::min(lost + settling(group), 0.0);
        for (const std::uint32_t o : group)
            accounts_[o].credit =
                before > 0.0 ? (std::max(lost, 0.0) + owed) * accounts_[o].before() / before : 0.0;
    }
    for (std::size_t o = 0; o < accounts_.size(); ++o)
        if (is_open_[o] != 0) accounts_[o] = {};
}

template <class Real>
void EnergyBound<Real>::slow_down(const Group& group, double most_kinetic,
                                  std::span<const Vec4<Real>> positions,
                                  std::span<Vec4<Real>> velocities) const {
    struct GroupMotion {
        RigidInertia inertia;
        Twist twist;
        explicit GroupMotion(const RigidSums& sums)
            : inertia(sums), twist(inertia.twist(sums.force, sums.moment)) {}
        double energy() const { return inertia.energy(twist); }
        glm::dvec3 at(const glm::dvec3& x) const { return twist.at(x - inertia.center); }
    };
    const glm::dvec3 origin(positions[model_->objects[group.front()].nodes.first]);
    const auto arm = [&](std::uint32_t n) { return glm::dvec3(positions[n]) - origin; };
    std::vector<GroupMotion> motions;
    RigidSums of_all;  // with masses for stiffnesses, and momenta for forces
    double all = 0.0, rigid = 0.0;
    for (const std::uint32_t o : group) {
        RigidSums sums;
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const auto mass = static_cast<double>(model_->masses[n]);
            sums.add(arm(n), mass, mass * glm::dvec3(velocities[n]));
        }
        of_all.add(sums);
        motions.emplace_back(sums);
        rigid += motions.back().energy();
        all += accounts_[o].kinetic_now;
    }
    const GroupMotion common(of_all);
    // Of what is there besides a part that stays.
    const auto kept = [&](double stays, double sum) {
        return sum > stays ? std::sqrt(std::clamp((most_kinetic - stays) / (sum - stays), 0.0, 1.0)) : 1.0;
    };
    const double of_rigid = kept(common.energy(), rigid), of_rest = kept(rigid, all);
    for (std::size_t k = 0; k < group.size(); ++k) {
        const Range& nodes = model_->objects[group[k]].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 of_body = motions[k].at(arm(n)), of_island = common.at(arm(n));
            const glm::dvec3 slower = of_island + of_rigid * (of_body - of_island) +
                                      of_rest * (glm::dvec3(velocities[n]) - of_body);
            velocities[n] = Vec4<Real>(Vec3<Real>(slower), velocities[n].w);
        }
    }
}

template class EnergyBound<float>;
template class EnergyBound<double>;

}  // namespace gelatin::cpu
