#include "model/scene/scene_of_meshes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "mesh/surface_file.h"
#include "mesh/tet_file.h"
#include "model/transform.h"

namespace gelatin {
namespace {

constexpr double kSize = 1.0;       // the largest extent of a mesh that is scaled [m]
constexpr double kDrop = 0.5;       // height of the first body above the floor, in its heights
constexpr double kClearance = 0.1;  // between two bodies of a pile, in sizes of the upper one
constexpr double kAside = 0.25;     // of a pile's bodies from its axis, in their sizes
constexpr int kFrames = 180;
constexpr int kMeshSubsteps = 2;  // one damps the swinging of ears visibly

/// A box that a mesh fits into, as it stands in the scene but for scale and position.
struct Extent {
    glm::dvec3 low{HUGE_VAL}, high{-HUGE_VAL};

    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    glm::dvec3 size() const { return high - low; }
    double largest() const { return std::max({size().x, size().y, size().z}); }
};

Axis up_axis(const std::filesystem::path& file, const MeshSceneOptions& options) {
    return options.up.value_or(lower_case_ending(file) == ".stl" ? Axis::z : Axis::y);
}

Extent measure(const std::filesystem::path& file, const glm::dquat& rotation) {
    Notes notes;  // the mesher repeats them
    const std::vector<glm::dvec3> positions =
        is_tet_file(file) ? read_tets(file, notes).positions : read_surface(file, notes).positions;
    Extent extent;
    for (const glm::dvec3& p : positions) extent.add(rotation * p);
    return extent;
}

// A metre of it stands under its own weight, compressed by about 5%, with ears that swing.
Material make_jelly() {
    Material jelly;
    jelly.name = "jelly";
    jelly.youngs_modulus = 2e5;
    jelly.poisson_ratio = 0.3;
    jelly.damping = 0.01;
    return jelly;
}

/// Puts one body after the other into a scene.
class Pile {
public:
    Pile(Scene& scene, const MeshSceneOptions& options, std::size_t count, Notes& notes)
        : scene_(scene), options_(options), is_single_(count == 1), notes_(notes) {}

    void add(const std::filesystem::path& file) {
        if (options_.nodes && is_tet_file(file)) {
            throw InvalidInput(
                {file.string(), 0, {}, {}, "--nodes is for surfaces, and this file has tetrahedra already"});
        }
        ObjectDescription body;
        body.name = free_name(file.stem().string());
        body.material = scene_.materials.front().name;
        body.shape = FileShape{std::filesystem::absolute(file)};
        body.mesher.nodes = options_.nodes;
        if (const Axis up = up_axis(file, options_); up != scene_.up) body.up = up;
        const auto [known, is_new] = extents_.try_emplace(file);
        if (is_new) known->second = measure(file, orientation_of(body, scene_.up));
        const Extent& extent = known->second;
        body.scale = scale_of(file, extent, is_new);
        place(body, extent);
        scene_.objects.push_back(std::move(body));
    }

private:
    std::string free_name(const std::string& name) {
        const int count = ++uses_[name];
        return count == 1 ? name : free_name(fmt::format("{} {}", name, count));
    }

    double scale_of(const std::filesystem::path& file, const Extent& extent, bool is_new) {
        const double largest = extent.largest();
        if (options_.keep_units || !(largest > 0.0) || largest == kSize) return 1.0;
        if (is_new) {
            notes_.push_back(
                fmt::format("{}: scaled to an extent of {} m from {:.3g}; --keep-units takes its "
                            "coordinates as metres",
                            file.string(), kSize, largest));
        }
        return kSize / largest;
    }

    void place(ObjectDescription& body, const Extent& extent) {
        const double size = body.scale * extent.largest(), height = body.scale * extent.size().y;
        const double bottom = top_ == 0.0 ? kDrop * height : top_ + kClearance * size;
        const glm::dvec3 foot(0.5 * (extent.low.x + extent.high.x), extent.low.y,
                              0.5 * (extent.low.z + extent.high.z));
        body.position = glm::dvec3(0.0, bottom, 0.0) - body.scale * foot;
        if (!is_single_) {  // in directions that are never the same
            const double angle =
                static_cast<double>(scene_.objects.size()) * std::numbers::pi * (3.0 - std::sqrt(5.0));
            body.position += kAside * size * glm::dvec3(std::cos(angle), 0.0, std::sin(angle));
        }
        top_ = bottom + height;
    }

    Scene& scene_;
    const MeshSceneOptions& options_;
    const bool is_single_;
    Notes& notes_;
    std::map<std::filesystem::path, Extent> extents_;
    std::map<std::string, int> uses_;  // of names
    double top_ = 0.0;                 // of the pile so far [m]
};

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) {
    return is_surface_file(file) || is_tet_file(file);
}

Scene scene_of_meshes(const std::vector<std::filesystem::path>& files, const MeshSceneOptions& options,
                      Notes& notes) {
    Scene scene;
    scene.file = files.at(0);
    scene.simulation.frames = kFrames;
    scene.simulation.substeps = kMeshSubsteps;
    scene.materials.push_back(make_jelly());
    scene.colliders.push_back({PlaneCollider{}});
    Pile pile(scene, options, files.size(), notes);
    for (const std::filesystem::path& file : files) pile.add(file);
    return scene;
}

}  // namespace gelatin
