#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/file.h"
#include "mesh/mesh_samples.h"
#include "mesh/surface_file.h"
#include "mesh/surface_repair.h"

namespace gelatin {

/// Reads surfaces from files with a given content.
class SurfaceFileFixture : public testing::Test {
protected:
    std::filesystem::path make(const std::string& name, const std::string& content) const {
        std::ofstream(folder_.path() / name, std::ios::binary) << content;  // write_file waits for the disk
        return folder_.path() / name;
    }
    SurfaceMesh read(const std::string& name, const std::string& content) {
        notes_.clear();
        return read_surface(make(name, content), notes_);
    }
    std::string refusal_of(const std::string& name, const std::string& content) {
        return refusal([&] { read(name, content); });
    }
    SurfaceMesh read(const std::string& name) { return read_surface(folder_.path() / name, notes_); }

    TemporaryFolder folder_;
    Notes notes_;
};

inline void expect_tetrahedron(const SurfaceMesh& mesh) {
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.faces.size(), 4u);
    EXPECT_TRUE(measure_openness(mesh).is_closed());
    EXPECT_NEAR(signed_volume(mesh), 1.0 / 6.0, 1e-12);
}

/// Of the corner of a face at a position; (-1, -1): it has none there.
inline glm::vec2 uv_at(const SurfaceMesh& mesh, std::size_t face, const glm::dvec3& corner) {
    for (int k = 0; k < 3; ++k) {
        if (mesh.positions[mesh.faces[face][k]] == corner)
            return mesh.look.corner_uvs[face][static_cast<std::size_t>(k)];
    }
    return glm::vec2(-1.0f);
}

template <class T>
std::string bytes_of(const T& value, bool swapped = false) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    return swapped ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// Decisions of a fuzz test.
class Dice {
public:
    explicit Dice(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t end) { return random_() % end; }
    bool one_in(std::size_t count) { return below(count) == 0; }
    std::string any(std::vector<std::string> of) { return of[below(of.size())]; }
    /// The number in one of the forms that programs write, exactly.
    std::string number(double value) {
        const std::string plain = fmt::format("{}", value);
        switch (below(7)) {
            case 0:
                return value < 0.0 ? plain : "+" + plain;
            case 1:
                return fmt::format("{:.12e}", value);
            case 2:
                return fmt::format("{:.12E}", value);
            case 3:
                return plain.find('.') == std::string::npos ? plain + "." : plain + "000";
            case 4:
                if (plain.starts_with("0.")) return plain.substr(1);
                return plain.starts_with("-0.") ? "-" + plain.substr(2) : plain;
            case 5:
                return fmt::format("{:.9f}", value);
            default:
                return plain;
        }
    }
    std::string blank() { return any({" ", "  ", "\t", " \t "}); }
    std::string indentation() { return one_in(3) ? blank() : ""; }

private:
    std::mt19937 random_;
};

/// A prism over a star, which is not convex: two polygons of `corners()` corners and as many quads.
class StarPrism {
public:
    explicit StarPrism(Dice& dice) : points_(3 + dice.below(5)) {
        for (std::size_t k = 0; k < corners(); ++k) {
            const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(points_);
            const double radius = k % 2 == 0 ? 2.0 : 0.75;
            // Of few bits, so that texts and floats are exact.
            const auto rounded = [](double value) { return std::round(64.0 * value) / 64.0 + 0.0; };
            outline_.emplace_back(rounded(radius * std::cos(angle)), rounded(radius * std::sin(angle)));
        }
        for (const double z : {0.0, kHeight}) {
            for (const glm::dvec2& p : outline_) positions.emplace_back(p, z);
        }
        polygons.resize(2);
        for (std::uint32_t k = 0; k < corners(); ++k) {
            const auto n = static_cast<std::uint32_t>(corners()), next = (k + 1) % n;
            polygons[0].insert(polygons[0].begin(), k);
            polygons[1].push_back(n + k);
            polygons.push_back({k, next, n + next, n + k});
        }
    }

    std::size_t corners() const { return 2 * points_; }

    void expect(const SurfaceMesh& mesh) const {
        EXPECT_EQ(mesh.positions.size(), positions.size());
        EXPECT_EQ(mesh.faces.size(), 2 * (corners() - 2) + 2 * corners());
        EXPECT_TRUE(measure_openness(mesh).is_closed());
        double area = 0.0;
        for (std::size_t k = 0; k < corners(); ++k) {
            const glm::dvec2 &a = outline_[k], &b = outline_[(k + 1) % corners()];
            area += (a.x * b.y - a.y * b.x) / 2.0;
        }
        EXPECT_NEAR(signed_volume(mesh), area * kHeight, 1e-12);
        double surface = 0.0;  // larger, if a triangle is outside its polygon
        for (const glm::uvec3& f : mesh.faces) {
            const glm::dvec3 &a = mesh.positions[f[0]], &b = mesh.positions[f[1]], &c = mesh.positions[f[2]];
            surface += length(cross(b - a, c - a)) / 2.0;
        }
        double sides = 0.0;
        for (std::size_t k = 0; k < corners(); ++k)
            sides += kHeight * distance(outline_[k], outline_[(k + 1) % corners()]);
        EXPECT_NEAR(surface, 2.0 * area + sides, 1e-12);
    }

    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> polygons;

private:
    static constexpr double kHeight = 0.625;
    std::size_t points_;
    std::vector<glm::dvec2> outline_;
};

/// The line for what a reader ignores, if there is any.
inline void expect_ignored(const Notes& notes, const std::string& what, std::size_t count) {
    const std::string line = fmt::format("ignored {}: {}", what, count);
    if (count > 0) {
        EXPECT_THAT(notes, testing::Contains(line));
    } else {
        EXPECT_THAT(notes, testing::Not(testing::Contains(testing::HasSubstr(what))));
    }
}

}  // namespace gelatin
