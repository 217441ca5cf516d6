#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "gelatin/export.h"
#include "gelatin/scene.h"
#include "gelatin/simulator.h"
#include "gelatin/views.h"

namespace gelatin {

/// high: light at each pixel, smooth edges. fast: light at each vertex, about a tenth of the time on software
/// drivers. automatic: fast on those, high on GPUs.
enum class PictureQuality { automatic, high, fast };

struct PictureOptions {
    int width = 1280, height = 720;  ///< [pixels], >= 1
    PictureQuality quality = PictureQuality::automatic;
    Overlays overlays = {};
    std::optional<CameraDescription> camera = {};  ///< empty: the scene's, or one that shows all of it
};

/// 8-bit sRGB, rows from the top.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  ///< R, G, B of each pixel, shape [height][width][3]
};

/// Draws a simulator's bodies, floor and colliders, as `gelatin run` does.
///
/// Needs the simulator's context: the GL backend, or SimulatorOptions::need_gl. Use it on the simulator's
/// thread. Move-only; the simulator must outlive it and stay where it is in memory.
class GELATIN_API PicturePainter {
public:
    /// Compiles shaders, and sets the camera by the present state, or by all frames of a recording that is
    /// played. @throws NoOpenGl without a context;
    /// InvalidInput for a size or a camera that is not allowed
    explicit PicturePainter(Simulator& simulator, const PictureOptions& options = {});
    PicturePainter(PicturePainter&&) noexcept;
    PicturePainter& operator=(PicturePainter&&) noexcept;
    ~PicturePainter();

    /// @throws InvalidInput as validate() for a scene's
    void set_camera(const CameraDescription& camera);
    void set_overlays(const Overlays& overlays);

    /// The present state.
    Picture paint();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// One picture of the present state. For several, a PicturePainter saves the time of compiling shaders.
/// @throws as PicturePainter
GELATIN_API Picture render_picture(Simulator& simulator, const PictureOptions& options = {});

/// Writes a PNG file, completely or not at all. @throws SystemError if it cannot be written.
GELATIN_API void save_picture(const std::filesystem::path& file, const Picture& picture);

}  // namespace gelatin
