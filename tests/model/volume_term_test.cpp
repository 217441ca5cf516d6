#include "model/volume_term.h"

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
        const float kappa = model.tet_rests[0].lacking;
        EXPECT_EQ(kappa < 0.0f, nu < 0.25);
        for (const glm::vec2& node : model.volume_term.nodes)
            EXPECT_NEAR(node.y, kappa, 1e-5f * std::abs(kappa));
        for (const float tet : model.volume_term.tets)
            EXPECT_NEAR(tet, std::abs(kappa), 1e-5f * std::abs(kappa));
    }
}

}  // namespace
}  // namespace gelatin
