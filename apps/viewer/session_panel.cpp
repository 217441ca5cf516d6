#include <fmt/core.h>
#include <imgui.h>

#include <string>

#include "panels.h"

namespace gelatin::viewer {
namespace {

constexpr float kWidth = 300.0f;

bool button(const char* label, float width) {
    return ImGui::Button(label, {width, 0.0f});
}

void print(const std::string& text) {
    ImGui::TextUnformatted(text.c_str());
}

// Goes to any frame of a recording, or on from there as a simulation.
void draw_timeline(const Session& session, const PanelState& state, Requests& requests) {
    const Recording& recording = *session.recording();
    int index = static_cast<int>(session.index());
    const int last = static_cast<int>(recording.frame_count()) - 1;
    if (ImGui::SliderInt("frame", &index, 0, last, std::to_string(session.frame()).c_str(),
                         ImGuiSliderFlags_AlwaysClamp))
        requests.recorded = static_cast<std::size_t>(index);
    if (ImGui::Button("Simulate from here", {-1.0f, 0.0f})) requests.edited = state.edited;
}

}  // namespace

void draw_session_panel(const Session& session, const PanelState& state, Requests& requests) {
    const float margin = 10.0f * state.scale;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({window.x - margin, margin}, ImGuiCond_Always, {1.0f, 0.0f});
    ImGui::SetNextWindowSizeConstraints({kWidth * state.scale, 0.0f},
                                        {kWidth * state.scale, window.y - 2.0f * margin});
    const std::string title = session.scene().file.filename().string() + "###session";
    ImGui::Begin(title.c_str(), nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav);
    ImGui::PushItemWidth(150.0f * state.scale);
    draw_playback(session, state, requests);
    if (ImGui::CollapsingHeader("Show")) draw_overlay_choices(session, state, requests);
    if (ImGui::CollapsingHeader("Settings")) draw_settings(state, requests);
    if (session.recording() == nullptr && ImGui::CollapsingHeader("Attachments"))
        draw_attachments(session, state, requests);
    if (!session.cavities().empty() && ImGui::CollapsingHeader("Cavities")) draw_cavities(session, requests);
    if (ImGui::CollapsingHeader("Readings")) draw_readings(session, state);
    ImGui::PopItemWidth();
    ImGui::End();
}

void draw_playback(const Session& session, const PanelState& state, Requests& requests) {
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 3.0f * spacing) / 4.0f;
    const auto command_button = [&](const char* label, Command command) {
        if (button(label, width)) requests.commands.push_back(command);
    };
    command_button(session.is_playing() ? "Pause###play" : "Play###play", Command::toggle_play);
    ImGui::SameLine();
    command_button("Step", Command::step);
    ImGui::SameLine();
    command_button("Frame", Command::step_frame);
    ImGui::SameLine();
    command_button("Reset", Command::reset);

    float speed = static_cast<float>(session.pace().speed());
    if (ImGui::SliderFloat("speed", &speed, 1.0f / 64.0f, 1.0f, "%.3f x real time",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        requests.speed = static_cast<double>(speed);
    if (session.recording() != nullptr) draw_timeline(session, state, requests);
    print(fmt::format("{:.3f} s, frame {}", session.time(), session.frame()));
    ImGui::SameLine(ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize("F1: help").x);
    ImGui::TextDisabled("F1: help");
    if (session.is_playing() && session.pace().is_behind()) {
        ImGui::TextColored({0.95f, 0.69f, 0.20f, 1.0f}, "slowed down: %.2g x real time",
                           session.pace().achieved_speed());
    } else {
        ImGui::TextDisabled("%.0f pictures/s, %s quality", state.picture_rate, state.quality);
    }
}

}  // namespace gelatin::viewer
