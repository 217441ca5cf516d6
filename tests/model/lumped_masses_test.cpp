#include "model/lumped_masses.h"

#include <gtest/gtest.h>

#include "model/assembly/build_model.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// Every node has mass, held or not; held ones have no inverse mass.
TEST(LumpedMasses, AddUpToTheObjectsMasses) {
    Body body = test::make_body(test::make_block({2, 3, 2}, {1, 2, 1}));
    const Body free = body;
    body.pins = {HalfSpaceRegion{{0, -1, 0}, -1.999}};
    const Model model = pack_bodies({body, free}, {}, {0, 0, 0});
    const std::vector<double> all = lumped_masses(model), moving = free_lumped_masses(model);
    ASSERT_EQ(all.size(), 2u);
    for (std::size_t o = 0; o < 2; ++o) EXPECT_NEAR(all[o] / model.objects[o].mass, 1.0, 1e-6);
    double held = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        if (model.positions[n].w == 0.0f) held += static_cast<double>(model.masses[n]);
    EXPECT_GT(held, 0.0);
    EXPECT_NEAR(all[0] - moving[0], held, 1e-9);
    EXPECT_EQ(moving[1], all[1]);
}

}  // namespace
}  // namespace gelatin
