// A bar of two materials, pulled at its ends between smooth plates, its sides free. One behind the other they
// share the force: 1 / E is the mean of 1 / E; side by side they share the strain: E is the mean (both have
// Poisson's ratio 1/4, so that neither hinders the other's waist).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <optional>

#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "support/test_models.h"
#include "verify/support/statics.h"

namespace gelatin::two_materials_test {
namespace {

constexpr double kSoft = 2e5;  // Young's modulus [Pa]

// Along y, and its middle at the origin.
const glm::dvec3 kSize(0.25, 1.0, 0.25);

TetMesh irregular_bar(int edges_across) {
    BoxShape box;
    box.size = kSize;
    const double edge = kSize.x / edges_across;
    box.segments = glm::ivec3(glm::round(kSize / edge));
    MesherSettings mesher;
    mesher.quality = 1.5;
    mesher.max_volume = 0.2 * std::pow(edge, 3);
    return tetrahedralise(make_box(box), mesher, "bar");
}

// The border between the materials is one between tets.
TetMesh regular_bar(int edges_across) {
    TetMesh mesh = test::make_block({edges_across, 4 * edges_across, edges_across}, kSize);
    for (glm::dvec3& p : mesh.positions) p -= 0.5 * kSize;
    return mesh;
}

glm::dvec3 centroid(const TetMesh& mesh, const glm::uvec4& t) {
    return 0.25 * (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z] + mesh.positions[t.w]);
}

// Stiff where the coordinate along `axis` is positive.
Model two_materials(const TetMesh& mesh, int axis, double ratio, const std::optional<SpringKinds>& springs) {
    Body body = test::make_body(mesh);
    body.material.youngs_modulus = kSoft;
    body.material.springs = springs;
    body.part_materials = {body.material};
    body.part_materials[0].youngs_modulus = ratio * kSoft;
    for (const glm::uvec4& tet : mesh.tets)
        body.tet_materials.push_back(centroid(mesh, tet)[axis] > 0.0 ? 1u : 0u);
    return test::make_model(body);
}

// Force over area and strain [Pa].
double pulled_modulus(const Model& model) {
    constexpr double kStrain = 1e-3;
    test::Statics statics(model);
    std::vector<std::uint32_t> far_end;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const double y = static_cast<double>(model.positions[n].y);
        if (std::abs(y + 0.5 * kSize.y) < 1e-5) statics.hold(n, 1, 0.0);
        if (std::abs(y - 0.5 * kSize.y) > 1e-5) continue;
        statics.hold(n, 1, kStrain * kSize.y);
        far_end.push_back(n);
    }
    statics.solve();
    double force = 0.0;
    for (const std::uint32_t n : far_end) force -= statics.elastic_force(n)[1];
    return force / (kSize.x * kSize.z) / kStrain;
}

double in_series(double ratio) {
    return kSoft * 2.0 / (1.0 + 1.0 / ratio);
}
double in_parallel(double ratio) {
    return kSoft * 0.5 * (1.0 + ratio);
}

struct Case {
    const char* name;
    TetMesh (*make_bar)(int edges_across);
    int edges_across;
    std::optional<SpringKinds> springs;
    double bound;  // relative to theory, and to the response of a bar of one material
};

class TwoMaterialsHeavy : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    All, TwoMaterialsHeavy,
    ::testing::Values(Case{"fitted", irregular_bar, 6, std::nullopt, 0.035},
                      Case{"fitted_coarse", irregular_bar, 4, std::nullopt, 0.035},
                      Case{"fitted_border_between_tets", regular_bar, 6, std::nullopt, 0.035},
                      Case{"structural", irregular_bar, 4, SpringKinds{true, false, false}, 0.05},
                      Case{"structural_and_shear", irregular_bar, 4, SpringKinds{true, true, false}, 0.04},
                      Case{"all_kinds", irregular_bar, 4, SpringKinds{true, true, true}, 0.065}),
    [](const auto& test) { return test.param.name; });

TEST_P(TwoMaterialsHeavy, AnswerTogetherAsTheorySays) {
    const TetMesh mesh = GetParam().make_bar(GetParam().edges_across);
    const auto& springs = GetParam().springs;
    const double alone = pulled_modulus(two_materials(mesh, 0, 1.0, springs)) / kSoft;
    if (!springs) {
        EXPECT_NEAR(alone, 1.0, 0.02);
    }
    for (const double ratio : {10.0, 100.0}) {
        const double series = pulled_modulus(two_materials(mesh, 1, ratio, springs)) / in_series(ratio);
        const double parallel = pulled_modulus(two_materials(mesh, 0, ratio, springs)) / in_parallel(ratio);
        EXPECT_NEAR(series / alone, 1.0, GetParam().bound) << "one behind the other, ratio " << ratio;
        EXPECT_NEAR(parallel / alone, 1.0, GetParam().bound) << "side by side, ratio " << ratio;
    }
}

}  // namespace
}  // namespace gelatin::two_materials_test
