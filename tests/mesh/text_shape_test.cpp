#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/shapes.h"
#include "mesh/surface_repair.h"
#include "mesh/text_outline.h"

namespace gelatin {
namespace {

using testing::HasSubstr;

TextShape text_of(const std::string& text) {
    TextShape shape;
    shape.text = text;
    return shape;
}

// V - E + F; fails unless each edge has two faces of consistent winding.
long euler_characteristic(const SurfaceMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges;
    for (const glm::uvec3& face : mesh.faces) {
        for (int k = 0; k < 3; ++k) ++directed_edges[{face[k], face[(k + 1) % 3]}];
    }
    for (const auto& [edge, count] : directed_edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(directed_edges.count({edge.second, edge.first}), 1u);
    }
    return static_cast<long>(mesh.positions.size() + mesh.faces.size()) -
           static_cast<long>(directed_edges.size() / 2);
}

// Twice the area over the square of the longest side, of the worst face.
double worst_face(const SurfaceMesh& mesh) {
    double worst = 1.0;
    for (const glm::uvec3& face : mesh.faces) {
        const glm::dvec3 a = mesh.positions[face[0]], b = mesh.positions[face[1]],
                         c = mesh.positions[face[2]];
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        worst = std::min(worst, glm::length(glm::cross(b - a, c - a)) / (longest * longest));
    }
    return worst;
}

std::string message_of(const TextShape& shape) {
    try {
        make_text(shape);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

// Each piece adds 2, each hole through it takes 2 away.
TEST(TextShape, EveryLetterAndDigitIsClosedOutwardAndKeepsItsHoles) {
    const std::string with_one_hole = "ADOPQRabdegopq4690", with_two_holes = "B8", with_two_pieces = "ij";
    for (char letter = '!'; letter <= '~'; ++letter) {
        SCOPED_TRACE(letter);
        const SurfaceMesh mesh = make_text(text_of({letter}));
        const long characteristic = euler_characteristic(mesh);
        EXPECT_GT(signed_volume(mesh), 0.0);
        EXPECT_GT(worst_face(mesh), 1e-3);
        if (!std::isalnum(static_cast<unsigned char>(letter))) continue;
        const long pieces = with_two_pieces.find(letter) != std::string::npos ? 2 : 1;
        const long holes = with_one_hole.find(letter) != std::string::npos    ? 1
                           : with_two_holes.find(letter) != std::string::npos ? 2
                                                                              : 0;
        EXPECT_EQ(characteristic, 2 * (pieces - holes));
    }
    EXPECT_EQ(euler_characteristic(make_text(text_of("%"))), 2 * (3 - 2));
    EXPECT_EQ(euler_characteristic(make_text(text_of("@"))), 2 * (1 - 1));
}

TEST(TextShape, HasItsSizeAndDepthAroundTheOrigin) {
    TextShape shape = text_of("H");
    shape.size = 2.0;
    shape.depth = 0.3;
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& p : make_text(shape).positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    EXPECT_NEAR(glm::length(low + high), 0.0, 1e-12);
    EXPECT_NEAR(high.z - low.z, 0.3, 1e-15);
    // Capitals of DejaVu Sans are 1493 of 2048 units high.
    EXPECT_NEAR(high.y - low.y, 2.0 * 1493.0 / 2048.0, 1e-12);
}

TEST(TextShape, LettersStandSideBySideAndLinesBelowEachOther) {
    const double one = signed_volume(make_text(text_of("H")));
    const SurfaceMesh word = make_text(text_of("H H"));
    EXPECT_NEAR(signed_volume(word), 2.0 * one, 1e-12);
    EXPECT_EQ(euler_characteristic(word), 4);
    const SurfaceMesh lines = make_text(text_of("H\nH"));
    EXPECT_NEAR(signed_volume(lines), 2.0 * one, 1e-12);
    const auto is_lower = [](const glm::dvec3& a, const glm::dvec3& b) { return a.y < b.y; };
    const auto [low, high] = std::minmax_element(lines.positions.begin(), lines.positions.end(), is_lower);
    EXPECT_GT(high->y - low->y, 1.5);
}

TEST(TextShape, OutlinesHaveNoShortEdges) {
    for (char letter = '!'; letter <= '~'; ++letter) {
        for (const Contour& contour : outline_text({letter}, "DejaVu Sans:bold")) {
            ASSERT_GE(contour.size(), 3u);
            for (std::size_t k = 0; k < contour.size(); ++k) {
                EXPECT_GE(glm::distance(contour[k], contour[(k + 1) % contour.size()]), 1e-3) << letter;
            }
        }
    }
}

TEST(TextShape, TakesLettersBeyondAscii) {
    EXPECT_EQ(euler_characteristic(make_text(text_of("\u00e9"))), 2 * (2 - 1));    // e with acute
    EXPECT_EQ(euler_characteristic(make_text(text_of("\u03a9"))), 2);              // Omega
    EXPECT_EQ(euler_characteristic(make_text(text_of("A\u00a0A"))), 2 * (2 - 2));  // no-break space
}

TEST(TextShape, NamesAFontThatIsNotInstalled) {
    TextShape shape = text_of("A");
    shape.font = "No Such Font:bold";
    EXPECT_THAT(message_of(shape), HasSubstr("No Such Font:bold"));
    EXPECT_THAT(message_of(shape), HasSubstr("not installed"));
    shape.font = "/no/such/font.ttf";
    EXPECT_THAT(message_of(shape), HasSubstr("no such font file"));
}

TEST(TextShape, RefusesAFileThatIsNoFont) {
    const TemporaryFolder folder;
    write_file(folder.path() / "letter.ttf", "this is no font");
    TextShape shape = text_of("A");
    shape.font = (folder.path() / "letter.ttf").string();
    EXPECT_THAT(message_of(shape), HasSubstr("letter.ttf"));
    EXPECT_THAT(message_of(shape), HasSubstr("cannot read this as a font"));
}

TEST(TextShape, RefusesTextWithNothingToSee) {
    for (const char* text : {"", "   ", "\n"})
        EXPECT_THAT(message_of(text_of(text)), HasSubstr("no visible letter"));
}

TEST(TextShape, NamesALetterThatTheFontDoesNotHave) {
    EXPECT_THAT(message_of(text_of("A\U0001f9ff")), HasSubstr("U+1F9FF"));
}

TEST(TextShape, RefusesBytesThatAreNotUtf8) {
    // A lone continuation, a cut-off sequence, an overlong '/', a surrogate, beyond the last code point.
    for (const char* text : {"A\x80", "A\xc3", "A\xc0\xaf", "A\xed\xa0\x80", "A\xf4\x90\x80\x80", "A\xff"}) {
        EXPECT_THAT(message_of(text_of(text)), HasSubstr("byte 2 is not UTF-8"));
    }
}

}  // namespace
}  // namespace gelatin
