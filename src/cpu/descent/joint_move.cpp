#include "cpu/descent/joint_move.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cpu/descent/rigid_motion.h"
#include "cpu/descent/rigid_nodes.h"

namespace gelatin::cpu {
namespace {

using Motion = Eigen::Matrix<double, 6, 1>;  // a translation [m] and a rotation
using Block = Eigen::Matrix<double, 6, 6>;

// Conjugate gradients end when the residual is this small, or after so many steps.
constexpr double kResidual = 1e-6;
constexpr int kMostSteps = 100;
// The line search halves its bracket so often.
constexpr int kHalvings = 12;
// Longest rotation of a step.
constexpr double kMostRotation = 1.0;

Motion motion(const glm::dvec3& translation, const glm::dvec3& rotation) {
    Motion m;
    m << translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z;
    return m;
}

// How a point at r from the origin moves along a direction.
Motion along(const glm::dvec3& r, const glm::dvec3& direction) {
    return motion(direction, glm::cross(r, direction));
}

struct Body {
    explicit Body(std::uint32_t of) : object(of) {}

    std::uint32_t object;
    glm::dvec3 origin{0.0};  // centre of mass [m]
    Block matrix = Block::Zero();
    Motion force = Motion::Zero();
    double stiffness = 0.0;  // sum of m / h^2 [N/m]

    void add(const Motion& row, double stiffness_along, double force_along) {
        matrix += stiffness_along * row * row.transpose();
        force += force_along * row;
    }
};

// A pair of the bodies, which are numbered within their island; kNoNode: held.
struct Touch {
    std::uint32_t a = kNoNode, b = kNoNode;
    Motion row_a, row_b;                             // how its gap changes
    double gap = 0.0, stiffness = 0.0, reach = 0.0;  // [m], [N/m]
    double change = 0.0;                             // of the gap by the step
    double friction = 0.0;
    // What would hold the first side if nothing slid [N], and directions across the normal, the first along
    // it.
    glm::dvec3 hold{0.0};
    std::array<glm::dvec3, 2> across{};
    std::array<glm::dvec3, 2> arms{};
};

struct Coupling {
    std::uint32_t a, b;
    Block block;
};

/// The bodies of an island, and Newton's system of their rigid motions.
class Island {
public:
    std::vector<Body> bodies;
    std::vector<Touch> touches;
    bool is_held = false;
    bool is_outside_touched = false;  // a body is in contact with a collider

    // The motions of all bodies at which the objective is least. Friction depends on how contacts press, of
    // which sweeps find far too much in stiff bodies: it is taken by what a first solution leaves of that.
    std::vector<Motion> find_motions() {
        const auto slips = [](const Touch& touch) { return touch.friction == 0.0; };
        if (std::all_of(touches.begin(), touches.end(), slips)) return solve_once();
        const std::vector<Body> bodies_alone = bodies;
        solve_once();
        bodies = bodies_alone;
        for (Coupling& coupling : couplings_) coupling.block.setZero();
        return solve_once();
    }

private:
    void add(const Touch& touch, const Motion& row_a, const Motion& row_b, double stiffness, double force) {
        const bool has_a = touch.a != kNoNode, has_b = touch.b != kNoNode;
        if (has_a) bodies[touch.a].add(row_a, stiffness, force);
        if (has_b) bodies[touch.b].add(row_b, stiffness, force);
        if (!has_a || !has_b) return;
        const auto [place, is_new] = index_.try_emplace({touch.a, touch.b}, couplings_.size());
        if (is_new) couplings_.push_back({touch.a, touch.b, Block::Zero()});
        couplings_[place->second].block += stiffness * row_a * row_b.transpose();
    }

