#pragma once

#include <bitset>

namespace gelatin::gl {

/// Restores the framebuffers and the viewport of the application that uses this library.
class FramebufferGuard {
public:
    FramebufferGuard();
    FramebufferGuard(const FramebufferGuard&) = delete;
    FramebufferGuard& operator=(const FramebufferGuard&) = delete;
    ~FramebufferGuard();

private:
    int draw_ = 0;
    int read_ = 0;
    int viewport_[4] = {};
};

/// Sets the state that decides which fragments of filled triangles are written, whatever the application has
/// set, and restores the application's settings: framebuffers, viewport, vertex array, the source of indirect
/// draws, masks, depth range and function, and the switches of all tests, which are off in between.
class DrawStateGuard {
public:
    DrawStateGuard();
    DrawStateGuard(const DrawStateGuard&) = delete;
    DrawStateGuard& operator=(const DrawStateGuard&) = delete;
    ~DrawStateGuard();

private:
    FramebufferGuard framebuffers_;
    std::bitset<32> switches_;
    int vertex_array_ = 0;
    int indirect_buffer_ = 0;
    int polygon_mode_ = 0;
    int depth_function_ = 0;
    double depth_range_[2] = {};
    unsigned char depth_mask_ = 0;
    unsigned char color_mask_[4] = {};
};

}  // namespace gelatin::gl
