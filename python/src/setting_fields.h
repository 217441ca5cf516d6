#pragma once

#include <optional>

#include "fields.h"
#include "gelatin/scene.h"

namespace gelatin::python {

/// A number that "auto" leaves to Gelatin, as None does.
struct Automatic {
    std::optional<int>& number;
};

template <>
struct Fields<SimulationSettings> {
    static constexpr const char* kClass = "SimulationSettings";
    static void visit(SimulationSettings& s, auto&& field) {
        auto& [solver, forces, frame_rate, substeps, iterations, gravity, frames, sleep] = s;
        field("solver", solver);
        field("forces", forces);
        field("frame_rate", frame_rate);
        Automatic count{substeps};
        field("substeps", count);
        field("iterations", iterations);
        field("gravity", gravity);
        field("frames", frames);
        field("sleep", sleep);
    }
};

template <>
struct Fields<MaterialPair> {
    static constexpr const char* kClass = "MaterialPair";
    static void visit(MaterialPair& p, auto&& field) {
        auto& [first, second, friction, contact_stiffness, restitution] = p;
        field("first", first);
        field("second", second);
        field("friction", friction);
        field("contact_stiffness", contact_stiffness);
        field("restitution", restitution);
    }
};

template <>
struct Fields<CollisionSettings> {
    static constexpr const char* kClass = "CollisionSettings";
    static void visit(CollisionSettings& c, auto&& field) {
        auto& [broad_phase, detection, response, self_collision, proximity_radius, friction, restitution,
               pairs] = c;
        field("broad_phase", broad_phase);
        field("detection", detection);
        field("response", response);
        field("self_collision", self_collision);
        field("proximity_radius", proximity_radius);
        field("friction", friction);
        field("restitution", restitution);
        field("pairs", pairs);
    }
};

template <>
struct Fields<SpringKinds> {
    static constexpr const char* kClass = "SpringKinds";
    static void visit(SpringKinds& k, auto&& field) {
        auto& [structural, shear, flex] = k;
        field("structural", structural);
        field("shear", shear);
        field("flex", flex);
    }
};

template <>
struct Fields<Material> {
    static constexpr const char* kClass = "Material";
    static void visit(Material& m, auto&& field) {
        auto& [name, model, youngs_modulus, density, poisson_ratio, damping, springs, friction, thickness,
               contact_stiffness, restitution, line] = m;
        field("name", name);
        field("model", model);
        field("youngs_modulus", youngs_modulus);
        field("density", density);
        field("poisson_ratio", poisson_ratio);
        field("damping", damping);
        field("springs", springs);
        field("friction", friction);
        field("thickness", thickness);
        field("contact_stiffness", contact_stiffness);
        field("restitution", restitution);
        field("line", line);
    }
};

}  // namespace gelatin::python
