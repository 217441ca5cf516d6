#include <epoxy/gl.h>

#include <glm/geometric.hpp>
#include <thread>

#include "gl/context.h"
#include "gl/debug.h"
#include "render/image.h"
#include "support/run_program.h"
#include "support/shader_folder.h"
#include "support/source_path.h"
#include "viewer/support/drop_files.h"
#include "viewer/support/window_test.h"

namespace gelatin::test {
namespace {

TEST_F(WindowHeavy, PlaysPausesStepsAndGoesBack) {
    open(two_cubes());
    draw_until([&] { return session().time() > 0.1; });
    press("space");
    ASSERT_FALSE(session().is_playing());
    draw_until([&] { return !session().is_computing(); });
    draw(2);
    const double paused = session().time();
    draw(5);
    EXPECT_EQ(session().time(), paused);

    press("period");
    draw_until([&] { return session().time() > paused; });
    draw(2);
    EXPECT_NEAR(session().time(), paused + 0.01, 1e-9);
    press("Right");
    draw_until([&] { return session().time() > paused + 0.015; });
    draw(2);
    EXPECT_NEAR(session().time(), paused + 0.03, 1e-9);

    press("r");
    draw_until([&] { return session().time() == 0.0; });
    EXPECT_EQ(session().simulator().frame(), 0);
    press("space");
    draw_until([&] { return session().time() > 0.02; });
}

TEST_F(WindowHeavy, SlowMotionIsSlow) {
    open(two_cubes());
    for (int i = 0; i < 3; ++i) press("minus");
    EXPECT_EQ(session().pace().speed(), 0.125);
    const double start = session().time(), now = window().now();
    draw_until([&] { return window().now() > now + 0.8; });
    EXPECT_NEAR(session().time() - start, 0.1, 0.05);
    press("plus");
    EXPECT_EQ(session().pace().speed(), 0.25);
}

TEST_F(WindowHeavy, PicturesAreFastOnSoftwareDriversUnlessAskedFor) {
    open(two_cubes());
    const bool is_software = gl::Context::current().device().is_software;
    EXPECT_STREQ(app().panels().quality, is_software ? "fast" : "high");
    for (const auto& [quality, name] :
         {std::pair(render::Quality::high, "high"), std::pair(render::Quality::fast, "fast")}) {
        close();
        open(two_cubes(), Backend::automatic, quality);
        EXPECT_STREQ(app().panels().quality, name);
    }
}

TEST_F(WindowHeavy, MouseTurnsMovesAndZoomsTheView) {
    open(two_cubes());
    press("space");
    const render::Camera start = app().camera().camera();
    // On the floor, where no body is.
    act({"mousemove", "500", "400", "mousedown", "1", "mousemove", "600", "400", "mouseup", "1"});
    draw(3);
    const render::Camera turned = app().camera().camera();
    EXPECT_EQ(turned.target, start.target);
    EXPECT_GT(glm::distance(turned.eye, start.eye), 1.0f);
    EXPECT_NEAR(glm::distance(turned.eye, turned.target), glm::distance(start.eye, start.target), 1e-4f);

    act({"mousemove", "300", "300", "mousedown", "3", "mousemove", "330", "280", "mouseup", "3"});
    draw(3);
    const render::Camera moved = app().camera().camera();
    EXPECT_GT(glm::distance(moved.target, turned.target), 0.1f);

    act({"click", "4", "click", "4"});
    draw(3);
    const render::Camera nearer = app().camera().camera();
    EXPECT_LT(glm::distance(nearer.eye, nearer.target), 0.9f * glm::distance(moved.eye, moved.target));

    press("f");
    const render::Camera all = app().camera().camera();
    EXPECT_NEAR(all.target.x, 0.625f,
                0.05f);  // from the left of the large cube to the right of the small one
}

// The picture has a body's colour there.
bool is_orange(const render::Image& image, int x, int y) {
    const std::uint8_t* p = image.at(x, y);
    return p[0] > p[2] + 60;
}

TEST_F(WindowHeavy, FollowsItsSize) {
    open(two_cubes());
    press("space");
    EXPECT_TRUE(is_orange(picture(), kWidth / 2, kHeight / 2));
    act({"search", "--name", "Gelatin", "windowsize", "800", "300"});
    draw_until([&] { return window().pixels() == glm::ivec2(800, 300); });
    draw(2);
    const render::Image wide = picture();
    EXPECT_TRUE(is_orange(wide, 400, 150));
    EXPECT_FALSE(is_orange(wide, 330, 250));
}

TEST_F(WindowHeavy, OnADenseScreenAllIsLarger) {
    VirtualDisplay::instance().set_density(192);
    open(two_cubes());
    VirtualDisplay::instance().set_density(96);
    EXPECT_EQ(window().scale(), 2.0f);
    EXPECT_EQ(window().pixels(), glm::ivec2(2 * kWidth, 2 * kHeight));
    press("space");
    draw(3);
    const render::Image large = picture();
    if (const char* folder = std::getenv("GELATIN_KEEP_PICTURES"))
        render::write_png(std::filesystem::path(folder) / "dense.png", large);
    // The panel's title bar is blue where it begins at the usual density and at this one.
    const std::uint8_t* title = large.at(2 * (kWidth - 310) + 60, 2 * 12 + 4);
    EXPECT_GT(title[2], title[0] + 40);
}

TEST_F(WindowHeavy, KeysShowWhatTheyPromise) {
    open(two_cubes());
    press("space");
    draw_until([&] { return !session().is_computing(); });
    draw(2);
    press("Tab");
    const render::Image plain = picture();
    const auto looks_different = [&](const char* key) {
        press(key);
        draw(2);
        const bool differs = picture().pixels != plain.pixels;
        press(key);
        draw(2);
        return differs;
    };
    for (const char* key : {"1", "3", "4", "5", "6", "7", "9", "0", "F1"})
        EXPECT_TRUE(looks_different(key)) << key;
    EXPECT_EQ(picture().pixels, plain.pixels);
    press("2");
    EXPECT_TRUE(app().panels().overlays.faces);
    press("8");  // nothing moves as long as nothing is simulated
    EXPECT_TRUE(app().panels().overlays.arrow_time);
    press("c");
    EXPECT_TRUE(app().panels().overlays.contact_forces);
}

// Straight from the buffers of a simulation that goes on meanwhile.
TEST_F(WindowHeavy, OverlaysFollowASimulationOnOpenGl) {
    open(two_cubes(), Backend::gl);
    for (const char* key : {"2", "3", "4", "6", "8", "9", "0"}) press(key);
    const Overlays& shown = app().panels().overlays;
    EXPECT_TRUE(shown.faces && shown.box_levels && shown.cut && shown.color_map && shown.arrow_time &&
                shown.wireframe && shown.objects);
    EXPECT_EQ(shown.cut->normal[2], 1.0f) << "open towards the eye";
    const double before = session().time();
    draw_until([&] { return session().time() > before + 0.1; });
    ASSERT_TRUE(session().view().overlay.color_map);
    EXPECT_GT(session().view().overlay.color_map->full, 0.0f);
    press("5");
    EXPECT_EQ(shown.color_map->quantity, Quantity::stretch);
    press("1");
    EXPECT_TRUE(shown.full_strain && !shown.color_map) << "springs have colours of their own";
}

TEST_F(WindowHeavy, ShowsWhatIsWrongWithASceneAndReadsItAgain) {
    open("[simulation]\nframe_rate = 0\n");
    EXPECT_EQ(app().problem(),
              path("scene.toml").string() + ":2: simulation.frame_rate = 0: must be greater than 0");
    EXPECT_EQ(app().session(), nullptr);
    write_file(path("scene.toml"), two_cubes());
    press("F5");
    draw_until([&] { return app().session() != nullptr; });
    EXPECT_EQ(app().problem(), "");
    // One that breaks while another is shown leaves that alone.
    write_file(path("scene.toml"), "[[object]]\n");
    press("F5");
    draw_until([&] { return !app().problem().empty(); });
    EXPECT_NE(app().session(), nullptr);
}

// The mean place of a body's nodes, as long as nothing is computed.
glm::dvec3 center_of(const viewer::Session& session, std::size_t object) {
    const std::vector<float> p = session.simulator().read_frame().positions;
    const Range& nodes = session.model().objects[object].nodes;
    glm::dvec3 sum(0.0);
    for (std::size_t n = nodes.first; n < nodes.end(); ++n)
        sum += glm::dvec3(p[3 * n], p[3 * n + 1], p[3 * n + 2]);
    return sum / static_cast<double>(nodes.count);
}

TEST_F(WindowHeavy, ABodyIsGrabbedPulledAndThrown) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        open(two_cubes(), backend);
        const auto settle = [&] { draw_until([&] { return !session().is_computing(); }); };
        draw_until([&] { return session().time() > 0.3; });  // it lies on the floor
        const render::Camera before = app().camera().camera();
        act({"mousemove", "320", "250", "mousedown", "1"});
        draw_until([&] { return session().hand() == viewer::Session::Hand::holding; });
        EXPECT_NEAR(session().held_point().z, 0.5f, 0.1f);  // on the front of the large cube
        for (int y = 240; y >= 130; y -= 10) {
            act({"mousemove", "320", std::to_string(y)});
            draw(1);
        }
        const double grabbed = session().time();
        draw_until([&] { return session().time() > grabbed + 0.7; });
        settle();
        EXPECT_GT(center_of(session(), 0).y, 0.8) << "it hangs in the air";
        EXPECT_LT(center_of(session(), 1).y, 0.4) << "the other one does not";
        EXPECT_EQ(app().camera().camera(), before);

