#include "sim/export.h"

#include <fmt/core.h>

#include <system_error>
#include <utility>

#include "core/file.h"
#include "core/file_writer.h"
#include "gelatin/error.h"

namespace gelatin {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPvdHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
    "byte_order=\"LittleEndian\">\n<Collection>\n";
constexpr const char* kPvdTail = "</Collection>\n</VTKFile>\n";

const char* ending(ExportFormat format) {
    switch (format) {
        case ExportFormat::obj:
            return "obj";
        case ExportFormat::ply:
            return "ply";
        case ExportFormat::vtu:
            return "vtu";
    }
    return "";
}

std::string content(ExportFormat format, const ExportTopology& topology, const HostFrame& frame) {
    switch (format) {
        case ExportFormat::obj:
            return obj_text(topology, frame);
        case ExportFormat::ply:
            return ply_bytes(topology, frame);
        case ExportFormat::vtu:
            return vtu_text(topology, frame);
    }
    return "";
}

}  // namespace

void prepare_export_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw InvalidInput({folder.string(), 0, {}, {}, "cannot be made: " + error.message()});
    try {
        const ScratchFile attempt(folder);
    } catch (const SystemError& problem) {
        throw InvalidInput(problem.what());
    }
}

FrameExporter::FrameExporter(fs::path folder, ExportFormat format, const Model& model)
    : folder_(std::move(folder)), format_(format), topology_(make_export_topology(model)) {
    if (format_ != ExportFormat::obj || topology_.obj_library.empty()) return;
    write_file(folder_ / kObjLibrary, topology_.obj_library);
    for (const ObjLook::Image& image : topology_.obj_images) write_file(folder_ / image.name, *image.bytes);
}

void FrameExporter::write(const HostFrame& frame) {
    const std::string stem = fmt::format("frame_{:06}.", frame.frame);
    std::vector<std::string> parts{stem + ending(format_)};
    write_file(folder_ / parts[0], content(format_, topology_, frame));
    if (format_ != ExportFormat::vtu) return;
    if (!topology_.vtp_polys.empty()) {
        parts.push_back(stem + "vtp");
        write_file(folder_ / parts[1], vtp_text(topology_, frame));
    }
    list_in_pvd(frame, parts);
}

void FrameExporter::list_in_pvd(const HostFrame& frame, const std::vector<std::string>& parts) {
    const fs::path file = folder_ / "scene.pvd";
    if (!pvd_.is_open()) {
        pvd_.open(file, std::ios::trunc | std::ios::binary);
        pvd_ << kPvdHead;
    } else {
        pvd_.seekp(-static_cast<std::streamoff>(std::string_view(kPvdTail).size()), std::ios::end);
    }
    for (std::size_t p = 0; p < parts.size(); ++p)
        pvd_ << fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", frame.time, p, parts[p]);
    pvd_ << kPvdTail;
    if (!pvd_.flush()) throw SystemError(file.string() + ": cannot be written");
}

}  // namespace gelatin
