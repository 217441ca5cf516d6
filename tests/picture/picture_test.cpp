#include "gelatin/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <utility>
#include <variant>

#include "core/file.h"
#include "gelatin/error.h"
#include "picture/scene_painter.h"
#include "render/frame_grabber.h"
#include "render/image.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

using PictureTest = test::SimulatorFixture;

PictureOptions small() {
    PictureOptions options;
    options.width = 120;
    options.height = 80;
    return options;
}

TEST_F(PictureTest, IsWhatTheCommandLineDraws) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(test::falling_balls(), on(backend));
        simulator.advance_frame();
        for (const PictureQuality quality : {PictureQuality::fast, PictureQuality::high}) {
            PictureOptions options = small();
            options.quality = quality;
            const Picture picture = render_picture(simulator, options);
            EXPECT_EQ(picture.width, 120);
            EXPECT_EQ(picture.height, 80);
            ASSERT_EQ(picture.pixels.size(), 3u * 120u * 80u);
            ScenePainter painter(
                simulator, {120, 80},
                quality == PictureQuality::fast ? render::Quality::fast : render::Quality::high);
            render::FrameGrabber grabber(120, 80);
            painter.draw();
            grabber.grab(painter.framebuffer());
            EXPECT_EQ(picture.pixels, grabber.flush()->pixels);
            EXPECT_NE(*std::min_element(picture.pixels.begin(), picture.pixels.end()),
                      *std::max_element(picture.pixels.begin(), picture.pixels.end()));
        }
    }
}

TEST_F(PictureTest, APainterFollowsTheStateTheCameraAndTheOverlays) {
    Simulator simulator(test::falling_balls(), on(Backend::cpu));
    PicturePainter painter(simulator, small());
    const Picture first = painter.paint();
    EXPECT_EQ(painter.paint().pixels, first.pixels);
    EXPECT_EQ(render_picture(simulator, small()).pixels, first.pixels);
    for (int f = 0; f < 30; ++f) simulator.advance_frame();
    const Picture later = painter.paint();
    EXPECT_NE(later.pixels, first.pixels);
    Overlays overlays;
    overlays.wireframe = true;
    painter.set_overlays(overlays);
    EXPECT_NE(painter.paint().pixels, later.pixels);
    painter.set_overlays({});
    EXPECT_EQ(painter.paint().pixels, later.pixels);
    const CameraDescription camera{{3.0, 2.0, 1.0}, {0.0, 0.5, 0.0}, 50.0};
    painter.set_camera(camera);
    const Picture aside = painter.paint();
    EXPECT_NE(aside.pixels, later.pixels);
    PictureOptions options = small();
    options.camera = camera;
    Simulator again(test::falling_balls(), on(Backend::cpu));
    for (int f = 0; f < 30; ++f) again.advance_frame();
    EXPECT_EQ(render_picture(again, options).width, aside.width);
}

TEST_F(PictureTest, IsWrittenAsPng) {
    const TemporaryFolder folder;
    Simulator simulator(test::falling_balls(), on(Backend::cpu));
    const Picture picture = render_picture(simulator, small());
    save_picture(folder.path() / "a.png", picture);
    EXPECT_EQ(render::read_png(folder.path() / "a.png").pixels, picture.pixels);
    EXPECT_THROW(save_picture(folder.path() / "nowhere" / "a.png", picture), SystemError);
}

TEST_F(PictureTest, NeedsAContextAndASize) {
    SimulatorOptions blind;
    blind.backend = Backend::cpu;
    Simulator simulator(test::falling_balls(), blind);
    EXPECT_THROW(render_picture(simulator), NoOpenGl);
    Simulator seeing(test::falling_balls(), on(Backend::cpu));
    PictureOptions options;
    options.width = 0;
    EXPECT_THROW(render_picture(seeing, options), InvalidInput);
}

