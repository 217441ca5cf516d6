#include <imgui.h>

#include <algorithm>

#include "panels.h"
#include "shortcuts.h"

namespace gelatin::viewer {
namespace {

constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav;
constexpr ImGuiWindowFlags kMessage =
    (kPlain & ~(ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoScrollbar)) |
    ImGuiWindowFlags_HorizontalScrollbar;

// The room for panels in the middle: the window without a margin.
ImVec2 room(float scale) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float margin = 20.0f * scale;
    return {std::max(size.x - margin, 1.0f), std::max(size.y - margin, 1.0f)};
}

void put_in_the_middle(float scale) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, room(scale));
}

void row(const char* what, const char* meaning) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored({0.42f, 0.74f, 0.91f, 1.0f}, "%s", what);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(meaning);
}

}  // namespace

void draw_help(float scale, Requests& requests) {
    put_in_the_middle(scale);
    ImGui::SetNextWindowBgAlpha(1.0f);  // another panel may be behind it
    bool is_open = true;
    ImGui::Begin("Keys and mouse", &is_open, kMessage);
    if (ImGui::BeginTable("shortcuts", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const Gesture& gesture : gestures()) row(gesture.gesture, gesture.meaning);
        for (const Shortcut& shortcut : shortcuts()) row(shortcut.keys, shortcut.meaning);
        ImGui::EndTable();
    }
    ImGui::End();
    if (!is_open) requests.commands.push_back(Command::toggle_help);
}

void draw_notice(float scale, const std::string& text) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, size.y - 16.0f * scale}, ImGuiCond_Always, {0.5f, 1.0f});
    ImGui::Begin("notice", nullptr, kPlain | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos(room(scale).x);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
}

bool draw_problem(float scale, const std::string& text) {
    put_in_the_middle(scale);
    ImGui::SetNextWindowBgAlpha(1.0f);
    bool is_open = true;
    ImGui::Begin("Error", &is_open, kMessage);
    ImGui::PushTextWrapPos(std::min(560.0f * scale, room(scale).x));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    if (ImGui::Button("OK", {80.0f * scale, 0.0f})) is_open = false;
    ImGui::End();
    return is_open;
}

}  // namespace gelatin::viewer
