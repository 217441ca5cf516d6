#include "model/collision/collision_stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/crowd.h"

namespace gelatin {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Notes which stages run.
struct Stages {
    std::vector<std::string> ran = {};

    void update_boxes(int /*previous*/, int /*current*/) { ran.emplace_back("update_boxes"); }
    void find_object_pairs(int /*current*/) { ran.emplace_back("find_object_pairs"); }
    void find_face_collisions(int /*previous*/, int /*current*/) { ran.emplace_back("find_face_collisions"); }
    void find_self_collisions(int /*current*/) { ran.emplace_back("find_self_collisions"); }
    void find_proximities(int /*current*/) { ran.emplace_back("find_proximities"); }
    void respond(double /*step*/, int /*previous*/, int& current) {
        ran.emplace_back("respond");
        ++current;
    }
};

std::vector<std::string> stages_of(int objects, const CollisionSettings& settings) {
    Stages stages;
    HostStageTimer timer;
    timer.time_stages(true);
    int current = 0;
    run_collision_stages(plan_collision(test::make_crowd(objects), settings), stages, 0.1, 0, current, timer);
    std::vector<std::string> timed;
    for (const auto& [name, times] : timer.take()) timed.push_back(name);
    EXPECT_THAT(timed, ::testing::UnorderedElementsAreArray(stages.ran));
    return stages.ran;
}

constexpr auto kRestore = CollisionResponse::restore, kContact = CollisionResponse::contact;

TEST(CollisionStages, AreThoseThatTheSceneNeedsInTheirOrder) {
    EXPECT_THAT(stages_of(1, {.response = kRestore}), IsEmpty());
    EXPECT_THAT(stages_of(2, {.response = kRestore}),
                ElementsAre("update_boxes", "find_object_pairs", "find_face_collisions", "respond"));
    EXPECT_THAT(stages_of(1, {.response = kRestore, .self_collision = true}),
                ElementsAre("update_boxes", "find_self_collisions", "respond"));
    EXPECT_THAT(stages_of(2, {.response = kRestore, .self_collision = true, .proximity_radius = 0.1}),
                ElementsAre("update_boxes", "find_object_pairs", "find_face_collisions",
                            "find_self_collisions", "find_proximities", "respond"));
}

TEST(CollisionStages, SeekOnlyProximitiesBesideContactsOrWithoutAResponse) {
    for (const std::optional<CollisionResponse> response :
         {std::optional(kContact), std::optional<CollisionResponse>()}) {
        EXPECT_THAT(stages_of(2, {.response = response, .self_collision = true}), IsEmpty());
        EXPECT_THAT(stages_of(2, {.response = response, .proximity_radius = 0.1}),
                    ElementsAre("update_boxes", "find_object_pairs", "find_proximities"));
        EXPECT_THAT(stages_of(1, {.response = response, .proximity_radius = 0.1}), IsEmpty());
        EXPECT_THAT(stages_of(1, {.response = response, .self_collision = true, .proximity_radius = 0.1}),
                    ElementsAre("update_boxes", "find_proximities"));
    }
}

}  // namespace
}  // namespace gelatin
