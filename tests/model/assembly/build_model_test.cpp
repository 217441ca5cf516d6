#include "model/assembly/build_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "gelatin/error.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

double sum(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(BuildModel, LumpsTheWholeMass) {
    Material material;
    material.density = 900.0;
    const Model model =
        test::make_model(test::make_body(test::make_block({4, 3, 5}, {2.0, 0.5, 1.0}, 0.2), material));
    EXPECT_NEAR(sum(model.masses), 900.0, 900.0 * 1e-6);
    EXPECT_NEAR(model.objects[0].mass, 900.0, 1e-9);
    EXPECT_NEAR(model.objects[0].rest_volume, 1.0, 1e-12);
    for (std::size_t n = 0; n < model.masses.size(); ++n)
        EXPECT_FLOAT_EQ(model.positions[n].w, 1.0f / model.masses[n]);
}

// The upper half of a block is of another material.
TEST(BuildModel, PartsHaveTheirOwnDensityDampingAndModulus) {
    Body body = test::make_body(test::make_block({3, 4, 3}, {1, 1, 1}));
    body.material = {
        .name = "flesh", .youngs_modulus = 1e4, .density = 1000.0, .damping = 0.02, .springs = {}};
    body.part_materials = {
        {.name = "bone", .youngs_modulus = 1e6, .density = 3000.0, .damping = 0.01, .springs = {}}};
    for (const glm::uvec4& tet : body.mesh.tets) {
        double y = 0.0;
        for (int k = 0; k < 4; ++k) y += 0.25 * body.mesh.positions[tet[k]].y;
        body.tet_materials.push_back(y > 0.5 ? 1u : 0u);
    }
    const Model model = test::make_model(body);
    EXPECT_NEAR(model.objects[0].mass, 2000.0, 1e-9);
    EXPECT_NEAR(sum(model.masses), 2000.0, 2000.0 * 1e-6);
    for (std::size_t t = 0; t < model.tets.size(); ++t) {
        float y = 0.0f;
        for (int k = 0; k < 4; ++k) y += 0.25f * model.positions[model.tets[t][k]].y;
        EXPECT_EQ(model.tet_rests[t].modulus, y > 0.5f ? 1e6f : 1e4f);
    }
    for (std::size_t n = 0; n < model.positions.size(); ++n) {
        const float y = model.positions[n].y;
        // In the middle by mass: (1 * 0.02 + 3 * 0.01) / 4, as a block's corners have the same tets above and
        // below.
        if (std::abs(y - 0.5f) < 0.1f) {
            EXPECT_GT(model.velocities[n].w, 0.01f);
            EXPECT_LT(model.velocities[n].w, 0.02f);
        } else {
            EXPECT_FLOAT_EQ(model.velocities[n].w, y > 0.5f ? 0.01f : 0.02f);
        }
    }
    Body soft = body;
    soft.part_materials.clear();
    soft.tet_materials.clear();
    const Model one = test::make_model(soft);
    ASSERT_EQ(one.springs.size(), model.springs.size());
    for (std::size_t s = 0; s < model.springs.size(); ++s) {
        const Spring &spring = model.springs[s], &before = one.springs[s];
        const float lower = std::min(model.positions[spring.i].y, model.positions[spring.j].y);
        const float upper = std::max(model.positions[spring.i].y, model.positions[spring.j].y);
        const float factor = spring.stiffness / before.stiffness;
        EXPECT_GE(factor, 1.0f - 1e-5f);
        EXPECT_LE(factor, 100.0f + 1e-3f);
        if (upper <= 0.5f && lower < 0.3f) {
            EXPECT_NEAR(factor, 1.0f, 1e-5f);
        } else if (lower >= 0.5f && upper > 0.7f) {
            EXPECT_NEAR(factor, 100.0f, 1e-3f);
        }
    }
}

TEST(BuildModel, RefusesPartsWithOtherKindsOfSprings) {
    Scene scene;
    scene.file = "parts.toml";
    scene.materials.resize(2);
    scene.materials[0].name = "flesh";
    scene.materials[1].name = "bone";
    scene.materials[1].springs = SpringKinds{};
    ObjectDescription object;
    object.name = "cube";
    object.material = "flesh";
    object.shape = BoxShape{};
    object.parts = {{HalfSpaceRegion{{0, 1, 0}, 0.0}, "bone", 12}};
    scene.objects.push_back(object);
    try {
        build_model(scene);
        FAIL() << "accepted springs of two kinds";
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(error.what(),
                     "parts.toml: object.cube.part[0].material = \"bone\": must have the same model and "
                     "springs as the "
                     "object's own, 'flesh'");
    }
}

TEST(BuildModel, ObjectsOwnContiguousRanges) {
    Body a = test::make_body(test::make_block({2, 2, 2}, {1, 1, 1}));
    Body b = test::make_body(test::make_block({3, 1, 1}, {1, 1, 1}));
    const Model model = pack_bodies({a, b}, {}, {});
    ASSERT_EQ(model.objects.size(), 2u);
    EXPECT_EQ(model.objects[1].nodes.first, model.objects[0].nodes.count);
    EXPECT_EQ(model.objects[1].nodes.end(), model.positions.size());
    EXPECT_EQ(model.objects[1].springs.end(), model.springs.size());
    for (std::uint32_t o = 0; o < 2; ++o) {
        const ModelObject& object = model.objects[o];
        const auto owns = [&](std::uint32_t n) { return n >= object.nodes.first && n < object.nodes.end(); };
        for (std::uint32_t s = object.springs.first; s < object.springs.end(); ++s) {
            EXPECT_TRUE(owns(model.springs[s].i) && owns(model.springs[s].j));
        }
        for (std::uint32_t f = object.faces.first; f < object.faces.end(); ++f) {
            EXPECT_TRUE(owns(model.faces[f].a) && owns(model.faces[f].b) && owns(model.faces[f].c));
            EXPECT_EQ(model.faces[f].object, o);
        }
        for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t)
            EXPECT_TRUE(owns(model.tets[t].w));
    }
}

