// What read_tets refuses, and that nothing else comes of damaged files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string_view>

#include "tet_file_fixture.h"
#include "vtk_samples.h"

namespace gelatin {
namespace {

using testing::HasSubstr;

class TetFileRefusalTest : public TetFileTest {
protected:
    // Every beginning of a file is a mesh or is refused; nothing else.
    void try_every_prefix(const std::string& name, const std::string& content) {
        try_prefixes(name, content, 1);
    }
    void try_prefixes(const std::string& name, const std::string& content, std::size_t stride) {
        for (std::size_t size = 0; size <= content.size(); size += stride)
            try_content(name, content.substr(0, size));
    }
    void try_damaged(const std::string& name, const std::string& content, int trials = 500) {
        std::mt19937 random(3);
        for (int trial = 0; trial < trials; ++trial) {
            std::string damaged = content;
            for (int k = 0; k < 3; ++k) {
                constexpr std::string_view kBytes("\0\xff\n 9-.#eafx$", 13);
                damaged[random() % damaged.size()] = kBytes[random() % kBytes.size()];
            }
            try_content(name, damaged);
        }
    }
    void try_content(const std::string& name, const std::string& content) {
        try {
            const TetMesh mesh = read(name, content);
            EXPECT_FALSE(mesh.tets.empty());
            for (const glm::uvec4& tet : mesh.tets) {
                for (int corner = 0; corner < 4; ++corner) EXPECT_LT(tet[corner], mesh.positions.size());
            }
        } catch (const InvalidInput& error) {
            EXPECT_THAT(error.what(), HasSubstr(path(name).stem().string()));
            EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
        }
    }
};

TEST_F(TetFileRefusalTest, RefusesFlatTets) {
    EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "0 0 1 0\n", "1 1 0 0\n")),
                HasSubstr("tet 1: is flat"));
    EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "1 3 2 5", "1 3 3 5")), HasSubstr("tet 2: is flat"));
    EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "0 0 1 0\n", "0 0 1e-12 0\n")),
                HasSubstr("tet 1: is flat"));
    EXPECT_EQ(read("a.mesh", replaced(kMedit, "0 0 1 0\n", "0 0 1e-9 0\n")).tets.size(), 2u);
}

TEST_F(TetFileRefusalTest, RefusesFilesThatAreNotThereOrEmpty) {
    EXPECT_EQ(refusal([&] { read_tets("/no/such/a.msh", notes_); }), "/no/such/a.msh: no such file");
    EXPECT_THAT(refusal_of("lonely.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n"),
                HasSubstr("lonely.ele: no such file"));
    make("orphan.ele", "1 4 0\n0 0 1 2 3\n");
    EXPECT_THAT(refusal([&] { read_tets(path("orphan.ele"), notes_); }),
                HasSubstr("orphan.node: no such file"));
    for (const char* name : {"a.node", "a.mesh", "a.msh", "a.vtk", "a.vtu"}) {
        EXPECT_THAT(refusal_of(name, ""), HasSubstr(name));
        EXPECT_THAT(refusal_of(name, std::string(200, '\0')), HasSubstr(name));
    }
    EXPECT_THAT(refusal_of("a.tet", "x"), HasSubstr(".node, .ele, .mesh, .msh, .vtk or .vtu"));
}

TEST_F(TetFileRefusalTest, RefusesFilesWithoutTets) {
    EXPECT_THAT(
        refusal_of("a.mesh", replaced(kMedit, "Tetrahedra", "TetrahedraP2")),
        HasSubstr(
            "no tets (the body lacks cells of a kind that Gelatin cannot read, Medit's TetrahedraP2: 2)"));
    EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "2\n1 2 3 4 1\n1 3 2 5 1\n", "0\n")),
                HasSubstr("no tets"));
    EXPECT_THAT(
        refusal_of("a.msh", replaced(kGmsh2, "2\n1 4 2 1 1 10 20 30 5\n2 4 0 10 30 20 4000000000\n", "0\n")),
        HasSubstr("no tets"));
}

TEST_F(TetFileRefusalTest, RefusesElementsWithoutNodes) {
    const std::string msh =
        replaced(replaced(kGmsh2, "$Nodes", "$ParametricNodes"), "$EndNodes", "$EndParametricNodes");
    EXPECT_THAT(refusal_of("a.msh", msh), HasSubstr("a.msh:16: section = $Elements: must follow $Nodes"));
}

