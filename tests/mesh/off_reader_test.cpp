// OFF as other programs write it.
#include "mesh/surface_file_fixture.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class OffReaderTest : public SurfaceFileFixture {};

const std::string kRows = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// With comments and blank lines anywhere, colours, faces over several lines, any header.
std::string odd_off(Dice& dice, const StarPrism& prism, std::size_t& vertex_colors,
                    std::size_t& face_colors) {
    const std::string end = dice.any({"\n", "\r\n", "\r"});
    const auto line_end = [&] {
        return (dice.one_in(6) ? dice.any({" # 1 2 3", "\t# x"}) : "") + end +
               (dice.one_in(8) ? dice.any({"# 4 5 6", "   ", ""}) + end : "");
    };
    const std::string kind = dice.any({"OFF", "COFF", "NOFF", "off", "STOFF", "CNOFF", ""});
    std::string text = dice.one_in(4) ? "\xef\xbb\xbf" : "";
    if (!kind.empty()) text += kind + (dice.one_in(4) ? " " : dice.one_in(8) ? "" : line_end());
    text += fmt::format("{}{}{}{}{}", prism.positions.size(), dice.blank(), prism.polygons.size(),
                        dice.any({" 0", "\t17", ""}), line_end());
    for (const glm::dvec3& p : prism.positions) {
        text += dice.indentation() + dice.number(p.x) + dice.blank() + dice.number(p.y) + dice.blank() +
                dice.number(p.z);
        if (kind.find('N') != std::string::npos) text += " 0 0 1";
        if (kind.find("ST") != std::string::npos) text += " 0.5 0.5";
        if (kind.find('C') != std::string::npos) {
            text += " 255 0 0 255";
            ++vertex_colors;
        }
        text += line_end();
    }
    for (const auto& polygon : prism.polygons) {
        text += dice.indentation() + std::to_string(polygon.size());
        for (const std::uint32_t v : polygon)
            text += (dice.one_in(12) ? end : dice.blank()) + std::to_string(v);
        if (dice.one_in(3)) {
            text += dice.any({" 3", " 1 0 0", " 0.5 0.5 .5 1"});
            ++face_colors;
        }
        text += line_end();
    }
    return text;
}

TEST_F(OffReaderTest, ReadsAnyFormOfTheGrammar) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const StarPrism prism(dice);
        std::size_t vertex_colors = 0, face_colors = 0;
        prism.expect(read("a.off", odd_off(dice, prism, vertex_colors, face_colors)));
        expect_ignored(notes_, "colours of vertices", vertex_colors);
        expect_ignored(notes_, "colours of faces", face_colors);
    }
}

TEST_F(OffReaderTest, ReadsHeadersOfOtherForms) {
    for (const char* header :
         {"OFF4 4 0\n", "OFF 4 4 6\n", "OFF\n4 4\n", "4 4 0\n", "OFF\n4\n4\n0\n", "OFF 4\n4 0\n"}) {
        expect_tetrahedron(read("a.off", header + kRows));
        EXPECT_THAT(notes_, IsEmpty()) << header;
    }
}

TEST_F(OffReaderTest, CountsWhatItIgnores) {
    std::string rows = kRows;
    rows.replace(rows.find("1 0 0"), 5, "1 0 0 7 7");
    expect_tetrahedron(read("a.off", "OFF\n4 6 0\n" + rows + "2 0 1\n0\nmore\n3 0 1 2\n"));
    EXPECT_THAT(notes_, ElementsAre("ignored values after the coordinates of vertices: 1",
                                    "ignored lines after the last face: 2",
                                    "ignored faces of fewer than three different corners: 2"));
}

TEST_F(OffReaderTest, RefusesOtherDimensionsAndBinaryData) {
    for (const char* kind : {"4OFF", "nOFF", "4nOFF", "OFFX", "NOOFF"})
        EXPECT_THAT(refusal_of("a.off", kind + std::string("\n4 4 0\n") + kRows),
                    HasSubstr("must be OFF, COFF"));
    EXPECT_THAT(refusal_of("a.off", "OFF BINARY\n"), HasSubstr("only OFF files in text are read"));
    EXPECT_THAT(refusal_of("a.off", "OFF\n4 4 0\n" + kRows.substr(0, kRows.size() - 8)),
                HasSubstr("corners of face 4: is missing: the file is cut off here"));
}

}  // namespace
}  // namespace gelatin
