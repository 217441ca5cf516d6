#include "render/up_axis.h"

#include "render/renderer_fixture.h"

namespace gelatin::render {
namespace {

TEST(UpAxis, IsTurnedAndBack) {
    EXPECT_EQ(to_y_up(glm::vec3(1, 2, 3), Axis::z), glm::vec3(1, 3, -2));
    EXPECT_EQ(to_y_up(glm::vec3(1, 2, 3), Axis::y), glm::vec3(1, 2, 3));
    const Bounds bounds{{-1, -2, -3}, {4, 5, 6}};
    EXPECT_EQ(to_y_up(bounds, Axis::z), (Bounds{{-1, -3, -5}, {4, 6, 2}}));
    EXPECT_EQ(from_y_up(to_y_up(bounds, Axis::z), Axis::z), bounds);
    const Camera camera{{1, 2, 3}, {4, 5, 6}, 40.0f};
    EXPECT_EQ(from_y_up(to_y_up(camera, Axis::z), Axis::z), camera);
}

using UpAxisTest = RendererTest;

// The vertices of a picture are the same, to the last bit.
TEST_F(UpAxisTest, ASceneWithZUpHasTheSamePicture) {
    for (const Quality quality : {Quality::high, Quality::fast}) {
        Studio studio = ball_and_box();
        studio.options.quality = quality;
        studio.surroundings.props = {sphere_at({-0.8, 0.2, 0.5}, 0.25)};
        Studio turned = studio;
        turned.surroundings.up = Axis::z;
        turned.surroundings.bounds = from_y_up(studio.surroundings.bounds, Axis::z);
        turned.camera = from_y_up(studio.camera, Axis::z);
        for (std::vector<SurfaceMesh>* meshes : {&turned.bodies, &turned.surroundings.props})
            for (SurfaceMesh& mesh : *meshes)
                for (glm::dvec3& p : mesh.positions) p = {p.x, -p.z, p.y};
        EXPECT_EQ(different_fraction(picture_of(studio), picture_of(turned)), 0.0);
        EXPECT_GT(red_fraction(picture_of(turned)), 0.01);
    }
}

// A renderer that has drawn z-up scenes draws others as before.
TEST_F(UpAxisTest, GoesWithTheSurroundings) {
    const Studio studio = ball_and_box();
    Renderer renderer(studio.options);
    Surroundings turned = studio.surroundings;
    turned.up = Axis::z;
    const StaticMesh bodies(studio.bodies);
    for (const Surroundings& surroundings : {studio.surroundings, turned, studio.surroundings}) {
        renderer.set_surroundings(surroundings);
        renderer.draw(bodies.view(), studio.camera);
    }
    FrameGrabber grabber(renderer.width(), renderer.height());
    grabber.grab(renderer.framebuffer());
    EXPECT_EQ(grabber.flush()->pixels, picture_of(studio).pixels);
}

}  // namespace
}  // namespace gelatin::render
