// Several files that are dropped onto the window at once.
#include <gmock/gmock.h>

#include <thread>

#include "core/file.h"
#include "viewer/support/drop_files.h"
#include "viewer/support/window_test.h"

namespace gelatin::test {
namespace {

TEST_F(WindowHeavy, MeshesThatAreDroppedMakeAPile) {
    open(two_cubes());
    for (const char* name : {"one.obj", "two.obj"})
        write_file(path(name), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    std::string problem;
    std::thread hand([&] { problem = drop_files("Gelatin", {path("one.obj"), path("two.obj")}); });
    draw_until([&] { return session().scene().file.filename() == "one.obj"; });
    hand.join();
    EXPECT_EQ(problem, "");
    ASSERT_EQ(session().scene().objects.size(), 2u);
    EXPECT_EQ(session().scene().objects[1].name, "two");
    press("F5");
    const viewer::Session* before = app().session();
    draw_until([&] { return app().session() != before; });
    EXPECT_EQ(session().scene().objects.size(), 2u) << "both are read again";

    hand = std::thread([&] { problem = drop_files("Gelatin", {path("one.obj"), path("scene.toml")}); });
    draw_until([&] { return !app().problem().empty(); });
    hand.join();
    EXPECT_THAT(app().problem(), testing::HasSubstr("a scene is simulated alone"));
}

}  // namespace
}  // namespace gelatin::test
