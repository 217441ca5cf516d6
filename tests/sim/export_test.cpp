#include "sim/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/surface_file.h"
#include "mesh/tet_file.h"
#include "mesh/texture_samples.h"
#include "model/assembly/pack_skin.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

// Of unit tets, 3 m apart.
constexpr std::array<float, 3> kCorners[9] = {{0, 0, 0}, {.25f, .25f, .25f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                              {3, 0, 0}, {4, 0, 0},          {3, 1, 0}, {3, 0, 1}};

// Two tets. The first has a node in no face, so that node and vertex numbers differ from there on.
Model two_tets() {
    Model model;
    for (const std::array<float, 3>& p : kCorners) model.positions.emplace_back(p[0], p[1], p[2], 1.0f);
    model.shear_moduli = {2e4f, 3e4f};
    model.tets = {{0, 2, 3, 4}, {5, 6, 7, 8}};
    for (std::uint32_t object = 0; object < 2; ++object) {
        const glm::uvec4 t = model.tets[object];
        for (const glm::uvec3 f : {glm::uvec3(t.x, t.z, t.y), glm::uvec3(t.x, t.y, t.w),
                                   glm::uvec3(t.y, t.z, t.w), glm::uvec3(t.x, t.w, t.z)}) {
            model.faces.push_back({f.x, f.y, f.z, object});
        }
    }
    ModelObject first, second;
    first.name = "left one";
    first.nodes = {0, 5};
    first.faces = {0, 4};
    first.tets = {0, 1};
    second.name = "right";
    second.nodes = {5, 4};
    second.faces = {4, 4};
    second.tets = {1, 1};
    model.objects = {first, second};
    return model;
}

// At rest; velocities name their node.
HostFrame frame_of(int number) {
    HostFrame frame;
    frame.frame = number;
    frame.time = 0.125 * number;
    for (int node = 0; node < 9; ++node) {
        frame.positions.insert(frame.positions.end(), kCorners[node].begin(), kCorners[node].end());
        frame.velocities.insert(frame.velocities.end(), {static_cast<float>(node), 0.5f, -1.0f});
    }
    return frame;
}

// The values of a VTU's array, of which this test has one block or none.
template <class T>
std::vector<T> data_array(const std::string& vtu, const std::string& name) {
    const auto tag = vtu.find("Name=\"" + name + "\"");
    if (tag == std::string::npos) return {};
    const auto start = vtu.find('>', tag) + 1;
    const std::string text = vtu.substr(start, vtu.find('<', start) - start);
    constexpr std::size_t kHead = 44;  // characters of four numbers, or 32 of three
    std::uint64_t head[4] = {};        // blocks, size of each, of the last, of what it has become
    const std::string head_bytes = from_base64(text.substr(0, kHead));
    std::memcpy(head, head_bytes.data(), std::min(sizeof head, head_bytes.size()));
    if (head[0] == 0) return {};
    EXPECT_EQ(head[0], 1u) << name;
    const std::string bytes = from_base64(text.substr(kHead));
    EXPECT_EQ(bytes.size(), head[3]) << name;
    std::vector<T> values(head[2] / sizeof(T));
    uLongf size = head[2];
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(values.data()), &size,
                         reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
              Z_OK);
    EXPECT_EQ(size, head[2]) << name;
    return values;
}

TEST(Export, ObjHasOneObjectABodyWithItsSurface) {
    EXPECT_EQ(obj_text(make_export_topology(two_tets()), frame_of(2)),
              "# frame 2, 0.25 s\n"
              "o left one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
              "o right\nv 3 0 0\nv 4 0 0\nv 3 1 0\nv 3 0 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n");
}

TEST(Export, PlyReadsBackAsTheSameSurface) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "frame.ply";
    write_file(file, ply_bytes(make_export_topology(two_tets()), frame_of(0)));
    Notes notes;
    const SurfaceMesh mesh = read_surface(file, notes);
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_EQ(mesh.faces.size(), 8u);
    EXPECT_EQ(mesh.positions.at(5), glm::dvec3(4.0, 0.0, 0.0));
    EXPECT_EQ(mesh.faces.at(4), glm::uvec3(4, 6, 5));
}

