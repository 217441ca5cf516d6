#include "gelatin/error.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

TEST(InvalidInputTest, NamesEverythingItKnows) {
    const InvalidInput error({"scene.toml", 12, "material.density", "-1", "must be positive"});
    EXPECT_STREQ(error.what(), "scene.toml:12: material.density = -1: must be positive");
    EXPECT_EQ(error.problem().line, 12);
    EXPECT_EQ(error.problem().field, "material.density");
}

TEST(InvalidInputTest, LeavesOutWhatDoesNotApply) {
    EXPECT_STREQ(InvalidInput("no scene given").what(), "no scene given");
    EXPECT_STREQ(InvalidInput({"mesh.obj", 0, {}, {}, "is empty"}).what(), "mesh.obj: is empty");
    EXPECT_STREQ(InvalidInput({"mesh.obj", 3, {}, {}, "is cut off"}).what(), "mesh.obj:3: is cut off");
    EXPECT_STREQ(InvalidInput({{}, 0, "vertex 4", {}, "is not finite"}).what(), "vertex 4: is not finite");
}

TEST(ErrorTest, EveryKindIsAnError) {
    EXPECT_THROW(throw InvalidInput("x"), Error);
    EXPECT_THROW(throw Diverged("x"), Error);
    EXPECT_THROW(throw NoOpenGl("x"), GlError);
    EXPECT_THROW(throw SystemError("x"), Error);
}

}  // namespace
}  // namespace gelatin
