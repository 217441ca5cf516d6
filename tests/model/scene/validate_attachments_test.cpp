#include "model/scene/rule_test.h"

namespace gelatin::test {
namespace {

// The ball and a second object, to which it is attached.
AttachmentDescription& add_attachment(Scene& scene) {
    scene.objects.push_back(scene.objects[0]);
    scene.objects[1].name = "beam";
    AttachmentDescription& attachment = scene.attachments.emplace_back();
    attachment.object = "ball";
    attachment.to = "beam";
    return attachment;
}

void add_named_colliders(Scene& scene, const std::vector<std::string>& names) {
    for (const std::string& name : names) scene.colliders.emplace_back().name = name;
}

class AttachmentRule : public RuleTest {};

// The lines of a rule are those of the attachment's table.
TEST_P(AttachmentRule, HoldsInFilesAndInCode) {
    EXPECT_EQ(code_error(GetParam()), GetParam().problem);
    EXPECT_EQ(
        file_error(std::string(kMaterials) + kObject +
                   "[[object]]\nname = 'beam'\nshape = {sphere = 0.5}\n[[attachment]]\n" + GetParam().lines),
        GetParam().problem);
}

const Rule kAttachmentRules[] = {
    {"name_of_lines", "name = \"a\\nb\"\nobject = 'ball'\nto = 'beam'",
     BREAKS(add_attachment(s).name = "a\nb"),
     "attachment[0].name = \"a\\nb\": must not have line breaks or other control characters"},
    {"object", "name = 'hook'\nobject = 'bean'\nto = 'ball'",
     BREAKS(add_attachment(s).object = "bean"; s.attachments[0].name = "hook"; s.attachments[0].to = "ball"),
     "attachment.hook.object = \"bean\": no such object (did you mean \"beam\"?); there is ball and beam"},
    {"no_object", "object = ''\nto = 'ball'", BREAKS(add_attachment(s).object = ""),
     "attachment[0].object = \"\": no such object; there is ball and beam"},
    {"to_nothing", "object = 'ball'\nto = 'ceiling'", BREAKS(add_attachment(s).to = "ceiling"),
     "attachment[0].to = \"ceiling\": must be another object's name or a collider's; there is beam"},
    {"to_itself", "object = 'ball'\nto = 'ball'", BREAKS(add_attachment(s).to = "ball"),
     "attachment[0].to = \"ball\": must be another object's name or a collider's; there is beam"},
    {"to_one_of_two",
     "object = 'ball'\nto = 'wall'\n[[collider]]\nname = 'wall'\nshape = {plane = [0, 1, 0]}\n"
     "[[collider]]\nname = 'wall'\nshape = {plane = [1, 0, 0]}",
     BREAKS(add_attachment(s).to = "wall"; add_named_colliders(s, {"wall", "wall"})),
     "attachment[0].to = \"wall\": must be the name of one collider, and 2 have it"},
    {"nowhere", "object = 'ball'", BREAKS(add_attachment(s).to = ""),
     "attachment[0]: needs \"to\", or one of region, point, line, rail, universal and distance"},
    {"region", "object = 'ball'\nregion = {box = [[0, 0, 0], [1, -1, 1]]}",
     BREAKS(add_attachment(s).where = Region(BoxRegion{glm::dvec3(0), glm::dvec3(1, -1, 1)})),
     "attachment[0].region.box = [[0, 0, 0], [1, -1, 1]]: the first corner must be the lower one: 0 is above "
     "-1 along y"},
    {"point", "object = 'ball'\npoint = [0, 0, inf]",
     BREAKS(add_attachment(s).where = AttachedPoint{glm::dvec3(0, 0, kInfinite)}),
     "attachment[0].point[2] = inf: must be finite"},
    {"line_from", "object = 'ball'\nline = [[0, nan, 0], [0, 0, 1]]",
     BREAKS(add_attachment(s).where = (AttachedLine{glm::dvec3(0, kNan, 0), glm::dvec3(0, 0, 1)})),
     "attachment[0].line = [[0, nan, 0], [0, 0, 1]]: points must be three finite numbers each"},
    {"line_to", "object = 'ball'\nline = [[0, 0, 0], [0, 0, inf]]",
     BREAKS(add_attachment(s).where = (AttachedLine{glm::dvec3(0), glm::dvec3(0, 0, kInfinite)})),
     "attachment[0].line = [[0, 0, 0], [0, 0, inf]]: points must be three finite numbers each"},
    {"line_of_a_point", "object = 'ball'\nline = [[1, 2, 3], [1, 2, 3]]",
     BREAKS(add_attachment(s).where = (AttachedLine{glm::dvec3(1, 2, 3), glm::dvec3(1, 2, 3)})),
     "attachment[0].line = [[1, 2, 3], [1, 2, 3]]: must be two different points"},
    {"compliance", "object = 'ball'\nto = 'beam'\ncompliance = -1e-5",
     BREAKS(add_attachment(s).compliance = -1e-5), "attachment[0].compliance = -1e-05: must be 0 or more"},
    {"compliance_finite", "object = 'ball'\nto = 'beam'\ncompliance = inf",
     BREAKS(add_attachment(s).compliance = kInfinite), "attachment[0].compliance = inf: must be finite"},
    {"break_force", "object = 'ball'\nto = 'beam'\nbreak_force = 0",
     BREAKS(add_attachment(s).break_force = 0), "attachment[0].break_force = 0: must be greater than 0"},
    {"break_force_finite", "object = 'ball'\nto = 'beam'\nbreak_force = nan",
     BREAKS(add_attachment(s).break_force = kNan), "attachment[0].break_force = nan: must be finite"},
    {"solver", "object = 'ball'\nto = 'beam'\n[simulation]\nsolver = 'midpoint'",
     BREAKS(add_attachment(s); s.simulation.solver = SolverKind::midpoint),
     "attachment[0]: needs simulation.solver = \"implicit\""},
};

INSTANTIATE_TEST_SUITE_P(Attachments, AttachmentRule, testing::ValuesIn(kAttachmentRules), rule_name);

// Ball and beam are rigid here, and there is a deformable block. The ball's joint is with the beam.
AttachmentDescription& add_joint(Scene& scene, decltype(AttachmentDescription::where) where) {
    scene.objects.push_back(scene.objects[0]);
    AttachmentDescription& joint = add_attachment(scene);
    scene.objects[1].name = "block";
    scene.objects.back().name = "beam";
    scene.objects[0].rigid.emplace();
    scene.objects[2].rigid.emplace();
    joint.where = where;
    return joint;
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

class ValidateAttachments : public RuleTest {
protected:
    static std::string error_of(const std::function<void(Scene&)>& breaks) {
        return code_error({"", "", breaks, ""});
    }
};

TEST_F(ValidateAttachments, NamesAreFree) {
    EXPECT_EQ(error_of(BREAKS(add_attachment(s).name = "a"; s.attachments.push_back(s.attachments[0]))),
              "attachment.a.name = \"a\": is taken by another attachment");
    EXPECT_EQ(error_of(BREAKS(add_attachment(s); s.attachments.push_back(s.attachments[0]))), "no error")
        << "two without a name";
}

// Without contact, too.
TEST_F(ValidateAttachments, TakesSoundOnes) {
    EXPECT_EQ(error_of(BREAKS(add_attachment(s); s.collision.response = CollisionResponse::restore)),
              "no error");
    EXPECT_EQ(error_of(BREAKS(add_attachment(s).to = "floor"; add_named_colliders(s, {"floor"}))),
              "no error");
    EXPECT_EQ(
        error_of(BREAKS(add_attachment(s).to = ""; s.attachments[0].where = AttachedPoint{glm::dvec3(0)})),
        "no error");
}

TEST_F(ValidateAttachments, TakesSoundJoints) {
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kRail).limits = {-1, 1})), "no error");
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kRail).to = "")), "no error") << "in space";
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kLine).to = "floor"; add_named_colliders(s, {"floor"});
                              s.attachments[0].limits = {-180, 180}; s.attachments[0].spring = {0, 1, 270};
                              s.attachments[0].motor = {-1, {}, 0, {{0, 1}, {1, {}, -5}, {2, 3, 4, 5}}})),
              "no error");
    EXPECT_EQ(error_of(BREAKS(add_joint(
                  s, AttachedUniversal{glm::dvec3(0), glm::dvec3(0, 0, 9), glm::dvec3(0, 9, 0.1)}))),
              "no error");
    EXPECT_EQ(error_of(BREAKS(add_joint(s, AttachedLine{kLine}).to = "block")), "no error")
        << "a hinge of a deformable body";
}

