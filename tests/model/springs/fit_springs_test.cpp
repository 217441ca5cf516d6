#include "model/springs/fit_springs.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "core/file.h"
#include "mesh/topology.h"
#include "model/assembly/build_model.h"
#include "model/springs/elastic_response.h"
#include "model/springs/spring_cache.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

TetMesh mesh_of(std::vector<glm::dvec3> positions, std::vector<glm::uvec4> tets) {
    TetMesh mesh{std::move(positions), std::move(tets), {}};
    mesh.faces = boundary_faces(mesh.tets);
    return mesh;
}

TetMesh one_tet() {
    return mesh_of({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}}, {{0, 1, 2, 3}});
}

// Corners that the fit must live with, all of them valid meshes.
std::vector<TetMesh> odd_meshes() {
    std::vector<TetMesh> meshes = {one_tet()};
    // Two tets over a face; the second a sliver, whose corner nearly lies in that face.
    for (const double depth : {1.0, 1e-3, 1e-9}) {
        meshes.push_back(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -depth}},
                                 {{0, 1, 2, 3}, {0, 2, 1, 4}}));
    }
    // Both slivers: the link across is nearly nothing.
    meshes.push_back(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-8}, {0.3, 0.3, -1e-8}},
                             {{0, 1, 2, 3}, {0, 2, 1, 4}}));
    // Two tets that share an edge alone, and a node that no tet has.
    meshes.push_back(
        mesh_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.5, 1}, {0.5, -1, 0}, {0.5, -0.5, -1}, {9, 9, 9}},
                {{0, 1, 2, 3}, {0, 1, 4, 5}}));
    meshes.push_back(test::make_block({6, 5, 1}, {1, 1, 0.1}));       // one element thick
    meshes.push_back(test::make_block({12, 1, 1}, {1, 0.05, 0.05}));  // and a rod of one
    meshes.push_back(test::make_block({3, 3, 3}, {1, 1, 1}, 0.3));
    TetMesh notched = test::make_block({4, 4, 4}, {1, 1, 1});  // not convex
    std::erase_if(notched.tets, [&](const glm::uvec4& t) {
        const glm::dvec3 middle = 0.25 * (notched.positions[t.x] + notched.positions[t.y] +
                                          notched.positions[t.z] + notched.positions[t.w]);
        return middle.x > 0.5 && middle.y > 0.5;
    });
    meshes.push_back(mesh_of(notched.positions, notched.tets));
    return meshes;
}

TEST(FitSprings, StiffnessesArePositiveAndFiniteOnAnyMesh) {
    std::size_t number = 0;
    for (const TetMesh& mesh : odd_meshes()) {
        SCOPED_TRACE(number++);
        const FittedSprings fitted = fit_springs(mesh);
        EXPECT_GE(fitted.springs.size(), tet_edges(mesh.tets).size());
        std::set<std::pair<unsigned, unsigned>> pairs;
        for (const UnitSpring& spring : fitted.springs) {
            EXPECT_LT(spring.nodes.x, spring.nodes.y);
            EXPECT_LT(spring.nodes.y, mesh.positions.size());
            EXPECT_GT(spring.stiffness, 0.0);
            EXPECT_TRUE(std::isfinite(spring.stiffness));
            pairs.emplace(spring.nodes.x, spring.nodes.y);
        }
        EXPECT_EQ(pairs.size(), fitted.springs.size()) << "a pair has more than one spring";
    }
}

TEST(FitSprings, SizeScalesThemAndPlaceDoesNot) {
    const TetMesh mesh = test::make_block({4, 5, 3}, {1.0, 1.2, 0.8}, 0.2);
    TetMesh other = mesh;
    for (glm::dvec3& p : other.positions) p = 3.0 * p + glm::dvec3(5.0, -2.0, 0.5);
    const FittedSprings a = fit_springs(mesh), b = fit_springs(other);
    ASSERT_EQ(a.springs.size(), b.springs.size());
    for (std::size_t s = 0; s < a.springs.size(); ++s)
        EXPECT_NEAR(b.springs[s].stiffness / (3.0 * a.springs[s].stiffness), 1.0, 1e-9);
}

TEST(FitSpringsHeavy, GivesTheSameBitsOnOneThread) {
    const TetMesh mesh = test::make_block({12, 12, 12}, {1, 1, 1}, 0.2);
    const FittedSprings many = fit_springs(mesh);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const FittedSprings alone = fit_springs(mesh);
    for (std::size_t s = 0; s < many.springs.size(); ++s)
        ASSERT_EQ(many.springs[s].stiffness, alone.springs[s].stiffness);
    EXPECT_EQ(many.softest, alone.softest);
}

