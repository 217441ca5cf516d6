#include "gelatin/loading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gelatin/error.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

using LoadingTest = test::SimulatorFixture;

// Each of other tets, by the lattice, which takes a while for all.
Scene many_balls(int count) {
    Scene scene;
    scene.materials.emplace_back().name = "jelly";
    for (int i = 0; i < count; ++i) {
        ObjectDescription& ball = scene.objects.emplace_back();
        ball.name = "ball " + std::to_string(i);
        ball.material = "jelly";
        ball.shape = SphereShape{0.3 + 0.001 * i, 6};
        ball.mesher.kind = MesherKind::lattice;
        ball.mesher.nodes = 300;
        ball.position.x = i;
    }
    return scene;
}

TEST_F(LoadingTest, GivesTheSimulatorThatTheConstructorMakes) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        std::vector<LoadProgress> seen;
        Loading loading = load_simulator(test::falling_balls(), on(backend),
                                         [&](const LoadProgress& progress) { seen.push_back(progress); });
        EXPECT_TRUE(loading.wait_for(600.0));
        EXPECT_TRUE(loading.is_ready());
        EXPECT_EQ(loading.progress().share, 1.0);
        Simulator simulator = loading.get(), expected(test::falling_balls(), on(backend));
        for (int f = 0; f < 3; ++f) {
            simulator.advance_frame();
            expected.advance_frame();
        }
        EXPECT_EQ(test::largest_difference(simulator.read_frame(), expected.read_frame()), 0.0);
        ASSERT_GE(seen.size(), 3u);
        for (std::size_t k = 1; k < seen.size(); ++k) EXPECT_GE(seen[k].share, seen[k - 1].share);
        EXPECT_EQ(seen[0].share, 0.0);
        EXPECT_THAT(seen[0].what, testing::StartsWith("object '"));
        EXPECT_EQ(seen.back().what, "ready");
    }
}

TEST_F(LoadingTest, CanBeCancelled) {
    Loading loading = load_simulator(many_balls(300), on(Backend::cpu));
    loading.cancel();
    EXPECT_THROW(loading.get(), Cancelled);
    Loading given_up =
        load_simulator(many_balls(300), on(Backend::cpu));  // the destructor does not load to the end
}

TEST_F(LoadingTest, WhatTheCallbackThrowsComesOut) {
    Loading loading = load_simulator(many_balls(3), on(Backend::cpu), [](const LoadProgress& progress) {
        if (progress.share > 0.5) throw std::runtime_error("no more");
    });
    EXPECT_THROW(loading.get(), std::runtime_error);
}

TEST_F(LoadingTest, ErrorsComeOut) {
    Scene scene = many_balls(1);
    scene.objects[0].material = "jam";
    EXPECT_THROW(load_simulator(scene), InvalidInput);
    scene = many_balls(1);
    scene.objects[0].shape = FileShape{"/nowhere/at_all.obj"};
    EXPECT_THROW(load_simulator(scene, on(Backend::cpu)).get(), InvalidInput);
}

}  // namespace
}  // namespace gelatin
