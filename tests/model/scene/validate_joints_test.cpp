#include <utility>

#include "model/scene/rule_test.h"

namespace gelatin::test {
namespace {

// Ball and beam are rigid here, and there is a deformable block. The ball's joint is with the beam.
AttachmentDescription& add_joint(Scene& scene, decltype(AttachmentDescription::where) where) {
    scene.objects.resize(3, scene.objects[0]);
    scene.objects[1].name = "block";
    scene.objects[2].name = "beam";
    scene.objects[0].rigid.emplace();
    scene.objects[2].rigid.emplace();
    return scene.attachments.emplace_back(
        AttachmentDescription{.object = "ball", .to = "beam", .where = std::move(where)});
}

const AttachedLine kLine{{0, 0, 0}, {0, 0, 1}};
const AttachedRail kRail{{0, 0, 0}, {0, 0, 1}};
const AttachedDistance kDistance{{0, 0, 0}, {0, 0, 2}};
const char* const kLineText = "line = [[0, 0, 0], [0, 0, 1]]\n";
const char* const kRailText = "rail = [[0, 0, 0], [0, 0, 1]]\n";
const char* const kDistanceText = "distance = [[0, 0, 0], [0, 0, 2]]\n";

// How a file and a program break a rule of joints.
struct JointRule {
    const char* name;
    const char* where;  ///< the first line of the joint's own ones
    const char* lines;
    decltype(AttachmentDescription::where) is_at;
    std::function<void(AttachmentDescription&)> breaks;
    const char* problem;  ///< behind "attachment[0]"
};
std::ostream& operator<<(std::ostream& stream, const JointRule& rule) {
    return stream << rule.name;
}

class JointRuleTest : public SceneFile, public testing::WithParamInterface<JointRule> {};

TEST_P(JointRuleTest, HoldsInFilesAndInCode) {
    const JointRule& rule = GetParam();
    const std::string problem = std::string("attachment[0]") + rule.problem;
    Scene scene = scene_of_file();
    rule.breaks(add_joint(scene, rule.is_at));
    try {
        validate(scene);
        ADD_FAILURE() << "no error";
    } catch (const InvalidInput& found) {
        EXPECT_EQ(found.what(), problem);
    }
    const std::string message = error(
        std::string(kMaterials) +
        "[[rigid]]\nname = 'ball'\nshape = {sphere = 0.5}\n[[object]]\nname = 'block'\nshape = {sphere = "
        "0.5}\n[[rigid]]\nname = 'beam'\nshape = {sphere = 0.5}\n[[attachment]]\nobject = 'ball'\n" +
        rule.where + (std::string(rule.lines).find("to =") == std::string::npos ? "to = 'beam'\n" : "") +
        rule.lines);
    EXPECT_THAT(message, testing::MatchesRegex("scene\\.toml(:[0-9]+)?: .*"));
    EXPECT_EQ(message.substr(message.find(": ") + 2), problem);
}

#define SETS(...) [](AttachmentDescription& a) { __VA_ARGS__; }

const JointRule kJointRules[] = {
    {"rail_of_a_point", "rail = [[1, 2, 3], [1, 2, 3]]\n", "", AttachedRail{{1, 2, 3}, {1, 2, 3}},
     SETS((void)a), ".rail = [[1, 2, 3], [1, 2, 3]]: must be two different points"},
    {"rail_finite", "rail = [[1, 2, nan], [1, 2, 3]]\n", "", AttachedRail{{1, 2, kNan}, {1, 2, 3}},
     SETS((void)a), ".rail = [[1, 2, nan], [1, 2, 3]]: points must be three finite numbers each"},
    {"distance_of_a_point", "distance = [[1, 2, 3], [1, 2, 3]]\n", "", AttachedDistance{{1, 2, 3}, {1, 2, 3}},
     SETS((void)a), ".distance = [[1, 2, 3], [1, 2, 3]]: must be two different points"},
    {"universal_point", "universal = {point = [0, inf, 0], own = [1, 0, 0], of_other = [0, 1, 0]}\n", "",
     AttachedUniversal{{0, kInfinite, 0}, {1, 0, 0}, {0, 1, 0}}, SETS((void)a),
     ".universal.point[1] = inf: must be finite"},
    {"universal_own", "universal = {point = [0, 0, 0], own = [0, 0, 0], of_other = [0, 1, 0]}\n", "",
     AttachedUniversal{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}, SETS((void)a),
     ".universal.own = [0, 0, 0]: must not be zero: a direction"},
    {"universal_of_other", "universal = {point = [0, 0, 0], own = [1, 0, 0], of_other = [nan, 1, 0]}\n", "",
     AttachedUniversal{{0, 0, 0}, {1, 0, 0}, {kNan, 1, 0}}, SETS((void)a),
     ".universal.of_other[0] = nan: must be finite"},
    {"universal_perpendicular", "universal = {point = [0, 0, 0], own = [1, 0, 0], of_other = [0.02, 1, 0]}\n",
     "", AttachedUniversal{{0, 0, 0}, {1, 0, 0}, {0.02, 1, 0}}, SETS((void)a),
     ".universal.own = [1, 0, 0]: must be perpendicular to of_other within 1 degree, and is at 88.85 "
     "degrees"},
    {"rail_of_deformable", kRailText, "to = 'block'", kRail, SETS(a.to = "block"),
     ".rail = [[0, 0, 0], [0, 0, 1]]: both sides must be rigid, and 'block' is deformable"},
    {"universal_of_deformable", "universal = {point = [0, 0, 0], own = [1, 0, 0], of_other = [0, 1, 0]}\n",
     "to = 'block'", AttachedUniversal{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, SETS(a.to = "block"),
     ".universal: both sides must be rigid, and 'block' is deformable"},
    {"limits_of_deformable", kLineText, "to = 'block'\nlimits = [0, 90]", kLine,
     SETS(a.to = "block"; a.limits = {0, 90}),
     ".limits = [0, 90]: at a line both sides must be rigid, and 'block' is deformable"},
    {"spring_of_deformable", kLineText, "to = 'block'\nspring = {stiffness = 1}", kLine,
     SETS(a.to = "block"; a.spring = {1}),
     ".spring: at a line both sides must be rigid, and 'block' is deformable"},
    {"motor_of_deformable", kLineText, "to = 'block'\nmotor = {speed = 1}", kLine,
     SETS(a.to = "block"; a.motor = {1}),
     ".motor: at a line both sides must be rigid, and 'block' is deformable"},
    {"limits_of_a_point", "point = [0, 0, 0]\n", "limits = [0, 90]", AttachedPoint{{0, 0, 0}},
     SETS(a.limits = {0, 90}), ".limits = [0, 90]: needs a line, a rail or a distance"},
    {"spring_of_glue", "", "spring = {stiffness = 1}", std::monostate{}, SETS(a.spring = {1}),
     ".spring: needs a line, a rail or a distance"},
    {"motor_of_a_universal", "universal = {point = [0, 0, 0], own = [1, 0, 0], of_other = [0, 1, 0]}\n",
     "motor = {speed = 1}", AttachedUniversal{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, SETS(a.motor = {1}),
     ".motor: needs a line, a rail or a distance"},
    {"limits_finite", kRailText, "limits = [0, inf]", kRail, SETS(a.limits = {0, kInfinite}),
     ".limits[1] = inf: must be finite"},
    {"limits_in_order", kRailText, "limits = [1, -1]", kRail, SETS(a.limits = {1, -1}),
     ".limits = [1, -1]: the first must not be above the second"},
    {"limits_of_angles", kLineText, "limits = [-181, 0]", kLine, SETS(a.limits = {-181, 0}),
     ".limits[0] = -181: must be from -180 to 180"},
    {"limits_have_the_start", kLineText, "limits = [10, 90]", kLine, SETS(a.limits = {10, 90}),
     ".limits = [10, 90]: must include 0, where the joint is at the start"},
    {"limits_of_a_rail_have_the_start", kRailText, "limits = [-2, -1]", kRail, SETS(a.limits = {-2, -1}),
     ".limits = [-2, -1]: must include 0, where the joint is at the start"},
    {"limits_of_a_distance", kDistanceText, "limits = [-1, 2]", kDistance, SETS(a.limits = {-1, 2}),
     ".limits[0] = -1: must be 0 or more"},
    {"limits_below_the_distance", kDistanceText, "limits = [0, 1.9]", kDistance, SETS(a.limits = {0, 1.9}),
     ".limits = [0, 1.9]: must include 2, where the joint is at the start"},
    {"limits_above_the_distance", kDistanceText, "limits = [2.1, 3]", kDistance, SETS(a.limits = {2.1, 3}),
     ".limits = [2.1, 3]: must include 2, where the joint is at the start"},
    {"stiffness", kRailText, "spring = {stiffness = -1}", kRail, SETS(a.spring = {-1}),
     ".spring.stiffness = -1: must be 0 or more"},
    {"damping", kRailText, "spring = {stiffness = 1, damping = nan}", kRail, SETS(a.spring = {1, kNan}),
     ".spring.damping = nan: must be finite"},
    {"no_spring", kRailText, "spring = {rest = 1}", kRail, SETS(a.spring = {0, 0, 1}),
     ".spring: needs a stiffness or a damping above 0"},
    {"rest", kRailText, "spring = {stiffness = 1, rest = inf}", kRail, SETS(a.spring = {1, 0, kInfinite}),
     ".spring.rest = inf: must be finite"},
    {"rest_of_a_distance", kDistanceText, "spring = {stiffness = 1, rest = -1}", kDistance,
     SETS(a.spring = {1, 0, -1}), ".spring.rest = -1: must be 0 or more"},
    {"no_motor", kLineText, "motor = {force = 1}", kLine, SETS(a.motor.emplace().force = 1),
     ".motor: needs a speed or a position"},
    {"speed", kLineText, "motor = {speed = nan}", kLine, SETS(a.motor = {kNan}),
     ".motor.speed = nan: must be finite"},
    {"position", kLineText, "motor = {position = inf}", kLine, SETS(a.motor = {{}, kInfinite}),
     ".motor.position = inf: must be finite"},
    {"rest_beyond_half_a_turn", kLineText, "spring = {stiffness = 1, rest = 270}", kLine,
     SETS(a.spring = {1, 0, 270}), ".spring.rest = 270: must be from -180 to 180"},
    {"position_of_a_distance", kDistanceText, "motor = {position = -1}", kDistance, SETS(a.motor = {{}, -1}),
     ".motor.position = -1: must be 0 or more"},
    {"speed_to_a_position", kLineText, "motor = {speed = -1, position = 2}", kLine, SETS(a.motor = {-1, 2}),
     ".motor.speed = -1: must be greater than 0 where there is a position"},
    {"force", kLineText, "motor = {speed = 1, force = -1}", kLine, SETS(a.motor = {1, {}, -1}),
     ".motor.force = -1: must be 0 or more"},
    {"keyframe_time", kLineText, "motor = {speed = 1, keyframes = [{time = -1, speed = 2}]}", kLine,
     SETS(a.motor = {1, {}, {}, {{-1, 2}}}), ".motor.keyframes[0].time = -1: must be 0 or more"},
    {"keyframe_order", kLineText,
     "motor = {speed = 1, keyframes = [{time = 1, speed = 2}, {time = 1, speed = 3}]}", kLine,
     SETS(a.motor = {1, {}, {}, {{1, 2}, {1, 3}}}),
     ".motor.keyframes[1].time = 1: must be greater than that of the keyframe before, 1"},
    {"empty_keyframe", kLineText, "motor = {speed = 1, keyframes = [{time = 1}]}", kLine,
     SETS(a.motor = {1, {}, {}, {{1}}}), ".motor.keyframes[0]: needs a speed, a position or a force"},
    {"keyframe_force", kLineText, "motor = {speed = 1, keyframes = [{time = 1, force = -2}]}", kLine,
     SETS(a.motor = {1, {}, {}, {{1, {}, {}, -2}}}), ".motor.keyframes[0].force = -2: must be 0 or more"},
    {"keyframe_of_a_distance", kDistanceText, "motor = {speed = 1, keyframes = [{time = 1, position = -2}]}",
     kDistance, SETS(a.motor = {1, {}, {}, {{1, {}, -2}}}),
     ".motor.keyframes[0].position = -2: must be 0 or more"},
    {"keyframe_brings_a_position", kLineText, "motor = {speed = 0, keyframes = [{time = 1, position = 2}]}",
     kLine, SETS(a.motor = {0, {}, {}, {{1, {}, 2}}}),
     ".motor.keyframes[0].position = 2: needs a speed greater than 0, and it is 0"},
    {"keyframe_brings_a_speed", kLineText, "motor = {position = 2, keyframes = [{time = 1, speed = -2}]}",
     kLine, SETS(a.motor = {{}, 2, {}, {{1, -2}}}),
     ".motor.keyframes[0].speed = -2: must be greater than 0 where there is a position"},
};

INSTANTIATE_TEST_SUITE_P(Joints, JointRuleTest, testing::ValuesIn(kJointRules),
                         [](const auto& rule) { return std::string(rule.param.name); });

class ValidateJoints : public RuleTest {
protected:
    static std::string error_of(const std::function<void(Scene&)>& breaks) {
        return code_error({"", "", breaks, ""});
    }
};

TEST_F(ValidateJoints, TakesSoundJoints) {
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kRail).limits = {-1, 1})), "no error");
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kRail).to = "")), "no error") << "in space";
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kLine).to = "floor"; s.colliders.emplace_back().name = "floor";
                              s.attachments[0].limits = {-180, 180}; s.attachments[0].spring = {0, 1, 170};
                              s.attachments[0].motor = {-1, {}, 0, {{0, 1}, {1, {}, -5}, {2, 3, 4, 5}}})),
              "no error");
    EXPECT_EQ(error_of(BREAKS(add_joint(
                  s, AttachedUniversal{glm::dvec3(0), glm::dvec3(0, 0, 9), glm::dvec3(0, 9, 0.1)}))),
              "no error");
    EXPECT_EQ(error_of(BREAKS(add_joint(s, AttachedLine{kLine}).to = "block")), "no error")
        << "a hinge of a deformable body";
}

// A rope of any bodies, also of a length that is rounded.
TEST_F(ValidateJoints, TakesSoundDistances) {
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kDistance).limits = {0, 2 - 1e-6}; s.attachments[0].to = "block";
                              s.attachments[0].motor = {1})),
              "no error");
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kDistance).to = ""; s.attachments[0].object = "block")),
              "no error")
        << "to a point in space";
}

// Of an attachment with a name.
TEST_F(ValidateJoints, NamesTheJoint) {
    EXPECT_EQ(error_of(BREAKS(add_joint(s, AttachedPoint{glm::dvec3(0)}).motor = {1};
                              s.attachments[0].name = "elbow")),
              "attachment.elbow.motor: needs a line, a rail or a distance");
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kRail); s.attachments[0].object = "block")),
              "attachment[0].rail = [[0, 0, 0], [0, 0, 1]]: both sides must be rigid, and 'block' is "
              "deformable");
}

}  // namespace
}  // namespace gelatin::test
