#include <fmt/core.h>
#include <imgui.h>

#include <cfloat>

#include "core/counted.h"
#include "panels.h"

namespace gelatin::viewer {
namespace {

void draw_graph(const char* name, const History& history, const char* unit, float scale) {
    const std::string latest = fmt::format("{} {:.4g} {}", name, history.latest(), unit);
    ImGui::PlotLines(fmt::format("##{}", name).c_str(), history.data(), history.size(), history.start(),
                     latest.c_str(), FLT_MAX, FLT_MAX, {ImGui::GetContentRegionAvail().x, 44.0f * scale});
}

void draw_stages(const Readings& readings, float scale) {
    double all = 0.0;
    for (const auto& [name, ms] : readings.stages) all += ms;
    for (const auto& [name, ms] : readings.stages) {
        ImGui::ProgressBar(static_cast<float>(all > 0.0 ? ms / all : 0.0), {80.0f * scale, 0.0f},
                           fmt::format("{:.3f} ms", ms).c_str());
        ImGui::SameLine();
        ImGui::TextUnformatted(name.c_str());
    }
}

}  // namespace

void draw_readings(const Session& session, const PanelState& state) {
    const Readings& readings = session.readings();
    const Counts counts = session.simulator().counts();
    const FrameStatistics& latest = readings.latest;
    ImGui::TextDisabled("%s", session.device().c_str());
    ImGui::Text("%s, %s, %s", counted(counts.objects, "object").c_str(),
                counted(counts.nodes, "node").c_str(), counted(counts.springs, "spring").c_str());
    ImGui::Text("%s, %s, %zu of them touch", counted(counts.tets, "tet").c_str(),
                counted(counts.faces, "face").c_str(), latest.colliding_faces);
    ImGui::Text("%s of %.3g ms per frame", counted(session.simulator().substeps(), "step").c_str(),
                1e3 * session.simulator().step_size());
    draw_graph("kinetic", readings.kinetic, "J", state.scale);
    draw_graph("elastic", readings.elastic, "J", state.scale);
    draw_graph("potential", readings.potential, "J", state.scale);
    draw_graph("momentum", readings.momentum, "kg m/s", state.scale);
    draw_graph("time of a step", readings.step_ms, "ms", state.scale);
    draw_stages(readings, state.scale);
}

}  // namespace gelatin::viewer
