#include "mesh/surface_material.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "gelatin/error.h"
#include "mesh/image_file.h"

namespace gelatin {

float color_component(double value) {
    return std::isfinite(value) ? static_cast<float>(std::clamp(value, 0.0, 1.0)) : 1.0f;
}

float linear_of_srgb(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

void load_image(SurfaceMaterial& material, const std::function<std::string()>& load, Notes& notes) {
    try {
        std::string image = load();
        check_image(image);
        material.image = std::make_shared<const std::string>(std::move(image));
    } catch (const Error& error) {
        notes.push_back(fmt::format("the texture '{}' of material '{}' is left out: {}", material.image_name,
                                    material.name, error.what()));
        for (char& c : notes.back().text) {
            if (c == '\n' || c == '\r') c = ' ';  // names in glTF files may contain anything
        }
        material.image_name.clear();
    }
}

}  // namespace gelatin