TEST(BuildModel, PinsNodesInTheirRegions) {
    Body body = test::make_body(test::make_block({4, 1, 1}, {4, 1, 1}));
    body.velocity = {1.0, 2.0, 3.0};
    body.pins = {BoxRegion{{-0.1, -1, -1}, {0.1, 2, 2}}, SphereRegion{{4.0, 0.0, 0.0}, 0.1}};
    const Model model = test::make_model(body);
    int pinned = 0;
    for (std::size_t n = 0; n < model.positions.size(); ++n) {
        const bool inside =
            model.positions[n].x < 0.1f || glm::vec3(model.positions[n]) == glm::vec3(4, 0, 0);
        EXPECT_EQ(model.positions[n].w == 0.0f, inside);
        EXPECT_EQ(model.velocities[n].x, inside ? 0.0f : 1.0f);
        EXPECT_GT(model.masses[n], 0.0f);
        pinned += inside ? 1 : 0;
    }
    EXPECT_EQ(pinned, 5);
}

TEST(BuildModel, RefusesNumbersBeyondSinglePrecision) {
    Body body = test::make_body(test::make_block({1, 1, 1}, {1, 1, 1}));
    body.material.youngs_modulus = 1e41;
    try {
        test::make_model(body);
        FAIL() << "accepted a modulus of 1e41";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("stiffness"));
        EXPECT_THAT(error.what(), ::testing::HasSubstr("body"));
    }
}

TEST(BuildModel, SaysWhichObjectsPinsHoldNothing) {
    Scene scene;
    scene.file = "pins.toml";
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    ObjectDescription object;
    object.name = "cube";
    object.material = "jelly";
    object.shape = BoxShape{};
    object.pins_line = 12;
    object.pins = {SphereRegion{{9, 9, 9}, 0.1}};
    scene.objects.push_back(object);
    try {
        build_model(scene);
        FAIL() << "accepted pins without nodes";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), ::testing::StartsWith("pins.toml:12: object.cube.pins: hold no node"));
    }
}

// Who makes meshes does not know where in a scene they are named.
TEST(BuildModel, AFileThatIsMissingIsNamedByTheScene) {
    Scene scene;
    scene.file = "scene.toml";
    scene.materials.emplace_back().name = "jelly";
    ObjectDescription& object = scene.objects.emplace_back();
    object.name = "ball";
    object.material = "jelly";
    object.line = 4;
    const auto error_of = [&](const Shape& shape) -> std::string {
        object.shape = shape;
        try {
            build_model(scene);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_EQ(error_of(FileShape{"gone.obj"}),
              "scene.toml:4: object.ball.shape.file = gone.obj: no such file");
    EXPECT_EQ(error_of(FileShape{"gone.ele"}),
              "scene.toml:4: object.ball.shape.file = gone.ele: gone.node: no such file");
    EXPECT_THAT(error_of(TextShape{.text = "A", .font = "gone.ttf"}),
                testing::StartsWith(
                    "scene.toml:4: object.ball.shape.font = \"gone.ttf\": this font is not installed"));
    object.rigid.emplace();
    EXPECT_EQ(error_of(FileShape{"gone.stl"}),
              "scene.toml:4: rigid.ball.shape.file = gone.stl: no such file");
}

}  // namespace
}  // namespace gelatin
