// shaders/sim/collision/time_of_impact.glsl misses no impact, and agrees with its CPU twin but for what
// nearly touches.
#include "cpu/collision/time_of_impact.h"

#include <gtest/gtest.h>

#include <string>

#include "gl/buffer.h"
#include "gl/program.h"
#include "support/gl_fixture.h"
#include "support/moving_pairs.h"
#include "support/shader_folder.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

using test::PairOf;
using Pairs = std::vector<test::MovingPair<float>>;

constexpr float kPoison = -7.0f, kNever = 2.0f;
constexpr std::size_t kGuard = 70;

constexpr const char* kProbe = R"(
#include "include/global_index.glsl"
#include "sim/collision/time_of_impact.glsl"
layout(local_size_x = 64) in;
layout(std430) readonly buffer Corners { vec4 corners[]; };
layout(std430) writeonly buffer Times { float times[]; };
uniform uint pair_count;
mat3 face(uint k) { return mat3(corners[k].xyz, corners[k + 1u].xyz, corners[k + 2u].xyz); }
void main() {
    uint n = global_index();
    if (n >= pair_count) return;
    times[n] = time_of_impact(MovingFace(face(12u * n), face(12u * n + 3u)),
                              MovingFace(face(12u * n + 6u), face(12u * n + 9u)));
}
)";

struct Change {
    const char* name = "none";
    const char* file = "sim/collision/time_of_impact.glsl";
    std::string from, to;
};

std::string changed_include(const std::string& file, const Change& change) {
    std::string text = read_file(test::source_path("shaders/") + file);
    if (file != change.file) return text;
    const std::size_t at = text.find(change.from);
    EXPECT_NE(at, std::string::npos) << "the shader no longer has: " << change.from;
    return at == std::string::npos ? text : text.replace(at, change.from.size(), change.to);
}

std::vector<float> times_on_gpu(const Pairs& pairs, const Change& change = {}) {
    test::ShaderFolder folder;
    folder.add("probe.comp", kProbe);
    for (const char* file :
         {"include/global_index.glsl", "layouts/predicates.glsl", "sim/collision/rounding.glsl",
          "sim/collision/nearest_points.glsl", "sim/collision/time_of_impact.glsl"})
        folder.add(file, changed_include(file, change));
    const gl::Program program = gl::Program::compute("probe.comp");

    std::vector<glm::vec4> points;
    for (const auto& pair : pairs) {
        for (const auto* corners : {&pair.a.start, &pair.a.end, &pair.b.start, &pair.b.end}) {
            for (const glm::vec3& p : *corners) points.emplace_back(p, 0.0f);
        }
    }
    const gl::Buffer<glm::vec4> corners{std::span<const glm::vec4>(points)};
    std::vector<float> times(pairs.size() + kGuard, kPoison);
    const gl::Buffer<float> results{std::span<const float>(times)};
    program.bind("Corners", corners);
    program.bind("Times", results);
    program.set("pair_count", static_cast<std::uint32_t>(pairs.size()));
    program.dispatch(pairs.size());
    gl::barrier(gl::Barrier::buffer_update);
    results.download(times);
    return times;
}

struct Differences {
    std::size_t touching = 0;    // on either
    std::size_t misses = 0;      // that double finds and comes_near confirms
    std::size_t verdicts = 0;    // that differ
    std::size_t times = 0;       // that differ by more than rounding
    std::size_t far_alarms = 0;  // impacts at a time when faces are apart
    bool guard_is_untouched = true;
};

Differences compare_with_cpu(const Pairs& pairs, const Change& change = {}) {
    const std::vector<float> times = times_on_gpu(pairs, change);
    Differences differences;
    for (std::size_t n = 0; n < pairs.size(); ++n) {
        const std::optional<float> expected = test::impact(PairOf::faces, pairs[n]);
        const bool touches = times[n] != kNever;
        differences.touching += touches || expected;
        differences.verdicts += touches != expected.has_value();
        if (touches && expected) differences.times += !(std::abs(times[n] - *expected) < 1e-3f);
    }
    for (std::size_t n = pairs.size(); n < times.size(); ++n)
        differences.guard_is_untouched = differences.guard_is_untouched && times[n] == kPoison;
    return differences;
}

