#include "model/elasticity/volume_term.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/test_models.h"

namespace gelatin {
namespace {

Model block_of(double poisson_ratio) {
    Body body = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2));
    body.material.poisson_ratio = poisson_ratio;
    return test::make_model(body);
}

// mu of springs and kappa of the volume term make the bulk modulus: 5/3 mu + kappa = E / (3 (1 - 2 nu)).
TEST(VolumeTerm, MakesUpTheBulkModulus) {
    Material material;
    material.youngs_modulus = 3e5;
    for (const double nu : {0.0, 0.2, 0.25, 0.4, 0.49}) {
        material.poisson_ratio = nu;
        EXPECT_NEAR(5.0 / 3.0 * shear_modulus(material) + lacking_modulus(material),
                    material.youngs_modulus / (3.0 * (1.0 - 2.0 * nu)), 1e-6 * material.youngs_modulus)
            << nu;
    }
}

TEST(VolumeTerm, IsEmptyWhereSpringsAreEnough) {
    EXPECT_TRUE(block_of(0.25).volume_term.is_empty());
}

TEST(VolumeTerm, SharesTheVolumeAmongTheNodes) {
    for (const double nu : {0.1, 0.4}) {
        const Model model = block_of(nu);
        ASSERT_EQ(model.volume_term.nodes.size(), model.node_count());
        const double sum =
            std::accumulate(model.volume_term.nodes.begin(), model.volume_term.nodes.end(), 0.0,
                            [](double s, const glm::vec2& n) { return s + static_cast<double>(n.x); });
        EXPECT_NEAR(sum, model.objects[0].rest_volume, 1e-6 * sum);
        const float kappa = model.tet_rests[0].kappa;
        EXPECT_EQ(kappa < 0.0f, nu < 0.25);
        for (const glm::vec2& node : model.volume_term.nodes)
            EXPECT_NEAR(node.y, kappa, 1e-5f * std::abs(kappa));
        for (const float tet : model.volume_term.tets)
            EXPECT_NEAR(tet, std::abs(kappa), 1e-5f * std::abs(kappa));
    }
}

// Two adjacent materials a and b meet at some nodes.
Model two_materials(const Material& a, const Material& b) {
    Body body = test::make_body(test::make_block({4, 3, 3}, {0.4, 0.3, 0.3}), a);
    body.part_materials = {b};
    for (const glm::uvec4& t : body.mesh.tets) {
        double middle = 0.0;
        for (int k = 0; k < 4; ++k) middle += 0.25 * body.mesh.positions[t[k]].x;
        body.tet_materials.push_back(middle > 0.2 ? 1u : 0u);
    }
    return test::make_model(body);
}

// Where they meet, the softer tets give way first: kappa is less than the mean.
TEST(VolumeTerm, TetsOfTwoMaterialsShareTheStress) {
    Material soft, stiff;
    soft.model = stiff.model = MaterialModel::neo_hookean;
    stiff.youngs_modulus = 2.0 * soft.youngs_modulus;
    EXPECT_TRUE(two_materials(soft, stiff).volume_term.is_empty());

    stiff.poisson_ratio = 0.45;
    const double stiffs = lacking_modulus(stiff);
    const Model model = two_materials(soft, stiff);
    const NodeTets tets = make_node_tets(model.node_count(), model.tets);
    int mixed = 0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        double volume = 0.0, of_stiff = 0.0;
        for (std::uint32_t e = tets.starts[n]; e < tets.starts[n + 1]; ++e) {
            const TetRest& rest = model.tet_rests[tets.entries[e] / 4];
            volume += static_cast<double>(rest.volume);
            of_stiff += rest.kappa > 0.0f ? static_cast<double>(rest.volume) : 0.0;
        }
        const auto kappa = static_cast<double>(model.volume_term.nodes[n].y);
        if (of_stiff == 0.0 || of_stiff == volume) {
            EXPECT_NEAR(kappa, of_stiff / volume * stiffs, 1e-5 * stiffs);
            continue;
        }
        ++mixed;
        EXPECT_GT(kappa, 0.0);
        EXPECT_LT(kappa, 0.8 * of_stiff / volume * stiffs);
    }
    EXPECT_GT(mixed, 10);
}

}  // namespace
}  // namespace gelatin
