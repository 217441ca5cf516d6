#include "mesh/tetrahedralise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>
#include <variant>
#include <vector>

#include "core/content_hash.h"
#include "core/counted.h"
#include "core/file.h"
#include "core/process.h"
#include "gelatin/error.h"
#include "mesh/cavity_points.h"
#include "mesh/flat_tets.h"
#include "mesh/surface_repair.h"
#include "mesh/tet_cache.h"
#include "mesh/tet_formats.h"
#include "mesh/topology.h"

namespace gelatin {

namespace {

// Part of the key. Increase it when this file processes TetGen's result differently.
constexpr const char* kCacheFormat = "gelatin tets 3";
constexpr const char* kSurfaceFile = "surface.smesh";
constexpr const char* kTetFile = "surface.1.ele";  // the name that TetGen derives
constexpr double kMostTets = 1e8;  // more would exhaust the memory long before they are complete

/// Runs TetGen, through stdbuf: TetGen ends by abort() when it fails, and its last output would be lost in
/// its buffer.
ProcessResult run_tetgen(std::vector<std::string> arguments, const std::filesystem::path& folder,
                         double time_limit) {
    constexpr int kNoSuchProgram = 127;  // stdbuf's exit code
    arguments.insert(arguments.begin(), {"stdbuf", "-oL", "tetgen"});
    ProcessResult result = run_process(arguments, folder, time_limit);
    if (result.exit_code == kNoSuchProgram) {
        throw SystemError("tetgen: no such program; it makes the tetrahedra (on Debian: apt install tetgen)");
    }
    return result;
}

/// Shortest fixed notation with six significant digits at least: TetGen's switches take no exponent.
std::string switch_number(double value) {
    const int decimals = std::max(0, 6 - static_cast<int>(std::floor(std::log10(value))));
    return fmt::format("{:.{}f}", value, decimals);
}

/// p: fill a surface; q, a: quality and volume; z: count from zero; F: no faces, they follow from the tets.
std::string make_switches(const MesherSettings& settings) {
    std::string switches = "-pzFq" + switch_number(settings.quality);
    if (settings.max_volume) switches += "a" + switch_number(*settings.max_volume);
    return switches;
}

/// A hash of everything that the tets depend on. `tetgen -h` prints the version.
std::string make_key(const SurfaceMesh& surface, const std::vector<glm::dvec3>& holes,
                     const std::string& switches) {
    const TemporaryFolder folder;
    const std::string help = run_tetgen({"-h"}, folder.path(), 10.0).output;
    const std::string head = fmt::format("{}\n{}\n{}\n{} {}\n", kCacheFormat, help, switches,
                                         surface.positions.size(), surface.faces.size());
    ContentHash hash;
    hash.add(head);
    hash.add(surface.positions);
    hash.add(surface.faces);
    if (!holes.empty()) hash.add(holes);  // keys of other surfaces stay what they were
    return hash.hex();
}

/// TetGen's .smesh: the vertices, a facet for each face, a point in each hole, no regions.
std::string format_smesh(const SurfaceMesh& surface, const std::vector<glm::dvec3>& holes) {
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{} 3 0 0\n", surface.positions.size());
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        const glm::dvec3& p = surface.positions[v];
        fmt::format_to(out, "{} {} {} {}\n", v, p.x, p.y, p.z);
    }
    fmt::format_to(out, "{} 0\n", surface.faces.size());
    for (const glm::uvec3& f : surface.faces) fmt::format_to(out, "3 {} {} {}\n", f[0], f[1], f[2]);
    fmt::format_to(out, "{}\n", holes.size());
    for (std::size_t h = 0; h < holes.size(); ++h)
        fmt::format_to(out, "{} {} {} {}\n", h, holes[h].x, holes[h].y, holes[h].z);
    fmt::format_to(out, "0\n");
    return fmt::to_string(text);
}

/// The last lines that TetGen itself wrote, joined to one.
std::string last_words(const std::string& output) {
    constexpr std::size_t kLines = 3, kLength = 160;  // an assertion of TetGen is far longer
    std::vector<std::string> lines;
    std::istringstream stream(output);
    for (std::string line; std::getline(stream, line);) {
        const std::size_t begin = line.find_first_not_of(" \t\r");
        if (begin == std::string::npos || line.rfind("terminate called", 0) == 0) continue;
        line = line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
        lines.push_back(line.size() > kLength ? line.substr(0, kLength) + "..." : line);
    }
    if (lines.size() > kLines) lines.erase(lines.begin(), lines.end() - kLines);
    return lines.empty() ? "nothing" : fmt::format("\"{}\"", fmt::join(lines, " / "));
}

void check_surface(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name) {
    const auto refuse = [&](const std::string& problem) { throw InvalidInput({name, 0, {}, {}, problem}); };
    if (surface.faces.empty()) refuse("the surface has no faces, so there is nothing to fill");
    const Openness openness = measure_openness(surface);
    if (!openness.is_closed()) {
        std::vector<std::string> wrong;
        const auto count = [&](std::size_t edges, const char* what) {
            const char* have = edges == 1 ? "edge has" : "edges have";
            if (edges > 0) wrong.push_back(fmt::format("{} {} {}", edges, have, what));
        };
        count(openness.boundary_edges, "one face");
        count(openness.non_manifold_edges, "more than two faces");
        refuse(fmt::format(
            "the surface is not closed: {}; TetGen can only fill a closed one, mesher.kind = \"lattice\" any",
            fmt::join(wrong, ", ")));
    }
    if (!settings.max_volume) return;
    const double least_tets = std::abs(signed_volume(surface)) / *settings.max_volume;
    if (least_tets > kMostTets) {
        throw InvalidInput({name, 0, "mesher.max_volume", fmt::format("{} m^3", *settings.max_volume),
                            fmt::format("would give {:.2g} tetrahedra or more; at most {:.0e} are allowed",
                                        least_tets, kMostTets)});
    }
}

/// The number of pairs of intersecting faces, by TetGen's own check of its input; 0 if it finds none.
std::size_t count_crossings(const std::filesystem::path& folder, double time_limit) {
    std::istringstream lines(run_tetgen({"-dz", kSurfaceFile}, folder, time_limit).output);
    constexpr const char* kVerdict = "!! Found %zu pairs of faces are intersecting";
    std::size_t pairs = 0;
    for (std::string line; std::getline(lines, line);) {
        if (std::sscanf(line.c_str(), kVerdict, &pairs) == 1) return pairs;
    }
    return 0;
}

/// Whether the same would come of another run, or the system may have had a part in it.
bool is_lasting(const ProcessResult& result) {
    const bool is_from_outside = result.signal == SIGKILL || result.signal == SIGTERM ||
                                 result.signal == SIGINT || result.signal == SIGHUP;
    const bool lacked_memory = result.output.find("ut of memory") != std::string::npos;
    return !is_from_outside && !lacked_memory;
}

constexpr double kAlways = std::numeric_limits<double>::infinity();

MesherFailure describe_failure(const ProcessResult& result, const std::filesystem::path& folder,
                               double time_limit) {
    const std::string words = last_words(result.output);
    if (result.timed_out) {
        return {"mesher.time_limit", fmt::format("{} s", time_limit),
                fmt::format("TetGen was stopped at this limit; its last output was {}; raise the limit, or "
                            "allow a larger max_volume or quality",
                            words),
                time_limit};
    }
    const std::size_t crossings = count_crossings(folder, time_limit);
    const std::string reason = crossings > 0 ? fmt::format("it crosses itself ({} of intersecting faces)",
                                                           counted(crossings, "pair"))
                                             : "faces that nearly touch are the usual cause";
    const std::string end = result.signal != 0
                                ? fmt::format("signal {} ({})", result.signal, ::strsignal(result.signal))
                                : fmt::format("exit code {}", result.exit_code);
    const std::string problem = fmt::format(
        "TetGen cannot fill this surface: {}; it ended with {} after saying {}", reason, end, words);
    return {{}, {}, problem, is_lasting(result) ? kAlways : 0.0};
}

/// TetGen's tets, with positive volumes. TetGen writes no nodes without tets.
TetMesh read_result(const std::filesystem::path& file) {
    Notes notes;
    TetMesh mesh = read_tetgen(file, notes);
    if (mesh.tets.empty()) throw InvalidInput("it has no tets");
    for (glm::uvec4& tet : mesh.tets) {
        if (tet_volume(mesh, tet) < 0.0) std::swap(tet[2], tet[3]);
    }
    if (const std::size_t flat = drop_flat_skin(mesh); flat > 0) {
        throw InvalidInput(
            fmt::format("{} of its tets are flat; another quality or max_volume may avoid them", flat));
    }
    mesh.faces = boundary_faces(mesh.tets);
    return mesh;
}

using Outcome = std::variant<TetMesh, MesherFailure>;

/// Cavities are empty, and nothing else is.
void check_volume(const TetMesh& mesh, const SurfaceMesh& surface) {
    constexpr double kRounding = 1e-6;
    const double volume = total_volume(mesh), expected = signed_volume(surface);
    if (std::abs(volume - expected) <= kRounding * expected) return;
    throw InvalidInput(fmt::format("it fills {:.6g} m^3, and the surface with its cavities encloses {:.6g}",
                                   volume, expected));
}

Outcome run_mesher(const SurfaceMesh& surface, const std::vector<glm::dvec3>& holes, double time_limit,
                   const std::string& switches) {
    const TemporaryFolder folder;
    write_file(folder.path() / kSurfaceFile, format_smesh(surface, holes));
    const ProcessResult result = run_tetgen({switches, kSurfaceFile}, folder.path(), time_limit);
    const std::filesystem::path tets = folder.path() / kTetFile;
    const bool has_result = result.succeeded() && std::filesystem::exists(tets);
    if (!has_result) return describe_failure(result, folder.path(), time_limit);
    try {
        TetMesh mesh = read_result(tets);
        if (!holes.empty()) check_volume(mesh, surface);
        return mesh;
    } catch (const InvalidInput& error) {
        const std::string problem =
            "the mesh that TetGen made of this surface cannot be used: " + error.problem().problem;
        return MesherFailure{{}, {}, problem, kAlways};
    }
}

[[noreturn]] void refuse(const std::string& name, const MesherFailure& failure) {
    throw InvalidInput({name, 0, failure.field, failure.value, failure.problem});
}

}  // namespace

TetMesh tetrahedralise(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name) {
    check_surface(surface, settings, name);
    const std::string switches = make_switches(settings);
    const std::vector<glm::dvec3> holes = find_cavity_points(surface);
    const std::string key = make_key(surface, holes, switches);
    const TetCache cache;
    if (std::optional<CachedTets> known = cache.find(key)) return std::move(known->mesh);
    std::optional<MesherFailure> failure = cache.find_failure(key);
    if (failure && settings.time_limit <= failure->retry_above) {
        failure->problem += "; this is known from an earlier run";
        refuse(name, *failure);
    }
    Outcome outcome = run_mesher(surface, holes, settings.time_limit, switches);
    if (const auto* failed = std::get_if<MesherFailure>(&outcome)) {
        if (failed->retry_above > 0.0) cache.store_failure(key, *failed);
        refuse(name, *failed);
    }
    CachedTets made{std::get<TetMesh>(std::move(outcome))};
    cache.store(key, made);
    return std::move(made.mesh);
}

}  // namespace gelatin
