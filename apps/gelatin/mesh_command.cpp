#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "commands.h"
#include "common/choice.h"
#include "common/output_file.h"
#include "mesh/fill_surface.h"
#include "mesh/surface_file.h"
#include "mesh/surface_repair.h"
#include "mesh/tet_file.h"
#include "mesh_report.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kSurfaceEndings = {".obj", ".stl", ".ply", ".off"};
const std::vector<std::string> kTetEndings = {".node", ".ele", ".mesh", ".msh", ".vtu"};

struct MeshOptions {
    fs::path input, output;
    std::string mesher = "auto";
    MesherSettings settings;
    bool has_mesher_options = false;
};

// The boundary faces over the nodes that they use, in the nodes' order.
SurfaceMesh boundary_of(const TetMesh& tets) {
    constexpr std::uint32_t kUnused = ~0u;
    SurfaceMesh surface;
    std::vector<std::uint32_t> vertex_of_node(tets.positions.size(), kUnused);
    for (const glm::uvec3& face : tets.faces) {
        for (int corner = 0; corner < 3; ++corner) vertex_of_node[face[corner]] = 0;
    }
    for (std::size_t node = 0; node < vertex_of_node.size(); ++node) {
        if (vertex_of_node[node] == kUnused) continue;
        vertex_of_node[node] = static_cast<std::uint32_t>(surface.positions.size());
        surface.positions.push_back(tets.positions[node]);
    }
    for (const glm::uvec3& face : tets.faces) {
        surface.faces.emplace_back(vertex_of_node[face.x], vertex_of_node[face.y], vertex_of_node[face.z]);
    }
    return surface;
}

/// What tets were made of, and how long that took [s].
struct FillReport {
    const SurfaceMesh& surface;
    double seconds;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void write_tets_and_report(const fs::path& file, const TetMesh& mesh,
                           const std::optional<FillReport>& filled = {}) {
    write_tets(file, mesh);
    Json description = describe_tets(mesh);
    if (filled) {
        if (measure_openness(filled->surface).is_closed())
            description["volume_by_surface"] =
                description["volume"].get<double>() / signed_volume(filled->surface);
        description["seconds"] = filled->seconds;
    }
    std::fprintf(message_stream({file}), "%sfile: %s\n", to_text(description).c_str(), file.c_str());
}

void write_surface_and_report(const fs::path& file, const SurfaceMesh& mesh) {
    write_surface(file, mesh);
    std::fprintf(message_stream({file}), "%sfile: %s\n", to_text(describe_surface(mesh)).c_str(),
                 file.c_str());
}

void check(const char* option, double value, bool holds, const char* allowed) {
    if (holds && std::isfinite(value)) return;
    throw InvalidInput({{}, 0, option, fmt::format("{}", value), allowed});
}

void check_settings(const MesherSettings& settings) {
    check("--quality", settings.quality, settings.quality > 1.0, "must be greater than 1");
    check("--time-limit", settings.time_limit, settings.time_limit > 0.0, "must be greater than 0");
    if (const auto volume = settings.max_volume)
        check("--max-volume", *volume, *volume > 0.0, "must be greater than 0");
    if (const auto size = settings.cell_size)
        check("--cell-size", *size, *size > 0.0, "must be greater than 0");
    if (const auto nodes = settings.nodes)
        check("--nodes", *nodes, *nodes >= 10 && *nodes <= 1'000'000, "must be from 10 to 1000000");
    if (settings.kind == MesherKind::tetgen && settings.cell_size)
        throw InvalidInput("--cell-size is only for the lattice, not for --mesher tetgen");
    if (settings.kind == MesherKind::lattice && settings.quality != MesherSettings().quality)
        throw InvalidInput("--quality is only for TetGen, not for --mesher lattice");
    if (settings.nodes.has_value() + settings.cell_size.has_value() + settings.max_volume.has_value() > 1)
        throw InvalidInput("of --nodes, --cell-size and --max-volume one at most can be given");
}

void run_mesh(MeshOptions& options) {
    options.settings.kind = choose<MesherKind>(
        "--mesher", options.mesher,
        {{"auto", MesherKind::automatic}, {"tetgen", MesherKind::tetgen}, {"lattice", MesherKind::lattice}});
    check_settings(options.settings);
    std::vector<std::string> endings = kTetEndings;
    endings.insert(endings.end(), kSurfaceEndings.begin(), kSurfaceEndings.end());
    check_ending("-o", options.output, endings);
    check_output_file("-o", options.output);
    const bool to_surface = is_surface_file(options.output);
    const bool from_tets = is_tet_file(options.input);
    if (options.has_mesher_options && (from_tets || to_surface)) {
        throw InvalidInput(
            "--mesher, --nodes, --cell-size, --quality, --max-volume and --time-limit are for making tets of "
            "a surface; " +
            (from_tets ? options.input.string() + " has tets already"
                       : options.output.string() + " takes none"));
    }
    Notes notes;
    if (from_tets) {
        const TetMesh mesh = read_tets(options.input, notes);
        print_notes(notes);
        return to_surface ? write_surface_and_report(options.output, boundary_of(mesh))
                          : write_tets_and_report(options.output, mesh);
    }
    const SurfaceMesh surface = read_surface(options.input, notes);
    print_notes(notes);
    if (to_surface) return write_surface_and_report(options.output, surface);
    const auto start = std::chrono::steady_clock::now();
    notes.clear();
    const TetMesh mesh = fill_surface(surface, sized(options.settings), options.input.string(), notes);
    print_notes(notes);
    write_tets_and_report(options.output, mesh, FillReport{surface, seconds_since(start)});
}

}  // namespace

void add_mesh_command(CLI::App& app) {
    auto options = std::make_shared<MeshOptions>();
    CLI::App* command = app.add_subcommand("mesh", "Fill a surface with tets, or convert between mesh files");
    command
        ->add_option(
            "IN", options->input,
            "A surface (.obj, .stl, .ply, .off, .gltf, .glb) or tets (.node, .ele, .mesh, .msh, .vtk, "
            ".vtu)")
        ->required();
    command->add_option("-o,--output", options->output, "Tets (.node, .mesh, .msh, .vtu) or a surface")
        ->type_name("OUT")
        ->required();
    MesherSettings& settings = options->settings;
    const std::vector<CLI::Option*> for_mesher = {
        command->add_option("--mesher", options->mesher, "auto, tetgen or lattice")->capture_default_str(),
        command->add_option("--nodes", settings.nodes, "About so many, within 20%; 5000 without a size"),
        command->add_option("--cell-size", settings.cell_size, "Of the lattice's cells at the surface, > 0"),
        command->add_option("--quality", settings.quality, "Largest radius-edge ratio of TetGen's tets, > 1")
            ->capture_default_str(),
        command->add_option("--max-volume", settings.max_volume, "Of a tet, in cubed units of the mesh, > 0"),
        command->add_option("--time-limit", settings.time_limit, "For TetGen, in seconds, > 0")
            ->capture_default_str()};
    command->callback([options, for_mesher] {
        options->has_mesher_options = std::any_of(for_mesher.begin(), for_mesher.end(),
                                                  [](const CLI::Option* o) { return o->count() > 0; });
        run_mesh(*options);
    });
}

}  // namespace gelatin
