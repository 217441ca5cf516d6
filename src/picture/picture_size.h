#pragma once

namespace gelatin {

/// Pixels.
struct PictureSize {
    int width = 1280;
    int height = 720;
};

}  // namespace gelatin