        // Let go on the way to the left it flies on, and falls.
        act({"mousemove", "250", "130"});
        draw_until([&] {
            return session().hand() == viewer::Session::Hand::holding && session().time() > grabbed + 0.85;
        });
        act({"mouseup", "1"});
        draw_until([&] { return session().hand() == viewer::Session::Hand::free; });
        settle();
        const double thrown = session().time(), x = center_of(session(), 0).x;
        draw_until([&] { return session().time() > thrown + 0.1; });
        settle();
        EXPECT_LT(center_of(session(), 0).x, x - 0.02);
        draw_until([&] { return session().time() > thrown + 1.5; });  // however high it was thrown
        settle();
        EXPECT_LT(center_of(session(), 0).y, 0.7);
        close();
    }
}

TEST_F(WindowHeavy, ARigidBodyIsGrabbedAndThrownInAndNotPinned) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        std::string scene = two_cubes();
        scene.replace(scene.find("[[object]]"), 10, "[[rigid]]");
        open(scene, backend);
        const auto settle = [&] { draw_until([&] { return !session().is_computing(); }); };
        ASSERT_TRUE(session().model().objects[0].is_rigid);
        draw_until([&] { return session().time() > 0.3; });  // it lies on the floor
        act({"mousemove", "320", "250", "mousedown", "1"});
        draw_until([&] { return session().hand() == viewer::Session::Hand::holding; });
        press("p");
        draw_until([&] { return !app().notice().empty(); });
        EXPECT_EQ(app().notice(), "a rigid body has no pins: an attachment holds it");
        for (int y = 240; y >= 130; y -= 10) {
            act({"mousemove", "320", std::to_string(y)});
            draw(1);
        }
        const double grabbed = session().time();
        draw_until([&] { return session().time() > grabbed + 0.7; });
        settle();
        EXPECT_GT(center_of(session(), 0).y, 0.8) << "it hangs in the air";
        EXPECT_LT(center_of(session(), 1).y, 0.4) << "the other one does not";
        act({"mouseup", "1"});
        draw_until([&] { return session().hand() == viewer::Session::Hand::free; });
        press("t");
        draw_until([&] { return session().model().objects.size() == 3; });
        settle();
        EXPECT_TRUE(session().model().objects[2].is_rigid);
        const double thrown = session().time();
        draw_until([&] { return session().time() > thrown + 1.5; });
        settle();
        EXPECT_LT(center_of(session(), 0).y, 0.9) << "it has fallen";
        EXPECT_TRUE(app().problem().empty()) << app().problem();
        close();
    }
}

