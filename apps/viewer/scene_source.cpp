#include "scene_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "mesh/surface_file.h"
#include "mesh/tet_file.h"
#include "model/build/build_model.h"

namespace gelatin::viewer {
namespace {

constexpr double kSmall = 0.1, kLarge = 3.0;  // between these sizes meshes keep their size [m]
constexpr double kDrop = 0.25;                // of the body's height

std::vector<glm::dvec3> read_positions(const std::filesystem::path& file) {
    Notes notes;  // the mesher repeats them
    return is_tet_file(file) ? read_tets(file, notes).positions : read_surface(file, notes).positions;
}

// A dropped file may be anything.
void check_kind(const std::filesystem::path& file) {
    constexpr std::array kKinds = {".toml", ".obj", ".stl", ".ply", ".off"};
    if (is_tet_file(file) || std::find(kKinds.begin(), kKinds.end(), lower_case_ending(file)) != kKinds.end())
        return;
    if (!std::filesystem::is_regular_file(file)) read_file(file);  // its message names the problem
    throw InvalidInput(
        {file.string(),
         0,
         {},
         {},
         "is neither a scene (.toml) nor a mesh (.obj, .stl, .ply, .off, .node, .ele, .mesh or "
         ".msh)"});
}

}  // namespace

LoadedScene open_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    check_kind(file);
    return build_scene(lower_case_ending(file) == ".toml" ? load_scene(file, overrides)
                                                          : scene_of_mesh(file));
}

LoadedScene build_scene(const Scene& scene) {
    return {scene, std::make_shared<const Model>(build_model(scene))};
}

Scene scene_of_mesh(const std::filesystem::path& file) {
    glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
    for (const glm::dvec3& p : read_positions(file)) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 size = high - low;
    const double largest = std::max({size.x, size.y, size.z});

    Scene scene;
    scene.file = file;
    scene.simulation.solver = SolverKind::vbd;
    scene.simulation.substeps = 1;
    Material jelly;
    jelly.name = "jelly";
    jelly.damping = 0.01;
    scene.materials.push_back(jelly);
    ObjectDescription body;
    body.name = file.stem().string();
    body.shape = FileShape{std::filesystem::absolute(file)};
    body.material = jelly.name;
    if (largest > 0.0 && (largest < kSmall || largest > kLarge)) body.scale = 1.0 / largest;
    const glm::dvec3 center = 0.5 * (low + high);
    body.position = -body.scale * glm::dvec3(center.x, low.y - kDrop * size.y, center.z);
    scene.objects.push_back(body);
    scene.colliders.push_back({PlaneCollider{}});
    return scene;
}

std::vector<std::filesystem::path> sample_scenes() {
    std::filesystem::path folder = "scenes";
    if (!std::filesystem::is_directory(folder)) folder = GELATIN_SCENES;
    std::vector<std::filesystem::path> files;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace gelatin::viewer
