#include "mesh/foreign_file.h"

#include <algorithm>
#include <array>
#include <string>

#include "gelatin/error.h"
#include "mesh/surface_readers.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

struct Beginning {
    std::string_view bytes;  // in small letters where they are text
    const char* what;
};

// What no surface file begins with.
constexpr std::array<Beginning, 20> kForeign = {{
    {"version https://git-lfs", "is a Git LFS pointer, not the file itself, which 'git lfs pull' gets"},
    {{"\xff\xfe\0\0", 4}, "is text in UTF-32, which is not read: save it as UTF-8"},
    {{"\0\0\xfe\xff", 4}, "is text in UTF-32, which is not read: save it as UTF-8"},
    {"\xff\xfe", "is text in UTF-16, which is not read: save it as UTF-8"},
    {"\xfe\xff", "is text in UTF-16, which is not read: save it as UTF-8"},
    {"\x1f\x8b", "is compressed by gzip: unpack it"},
    {"\xfd"
     "7zxz",
     "is compressed by xz: unpack it"},
    {"\x28\xb5\x2f\xfd", "is compressed by zstd: unpack it"},
    {"bzh", "is compressed by bzip2: unpack it"},
    {{"pk\x03\x04", 4}, "is a ZIP archive: unpack it"},
    {"7z\xbc\xaf", "is a 7z archive: unpack it"},
    {"\x89png", "is a picture (PNG)"},
    {"\xff\xd8\xff", "is a picture (JPEG)"},
    {"<!doctype", "is a web page (HTML)"},
    {"<html", "is a web page (HTML)"},
    {"<?xml", "is XML, perhaps a COLLADA, VTK or X3D file, which are no surface files here"},
    {"kaydara fbx", "is an FBX file, which is not read: export OBJ, STL, PLY, OFF or glTF"},
    {"blender", "is a Blender file, which is not read: export OBJ, STL, PLY, OFF or glTF"},
    {"iso-10303-21", "is a STEP file, which is not read: export OBJ, STL, PLY, OFF or glTF"},
    {"%pdf", "is a PDF file"},
}};

// The first lines have a vertex, and nothing but OBJ's statements.
bool seems_obj(const fs::path& file, std::string_view content) {
    constexpr std::array kKeywords = {"f", "g", "mtllib", "o", "s", "usemtl", "vn", "vt"};
    TextScanner scanner(file, content.substr(0, 4096));
    for (; !scanner.at_end(); scanner.skip_line()) {
        const std::string keyword = lower_case(scanner.word("word"));
        if (keyword == "v") return true;
        if (std::find(kKeywords.begin(), kKeywords.end(), keyword) == kKeywords.end()) return false;
    }
    return false;
}

bool seems_off(const fs::path& file, std::string_view content) {
    TextScanner scanner(file, content.substr(0, 4096));
    if (scanner.at_end()) return false;
    const std::string word = lower_case(scanner.word("word"));
    return word == "off" || word == "coff" || word == "noff" || word == "stoff" || word == "cnoff";
}

// The endings of the format that the content seems to have; empty: none of these.
std::string seeming_ending(const fs::path& file, std::string_view content) {
    if (seems_stl(file, content)) return ".stl";
    if (content.starts_with("ply\n") || content.starts_with("ply\r")) return ".ply";
    if (content.starts_with("glTF")) return ".glb";
    if (seems_off(file, content)) return ".off";
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && content[first] == '{' &&
        content.find("\"asset\"") != std::string_view::npos)
        return ".gltf";
    return seems_obj(file, content) ? ".obj" : "";
}

}  // namespace

void refuse_foreign_content(const fs::path& file, std::string_view ending, std::string_view content) {
    const std::string seeming = seeming_ending(file, content);
    const bool is_gltf = ending == ".gltf" || ending == ".glb";
    if (seeming == ending || (is_gltf && (seeming == ".gltf" || seeming == ".glb"))) return;
    const std::string start = lower_case(content.substr(0, 32));
    const std::size_t first = std::min(start.find_first_not_of(" \t\r\n"), start.size());
    for (const Beginning& foreign : kForeign) {
        if (std::string_view(start).substr(first).starts_with(foreign.bytes))
            throw InvalidInput({file.string(), 0, {}, {}, foreign.what});
    }
    if (!seeming.empty()) {
        throw InvalidInput(
            {file.string(),
             0,
             {},
             {},
             "seems to be a " + lower_case(seeming).substr(1) + " file: its name should end in " + seeming});
    }
}

}  // namespace gelatin