class TimeOfImpactTest : public test::GlTest {};

// Rounding differs by driver, so that what nearly touches may be told otherwise.
TEST_F(TimeOfImpactTest, RandomPairs) {
    for (const auto& [what, name] : test::kPairsOf) {
        SCOPED_TRACE(name);
        const Pairs pairs = test::random_moving_pairs<float>(what, 20'001, 40);
        const Differences differences = compare_with_cpu(pairs);
        EXPECT_GT(differences.touching, pairs.size() / 100);
        EXPECT_LE(differences.verdicts, 1u);
        EXPECT_LE(differences.times, pairs.size() / 1000);
        EXPECT_TRUE(differences.guard_is_untouched);
    }
}

TEST_F(TimeOfImpactTest, NoImpactIsMissed) {
    for (const auto& [what, name] : test::kPairsOf) {
        SCOPED_TRACE(name);
        std::size_t misses = 0;
        for (const float time : times_on_gpu(test::touching_pairs<float>(what, 50'001, 41)))
            misses += time == kNever;
        EXPECT_EQ(misses, 0u);
    }
}

// Broken in these ways, the shader misses impacts or sees what is far away touch.
const Change kMutants[] = {
    {"rounding_is_forgotten", "sim/collision/time_of_impact.glsl",
     "kRoundingBound = float(kImpactRounding) * kEpsilon", "kRoundingBound = 0.0"},
    {"a_corner_is_forgotten", "sim/collision/time_of_impact.glsl", "low_end = low_end.yzx;", ""},
    {"planes_are_not_renewed", "layouts/predicates.glsl", "kMostPlanes = 32", "kMostPlanes = 1"},
    {"the_end_is_not_looked_at", "sim/collision/time_of_impact.glsl", "max(first.y, first.z)));",
     "max(first.y, first.z))); window.y = 1.0;"},
    {"the_frame_stands_still", "sim/collision/time_of_impact.glsl", "t.end));\n    vec3 reach",
     "t.start));\n    vec3 reach"},
    {"roots_are_late", "sim/collision/time_of_impact.glsl", "root * (1.0 - kRootBound)", "root * 1.1"},
    {"an_edge_of_a_face_is_forgotten", "sim/collision/nearest_points.glsl",
     "for (int k = 0; k < 3; ++k) {\n        NodeToEdge",
     "for (int k = 0; k < 2; ++k) {\n        NodeToEdge"},
    {"edges_are_forgotten", "sim/collision/nearest_points.glsl", "k < 9", "k < 6"},
    {"inside_is_ignored", "sim/collision/nearest_points.glsl", "if (inner) nearest", "if (false) nearest"},
    {"the_way_back", "sim/collision/nearest_points.glsl",
     "-to.apart, to.squared_distance);\n        s =", "to.apart, to.squared_distance);\n        s ="},
};
class TimeOfImpactMutantsTest : public test::GlTest, public ::testing::WithParamInterface<Change> {};
INSTANTIATE_TEST_SUITE_P(All, TimeOfImpactMutantsTest, ::testing::ValuesIn(kMutants),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(TimeOfImpactMutantsTest, IsCaught) {
    Pairs touching;
    for (const auto& [what, name] : test::kPairsOf) {
        for (const auto& pair : test::touching_pairs<float>(what, 20'000, 42)) touching.push_back(pair);
    }
    std::size_t misses = 0;
    for (const float time : times_on_gpu(touching, GetParam())) misses += time == kNever;
    const Differences differences =
        compare_with_cpu(test::random_moving_pairs<float>(PairOf::faces, 20'001, 40), GetParam());
    EXPECT_TRUE(misses > 0 || differences.verdicts > 1 || differences.times > 20)
        << "the broken shader passes";
}

}  // namespace
}  // namespace gelatin
