#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace gelatin::test {

/// Puts the parts of a binary glTF file together.
class GltfMaker {
public:
    using Json = nlohmann::json;

    Json json = {
        {"asset", {{"version", "2.0"}}}, {"accessors", Json::array()}, {"bufferViews", Json::array()}};

    /// @param type "VEC3" and so on @return the accessor's index
    std::size_t add(const std::vector<float>& values, const char* type) {
        return add(values.data(), values.size() * sizeof(float), values.size(), type, 5126);
    }
    std::size_t add(const std::vector<std::uint16_t>& values, const char* type) {
        return add(values.data(), values.size() * sizeof(std::uint16_t), values.size(), type, 5123);
    }

    std::string content() const {
        Json whole = json;
        whole["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
        std::string text = whole.dump();
        while (text.size() % 4 != 0) text += ' ';
        return "glTF" + word(2) + word(28 + text.size() + bytes_.size()) + word(text.size()) + "JSON" + text +
               word(bytes_.size()) + std::string("BIN\0", 4) + bytes_;
    }
    void write(const std::filesystem::path& file) const {
        std::ofstream(file, std::ios::binary) << content();
    }

private:
    std::size_t add(const void* data, std::size_t size, std::size_t count, const std::string& type,
                    int component) {
        const std::size_t components = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
        bytes_.append(static_cast<const char*>(data), size);
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count / components},
                                     {"type", type}});
        return json["accessors"].size() - 1;
    }
    static std::string word(std::size_t value) {
        const auto number = static_cast<std::uint32_t>(value);
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &number, 4);
        return bytes;
    }

    std::string bytes_;
};

/// A bar of 0.2 x 2 x 0.2 m that stands on the origin, in eight layers, with a skin of three joints at its
/// foot, its middle and its end: the first two move a half each, and both the layer in the middle. The clip
/// "bend" turns the upper one about z by 90 degrees within a second, at even speed.
inline GltfMaker bending_bar() {
    constexpr int kLayers = 8;
    GltfMaker maker;
    std::vector<float> positions, weights;
    std::vector<std::uint16_t> joints, corners;
    const auto quad = [&](int a, int b, int c, int d) {
        for (const int k : {a, b, c, a, c, d}) corners.push_back(static_cast<std::uint16_t>(k));
    };
    for (int layer = 0; layer <= kLayers; ++layer) {
        const float y = 2.0f * static_cast<float>(layer) / kLayers;
        const float upper = layer > kLayers / 2 ? 1.0f : layer == kLayers / 2 ? 0.5f : 0.0f;
        for (const auto& [x, z] : {std::pair(-0.1f, -0.1f), {0.1f, -0.1f}, {0.1f, 0.1f}, {-0.1f, 0.1f}}) {
            positions.insert(positions.end(), {x, y, z});
            joints.insert(joints.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {1.0f - upper, upper, 0.0f, 0.0f});
        }
        const int first = 4 * layer;
        for (int k = 0; layer < kLayers && k < 4; ++k)
            quad(first + k, first + 4 + k, first + 4 + (k + 1) % 4, first + (k + 1) % 4);
    }
    quad(0, 1, 2, 3);
    quad(4 * kLayers + 3, 4 * kLayers + 2, 4 * kLayers + 1, 4 * kLayers);
    std::vector<float> binds;
    for (const float y : {0.0f, -1.0f, -2.0f})
        binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, y, 0, 1});
    const float half = std::sqrt(0.5f);
    maker.json["meshes"] = {{{"primitives",
                              {{{"attributes",
                                 {{"POSITION", maker.add(positions, "VEC3")},
                                  {"JOINTS_0", maker.add(joints, "VEC4")},
                                  {"WEIGHTS_0", maker.add(weights, "VEC4")}}},
                                {"indices", maker.add(corners, "SCALAR")}}}}}};
    maker.json["skins"] = {{{"joints", {1, 2, 3}}, {"inverseBindMatrices", maker.add(binds, "MAT4")}}};
    maker.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {7, 7, 7}}},  // which skins leave out
                           {{"name", "foot"}, {"children", {2}}},
                           {{"name", "middle"}, {"translation", {0, 1, 0}}, {"children", {3}}},
                           {{"name", "end"}, {"translation", {0, 1, 0}}}};
    maker.json["scenes"] = {{{"nodes", {0, 1}}}};
    maker.json["animations"] = {
        {{"name", "bend"},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}}}},
         {"samplers",
          {{{"input", maker.add(std::vector<float>{0, 1}, "SCALAR")},
            {"output", maker.add(std::vector<float>{0, 0, 0, 1, 0, 0, half, half}, "VEC4")}}}}}};
    return maker;
}

}  // namespace gelatin::test
