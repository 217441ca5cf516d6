// Overlays of bodies from the simulator, as they once looked.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "gelatin/simulator.h"
#include "render/image.h"
#include "render/overlay_fixture.h"
#include "support/source_path.h"

namespace gelatin::render {
namespace {

// A block out of shape that spins, and a ball at rest: which of a ball's nodes have arrows depends on its
// mesh, and that on the compiler.
Scene block_and_ball() {
    Scene scene;
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    ObjectDescription block;
    block.name = "block";
    block.shape = BoxShape{{0.9, 0.5, 0.5}, {6, 4, 4}};
    block.material = "jelly";
    block.position = {-0.25, 0.5, 0.0};
    block.start = {.scale = {1.0, 1.2, 1.0}, .scatter = 0.02};
    block.spin = {0.0, 200.0, 0.0};
    scene.objects.push_back(block);
    ObjectDescription ball;
    ball.name = "ball 2";
    ball.shape = SphereShape{0.25, 6};
    ball.material = "jelly";
    ball.position = {0.65, 0.5, 0.1};
    scene.objects.push_back(ball);
    return scene;
}

struct Case {
    const char* name;
    Overlays overlays;
};
const Case kCases[] = {
    {"overlay_cut",
     {.color_map = ColorMap{Quantity::stress, {}},
      .cut = CutPlane{{0.0f, 0.2f, 1.0f}, 0.2f},
      .wireframe = true}},
    {"overlay_objects", {.box_levels = 1, .lowest_boxes_alone = true, .arrow_time = 0.15f, .objects = true}},
};

class OverlayReferenceTest : public test::GlTest, public ::testing::WithParamInterface<Quality> {};
INSTANTIATE_TEST_SUITE_P(Qualities, OverlayReferenceTest, kQualities, name_of_quality);

TEST_P(OverlayReferenceTest, LooksAsItDidOnEitherBackend) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        Simulator simulator(block_and_ball(), options);
        Renderer renderer({.width = kOverlayWidth, .height = kOverlayHeight, .quality = GetParam()});
        renderer.set_surroundings({.bounds = {{-0.8f, 0.0f, -0.4f}, {0.9f, 1.0f, 0.4f}},
                                   .floor_height = 0.0f,
                                   .props = {},
                                   .colors = {}});
        for (const auto& [name, overlays] : kCases) {
            renderer.draw(simulator.render_view(overlays), {{0.3f, 1.3f, 3.2f}, {0.1f, 0.5f, 0.0f}, 35.0f});
            FrameGrabber grabber(kOverlayWidth, kOverlayHeight);
            grabber.grab(renderer.framebuffer());
            const Image image = *grabber.flush();
            const std::string ending = GetParam() == Quality::fast ? "_fast.png" : ".png";
            const auto file =
                std::filesystem::path(test::source_path("tests/render/references")) / (name + ending);
            if (std::getenv("GELATIN_UPDATE_REFERENCES") != nullptr) write_png(file, image);
            EXPECT_LT(test::perceptual_difference(image, read_png(file)), 1.0)
                << name << ": if the new picture is better, set GELATIN_UPDATE_REFERENCES=1 once";
        }
    }
}

}  // namespace
}  // namespace gelatin::render
