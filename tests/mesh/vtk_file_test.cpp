// VTK's two formats of tets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/topology.h"
#include "vtk_samples.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class VtkFileTest : public TetFileTest {
protected:
    void expect_pair(const TetMesh& mesh) {
        EXPECT_EQ(mesh.positions, kPair.positions);
        EXPECT_EQ(mesh.tets, kPair.tets);
        EXPECT_EQ(mesh.faces, boundary_faces(kPair.tets));
        EXPECT_THAT(mesh.attributes, ElementsAre(3, -5));
        EXPECT_THAT(notes_, ElementsAre("ignored points, lines and surfaces: 1"));
    }
    std::string vtu(const VtuChoice& choice = {}) { return VtuSample(choice).text(); }
};

TEST_F(VtkFileTest, ReadsLegacyText) {
    expect_pair(read("a.vtk", kVtkText));
    expect_pair(read("a.vtk", kVtk5Text));
    expect_pair(read("a.VTK", replaced(kVtkText, "DATASET UNSTRUCTURED_GRID", "dataset Unstructured_Grid")));
}

TEST_F(VtkFileTest, ReadsLegacyBytes) {
    for (const bool is_version_5 : {false, true}) expect_pair(read("a.vtk", vtk_binary(is_version_5)));
}

TEST_F(VtkFileTest, ReadsEveryCodingOfVtu) {
    for (const VtuChoice& choice : vtu_choices()) {
        SCOPED_TRACE(describe(choice));
        expect_pair(read("a.vtu", vtu(choice)));
    }
}

TEST_F(VtkFileTest, ReadsLinesOfWindows) {
    std::string text = replaced(vtu(), " 0 1 2 0 1 2 3 0 2 1 4", "\n0\n1\n2\n0\n1\n2\n3\n0\n2\n1\n4");
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    expect_pair(read("a.vtu", text));
}

