// gelatin run --overlay.
#include "apps/program_test.h"
#include "render/image.h"
#include "support/image_compare.h"

namespace gelatin {
namespace {

using test::ProgramResult;

class RunOverlays : public test::ProgramTest {};

TEST_F(RunOverlays, RefusesWhatItDoesNotKnow) {
    expect_error(
        {"run", "cube.toml", "--overlay", "faces,bxes"}, 2,
        "--overlay = bxes: must be boxes, faces, springs, stretch, stress, speed, pressure, cut, velocity, "
        "forces, objects, wireframe, attachments or bones (did you mean \"boxes\"?)");
    expect_error({"run", "cube.toml", "--overlay", "faces:2"}, 2,
                 "--overlay = faces:2: faces takes no number");
    for (const char* text : {"boxes:", "boxes:x", "boxes:1.5", "boxes:-1", "boxes:13"}) {
        expect_error({"run", "cube.toml", "--overlay", text}, 2,
                     std::string("--overlay = ") + text + ": the number must be a whole number from 0 to 12");
    }
    const auto refuses = [&](const char* text, const char* problem) {
        expect_error({"run", "cube.toml", "--overlay", text}, 2,
                     std::string("--overlay = ") + text + ": " + problem);
    };
    refuses("boxes:2:only",
            "behind the number there may be 'alone', for the boxes of that level and no other");
    refuses("boxes:2:alone:1", "boxes takes no more than 2 fields");
    refuses("stress:0", "the number must be a stress above 0, up to 1e15 Pa");
    refuses("stretch:1", "the number must be a stretch above 1, up to 1000");
    refuses("speed:1:2", "speed takes no more than 1 field");
    refuses("velocity:0", "the number must be a time from 0.0001 to 100 s");
    refuses("forces:0", "the number must be a length from 1e-9 to 1e6 m for each newton");
    refuses("pressure:-1", "the number must be a pressure above 0, up to 1e15 Pa");
    refuses("objects:1", "objects takes no number");
    refuses("cut:0:0:0", "the direction must not be zero");
    refuses("cut:x:a", "the number must be between -1e6 and 1e6");
    for (const char* text : {"cut", "cut:1:2", "cut:w", "cut:x:1:2", "cut:1:2:3:4:5"}) {
        const ProgramResult result = run({"run", "cube.toml", "--overlay", text});
        EXPECT_EQ(result.exit_code, 2) << text;
        EXPECT_NE(result.err.find("must be cut:x, cut:y, cut:z or cut:NX:NY:NZ"), std::string::npos)
            << result.err;
    }
    expect_error({"run", "cube.toml", "--overlay", "springs,stress"}, 2,
                 "--overlay = stress: of springs, stretch, stress, speed and pressure one can be shown");
    expect_error({"run", "cube.toml", "--overlay", "springs:0"}, 2,
                 "--overlay = springs:0: the number must be a strain from 0.0001 to 1");
}

class RunOverlaysDrawnHeavy : public test::DrawingProgramTest {};

// Balls in one another. Of several names, together or apart, all are shown.
TEST_F(RunOverlaysDrawnHeavy, AreTheSameOnBothBackends) {
    write("balls.toml",
          "[simulation]\nframe_rate = 500\nframes = 5\ngravity = [0, 0, 0]\n"
          "[[material]]\nname = 'jelly'\n"
          "[[object]]\nname = 'left'\nshape = { sphere = 0.3, frequency = 4 }\nvelocity = [0.6, 0, 0]\n"
          "[[object]]\nname = 'right'\nshape = { sphere = 0.3, frequency = 4 }\nposition = [0.55, 0.1, 0]\n");
    const auto picture = [&](const std::string& quality, const std::string& backend,
                             const std::vector<std::string>& overlays) {
        std::vector<std::string> call = {"run",       "balls.toml", "--image",   "a.png",
                                         "--size",    "320x180",    "--quality", quality,
                                         "--backend", backend,      "--gl-debug"};
        call.insert(call.end(), overlays.begin(), overlays.end());
        const ProgramResult result = run(call);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return render::read_png(path("a.png"));
    };
    for (const char* quality : {"high", "fast"}) {
        const render::Image plain = picture(quality, "cpu", {});
        for (const char* overlay : {"boxes:2:alone,faces", "springs:0.05,wireframe",
                                    "cut:1:0:1:0.1,stretch:1.1", "cut:z:0.05,speed,velocity:0.3,objects"}) {
            const render::Image cpu = picture(quality, "cpu", {"--overlay", overlay}),
                                gl = picture(quality, "gl", {"--overlay", overlay});
            EXPECT_GT(test::perceptual_difference(cpu, plain), 0.1) << overlay;
            EXPECT_LT(test::perceptual_difference(cpu, gl), 0.02) << overlay;
        }
        EXPECT_EQ(picture(quality, "cpu", {"--overlay", "boxes", "--overlay", "faces"}).pixels,
                  picture(quality, "cpu", {"--overlay", "boxes,faces"}).pixels);
    }
}

// A block on a floor without self-contact, whose forces the CPU finds alone. Elsewhere a line says so.
TEST_F(RunOverlaysDrawnHeavy, ContactForcesNeedTheCpu) {
    write("block.toml",
          "[simulation]\nframes = 30\n[collision]\nself_collision = false\n[[material]]\nname = "
          "'jelly'\n[[collider]]\nshape = { plane = [0, 1, "
          "0] }\n"
          "[[object]]\nname = 'block'\nshape = { box = [0.4, 0.4, 0.4], segments = [3, 3, 3] }\n"
          "position = [0, 0.2, 0]\n");
    const auto draw = [&](const std::string& backend, const std::string& overlay) {
        return run({"run", "block.toml", "--image", "a.png", "--size", "320x180", "--backend", backend,
                    "--overlay", overlay, "--gl-debug"});
    };
    const ProgramResult plain = draw("cpu", "velocity:0.0001");
    EXPECT_EQ(plain.exit_code, 0) << plain.err;
    const render::Image without = render::read_png(path("a.png"));
    for (const char* overlay : {"forces", "pressure", "pressure:1e4,forces:1e-3,cut:z"}) {
        const ProgramResult on_cpu = draw("cpu", overlay);
        EXPECT_EQ(on_cpu.exit_code, 0) << on_cpu.err;
        EXPECT_EQ(on_cpu.err.find("overlays of contact forces"), std::string::npos);
        EXPECT_GT(test::perceptual_difference(render::read_png(path("a.png")), without), 0.05) << overlay;
        const ProgramResult on_gl = draw("gl", overlay);
        EXPECT_EQ(on_gl.exit_code, 0) << on_gl.err;
        EXPECT_NE(on_gl.err.find("overlays of contact forces need an implicit solver on the CPU"),
                  std::string::npos)
            << on_gl.err;
    }
}

}  // namespace
}  // namespace gelatin
