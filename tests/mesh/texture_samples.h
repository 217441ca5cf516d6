#pragma once

#include <string>

namespace gelatin {

inline std::string from_base64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int held = 0;
    for (const char c : text) {
        const auto digit = digits.find(c);
        if (digit == std::string::npos) break;
        bits = bits << 6 | static_cast<unsigned>(digit);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes += static_cast<char>(bits >> held & 255u);
    }
    return bytes;
}

/// 2 x 2 pixels: red and green over blue and white.
inline const std::string kPngText =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/uBfvxq7p3AAAAAElFTkSuQmCC";
/// 8 x 8 pixels: (200, 30, 40) over (20, 60, 220).
inline const std::string kJpegText =
    "/9j//gAQTGF2YzU5LjM3LjEwMAD/"
    "2wBDAAgEBAQEBAUFBQUFBQYGBgYGBgYGBgYGBgYHBwcICAgHBwcGBgcHCAgICAkJCQgICAgJCQoKCg"
    "wMCwsODg4RERT/"
    "xABUAAEBAAAAAAAAAAAAAAAAAAAEBgEBAQAAAAAAAAAAAAAAAAAABgUQAQADAQAAAAAAAAAAAAAAAAAUY+KiEQEAAwEA"
    "AAAAAAAAAAAAAAAAF2Xkpf/AABEIAAgACAMBEgACEgADEgD/2gAMAwEAAhEDEQA/AImdX1kcghu85+03WpqoehhBH//Z";

inline std::string png_sample() {
    return from_base64(kPngText);
}
inline std::string jpeg_sample() {
    return from_base64(kJpegText);
}

/// A glTF file of the tetrahedron (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1) with texture coordinates, that a
/// node moves by 5 along x and another one scales by 2 before.
/// @param image of its material: a URI
inline std::string gltf_sample(const std::string& image) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"children":[1],"translation":[5,0,0]},{"mesh":0,"scale":[2,2,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"uri":")" +
           image +
           R"("}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":2,"componentType":5123,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
{"buffer":0,"byteOffset":80,"byteLength":24}],
"buffers":[{"byteLength":104,"uri":"data:application/octet-stream;base64,)"
           "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"
           "AACAPwAA"
           "gD8AAAIAAQAAAAEAAwABAAIAAwAAAAMAAgA="
           R"("}]})";
}

}  // namespace gelatin
