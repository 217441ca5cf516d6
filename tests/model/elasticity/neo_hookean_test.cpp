#include "model/elasticity/neo_hookean.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "mesh/topology.h"
#include "model/spring_packing.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

Body neo_hookean_body(const TetMesh& mesh) {
    Material material;
    material.model = MaterialModel::neo_hookean;
    material.poisson_ratio = 0.4;
    return test::make_body(mesh, material);
}

// E = mu (3 lambda + 2 mu) / (lambda + mu), nu = lambda / 2 (lambda + mu) give back what was asked for.
TEST(NeoHookeanModuli, AreLamesAtSmallStrains) {
    for (const double nu : {0.0, 0.1, 0.25, 0.3, 0.4, 0.49}) {
        const NeoHookeanModuli moduli = neo_hookean_moduli(3e5, nu);
        const double shear = 0.75 * moduli.mu, own = moduli.lambda - 5.0 / 6.0 * shear;
        const double lame = own + moduli.kappa;
        EXPECT_NEAR(shear * (3 * lame + 2 * shear) / (lame + shear), 3e5, 1e-6);
        EXPECT_NEAR(0.5 * lame / (lame + shear), nu, 1e-12);
        // The tets' own Poisson's ratio.
        EXPECT_NEAR(0.5 * own / (own + shear), nu <= 0.3 ? nu : 0.25, 1e-12) << nu;
        EXPECT_EQ(moduli.kappa == 0.0, nu <= 0.3) << nu;
    }
}

// Between nu = 0.3 and 1/3 the volume term takes over, without a jump.
TEST(NeoHookeanModuli, HandOverToTheVolumeTermSmoothly) {
    double before = 0.0;
    for (double nu = 0.3; nu < 0.34; nu += 1e-3) {
        const double kappa = neo_hookean_moduli(1.0, nu).kappa;
        EXPECT_GE(kappa, before) << nu;
        EXPECT_LT(kappa - before, 0.02) << nu;
        before = kappa;
    }
    EXPECT_NEAR(neo_hookean_moduli(1.0, 1.0 / 3.0).kappa, 0.375, 1e-12);  // mu_L
}

// sum_k p(x_k) g_k is the gradient of any linear p, and the gradients add up to nothing.
TEST(NeoHookeanTet, ShapeGradientsReproduceLinearFields) {
    const TetMesh mesh = test::make_block({3, 2, 2}, {0.3, 0.2, 0.25}, 0.2);
    const Model model = test::make_model(neo_hookean_body(mesh));
    ASSERT_EQ(model.neo_hookean_tets.size(), mesh.tets.size());
    const glm::dvec3 slope(1.0, -2.0, 0.5);
    double volume = 0.0;
    for (const NeoHookeanTet& tet : model.neo_hookean_tets) {
        const auto gradients = shape_gradients(tet);
        glm::dvec3 sum(0.0);
        for (int k = 0; k < 4; ++k) {
            const glm::dvec3 position(model.positions[nodes_of(tet)[k]]);
            sum += (7.0 + glm::dot(slope, position)) * gradients[static_cast<std::size_t>(k)];
        }
        EXPECT_LT(glm::distance(sum, slope), 2e-4);  // 7 / edge in single precision
        volume += static_cast<double>(tet.gradient_1.w);
    }
    EXPECT_NEAR(volume, 0.3 * 0.2 * 0.25, 1e-8);
}

TEST(NeoHookeanBodies, HaveTetsAndNoSprings) {
    const TetMesh one = test::make_block({3, 2, 2}, {0.3, 0.2, 0.2}),
                  two = test::make_block({2, 2, 2}, {0.2, 0.2, 0.2});
    const Model model = pack_bodies({test::make_body(one), neo_hookean_body(two)}, {}, {});
    EXPECT_EQ(model.objects[0].neo_hookean_tets.count, 0u);
    EXPECT_EQ(model.objects[1].neo_hookean_tets.count, two.tets.size());
    EXPECT_EQ(model.objects[1].springs.count, 0u);
    const Range& nodes = model.objects[1].nodes;
    for (std::size_t t = 0; t < two.tets.size(); ++t) {
        const glm::uvec4 corners = nodes_of(model.neo_hookean_tets[t]);
        EXPECT_EQ(corners, model.tets[model.objects[1].tets.first + t]);
        for (int k = 0; k < 4; ++k) EXPECT_TRUE(corners[k] >= nodes.first && corners[k] < nodes.end());
        EXPECT_EQ(model.tet_rests[model.objects[1].tets.first + t].modulus, 0.0f);
    }
}

// Each corner of each tet is in its node's row, once, and nothing else is.
TEST(PackNodeTets, ListsEachCornerInItsRow) {
    const TetMesh mesh = test::make_block({5, 4, 3}, {0.5, 0.4, 0.3});
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    std::vector<std::uint32_t> rows(count);
    std::iota(rows.begin(), rows.end(), 0u);
    std::shuffle(rows.begin(), rows.end(), std::mt19937(3));
    rows.insert(rows.begin() + 10, kNoNode);
    ASSERT_NE(rows.size() % 64, 0u);
    const NodeTetSlices slices = pack_node_tets(rows, make_node_tets(count, mesh.tets));
    std::size_t found = 0;
    for (std::uint32_t s = 0; s + 1 < slices.slice_starts.size(); ++s) {
        for (std::uint32_t e = slices.slice_starts[s]; e < slices.slice_starts[s + 1]; ++e) {
            const std::uint32_t entry = slices.entries[e];
            if (entry == NodeTetSlices::kNoEntry) continue;
            ++found;
            const std::size_t row = 64 * s + (e - slices.slice_starts[s]) % 64;
            ASSERT_LT(row, rows.size());
            EXPECT_EQ(mesh.tets[entry / 4][static_cast<int>(entry % 4)], rows[row]);
        }
    }
    EXPECT_EQ(found, 4 * mesh.tets.size());
}

}  // namespace
}  // namespace gelatin
