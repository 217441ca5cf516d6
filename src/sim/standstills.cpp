#include "sim/standstills.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

namespace gelatin {
namespace {

// What presses an object most, or nothing.
std::string presser_of(std::uint32_t object, const Model& model, Solver& solver) {
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

// "collider 'press'", "object 'bar'", and with several handles "handle[1] of object 'bar'", as in errors of
// scenes.
std::string name_of(const Handle& handle, const Model& model) {
    const bool is_body = model.is_body(handle.object);
    const std::string name =
        fmt::format("{} '{}'", is_body ? "object" : "collider", model.objects[handle.object].name);
    const auto is_other = [&](const Handle& other) {
        return other.object == handle.object && !other.is_pin && other.index != handle.index;
    };
    const bool has_others = std::any_of(model.handles.begin(), model.handles.end(), is_other);
    return has_others ? fmt::format("handle[{}] of {}", handle.index, name) : name;
}

std::string blocked_line(const std::string& name, const char* does, double time, std::uint32_t object,
                         const Model& model, Solver& solver) {
    const std::string presser = presser_of(object, model, solver);
    return fmt::format("{} {} at {:.4g} s: {} leaves it no room to move as it should", name, does, time,
                       presser.empty() ? "what it meets" : "'" + presser + "'");
}

}  // namespace

std::vector<std::string> Standstills::look(const Model& model, Solver& solver,
                                           std::span<const std::uint32_t> held_up,
                                           std::span<const double> delays, double time) {
    std::vector<std::string> lines;
    for (const std::uint32_t h : held_up) {
        const Handle& handle = model.handles[h];
        const auto object = static_cast<std::uint32_t>(handle.object);
        if (handle.stops) {
            if (stopped_.insert_or_assign(h, time).second)
                lines.push_back(blocked_line(name_of(handle, model), "stops", time, object, model, solver));
        } else if (told_.insert(object).second) {
            const std::string name = fmt::format("{} '{}'", model.is_body(object) ? "object" : "collider",
                                                 model.objects[object].name);
            lines.push_back(blocked_line(name, "waits", time, object, model, solver));
        }
    }
    for (auto next = stopped_.begin(); next != stopped_.end();) {
        const auto [h, until] = *next;
        if (time - until < kMovesOn) {
            ++next;
            continue;
        }
        std::string line =
            fmt::format("{} has moved on since {:.4g} s", name_of(model.handles[h], model), until);
        if (delays[h] > 0.0) line += fmt::format(", {:.4g} s later than its keyframes", delays[h]);
        lines.push_back(std::move(line));
        next = stopped_.erase(next);
    }
    return lines;
}

}  // namespace gelatin