// A rope of any bodies, also of a length that is rounded.
TEST_F(ValidateAttachments, TakesSoundDistances) {
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kDistance).limits = {0, 2 - 1e-6}; s.attachments[0].to = "block";
                              s.attachments[0].motor = {1})),
              "no error");
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kDistance).to = ""; s.attachments[0].object = "block")),
              "no error")
        << "to a point in space";
}

// Of an attachment with a name.
TEST_F(ValidateAttachments, NamesTheJoint) {
    EXPECT_EQ(error_of(BREAKS(add_joint(s, AttachedPoint{glm::dvec3(0)}).motor = {1};
                              s.attachments[0].name = "elbow")),
              "attachment.elbow.motor: needs a line, a rail or a distance");
    EXPECT_EQ(error_of(BREAKS(add_joint(s, kRail); s.attachments[0].object = "block")),
              "attachment[0].rail = [[0, 0, 0], [0, 0, 1]]: both sides must be rigid, and 'block' is "
              "deformable");
}

// Then it does not matter how many colliders have it.
TEST_F(ValidateAttachments, ANameOfBothIsTheObjects) {
    EXPECT_EQ(error_of(BREAKS(add_attachment(s); add_named_colliders(s, {"beam", "beam"}))), "no error");
    EXPECT_EQ(error_of(BREAKS(add_attachment(s).to = "ball"; add_named_colliders(s, {"ball", "", "wall"}))),
              "attachment[0].to = \"ball\": must be another object's name or a collider's (did you mean "
              "\"wall\"?); there is beam and wall");
}

TEST_F(ValidateAttachments, CountsNamesWhereThereAreMany) {
    const auto add_objects = [](Scene& s) {
        add_attachment(s).object = "none";
        for (int k = 0; k < 20; ++k) {
            s.objects.push_back(s.objects[0]);
            s.objects.back().name = "object " + std::to_string(k);
        }
    };
    EXPECT_EQ(error_of(add_objects), "attachment[0].object = \"none\": no such object; there are 22");
}

}  // namespace
}  // namespace gelatin::test
