#include <imgui.h>

#include <array>
#include <glm/geometric.hpp>

#include "panels.h"

namespace gelatin::viewer {
namespace {

struct SolverChoice {
    SolverKind kind;
    const char* name;
};
constexpr std::array kSolvers{
    SolverChoice{SolverKind::implicit, "implicit"},
    SolverChoice{SolverKind::semi_implicit_euler, "semi_implicit_euler"},
    SolverChoice{SolverKind::explicit_euler, "explicit_euler"},
    SolverChoice{SolverKind::midpoint, "midpoint"},
    SolverChoice{SolverKind::rk4, "rk4"},
};

bool choose_solver(SolverKind& solver) {
    const char* present = "";
    for (const SolverChoice& choice : kSolvers) {
        if (choice.kind == solver) present = choice.name;
    }
    bool changed = false;
    if (ImGui::BeginCombo("solver", present)) {
        for (const SolverChoice& choice : kSolvers) {
            if (ImGui::Selectable(choice.name, choice.kind == solver)) {
                solver = choice.kind;
                changed = true;
            }
        }
        ImGui::EndCombo();
    }
    return changed;
}

bool slide(const char* label, double& value, double least, double most, const char* format) {
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most, format,
                               ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
}

bool edit_simulation(Scene& scene) {
    SimulationSettings& simulation = scene.simulation;
    bool changed = choose_solver(simulation.solver);
    if (changed) simulation.substeps.reset();  // the number for another solver need not be stable
    int substeps = simulation.substeps.value_or(0);
    if (ImGui::InputInt("steps per frame", &substeps)) {
        simulation.substeps = substeps > 0 ? std::optional(substeps) : std::nullopt;
        changed = true;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("0: the fewest that are stable");
    if (is_implicit(simulation.solver))
        changed |= ImGui::SliderInt("iterations", &simulation.iterations, 1, 100, "%d",
                                    ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    const double upwards = glm::dot(scene.gravity(), scene.up_direction());
    auto gravity = static_cast<float>(-upwards);
    if (ImGui::SliderFloat("gravity", &gravity, -20.0f, 20.0f, "%.2f m/s2 down")) {
        simulation.gravity =
            scene.gravity() - (static_cast<double>(gravity) + upwards) * scene.up_direction();
        changed = true;
    }
    return changed;
}

bool edit_material(Material& material) {
    ImGui::PushID(material.name.c_str());
    ImGui::Separator();
    ImGui::TextUnformatted(material.name.c_str());
    bool changed = slide("stiffness", material.youngs_modulus, 1e3, 1e9, "%.3g Pa");
    changed |= slide("density", material.density, 10.0, 10000.0, "%.0f kg/m3");
    changed |= slide("damping", material.damping, 0.0, 1.0, "%.2g s");
    ImGui::PopID();
    return changed;
}

}  // namespace

void draw_settings(const PanelState& state, Requests& requests) {
    Scene scene = state.edited;
    bool changed = edit_simulation(scene);
    for (Material& material : scene.materials) changed |= edit_material(material);
    if (changed) requests.edited = std::move(scene);
}

}  // namespace gelatin::viewer
