#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "gpu/support/end_reference.h"
#include "model/model.h"

namespace gelatin::test {

constexpr double kStepSize = 1.0 / 60.0;  ///< of steps whose parts are ended [s]

/// What happens to a part before its end, beside its solve.
struct PartChange {
    double step = kStepSize / 4.0;  ///< [s]
    double noise = 0.0;             ///< of displacements, as a speed [m/s]
    glm::dvec3 push{0.0};           ///< of all nodes, as a speed [m/s]
    glm::dvec3 last_push{0.0};      ///< of the last body's alone
    bool breaks = false;            ///< a displacement is no number
    bool sets_velocities = false;   ///< before it, from outside
    bool forgets = false;           ///< before it
    bool goes_on = false;           ///< before it, with velocities of before
    bool is_apart = false;          ///< no object touches another in it
    bool strikes = false;           ///< before it, the first body
};

/// Parts, one after the other.
struct EndCase {
    std::shared_ptr<const Model> model;
    std::vector<PartChange> parts;
    double restitution = 0.0;
    bool is_pulled = false;
    std::vector<EndReference::Outcome> outcomes = {};  // of tries that have to be among them
    bool is_struck = false;                            ///< some body has to be struck
    bool is_guarded = false;                           ///< the guard has to move nodes
    bool bounces = false;                              ///< some body has to end an impact faster
    bool contacts = false;                             ///< objects meet each other, and bodies themselves
    /// With contacts: the most bodies of an island of any part; whether bodies that are tied have to go by
    /// different schemes.
    std::uint32_t island = 0;
    bool is_torn = false;
    int own_rows = 0;  ///< of the first body with itself
};

/// @return the greatest error over its bound
double end_error(const EndCase& at);
std::vector<glm::vec4> velocities_after(const EndCase& at);
/// All programs of the end of a part are run once.
void use_programs(const EndCase& at);

}  // namespace gelatin::test
