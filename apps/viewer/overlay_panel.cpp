#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "overlay_choices.h"
#include "panels.h"

namespace gelatin::viewer {
namespace {

constexpr ImGuiSliderFlags kLogarithmic = ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp;

// The quantities that colour bodies, and the limits of their range.
struct ColorChoice {
    const char* name;
    std::optional<Quantity> quantity;
    float least, most;
    const char* format;
};
constexpr std::array kColors{
    ColorChoice{"own colours", {}, 0.0f, 0.0f, ""},
    ColorChoice{"stretch", Quantity::stretch, 1.001f, 10.0f, "%.3f"},
    ColorChoice{"stress", Quantity::stress, 1.0f, 1e9f, "%.3g Pa"},
    ColorChoice{"speed", Quantity::speed, 0.001f, 100.0f, "%.3g m/s"},
    ColorChoice{"contact pressure", Quantity::pressure, 1.0f, 1e9f, "%.3g Pa"},
};

const ColorChoice& present_choice(const Overlays& overlays) {
    for (const ColorChoice& choice : kColors) {
        if (overlays.color_map && choice.quantity == overlays.color_map->quantity) return choice;
    }
    return kColors.front();
}

bool choose_colors(const RenderView& bodies, Overlays& overlays) {
    bool changed = false;
    const ColorChoice& present = present_choice(overlays);
    if (ImGui::BeginCombo("colours", present.name)) {
        for (const ColorChoice& choice : kColors) {
            if (!ImGui::Selectable(choice.name, &choice == &present)) continue;
            show_quantity(overlays, choice.quantity);
            changed = true;
        }
        ImGui::EndCombo();
    }
    if (!present.quantity || !overlays.color_map) return changed;
    std::optional<float>& full = overlays.color_map->full;
    bool follows = !full;
    if (ImGui::Checkbox("range adapts", &follows)) {
        full = follows || !bodies.overlay.color_map ? std::nullopt
                                                    : std::optional(bodies.overlay.color_map->full);
        changed = true;
    }
    if (full)
        changed |= ImGui::SliderFloat("full colour##value", &*full, present.least, present.most,
                                      present.format, kLogarithmic);
    return changed;
}

bool choose_springs(Overlays& overlays) {
    bool is_shown = overlays.full_strain.has_value();
    const bool changed = ImGui::Checkbox("springs by strain", &is_shown);
    if (changed) show_springs(overlays, is_shown);
    if (!overlays.full_strain) return changed;
    float percent = 100.0f * *overlays.full_strain;
    if (!ImGui::SliderFloat("full colour##strain", &percent, 0.1f, 50.0f, "%.1f %%", kLogarithmic))
        return changed;
    overlays.full_strain = percent / 100.0f;
    return true;
}

// A normal along an axis, or any other.
bool choose_direction(CutPlane& cut) {
    bool changed = false;
    for (int k = 0; k < 3; ++k) {
        constexpr std::array kNames{"x", "y", "z"};
        if (k > 0) ImGui::SameLine();
        const bool is_along = std::abs(cut.normal[k]) == 1.0f && cut.normal[(k + 1) % 3] == 0.0f &&
                              cut.normal[(k + 2) % 3] == 0.0f;
        if (ImGui::RadioButton(kNames[static_cast<std::size_t>(k)], is_along)) {
            cut.normal[0] = cut.normal[1] = cut.normal[2] = 0.0f;
            cut.normal[k] = 1.0f;
            changed = true;
        }
    }
    ImGui::SameLine();
    if (ImGui::Button("other side")) {
        for (float& component : cut.normal) component = -component;
        cut.offset = -cut.offset.value_or(0.0f);
        changed = true;
    }
    std::array<float, 3> free{cut.normal[0], cut.normal[1], cut.normal[2]};
    if (ImGui::SliderFloat3("normal", free.data(), -1.0f, 1.0f, "%.2f") &&
        std::hypot(free[0], free[1], free[2]) > 0.01f) {
        std::copy(free.begin(), free.end(), cut.normal);
        changed = true;
    }
    return changed;
}

bool choose_cut(const RenderView& bodies, const render::Camera& camera, Overlays& overlays) {
    bool is_shown = overlays.cut.has_value();
    bool changed = ImGui::Checkbox("cut open", &is_shown);
    if (changed) overlays.cut = is_shown ? std::optional(cut_towards(camera, bodies)) : std::nullopt;
    if (!overlays.cut) return changed;
    const bool is_changed = choose_direction(*overlays.cut);
    const OffsetRange range = offsets_through(bodies, *overlays.cut);
    float offset = overlays.cut->offset.value_or(0.0f);
    if (is_changed) {
        overlays.cut->offset = offset = std::clamp(offset, range.least, range.most);
        changed = true;
    }
    if (ImGui::SliderFloat("offset", &offset, range.least, range.most, "%.3f m")) {
        overlays.cut->offset = offset;
        changed = true;
    }
    return changed;
}

bool choose_arrows(Overlays& overlays) {
    bool is_shown = overlays.arrow_time.has_value();
    bool changed = ImGui::Checkbox("velocities", &is_shown);
    if (changed) overlays.arrow_time = is_shown ? std::optional(kUsualArrowTime) : std::nullopt;
    if (overlays.arrow_time)
        changed |= ImGui::SliderFloat("length", &*overlays.arrow_time, 0.001f, 1.0f, "%.3f s of motion",
                                      kLogarithmic);
    return changed;
}

bool choose_forces(const RenderView& bodies, Overlays& overlays) {
    bool is_shown = overlays.contact_forces.has_value();
    bool changed = ImGui::Checkbox("contact forces", &is_shown);
    if (changed) overlays.contact_forces = is_shown ? std::optional(ForceArrows{}) : std::nullopt;
    if (!overlays.contact_forces) return changed;
    std::optional<float>& scale = overlays.contact_forces->scale;
    bool follows = !scale;
    if (ImGui::Checkbox("length adapts", &follows)) {
        const float present = bodies.overlay.contact_forces ? bodies.overlay.contact_forces->scale : 0.01f;
        scale = follows ? std::nullopt : std::optional(present);
        changed = true;
    }
    if (scale) changed |= ImGui::SliderFloat("length##force", &*scale, 1e-6f, 1.0f, "%.3g m/N", kLogarithmic);
    return changed;
}

bool choose_boxes(Overlays& overlays) {
    bool is_shown = overlays.box_levels.has_value();
    bool changed = ImGui::Checkbox("boxes", &is_shown);
    if (changed) overlays.box_levels = is_shown ? std::optional(0) : std::nullopt;
    if (!overlays.box_levels) return changed;
    changed |= ImGui::SliderInt("level", &*overlays.box_levels, 0, 8, "%d", ImGuiSliderFlags_AlwaysClamp);
    changed |= ImGui::Checkbox("only that level", &overlays.lowest_boxes_alone);
    return changed;
}

bool has_skeletons(const Scene& scene) {
    const auto is_skeleton = [](const HandleDescription& handle) { return handle.skeleton.has_value(); };
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const ObjectDescription& object) {
        return std::any_of(object.handles.begin(), object.handles.end(), is_skeleton);
    });
}

}  // namespace

void draw_overlay_choices(const Session& session, const PanelState& state, Requests& requests) {
    Overlays overlays = state.overlays;
    bool changed = choose_colors(session.view(), overlays);
    changed |= ImGui::Checkbox("objects by colour and name", &overlays.objects);
    changed |= ImGui::Checkbox("edges of the surfaces", &overlays.wireframe);
    changed |= choose_cut(session.view(), state.camera, overlays);
    changed |= choose_arrows(overlays);
    changed |= choose_forces(session.view(), overlays);
    changed |= choose_springs(overlays);
    changed |= ImGui::Checkbox("faces that touch", &overlays.faces);
    changed |= choose_boxes(overlays);
    if (!session.scene().attachments.empty())
        changed |= ImGui::Checkbox("attachments", &overlays.attachments);
    if (has_skeletons(session.scene())) changed |= ImGui::Checkbox("bones", &overlays.bones);
    if (changed) requests.overlays = overlays;
    bool markers = state.shows_markers;
    if (!session.held_nodes().empty() && ImGui::Checkbox("pins and handles", &markers))
        requests.shows_markers = markers;
}

}  // namespace gelatin::viewer
