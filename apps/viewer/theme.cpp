#include "theme.h"

#include <imgui.h>

#include <filesystem>

#include "core/log.h"
#include "gelatin/error.h"
#include "mesh/find_font.h"

namespace gelatin::viewer {
namespace {

constexpr float kFontSize = 15.0f;

// If the usual font is not installed, Dear ImGui's own is used.
void load_font(float scale) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    try {
        const FontFile font = find_font("DejaVu Sans");
        if (fonts.AddFontFromFileTTF(font.file.c_str(), kFontSize * scale) != nullptr) return;
    } catch (const InvalidInput& problem) {
        log_debug(problem.what());
    }
    ImFontConfig config;
    config.SizePixels = kFontSize * scale;
    fonts.AddFontDefault(&config);
}

}  // namespace

void apply_theme(float scale) {
    load_font(scale);
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark();
    style.WindowRounding = 6.0f;
    style.FrameRounding = 4.0f;
    style.GrabRounding = 4.0f;
    style.WindowBorderSize = 0.0f;
    style.Colors[ImGuiCol_WindowBg] = {0.10f, 0.11f, 0.13f, 0.88f};
    style.Colors[ImGuiCol_PlotLines] = {0.42f, 0.74f, 0.91f, 1.0f};
    style.Colors[ImGuiCol_PlotHistogram] = {0.95f, 0.69f, 0.20f, 1.0f};
    style.ScaleAllSizes(scale);
}

}  // namespace gelatin::viewer
