#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesh/shapes.h"
#include "render/frame_grabber.h"
#include "render/renderer.h"
#include "support/gl_fixture.h"
#include "support/image_compare.h"

namespace gelatin::render {

inline constexpr int kOverlayWidth = 320, kOverlayHeight = 240;
inline constexpr Camera kCamera{{0.0f, 1.0f, 4.0f}, {0.0f, 0.5f, 0.0f}, 35.0f};

// Where a point in space is in the picture [pixels].
inline glm::vec2 project(const glm::vec3& point) {
    const float aspect = static_cast<float>(kOverlayWidth) / kOverlayHeight;
    const glm::vec4 clip = kCamera.projection(aspect) * kCamera.view() * glm::vec4(point, 1.0f);
    return {(0.5f + 0.5f * clip.x / clip.w) * kOverlayWidth,
            (0.5f - 0.5f * clip.y / clip.w) * kOverlayHeight};
}

inline glm::dvec3 color_at(const Image& image, const glm::vec3& point) {
    const glm::ivec2 pixel(project(point));
    return test::mean_color(image, pixel.x, pixel.y, 1, 1);
}

inline double lightness(const glm::dvec3& color) {
    return (color.r + color.g + color.b) / 3.0;
}

// A green ball over a floor, with what an overlay shows of it in buffers of the test's own.
class OverlayTest : public test::GlTest, public ::testing::WithParamInterface<Quality> {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        SurfaceMesh ball = make_sphere({0.4, 8});
        for (glm::dvec3& p : ball.positions) p.y += 0.6;
        surfaces_ = {ball};
        body_ = StaticMesh(surfaces_);
        view_ = body_.view();
        renderer_.emplace(
            RendererOptions{.width = kOverlayWidth, .height = kOverlayHeight, .quality = GetParam()});
        renderer_->set_surroundings({.bounds = {{-0.5f, 0.0f, -0.5f}, {0.5f, 1.1f, 0.5f}},
                                     .floor_height = 0.0f,
                                     .props = {},
                                     .colors = {{0.05f, 0.4f, 0.1f}}});
    }

    Image draw(const OverlayView& overlay = {}) {
        view_.overlay = overlay;
        view_.overlay.node_positions = view_.node_positions;  // the surface's points are nodes
        view_.overlay.node_count = view_.node_count;
        renderer_->draw(view_, kCamera);
        FrameGrabber grabber(kOverlayWidth, kOverlayHeight);
        grabber.grab(renderer_->framebuffer());
        return *grabber.flush();
    }

    template <class T>
    static gl::Buffer<T> buffer_of(const std::vector<T>& values) {
        return gl::Buffer<T>(std::span<const T>(values));
    }

    std::vector<SurfaceMesh> surfaces_;
    StaticMesh body_;
    RenderView view_;
    std::optional<Renderer> renderer_;
};

/// Names of the parameter.
inline const auto name_of_quality = [](const auto& test) {
    return std::string(test.param == Quality::high ? "High" : "Fast");
};
inline const auto kQualities = ::testing::Values(Quality::high, Quality::fast);

}  // namespace gelatin::render
