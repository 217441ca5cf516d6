#include "model/setting_names.h"

namespace gelatin {

const char* name_of(SolverKind solver) {
    switch (solver) {
        case SolverKind::explicit_euler:
            return "explicit_euler";
        case SolverKind::midpoint:
            return "midpoint";
        case SolverKind::rk4:
            return "rk4";
        case SolverKind::vbd:
            return "vbd";
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

const char* name_of(CollisionResponse /*response*/) {
    return "restore";
}

}  // namespace gelatin
