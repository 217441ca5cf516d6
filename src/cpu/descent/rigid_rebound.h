#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "cpu/contact/contacts.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/rigid_inertia.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Restitution (docs/contact.md). Bodies bounce by their elasticity, of which implicit steps leave little
/// where bodies are stiff. Those that leave each other with less than the restitution times the speed at
/// which they met, or still lie there when the impact is over, get that speed, as rigid bodies.
template <class Real>
class RigidRebound {
public:
    /// @param wave_times of its objects [s]; must outlive this
    RigidRebound(std::shared_ptr<const Model> model, std::span<const double> wave_times);

    /// Forgets what has met.
    void restart() { meetings_.clear(); }

    /// A step, as it is without restitution.
    struct Step {
        double length, resting_speed;  ///< [s]; what meets slower stays [m/s]
        /// Velocities when it began, shape [nodes]; starts as of StepState; positions at its end.
        std::span<const Vec4<Real>> before, starts, positions;
    };
    /// To be called at the end of a step. Bodies with held nodes do not change.
    /// @param velocities at its end, input and output, shape [nodes]
    void run(const Step& step, const Contacts<Real>& contacts, const ColliderContacts<Real>& planes,
             std::span<Vec4<Real>> velocities);

private:
    // Objects, or a body and a plane, which comes first and has its number among the colliders.
    struct Pair {
        bool has_plane;
        std::uint32_t first, second;
        bool operator<(const Pair& p) const {
            return std::tie(has_plane, first, second) < std::tie(p.has_plane, p.first, p.second);
        }
    };
    // A point where two sides press each other.
    struct Touch {
        std::array<glm::dvec3, 2> points{};      // of bodies that move as a whole: from their centres [m]
        std::array<glm::dvec3, 2> velocities{};  // of other sides [m/s]
        glm::dvec3 normal{0.0};                  // from the first side to the second
    };
    // Of two: of their motion as rigid ones, and with what they will give back of all else [J].
    struct Energy {
        double rigid = 0.0, sum = 0.0;
    };
    // Two that have met, since then.
    struct Meeting {
        std::array<Twist, 2> twists;   // when they met
        Energy energy;                 // then
        double approach = 0.0;         // then, of their fastest point [m/s]
        double latest_approach = 0.0;  // when they pressed each other last
        double age = 0.0;              // [s]
        std::vector<Touch> touches;    // when they pressed each other last
        bool presses = true;           // in this step
    };
    struct Body;
    struct Push;
    // Of all nodes, at the start or the end of a step of so many seconds; and the twists of bodies then.
    struct State {
        double step;
        std::span<const Vec4<Real>> positions, velocities;
        Twist Body::*twist;
    };
    using Bodies = std::map<std::uint32_t, Body>;  // by object
    using Touches = std::map<Pair, std::vector<Touch>>;

    Vec3<Real> velocity_before(const Step& step, std::uint32_t node) const;
    std::vector<std::uint8_t> find_fast(const Step& step) const;
    Touches find_touches(const Step& step, const Contacts<Real>& contacts,
                         const ColliderContacts<Real>& planes) const;
    std::optional<Touch> find_touch(const Step& step, const Contacts<Real>& contacts,
                                    const Press<Real>& press) const;
    void add_planes(const Step& step, const ColliderContacts<Real>& planes, std::uint32_t object,
                    bool is_fast, Touches& touches) const;
    std::array<Body*, 2> sides_of(const Pair& pair, Bodies& bodies) const;
    Bodies measure(const Step& step, const Touches& touches, const Contacts<Real>& contacts,
                   std::span<const Vec4<Real>> velocities) const;
    Body measure(const Step& step, std::uint32_t object, std::span<const Vec4<Real>> velocities) const;
    void meet(const Step& step, Touches touches, Bodies& bodies);
    Energy energy_of(const Pair& pair, const std::array<Body*, 2>& sides, std::span<const Touch> touches,
                     const State& state) const;
    double internal_energy(std::uint32_t object, const Body* body, const State& state) const;
    static void meet_in_one_point(Push& push);
    static void push_apart(std::vector<Push>& pushes);
    static void limit_energy(std::span<Push> of_meeting);
    std::vector<Push> end_meetings(const Step& step, const Contacts<Real>& contacts,
                                   std::span<const Vec4<Real>> velocities, Bodies& bodies);
    bool is_over(const Step& step, const Meeting& meeting, const std::array<Body*, 2>& sides, bool presses,
                 double wave_time) const;

    std::shared_ptr<const Model> model_;
    std::span<const double> wave_times_;
    std::map<Pair, Meeting> meetings_;
};

}  // namespace gelatin::cpu
