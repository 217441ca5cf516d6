#include <imgui.h>

#include "panels.h"

namespace gelatin::viewer {
namespace {

constexpr ImU32 kLight = IM_COL32(255, 255, 255, 200), kDark = IM_COL32(20, 22, 26, 200);
constexpr ImU32 kPointed = IM_COL32(242, 176, 51, 255);

ImVec2 on_screen(const glm::vec2& place) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    return {0.5f * size.x + place.x * size.y, 0.5f * size.y - place.y * size.y};
}

// A pin is a disc, a handle a diamond that appears equally large.
void draw_mark(ImDrawList& list, const ImVec2& at, float radius, bool is_pin, ImU32 color) {
    const int corners = is_pin ? 16 : 4;
    if (!is_pin) radius *= 1.3f;
    list.AddNgonFilled(at, 1.5f * radius, kDark, corners);
    list.AddNgonFilled(at, radius, color, corners);
}

void draw_name(ImDrawList& list, const ImVec2& at, float scale, const std::string& name) {
    const ImVec2 size = ImGui::CalcTextSize(name.c_str()), margin{6.0f * scale, 3.0f * scale};
    const ImVec2 corner{at.x + 14.0f * scale, at.y - 0.5f * size.y};
    list.AddRectFilled({corner.x - margin.x, corner.y - margin.y},
                       {corner.x + size.x + margin.x, corner.y + size.y + margin.y}, kDark, 4.0f * scale);
    list.AddText(corner, kPointed, name.c_str());
}

}  // namespace

void draw_markers(float scale, const std::vector<Marker>& markers, const Marker* pointed) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const Marker& marker : markers) {
        const bool is_pointed = &marker == pointed;
        const ImVec2 place = on_screen(marker.place), target = on_screen(marker.target);
        if (marker.target != marker.place) list.AddLine(place, target, kLight, scale);
        draw_mark(list, target, (is_pointed ? 6.0f : 4.0f) * scale, marker.is_pin,
                  is_pointed ? kPointed : kLight);
    }
    if (pointed != nullptr) draw_name(list, on_screen(pointed->target), scale, pointed->name);
}

void draw_first_point(float scale, const glm::vec2& place, const glm::vec2& pointer) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddLine(on_screen(place), on_screen(pointer), kPointed, 1.5f * scale);
    draw_mark(list, on_screen(place), 5.0f * scale, true, kPointed);
}

}  // namespace gelatin::viewer