// Beside that of the same scene without the room, seen from the same place: its floor and its far walls are
// drawn, its near walls hide nothing, and its lid keeps no light from it.
TEST_F(PictureTest, ShowsARoomAroundBodies) {
    for (const Axis up : {Axis::y, Axis::z}) {
        Scene scene = test::falling_balls();
        scene.up = up;
        scene.collision.response = CollisionResponse::contact;
        scene.simulation.solver = SolverKind::vbd;
        Scene empty = scene;
        ColliderDescription room;
        room.shape = Shape{BoxShape{glm::dvec3(4.0)}};
        room.position = scene.objects.front().position;
        scene.colliders = {room};
        empty.colliders.clear();
        Simulator within(scene, on(Backend::cpu)), alone(empty, on(Backend::cpu));
        PictureOptions options = small();
        const render::Camera camera = Shown(within).camera(1.5f);
        options.camera = CameraDescription{glm::dvec3(camera.eye), glm::dvec3(camera.target),
                                           static_cast<double>(camera.field_of_view)};
        for (const PictureQuality quality : {PictureQuality::fast, PictureQuality::high}) {
            options.quality = quality;
            const Picture one = render_picture(within, options), two = render_picture(alone, options);
            std::size_t bodies = 0, seen = 0, walls = 0, dark = 0;
            for (std::size_t p = 0; p < one.pixels.size(); p += 3) {
                const auto is_body = [&](const Picture& picture) {
                    const auto [low, high] =
                        std::minmax({picture.pixels[p], picture.pixels[p + 1], picture.pixels[p + 2]});
                    return high - low > 80;
                };
                bodies += is_body(two);
                seen += is_body(one) && is_body(two);
                if (is_body(one) || std::abs(one.pixels[p] - two.pixels[p]) <= 8) continue;
                ++walls;
                dark += one.pixels[p] < 70;
            }
            EXPECT_GT(bodies, 50u);
            EXPECT_GT(seen, bodies * 9 / 10);
            EXPECT_GT(walls, one.pixels.size() / 3 / 4);
            EXPECT_LT(dark, walls / 10);
        }
    }
}

// The same scene with z up, every overlay in it.
TEST_F(PictureTest, ShowsASceneAlikeWhicheverAxisPointsUp) {
    Scene scene = test::falling_balls();
    ColliderDescription ramp;
    ramp.shape = PlaneCollider{glm::normalize(glm::dvec3(1.0, 2.0, 0.5)), -0.5};
    scene.colliders.push_back(ramp);
    ColliderDescription post;
    post.shape = CapsuleShape{.radius = 0.1, .length = 0.5};
    post.position = {0.7, 0.2, 0.4};
    scene.colliders.push_back(post);
    scene.simulation.solver = SolverKind::semi_implicit_euler;
    const auto turned = [](const glm::dvec3& v) { return glm::dvec3(v.x, -v.z, v.y); };
    Scene other = scene;
    other.up = Axis::z;
    for (ObjectDescription& object : other.objects) {
        object.position = turned(object.position);
        object.velocity = turned(object.velocity);
    }
    for (ColliderDescription& collider : other.colliders) {
        collider.position = turned(collider.position);
        if (auto* plane = std::get_if<PlaneCollider>(&collider.shape)) plane->normal = turned(plane->normal);
    }
    std::vector<Overlays> all(7);
    all[1].box_levels = 0;  // trees are divided by the axes
    all[2].wireframe = all[2].objects = true;
    all[3].arrow_time = 0.1f;
    all[4].cut = CutPlane{{0.3f, 0.2f, 1.0f}, 0.1f};
    all[5].full_strain = 0.02f;
    all[6].color_map = ColorMap{Quantity::stress, 1e3f};
    for (const PictureQuality quality : {PictureQuality::fast, PictureQuality::high}) {
        for (std::size_t k = 0; k < all.size(); ++k) {
            PictureOptions options = small();
            options.quality = quality;
            options.overlays = all[k];
            Simulator a(scene, on(Backend::cpu)), b(other, on(Backend::cpu));
            a.advance_frame();
            b.advance_frame();
            const Picture one = render_picture(a, options);
            if (auto& cut = options.overlays.cut) {
                std::swap(cut->normal[1], cut->normal[2]);
                cut->normal[1] = -cut->normal[1];
            }
            const Picture two = render_picture(b, options);
            std::size_t different = 0;
            for (std::size_t p = 0; p < one.pixels.size(); ++p)
                different += std::abs(one.pixels[p] - two.pixels[p]) > 8;
            EXPECT_LT(different, one.pixels.size() / 200) << "overlay " << k;
        }
    }
}

}  // namespace
}  // namespace gelatin
