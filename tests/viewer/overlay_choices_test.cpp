#include "viewer/overlay_choices.h"

#include <gtest/gtest.h>

namespace gelatin::viewer {
namespace {

// A box from (0, 1, 2) to (4, 3, 8), seen from where the eye is.
RenderView bodies() {
    RenderView view;
    view.box_min[1] = 1.0f;
    view.box_min[2] = 2.0f;
    view.box_max[0] = 4.0f;
    view.box_max[1] = 3.0f;
    view.box_max[2] = 8.0f;
    return view;
}

Overlays after(const std::vector<Command>& commands) {
    Overlays overlays;
    for (const Command command : commands)
        overlays = toggled(overlays, command, bodies(), render::Camera{}).value();
    return overlays;
}

TEST(OverlayChoices, EachKeyTurnsItsOverlayOnAndOff) {
    for (const Command command :
         {Command::toggle_springs, Command::toggle_faces, Command::toggle_boxes, Command::toggle_cut,
          Command::toggle_stretch, Command::toggle_stress, Command::toggle_speed, Command::toggle_arrows,
          Command::toggle_pressure, Command::toggle_contact_forces, Command::toggle_wireframe,
          Command::toggle_objects, Command::toggle_attachments, Command::toggle_bones}) {
        EXPECT_TRUE(after({command}).any());
        EXPECT_FALSE(after({command, command}).any());
    }
    EXPECT_FALSE(toggled({}, Command::reset, bodies(), {}));
}

TEST(OverlayChoices, OneThingColorsTheBodies) {
    EXPECT_EQ(after({Command::toggle_stress, Command::toggle_speed}).color_map->quantity, Quantity::speed);
    const Overlays springs = after({Command::toggle_stress, Command::toggle_springs});
    EXPECT_TRUE(springs.full_strain && !springs.color_map);
    const Overlays stretch = after({Command::toggle_springs, Command::toggle_stretch});
    EXPECT_TRUE(!stretch.full_strain && stretch.color_map);
}

TEST(OverlayChoices, ACutOpensTowardsTheEye) {
    const CutPlane front = cut_towards({{1.0f, 3.0f, 20.0f}, {2.0f, 2.0f, 5.0f}}, bodies());
    EXPECT_EQ(front.normal[2], 1.0f);
    EXPECT_EQ(front.offset, 5.0f);
    const CutPlane left = cut_towards({{-20.0f, 3.0f, 5.0f}, {2.0f, 2.0f, 5.0f}}, bodies());
    EXPECT_EQ(left.normal[0], -1.0f);
    EXPECT_EQ(left.normal[2], 0.0f);
    EXPECT_EQ(left.offset, -2.0f);
}

TEST(OverlayChoices, OffsetsReachFromOneEndOfTheBodiesToTheOther) {
    const OffsetRange range = offsets_through(bodies(), {.normal = {0.0f, -3.0f, 4.0f}});
    EXPECT_FLOAT_EQ(range.least, -0.6f * 3.0f + 0.8f * 2.0f);
    EXPECT_FLOAT_EQ(range.most, -0.6f * 1.0f + 0.8f * 8.0f);
}

}  // namespace
}  // namespace gelatin::viewer
