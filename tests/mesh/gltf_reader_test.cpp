// glTF as other programs write it.
#include <nlohmann/json.hpp>

#include "mesh/gltf_document.h"
#include "mesh/surface_file_fixture.h"
#include "mesh/texture_samples.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

class GltfReaderTest : public SurfaceFileFixture {};

// The binary form: a header of three numbers, a chunk with the text, and one with the bytes of its buffer.
std::string pack_binary(std::string text, const std::string& buffer) {
    while (text.size() % 4 != 0) text += ' ';
    const auto word = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
    return "glTF" + word(2) + word(28 + text.size() + buffer.size()) + word(text.size()) + "JSON" + text +
           word(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

// Of a file whose buffer is a data URI.
std::string glb_of(std::string text) {
    const std::string uri = ",\"uri\":\"data:application/octet-stream;base64,";
    const std::size_t start = text.find(uri), data = start + uri.size(), end = text.find('"', data);
    const std::string buffer = from_base64(text.substr(data, end - data));
    return pack_binary(text.erase(start, end + 1 - start), buffer);
}

TEST_F(GltfReaderTest, GltfHasItsNodesTransformsAndTextures) {
    make("pa int.png", png_sample());
    make("file.gltf", gltf_sample("pa%20int.png"));
    make("embedded.gltf", gltf_sample("data:image/png;base64," + kPngText));
    make("binary.glb", glb_of(gltf_sample("data:image/png;base64," + kPngText)));
    for (const char* name : {"file.gltf", "embedded.gltf", "binary.glb"}) {
        const SurfaceMesh mesh = read(name);
        EXPECT_THAT(notes_, IsEmpty());
        ASSERT_EQ(mesh.faces.size(), 4u);
        ASSERT_EQ(mesh.positions.size(), 4u);
        EXPECT_EQ(mesh.positions[1], glm::dvec3(7, 0, 0));
        EXPECT_EQ(mesh.positions[3], glm::dvec3(5, 0, 2));
        ASSERT_EQ(mesh.look.materials.size(), 1u);
        EXPECT_EQ(mesh.look.materials[0].name, "paint");
        EXPECT_EQ(mesh.look.materials[0].color, glm::vec3(0.5f, 1.0f, 1.0f)) << "linear already";
        ASSERT_NE(mesh.look.materials[0].image, nullptr) << name;
        EXPECT_EQ(*mesh.look.materials[0].image, png_sample());
        EXPECT_EQ(uv_at(mesh, 0, {5, 0, 0}), glm::vec2(0.0f, 1.0f)) << "its v points down";
        EXPECT_THAT(mesh.look.face_materials, testing::Each(0u));
    }
}

TEST_F(GltfReaderTest, RefusesDamagedGltfWithItsName) {
    make("a.gltf", "{\"asset\":");
    make("b.glb", "glTF nonsense");
    make("c.gltf", gltf_sample("x.png").replace(80, 1, ""));
    EXPECT_THAT(refusal([&] { read("a.gltf"); }), HasSubstr("a.gltf: cannot be read: "));
    EXPECT_THAT(refusal([&] { read("b.glb"); }), HasSubstr("b.glb: version = "));
    try {
        read("c.gltf");
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("c.gltf"));
    }
}

// Every beginning of a file is a mesh or is refused; nothing else.
TEST_F(GltfReaderTest, AnyBeginningOfAGltfFileIsReadOrRefused) {
    const std::string whole = gltf_sample("data:image/png;base64," + kPngText);
    for (std::size_t size = 0; size < whole.size(); size += 7) {
        make("a.gltf", whole.substr(0, size));
        EXPECT_THROW(read("a.gltf"), InvalidInput) << size;
    }
}

std::string to_base64(const std::string& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 3; ++i)
            bits = bits << 8 | (k + i < bytes.size() ? static_cast<std::uint8_t>(bytes[k + i]) : 0u);
        for (int i = 0; i < 4; ++i) text += kDigits[bits >> (18 - 6 * i) & 63];
    }
    text.resize(text.size() - (3 - bytes.size() % 3) % 3);
    return text + std::string((3 - bytes.size() % 3) % 3, '=');
}

/// The tetrahedron of the samples in one of the many forms that glTF allows.
class OddGltf {
public:
    explicit OddGltf(Dice& dice) : dice_(dice) {}

