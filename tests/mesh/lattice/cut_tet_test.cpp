#include "mesh/lattice/cut_tet.h"

#include <gtest/gtest.h>

#include <map>

#include "mesh/lattice/sound_tets.h"

namespace gelatin::lattice {
namespace {

// A tet with outer corners cut off where a linear function is zero, so that the volume is known.
class CutTetTest : public testing::Test {
protected:
    std::vector<glm::dvec3> positions_ = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::array<double, 4> values_ = {};  // positive inside

    std::vector<glm::uvec4> cut() {
        std::array<Side, 4> sides = {};
        for (std::size_t k = 0; k < 4; ++k)
            sides[k] = values_[k] > 0.0 ? Side::inside : values_[k] < 0.0 ? Side::outside : Side::boundary;
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cuts;
        const auto node_of_cut = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] = cuts.try_emplace(std::minmax(a, b), positions_.size());
            const double t = values_[a] / (values_[a] - values_[b]);
            if (is_new) positions_.push_back(positions_[a] + t * (positions_[b] - positions_[a]));
            return found->second;
        };
        for (std::uint32_t a = 0; a < 4;
             ++a) {  // before, because the cutter keeps a reference to the positions
            for (std::uint32_t b = 0; b < a; ++b) {
                if (values_[a] * values_[b] < 0.0) node_of_cut(a, b);
            }
        }
        std::vector<glm::uvec4> tets;
        cut_tet({0, 1, 2, 3}, sides, node_of_cut, positions_, tets);
        return tets;
    }
};

// Of the unit tet's volume with values v at corners, what is above zero.
double volume_above_zero(const std::array<double, 4>& v) {
    constexpr int kPieces = 120;  // by summing up little cubes' centres
    double inside = 0.0, all = 0.0;
    for (int i = 0; i < kPieces; ++i) {
        for (int j = 0; j + i < kPieces; ++j) {
            for (int k = 0; k + j + i < kPieces; ++k) {
                const double x = (i + 0.25) / kPieces, y = (j + 0.25) / kPieces, z = (k + 0.25) / kPieces;
                if ((1.0 - x - y - z) * v[0] + x * v[1] + y * v[2] + z * v[3] > 0.0) inside += 1.0;
                all += 1.0;
            }
        }
    }
    return inside / all / 6.0;
}

TEST_F(CutTetTest, KeepsTheVolumeThatIsInside) {
    constexpr std::array<double, 3> kValues = {1.0, 0.0, -0.7};
    for (int k = 0; k < 81; ++k) {
        values_ = {kValues[k % 3], 1.3 * kValues[k / 3 % 3], 0.8 * kValues[k / 9 % 3], 1.1 * kValues[k / 27]};
        if (*std::max_element(values_.begin(), values_.end()) <= 0.0) continue;
        positions_.resize(4);
        TetMesh mesh;
        mesh.tets = cut();
        mesh.positions = positions_;
        double volume = 0.0;
        for (const glm::uvec4& tet : mesh.tets) volume += std::abs(tet_volume(mesh, tet));
        EXPECT_NEAR(volume, volume_above_zero(values_), 3e-3) << k;
        for (glm::uvec4& tet : mesh.tets) {
            if (tet_volume(mesh, tet) < 0.0) std::swap(tet[2], tet[3]);
        }
        EXPECT_TRUE(is_manifold(boundary_faces(mesh.tets))) << k;
    }
}

}  // namespace
}  // namespace gelatin::lattice
