#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "sim/export_formats.h"

namespace gelatin {

enum class ExportFormat { obj, ply, vtu };

/// Creates `folder` if necessary and tests it, so that a run does not fail after hours.
/// @throws InvalidInput if it cannot be created, is a file, or cannot be written into.
void prepare_export_folder(const std::filesystem::path& folder);

/// Writes frames as frame_000000.obj (.ply, .vtu) and so on, each file completely or not at all. With .vtu
/// also scene.pvd, the list of frames and their times that ParaView opens, complete after every frame; and,
/// if an object has a skin, frame_000000.vtp with the skins, which the list has as a second part.
class FrameExporter {
public:
    /// Writes scene.mtl and its images, if the format is OBJ and surfaces have materials.
    /// @param folder one that `prepare_export_folder` has accepted @throws SystemError if it cannot be
    /// written
    FrameExporter(std::filesystem::path folder, ExportFormat format, const Model& model);

    /// @throws SystemError if it cannot be written.
    void write(const HostFrame& frame);

private:
    void list_in_pvd(const HostFrame& frame, const std::vector<std::string>& parts);

    std::filesystem::path folder_;
    ExportFormat format_;
    ExportTopology topology_;
    std::ofstream pvd_;
};

}  // namespace gelatin
