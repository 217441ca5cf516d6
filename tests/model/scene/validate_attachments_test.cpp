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
    // One without a name is called by its place.
    EXPECT_EQ(error_of(BREAKS(add_attachment(s).name = "attachment 2";
                              s.attachments.push_back(s.attachments[0]); s.attachments[1].name.clear())),
              "attachment.attachment 2.name = \"attachment 2\": is taken by another attachment");
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

TEST_F(ValidateAttachments, ANameOfBothIsTheObjects) {
    EXPECT_EQ(error_of(BREAKS(add_attachment(s); add_named_colliders(s, {"beam"}))), "no error");
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