    // @param limit the most that friction may be [N]
    void add_friction(const Touch& touch, double limit) {
        std::array<double, 2> stiffnesses{touch.stiffness, touch.stiffness};
        glm::dvec3 hold = touch.hold;
        const double length = glm::length(hold);
        if (length > limit) {
            hold *= limit / length;
            stiffnesses[1] *= limit / length;
            stiffnesses[0] = kSlipShare<double> * stiffnesses[1];
        }
        for (std::size_t k = 0; k < 2; ++k)
            add(touch, along(touch.arms[0], -touch.across[k]), along(touch.arms[1], touch.across[k]),
                stiffnesses[k], -glm::dot(hold, touch.across[k]));
    }

    // By the changes of gaps of the solution before, if there is one.
    std::vector<Motion> solve_once() {
        for (const Touch& touch : touches) {
            const double force = contact_force(touch.gap, touch.reach, touch.stiffness);
            if (force > 0.0)
                add(touch, touch.row_a, touch.row_b, contact_hessian(touch.gap, touch.reach, touch.stiffness),
                    force);
            const double limit =
                touch.friction * contact_force(touch.gap + touch.change, touch.reach, touch.stiffness);
            if (limit > 0.0) add_friction(touch, limit);
        }
        std::vector<Motion> motions = solve();
        Motion common = is_held ? Motion::Zero() : common_motion(motions);
        for (Motion& motion : motions) motion -= common;
        // Contacts cancel in the sum, so that momentum does not depend on how well the rest was solved.
        if (!is_held && !is_outside_touched) common = free_motion();
        const double part = least_along(motions, common);
        for (Touch& touch : touches) touch.change *= part;
        for (Motion& motion : motions) motion = part * motion + common;
        return motions;
    }

    // By conjugate gradients, preconditioned with the bodies' own blocks.
    std::vector<Motion> solve() const {
        const std::size_t count = bodies.size();
        std::vector<Eigen::LLT<Block>> own;
        for (const Body& body : bodies) own.emplace_back(body.matrix);
        std::vector<Motion> x(count, Motion::Zero()), r, z(count), p;
        for (const Body& body : bodies) r.push_back(body.force);
        const auto precondition = [&] {
            for (std::size_t k = 0; k < count; ++k) z[k] = own[k].solve(r[k]);
            return dot(r, z);
        };
        double now = precondition();
        const double enough = kResidual * kResidual * now;
        p = z;
        for (int i = 0; i < kMostSteps && now > enough; ++i) {
            const std::vector<Motion> q = product(p);
            const double curvature = dot(p, q);
            if (!(curvature > 0.0)) break;
            const double length = now / curvature;
            for (std::size_t k = 0; k < count; ++k) {
                x[k] += length * p[k];
                r[k] -= length * q[k];
            }
            const double before = std::exchange(now, precondition());
            for (std::size_t k = 0; k < count; ++k) p[k] = z[k] + now / before * p[k];
        }
        return x;
    }

    // The mean translation by mass, which changes no gap.
    Motion common_motion(const std::vector<Motion>& motions) const {
        Motion sum = Motion::Zero();
        double stiffness = 0.0;
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            sum.head<3>() += bodies[k].stiffness * motions[k].head<3>();
            stiffness += bodies[k].stiffness;
        }
        return sum / stiffness;
    }

    // What brings all of them to their targets on average.
    Motion free_motion() const {
        Motion sum = Motion::Zero();
        double stiffness = 0.0;
        for (const Body& body : bodies) {
            sum.head<3>() += body.force.head<3>();
            stiffness += body.stiffness;
        }
        return sum / stiffness;
    }

    // The part of the motions, after the common one, at which the objective is least: contacts as they are,
    // the rest to second order. Newton's step alone would throw bodies through the reach of others.
    double least_along(const std::vector<Motion>& motions, const Motion& common) {
        const std::vector<Motion> product_of = product(motions);
        double pull = 0.0, curvature = dot(motions, product_of);
        for (std::size_t k = 0; k < bodies.size(); ++k)
            pull += bodies[k].force.dot(motions[k]) - common.dot(product_of[k]);
        for (Touch& touch : touches) {
            touch.change = 0.0;
            if (touch.a != kNoNode) touch.change += touch.row_a.dot(motions[touch.a]);
            if (touch.b != kNoNode) touch.change += touch.row_b.dot(motions[touch.b]);
            pull -= contact_force(touch.gap, touch.reach, touch.stiffness) * touch.change;
            curvature -=
                contact_hessian(touch.gap, touch.reach, touch.stiffness) * touch.change * touch.change;
        }
        const auto slope_at = [&](double part) {
            double slope = part * curvature - pull;
            for (const Touch& touch : touches)
                slope -= contact_force(touch.gap + part * touch.change, touch.reach, touch.stiffness) *
                         touch.change;
            return slope;
        };
        if (!(slope_at(1.0) > 0.0)) return 1.0;
        double low = 0.0, high = 1.0;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (low + high);
            (slope_at(middle) > 0.0 ? high : low) = middle;
        }
        return low;
    }

