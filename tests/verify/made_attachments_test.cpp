// Attachments that programs make while a scene runs, in checkpoints, recordings and other simulations.
#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>

#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "support/gl_fixture.h"
#include "verify/support/attached_boxes.h"
#include "verify/support/measured_run.h"

namespace gelatin::made_attachments_test {
namespace {

using namespace test;

// Two boxes, of which a program glues one to the other after a while, and hangs it on a thread: where nodes
// are then, these attachments can only be made from what a checkpoint says.
class MadeAttachments : public ::testing::Test {
protected:
    MadeAttachments() {
        scene_ = scene_of(jelly(1e4, 0.05));
        scene_.objects = {box("a", {0.2, 0.2, 0.2}, {0.0, 0.0, 0.0}),
                          box("b", {0.2, 0.2, 0.2}, {0.0, -0.206, 0.0})};
        scene_.objects[0].pins = {above(0.09)};
        scene_.objects[1].velocity = glm::dvec3(0.3, 0.0, 0.0);
    }
    void SetUp() override { std::filesystem::create_directory(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    static void attach_and_go_on(MeasuredRun& run) {
        run.simulator().attach({.name = "glue", .object = "b", .to = "a"});
        const glm::dvec3 at = run.center(1);
        run.advance(0.2);
        run.simulator().attach({.name = "thread",
                                .object = "b",
                                .where = AttachedDistance{at, at + glm::dvec3(0.1, 0.3, 0.0)},
                                .compliance = 1e-4,
                                .break_force = 1e3,
                                .spring = JointSpring{.stiffness = 20.0}});
        run.simulator().attach({.name = "cut", .object = "a", .where = AttachedPoint{run.center(0)}});
        run.simulator().detach(2);
        run.advance(0.2);
    }
    static void expect_same(MeasuredRun& run, MeasuredRun& other, double most) {
        const auto a = run.simulator().attachments(), b = other.simulator().attachments();
        ASSERT_EQ(a.size(), 3u);
        ASSERT_EQ(b.size(), 3u);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(b[k].name, a[k].name);
            EXPECT_EQ(b[k].is_broken, k == 2);
        }
        for (const std::size_t object : {0u, 1u})
            EXPECT_LE(glm::distance(other.center(object), run.center(object)), most) << object;
    }

    Scene scene_;
    std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) / "made_attachments";
};

TEST_F(MadeAttachments, GoOnFromACheckpoint) {
    MeasuredRun run(scene_), other(scene_);
    attach_and_go_on(run);
    run.simulator().save_checkpoint(folder_ / "a.gelatin");
    other.simulator().load_checkpoint(folder_ / "a.gelatin");
    for (MeasuredRun* each : {&run, &other}) each->advance(0.5);
    expect_same(run, other, 0.0);
    EXPECT_GT(run.center(1).y, -0.3) << "it hangs";
    EXPECT_EQ(other.simulator().scene().attachments[1].spring->stiffness, 20.0);
    other.simulator().reset();
    EXPECT_TRUE(other.simulator().attachments().empty());
    EXPECT_TRUE(other.simulator().scene().attachments.empty());
}

TEST_F(MadeAttachments, AreInRecordings) {
    MeasuredRun run(scene_), other(scene_);
    RecordingWriter writer(folder_ / "a.gel", run.simulator());
    writer.write(run.simulator());
    attach_and_go_on(run);
    writer.write(run.simulator());
    writer.finish();
    other.simulator().load_checkpoint(folder_ / "a.gel");
    for (MeasuredRun* each : {&run, &other}) each->advance(0.1);
    expect_same(run, other, 1e-4);

    Simulator player(std::make_shared<const Recording>(folder_ / "a.gel"));
    EXPECT_EQ(SimulatorInternals::attachments(player).size(), 0u);
    player.step();
    const std::span<const Attachment> shown = SimulatorInternals::attachments(player);
    ASSERT_EQ(shown.size(), 3u);
    EXPECT_EQ(shown[1].name, "thread");
    EXPECT_TRUE(shown[2].is_broken);
    player.save_checkpoint(folder_ / "b.gelatin");
    MeasuredRun last(scene_);
    last.simulator().load_checkpoint(folder_ / "b.gelatin");
    last.advance(0.1);
    expect_same(run, last, 1e-4);
}

// However many there are, and those from before the recording, which are not the scene's.
TEST_F(MadeAttachments, FillRecordings) {
    MeasuredRun run(scene_), other(scene_);
    for (int k = 0; k < 12; ++k) {
        run.simulator().attach({.object = "b", .where = AttachedPoint{run.center(1)}});
        run.simulator().detach(static_cast<std::size_t>(k));
        run.advance(1.0 / 60.0);
    }
    run.simulator().attach({.name = "hook", .object = "b", .where = AttachedPoint{run.center(1)}});
    RecordingWriter writer(folder_ / "many.gel", run.simulator());
    writer.write(run.simulator());
    run.advance(0.1);
    writer.write(run.simulator());
    writer.finish();
    const auto recording = std::make_shared<const Recording>(folder_ / "many.gel");
    EXPECT_TRUE(recording->scene().attachments.empty());
    Simulator player(recording);
    player.step();
    EXPECT_EQ(SimulatorInternals::attachments(player).size(), 13u);
    other.simulator().load_checkpoint(folder_ / "many.gel");
    for (MeasuredRun* each : {&run, &other}) each->advance(0.1);
    EXPECT_LT(glm::distance(other.center(1), run.center(1)), 5e-3);
    EXPECT_FALSE(other.is_broken(12));
}

// As a gripper that lets go and takes hold again.
TEST_F(MadeAttachments, TakeTheNameOfABrokenOne) {
    MeasuredRun run(scene_), other(scene_), third(scene_);
    const AttachmentDescription grip{.name = "grip", .object = "b", .to = "a"};
    run.simulator().attach(grip);
    run.advance(0.05);
    EXPECT_THROW(run.simulator().attach(grip), InvalidInput) << "it holds";
    run.simulator().detach(0);
    EXPECT_THROW(run.simulator().attach({.name = "grip", .object = "b"}), InvalidInput);
    EXPECT_EQ(run.simulator().attachments()[0].name, "grip") << "nothing has changed";
    EXPECT_EQ(run.simulator().attach(grip), 1u);
    run.advance(0.05);
    RecordingWriter writer(folder_ / "grip.gel", run.simulator());
    writer.write(run.simulator());
    writer.finish();
    run.simulator().save_checkpoint(folder_ / "grip.gelatin");
    other.simulator().load_checkpoint(folder_ / "grip.gelatin");
    third.simulator().go_on_from(run.simulator());
    Simulator player(std::make_shared<const Recording>(folder_ / "grip.gel"));
    EXPECT_EQ(SimulatorInternals::attachments(player)[1].name, "grip");
    for (MeasuredRun* each : {&run, &other, &third}) {
        const auto all = each->simulator().attachments();
        ASSERT_EQ(all.size(), 2u);
        EXPECT_EQ(all[0].name, "attachment 1");
        EXPECT_EQ(all[1].name, "grip");
        EXPECT_TRUE(all[0].is_broken);
        EXPECT_FALSE(all[1].is_broken);
        each->advance(0.2);
    }
    EXPECT_EQ(other.center(1), run.center(1));
    EXPECT_GT(run.center(1).y, -0.3) << "it hangs";
}

// Of the run before.
TEST_F(MadeAttachments, ExertNothingWhereStepsBeginAnew) {
    MeasuredRun run(hanging_row());
    RecordingWriter writer(folder_ / "row.gel", run.simulator());
    writer.write(run.simulator());
    writer.finish();
    run.advance(0.5);
    EXPECT_GT(glm::length(run.force(0)), 1.0);
    run.simulator().load_checkpoint(folder_ / "row.gel");
    EXPECT_EQ(run.force(0), glm::dvec3(0.0));
    run.advance(0.5);
    run.simulator().reset();
    EXPECT_EQ(run.force(0), glm::dvec3(0.0));
}

// As far as they can be made there.
TEST_F(MadeAttachments, GoOnInAnotherSimulation) {
    MeasuredRun run(scene_);
    attach_and_go_on(run);
    Scene changed = scene_;
    changed.objects.push_back(box("c", {0.1, 0.1, 0.1}, {2.0, 0.0, 0.0}));
    MeasuredRun other(changed);
    other.simulator().go_on_from(run.simulator());
    for (MeasuredRun* each : {&run, &other}) each->advance(0.1);
    expect_same(run, other, 1e-4);
    Scene one = scene_;
    one.objects.pop_back();
    MeasuredRun alone(one);
    alone.simulator().go_on_from(run.simulator());
    const auto left = alone.simulator().attachments();  // of the other body none
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].name, "cut");
    EXPECT_TRUE(left[0].is_broken);
}