TEST_F(TetFileRefusalTest, RefusesUnknownVersions) {
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "2.2 0", "4.0 0")),
                HasSubstr("a.msh:2: version = 4.0: must be 2.2 or 4.1"));
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "0 8", "0 4")),
                HasSubstr("a.msh:2: size of numbers = 4"));
    EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "Formatted 2", "Formatted 9")),
                HasSubstr("a.mesh:1: MeshVersionFormatted = 9"));
    EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "Dimension 3", "Dimension 2")),
                HasSubstr("a.mesh:2: Dimension = 2"));
    EXPECT_THAT(refusal_of("a.node", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n9 9 9\n"),
                HasSubstr("a.node:1: dimension = 2"));
    make("a.ele", "1 6 0\n0 0 1 2 3 4 5\n");
    EXPECT_THAT(refusal_of("a.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n"),
                HasSubstr("a.ele:1: nodes of a tet = 6"));
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "2 4 0 10", "2 199 0 10")),
                HasSubstr("type of element 2 = 199"));
}

TEST_F(TetFileRefusalTest, NamesTheNodeThatIsNotFinite) {
    for (const char* value : {"nan", "inf", "-Inf", "1e999", "1e39"}) {
        const std::string number(value);
        EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "0 1 0 0\n", "0 " + number + " 0 0\n")),
                    HasSubstr("a.mesh:7: vertex 3 = "));
        EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "0 1 0\n", "0 " + number + " 0\n")),
                    HasSubstr("a.msh:12: node 3 = "));
        EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh4, "0 1 0\n0", "0 " + number + " 0\n0")),
                    HasSubstr("a.msh:19: node 3 = "));
        EXPECT_THAT(refusal_of("a.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 " + number + " 0\n3 0 0 1\n"),
                    HasSubstr("a.node:4: node 3 = "));
    }
    std::string binary = binary_gmsh4(false);
    const double one = 1.0, not_a_number = std::nan("");
    const std::size_t place = binary.find(std::string(reinterpret_cast<const char*>(&one), 8));
    binary.replace(place, 8, std::string(reinterpret_cast<const char*>(&not_a_number), 8));
    EXPECT_THAT(refusal_of("a.msh", binary), HasSubstr("a.msh: node 2 = nan"));
}

TEST_F(TetFileRefusalTest, RefusesCountsThatTheFileIsTooShortFor) {
    for (const char* text :
         {"1000000000000", "99999999999999999999999", "18446744073709551615", "4000000000", "50"}) {
        const std::string count = text;
        EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "Vertices\n5", "Vertices\n" + count)),
                    HasSubstr("a.mesh:4: number of Vertices = "));
        EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "Tetrahedra\n2", "Tetrahedra\n" + count)),
                    HasSubstr("a.mesh:11: number of Tetrahedra = "));
        EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "$Nodes\n5", "$Nodes\n" + count)),
                    HasSubstr("a.msh:9: number of nodes = "));
        EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "$Elements\n2", "$Elements\n" + count)),
                    HasSubstr("a.msh:17: number of elements = "));
        EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh4, "2 5 5 77", "2 " + count + " 5 77")),
                    HasSubstr("a.msh:9: number of nodes = "));
        EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh4, "3 1 0 3", "3 1 0 " + count)), HasSubstr("a.msh"));
        EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh4, "3 1 4 2", "3 1 4 " + count)),
                    HasSubstr("size of element block 1 = "));
        EXPECT_THAT(refusal_of("a.node", count + " 3 0 0\n0 0 0 0\n"),
                    HasSubstr("a.node:1: number of nodes = "));
        make("a.ele", count + " 4 0\n0 0 1 2 3\n");
        EXPECT_THAT(refusal_of("a.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n"),
                    HasSubstr("a.ele:1: number of tets = "));
    }
    EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "Vertices\n5", "Vertices\n1000000000000")),
                HasSubstr("the file is too short for so many"));
    Bytes bytes(false);
    bytes.text("$MeshFormat\n4.1 1 8\n").add(Ints{1}).text("\n$EndMeshFormat\n$Nodes\n");
    bytes.add(Sizes{1, 1'000'000'000'000, 1, 1}).add(Ints{3, 1, 0}).add(Sizes{1'000'000'000'000, 1, 2, 3});
    EXPECT_THAT(refusal_of("a.msh", bytes.all()),
                HasSubstr("number of nodes = 1000000000000: the file is too short"));
}

