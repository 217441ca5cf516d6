// Files that are something else than their names say.
#include "mesh/foreign_file.h"

#include "mesh/surface_file_fixture.h"
#include "mesh/texture_samples.h"

namespace gelatin {
namespace {

using testing::HasSubstr;

class ForeignFileTest : public SurfaceFileFixture {};

const std::string kForeignObj =
    "# x\nvn 0 0 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string utf16(const std::string& text, bool is_big) {
    std::string result = is_big ? "\xfe\xff" : "\xff\xfe";
    for (const char c : text) result += is_big ? std::string(1, '\0') + c : c + std::string(1, '\0');
    return result;
}

TEST_F(ForeignFileTest, SaysWhatAFileIs) {
    const std::pair<std::string, const char*> samples[] = {
        {"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n", "is a Git LFS pointer"},
        {utf16(kForeignObj, false), "is text in UTF-16"},
        {utf16(kForeignObj, true), "is text in UTF-16"},
        {std::string("\xff\xfe\0\0v\0\0\0", 8), "is text in UTF-32"},
        {"\n <!DOCTYPE html>\n<title>404</title>", "is a web page"},
        {"<html>", "is a web page"},
        {"<?xml version=\"1.0\"?><COLLADA/>", "is XML"},
        {"\x1f\x8b\x08" + std::string(100, '\0'), "is compressed by gzip"},
        {"PK\x03\x04" + std::string(100, '\0'), "is a ZIP archive"},
        {png_sample(), "is a picture (PNG)"},
        {jpeg_sample(), "is a picture (JPEG)"},
        {"Kaydara FBX Binary  ", "is an FBX file"},
        {"ISO-10303-21;\nHEADER;", "is a STEP file"}};
    for (const auto& [content, what] : samples) {
        for (const char* name : {"a.obj", "a.stl", "a.ply", "a.off", "a.gltf", "a.glb"})
            EXPECT_THAT(refusal_of(name, content), HasSubstr(std::string(name) + ": " + what));
    }
}

TEST_F(ForeignFileTest, SaysWhichFormatAFileHas) {
    make("a.obj", kForeignObj);
    Notes notes;
    const SurfaceMesh mesh = read_surface(folder_.path() / "a.obj", notes);
    for (const char* name : {"a.stl", "a.ply", "a.off"}) write_surface(folder_.path() / name, mesh);
    make("b.stl",
         "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\n"
         "endsolid\n");
    make("a.gltf", gltf_sample("x.png"));
    const std::vector<std::string> names = {"a.obj", "a.stl", "b.stl", "a.ply", "a.off", "a.gltf"};
    for (const std::string& is : names) {
        const std::string content = read_file(folder_.path() / is), ending = is.substr(1);
        for (const std::string& called : names) {
            if (called.substr(1) == ending) continue;
            EXPECT_THAT(
                refusal_of("called" + called.substr(1), content),
                HasSubstr("seems to be a " + ending.substr(1) + " file: its name should end in " + ending))
                << is << " as " << called;
        }
    }
}

}  // namespace
}  // namespace gelatin
