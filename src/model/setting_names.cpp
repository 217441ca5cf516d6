#include "model/setting_names.h"

#include <iterator>

namespace gelatin {

const char* name_of(SolverKind solver) {
    switch (solver) {
        case SolverKind::explicit_euler:
            return "explicit_euler";
        case SolverKind::midpoint:
            return "midpoint";
        case SolverKind::rk4:
            return "rk4";
        case SolverKind::implicit:
            return "implicit";
        case SolverKind::semi_implicit_euler:
            break;
    }
    return "semi_implicit_euler";
}

const char* name_of(ForceMethod forces) {
    return forces == ForceMethod::fused ? "fused" : "divide_and_merge";
}

const char* name_of(BroadPhase broad_phase) {
    switch (broad_phase) {
        case BroadPhase::none:
            return "none";
        case BroadPhase::boxes:
            return "boxes";
        case BroadPhase::hierarchy:
            return "hierarchy";
        case BroadPhase::depth:
            return "depth";
    }
    return "";
}

const char* name_of(CollisionDetection detection) {
    return detection == CollisionDetection::continuous ? "continuous" : "discrete";
}

const char* name_of(CollisionResponse response) {
    return response == CollisionResponse::contact ? "contact" : "restore";
}

const char* name_of(Axis axis) {
    return axis == Axis::x ? "x" : axis == Axis::y ? "y" : "z";
}

const char* table_name(const ObjectDescription& object) {
    return object.rigid ? "rigid" : "object";
}

const std::vector<std::string>& spring_kind_names() {
    static const std::vector<std::string> names{"structural", "shear", "flex"};
    return names;
}

std::vector<std::string> kind_names(const SpringKinds& kinds) {
    std::vector<std::string> names;
    const bool has[] = {kinds.structural, kinds.shear, kinds.flex};
    for (std::size_t k = 0; k < std::size(has); ++k) {
        if (has[k]) names.push_back(spring_kind_names()[k]);
    }
    return names;
}

}  // namespace gelatin