TEST_F(TetFileRefusalTest, RefusesCountsThatDoNotAgree) {
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh4, "2 5 5 77", "2 4 5 77")),
                HasSubstr("number of nodes = 4: but the blocks have 5"));
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh4, "1 2 1 2\n", "1 3 1 2\n")),
                HasSubstr("number of elements = 3: but the blocks have 2"));
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "$Nodes\n5", "$Nodes\n4")),
                HasSubstr("a.msh:14: word = 4000000000: must be '$EndNodes' here"));
    EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "Vertices\n5", "Vertices\n4")),
                HasSubstr("a.mesh:9: keyword = 0.1"));
    make("a.ele", "1 4 0\n0 0 1 2 3\n1 0 2 1 3\n");
    EXPECT_THAT(refusal_of("a.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n"),
                HasSubstr("a.ele:3: tet = 1: there are more rows"));
}

TEST_F(TetFileRefusalTest, RefusesIndicesOutOfRange) {
    for (const char* index : {"0", "6", "-1", "x", "4294967297", "1.5"}) {
        EXPECT_THAT(refusal_of("a.mesh", replaced(kMedit, "1 3 2 5", std::string("1 3 2 ") + index)),
                    HasSubstr("a.mesh:13: Tetrahedra 2 = "));
        make("a.ele", std::string("1 4 0\n1 1 2 3 ") + index + "\n");
        EXPECT_THAT(refusal_of("a.node", "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"),
                    HasSubstr("a.ele:2: tet 1 = "));
    }
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "10 30 20 4000000000", "10 30 20 21")),
                HasSubstr("a.msh:19: element 2 = 21: there is no node of this number"));
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh4, "2 10 30 20 77", "2 10 30 20 78")),
                HasSubstr("element 2 = 78"));
}

TEST_F(TetFileRefusalTest, RefusesNodesOfOneNumber) {
    EXPECT_THAT(refusal_of("a.msh", replaced(kGmsh2, "20 1 0 0", "10 1 0 0")),
                HasSubstr("number of node = 10: must not be given twice"));
    EXPECT_THAT(refusal_of("a.node", "2 3 0 0\n1 0 0 0\n1 1 0 0\n"),
                HasSubstr("a.node:3: number of node 2 = 1"));
}

TEST_F(TetFileRefusalTest, TakesEveryPrefixInItsStride) {
    try_every_prefix("a.mesh", kMedit);
    try_every_prefix("a.msh", kGmsh2);
    try_every_prefix("a.msh", kGmsh4);
    try_every_prefix("a.msh", binary_gmsh2(false));
    try_every_prefix("a.msh", binary_gmsh4(true));
    for (const std::string& vtk : {kVtkText, kVtk5Text, vtk_binary(false), vtk_binary(true)})
        try_every_prefix("a.vtk", vtk);
    for (const VtuChoice& choice : vtu_choices()) try_prefixes("a.vtu", VtuSample(choice).text(), 23);
    make("b.ele", "1 4 0\n0 0 1 2 3\n");
    try_every_prefix("b.node", "4 3 1 1\n0 0 0 0 5 1\n1 1 0 0 5 1\n2 0 1 0 5 1\n3 0 0 1 5 1\n");
    make("c.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    try_every_prefix("c.ele", "1 4 1\n0 0 1 2 3 -5\n");
}

TEST_F(TetFileRefusalTest, TakesDamagedBytesInItsStride) {
    try_damaged("a.mesh", kMedit);
    try_damaged("a.msh", kGmsh2);
    try_damaged("a.msh", kGmsh4);
    try_damaged("a.msh", binary_gmsh2(true));
    try_damaged("a.msh", binary_gmsh4(false));
    for (const std::string& vtk : {kVtkText, kVtk5Text, vtk_binary(false), vtk_binary(true)})
        try_damaged("a.vtk", vtk);
    for (const VtuChoice& choice : vtu_choices()) try_damaged("a.vtu", VtuSample(choice).text(), 60);
    make("b.ele", "1 4 0\n0 0 1 2 3\n");
    try_damaged("b.node", "4 3 1 1\n0 0 0 0 5 1\n1 1 0 0 5 1\n2 0 1 0 5 1\n3 0 0 1 5 1\n");
}

}  // namespace
}  // namespace gelatin
