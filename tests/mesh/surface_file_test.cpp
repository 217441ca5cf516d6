#include "mesh/surface_file.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "mesh/surface_file_fixture.h"
#include "mesh/texture_samples.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kObj =
    "# a tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string kOff = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string kPlyHeader =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPly = kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string text_stl() {
    const auto facet = [](const char* a, const char* b, const char* c) {
        return std::string("facet normal 0 0 0\n outer loop\n  vertex ") + a + "\n  vertex " + b +
               "\n  vertex " + c + "\n endloop\nendfacet\n";
    };
    const char *o = "0 0 0", *x = "1 0 0", *y = "0 1 0", *z = "0 0 1";
    return "solid a name\n" + facet(o, y, x) + facet(o, x, z) + facet(o, z, y) + facet(x, y, z) +
           "endsolid a name\n";
}

class SurfaceFileTest : public SurfaceFileFixture {
protected:
    SurfaceMesh write_and_read(const std::string& name, const SurfaceMesh& mesh) {
        write_surface(folder_.path() / name, mesh);
        notes_.clear();
        return read_surface(folder_.path() / name, notes_);
    }
    // Every beginning of a file is a mesh or is refused; nothing else.
    void try_every_prefix(const std::string& name, const std::string& content) {
        std::size_t refused = 0;
        for (std::size_t size = 0; size <= content.size(); ++size) {
            try {
                const SurfaceMesh mesh = read(name, content.substr(0, size));
                EXPECT_FALSE(mesh.faces.empty());
            } catch (const InvalidInput& error) {
                EXPECT_THAT(error.what(), HasSubstr(name));
                EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
                ++refused;
            }
        }
        EXPECT_GE(refused, content.size() / 2);
    }
};

TEST_F(SurfaceFileTest, ReadsEachFormat) {
    expect_tetrahedron(read("a.obj", kObj));
    EXPECT_THAT(notes_, IsEmpty());
    expect_tetrahedron(read("a.OFF", kOff));
    EXPECT_THAT(notes_, IsEmpty());
    expect_tetrahedron(read("a.ply", kPly));
    EXPECT_THAT(notes_, IsEmpty());
    expect_tetrahedron(read("a.stl", text_stl()));
    EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(SurfaceFileTest, ReadsWhatItWrites) {
    SurfaceMesh mesh = cube({0.25, -3.5, 1e-3}, 0.375);
    append(mesh, cube({2, 2, 2}, 1.0));
    for (const char* name : {"a.obj", "a.stl", "a.ply", "a.off"}) {
        const SurfaceMesh back = write_and_read(name, mesh);
        EXPECT_THAT(notes_, IsEmpty()) << name;
        ASSERT_EQ(back.positions.size(), mesh.positions.size()) << name;
        ASSERT_EQ(back.faces.size(), mesh.faces.size()) << name;
        // STL renumbers vertices and has floats, so faces are compared by the positions of their corners.
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec3 expected = mesh.positions[mesh.faces[f][corner]];
                EXPECT_LT(distance(back.positions[back.faces[f][corner]], expected), 1e-6) << name;
            }
        }
    }
}

TEST_F(SurfaceFileTest, CutsPolygonsIntoTriangles) {
    const std::string quads =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
        "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    const SurfaceMesh mesh = read("a.obj", quads);
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_EQ(mesh.faces.size(), 12u);
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 1.0);
    EXPECT_TRUE(measure_openness(mesh).is_closed());
}

TEST_F(SurfaceFileTest, JoinsTheObjectsOfAFileWhateverElseTheyHave) {
    const std::string obj =
        "mtllib no_such.mtl\no one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 1\nvn 0 0 1\nvn 1 0 0\n"
        "usemtl red\nf 1/1/1 3/2/1 2/1/1\nf 1/1/2 2/2/2 4/1/2\n"
        "o two\nusemtl blue\nf -4//1 -1//1 -2//1\nf 2 3 \\\n 4\nl 1 2\np 3\n";
    expect_tetrahedron(read("a.obj", obj));
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("'no_such.mtl' cannot be read"), "ignored lines: 1",
                                    "ignored points: 1"));
}

TEST_F(SurfaceFileTest, ReadsWhatWindowsWrites) {
    const std::pair<const char*, std::string> samples[] = {
        {"a.obj", kObj.substr(kObj.find('v'))}, {"a.off", kOff}, {"a.ply", kPly}, {"a.stl", text_stl()}};
    for (const auto& [name, content] : samples) {
        std::string windows = "\xef\xbb\xbf";
        for (const char c : content) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
        expect_tetrahedron(read(name, windows));
    }
}

TEST_F(SurfaceFileTest, ReportsRepairs) {
    std::string obj = kObj;
    obj.replace(obj.find("f 2 3 4"), 7,
                "v 0 1 0\nv 9 9 9\nf 2 4 5");  // wound the wrong way, with a vertex of its own
    expect_tetrahedron(read("a.obj", obj));
    EXPECT_THAT(notes_, ElementsAre("merged vertices that coincide: 1", "discarded vertices without faces: 1",
                                    "flipped faces with the wrong orientation: 1"));
}