TEST(Export, VtuReadsBackAsTheSameTets) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "frame.vtu";
    write_file(file, vtu_text(make_export_topology(two_tets()), frame_of(0)));
    Notes notes;
    const TetMesh mesh = read_tets(file, notes);
    ASSERT_EQ(mesh.positions.size(), 8u);  // one of the nine has no tet
    EXPECT_EQ(mesh.positions[5], glm::dvec3(4.0, 0.0, 0.0));
    EXPECT_EQ(mesh.tets, (std::vector<glm::uvec4>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
    EXPECT_EQ(mesh.attributes, (std::vector<int>{0, 1}));  // the objects
}

// The first of two tets becomes the surface of a rigid body.
TEST(Export, VtuHasFacesOfRigidBodies) {
    Model model = two_tets();
    model.objects[0].is_rigid = true;
    model.tets.erase(model.tets.begin());
    model.shear_moduli.erase(model.shear_moduli.begin());
    model.objects[0].tets = {0, 0};
    model.objects[1].tets = {0, 1};
    const std::string vtu = vtu_text(make_export_topology(model), frame_of(0));
    EXPECT_THAT(vtu, HasSubstr("NumberOfPoints=\"9\" NumberOfCells=\"5\""));
    EXPECT_EQ(data_array<std::uint8_t>(vtu, "types"), (std::vector<std::uint8_t>{10, 5, 5, 5, 5}));
    EXPECT_EQ(data_array<std::int32_t>(vtu, "object"), (std::vector<std::int32_t>{1, 0, 0, 0, 0}));
    EXPECT_EQ(data_array<std::int64_t>(vtu, "offsets"), (std::vector<std::int64_t>{4, 7, 10, 13, 16}));
    EXPECT_EQ(data_array<std::int64_t>(vtu, "connectivity"),
              (std::vector<std::int64_t>{5, 6, 7, 8, 0, 3, 2, 0, 2, 4, 2, 3, 4, 0, 4, 3}));
    EXPECT_EQ(data_array<float>(vtu, "strain").size(), 5u * 9u);
    EXPECT_EQ(data_array<float>(vtu, "stress").size(), 5u);
    const TemporaryFolder folder;
    write_file(folder.path() / "frame.vtu", vtu);
    Notes notes;
    EXPECT_EQ(read_tets(folder.path() / "frame.vtu", notes).positions.size(), 4u) << "of the other";
}

// The second of two tets becomes the surface of a collider, which moves.
TEST(Export, VtuHasCollidersWhereTheyAre) {
    Model model = two_tets();
    model.surfaces.resize(1);
    model.tets.pop_back();
    model.shear_moduli.pop_back();
    model.objects[1].tets = {1, 0};
    HostFrame frame = frame_of(0);
    frame.positions[3 * 8 + 1] += 0.5f;
    const std::string vtu = vtu_text(make_export_topology(model), frame);
    EXPECT_THAT(vtu, HasSubstr("NumberOfPoints=\"9\" NumberOfCells=\"5\""));
    EXPECT_EQ(data_array<float>(vtu, "Points"), frame.positions);
    EXPECT_EQ(data_array<float>(vtu, "displacement")[3 * 8 + 1], 0.5f);
    EXPECT_EQ(data_array<std::uint8_t>(vtu, "types"), (std::vector<std::uint8_t>{10, 5, 5, 5, 5}));
    EXPECT_EQ(data_array<std::int32_t>(vtu, "object"), (std::vector<std::int32_t>{0, 1, 1, 1, 1}));
}

TEST(Export, PlyHasVelocitiesAndObjects) {
    const std::string bytes = ply_bytes(make_export_topology(two_tets()), frame_of(0));
    const std::string end = "end_header\n";
    const char* data = bytes.data() + bytes.find(end) + end.size();
    constexpr std::size_t kVertex = 24, kFace = 17;
    ASSERT_EQ(bytes.data() + bytes.size() - data, static_cast<std::ptrdiff_t>(8 * kVertex + 8 * kFace));
    float velocity[3];
    std::memcpy(velocity, data + 1 * kVertex + 12, sizeof velocity);
    EXPECT_EQ(velocity[0], 2.0f);  // the second vertex is node 2
    std::uint32_t object[2];
    std::memcpy(&object[0], data + 8 * kVertex + 3 * kFace + 13, 4);
    std::memcpy(&object[1], data + 8 * kVertex + 4 * kFace + 13, 4);
    EXPECT_EQ(object[0], 0u);
    EXPECT_EQ(object[1], 1u);
}

// The second tet is stretched by a tenth along x, and sheared by a fifth of y along x.
TEST(Export, VtuHasStrainAndStress) {
    HostFrame frame = frame_of(0);
    for (std::size_t n = 5; n < 9; ++n)
        frame.positions[3 * n] += 0.1f * (kCorners[n][0] - 3.0f) + 0.2f * kCorners[n][1];
    const std::string vtu = vtu_text(make_export_topology(two_tets()), frame);
    const std::vector<float> moved = data_array<float>(vtu, "displacement"),
                             strains = data_array<float>(vtu, "strain"),
                             stresses = data_array<float>(vtu, "stress");
    EXPECT_NEAR(moved[3 * 6], 0.1f, 1e-6f);
    EXPECT_NEAR(moved[3 * 7], 0.2f, 1e-6f);
    // F = (1.1 0.2 0; 0 1 0; 0 0 1)
    const float expected[9] = {0.105f, 0.11f, 0, 0.11f, 0.02f, 0, 0, 0, 0};
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(strains[9 + k], expected[k], 1e-6f) << k;
    for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(strains[k], 0.0f);
    // Stretches squared are the roots of x^2 - 2.25 x + 1.21, and 1.
    const double root = std::sqrt(0.25 * 2.25 * 2.25 - 1.21), a = std::sqrt(1.125 + root),
                 b = std::sqrt(1.125 - root);
    EXPECT_NEAR(stresses[1],
                3e4 * std::sqrt(2.0 * ((a - b) * (a - b) + (a - 1) * (a - 1) + (b - 1) * (b - 1))), 0.1);
    EXPECT_EQ(stresses[0], 0.0f);
}

TEST(Export, VtuHasEveryNodeAndTet) {
    const HostFrame frame = frame_of(0);
    const std::string vtu = vtu_text(make_export_topology(two_tets()), frame);
    EXPECT_THAT(vtu, HasSubstr("<Piece NumberOfPoints=\"9\" NumberOfCells=\"2\">"));
    EXPECT_EQ(data_array<float>(vtu, "Points"), frame.positions);
    EXPECT_EQ(data_array<float>(vtu, "velocity"), frame.velocities);
    EXPECT_EQ(data_array<std::int64_t>(vtu, "connectivity"),
              (std::vector<std::int64_t>{0, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(data_array<std::int64_t>(vtu, "offsets"), (std::vector<std::int64_t>{4, 8}));
    EXPECT_EQ(data_array<std::uint8_t>(vtu, "types"), (std::vector<std::uint8_t>{10, 10}));
    EXPECT_EQ(data_array<std::int32_t>(vtu, "object"), (std::vector<std::int32_t>{0, 1}));
    EXPECT_EQ(data_array<float>(vtu, "displacement"), std::vector<float>(27));
    EXPECT_EQ(data_array<float>(vtu, "strain"), std::vector<float>(18));
    EXPECT_EQ(data_array<float>(vtu, "stress"), std::vector<float>(2));
}

// The same with a surface for the first tet: a triangle around it, and the second's hull.
Model tets_with_a_skin() {
    Model model = two_tets();
    Skin& skin = model.skin;
    skin.points = {{0, 2, 3, 4, {-1.0f, 2.0f, 0.0f, 0.0f}},
                   {0, 2, 3, 4, {0.5f, 0.0f, 0.5f, 0.0f}},
                   {0, 2, 3, 4, {0.0f, 0.0f, 0.0f, 1.0f}}};
    skin.faces = {{2, 0, 1, 0}};
    skin.objects = {{{0, 3}, {0, 1}, 1.0}};
    append_hull(model, 1, skin);
    return model;
}

TEST(Export, ObjHasSkinsInTheOrderOfTheirFiles) {
    EXPECT_EQ(obj_text(make_export_topology(tets_with_a_skin()), frame_of(2)),
              "# frame 2, 0.25 s\n"
              "o left one\nv 2 0 0\nv 0 0.5 0\nv 0 0 1\nf 3 1 2\n"
              "o right\nv 3 0 0\nv 4 0 0\nv 3 1 0\nv 3 0 1\nf 4 6 5\nf 4 5 7\nf 5 6 7\nf 4 7 6\n");
}

// A red triangle with a picture, and a hull of no material.
Model painted_tets() {
    Model model = tets_with_a_skin();
    SurfaceLook& look = model.skin.look;
    look.materials = {
        {"my paint", {0.0f, 0.0f, 0.214f}, "a/b.png", std::make_shared<const std::string>("\x89PNG")}};
    look.face_materials = {0, SurfaceLook::kNone, SurfaceLook::kNone, SurfaceLook::kNone, SurfaceLook::kNone};
    look.corner_uvs.resize(5);
    look.corner_uvs[0] = {glm::vec2(0.5f, 0.25f), glm::vec2(0.0f), glm::vec2(0.5f, 0.25f)};
    return model;
}

TEST(Export, ObjKeepsTextureCoordinatesAndMaterials) {
    EXPECT_EQ(obj_text(make_export_topology(painted_tets()), frame_of(2)),
              "# frame 2, 0.25 s\nmtllib scene.mtl\n"
              "o left one\nv 2 0 0\nv 0 0.5 0\nv 0 0 1\n"
              "vt 0.5 0.25\nvt 0 0\nusemtl my_paint\nf 3/1 1/2 2/1\n"
              "o right\nv 3 0 0\nv 4 0 0\nv 3 1 0\nv 3 0 1\n"
              "vt 0 0\nusemtl none\nf 4/3 6/3 5/3\nf 4/3 5/3 7/3\nf 5/3 6/3 7/3\nf 4/3 7/3 6/3\n");
}

TEST(Export, MaterialsAreBesideObjFramesAlone) {
    const TemporaryFolder folder;
    FrameExporter(folder.path(), ExportFormat::ply, painted_tets()).write(frame_of(3));
    EXPECT_FALSE(fs::exists(folder.path() / "scene.mtl"));
    FrameExporter(folder.path(), ExportFormat::obj, painted_tets()).write(frame_of(3));
    const std::string library = read_file(folder.path() / "scene.mtl");
    EXPECT_THAT(library, HasSubstr("newmtl none\n"));
    EXPECT_THAT(library, HasSubstr("newmtl my_paint\nKd 0 0 0.49"));
    EXPECT_THAT(library, HasSubstr("map_Kd my_paint.png\n"));
    EXPECT_EQ(read_file(folder.path() / "my_paint.png"), "\x89PNG");
}

TEST(Export, PlyHasSkinsAndTheirVelocities) {
    const std::string bytes = ply_bytes(make_export_topology(tets_with_a_skin()), frame_of(0));
    EXPECT_THAT(bytes, HasSubstr("element vertex 7\n"));
    EXPECT_THAT(bytes, HasSubstr("element face 5\n"));
    const std::string end = "end_header\n";
    const char* data = bytes.data() + bytes.find(end) + end.size();
    float first[6];
    std::memcpy(first, data, sizeof first);
    EXPECT_EQ(first[0], 2.0f);
    EXPECT_EQ(first[3], 4.0f) << "twice node 2, less node 0";
    std::uint32_t face[4];
    std::memcpy(face, data + 7 * 24 + 17 + 1, sizeof face);  // the second
    EXPECT_THAT(face, testing::ElementsAre(3u, 5u, 4u, 1u));
}

TEST(Export, VtpHasSkins) {
    const HostFrame frame = frame_of(0);
    const std::string vtp = vtp_text(make_export_topology(tets_with_a_skin()), frame);
    EXPECT_THAT(vtp, HasSubstr("<Piece NumberOfPoints=\"7\" NumberOfPolys=\"5\">"));
    const std::vector<float> points = data_array<float>(vtp, "Points");
    ASSERT_EQ(points.size(), 21u);
    EXPECT_EQ(points[0], 2.0f);
    EXPECT_EQ(points[4], 0.5f);
    EXPECT_EQ(data_array<float>(vtp, "velocity")[0], 4.0f);
    EXPECT_EQ(data_array<std::int64_t>(vtp, "connectivity"),
              (std::vector<std::int64_t>{2, 0, 1, 3, 5, 4, 3, 4, 6, 4, 5, 6, 3, 6, 5}));
    EXPECT_EQ(data_array<std::int64_t>(vtp, "offsets"), (std::vector<std::int64_t>{3, 6, 9, 12, 15}));
    EXPECT_EQ(data_array<std::int32_t>(vtp, "object"), (std::vector<std::int32_t>{0, 1, 1, 1, 1}));
}

TEST(Export, SkinsAreTheSecondPartOfEachFrame) {
    const TemporaryFolder folder;
    FrameExporter exporter(folder.path(), ExportFormat::vtu, tets_with_a_skin());
    exporter.write(frame_of(12));
    EXPECT_TRUE(fs::exists(folder.path() / "frame_000012.vtu"));
    EXPECT_TRUE(fs::exists(folder.path() / "frame_000012.vtp"));
    EXPECT_THAT(read_file(folder.path() / "scene.pvd"),
                HasSubstr("<DataSet timestep=\"1.5\" part=\"0\" file=\"frame_000012.vtu\"/>\n"
                          "<DataSet timestep=\"1.5\" part=\"1\" file=\"frame_000012.vtp\"/>\n"));
}

TEST(Export, FramesAreNumberedAndListedWithTheirTimes) {
    const TemporaryFolder folder;
    FrameExporter exporter(folder.path(), ExportFormat::vtu, two_tets());
    exporter.write(frame_of(0));
    exporter.write(frame_of(12));
    EXPECT_TRUE(fs::exists(folder.path() / "frame_000000.vtu"));
    EXPECT_TRUE(fs::exists(folder.path() / "frame_000012.vtu"));
    const std::string list = read_file(folder.path() / "scene.pvd");
    EXPECT_EQ(
        list,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n<DataSet timestep=\"0\" part=\"0\" file=\"frame_000000.vtu\"/>\n"
        "<DataSet timestep=\"1.5\" part=\"0\" file=\"frame_000012.vtu\"/>\n</Collection>\n</VTKFile>\n");
}

TEST(Export, OtherFormatsHaveNoList) {
    const TemporaryFolder folder;
    FrameExporter(folder.path(), ExportFormat::obj, two_tets()).write(frame_of(3));
    EXPECT_TRUE(fs::exists(folder.path() / "frame_000003.obj"));
    EXPECT_FALSE(fs::exists(folder.path() / "scene.pvd"));
}

TEST(Export, MakesTheFolder) {
    const TemporaryFolder folder;
    const fs::path deep = folder.path() / "a" / "b";
    prepare_export_folder(deep);
    EXPECT_TRUE(fs::is_directory(deep));
    EXPECT_NO_THROW(prepare_export_folder(deep));
}

TEST(Export, RefusesAFolderThatIsAFile) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "taken";
    write_file(file, "x");
    try {
        prepare_export_folder(file);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), StartsWith(file.string() + ": cannot be made: "));
    }
}

TEST(Export, SaysSoWhenAFrameCannotBeWritten) {
    TemporaryFolder folder;
    const fs::path gone = folder.path() / "gone";
    prepare_export_folder(gone);
    FrameExporter exporter(gone, ExportFormat::vtu, two_tets());
    fs::remove(gone);
    EXPECT_THROW(exporter.write(frame_of(0)), SystemError);
}

}  // namespace
}  // namespace gelatin