// What is damaged, or of another scene, changes nothing.
TEST_F(MadeAttachments, OfOtherScenesAreRefused) {
    MeasuredRun run(scene_);
    attach_and_go_on(run);
    run.simulator().save_checkpoint(folder_ / "a.gelatin");
    Scene changed = scene_;
    changed.attachments = {{.name = "glue", .object = "b", .to = "a"}};
    MeasuredRun other(changed);
    const glm::dvec3 start = other.center(1);
    try {
        other.simulator().load_checkpoint(folder_ / "a.gelatin");
        FAIL() << "it has another attachment";
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("a.gelatin"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("other attachments"), std::string::npos);
    }
    EXPECT_EQ(other.center(1), start);
    EXPECT_EQ(other.simulator().attachments().size(), 1u);
}

class MadeAttachmentsOnGl : public GlTest {};
// Its scene has none, so the device made the steps.
TEST_F(MadeAttachmentsOnGl, GoOnFromACheckpoint) {
    const auto file = std::filesystem::path(::testing::TempDir()) / "attached_on_gl.gelatin";
    Scene scene = hanging_row();
    scene.attachments.clear();
    scene.objects[0].pins = {above(1.09)};
    scene.collision.response = CollisionResponse::restore;
    SimulatorOptions on_gl;
    on_gl.backend = Backend::gl;
    on_gl.use_current_context = true;
    MeasuredRun cpu(scene), gl(scene, on_gl), next(scene, on_gl);
    cpu.simulator().attach({.object = "middle", .to = "top"});
    cpu.advance(0.2);
    cpu.simulator().save_checkpoint(file);
    gl.simulator().load_checkpoint(file);
    next.simulator().go_on_from(cpu.simulator());
    for (MeasuredRun* each : {&cpu, &gl, &next}) each->advance(0.2);
    EXPECT_LT(glm::distance(gl.center(1), cpu.center(1)), 1e-5);
    EXPECT_LT(glm::distance(next.center(1), cpu.center(1)), 1e-4);
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace gelatin::made_attachments_test