// Where in the panel is known by its look; Ctrl and a click let numbers be typed.
TEST_F(WindowHeavy, StiffnessChangesUnderWay) {
    open(two_cubes());
    draw_until([&] { return session().time() > 0.2; });
    const Counts counts = session().simulator().counts();
    act({"mousemove", "430", "162", "click", "1"});  // opens the settings
    draw(3);
    // Dear ImGui reads the keys once a picture.
    const std::vector<std::vector<std::string>> typing = {
        {"mousemove", "405", "310"}, {"keydown", "ctrl"}, {"click", "1"}, {"key", "a"},
        {"keyup", "ctrl"},           {"type", "1e6"}};
    for (const std::vector<std::string>& action : typing) {
        act(action);
        draw(3);
    }
    const double before = session().time();
    act({"key", "Return"});
    draw_until([&] { return session().scene().materials[0].youngs_modulus == 1e6; });
    EXPECT_GE(session().time(), before);
    EXPECT_TRUE(session().is_playing());
    draw_until([&] { return session().time() > before + 0.5; });
    draw_until([&] { return !session().is_computing(); });
    EXPECT_EQ(session().simulator().counts().nodes, counts.nodes);
    EXPECT_GT(center_of(session(), 0).y, 0.48) << "a stiff cube does not sag, but may bounce";
}

TEST_F(WindowHeavy, ABodyIsThrownIn) {
    open(two_cubes());
    draw_until([&] { return session().time() > 0.1; });
    act({"mousemove", "200", "200"});
    draw(3);
    const double before = session().time();
    press("t");
    draw_until([&] { return session().model().objects.size() == 3; });
    EXPECT_GE(session().time(), before);
    draw_until([&] { return !session().is_computing(); });
    EXPECT_EQ(session().model().objects[2].name, "large 2");
    EXPECT_GT(center_of(session(), 2).z, 2.0) << "it comes from where the eye is";
    const double thrown = session().time();
    draw_until([&] { return session().time() > thrown + 0.5; });
    draw_until([&] { return !session().is_computing(); });
    EXPECT_LT(center_of(session(), 2).z, 2.0);
    EXPECT_LT(center_of(session(), 0).y, 0.7) << "the others go on";
}

