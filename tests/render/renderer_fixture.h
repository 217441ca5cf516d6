#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/vec2.hpp>
#include <vector>

#include "mesh/shapes.h"
#include "render/frame_grabber.h"
#include "render/renderer.h"
#include "support/gl_fixture.h"
#include "support/image_compare.h"

namespace gelatin::render {

/// Of pictures [pixels].
inline constexpr int kWidth = 160;
inline constexpr int kHeight = 120;

inline SurfaceMesh sphere_at(const glm::dvec3& center, double radius = 0.5) {
    SurfaceMesh mesh = make_sphere({radius, 12});
    for (glm::dvec3& p : mesh.positions) p += center;
    return mesh;
}

/// A red ball of radius 0.5 over the floor, seen from the front and somewhat above.
struct Studio {
    std::vector<SurfaceMesh> bodies = {sphere_at({0.0, 0.6, 0.0})};
    Surroundings surroundings{.bounds = {{-0.5f, 0.0f, -0.5f}, {0.5f, 1.1f, 0.5f}},
                              .floor_height = 0.0f,
                              .props = {},
                              .colors = {{0.8f, 0.05f, 0.05f}}};
    Camera camera{{0.0f, 1.2f, 4.0f}, {0.0f, 0.5f, 0.0f}, 35.0f};
    RendererOptions options{.width = kWidth, .height = kHeight, .quality = Quality::high};
};

/// A test that examines finished pictures.
class RendererTest : public test::GlTest {
protected:
    static Image picture_of(const Studio& studio) {
        Renderer renderer(studio.options);
        renderer.set_surroundings(studio.surroundings);
        const StaticMesh bodies(studio.bodies);
        renderer.draw(bodies.view(), studio.camera);
        FrameGrabber grabber(renderer.width(), renderer.height());
        grabber.grab(renderer.framebuffer());
        return *grabber.flush();
    }

    static Studio ball_and_box() {
        Studio studio;
        studio.options.width = 320;
        studio.options.height = 180;
        studio.bodies.push_back(make_box({glm::dvec3(0.5), glm::ivec3(2)}));
        for (glm::dvec3& p : studio.bodies.back().positions) p += glm::dvec3(1.0, 0.25, 0.0);
        studio.surroundings.bounds.max.x = 1.3f;
        studio.camera = frame_bounds(studio.surroundings.bounds, 320.0f / 180.0f);
        return studio;
    }

    static double brightness(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3.0; }

    // Where a point in space is in the picture.
    static glm::ivec2 pixel_of(const Camera& camera, const glm::vec3& point) {
        const float aspect = static_cast<float>(kWidth) / kHeight;
        const glm::vec4 clip = camera.projection(aspect) * camera.view() * glm::vec4(point, 1.0f);
        return {static_cast<int>((0.5f + 0.5f * clip.x / clip.w) * kWidth),
                static_cast<int>((0.5f - 0.5f * clip.y / clip.w) * kHeight)};
    }

    static double brightness_at(const Image& image, const glm::ivec2& pixel) {
        return brightness(test::mean_color(image, pixel.x - 1, pixel.y - 1, 3, 3));
    }

    static bool is_red(const std::uint8_t* pixel) {
        return pixel[0] > 2 * pixel[1] && pixel[0] > 2 * pixel[2];
    }

    static double different_fraction(const Image& a, const Image& b) {
        int different = 0;
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x) different += std::abs(a.at(x, y)[1] - b.at(x, y)[1]) > 30;
        }
        return static_cast<double>(different) / (a.width * a.height);
    }

    static double red_fraction(const Image& image) {
        int red = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) red += is_red(image.at(x, y));
        }
        return static_cast<double>(red) / (image.width * image.height);
    }
};

}  // namespace gelatin::render
