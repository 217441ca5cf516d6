// However often scenes, shaders and sizes change in the window, no object of OpenGL is left behind: objects
// do not add up, and when the window closes all are gone, as in every test of the window.
#include <filesystem>

#include "gl/debug.h"
#include "support/shader_folder.h"
#include "support/source_path.h"
#include "viewer/support/gl_objects.h"
#include "viewer/support/window_test.h"

namespace gelatin::test {
namespace {

namespace fs = std::filesystem;

class GlObjectsWindowHeavy : public WindowHeavy {
protected:
    // Of what runs now, at rest. Timers keep as many queries as a batch had stages, and readbacks as many
    // buffers and fences as were under way at once: these are counted when all is gone.
    std::map<std::string, int> objects_at_rest() {
        if (session().is_playing()) press("space");
        draw_until([&] { return !session().is_computing(); });
        draw(3);
        std::map<std::string, int> counts = count_gl_objects();
        EXPECT_GT(counts.at("buffers"), 10);
        for (const char* pooled : {"queries", "buffers", "fences"}) counts.erase(pooled);
        return counts;
    }

    void reload() {
        const viewer::Session* before = &session();
        press("F5");
        draw_until([&] { return &session() != before || session().time() == 0.0; });
        draw_until([&] { return session().time() > 0.02; });
    }

    void resize(int width, int height) {
        act({"search", "--name", "Gelatin", "windowsize", std::to_string(width), std::to_string(height)});
        draw_until([&] { return window().pixels() == glm::ivec2(width, height); });
        draw(2);
    }

    // Thrown bodies are an edited scene's.
    void edit() {
        const std::size_t bodies = session().model().objects.size();
        press("t");
        draw_until([&] { return session().model().objects.size() == bodies + 1; });
        draw_until([&] { return !session().is_computing(); });
    }
};

TEST_F(GlObjectsWindowHeavy, DoNotAddUp) {
    ShaderFolder folder;
    const fs::path root = fs::path(test::source_path()) / "shaders";
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        if (entry.is_regular_file())
            folder.add(fs::relative(entry.path(), root).generic_string(), read_file(entry.path()));
    }
    const fs::path tone = "render/include/tone.glsl";
    write_file(path("tetrahedron.obj"),
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    for (const Backend backend : {Backend::gl, Backend::cpu}) {
        open(two_cubes(), backend);
        for (const char* key : {"1", "2", "3"}) press(key);  // overlays make programs of their own
        std::map<std::string, int> once;
        for (int round = 0; round < 2; ++round) {
            edit();
            resize(500 + 20 * round, 400);
            app().open({path("tetrahedron.obj")});
            draw_until([&] { return session().model().objects.size() == 1; });
            app().open({path("scene.toml")});
            draw_until([&] { return session().model().objects.size() == 2; });
            resize(kWidth, kHeight);
            folder.add(tone.generic_string(), read_file(root / tone) + std::string(1 + round, '\n'));
            draw_until([&] { return app().notice() == "shaders read again"; });
            reload();
            const std::map<std::string, int> counts = objects_at_rest();
            if (round > 0) {
                EXPECT_EQ(counts, once);
                continue;
            }
            once = counts;
            EXPECT_GT(once.at("programs"), 10);
        }
        close();
    }
}

}  // namespace
}  // namespace gelatin::test