TEST_F(WindowHeavy, SavesThePicture) {
    open(two_cubes());
    press("space");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(path(""));
    press("F12");
    press("shift+F12");
    std::filesystem::current_path(before);
    EXPECT_EQ(app().notice(), "saved scene-2.png");
    const render::Image plain = render::read_png(path("scene-1.png"));
    const render::Image with_panels = render::read_png(path("scene-2.png"));
    EXPECT_EQ(plain.width, kWidth);
    EXPECT_EQ(plain.height, kHeight);
    EXPECT_TRUE(is_orange(plain, kWidth / 2, kHeight / 2));
    EXPECT_NE(plain.pixels, with_panels.pixels);
}

TEST_F(WindowHeavy, SavesTheSceneAsItIs) {
    open(two_cubes());
    press("space");
    press("t");
    draw_until([&] { return session().model().objects.size() == 3; });
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(path(""));
    press("ctrl+s");
    std::filesystem::current_path(before);
    EXPECT_EQ(app().notice(), "saved scene-1.toml");
    const Scene scene = load_scene(path("scene-1.toml"));
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.objects[2].name, "large 2");
    EXPECT_EQ(scene.simulation.solver, SolverKind::implicit);
    EXPECT_NEAR(scene.camera->eye.z, 6.0, 1e-4);
}

TEST_F(WindowHeavy, AFileThatIsDroppedOpens) {
    open(two_cubes());
    write_file(path("tetrahedron.obj"),
               "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    std::string problem;
    std::thread hand([&] { problem = drop_files("Gelatin", {path("tetrahedron.obj")}); });
    draw_until([&] { return session().scene().file.filename() == "tetrahedron.obj"; });
    hand.join();
    EXPECT_EQ(problem, "");
    EXPECT_EQ(session().scene().objects[0].scale, 0.01) << "a hundred metres become one";
    draw_until([&] { return session().time() > 0.1; });
    EXPECT_TRUE(is_orange(picture(), kWidth / 2, kHeight / 2));
}

TEST_F(WindowHeavy, FilmsBySimulatedTime) {
    open(two_cubes());
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(path(""));
    press("F9");
    EXPECT_TRUE(app().is_filming());
    const double start = session().time();
    draw_until([&] { return session().time() > start + 0.5; });
    press("space");
    draw_until([&] { return !session().is_computing(); });
    draw(2);
    const double length = session().time() - start;
    press("F9");
    std::filesystem::current_path(before);
    EXPECT_EQ(app().notice(), "saved scene-1.mp4");
    const ProgramResult probe =
        run_program({"ffprobe", "-v", "error", "-show_entries", "stream=width,height,duration", "-of",
                     "csv=p=0", path("scene-1.mp4").string()});
    ASSERT_EQ(probe.exit_code, 0) << probe.err;
    EXPECT_EQ(probe.out.substr(0, 8), "640,480,");
    EXPECT_NEAR(std::stod(probe.out.substr(8)), length, 0.1);
}

TEST_F(WindowHeavy, ShadersAreReadAgainAndTheOldOnesKept) {
    namespace fs = std::filesystem;
    ShaderFolder folder;
    const fs::path root = fs::path(test::source_path()) / "shaders";
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        if (entry.is_regular_file())
            folder.add(fs::relative(entry.path(), root).generic_string(), read_file(entry.path()));
    }
    open(two_cubes());
    press("space");
    const fs::path tone = "render/include/tone.glsl";
    const std::string original = read_file(root / tone);
    folder.add(tone.generic_string(), original + "\nthis is no GLSL\n");
    draw_until([&] { return !app().problem().empty(); });
    gl::take_debug_messages();  // the driver reports it, too
    EXPECT_NE(app().problem().find("render/include/tone.glsl"), std::string::npos) << app().problem();
    EXPECT_TRUE(is_orange(picture(), kWidth / 2, kHeight / 2)) << "the old ones draw on";
    folder.add(tone.generic_string(), original);
    draw_until([&] { return app().problem().empty(); });
    EXPECT_EQ(app().notice(), "shaders read again");
}

TEST_F(WindowHeavy, WhatTheDriverHasToSayIsHeard) {
    open(two_cubes());
    glEnable(GL_TEXTURE_3D);  // which the core profile does not have
    const std::vector<std::string> messages = gl::take_debug_messages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_EQ(messages[0].substr(0, 14), "OpenGL error: ");
    EXPECT_EQ(glGetError(), GLenum{GL_INVALID_ENUM});
}

TEST_F(WindowHeavy, ClosesByItsKey) {
    open(two_cubes());
    EXPECT_FALSE(window().is_asked_to_close());
    press("ctrl+q");
    EXPECT_TRUE(window().is_asked_to_close());
}

}  // namespace
}  // namespace gelatin::test
