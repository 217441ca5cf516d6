#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.h"
#include "bindings.h"
#include "gelatin/error.h"
#include "gelatin/picture.h"
#include "model/scene/value_text.h"
#include "overlay_option.h"
#include "python_simulator.h"
#include "scene_conversion.h"

namespace gelatin::python {
namespace {

using Pixels = nb::ndarray<nb::numpy, std::uint8_t, nb::shape<-1, -1, 3>>;

PictureQuality quality_of(const std::string& word) {
    if (word == "auto") return PictureQuality::automatic;
    if (word == "high") return PictureQuality::high;
    if (word == "fast") return PictureQuality::fast;
    throw InvalidInput({{}, 0, "quality", text_of(word), "must be one of \"auto\", \"high\", \"fast\""});
}

Pixels pixels_of(Picture picture) {
    const auto kept = std::make_shared<Picture>(std::move(picture));
    return Pixels(kept->pixels.data(),
                  {static_cast<std::size_t>(kept->height), static_cast<std::size_t>(kept->width), 3},
                  capsule_of(kept));
}

Pixels render(PythonSimulator& self, int width, int height, const std::string& quality, nb::handle camera,
              const std::vector<std::string>& overlays) {
    PictureOptions options;
    options.width = width;
    options.height = height;
    options.quality = quality_of(quality);
    options.overlays = parse_overlays(overlays);
    if (!camera.is_none()) options.camera = camera_of(camera);
    return pixels_of(self.paint(options));
}

}  // namespace

void bind_picture(nb::class_<PythonSimulator>& simulator) {
    simulator.def("render", &render, nb::arg("width"), nb::arg("height"), nb::arg("quality"),
                  nb::arg("camera").none(), nb::arg("overlays"));
}

}  // namespace gelatin::python