TEST_F(SurfaceFileTest, KeepsSmallMeshesApart) {
    const SurfaceMesh mesh = write_and_read("a.stl", cube({0, 0, 0}, 1e-6));
    EXPECT_EQ(mesh.positions.size(), 8u);
}

TEST_F(SurfaceFileTest, ReadsCommentsAndBlankLinesInOff) {
    expect_tetrahedron(read("a.off",
                            "OFF # kind\n# counts\n4 4 0\n\n0 0 0 # first\n   \n1 0 0\n# here\n0 1 0\n0 0 1\n"
                            "3 0 2 1 255 0 0\n3 0 1 3\n\n3 0 3 2\n3 1 2 3"));
}

TEST_F(SurfaceFileTest, ReadsPlyOfEitherByteOrder) {
    for (const bool big : {false, true}) {
        std::string ply = kPlyHeader;
        ply.replace(ply.find("ascii"), 5, big ? "binary_big_endian" : "binary_little_endian");
        const auto add = [&](auto value) { ply += bytes_of(value, big); };
        for (const float value : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) add(value);
        for (const std::array<int, 3>& face : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
            ply += '\3';
            for (const int vertex : face) add(vertex);
        }
        expect_tetrahedron(read("a.ply", ply));
        if (big) try_every_prefix("cut.ply", ply);
    }
}

TEST_F(SurfaceFileTest, ReadsBinaryStlThatClaimsToBeText) {
    write_surface(folder_.path() / "a.stl", cube({0, 0, 0}, 1.0));
    std::string stl = read_file(folder_.path() / "a.stl");
    stl.replace(0, 5, "solid");
    EXPECT_EQ(read("a.stl", stl).faces.size(), 12u);
    stl.replace(0, 5, "thing");
    EXPECT_EQ(read("a.stl", stl + "something behind it").faces.size(), 12u);
}

TEST_F(SurfaceFileTest, RefusesFilesThatAreNotThereOrEmpty) {
    const std::string missing = refusal([&] { read_surface("/no/such/mesh.obj", notes_); });
    EXPECT_EQ(missing, "/no/such/mesh.obj: no such file");
    for (const char* name : {"a.obj", "a.stl", "a.ply", "a.off"}) {
        EXPECT_THAT(refusal_of(name, ""), HasSubstr("is empty"));
        EXPECT_THAT(refusal_of(name, "\n\n"), HasSubstr(name));
        EXPECT_THAT(refusal_of(name, std::string(300, '\0')), HasSubstr(name));
    }
}

TEST_F(SurfaceFileTest, RefusesUnknownEndings) {
    EXPECT_THAT(refusal_of("a.fbx", "x"), HasSubstr(".obj, .stl, .ply, .off, .gltf or .glb"));
    EXPECT_THAT(refusal([&] {
                    write_surface(folder_.path() / "a.fbx", cube({0, 0, 0}, 1));
                }),
                HasSubstr(".obj, .stl"));
}