// Pulled along the axes and converged far beyond what the fit itself does.
TEST(FitSprings, AnswerWithTheModulusAskedForAlongTheAxes) {
    const TetMesh mesh = test::make_block({6, 6, 6}, {1.0, 1.1, 0.9}, 0.2);
    const FittedSprings fitted = fit_springs(mesh);
    std::vector<Link> links;
    std::vector<double> stiffness;
    for (const UnitSpring& spring : fitted.springs) {
        links.push_back({spring.nodes, 0.0});
        stiffness.push_back(spring.stiffness);
    }
    const double modulus = 1.0 / kShearOverYoungs;
    const ElasticResponse response =
        measure_response(mesh, make_rest_net(mesh, links), stiffness, modulus, 1e-14);
    double compliance = 0.0;
    for (int axis = 0; axis < 3; ++axis) compliance += response.compliance(axis, axis) * modulus / 3.0;
    EXPECT_NEAR(compliance, 1.0, 2e-3);
    EXPECT_NEAR(response.poisson_ratio(), 0.25, 0.02);
    const auto [softest, stiffest] = response.youngs_modulus_range();
    EXPECT_NEAR(softest / modulus, fitted.softest, 5e-3);
    EXPECT_NEAR(stiffest / modulus, fitted.stiffest, 5e-3);
}

TEST(FitSprings, TellsWhereSpringsCannotBeIsotropic) {
    const FittedSprings good = fit_springs(test::make_block({6, 6, 6}, {1, 1, 1}));
    EXPECT_GT(good.softest, 0.9);
    EXPECT_LT(good.stiffest, 1.1);
    EXPECT_LT(fit_springs(test::make_block({6, 6, 6}, {1, 1, 0.2})).softest, 0.6);
}

// As a scene's copies are: placed, scaled, of another stiffness, from one fit.
TEST(FitSprings, OneFitServesBodiesOfAnySizeAndPlace) {
    Material material;
    material.youngs_modulus = 3e4;
    Body plain = test::make_body(test::make_block({4, 4, 4}, {1, 1, 1}, 0.2), material);
    Body placed = plain;
    placed.fitted = std::make_shared<const FittedSprings>(fit_springs(plain.mesh));
    placed.scale = 0.5;
    for (glm::dvec3& p : placed.mesh.positions) p = 0.5 * glm::dvec3(p.y, -p.x, p.z) + glm::dvec3(1, 2, 3);
    const Model model = pack_bodies({plain, placed}, {}, {});
    const Range a = model.objects[0].springs, b = model.objects[1].springs;
    ASSERT_EQ(a.count, b.count);
    for (std::uint32_t s = 0; s < a.count; ++s) {
        const Spring &first = model.springs[a.first + s], &second = model.springs[b.first + s];
        EXPECT_EQ(first.i + model.objects[1].nodes.first, second.i);
        EXPECT_NEAR(static_cast<double>(second.stiffness / first.stiffness), 0.5, 1e-6);
        EXPECT_NEAR(static_cast<double>(second.rest_length / first.rest_length), 0.5, 1e-6);
    }
}

TEST(SpringCache, KeepsWhatWasFittedAndNothingElse) {
    const TemporaryFolder folder;
    const SpringCache cache(folder.path());
    TetMesh mesh = test::make_block({3, 3, 3}, {1, 1, 1}, 0.2);
    const FittedSprings fitted = cache.fit(mesh);
    ASSERT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
    const fs::path entry = fs::directory_iterator(folder.path())->path();
    const std::string good = read_file(entry);

    const auto is_same = [&](const FittedSprings& other) {
        for (std::size_t s = 0; s < fitted.springs.size(); ++s) {
            if (other.springs[s].nodes != fitted.springs[s].nodes ||
                other.springs[s].stiffness != fitted.springs[s].stiffness)
                return false;
        }
        return other.springs.size() == fitted.springs.size() && other.softest == fitted.softest &&
               other.stiffest == fitted.stiffest;
    };
    const auto written = fs::last_write_time(entry);
    EXPECT_TRUE(is_same(cache.fit(mesh)));
    EXPECT_EQ(fs::last_write_time(entry), written) << "fitted again";

    std::string damaged = good;
    damaged[damaged.size() / 2] ^= 0x10;
    write_file(entry, damaged);
    EXPECT_TRUE(is_same(cache.fit(mesh)));
    EXPECT_EQ(read_file(entry), good) << "a damaged entry is replaced";

    mesh.positions[21] += glm::dvec3(0.0, 0.0, 1e-9);
    cache.fit(mesh);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

}  // namespace
}  // namespace gelatin