    static double dot(const std::vector<Motion>& a, const std::vector<Motion>& b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
        return sum;
    }
    std::vector<Motion> product(const std::vector<Motion>& p) const {
        std::vector<Motion> q(p.size());
        for (std::size_t k = 0; k < bodies.size(); ++k) q[k] = bodies[k].matrix * p[k];
        for (const Coupling& coupling : couplings_) {
            q[coupling.a] += coupling.block * p[coupling.b];
            q[coupling.b] += coupling.block.transpose() * p[coupling.a];
        }
        return q;
    }

    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> index_;
    std::vector<Coupling> couplings_;
};

template <class Real>
Body make_body(std::uint32_t object, const Range& nodes, const StepObjective<Real>& objective,
               const ColliderContacts<Real>& colliders, std::span<const Vec4<Real>> positions) {
    Body body(object);
    const glm::dvec3 first(positions[nodes.first]);
    RigidSums sums = sum_rigid_nodes(
        positions.subspan(nodes.first, nodes.count),
        std::span<const Vec4<Real>>(objective.step.targets).subspan(nodes.first, nodes.count), first);
    const glm::dvec3 center = sums.arm / sums.stiffness;
    body.origin = first + center;
    body.stiffness = sums.stiffness;
    sums.square.add_outer(-sums.stiffness, center);  // round the centre of mass
    sums.moment -= glm::cross(center, sums.force);
    body.force = motion(sums.force, sums.moment);
    const glm::dvec3 &d = sums.square.diagonal, &b = sums.square.beside;
    const double trace = d.x + d.y + d.z;
    constexpr double kThin = 1e-6;  // a row of nodes has no inertia about itself
    body.matrix.diagonal() = motion(glm::dvec3(sums.stiffness), (1.0 + kThin) * glm::dvec3(trace) - d);
    body.matrix(3, 4) = body.matrix(4, 3) = -b.z;
    body.matrix(4, 5) = body.matrix(5, 4) = -b.x;
    body.matrix(5, 3) = body.matrix(3, 5) = -b.y;
    if (colliders.objects[object] == 0) return body;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const ColliderContact<Real>& contact = colliders.nodes[n];
        if (contact.along == Real(0)) continue;
        const glm::dvec3 r = glm::dvec3(positions[n]) - body.origin, normal(contact.normal);
        const auto across = static_cast<double>(contact.across);
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 axis(0.0);
            axis[k] = 1.0;
            body.add(along(r, axis), across, static_cast<double>(contact.force[k]));
        }
        body.add(along(r, normal), static_cast<double>(contact.along) - across, 0.0);
    }
    return body;
}

}  // namespace

