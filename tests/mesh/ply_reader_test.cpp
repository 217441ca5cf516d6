// PLY as other programs write it.
#include "mesh/surface_file_fixture.h"

namespace gelatin {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PlyReaderTest : public SurfaceFileFixture {};

enum class Form { text, little, big };

/// A value of a PLY type, as text or binary data.
std::string ply_value(const std::string& type, double value, Form form, Dice& dice) {
    if (form == Form::text)
        return dice.blank() +
               (type == "float" || type == "double" ? dice.number(value) : fmt::format("{}", value));
    const bool swapped = form == Form::big;
    if (type == "char" || type == "int8") return bytes_of(static_cast<std::int8_t>(value));
    if (type == "uchar" || type == "uint8") return bytes_of(static_cast<std::uint8_t>(value));
    if (type == "short" || type == "int16") return bytes_of(static_cast<std::int16_t>(value), swapped);
    if (type == "ushort" || type == "uint16") return bytes_of(static_cast<std::uint16_t>(value), swapped);
    if (type == "int" || type == "int32") return bytes_of(static_cast<std::int32_t>(value), swapped);
    if (type == "uint" || type == "uint32") return bytes_of(static_cast<std::uint32_t>(value), swapped);
    if (type == "float" || type == "float32") return bytes_of(static_cast<float>(value), swapped);
    return bytes_of(value, swapped);
}

/// A file with any types, orders and further elements and properties.
class OddPly {
public:
    OddPly(Dice& dice, const StarPrism& prism)
        : dice_(dice), prism_(prism), form_(static_cast<Form>(dice.below(3))) {}

    std::string write() {
        const std::string end = dice_.any({"\n", "\r\n"});
        const std::string real = dice_.any({"float", "double", "float32", "float64"});
        const std::string length = any_type(), index = any_type();
        const bool has_color = dice_.one_in(2), has_list = dice_.one_in(3), faces_first = dice_.one_in(4);
        edges = dice_.one_in(2) ? 3 : 0;

        std::string head = dice_.one_in(6) ? "PLY" : "ply";
        head += end + "format " +
                (form_ == Form::text  ? "ascii"
                 : form_ == Form::big ? "binary_big_endian"
                                      : "binary_little_endian") +
                " 1.0" + end + "comment  element face 7" + end + "obj_info x" + end;
        std::string vertex = fmt::format("element vertex {}{}", prism_.positions.size(), end);
        if (has_color) vertex += "property uchar red" + end;
        for (const char* axis : {"x", "y", "z"}) vertex += "property " + real + " " + axis + end;
        if (has_list) vertex += "property list uchar short near" + end;
        std::string face = fmt::format("element face {}{}property list {} {} {}{}property int flags{}",
                                       prism_.polygons.size(), end, length, index,
                                       dice_.any({"vertex_indices", "vertex_index"}), end, end);
        const std::string edge = fmt::format("element edge {}{}property int vertex1{}property int vertex2{}",
                                             edges, end, end, end);
        std::string vertex_rows, face_rows, edge_rows;
        for (const glm::dvec3& p : prism_.positions) {
            if (has_color) add(vertex_rows, "uchar", 10);
            for (int k = 0; k < 3; ++k) add(vertex_rows, real, p[k]);
            if (has_list) {
                add(vertex_rows, "uchar", 2);
                for (int k = 0; k < 2; ++k) add(vertex_rows, "short", -5);
            }
            end_row(vertex_rows, end);
        }
        for (const auto& polygon : prism_.polygons) {
            add(face_rows, length, static_cast<double>(polygon.size()));
            for (const std::uint32_t v : polygon) add(face_rows, index, v);
            add(face_rows, "int", 10);
            end_row(face_rows, end);
        }
        for (std::size_t k = 0; k < edges; ++k) {
            add(edge_rows, "int", 0);
            add(edge_rows, "int", 10);
            end_row(edge_rows, end);
        }
        colors = has_color || has_list ? prism_.positions.size() : 0;
        return faces_first
                   ? head + face + edge + vertex + "end_header" + end + face_rows + edge_rows + vertex_rows
                   : head + edge + vertex + face + "end_header" + end + edge_rows + vertex_rows + face_rows;
    }

    std::size_t edges = 0, colors = 0;

private:
    std::string any_type() {
        return dice_.any(
            {"char", "uchar", "short", "ushort", "int", "uint", "float", "double", "int8", "uint32"});
    }
    void add(std::string& rows, const std::string& type, double value) {
        rows += ply_value(type, value, form_, dice_);
    }
    void end_row(std::string& rows, const std::string& end) const {
        if (form_ == Form::text) rows += end;
    }

