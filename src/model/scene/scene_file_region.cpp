#include "model/scene/scene_file_region.h"

namespace gelatin {

Region read_region(TableReader reader) {
    const std::string kind = reader.require_one_of({"box", "sphere", "plane"});
    Region result;
    if (kind == "box") {
        const auto [lower, upper] = reader.read_two_points("box", "corners");
        result = BoxRegion{lower, upper};
    } else if (kind == "sphere") {
        SphereRegion region{};
        reader.require({"radius"});
        reader.read("sphere", region.center);
        reader.read("radius", region.radius);
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