template <class Real>
void add_pair(const ContactPair& pair, const ContactAims<Real>& aims, const Press<Real>& press,
              const std::vector<std::uint32_t>& numbers, std::span<const Vec4<Real>> positions,
              Island& island) {
    std::array<glm::dvec3, 2> arms{};
    for (std::size_t k = 0; k < 4; ++k)
        arms[pair.side_of(k)] +=
            static_cast<double>(press.weights[static_cast<int>(k)]) * glm::dvec3(positions[pair.nodes[k]]);
    const std::array<std::uint32_t, 2> bodies{numbers[pair.object], numbers[pair.other]};
    for (std::size_t side = 0; side < 2; ++side)
        if (bodies[side] != kNoNode) arms[side] -= island.bodies[bodies[side]].origin;
    const glm::dvec3 normal(press.normal);
    Touch touch;
    touch.a = bodies[0];
    touch.b = bodies[1];
    touch.row_a = along(arms[0], -normal);
    touch.row_b = along(arms[1], normal);
    touch.gap = static_cast<double>(aims.gap(pair, press, positions));
    touch.stiffness = static_cast<double>(press.stiffness);
    touch.reach = static_cast<double>(press.reach);
    touch.friction = static_cast<double>(press.friction);
    touch.arms = arms;
    touch.hold = glm::dvec3(aims.hold(pair, press, positions));
    const double length = glm::length(touch.hold);
    const glm::dvec3 axis = std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = length > 0.0 ? touch.hold / length : glm::cross(normal, axis);
    touch.across[0] = glm::normalize(first - glm::dot(first, normal) * normal);
    touch.across[1] = glm::cross(normal, touch.across[0]);
    island.touches.push_back(touch);
}

template <class Real>
JointMove<Real>::JointMove(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

template <class Real>
void JointMove<Real>::run(bool is_last, const Contacts<Real>& contacts, const StepObjective<Real>& objective,
                          const ColliderContacts<Real>& colliders, std::span<const Vec4<Real>> positions,
                          std::span<Vec4<Real>> ends) const {
    const ContactList<Real>& list = contacts.list();
    const std::size_t objects = model_->objects.size();
    std::vector<Island> islands(list.shifts.size());
    std::vector<std::uint32_t> numbers(objects, kNoNode);  // of bodies within their islands
    std::vector<std::uint8_t> waits(islands.size());
    for (std::uint32_t o = 0; o < objects; ++o) {
        const std::uint32_t i = list.islands[o];
        // The last sweep has left nodes outside colliders: bodies that touch one do not move after it.
        if (list.is_alone[i] != 0 || (is_last && colliders.objects[o] != 0)) waits[i] = 1;
        islands[i].is_held |= list.is_fixed[i] != 0 || contacts.is_held(o);
        if (contacts.is_held(o)) {
            continue;
        }
        numbers[o] = static_cast<std::uint32_t>(islands[i].bodies.size());
        islands[i].bodies.emplace_back(o);
    }
    const std::vector<Press<Real>>& presses = contacts.aims().presses();
    std::vector<std::vector<std::uint32_t>> own(islands.size());  // presses of each island
    for (std::uint32_t k = 0; k < presses.size(); ++k) {
        const ContactPair& pair = list.pairs[presses[k].pair];
        if (!pair.is_own()) own[list.island_of(pair)].push_back(k);
    }
    tbb::parallel_for(std::size_t(0), islands.size(), [&](std::size_t i) {
        Island& island = islands[i];
        if (waits[i] != 0 || island.bodies.empty()) return;
        for (Body& body : island.bodies) {
            body = make_body<Real>(body.object, model_->objects[body.object].nodes, objective, colliders,
                                   positions);
            island.is_outside_touched |= colliders.objects[body.object] != 0;
        }
        for (const std::uint32_t k : own[i])
            add_pair(list.pairs[presses[k].pair], contacts.aims(), presses[k], numbers, positions, island);
        const std::vector<Motion> motions = island.find_motions();
        for (std::size_t k = 0; k < motions.size(); ++k) {
            const Motion& m = motions[k];
            if (!m.allFinite()) return;
            glm::dvec3 rotation(m(3), m(4), m(5));
            const double length = glm::length(rotation);
            if (length > kMostRotation) rotation *= kMostRotation / length;
            const Range& nodes = model_->objects[island.bodies[k].object].nodes;
            move_rigid_nodes({island.bodies[k].origin, {m(0), m(1), m(2)}, cayley_rotation(rotation)},
                             ends.subspan(nodes.first, nodes.count));
        }
    });
}

template class JointMove<float>;
template class JointMove<double>;

}  // namespace gelatin::cpu