    Dice& dice_;
    const StarPrism& prism_;
    Form form_;
};

TEST_F(PlyReaderTest, ReadsAnyFormOfTheGrammar) {
    for (unsigned seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const StarPrism prism(dice);
        OddPly ply(dice, prism);
        prism.expect(read("a.ply", ply.write()));
        expect_ignored(notes_, "elements 'edge'", ply.edges);
        EXPECT_THAT(notes_, Contains(fmt::format("ignored properties of element 'face' (flags): {}",
                                                 prism.polygons.size())));
        EXPECT_EQ(std::count_if(notes_.begin(), notes_.end(),
                                [](const std::string& note) {
                                    return note.find("properties of element 'vertex'") != std::string::npos;
                                }),
                  ply.colors > 0 ? 1 : 0);
    }
}

std::string header(const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}
const std::string kVertex = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

TEST_F(PlyReaderTest, ReadsDataThatBeginsWithAnyByte) {
    const std::string head =
        header("binary_little_endian",
               "element vertex 4\nproperty uchar material\nproperty float x\nproperty float y\n"
               "property float z\nelement face 4\nproperty list uchar uchar vertex_index\n");
    for (int first = 0; first < 256; ++first) {
        std::string data;
        for (const glm::vec3& p : {glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
            data += static_cast<char>(first) + bytes_of(p);
        expect_tetrahedron(read("a.ply", head + data + std::string("\3\0\2\1\3\0\1\3\3\0\3\2\3\1\2\3", 16)));
    }
}

TEST_F(PlyReaderTest, MakesTrianglesOfStrips) {
    const std::string strips = kVertex + "element tristrips 1\nproperty list int int vertex_indices\n";
    expect_tetrahedron(read("a.ply", header("ascii", strips) + kPoints + "6 0 1 2 3 0 1\n"));
    // Strips end with -1; corners that repeat make no triangle, but turn the orientation.
    expect_tetrahedron(
        read("a.ply", header("ascii", strips) + kPoints + "16 2 1 0 -1 0 1 3 3 3 1 2 -1 -1 2 0 3\n"));
    EXPECT_THAT(notes_, IsEmpty()) << "all are wound outwards";
    EXPECT_THAT(refusal_of("a.ply", header("ascii", strips) + kPoints + "3 0 1 4\n"), HasSubstr("below 4"));
}

TEST_F(PlyReaderTest, ReadsRowsOverSeveralLines) {
    const std::string head =
        header("ascii", kVertex + "element face 4\nproperty list uchar int vertex_indices\n");
    expect_tetrahedron(read("a.ply", head + kPoints + "3 0 2\n1\n3\n0 1 3\n\n3 0 3 2\n3 1 2 3\n"));
    EXPECT_THAT(notes_, IsEmpty());
    expect_tetrahedron(read("a.ply", head + kPoints + "3 0 2 1 9\n3 0 1 3\n3 0 3 2\n3 1 2 3 7 7\nend\n"));
    EXPECT_THAT(notes_, ElementsAre("ignored rows' values beyond those of the header: 2",
                                    "ignored lines after the last element: 1"));
}

TEST_F(PlyReaderTest, TakesOldMacintoshLineEnds) {
    std::string text = header("ascii", kVertex + "element face 4\nproperty list uchar int vertex_indices\n") +
                       kPoints + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    std::replace(text.begin(), text.end(), '\n', '\r');
    expect_tetrahedron(read("a.ply", text));
}

TEST_F(PlyReaderTest, SaysWhatAFileWithoutFacesHas) {
    EXPECT_THAT(refusal_of("a.ply", header("ascii", kVertex) + kPoints),
                HasSubstr("has 4 vertices and no faces"));
    EXPECT_THAT(
        refusal_of(
            "a.ply",
            header("ascii", kVertex + "element range_grid 1\nproperty list uchar int vertex_indices\n") +
                kPoints + "1 2\n"),
        HasSubstr("has 4 vertices and no faces; ignored elements 'range_grid': 1"));
}

TEST_F(PlyReaderTest, RefusesListsOfNonsense) {
    const auto with = [&](const std::string& types, const std::string& row) {
        return refusal_of(
            "a.ply", header("ascii", kVertex + "element face 1\nproperty list " + types + " vertex_index\n") +
                         kPoints + row);
    };
    EXPECT_THAT(with("float int", "2.5 0 1 2\n"),
                HasSubstr("a.ply:14: length of list 1 = 2.5: must be a whole number"));
    EXPECT_THAT(with("char int", "-1 0 1 2\n"), HasSubstr("must be a whole number"));
    EXPECT_THAT(with("uint int", "4000000000 0 1 2\n"), HasSubstr("the file is too short for so many"));
    EXPECT_THAT(with("uchar float", "3 0 1 0.5\n"),
                HasSubstr("face 1 = 0.5: vertex indices must be below 4"));
    EXPECT_THAT(refusal_of("a.ply", "ply\nelement vertex 1\nproperty float x\nend_header\n"),
                HasSubstr("a.ply:4: format: is missing"));
    EXPECT_THAT(refusal_of("a.ply", header("ascii", "element vertex 1\nproperty float x\n")),
                HasSubstr("must have the properties x, y and z"));
    EXPECT_THAT(refusal_of("a.ply", header("ascii", kVertex + "propert float w\n")),
                HasSubstr("keyword = propert"));
}

}  // namespace
}  // namespace gelatin