TEST_F(SurfaceFileTest, RefusesFilesWithoutFaces) {
    EXPECT_THAT(refusal_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n"), HasSubstr("no faces"));
    EXPECT_THAT(refusal_of("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
                HasSubstr("no faces with an area"));
}

TEST_F(SurfaceFileTest, NamesTheVertexThatIsNotFinite) {
    for (const char* value : {"nan", "inf", "-inf", "1e999", "1e39", "NaN"}) {
        const auto with = [&](std::string content, const std::string& row) {
            content.replace(content.find(row), row.size(), "0 " + std::string(value) + " 0");
            return content;
        };
        const std::string obj = refusal_of("a.obj", with(kObj, "0 1 0"));
        EXPECT_THAT(obj, HasSubstr("a.obj:4: vertex 3 = "));
        EXPECT_THAT(obj, HasSubstr("finite"));
        EXPECT_THAT(refusal_of("a.off", with(kOff, "0 1 0")), HasSubstr("a.off:5: vertex 3 = "));
        EXPECT_THAT(refusal_of("a.ply", with(kPly, "0 1 0")), HasSubstr("a.ply:13: vertex 3 = "));
        EXPECT_THAT(refusal_of("a.stl", with(text_stl(), "0 1 0")),
                    HasSubstr("a.stl:5: vertex of facet 1 = "));
    }
    SurfaceMesh mesh = cube({0, 0, 0}, 1.0);
    mesh.positions[6].y = std::nan("");
    write_surface(folder_.path() / "a.stl", mesh);
    EXPECT_THAT(refusal([&] { read_surface(folder_.path() / "a.stl", notes_); }),
                HasSubstr("vertex of facet 4 = nan"));
    write_surface(folder_.path() / "a.ply", mesh);
    EXPECT_THAT(refusal([&] { read_surface(folder_.path() / "a.ply", notes_); }),
                HasSubstr("vertex 7 = nan"));
}

// Were the counts believed, these would end in std::bad_alloc or take all memory.
TEST_F(SurfaceFileTest, RefusesCountsThatTheFileIsTooShortFor) {
    for (const char* count : {"1000000000000", "99999999999999999999999", "4000000000", "5"}) {
        const auto claiming = [&](std::string content, const std::string& old) {
            content.replace(content.find(old), old.size(), old.substr(0, old.size() - 1) + count);
            return content;
        };
        EXPECT_THAT(refusal_of("a.ply", claiming(kPly, "vertex 4")), HasSubstr("a.ply"));
        EXPECT_THAT(refusal_of("a.ply", claiming(kPly, "face 4")), HasSubstr("a.ply"));
        EXPECT_THAT(refusal_of("a.off", claiming(kOff, "\n4")), HasSubstr("a.off"));
        EXPECT_THAT(refusal_of("a.off", claiming(kOff, "4 4")), HasSubstr("a.off"));
    }
    EXPECT_THAT(refusal_of("a.off", "OFF\n1000000000000 1000000000000 0\n0 0 0\n"),
                HasSubstr("a.off:2: number of vertices = 1000000000000: the file is too short for so many"));
    std::string ply = kPly;
    ply.replace(ply.find("face 4"), 6, "face 1000000000000");
    EXPECT_THAT(refusal_of("a.ply", ply),
                HasSubstr("number of elements = 1000000000000: the file is too short for"));
    const std::string stl =
        std::string(80, ' ') + bytes_of(std::uint32_t{4'000'000'000}) + std::string(500, '\1');
    EXPECT_THAT(refusal_of("a.stl", stl), HasSubstr("number of facets = 4000000000: the file is too short"));
}

TEST_F(SurfaceFileTest, RefusesIndicesOutOfRange) {
    const auto with = [](std::string content, const std::string& old, const std::string& face) {
        return content.replace(content.find(old), old.size(), face);
    };
    for (const char* face : {"f 2 3 5", "f 2 3 0", "f 2 3 -5", "f 2 3 x", "f 2 3 4000000000"}) {
        EXPECT_THAT(refusal_of("a.obj", with(kObj, "f 2 3 4", face)), HasSubstr("a.obj:9: face = ")) << face;
    }
    EXPECT_THAT(refusal_of("a.off", with(kOff, "3 1 2 3", "3 1 2 4")), HasSubstr("a.off:10: face 4 = 4"));
    EXPECT_THAT(refusal_of("a.off", with(kOff, "3 1 2 3", "3 1 2 -1")), HasSubstr("a.off:10: face 4 = -1"));
    EXPECT_THAT(refusal_of("a.ply", with(kPly, "3 1 2 3", "3 1 2 4")), HasSubstr("a.ply:18: face 4 = 4"));
    EXPECT_THAT(refusal_of("a.ply", with(kPly, "3 1 2 3", "3 1 2 -1")), HasSubstr("a.ply:18: face 4 = -1"));
}

TEST_F(SurfaceFileTest, RefusesIncompleteRows) {
    EXPECT_THAT(refusal_of("a.obj", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("a.obj:1: vertex 1"));
    EXPECT_THAT(refusal_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n"),
                HasSubstr("a.off:4: vertex 2"));
    std::string stl = text_stl();
    stl.replace(stl.find("  vertex 1 0 0\n"), 15, "");
    EXPECT_THAT(refusal_of("a.stl", stl), HasSubstr("must be 'vertex' here"));
}

TEST_F(SurfaceFileTest, TakesEveryPrefixInItsStride) {
    try_every_prefix("a.off", kOff);
    try_every_prefix("a.ply", kPly);
    try_every_prefix("a.stl", text_stl());
    write_surface(folder_.path() / "b.stl", cube({0, 0, 0}, 1.0));
    try_every_prefix("b.stl", read_file(folder_.path() / "b.stl"));
    try_every_prefix("a.obj", kObj);
}

// Each damaged file is a mesh or is refused.
TEST_F(SurfaceFileTest, TakesDamagedBytesInItsStride) {
    write_surface(folder_.path() / "whole.stl", cube({0, 0, 0}, 1.0));
    write_surface(folder_.path() / "whole.ply", cube({0, 0, 0}, 1.0));
    const std::pair<const char*, std::string> samples[] = {
        {"a.obj", kObj},
        {"a.off", kOff},
        {"a.ply", kPly},
        {"a.stl", text_stl()},
        {"b.stl", read_file(folder_.path() / "whole.stl")},
        {"b.ply", read_file(folder_.path() / "whole.ply")},
        {"a.gltf", gltf_sample("data:image/png;base64," + kPngText)}};
    std::mt19937 random(3);
    for (const auto& [name, content] : samples) {
        for (int trial = 0; trial < 60; ++trial) {
            std::string damaged = content;
            for (int k = 0; k < 3; ++k) {
                constexpr std::string_view kBytes("\0\xff\n 9-.#eafx", 12);
                damaged[random() % damaged.size()] = kBytes[random() % kBytes.size()];
            }
            try {
                EXPECT_FALSE(read(name, damaged).faces.empty());
            } catch (const InvalidInput&) {
            }
        }
    }
}

}  // namespace
}  // namespace gelatin
