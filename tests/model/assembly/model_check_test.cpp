#include "model/assembly/model_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "model/assembly/rigid_body.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A cube of a metre, in cells of half a metre.
Body cube(const glm::dvec3& at = glm::dvec3(0.0)) {
    Body body = test::make_body(test::make_block({2, 2, 2}, {1, 1, 1}));
    for (glm::dvec3& p : body.mesh.positions) p += at;
    return body;
}

std::vector<std::string> check(const std::vector<Body>& bodies, SolverKind solver, double step_size) {
    Scene scene;
    scene.simulation.solver = solver;
    return check_model(pack_bodies(bodies, {}, {0.0, -9.81, 0.0}), scene, step_size);
}
std::vector<std::string> check(const std::vector<Body>& bodies) {
    return check(bodies, SolverKind::semi_implicit_euler, 1e-3);
}

TEST(CheckModel, HasNothingToSayAboutUsualScenes) {
    EXPECT_THAT(check({cube(), cube({5, 1000, 0})}), IsEmpty());
    EXPECT_THAT(check({cube()}, SolverKind::implicit, 1.0 / 60.0), IsEmpty());
}

TEST(CheckModel, HintsAtMillimetres) {
    Body body = cube();
    for (glm::dvec3& p : body.mesh.positions) p.y *= 120.0;
    Scene scene;
    scene.objects.resize(1);
    scene.objects[0].name = body.name;
    scene.objects[0].scale = 2.0;
    const auto lines = [&] { return check_model(pack_bodies({body}, {}, scene.gravity()), scene, 1e-3); };
    EXPECT_THAT(lines(),
                ElementsAre("object 'body': it is 120 m large, and gravity is in metres; if its shape "
                            "is in millimetres, scale = 0.002 makes it 0.12 m large"));
    scene.simulation.gravity = {9.8, 0.0, 0.0};
    EXPECT_EQ(lines().size(), 1u);
    scene.simulation.gravity = {0.0, -9810.0, 0.0};  // of millimetres
    EXPECT_THAT(lines(), IsEmpty());
    scene.simulation.gravity = {0.0, -9.81, 0.0};
    for (glm::dvec3& p : body.mesh.positions) p.y *= 0.1;
    EXPECT_THAT(lines(), IsEmpty());
}

TEST(CheckModel, TellsOfObjectsFarFromTheOriginOnce) {
    EXPECT_THAT(
        check({cube(), cube({1e5, 0, 0}), cube({2e5, 0, 0})}),
        ElementsAre(
            "object 'body': at coordinates of 1e+05 m single precision rounds its shortest spring, of "
            "0.5 m, by 0.01 of its length; at coordinates below 8.39e+04 m the error is below 0.01 "
            "(and 1 more objects)"));
}

TEST(CheckModel, TellsOfMaterialsThatDifferTooMuch) {
    Body body = cube();
    body.part_materials = {body.material};
    body.tet_materials.assign(body.mesh.tets.size(), 0);
    body.tet_materials[7] = 1;
    body.part_materials[0].youngs_modulus = 9e5 * body.material.youngs_modulus;
    EXPECT_THAT(check({body}), IsEmpty());
    body.part_materials[0].youngs_modulus = 2e6 * body.material.youngs_modulus;
    EXPECT_THAT(check({body}), ElementsAre(HasSubstr("parts have youngs_modulus from 5e+04 to 1e+11 Pa")));
}

TEST(CheckModel, TellsOfMassesThatDifferTooMuch) {
    Body light = cube({3, 0, 0});
    light.name = "feather";
    light.material.density = 5e-4;
    EXPECT_THAT(
        check({cube(), light}),
        ElementsAre(HasSubstr("object 'body' has 2e+06 times the mass of 'feather' (1e+03 and 0.0005 kg)")));
    EXPECT_THAT(check({light}), IsEmpty()) << "there is nothing that it may touch";
}

// They have no springs, materials of parts and stiffness.
TEST(CheckModel, OfRigidBodiesSizesAndMassesCount) {
    const auto rigid = [](double size, double density) {
        const SurfaceMesh surface = make_box({glm::dvec3(size), glm::ivec3(1)});
        RigidNodes nodes = make_rigid_nodes(surface, solid_moments(surface, density));
        Body body;
        body.name = "rock";
        body.mesh = std::move(nodes.mesh);
        body.rigid_masses = std::move(nodes.masses);
        body.rigid_volume = size * size * size;
        return body;
    };
    EXPECT_THAT(check({rigid(1.0, 1e3), cube()}, SolverKind::implicit, 1.0 / 60.0), IsEmpty());
    EXPECT_THAT(check({rigid(0.005, 1e3), cube()}, SolverKind::implicit, 1.0 / 60.0),
                ElementsAre(HasSubstr("times the mass of 'rock'")));
    Scene scene;
    scene.objects.resize(1);
    EXPECT_THAT(check_model(pack_bodies({rigid(30.0, 1e3)}, {}, {0.0, -9.81, 0.0}), scene, 1.0 / 60.0),
                ElementsAre(HasSubstr("object 'rock': it is 30 m large")));
}

TEST(CheckModel, TellsWhereDescentLosesInertia) {
    Body body = cube();
    body.material.youngs_modulus = 1e14;
    EXPECT_THAT(check({body}, SolverKind::implicit, 1.0 / 60.0), ElementsAre(HasSubstr("loses the inertia")));
    EXPECT_THAT(check({body}, SolverKind::implicit, 1e-4), IsEmpty());
}

}  // namespace
}  // namespace gelatin
