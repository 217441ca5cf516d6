// Bodies with textures from the simulator.
#include <glm/geometric.hpp>

#include "core/file.h"
#include "gelatin/simulator.h"
#include "render/image.h"
#include "render/overlay_fixture.h"
#include "sim/simulator_internals.h"
#include "support/source_path.h"

namespace gelatin::render {
namespace {

constexpr Camera kEye{{0.4f, 0.9f, 3.2f}, {0.0f, 0.55f, 0.0f}, 35.0f};
const glm::dvec3 kQuarters[2][2] = {{{230, 20, 20}, {20, 200, 20}},
                                    {{20, 40, 230}, {230, 200, 20}}};  // from below

// A bar whose front shows four quarters of a picture, with coordinates by place.
void write_bar(const std::filesystem::path& folder) {
    Image picture(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            for (int k = 0; k < 3; ++k)
                picture.at(x, y)[k] = static_cast<std::uint8_t>(kQuarters[y < 32 ? 1 : 0][x < 32 ? 0 : 1][k]);
        }
    }
    write_png(folder / "bar.png", picture);
    write_file(folder / "bar.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd bar.png\n");
    const glm::dvec3 size(1.2, 0.6, 0.4);
    const SurfaceMesh box = make_box({size, {24, 12, 8}});
    std::string obj = "mtllib bar.mtl\nusemtl paint\n";
    for (const glm::dvec3& p : box.positions) {
        const glm::dvec3 at = p / size + 0.5;
        obj += fmt::format("v {} {} {}\nvt {} {}\n", p.x, p.y, p.z, at.x, at.y);
    }
    for (const glm::uvec3& f : box.faces)
        obj += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", f.x + 1, f.y + 1, f.z + 1);
    write_file(folder / "bar.obj", obj);
}

// Pressed together along its length, and thrown round by its spin.
Scene bar_scene(const std::filesystem::path& folder) {
    Scene scene;
    scene.simulation.gravity = {0, 0, 0};
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    scene.materials[0].youngs_modulus = 2e4;
    ObjectDescription bar;
    bar.name = "bar";
    bar.shape = FileShape{folder / "bar.obj"};
    bar.mesher.kind = MesherKind::lattice;
    bar.mesher.nodes = 300;
    bar.material = "jelly";
    bar.position = {0, 0.6, 0};
    bar.start.scale = {0.9, 1.1, 1.0};
    bar.spin = {0, 0, 150};
    bar.pins = {BoxRegion{{-0.7, 0.2, -0.3}, {-0.45, 1.0, 0.3}}};
    scene.objects.push_back(bar);
    return scene;
}

class TexturedSkinTest : public test::GlTest, public ::testing::WithParamInterface<Quality> {
protected:
    Simulator simulate(Backend backend) const {
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        Simulator simulator(bar_scene(folder_.path()), options);
        for (int f = 0; f < 12; ++f) simulator.advance_frame();
        return simulator;
    }
    Image picture_of(Simulator& simulator, const Overlays& overlays) const {
        return picture_of(simulator, glm::vec3(-1.0f), overlays);
    }
    Image picture_of(Simulator& simulator, const glm::vec3& color = glm::vec3(-1.0f),
                     const Overlays& overlays = {}) const {
        Renderer renderer({.width = kOverlayWidth, .height = kOverlayHeight, .quality = GetParam()});
        renderer.set_surroundings({.bounds = {{-0.7f, 0.0f, -0.3f}, {0.7f, 1.0f, 0.3f}},
                                   .floor_height = 0.0f,
                                   .props = {},
                                   .colors = {color}});
        renderer.draw(simulator.render_view(overlays), kEye);
        FrameGrabber grabber(kOverlayWidth, kOverlayHeight);
        grabber.grab(renderer.framebuffer());
        return *grabber.flush();
    }

    void SetUp() override {
        GlTest::SetUp();
        write_bar(folder_.path());
    }

    TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Qualities, TexturedSkinTest, kQualities, name_of_quality);

glm::ivec2 pixel_of(const glm::vec3& point) {
    const glm::vec4 clip = kEye.projection(static_cast<float>(kOverlayWidth) / kOverlayHeight) * kEye.view() *
                           glm::vec4(point, 1.0f);
    return {(0.5f + 0.5f * clip.x / clip.w) * kOverlayWidth,
            (0.5f - 0.5f * clip.y / clip.w) * kOverlayHeight};
}

// Whichever of the three is weak in the picture is weak in the quarter's colour.
bool has_hue(const glm::dvec3& shown, const glm::dvec3& quarter) {
    for (int k = 0; k < 3; ++k) {
        for (int other = 0; other < 3; ++other) {
            if (quarter[k] - quarter[other] > 100.0 && shown[k] - shown[other] < 30.0) return false;
        }
    }
    return true;
}

TEST_P(TexturedSkinTest, ThePictureMovesWithTheSurface) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator = simulate(backend);
        const Model& model = model_of(simulator);
        const Image image = picture_of(simulator);
        const HostFrame frame = simulator.read_frame();
        const std::vector<float> points =
            carry_skin(model.skin.points, std::span<const float>(frame.positions));
        const glm::dvec3 size(1.2, 0.6, 0.4);
        const SurfaceMesh box = make_box({size, {24, 12, 8}});
        int tested = 0;
        float bent = 0.0f;
        for (std::size_t p = 0; p < model.skin.points.size(); ++p) {
            const glm::vec4 rest =
                carry_skin(std::span(&model.skin.points[p], 1), std::span(model.positions))[0];
            const glm::dvec3 at = glm::dvec3(rest.x, rest.y - 0.6f, rest.z) / size + 0.5;
            const glm::vec3 now(points[3 * p], points[3 * p + 1], points[3 * p + 2]);
            bent = std::max(bent, glm::distance(now, glm::vec3(rest)));
            const bool is_in_a_quarter =
                std::abs(std::abs(at.x - 0.5) - 0.25) < 0.15 && std::abs(std::abs(at.y - 0.5) - 0.25) < 0.12;
            if (at.z < 0.999 || !is_in_a_quarter) continue;
            const glm::ivec2 pixel = pixel_of(now);
            ASSERT_TRUE(pixel.x >= 0 && pixel.x < kOverlayWidth && pixel.y >= 0 && pixel.y < kOverlayHeight);
            const glm::dvec3 quarter = kQuarters[at.y > 0.5 ? 1 : 0][at.x > 0.5 ? 1 : 0];
            EXPECT_TRUE(has_hue(test::mean_color(image, pixel.x, pixel.y, 1, 1), quarter))
                << at.x << ' ' << at.y;
            ++tested;
        }
        EXPECT_GT(tested, 40);
        EXPECT_GT(bent, 0.2f);
    }
}

TEST_P(TexturedSkinTest, LooksAsItDidOnEitherBackend) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator = simulate(backend);
        const Image image = picture_of(simulator);
        const std::string name = GetParam() == Quality::fast ? "textured_skin_fast.png" : "textured_skin.png";
        const auto file = std::filesystem::path(test::source_path("tests/render/references")) / name;
        if (std::getenv("GELATIN_UPDATE_REFERENCES") != nullptr) write_png(file, image);
        EXPECT_LT(test::perceptual_difference(image, read_png(file)), 1.0)
            << "if the new picture is better, set GELATIN_UPDATE_REFERENCES=1 once";
    }
}

// A material without an image is lit like an object of its colour.
TEST_P(TexturedSkinTest, OneColorLooksLikeAnObjectsOwn) {
    write_file(folder_.path() / "bar.mtl", "newmtl paint\nKd 0.8 0.4 0.3\n");
    Simulator textured = simulate(Backend::cpu);
    ASSERT_FALSE(model_of(textured).skin.look.is_empty());
    Scene scene = bar_scene(folder_.path());
    scene.objects[0].color = glm::dvec3(0.6038, 0.1329, 0.0732);
    SimulatorOptions options;
    options.backend = Backend::cpu;
    options.use_current_context = true;
    Simulator plain(scene, options);
    ASSERT_TRUE(model_of(plain).skin.look.is_empty());
    for (int f = 0; f < 12; ++f) plain.advance_frame();
    const Image expected = picture_of(plain, glm::vec3(*scene.objects[0].color));
    EXPECT_LT(test::perceptual_difference(picture_of(textured), expected), 0.5);
}

// A cut leaves the texture on what is left; objects are distinguished by colours alone.
TEST_P(TexturedSkinTest, OverlaysKeepOrReplaceTheTexture) {
    Simulator simulator = simulate(Backend::cpu);
    const auto colorful = [&](const Image& image) {  // pixels of the picture's green quarter
        int count = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const std::uint8_t* p = image.at(x, y);
                count += p[1] > p[0] + 60 && p[1] > p[2] + 60 ? 1 : 0;
            }
        }
        return count;
    };
    const int whole = colorful(picture_of(simulator));
    EXPECT_GT(whole, 300);
    const int cut = colorful(picture_of(simulator, {.cut = CutPlane{{0.0f, 1.0f, 0.0f}, 0.45f}}));
    EXPECT_GT(cut, 50);
    EXPECT_LT(cut, whole);
    EXPECT_LT(colorful(picture_of(simulator, {.objects = true})), 50);
    EXPECT_LT(colorful(picture_of(simulator, {.full_strain = 0.1f})), 50);
}

}  // namespace
}  // namespace gelatin::render
