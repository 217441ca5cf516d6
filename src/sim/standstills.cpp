#include "sim/standstills.h"

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <string>

namespace gelatin {
namespace {

// What presses an object most, or nothing.
std::string presser_of(std::uint32_t object, const Model& model, const Solver& solver) {
    std::string name;
    double most = 0.0;
    for (const ContactForces::Between& between : solver.contact_forces().between) {
        if (between.is_plane || (between.object != object && between.other != object)) continue;
        const double pressing = glm::length(between.normal);
        if (pressing <= most) continue;
        most = pressing;
        name = model.objects[between.object == object ? between.other : between.object].name;
    }
    return name;
}

}  // namespace

std::vector<std::string> Standstills::look(const Model& model, const Solver& solver, double time) {
    std::vector<std::string> lines;
    for (const std::uint32_t object : solver.held_up()) {
        if (!told_.insert(object).second) continue;
        const std::string presser = presser_of(object, model, solver);
        lines.push_back(fmt::format("{} '{}' waits at {:.4g} s: {} leaves it no room to move as it should",
                                    model.is_body(object) ? "object" : "collider", model.objects[object].name,
                                    time, presser.empty() ? "what it meets" : "'" + presser + "'"));
    }
    return lines;
}

}  // namespace gelatin
