#include "common/scene_input.h"

#include <algorithm>

#include "core/file.h"
#include "core/log.h"
#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "mesh/file_ending.h"
#include "model/scene/override_scene.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordingEnding = ".gel";

[[noreturn]] void refuse(const fs::path& file, const std::string& problem) {
    throw InvalidInput({file.string(), 0, {}, {}, problem});
}

// A file that a user drops onto a window may be anything. One without an ending may be a pipe.
void check_kind(const fs::path& file) {
    const std::string ending = lower_case_ending(file);
    if (ending == ".toml" || ending.empty() || is_mesh_file(file)) return;
    if (ending == kRecordingEnding) refuse(file, "is a recording, which is played or simulated alone");
    if (!fs::is_regular_file(file)) read_file(file);  // its message names the problem
    refuse(file,
           "is neither a scene (.toml) nor a mesh (.obj, .stl, .ply, .off, .gltf, .glb, .node, .ele, .mesh, "
           ".msh, .vtk or .vtu)");
}

// The scene file among the files, if there is one.
std::vector<fs::path>::const_iterator find_scene(const SceneInput& input) {
    return std::find_if_not(input.files.begin(), input.files.end(), is_mesh_file);
}

}  // namespace

bool is_recording_input(const SceneInput& input) {
    return input.files.size() == 1 && lower_case_ending(input.files.front()) == kRecordingEnding;
}

void check_input(const SceneInput& input) {
    if (is_recording_input(input)) {
        if (input.meshes != MeshSceneOptions())
            refuse(input.files.front(), "is a recording; --up, --keep-units and --nodes are for meshes");
        return;
    }
    if (input.files.empty()) throw InvalidInput("there is no scene and no mesh to simulate");
    for (const fs::path& file : input.files) check_kind(file);
    const auto scene = find_scene(input);
    if (scene == input.files.end()) return;
    if (input.files.size() > 1)
        refuse(*scene, "a scene is simulated alone; several files must all be meshes");
    if (input.meshes != MeshSceneOptions())
        refuse(*scene, "is a scene; --up, --keep-units and --nodes are for meshes");
}

Scene load_input(const SceneInput& input) {
    check_input(input);
    if (is_recording_input(input))
        return override_scene(Recording(input.files.front()).scene(), input.overrides);
    if (const auto scene = find_scene(input); scene != input.files.end())
        return load_scene(*scene, input.overrides);
    Notes notes;
    const Scene of_meshes = scene_of_meshes(input.files, input.meshes, notes);
    for (const Note& note : notes) log_note(note.text);
    return override_scene(of_meshes, input.overrides);
}

}  // namespace gelatin
