#include "model/scene/scene_file_region.h"

#include <fmt/core.h>

#include <cmath>

namespace gelatin {
namespace {

BoxRegion read_box_region(TableReader& reader) {
    const toml::array* corners = reader.find("box")->as_array();
    const bool is_pair = corners != nullptr && corners->size() == 2 && corners->is_homogeneous<toml::array>();
    if (!is_pair) reader.fail("box", "must be two corners: [[x, y, z], [x, y, z]]");
    glm::dvec3 corner[2];
    for (std::size_t c = 0; c < 2; ++c) {
        const toml::array& numbers = *(*corners)[c].as_array();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::optional<double> x =
                numbers.size() == 3 ? numbers[axis].value<double>() : std::nullopt;
            if (!x || !(std::abs(*x) <= 1e15))
                reader.fail("box", "corners must be three finite numbers each");
            corner[c][static_cast<int>(axis)] = *x;
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (corner[0][axis] > corner[1][axis]) {
            reader.fail("box", fmt::format("the first corner must be the lower one: {} is above {} along {}",
                                           corner[0][axis], corner[1][axis], "xyz"[axis]));
        }
    }
    return {corner[0], corner[1]};
}

}  // namespace

Region read_region(TableReader reader) {
    const std::string kind = reader.require_one_of({"box", "sphere", "plane"});
    Region result;
    if (kind == "box") {
        result = read_box_region(reader);
    } else if (kind == "sphere") {
        SphereRegion region{};
        reader.require({"radius"});
        reader.read("sphere", region.center);
        reader.read("radius", region.radius, kPositive);
        result = region;
    } else {
        HalfSpaceRegion region{{0.0, 1.0, 0.0}, 0.0};
        reader.read_direction("plane", region.normal);
        reader.read("offset", region.offset);
        result = region;
    }
    reader.finish();
    return result;
}

}  // namespace gelatin
