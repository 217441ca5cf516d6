#include "sim/contact_overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/log.h"

namespace gelatin {
namespace {

constexpr float kLeastForce = 1e-6f, kLeastPressure = 1.0f;  // [N], [Pa]
constexpr float kLongest = 0.5f;                             // the arrow of the range's end, in bodies' sizes

float mean_size(const Model& model) {
    double sum = 0.0;
    for (const ModelObject& body : model.bodies()) sum += std::cbrt(body.rest_volume);
    return static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, model.body_count())));
}

// The value that nine of ten do not exceed; 0 without values. Corners and edges of bodies have far more.
float high_of(std::vector<float> values) {
    if (values.empty()) return 0.0f;
    const std::size_t index = values.size() * 9 / 10;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values.end());
    return values[index];
}

template <class T>
void upload(std::span<const T> values, gl::Buffer<T>& buffer) {
    if (buffer.size() != values.size()) buffer = gl::Buffer<T>(values.size());
    buffer.upload(values);
}

}  // namespace

std::vector<float> surface_areas(const Model& model, std::span<const glm::vec4> positions) {
    std::vector<float> areas(positions.size(), 0.0f);
    for (const Face& face : model.faces) {
        const glm::vec3 a(positions[face.a]), b(positions[face.b]), c(positions[face.c]);
        const float third = glm::length(glm::cross(b - a, c - a)) / 6.0f;
        for (const std::uint32_t node : {face.a, face.b, face.c}) areas[node] += third;
    }
    return areas;
}

ContactOverlay::ContactOverlay(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      body_size_(mean_size(*model_)),
      force_range_(kLeastForce),
      pressure_range_(kLeastPressure) {}

void ContactOverlay::read(Solver& solver) {
    const ContactForces found = solver.contact_forces();
    if (found.normal.empty() && !std::exchange(is_reported_, true))
        log_warning("overlays of contact forces need an implicit solver on the CPU: none is shown");
    forces_.assign(model_->node_count(), glm::vec4(0.0f));
    pressures_.assign(model_->node_count(), 0.0f);
    pressed_.clear();
    if (found.normal.empty()) return;
    const std::vector<float> areas = surface_areas(*model_, solver.read_state().positions);
    for (std::uint32_t n = 0; n < model_->body_node_count(); ++n) {
        const glm::vec3 force(found.normal[n] + found.friction[n]);
        if (force == glm::vec3(0.0f)) continue;
        forces_[n] = glm::vec4(force, 0.0f);
        if (areas[n] > 0.0f) pressures_[n] = static_cast<float>(glm::length(found.normal[n])) / areas[n];
        pressed_.push_back(n);
    }
}

std::optional<ArrowView> ContactOverlay::arrows(const ForceArrows& shown) {
    std::vector<float> sizes;
    for (const std::uint32_t n : pressed_) sizes.push_back(glm::length(glm::vec3(forces_[n])));
    const float full = force_range_.follow(high_of(std::move(sizes)));
    if (pressed_.empty()) return {};
    upload<glm::vec4>(forces_, uploaded_forces_);
    upload<std::uint32_t>(pressed_, uploaded_nodes_);
    return ArrowView{.nodes = uploaded_nodes_.id(),
                     .vectors = uploaded_forces_.id(),
                     .count = static_cast<std::uint32_t>(pressed_.size()),
                     .scale = shown.scale.value_or(kLongest * body_size_ / full)};
}

// Bodies that are cut open show the mean of a tet's corners there.
ColorMapView ContactOverlay::pressures(const ColorMap& map) {
    std::vector<float> of_pressed, of_tets;
    for (const std::uint32_t n : pressed_) of_pressed.push_back(pressures_[n]);
    const float full = pressure_range_.follow(high_of(std::move(of_pressed)));
    for (const glm::uvec4& tet : model_->tets)
        of_tets.push_back(0.25f *
                          (pressures_[tet.x] + pressures_[tet.y] + pressures_[tet.z] + pressures_[tet.w]));
    upload<float>(pressures_, node_values_);
    upload<float>(of_tets, tet_values_);
    return {.quantity = Quantity::pressure,
            .node_values = node_values_.id(),
            .tet_values = tet_values_.id(),
            .low = 0.0f,
            .full = map.full.value_or(full)};
}

}  // namespace gelatin
