#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "commands.h"
#include "cpu/explicit/advance_nodes.h"
#include "crossings.h"
#include "gelatin/error.h"
#include "gelatin/simulator.h"
#include "gelatin/version.h"
#include "gl/context.h"
#include "mesh/file_ending.h"
#include "mesh/surface_file.h"
#include "mesh/tet_file.h"
#include "mesh_report.h"
#include "model/model.h"
#include "model/setting_names.h"
#include "sim/report.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

// The properties of a context on this device (or on any), or why there is none.
Json describe_device(std::optional<int> index) {
    try {
        const gl::DeviceInfo device = gl::Context::headless({index, false}).device();
        return {{"renderer", device.renderer},
                {"vendor", device.vendor},
                {"version", device.version},
                {"software", device.is_software},
                {"max_storage_block_bytes", device.max_storage_block_bytes}};
    } catch (const NoOpenGl& error) {
        return {{"unusable", error.what()}};
    }
}

Json describe_machine() {
    Json opengl = {{"default", describe_device(std::nullopt)}};
    for (int i = 0; i < gl::Context::device_count(); ++i)
        opengl["device " + std::to_string(i)] = describe_device(i);
    return {{"version", version()},
            {"commit", commit()},
            {"cpu", {{"simd", cpu::simd_target()}, {"threads", std::thread::hardware_concurrency()}}},
            {"opengl", opengl}};
}

Json describe_scene(const std::filesystem::path& file) {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Scene scene = load_scene(file);
    // The description does not depend on what needs OpenGL.
    if (scene.collision.broad_phase == BroadPhase::depth) scene.collision.broad_phase = BroadPhase::hierarchy;
    const Simulator simulator(scene, options);
    const SimulationSettings& settings = simulator.scene().simulation;
    const Counts counts = simulator.counts();
    Json description = {{"kind", "scene"},
                        {"solver", name_of(settings.solver)},
                        {"frame_rate", settings.frame_rate},
                        {"frames", settings.frames},
                        {"substeps", simulator.substeps()},
                        {"step_size", simulator.step_size()},
                        {"counts",
                         {{"objects", counts.objects},
                          {"nodes", counts.nodes},
                          {"springs", counts.springs},
                          {"faces", counts.faces},
                          {"tets", counts.tets}}}};
    for (const ModelObject& object : model_of(simulator).bodies()) {
        description["objects"][object.name] = {
            {"nodes", object.nodes.count}, {"springs", object.springs.count},
            {"faces", object.faces.count}, {"tets", object.tets.count},
            {"mass", object.mass},         {"volume", object.rest_volume}};
        if (object.is_rigid) description["objects"][object.name]["rigid"] = true;
    }
    return description;
}

// Adds what is to say about the file itself.
Json describe(const std::filesystem::path& file, Notes& notes) {
    if (file.empty()) return describe_machine();
    if (lower_case_ending(file) == ".toml") return describe_scene(file);
    Json description;
    if (is_tet_file(file)) {
        const TetMesh mesh = read_tets(file, notes);
        description = describe_tets(mesh);
        add_histograms(mesh, description);
    } else {
        const SurfaceMesh mesh = read_surface(file, notes);
        description = describe_surface(mesh);
        description["crossings"] = count_crossings(mesh);
    }
    return description;
}

void print(const std::filesystem::path& file, bool as_json) {
    Notes notes;
    Json description = describe(file, notes);
    if (!as_json) {
        print_notes(notes);
        std::fputs(to_text(description).c_str(), stdout);
        return;
    }
    if (description.value("kind", "scene") != "scene") {
        Json& lines = description["notes"] = Json::array();
        for (const Note& note : notes) lines.push_back(note.text);
    }
    std::puts(description.dump(1, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace

void add_info_command(CLI::App& app) {
    struct Options {
        std::filesystem::path file;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("info", "Describe this machine, a scene or a mesh");
    command->add_option("FILE", options->file,
                        "A scene (.toml) or a mesh; none: this program and its devices");
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([options] { print(options->file, options->json); });
}

}  // namespace gelatin