    std::string write(bool is_binary) {
        const std::size_t form = dice_.below(4);
        Json primitive = {{"attributes", {{"POSITION", positions()}}}};
        if (form == 0) primitive["indices"] = indices({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
        if (form == 1) {
            primitive["indices"] = indices({0, 2, 1, 3, 0, 2});  // all four
            primitive["mode"] = 5;
        }
        Json primitives = Json::array({primitive});
        if (form == 2) {  // a fan of three, and the face that closes it
            primitives[0]["indices"] = indices({0, 2, 1, 3, 2});
            primitives[0]["mode"] = 6;
            primitive["indices"] = indices({1, 2, 3});
            primitive["mode"] = 4;
            primitives.push_back(primitive);
        }
        if (form == 3) {
            primitives[0]["indices"] = indices({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
            primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", dice_.below(4)}});
            ++other_groups;
        }
        json_["asset"] = {{"version", "2.0"}, {"generator", "a test"}};
        json_["meshes"] = Json::array({{{"primitives", primitives}}});
        // A turn about (1, 1, 1) moves the axes, a reflection of all three turns the surface inside out.
        json_["nodes"] = {{{"children", Json::array({1})}, {"rotation", {0.5, 0.5, 0.5, 0.5}}},
                          {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}}},
                          {{"mesh", 0}}};
        if (dice_.one_in(2)) {
            json_["scenes"] = {{{"nodes", Json::array({2})}}, {{"nodes", Json::array({0})}}};
            json_["scene"] = 1;
        } else {
            json_["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
        }
        json_["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
        if (is_binary) return pack_binary(json_.dump(), buffer_);
        json_["buffers"][0]["uri"] = "data:application/octet-stream;base64," + to_base64(buffer_);
        return json_.dump(dice_.one_in(2) ? 2 : -1);
    }

    std::size_t other_groups = 0;

private:
    template <class T>
    void align() {
        buffer_.resize((buffer_.size() + sizeof(T) - 1) / sizeof(T) * sizeof(T), '\x55');
    }
    std::size_t add_view(std::size_t first, std::size_t stride = 0) {
        Json view = {{"buffer", 0}, {"byteOffset", first}, {"byteLength", buffer_.size() - first}};
        if (stride > 0) view["byteStride"] = stride;
        json_["bufferViews"].push_back(view);
        return json_["bufferViews"].size() - 1;
    }
    std::size_t add_accessor(Json accessor) {
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    std::size_t positions() {
        const std::array<glm::vec3, 4> points = {glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const bool is_quantized = dice_.one_in(3), is_sparse = dice_.one_in(3);
        const std::size_t stride = dice_.any({"", "x"}).empty() ? 0 : 20;
        align<float>();
        const std::size_t first = buffer_.size();
        for (const glm::vec3& p : points) {
            const std::size_t begin = buffer_.size();
            for (int k = 0; k < 3; ++k) {
                const float value = is_sparse && &p == &points[2] ? 0.0f : p[k];
                buffer_ +=
                    is_quantized ? bytes_of(static_cast<std::int16_t>(32767 * value)) : bytes_of(value);
            }
            if (stride > 0) buffer_.resize(begin + stride, '\x55');
        }
        Json accessor = {{"bufferView", add_view(first, stride)},
                         {"componentType", is_quantized ? 5122 : 5126},
                         {"count", 4},
                         {"type", "VEC3"}};
        if (is_quantized) accessor["normalized"] = true;
        if (is_sparse) {
            const std::size_t place = buffer_.size();
            buffer_ += '\2';
            const std::size_t place_view = add_view(place);
            align<float>();
            const std::size_t value = buffer_.size();
            for (int k = 0; k < 3; ++k)
                buffer_ += is_quantized ? bytes_of(static_cast<std::int16_t>(32767 * points[2][k]))
                                        : bytes_of(points[2][k]);
            accessor["sparse"] = {{"count", 1},
                                  {"indices", {{"bufferView", place_view}, {"componentType", 5121}}},
                                  {"values", {{"bufferView", add_view(value)}}}};
        }
        return add_accessor(accessor);
    }

    std::size_t indices(const std::vector<std::uint32_t>& values) {
        const int type = dice_.one_in(3) ? 5121 : dice_.one_in(2) ? 5123 : 5125;
        align<std::uint32_t>();
        const std::size_t first = buffer_.size();
        buffer_ += "12345678";  // which its byteOffset leaves out
        for (const std::uint32_t v : values) {
            if (type == 5121) buffer_ += static_cast<char>(v);
            if (type == 5123) buffer_ += bytes_of(static_cast<std::uint16_t>(v));
            if (type == 5125) buffer_ += bytes_of(v);
        }
        return add_accessor({{"bufferView", add_view(first)},
                             {"byteOffset", 8},
                             {"componentType", type},
                             {"count", values.size()},
                             {"type", "SCALAR"}});
    }

    Dice& dice_;
    Json json_;
    std::string buffer_;
};

TEST_F(GltfReaderTest, ReadsAnyFormOfTheGrammar) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        OddGltf gltf(dice);
        const bool is_binary = dice.one_in(2);
        const SurfaceMesh mesh = read(is_binary ? "a.glb" : "a.gltf", gltf.write(is_binary));
        expect_tetrahedron(mesh);
        for (const glm::dvec3& p : mesh.positions) EXPECT_LE(std::max({p.x, p.y, p.z}), 1e-15);
        EXPECT_EQ(notes_.size(), gltf.other_groups);
        for (const std::string& note : notes_) EXPECT_THAT(note, testing::StartsWith("ignored groups of "));
    }
}

std::string changed_sample(const std::function<void(Json&)>& change) {
    Json json = Json::parse(gltf_sample("data:image/png;base64," + kPngText));
    change(json);
    return json.dump();
}

TEST_F(GltfReaderTest, RefusesCompressionAndOtherVersions) {
    for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "XYZ_new"}) {
        const std::string text =
            changed_sample([&](Json& json) { json["extensionsRequired"] = Json::array({extension}); });
        EXPECT_THAT(refusal_of("a.gltf", text),
                    HasSubstr("a.gltf: extensionsRequired = " + std::string(extension) + ": is not read"));
    }
    read("a.gltf", changed_sample([](Json& json) {
             json["extensionsRequired"] = Json::array({"KHR_materials_unlit"});
         }));
    EXPECT_THAT(notes_, IsEmpty());
    EXPECT_THAT(refusal_of("a.gltf", changed_sample([](Json& json) { json["asset"]["version"] = "1.0"; })),
                HasSubstr("asset.version = \"1.0\": only glTF 2 is read"));
}

TEST_F(GltfReaderTest, NamesTheItemThatIsWrong) {
    const auto refusal = [&](const char* pointer, const Json& value) {
        return refusal_of("a.gltf",
                          changed_sample([&](Json& json) { json[Json::json_pointer(pointer)] = value; }));
    };
    EXPECT_THAT(refusal("/accessors/2/count", 13),
                HasSubstr("accessors[2] = 13 elements of 2 bytes: its bufferView has 24"));
    EXPECT_THAT(refusal("/accessors/0/count", 1u << 31), HasSubstr("its bufferView has 48 bytes"));
    EXPECT_THAT(refusal("/accessors/0/componentType", 5124), HasSubstr("accessors[0].componentType = 5124"));
    EXPECT_THAT(refusal("/accessors/0/type", "VEC2"), HasSubstr("POSITION: must be of type VEC3"));
    EXPECT_THAT(refusal("/accessors/0/bufferView", 7),
                HasSubstr("bufferViews = 7: is not there: the file has 3"));
    EXPECT_THAT(refusal("/bufferViews/1/byteOffset", 100),
                HasSubstr("bufferViews[1] = 32 bytes from byte 100: its buffer has 104"));
    EXPECT_THAT(refusal("/buffers/0/uri", "gone.bin"),
                HasSubstr("a.gltf: buffers[0].uri = gone.bin: no such file"));
    EXPECT_THAT(refusal("/buffers/0/uri", 3), HasSubstr("buffers[0].uri = 3: must be text"));
    EXPECT_THAT(refusal("/meshes/0/primitives/0/indices", -1),
                HasSubstr("indices = -1: must be a whole number"));
    EXPECT_THAT(refusal("/nodes/1/children", {0}), HasSubstr("nodes[0]: occurs twice in the scene"));
    EXPECT_THAT(refusal("/nodes/1/scale", {1, 2}), HasSubstr("nodes[1].scale = [1,2]: must be 3 numbers"));
    EXPECT_THAT(refusal("/nodes/1/scale", {1e39, 1, 1}),
                HasSubstr("vertex 1 = 1e+39: coordinates must be finite"));
    EXPECT_THAT(refusal("/scenes", "x"), HasSubstr("scenes: must be an array"));
    EXPECT_THAT(refusal("/meshes/0/primitives", 5), HasSubstr("a.gltf: cannot be read: "));
}

TEST_F(GltfReaderTest, CountsWhatItIgnores) {
    read("a.gltf", changed_sample([](Json& json) {
             json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 0;
             json["textures"] = Json::array({Json::object()});
         }));
    EXPECT_THAT(notes_, ElementsAre("ignored colours of vertices: 4",
                                    "ignored textures of formats that are neither PNG nor JPEG: 1"));
}

}  // namespace
}  // namespace gelatin
