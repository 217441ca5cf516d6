#include "model/drive/check_regions.h"

#include <gtest/gtest.h>

#include <utility>

#include "gelatin/error.h"
#include "model/region.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// What is wrong with the regions of a block of 1 m from the origin on.
std::string problem_with(const ObjectDescription& object) {
    try {
        const TetMesh block = test::make_block({2, 2, 2}, {1, 1, 1});
        std::vector<std::vector<std::uint32_t>> held;
        for (const HandleDescription& handle : object.handles)
            held.push_back(find_inside(handle.region, block.positions));
        check_regions("scene.toml", object, block, held);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

HandleDescription handle_on(const Region& region, int line) {
    HandleDescription handle;
    handle.region = region;
    handle.line = line;
    return handle;
}

LoadDescription load_on(const Region& region, int line, decltype(LoadDescription::kind) kind) {
    LoadDescription load{region, kind};
    load.line = line;
    return load;
}

const Region kNowhere = SphereRegion{{9.0, 9.0, 9.0}, 0.1}, kLeft = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.1},
             kCorner = SphereRegion{{0.0, 0.0, 0.0}, 0.1}, kRight = HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.9};

ObjectDescription make_object() {
    ObjectDescription object;
    object.name = "cube";
    object.line = 2;
    object.pins_line = 3;
    return object;
}

TEST(CheckRegions, AcceptsWhatHoldsSomething) {
    ObjectDescription object = make_object();
    object.pins = {kCorner, kNowhere};
    object.handles = {handle_on(kRight, 7)};
    object.loads = {load_on(kLeft, 8, PressureLoad{1.0}), load_on(kCorner, 9, ForceLoad{})};
    EXPECT_EQ(problem_with(object), "no error");
}

TEST(CheckRegions, RefusesRegionsThatHoldNothing) {
    ObjectDescription object = make_object();
    object.pins = {kNowhere};
    EXPECT_EQ(problem_with(object),
              "scene.toml:3: object.cube.pins: hold no node of the object (regions are in world coordinates "
              "at the start)");
    object.pins.clear();
    object.handles = {handle_on(kLeft, 7), handle_on(kNowhere, 11)};
    EXPECT_EQ(
        problem_with(object),
        "scene.toml:11: object.cube.handle[1].region: holds no node of the object (regions are in world "
        "coordinates at the start)");
    object.handles.clear();
    object.loads = {load_on(kNowhere, 12, ForceLoad{})};
    EXPECT_EQ(problem_with(object),
              "scene.toml:12: object.cube.load[0].region: holds no node of the object (regions are in world "
              "coordinates at the start)");
    object.loads = {load_on(kCorner, 13, PressureLoad{1.0})};
    EXPECT_EQ(problem_with(object),
              "scene.toml:13: object.cube.load[0].region: holds no whole face of the object (regions are in "
              "world coordinates at the start)");
    object.loads = {load_on(kCorner, 14, TractionLoad{})};
    EXPECT_NE(problem_with(object).find("scene.toml:14: object.cube.load[0].region: holds no whole face"),
              std::string::npos);
    object.rigid.emplace();
    EXPECT_NE(problem_with(object).find("scene.toml:14: rigid.cube.load[0].region: holds no whole face"),
              std::string::npos);
}

TEST(CheckRegions, RefusesNodesThatAreHeldTwice) {
    ObjectDescription object = make_object();
    object.handles = {handle_on(kLeft, 7), handle_on(kCorner, 9)};
    EXPECT_EQ(problem_with(object), "no error") << "handles that rest are pins";
    object.handles[0].release = 2.0;
    const char* with_handle =
        "scene.toml:9: object.cube.handle[1].region: must not share a node with handle[0]";
    EXPECT_EQ(problem_with(object), with_handle);
    std::swap(object.handles[0].release, object.handles[1].release);
    EXPECT_EQ(problem_with(object), with_handle);
    object.handles.pop_back();
    object.pins = {kCorner};
    EXPECT_EQ(problem_with(object), "no error");
    object.handles[0].keyframes = {{0.0}, {1.0, {1.0, 0.0, 0.0}}};
    EXPECT_EQ(problem_with(object),
              "scene.toml:7: object.cube.handle[0].region: must not share a node with a pin");
}

}  // namespace
}  // namespace gelatin
