#include "model/scene/scene_of_meshes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/surface_file.h"
#include "mesh/tet_file.h"
#include "model/transform.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
struct Box {
    glm::dvec3 low{HUGE_VAL}, high{-HUGE_VAL};
};

// A box of 20 x 40 x 10, its top corner marked by its place: what is up is known.
class SceneOfMeshes : public testing::Test {
protected:
    SceneOfMeshes() {
        const std::string vertices = "v 100 0 0\nv 120 0 0\nv 100 40 0\nv 100 0 10\n";
        write_file(path("wedge.obj"), vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
        Notes notes;
        write_surface(path("wedge.stl"), read_surface(path("wedge.obj"), notes));
        write_tets(path("wedge.msh"),
                   {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {{0, 2, 1}}, {}});
    }
    fs::path path(const std::string& name) const { return folder_.path() / name; }

    Scene make(const std::vector<std::string>& names, const MeshSceneOptions& options = {}) {
        std::vector<fs::path> files;
        for (const std::string& name : names) files.push_back(path(name));
        notes_.clear();
        return scene_of_meshes(files, options, notes_);
    }

    static Box box_of(const ObjectDescription& object) {
        Notes notes;
        const fs::path file = std::get<FileShape>(object.shape).file;
        Box box;
        for (const glm::dvec3& p :
             is_tet_file(file) ? read_tets(file, notes).positions : read_surface(file, notes).positions) {
            const glm::dvec3 placed = orientation_of(object, Axis::y) * (object.scale * p) + object.position;
            box.low = glm::min(box.low, placed);
            box.high = glm::max(box.high, placed);
        }
        return box;
    }
    glm::dvec3 size_with(const std::string& name, std::optional<Axis> up) {
        const Box box = box_of(make({name}, {up}).objects.at(0));
        return box.high - box.low;
    }

    Notes notes_;

private:
    const TemporaryFolder folder_;
};

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::distance(a, b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST_F(SceneOfMeshes, DropsAMeshOfAMetreFromHalfItsHeight) {
    const Scene scene = make({"wedge.obj"});
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "wedge");
    const Box box = box_of(scene.objects[0]);
    expect_near(box.low, {-0.25, 0.5, -0.125});
    expect_near(box.high, {0.25, 1.5, 0.125});
    EXPECT_THAT(notes_,
                ElementsAre(HasSubstr("wedge.obj: scaled to an extent of 1 m from 40; --keep-units")));
    EXPECT_EQ(scene.simulation.frames * scene.simulation.frame_time(), 3.0);
    EXPECT_EQ(std::get<PlaneCollider>(scene.colliders.at(0).shape).offset, 0.0);
    EXPECT_NO_THROW(validate(scene));
}

TEST_F(SceneOfMeshes, KeepsUnitsWhereAsked) {
    const Scene scene = make({"wedge.obj"}, {.up = {}, .keep_units = true, .nodes = 900});
    expect_near(box_of(scene.objects[0]).high, {10.0, 60.0, 5.0});
    EXPECT_THAT(notes_, IsEmpty());
    EXPECT_EQ(scene.objects[0].mesher.nodes, 900);
    EXPECT_EQ(make({"wedge.obj"}).objects[0].mesher, MesherSettings());
}

// The height is along the axis that points up, and right-handed things stay so.
TEST_F(SceneOfMeshes, StandsAsTheFileSays) {
    expect_near(size_with("wedge.obj", {}), {0.5, 1.0, 0.25});
    expect_near(size_with("wedge.stl", {}), {0.5, 0.25, 1.0});
    expect_near(size_with("wedge.obj", Axis::z), {0.5, 0.25, 1.0});
    expect_near(size_with("wedge.obj", Axis::x), {1.0, 0.5, 0.25});
    expect_near(size_with("wedge.stl", Axis::y), {0.5, 1.0, 0.25});
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
        glm::dvec3 up(0.0);
        up[static_cast<int>(axis)] = 1.0;
        expect_near(orientation_of(make({"wedge.obj"}, {axis}).objects[0], Axis::y) * up, {0.0, 1.0, 0.0});
    }
}

TEST_F(SceneOfMeshes, PilesBodiesUpWithRoomBetweenThem) {
    const Scene scene = make({"wedge.obj", "wedge.msh", "wedge.obj", "wedge.stl"});
    ASSERT_EQ(scene.objects.size(), 4u);
    std::vector<std::string> names;
    for (const ObjectDescription& object : scene.objects) names.push_back(object.name);
    EXPECT_THAT(names, ElementsAre("wedge", "wedge 2", "wedge 3", "wedge 4"));
    EXPECT_EQ(notes_.size(), 2u);  // one for each file that is scaled
    EXPECT_NO_THROW(validate(scene));
    for (std::size_t o = 1; o < scene.objects.size(); ++o) {
        const Box below = box_of(scene.objects[o - 1]), above = box_of(scene.objects[o]);
        EXPECT_NEAR(above.low.y - below.high.y, 0.1, 1e-6);
        const glm::dvec3 aside = 0.5 * (above.low + above.high - below.low - below.high);
        EXPECT_GT(std::hypot(aside.x, aside.z), 0.2);
        EXPECT_LT(std::hypot(aside.x, aside.z), 0.5);
    }
}

TEST_F(SceneOfMeshes, RefusesWhatItCannotUse) {
    EXPECT_THROW(make({"missing.obj"}), InvalidInput);
    try {
        make({"wedge.obj", "wedge.msh"}, {.up = {}, .keep_units = false, .nodes = 900});
        FAIL() << "no error";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("wedge.msh: --nodes is for surfaces, and this file has tetrahedra already"));
    }
}

}  // namespace
}  // namespace gelatin
