// The list of cavities: their volumes and pressures, and what gas they have.
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "panels.h"

namespace gelatin::viewer {
namespace {

std::string volume_text(double volume) {
    if (volume >= 1.0) return fmt::format("{:.4g} m3", volume);
    return volume >= 1e-4 ? fmt::format("{:.4g} l", 1e3 * volume) : fmt::format("{:.4g} ml", 1e6 * volume);
}

std::string pressure_text(double pressure) {
    return std::abs(pressure) < 1e3 ? fmt::format("{:.4g} Pa", pressure)
                                    : fmt::format("{:.4g} kPa", 1e-3 * pressure);
}

// Twice as far as the scene goes. What is typed may be beyond.
bool slide_gas(const char* label, double& value, double least, double most, const char* format,
               ImGuiSliderFlags flags) {
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most, format, flags);
}

bool edit_gas(const CavityDescription& cavity, CavityGas& gas) {
    double least = cavity.pressure, most = cavity.pressure, amount = cavity.amount;
    for (const CavityKeyframe& key : cavity.keyframes) {
        least = std::min(least, key.pressure.value_or(least));
        most = std::max(most, key.pressure.value_or(most));
        amount = std::max(amount, key.amount.value_or(amount));
    }
    if (gas.pressure)
        return slide_gas("pressure", *gas.pressure, std::min(0.0, 2.0 * least), std::max(1e3, 2.0 * most),
                         "%.0f Pa", ImGuiSliderFlags_None);
    return slide_gas("amount", *gas.amount, 0.1, std::max(3.0, 2.0 * amount), "%.3f",
                     ImGuiSliderFlags_Logarithmic);
}

void draw_cavity(const Session& session, std::size_t index, Requests& requests) {
    const CavityStatus& status = session.cavities()[index];
    ImGui::Text("%s, %s", session.model().objects[status.object].name.c_str(), status.name.c_str());
    const std::string text = volume_text(status.volume) + ", " + pressure_text(status.pressure);
    ImGui::TextDisabled("  %s", text.c_str());
    if (session.recording() != nullptr) return;
    CavityGas gas = session.cavity_gas(index);
    if (edit_gas(session.model().cavities[index].gas, gas)) requests.gas.emplace_back(index, gas);
}

}  // namespace

void draw_cavities(const Session& session, Requests& requests) {
    for (std::size_t c = 0; c < session.cavities().size(); ++c) {
        ImGui::PushID(static_cast<int>(c));
        draw_cavity(session, c, requests);
        ImGui::PopID();
    }
}

}  // namespace gelatin::viewer
