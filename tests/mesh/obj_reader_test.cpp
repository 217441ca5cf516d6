// OBJ as other programs write it.
#include "mesh/surface_file_fixture.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string kFaces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class ObjReaderTest : public SurfaceFileFixture {};

/// Writes a surface in one of the many forms that OBJ allows.
class OddObj {
public:
    OddObj(Dice& dice, const StarPrism& prism)
        : dice_(dice), prism_(prism), end_(dice.any({"\n", "\r\n", "\r"})) {}

    std::string write() {
        std::string text = dice_.one_in(4) ? "\xef\xbb\xbf" : "";
        text += "# a prism" + end_ + "mtllib" + end_;
        const bool has_uvs = dice_.one_in(2), has_normals = dice_.one_in(2);
        for (std::size_t v = 0; v < prism_.positions.size(); ++v) {
            const glm::dvec3& p = prism_.positions[v];
            std::string extra;
            if (dice_.one_in(6)) extra = dice_.blank() + "1.0";
            if (dice_.one_in(6)) {
                extra = " 0.5 .25 1";
                ++colors;
            }
            text += statement("v", gap() + dice_.number(p.x) + gap() + dice_.number(p.y) + gap() +
                                       dice_.number(p.z) + extra);
            if (has_uvs) text += statement("vt", " 0.5 1." + std::string(dice_.one_in(2) ? " 0" : ""));
            if (has_normals) text += statement("vn", " 0 0 1");
            other_statement(text);
        }
        for (const auto& polygon : prism_.polygons) {
            std::string arguments;
            const bool is_negative = dice_.one_in(3);
            for (const std::uint32_t v : polygon) {
                const std::string number = index(v, is_negative);
                arguments += gap() + number;
                if (has_uvs) arguments += "/" + number;
                if (has_normals) arguments += (has_uvs ? "/" : "//") + number;
            }
            text += statement("f", arguments);
            other_statement(text);
        }
        return text;
    }

    std::size_t points = 0, lines = 0, colors = 0, curves = 0;

private:
    std::string gap() { return dice_.one_in(15) && end_ != "\r" ? " \\" + end_ + "  " : dice_.blank(); }
    std::string index(std::uint32_t v, bool is_negative) const {
        if (!is_negative) return std::to_string(v + 1);
        return "-" + std::to_string(prism_.positions.size() - v);
    }
    std::string statement(std::string keyword, const std::string& arguments) {
        if (dice_.one_in(8)) keyword[0] = static_cast<char>(keyword[0] - 'a' + 'A');
        const std::string comment = dice_.one_in(6) ? dice_.any({" # why \\", "# f 1 2 3", "\t#"}) : "";
        return dice_.indentation() + keyword + arguments + comment + (dice_.one_in(4) ? " " : "") + end_;
    }
    void other_statement(std::string& text) {
        switch (dice_.below(24)) {
            case 0:
                text += end_ + "   " + end_;
                break;
            case 1:
                text += "   # v 9 9 9" + end_;
                break;
            case 2:
                text += "g one two # f" + end_ + "s off" + end_ + "o a#b" + end_;
                break;
            case 3:
                text += "usemtl some stone#2" + end_;
                break;
            case 4:
                text += "l 1 2 1" + end_;
                ++lines;
                break;
            case 5:
                text += "p 1 -1" + end_;
                points += 2;
                break;
            case 6:
                text += "curv 0 1 1 2" + (end_ == "\r" ? end_ : " \\" + end_ + "f 3 4" + end_);
                ++curves;
                break;
            default:
                break;
        }
    }

    Dice& dice_;
    const StarPrism& prism_;
    std::string end_;
};

TEST_F(ObjReaderTest, ReadsAnyFormOfTheGrammar) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const StarPrism prism(dice);
        OddObj obj(dice, prism);
        prism.expect(read("a.obj", obj.write()));
        expect_ignored(notes_, "points", obj.points);
        expect_ignored(notes_, "lines", obj.lines);
        expect_ignored(notes_, "colours of vertices", obj.colors);
        expect_ignored(notes_, "statements 'curv'", obj.curves);
    }
}

TEST_F(ObjReaderTest, ReadsFacesThatComeBeforeTheirVertices) {
    expect_tetrahedron(read("a.obj", kFaces + kVertices));
    EXPECT_THAT(refusal_of("a.obj", "f 1 2 3\n" + kVertices + "f 1 5 2\nf 1 2 9\nf 1 2 3\n"),
                HasSubstr("a.obj:7: face = 9: must name a vertex by its number from 1 to 4"));
}

TEST_F(ObjReaderTest, LeavesOutTextureCoordinatesThatAreNotThere) {
    const SurfaceMesh mesh =
        read("a.obj", kVertices + "vt 0.5 1\nf 1/1 3/7 2/-4\nf 1/ 2 4//\nf 1 4 3\nf 2 3 4\n");
    expect_tetrahedron(mesh);
    EXPECT_EQ(mesh.look.corner_uvs.at(0)[0], glm::vec2(0.5f, 1.0f));
    EXPECT_EQ(mesh.look.corner_uvs.at(0)[1], glm::vec2(0.0f));
    EXPECT_THAT(notes_, ElementsAre("ignored texture coordinates that faces name and that are not there: 2"));
}

TEST_F(ObjReaderTest, CountsWhatItIgnores) {
    expect_tetrahedron(
        read("a.obj", kVertices + kFaces + "f 1 2\nf 1 1 1 2\nsurf 0 1 0 1 1 2 \\\n 3 4\nvp 1\nvp 2\n"));
    EXPECT_THAT(notes_, ElementsAre("ignored statements 'surf': 1", "ignored statements 'vp': 2",
                                    "ignored faces of fewer than three different corners: 2"));
    // A file of nonsense has any number of keywords.
    std::string nonsense = kVertices + kFaces;
    for (int k = 0; k < 100; ++k) nonsense += "x" + std::to_string(k) + "\n";
    read("a.obj", nonsense);
    EXPECT_EQ(notes_.size(), 21u);
    EXPECT_EQ(notes_.back(), "ignored others: 80");
}

TEST_F(ObjReaderTest, KeepsAllDigits) {
    const SurfaceMesh mesh = read("a.obj", "v 0.1 0 0\nv 1.10000000000001 0 0\nv 0 1 0\nv 0 0 1\n" + kFaces);
    EXPECT_EQ(mesh.positions[1].x, 1.10000000000001);
    EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(ObjReaderTest, RefusesWhatIsNoNumber) {
    for (const char* value : {"0,5", "1d3", "--1", "+-1", "1.0f", "x", "0x10"}) {
        EXPECT_THAT(refusal_of("a.obj", "v 0 0 " + std::string(value) + "\n" + kFaces),
                    HasSubstr("a.obj:1: vertex 1 = " + std::string(value) + ": must be a number"));
    }
}

TEST_F(ObjReaderTest, SaysWhatAFileWithoutFacesHas) {
    EXPECT_THAT(refusal_of("a.obj", kVertices), HasSubstr("a.obj: has 4 vertices and no faces"));
    EXPECT_THAT(refusal_of("a.obj", kVertices + "l 1 2\nl 2 3\np 1\n"),
                HasSubstr("has 4 vertices and no faces; ignored lines: 2; ignored points: 1"));
}

}  // namespace
}  // namespace gelatin
