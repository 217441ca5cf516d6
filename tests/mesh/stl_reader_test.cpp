// STL as other programs write it.
#include "mesh/surface_file_fixture.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class StlReaderTest : public SurfaceFileFixture {};

using Triangle = std::array<glm::dvec3, 3>;

const std::vector<Triangle> kTetrahedron = {{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                            {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                            {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                            {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

std::string binary(std::string header, std::uint16_t attribute = 0) {
    header.resize(80, ' ');
    std::string bytes = header + bytes_of(static_cast<std::uint32_t>(kTetrahedron.size()));
    for (const Triangle& triangle : kTetrahedron) {
        bytes += bytes_of(glm::vec3(std::nanf("")));  // nobody needs the normal
        for (const glm::dvec3& corner : triangle) bytes += bytes_of(glm::vec3(corner));
        bytes += bytes_of(attribute);
    }
    return bytes;
}

/// Several solids, some of them empty, in any case.
std::string odd_text(Dice& dice, std::size_t& colors) {
    const std::string end = dice.any({"\n", "\r\n", "\r"});
    const bool is_upper = dice.one_in(3);
    const auto word = [&](std::string text) {
        for (char& c : text) {
            if (is_upper && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
        }
        return dice.indentation() + text;
    };
    const std::string name = dice.any({"", " part 1", " facet normal", " a solid endsolid"});
    std::string text = dice.one_in(4) ? "\xef\xbb\xbf" : "";
    if (dice.one_in(2)) text += word("solid none") + end + word("endsolid none") + end;
    text += word("solid") + name + end;
    for (const Triangle& triangle : kTetrahedron) {
        if (dice.one_in(6)) {
            text += word("color") + " 0.5 0.5 1" + end;
            ++colors;
        }
        if (dice.one_in(6)) text += word("endsolid") + name + end + end + word("solid") + end;
        text +=
            word("facet normal ") + dice.any({"0 0 1", "nan nan nan", "-1.#IND 0 0", "0.0 -.5 1e0"}) + end;
        text += word("outer loop") + end;
        for (const glm::dvec3& p : triangle) {
            text += word("vertex") + dice.blank() + dice.number(p.x) + dice.blank() + dice.number(p.y) +
                    dice.blank() + dice.number(p.z) + end;
        }
        text += word("endloop") + end + word("endfacet") + end;
    }
    return text + word("endsolid") + name + (dice.one_in(2) ? end : "");
}

TEST_F(StlReaderTest, ReadsAnyFormOfTheGrammar) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        std::size_t colors = 0;
        expect_tetrahedron(read("a.stl", odd_text(dice, colors)));
        expect_ignored(notes_, "colours", colors);
        EXPECT_EQ(notes_.size(), colors > 0 ? 1u : 0u);
    }
}

TEST_F(StlReaderTest, RecognisesBinaryDataByItsSize) {
    for (const char* header : {"", "solid", "solid x\nfacet normal", "\n", "SOLID", "ply", "facet", "glTF"}) {
        expect_tetrahedron(read("a.stl", binary(header)));
        EXPECT_THAT(notes_, IsEmpty());
    }
    expect_tetrahedron(read("a.stl", binary("solid x\nfacet normal") + "behind"));
    EXPECT_THAT(notes_, ElementsAre("ignored bytes after the last facet: 6"));
}

TEST_F(StlReaderTest, CountsColoursOfFacets) {
    expect_tetrahedron(read("a.stl", binary("COLOR=", 0x8000)));
    EXPECT_THAT(notes_, ElementsAre("ignored attributes of facets, which some programs use for colours: 4"));
}

TEST_F(StlReaderTest, TakesFacetsOfFourCorners) {
    const SurfaceMesh mesh =
        read("a.stl",
             "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
             "vertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    EXPECT_EQ(mesh.faces.size(), 2u);
}

TEST_F(StlReaderTest, RefusesWhatIsCutOffOrEmpty) {
    EXPECT_THAT(refusal_of("a.stl", "solid x\nendsolid x\n"), HasSubstr("has 0 vertices and no faces"));
    EXPECT_THAT(refusal_of("a.stl", "solid x\n"),
                HasSubstr("a.stl:2: endsolid: is missing: the file is cut off here"));
    EXPECT_THAT(refusal_of("a.stl", "solid x\nvertex 0 0 0\n"),
                HasSubstr("a.stl:2: word = vertex: must be 'facet', 'solid' or 'endsolid' here"));
    EXPECT_THAT(refusal_of("a.stl", binary("").substr(0, 200)), HasSubstr("number of facets = 4"));
}

}  // namespace
}  // namespace gelatin
