#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/file.h"
#include "mesh/tet_file.h"
#include "mesh_samples.h"

namespace gelatin {

// Every sample is this mesh: two tets on the shared face 0 1 2.
inline const TetMesh kPair = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.2, -1.0 / 3.0}}, {{0, 1, 2, 3}, {0, 2, 1, 4}}, {}};
inline const std::string kPositions = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.1 0.2 -0.3333333333333333\n";

inline const std::string kMedit =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "0.1 0.2 -0.3333333333333333 7\nTetrahedra\n2\n1 2 3 4 1\n1 3 2 5 1\nEnd\n";
inline const std::string kGmsh2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"a name\"\n$EndPhysicalNames\n$Nodes\n5\n"
    "10 0 0 0\n20 1 0 0\n30 0 1 0\n5 0 0 1\n4000000000 0.1 0.2 -0.3333333333333333\n$EndNodes\n"
    "$Elements\n2\n1 4 2 1 1 10 20 30 5\n2 4 0 10 30 20 4000000000\n$EndElements\n";
inline const std::string kGmsh4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n2 5 "
    "5 77\n"
    "2 1 1 2\n10\n20\n0 0 0 0.5 0.5\n1 0 0 0.5 0.5\n3 1 0 3\n30\n5\n77\n0 1 0\n0 0 1\n"
    "0.1 0.2 -0.3333333333333333\n$EndNodes\n"
    "$Elements\n1 2 1 2\n3 1 4 2\n1 10 20 30 5\n2 10 30 20 77\n$EndElements\n";

inline std::string replaced(std::string text, const std::string& old, const std::string& with) {
    EXPECT_NE(text.find(old), std::string::npos) << old;
    return text.replace(text.find(old), old.size(), with);
}

// Appends numbers as they lie in a file of either byte order.
class Bytes {
public:
    explicit Bytes(bool swapped) : swapped_(swapped) {}
    Bytes& text(const std::string& text) {
        all_ += text;
        return *this;
    }
    template <class T>
    Bytes& add(const std::vector<T>& values) {
        for (const T& value : values) {
            std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
            if (swapped_) std::reverse(bytes.begin(), bytes.end());
            all_ += bytes;
        }
        return *this;
    }
    const std::string& all() const { return all_; }

private:
    bool swapped_;
    std::string all_;
};
using Ints = std::vector<std::int32_t>;
using Sizes = std::vector<std::uint64_t>;
using Doubles = std::vector<double>;

inline std::string binary_gmsh2(bool swapped) {
    Bytes bytes(swapped);
    bytes.text("$MeshFormat\n2.2 1 8\n").add(Ints{1}).text("\n$EndMeshFormat\n$Nodes\n5\n");
    for (std::int32_t n = 0; n < 5; ++n) {
        const glm::dvec3& p = kPair.positions[static_cast<std::size_t>(n)];
        bytes.add(Ints{3 * n + 2}).add(Doubles{p.x, p.y, p.z});
    }
    bytes.text("\n$EndNodes\n$Elements\n4\n").add(Ints{15, 1, 2, 1, 0, 1, 2});  // a point
    bytes.add(Ints{4, 2, 2, 2, 1, 1, 2, 5, 8, 11, 3, 1, 1, 2, 8, 5, 14});       // two tets
    bytes.add(Ints{2, 1, 2, 4, 1, 1, 2, 5, 8}).text("\n$EndElements\n");        // a triangle
    return bytes.all();
}

inline std::string binary_gmsh4(bool swapped) {
    Bytes bytes(swapped);
    bytes.text("$MeshFormat\n4.1 1 8\n").add(Ints{1}).text("\n$EndMeshFormat\n$Entities\n");
    bytes.add(Sizes{0, 0, 0, 0}).text("\n$EndEntities\n$Nodes\n");
    bytes.add(Sizes{2, 5, 1, 5}).add(Ints{1, 7, 1}).add(Sizes{1, 1}).add(Doubles{0, 0, 0, 0.5});
    bytes.add(Ints{3, -1, 0}).add(Sizes{4, 2, 3, 4, 5});
    for (std::size_t n = 1; n < 5; ++n) {
        bytes.add(Doubles{kPair.positions[n].x, kPair.positions[n].y, kPair.positions[n].z});
    }
    bytes.text("\n$EndNodes\n$Elements\n")
        .add(Sizes{2, 3, 1, 3})
        .add(Ints{2, 1, 2})
        .add(Sizes{1, 1, 1, 2, 3});
    bytes.add(Ints{3, 1, 4}).add(Sizes{2, 2, 1, 2, 3, 4, 3, 1, 3, 2, 5}).text("\n$EndElements\n");
    return bytes.all();
}

// Reads files of a folder of its own.
class TetFileTest : public testing::Test {
protected:
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    std::filesystem::path make(const std::string& name, const std::string& content) {
        std::ofstream(path(name), std::ios::binary) << content;  // write_file waits for the disk
        return path(name);
    }
    TetMesh read(const std::string& name, const std::string& content) {
        notes_.clear();
        return read_tets(make(name, content), notes_);
    }
    TetMesh read_tetgen(const std::string& nodes, const std::string& tets) {
        make("a.ele", tets);
        return read("a.node", nodes);
    }
    std::string refusal_of(const std::string& name, const std::string& content) {
        return refusal([&] { read(name, content); });
    }

    TemporaryFolder folder_;
    Notes notes_;
};

}  // namespace gelatin