TEST_F(VtkFileTest, ReadsWhatItWrites) {
    TetMesh mesh = kPair;
    mesh.attributes = {3, -5};
    write_tets(path("b.vtu"), mesh);
    const TetMesh again = read_tets(path("b.vtu"), notes_);
    EXPECT_EQ(again.positions, mesh.positions);
    EXPECT_EQ(again.tets, mesh.tets);
    EXPECT_EQ(again.attributes, mesh.attributes);
    EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(VtkFileTest, JoinsPieces) {
    const std::string whole = vtu();
    const std::size_t begin = whole.find("<Piece"), end = whole.find("</UnstructuredGrid>");
    std::string second = whole.substr(begin, end - begin);
    second = replaced(second, "-0.3333333333333333", "-2");
    second = replaced(second, "0 0 0 1 0 0", "0 0 -1 1 0 -1");  // the second pair lies below the first
    second = replaced(second, " 0 1 0 0 0 1", " 0 1 -1 0 0 -0.5");
    std::string both = whole;
    both.insert(end, second);
    const TetMesh mesh = read("a.vtu", both);
    EXPECT_EQ(mesh.tets.size(), 4u);
    EXPECT_EQ(mesh.positions.size(), 10u);
    EXPECT_THAT(mesh.attributes, ElementsAre(3, -5, 3, -5));
}

TEST_F(VtkFileTest, KeepsTheCornersOfCurvedTets) {
    for (const char* type : {"24", "71", "79"}) {
        std::string text = replaced(kVtkText, "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n",
                                    "CELLS 3 20\n3 0 1 2\n10 0 1 2 3 0 0 0 0 0 0\n");
        const TetMesh mesh = read("a.vtk", replaced(text, "5 10 10", std::string("5 ") + type + " 10"));
        EXPECT_EQ(mesh.tets, kPair.tets);
        EXPECT_THAT(notes_, ElementsAre("ignored points, lines and surfaces: 1",
                                        "kept the corners only of cells with more nodes: 1"));
    }
}

TEST_F(VtkFileTest, ChoosesTheAttributeByItsName) {
    const auto attributes_of = [&](const std::string& name, const std::string& type) {
        const std::string text = replaced(kVtkText, "material 1 3 int", name + " 1 3 " + type);
        return read("a.vtk", text).attributes;
    };
    for (const char* name : {"attribute", "Material", "material_id", "MaterialIds", "region", "RegionId",
                             "medit:ref", "gmsh:physical", "CellEntityIds", "object"})
        EXPECT_THAT(attributes_of(name, "int"), ElementsAre(3, -5)) << name;
    EXPECT_THAT(attributes_of("colour", "int"), IsEmpty());
    EXPECT_THAT(attributes_of("material", "float"), IsEmpty());
    // Of two the one with the more exact name, wherever it stands.
    const std::string object = "object 1 3 int\n1 2 3\n";
    const std::string three = replaced(kVtkText, "FieldData 2\n", "FieldData 3\n");
    EXPECT_THAT(read("a.vtk", three + object).attributes, ElementsAre(3, -5));
    EXPECT_THAT(read("a.vtk", replaced(three, "FieldData 3\n", "FieldData 3\n" + object)).attributes,
                ElementsAre(3, -5));
    const std::string xml = vtu();
    const std::string array =
        "<DataArray type=\"Int32\" Name=\"object\" format=\"ascii\">1 2 3</DataArray></CellData>";
    EXPECT_THAT(read("a.vtu", replaced(xml, "</CellData>", array)).attributes, ElementsAre(3, -5));
    EXPECT_THAT(
        read("a.vtu", replaced(replaced(xml, "</CellData>", array), "\"material\"", "\"x\"")).attributes,
        ElementsAre(2, 3));
}

// The grid is complete without them.
TEST_F(VtkFileTest, IgnoresDataThatItDoesNotKnow) {
    const TetMesh mesh = read("a.vtk", replaced(kVtkText, "stress 2 3 double", "stress 2 3 string"));
    EXPECT_EQ(mesh.tets, kPair.tets);
    EXPECT_THAT(notes_, ElementsAre("ignored the data from 'string' on, which Gelatin does not know",
                                    "ignored points, lines and surfaces: 1"));
}

TEST_F(VtkFileTest, RefusesOtherKindsOfFiles) {
    EXPECT_EQ(refusal_of("a.vtk", replaced(kVtkText, "UNSTRUCTURED_GRID", "POLYDATA")),
              path("a.vtk").string() + ":4: DATASET = polydata: must be UNSTRUCTURED_GRID");
    EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "Version 3.0", "Version 7.0")),
                HasSubstr("a.vtk:1: version = 7.0: must be from 1.0 to 5.1"));
    EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "ASCII", "EBCDIC")),
                HasSubstr("a.vtk:3: coding = ebcdic: must be ASCII or BINARY"));
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), "type=\"UnstructuredGrid\"", "type=\"PolyData\"")),
                HasSubstr("a.vtu:2: type = PolyData: must be UnstructuredGrid"));
    EXPECT_THAT(refusal_of("a.vtu", "<a/>"), HasSubstr("VTKFile: is missing"));
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), "<Cells>", "<Cells")), HasSubstr("is not valid XML"));
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu({VtuChoice::Format::inline_base64, true}), "ZLib", "LZ4")),
                HasSubstr("compressor = vtkLZ4DataCompressor: must be vtkZLibDataCompressor"));
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), "LittleEndian", "MiddleEndian")),
                HasSubstr("byte_order = MiddleEndian"));
}

TEST_F(VtkFileTest, RefusesIndicesOutOfRange) {
    for (const char* index : {"5", "-1", "4294967296"}) {
        const std::string bad = std::string("4 0 2 1 ") + index;
        EXPECT_THAT(
            refusal_of("a.vtk", replaced(kVtkText, "4 0 2 1 4", bad)),
            HasSubstr(std::string("a.vtk: cell 3 = ") + index + ": there is no point of this number"));
        EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), "0 2 1 4", std::string("0 2 1 ") + index)),
                    HasSubstr(std::string("a.vtu:10: cell 3 = ") + index));
    }
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), " 3 7 11", " 3 12 11")),
                HasSubstr("end of cell 2 = 12: must be from 3 to 11"));
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), " 3 7 11", " 3 2 11")), HasSubstr("end of cell 2 = 2"));
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), " 3 7 11", " 3 6 11")),
                HasSubstr("cell 2 = 3 points: tets must have 4"));
    EXPECT_THAT(refusal_of("a.vtk", replaced(kVtk5Text, "0 3 7 11", "1 3 7 11")), HasSubstr("offset 1 = 1"));
    EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "4 0 2 1 4", "5 0 2 1 4")),
                HasSubstr("cell 3 = 5 points: CELLS has only 14 numbers"));
    EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "4 0 2 1 4", "3 0 2 1 4")),
                HasSubstr("size of cells = 14: but 3 cells have 13 numbers"));
}

