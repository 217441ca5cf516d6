#include <gmock/gmock.h>

#include "model/scene/rule_test.h"

namespace gelatin::test {
namespace {

CavityDescription& add_cavity(Scene& scene, GasLaw law = GasLaw::sealed) {
    CavityDescription& cavity = scene.objects[0].cavities.emplace_back();
    cavity.law = law;
    return cavity;
}

class CavityRule : public RuleTest {};

// The lines of a rule are those of the cavity's table.
TEST_P(CavityRule, HoldsInFilesAndInCode) {
    EXPECT_EQ(code_error(GetParam()), GetParam().problem);
    EXPECT_EQ(file_error(std::string(kMaterials) + kObject + "[[object.cavity]]\n" + GetParam().lines),
              GetParam().problem);
}

const Rule kCavityRules[] = {
    {"name_of_lines", "name = \"a\\nb\"", BREAKS(add_cavity(s).name = "a\nb"),
     "object.ball.cavity[0].name = \"a\\nb\": must not have line breaks or other control characters"},
    {"region", "region = {sphere = [0, 0, 0], radius = 0}",
     BREAKS(add_cavity(s).region = SphereRegion{glm::dvec3(0), 0.0}),
     "object.ball.cavity[0].region.radius = 0: must be greater than 0"},
    {"pressure", "pressure = nan", BREAKS(add_cavity(s).pressure = kNan),
     "object.ball.cavity[0].pressure = nan: must be finite"},
    {"vacuum", "pressure = -2e5\nambient = 1e5",
     BREAKS(add_cavity(s).pressure = -2e5; s.objects[0].cavities[0].ambient = 1e5),
     "object.ball.cavity[0].pressure = -200000: must be greater than -100000, minus the ambient pressure"},
    {"amount", "amount = 0", BREAKS(add_cavity(s).amount = 0.0),
     "object.ball.cavity[0].amount = 0: must be greater than 0"},
    {"amount_of_constant", "law = 'constant'\namount = 2",
     BREAKS(add_cavity(s, GasLaw::constant).amount = 2.0),
     "object.ball.cavity[0].amount = 2: is only for law = \"sealed\""},
    {"ambient", "ambient = 0", BREAKS(add_cavity(s).ambient = 0.0),
     "object.ball.cavity[0].ambient = 0: must be greater than 0"},
    {"keyframe_time", "keyframes = [{time = -1, amount = 1}]",
     BREAKS(add_cavity(s).keyframes.push_back({.time = -1.0, .amount = 1.0})),
     "object.ball.cavity[0].keyframes[0].time = -1: must be 0 or more"},
    {"keyframe_order", "keyframes = [{time = 1, amount = 1}, {time = 1, amount = 2}]",
     BREAKS(add_cavity(s).keyframes = {{.time = 1.0, .amount = 1.0}, {.time = 1.0, .amount = 2.0}}),
     "object.ball.cavity[0].keyframes[1].time = 1: must be greater than that of the keyframe before, 1"},
    {"keyframe_without_amount", "keyframes = [{time = 1}]",
     BREAKS(add_cavity(s).keyframes.push_back({.time = 1.0})),
     "object.ball.cavity[0].keyframes[0]: needs an amount"},
    {"keyframe_amount", "keyframes = [{time = 1, amount = -1}]",
     BREAKS(add_cavity(s).keyframes.push_back({.time = 1.0, .amount = -1.0})),
     "object.ball.cavity[0].keyframes[0].amount = -1: must be greater than 0"},
    {"keyframe_pressure_of_sealed", "keyframes = [{time = 1, pressure = 1, amount = 1}]",
     BREAKS(add_cavity(s).keyframes.push_back({.time = 1.0, .pressure = 1.0, .amount = 1.0})),
     "object.ball.cavity[0].keyframes[0].pressure = 1: is only for law = \"constant\""},
    {"keyframe_without_pressure", "law = 'constant'\nkeyframes = [{time = 1}]",
     BREAKS(add_cavity(s, GasLaw::constant).keyframes.push_back({.time = 1.0})),
     "object.ball.cavity[0].keyframes[0]: needs a pressure"},
    {"keyframe_amount_of_constant", "law = 'constant'\nkeyframes = [{time = 1, pressure = 1, amount = 1}]",
     BREAKS(
         add_cavity(s, GasLaw::constant).keyframes.push_back({.time = 1.0, .pressure = 1.0, .amount = 1.0})),
     "object.ball.cavity[0].keyframes[0].amount = 1: is only for law = \"sealed\""},
    {"keyframe_vacuum", "law = 'constant'\nkeyframes = [{time = 1, pressure = -2e5}]",
     BREAKS(add_cavity(s, GasLaw::constant).keyframes.push_back({.time = 1.0, .pressure = -2e5})),
     "object.ball.cavity[0].keyframes[0].pressure = -200000: must be greater than -101325, minus the ambient "
     "pressure"},
    {"solver", "pressure = 1\n[simulation]\nsolver = 'midpoint'",
     BREAKS(add_cavity(s); s.simulation.solver = SolverKind::midpoint),
     "object.ball.cavity[0]: needs simulation.solver = \"implicit\""},
};

INSTANTIATE_TEST_SUITE_P(Cavities, CavityRule, testing::ValuesIn(kCavityRules), rule_name);

class CavityFile : public SceneFile {};

TEST_F(CavityFile, HasAllOfACavity) {
    const Scene scene =
        load(std::string(kMaterials) + kObject +
                 "[[object]]\nname = 'b'\nshape = {sphere = 1}\n[[object.cavity]]\nname = 'air'\n"
                 "region = {sphere = [1, 2, 3], radius = 4}\nlaw = 'constant'\npressure = 5\n"
                 "ambient = 6e4\nkeyframes = [{time = 1, pressure = 7}]\n[[object.cavity]]\n"
                 "amount = 1.5\n",
             {});
    const CavityDescription& air = scene.objects[1].cavities[0];
    EXPECT_EQ(air.name, "air");
    EXPECT_EQ(std::get<SphereRegion>(*air.region).center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(air.law, GasLaw::constant);
    EXPECT_EQ(air.pressure, 5.0);
    EXPECT_EQ(air.ambient, 6e4);
    ASSERT_EQ(air.keyframes.size(), 1u);
    EXPECT_EQ(air.keyframes[0].time, 1.0);
    EXPECT_EQ(air.keyframes[0].pressure, 7.0);
    EXPECT_EQ(scene.objects[1].cavities[1].law, GasLaw::sealed);
    EXPECT_EQ(scene.objects[1].cavities[1].amount, 1.5);
}

TEST_F(CavityFile, IsOverridden) {
    const std::string text = std::string(kMaterials) + kObject + "[[object.cavity]]\nname = 'air'\n";
    EXPECT_EQ(load(text, {"object.ball.cavity.air.pressure=3e4"}).objects[0].cavities[0].pressure, 3e4);
}

TEST_F(CavityFile, NamesAreFree) {
    EXPECT_EQ(error(std::string(kMaterials) + kObject +
                    "[[object.cavity]]\nname = 'air'\n[[object.cavity]]\nname = 'air'\n"),
              "scene.toml:9: object.ball.cavity[1].name = \"air\": is taken by the cavity on line 6");
}

TEST_F(CavityFile, LawsAreTwo) {
    EXPECT_THAT(error(std::string(kMaterials) + kObject + "[[object.cavity]]\nlaw = 'adiabatic'\n"),
                testing::HasSubstr("law = \"adiabatic\": must be sealed or constant"));
}

TEST_F(CavityFile, RigidBodiesHaveNone) {
    EXPECT_THAT(error(std::string(kMaterials) +
                      "[[rigid]]\nname = 'ball'\nshape = {sphere = 0.5}\n[[rigid.cavity]]\npressure = 1\n"),
                testing::HasSubstr("a rigid body has none: it does not deform, and has no tets"));
    Scene scene = scene_of_file();
    scene.objects[0].rigid.emplace();
    add_cavity(scene);
    try {
        validate(scene);
        FAIL();
    } catch (const InvalidInput& problem) {
        EXPECT_THAT(problem.what(), testing::HasSubstr("rigid.ball.cavity: a rigid body has none"));
    }
}

}  // namespace
}  // namespace gelatin::test
