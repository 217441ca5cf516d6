#include <imgui.h>

#include "panels.h"
#include "shortcuts.h"

namespace gelatin::viewer {
namespace {

constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav;

void put_in_the_middle() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
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
    put_in_the_middle();
    bool is_open = true;
    ImGui::Begin("Keys and mouse", &is_open, kPlain & ~ImGuiWindowFlags_NoTitleBar);
    if (ImGui::BeginTable("shortcuts", 2)) {
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 180.0f * scale);
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 240.0f * scale);
        for (const Gesture& gesture : gestures()) row(gesture.gesture, gesture.meaning);
        for (const Shortcut& shortcut : shortcuts()) row(shortcut.keys, shortcut.meaning);
        ImGui::EndTable();
    }
    ImGui::End();
    if (!is_open) requests.commands.push_back(Command::toggle_help);
}

void draw_start_screen(float scale, const std::vector<std::filesystem::path>& samples, Requests& requests) {
    put_in_the_middle();
    ImGui::Begin("start", nullptr, kPlain);
    ImGui::TextUnformatted("Gelatin");
    ImGui::TextDisabled("Drop a scene or a mesh onto this window, or begin with:");
    ImGui::Spacing();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (i % 3 != 0) ImGui::SameLine();
        const std::string name = samples[i].stem().string();
        if (ImGui::Button(name.c_str(), {150.0f * scale, 0.0f})) requests.opened = samples[i];
    }
    ImGui::End();
}

void draw_notice(float scale, const std::string& text) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, size.y - 16.0f * scale}, ImGuiCond_Always, {0.5f, 1.0f});
    ImGui::Begin("notice", nullptr, kPlain | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextUnformatted(text.c_str());
    ImGui::End();
}

bool draw_problem(float scale, const std::string& text) {
    put_in_the_middle();
    bool is_open = true;
    ImGui::Begin("Something is wrong", &is_open, kPlain & ~ImGuiWindowFlags_NoTitleBar);
    ImGui::PushTextWrapPos(560.0f * scale);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    if (ImGui::Button("OK", {80.0f * scale, 0.0f})) is_open = false;
    ImGui::End();
    return is_open;
}

}  // namespace gelatin::viewer