TEST_F(VtkFileTest, RefusesCountsThatMakeNoSense) {
    for (const char* count : {"4000000000", "1000000000000", "18446744073709551615"}) {
        const std::string text(count);
        EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "POINTS 5", "POINTS " + text)),
                    HasSubstr("a.vtk:5: number of points = " + text));
        EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "CELLS 3 14", "CELLS 3 " + text)),
                    HasSubstr("a.vtk"));
        EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "CELL_TYPES 3", "CELL_TYPES " + text)),
                    HasSubstr("cell types = " + text));
        EXPECT_THAT(refusal_of("a.vtk", replaced(kVtk5Text, "CELLS 4", "CELLS " + text)), HasSubstr("a.vtk"));
        EXPECT_THAT(refusal_of("a.vtk", replaced(vtk_binary(true), "CELLS 4 11", "CELLS 4 " + text)),
                    HasSubstr("a.vtk: "));
        EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "CELL_DATA 3", "CELL_DATA " + text)),
                    HasSubstr("CELL_DATA = " + text + ": must be the number of cells, 3"));
        EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), "NumberOfPoints=\"5", "NumberOfPoints=\"" + text)),
                    HasSubstr("a.vtu:"));
        EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), "NumberOfCells=\"3", "NumberOfCells=\"" + text)),
                    HasSubstr("a.vtu:"));
    }
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), "NumberOfPoints=\"5", "NumberOfPoints=\"-5")),
                HasSubstr("a.vtu:4: NumberOfPoints = -5: must be a whole number"));
}

TEST_F(VtkFileTest, NamesTheLineOfANumberThatIsWrong) {
    for (const char* bad : {"nan", "1e999", "x"}) {
        const std::string points = std::string("0 0 ") + bad + "\n";
        EXPECT_THAT(refusal_of("a.vtk", replaced(kVtkText, "0 0 1\n", points)),
                    HasSubstr("a.vtk:9: point 4 = "));
    }
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), "0.1 0.2", "0.1 inf")),
                HasSubstr("a.vtu:7: point 5 = inf"));
    EXPECT_THAT(refusal_of("a.vtu", replaced(vtu(), " 5 10 10", " 5 10 1.5")),
                HasSubstr("a.vtu:18: types 3 = 1.5: must be a whole number"));
}

TEST_F(VtkFileTest, RefusesDamagedArrays) {
    using Format = VtuChoice::Format;
    const std::string zipped = vtu({Format::inline_base64, true});
    const std::size_t place = zipped.find("connectivity");
    const std::size_t data = zipped.find("\n  ", place) + 3;
    std::string damaged = zipped;
    damaged[data + 60] = damaged[data + 60] == 'A' ? 'B' : 'A';
    EXPECT_THAT(refusal_of("a.vtu", damaged), HasSubstr("DataArray connectivity: has a block"));
    damaged = zipped;
    damaged[data + 2] = '!';
    EXPECT_THAT(refusal_of("a.vtu", damaged), HasSubstr("DataArray connectivity: is not valid base64"));
    const std::string raw = vtu({Format::appended_raw});
    EXPECT_THAT(refusal_of("a.vtu", replaced(raw, "offset=\"0\"", "offset=\"99999\"")),
                HasSubstr("offset of DataArray Points = 99999: the appended data have"));
    EXPECT_THAT(refusal_of("a.vtu", raw.substr(0, raw.find("\n_") + 40)), HasSubstr("is cut off"));
    EXPECT_THAT(refusal_of("a.vtu", replaced(raw, "format=\"appended\"", "format=\"spoken\"")),
                HasSubstr("must be ascii, binary or appended"));
}

// A header that announces a terabyte.
TEST_F(VtkFileTest, DoesNotBelieveHeaders) {
    for (const bool is_compressed : {false, true}) {
        Bytes header(false);
        if (is_compressed)
            header.add(Sizes{1, 1'000'000'000'000, 0, 8});
        else
            header.add(Sizes{1'000'000'000'000});
        header.text("12345678");
        const VtuChoice choice{VtuChoice::Format::appended_raw, is_compressed, true};
        std::string text = vtu(choice);
        text.replace(text.find("\n_") + 2, header.all().size(), header.all());
        EXPECT_THAT(refusal_of("a.vtu", text), HasSubstr("DataArray Points: "));
    }
}

}  // namespace
}  // namespace gelatin
