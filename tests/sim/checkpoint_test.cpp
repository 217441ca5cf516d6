#include "sim/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "gelatin/error.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class CheckpointTest : public ::testing::Test {
protected:
    std::filesystem::path file() const { return folder_.path() / "run.ckpt"; }
    std::string message_of_reading(const Model& model) const {
        try {
            read_checkpoint(file(), model);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "no error";
    }
    Model model_ = test::make_lively_model();
    Checkpoint checkpoint_{42, 0.7, {model_.positions, model_.velocities, {}}};

private:
    TemporaryFolder folder_;
};

TEST_F(CheckpointTest, GivesBackTheExactBits) {
    checkpoint_.state.positions[5].x = std::nextafter(1.0f, 2.0f);
    write_checkpoint(file(), model_, checkpoint_);
    const Checkpoint read = read_checkpoint(file(), model_);
    EXPECT_EQ(read.frame, 42);
    EXPECT_EQ(read.time, 0.7);
    EXPECT_EQ(read.state.positions, checkpoint_.state.positions);
    EXPECT_EQ(read.state.velocities, checkpoint_.state.velocities);
    EXPECT_TRUE(read.state.earlier_velocities.empty());
}

TEST_F(CheckpointTest, GivesBackEarlierVelocities) {
    checkpoint_.state.earlier_velocities = model_.velocities;
    checkpoint_.state.earlier_velocities[3].y = 7.0f;
    write_checkpoint(file(), model_, checkpoint_);
    EXPECT_EQ(read_checkpoint(file(), model_).state.earlier_velocities, checkpoint_.state.earlier_velocities);
}

TEST_F(CheckpointTest, GivesBackDrags) {
    ASSERT_EQ(model_.handles.size(), 1u);
    checkpoint_.drags = {{{0.1, 0.2, 0.3}, {0.6, 0.0, 0.8, 0.0}}};
    checkpoint_.drag_targets = {{{0.0, -1.0, 0.0}}};
    write_checkpoint(file(), model_, checkpoint_);
    const Checkpoint read = read_checkpoint(file(), model_);
    EXPECT_EQ(read.drags, checkpoint_.drags);
    EXPECT_EQ(read.drag_targets, checkpoint_.drag_targets);
    model_.handles.clear();
    EXPECT_THAT(message_of_reading(model_), ::testing::HasSubstr("other pins or handles"));
}

TEST_F(CheckpointTest, GivesBackDelays) {
    checkpoint_.delays = {0.625};
    write_checkpoint(file(), model_, checkpoint_);
    const Checkpoint read = read_checkpoint(file(), model_);
    EXPECT_EQ(read.delays, checkpoint_.delays);
    EXPECT_EQ(read.drags, std::vector<Drag>(1)) << "nothing is dragged";
    model_.handles.emplace_back();
    EXPECT_THAT(message_of_reading(model_), ::testing::HasSubstr("other pins or handles"));
}

TEST_F(CheckpointTest, RefusesThoseOfEarlierVersions) {
    write_checkpoint(file(), model_, checkpoint_);
    std::string earlier = read_file(file());
    earlier[8] = 3;
    write_file(file(), earlier);
    EXPECT_THAT(message_of_reading(model_), ::testing::HasSubstr("another version"));
}

TEST_F(CheckpointTest, RefusesAnotherScenes) {
    write_checkpoint(file(), model_, checkpoint_);
    EXPECT_THAT(message_of_reading(test::make_model(test::make_body(test::make_block({2, 2, 2}, {1, 1, 1})))),
                ::testing::HasSubstr("other objects or meshes"));
}

TEST_F(CheckpointTest, RefusesWhatIsCutOffDamagedOrSomethingElse) {
    write_checkpoint(file(), model_, checkpoint_);
    const std::string whole = read_file(file());
    for (const std::size_t size : {std::size_t{0}, std::size_t{20}, whole.size() / 2, whole.size() - 1}) {
        write_file(file(), whole.substr(0, size));
        EXPECT_THAT(message_of_reading(model_),
                    ::testing::AnyOf(::testing::HasSubstr("not a Gelatin checkpoint"),
                                     ::testing::HasSubstr("damaged")));
    }
    std::string flipped = whole;
    flipped[whole.size() - 9] = static_cast<char>(flipped[whole.size() - 9] ^ 1);
    write_file(file(), flipped);
    EXPECT_THAT(message_of_reading(model_), ::testing::HasSubstr("checksum"));
    write_file(file(), std::string(200, 'x'));
    EXPECT_THAT(message_of_reading(model_), ::testing::HasSubstr("not a Gelatin checkpoint"));
}

}  // namespace
}  // namespace gelatin
