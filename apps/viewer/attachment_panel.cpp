// The list of attachments: their forces, where joints are, and what motors do.
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "panels.h"

namespace gelatin::viewer {
namespace {

constexpr float kListHeight = 260.0f;  // at most: a chain has fifty
constexpr double kMostForce = 1e6;     // of a motor [N m] or [N]

bool turns(const AttachmentDescription& attachment) {
    return std::holds_alternative<AttachedLine>(attachment.where);
}

std::string text_of(const JointStatus& joint, bool is_angle) {
    if (is_angle)
        return fmt::format("{:.1f} deg, {:.3g} deg/s", glm::degrees(joint.position),
                           glm::degrees(joint.speed));
    const bool is_short = std::abs(joint.position) < 1.0;
    return fmt::format("{:.4g} {}, {:.3g} m/s", is_short ? 1e3 * joint.position : joint.position,
                       is_short ? "mm" : "m", joint.speed);
}

bool slide_motor(const char* label, double& value, double least, double most, const char* format,
                 ImGuiSliderFlags flags = 0) {
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most, format,
                               ImGuiSliderFlags_AlwaysClamp | flags);
}

// With a position the speed is the greatest, and stays what it is.
bool edit_motor(const AttachmentDescription& attachment, JointMotor& motor) {
    const bool is_angle = turns(attachment);
    bool changed = false;
    if (motor.position) {
        const double usual = is_angle ? 180.0 : std::max(1.0, 2.0 * std::abs(*motor.position));
        const glm::dvec2 range = attachment.limits.value_or(glm::dvec2(-usual, usual));
        changed |=
            slide_motor("position", *motor.position, range.x, range.y, is_angle ? "%.1f deg" : "%.4f m");
    } else if (motor.speed) {
        const double most = std::max(is_angle ? 720.0 : 2.0, 2.0 * std::abs(*motor.speed));
        changed |=
            slide_motor("speed##motor", *motor.speed, -most, most, is_angle ? "%.1f deg/s" : "%.3f m/s");
    }
    if (motor.force)
        changed |= slide_motor("greatest", *motor.force, 0.0, std::max(kMostForce, *motor.force),
                               is_angle ? "%.4g N m" : "%.4g N", ImGuiSliderFlags_Logarithmic);
    return changed;
}

void draw_attachment(const Session& session, std::size_t index, Requests& requests) {
    const AttachmentStatus& status = session.attachments()[index];
    const AttachmentDescription& attachment = session.scene().attachments[index];
    ImGui::TextUnformatted(status.name.c_str());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s to %s", attachment.object.c_str(),
                          attachment.to.empty() ? "space" : attachment.to.c_str());
    if (status.is_broken) {
        ImGui::SameLine();
        ImGui::TextDisabled("broken");
        return;
    }
    const double force = glm::length(glm::dvec3(status.force[0], status.force[1], status.force[2]));
    const float button_width = ImGui::CalcTextSize("detach").x + 2.0f * ImGui::GetStyle().FramePadding.x;
    const std::string text = fmt::format("{:.4g} N", force);
    const float right = ImGui::GetWindowContentRegionMax().x - button_width;
    ImGui::SameLine(right - ImGui::CalcTextSize(text.c_str()).x - ImGui::GetStyle().ItemSpacing.x);
    ImGui::TextUnformatted(text.c_str());
    ImGui::SameLine(right);
    if (ImGui::SmallButton("detach")) requests.detached.push_back(index);
    if (status.joint) ImGui::TextDisabled("  %s", text_of(*status.joint, turns(attachment)).c_str());
    std::optional<JointMotor> motor = session.motor(index);
    if (motor && edit_motor(attachment, *motor)) requests.motors.emplace_back(index, *motor);
}

float height_of(const Session& session, std::size_t index) {
    const AttachmentStatus& status = session.attachments()[index];
    const float line = ImGui::GetTextLineHeightWithSpacing();
    if (status.is_broken) return line;
    const std::optional<JointMotor> motor = session.motor(index);
    const int sliders = !motor ? 0 : motor->force ? 2 : 1;
    return (status.joint ? 2.0f : 1.0f) * line +
           static_cast<float>(sliders) * ImGui::GetFrameHeightWithSpacing();
}

}  // namespace

void draw_attachments(const Session& session, const PanelState& state, Requests& requests) {
    if (ImGui::Button("Attach by two clicks", {-1.0f, 0.0f})) requests.commands.push_back(Command::attach);
    const std::size_t count = session.attachments().size();
    if (count == 0) return ImGui::TextDisabled("there are none");
    float height = 0.0f;
    for (std::size_t a = 0; a < count; ++a) height += height_of(session, a);
    ImGui::BeginChild("attachments", {0.0f, std::min(kListHeight * state.scale, height)});
    for (std::size_t a = 0; a < count; ++a) {
        ImGui::PushID(static_cast<int>(a));
        draw_attachment(session, a, requests);
        ImGui::PopID();
    }
    ImGui::EndChild();
}

}  // namespace gelatin::viewer
