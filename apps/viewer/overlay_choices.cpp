#include "overlay_choices.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace gelatin::viewer {
namespace {

template <class T>
std::optional<T> switched(const std::optional<T>& setting, T usual) {
    return setting ? std::nullopt : std::optional(usual);
}

void switch_quantity(Overlays& overlays, Quantity quantity) {
    const bool is_shown = overlays.color_map && overlays.color_map->quantity == quantity;
    show_quantity(overlays, is_shown ? std::nullopt : std::optional(quantity));
}

}  // namespace

std::optional<Overlays> toggled(Overlays overlays, Command command, const RenderView& bodies,
                                const render::Camera& camera) {
    switch (command) {
        case Command::toggle_springs:
            show_springs(overlays, !overlays.full_strain);
            return overlays;
        case Command::toggle_faces:
            overlays.faces = !overlays.faces;
            return overlays;
        case Command::toggle_boxes:
            overlays.box_levels = switched(overlays.box_levels, kUsualBoxLevels);
            return overlays;
        case Command::toggle_cut:
            overlays.cut = switched(overlays.cut, cut_towards(camera, bodies));
            return overlays;
        case Command::toggle_stretch:
            switch_quantity(overlays, Quantity::stretch);
            return overlays;
        case Command::toggle_stress:
            switch_quantity(overlays, Quantity::stress);
            return overlays;
        case Command::toggle_speed:
            switch_quantity(overlays, Quantity::speed);
            return overlays;
        case Command::toggle_pressure:
            switch_quantity(overlays, Quantity::pressure);
            return overlays;
        case Command::toggle_contact_forces:
            overlays.contact_forces = switched(overlays.contact_forces, ForceArrows{});
            return overlays;
        case Command::toggle_arrows:
            overlays.arrow_time = switched(overlays.arrow_time, kUsualArrowTime);
            return overlays;
        case Command::toggle_wireframe:
            overlays.wireframe = !overlays.wireframe;
            return overlays;
        case Command::toggle_objects:
            overlays.objects = !overlays.objects;
            return overlays;
        case Command::toggle_attachments:
            overlays.attachments = !overlays.attachments;
            return overlays;
        case Command::toggle_bones:
            overlays.bones = !overlays.bones;
            return overlays;
        default:
            return {};
    }
}

void show_springs(Overlays& overlays, bool shown) {
    overlays.full_strain = shown ? std::optional(kUsualStrain) : std::nullopt;
    if (shown) overlays.color_map.reset();
}

void show_quantity(Overlays& overlays, std::optional<Quantity> quantity) {
    overlays.color_map = quantity ? std::optional(ColorMap{.quantity = *quantity}) : std::nullopt;
    if (quantity) overlays.full_strain.reset();
}

CutPlane cut_towards(const render::Camera& camera, const RenderView& bodies) {
    const glm::vec3 to_eye = camera.eye - camera.target;
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        if (std::abs(to_eye[k]) > std::abs(to_eye[axis])) axis = k;
    }
    CutPlane cut{.normal = {0.0f, 0.0f, 0.0f}};
    cut.normal[axis] = to_eye[axis] < 0.0f ? -1.0f : 1.0f;
    const OffsetRange range = offsets_through(bodies, cut);
    cut.offset = 0.5f * (range.least + range.most);
    return cut;
}

OffsetRange offsets_through(const RenderView& bodies, const CutPlane& cut) {
    const glm::vec3 normal = glm::normalize(glm::vec3(cut.normal[0], cut.normal[1], cut.normal[2]));
    OffsetRange range{0.0f, 0.0f};
    for (int k = 0; k < 3; ++k) {
        const float low = normal[k] * bodies.box_min[k], high = normal[k] * bodies.box_max[k];
        range.least += std::min(low, high);
        range.most += std::max(low, high);
    }
    return range;
}

}  // namespace gelatin::viewer
