// gelatin run --overlay.
#include "apps/program_test.h"
#include "render/image.h"
#include "support/image_compare.h"

namespace gelatin {
namespace {

using test::ProgramResult;

class RunOverlays : public test::ProgramTest {};

TEST_F(RunOverlays, RefusesWhatItDoesNotKnow) {
    expect_error({"run", "cube.toml", "--overlay", "faces,bxes"}, 2,
                 "--overlay = bxes: must be boxes, faces or springs (did you mean \"boxes\"?)");
    expect_error({"run", "cube.toml", "--overlay", "faces:2"}, 2,
                 "--overlay = faces:2: faces takes no number");
    for (const char* text : {"boxes:", "boxes:x", "boxes:1.5", "boxes:-1", "boxes:13"}) {
        expect_error({"run", "cube.toml", "--overlay", text}, 2,
                     std::string("--overlay = ") + text + ": the number must be a whole number from 0 to 12");
    }
    expect_error({"run", "cube.toml", "--overlay", "springs:0"}, 2,
                 "--overlay = springs:0: the number must be a strain from 0.0001 to 1");
}

class RunOverlaysDrawn : public test::DrawingProgramTest {};

// Balls in one another. Of several names, together or apart, all are shown.
TEST_F(RunOverlaysDrawn, AreTheSameOnBothBackends) {
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
        for (const char* overlay : {"boxes", "boxes:2", "faces", "springs:0.05"}) {
            const render::Image cpu = picture(quality, "cpu", {"--overlay", overlay}),
                                gl = picture(quality, "gl", {"--overlay", overlay});
            EXPECT_GT(test::perceptual_difference(cpu, plain), 0.1) << overlay;
            EXPECT_LT(test::perceptual_difference(cpu, gl), 0.02) << overlay;
        }
        EXPECT_EQ(picture(quality, "cpu", {"--overlay", "boxes", "--overlay", "faces"}).pixels,
                  picture(quality, "cpu", {"--overlay", "boxes,faces"}).pixels);
    }
}

}  // namespace
}  // namespace gelatin
