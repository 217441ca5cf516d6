#include "sim/animation/gltf_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/common.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

using Json = nlohmann::json;

// Constants of glTF, as of OpenGL.
constexpr int kFloat = 5126, kUnsigned = 5125, kArrayBuffer = 34962, kElementBuffer = 34963, kRepeat = 10497;

static_assert(std::endian::native == std::endian::little, "glTF has this order");

/// The file's one buffer, and what is in it.
class GltfContent {
public:
    Json json = {{"asset", {{"version", "2.0"}, {"generator", std::string("Gelatin ") + version()}}},
                 {"scene", 0},
                 {"accessors", Json::array()},
                 {"bufferViews", Json::array()}};

    int add_view(const void* data, std::size_t size, std::optional<int> target = {}) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
        if (target) view["target"] = *target;
        bytes_.append(static_cast<const char*>(data), size);
        return append("bufferViews", std::move(view));
    }

    template <class T>
    int add(const std::vector<T>& values, const char* type, int component, std::optional<int> target = {}) {
        return append("accessors",
                      {{"bufferView", add_view(values.data(), values.size() * sizeof(T), target)},
                       {"componentType", component},
                       {"count", values.size()},
                       {"type", type}});
    }

    /// Positions, or changes of them, have their bounds.
    int add_positions(const std::vector<glm::vec3>& values) {
        const int accessor = add(values, "VEC3", kFloat, kArrayBuffer);
        glm::vec3 least(std::numeric_limits<float>::max()), most(-least);
        for (const glm::vec3& value : values) {
            least = glm::min(least, value);
            most = glm::max(most, value);
        }
        Json& described = json["accessors"][static_cast<std::size_t>(accessor)];
        described["min"] = {least.x, least.y, least.z};
        described["max"] = {most.x, most.y, most.z};
        return accessor;
    }

    int append(const char* list, Json value) {
        Json& values = json[list];
        values.push_back(std::move(value));
        return static_cast<int>(values.size()) - 1;
    }

    /// The whole file.
    std::string finished(const std::filesystem::path& file) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        json["buffers"] = {{{"byteLength", bytes_.size()}}};
        std::string text = json.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::size_t size = 12 + 8 + text.size() + 8 + bytes_.size();
        if (size > std::numeric_limits<std::uint32_t>::max())
            throw InvalidInput(
                {file.string(),
                 0,
                 {},
                 {},
                 fmt::format("would have {} bytes, glTF has at most 4 GiB: export fewer frames (--every)",
                             size)});
        std::string result;
        const auto add_number = [&](std::size_t number) {
            const auto value = static_cast<std::uint32_t>(number);
            result.append(reinterpret_cast<const char*>(&value), sizeof(value));
        };
        result += "glTF";
        add_number(2);
        add_number(size);
        add_number(text.size());
        result += "JSON" + text;
        add_number(bytes_.size());
        result.append("BIN\0", 4);
        return result + bytes_;
    }

private:
    std::string bytes_;
};

Json material_of(const glm::vec3& color) {
    return {{"pbrMetallicRoughness",
             {{"baseColorFactor", {color.r, color.g, color.b, 1.0f}},
              {"metallicFactor", 0.0},
              {"roughnessFactor", 0.6}}},
            {"doubleSided", true}};
}

// Of the skin's materials, in their order.
void add_materials(const SurfaceLook& look, GltfContent& content) {
    for (const SurfaceMaterial& material : look.materials) {
        Json described = material_of(material.color);
        described["name"] = material.name;
        if (material.image) {
            const bool is_png = material.image->starts_with("\x89PNG");
            const int view = content.add_view(material.image->data(), material.image->size());
            const int image = content.append(
                "images", {{"bufferView", view}, {"mimeType", is_png ? "image/png" : "image/jpeg"}});
            if (!content.json.contains("samplers"))
                content.append("samplers", {{"wrapS", kRepeat}, {"wrapT", kRepeat}});
            const int texture = content.append("textures", {{"source", image}, {"sampler", 0}});
            described["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
        }
        content.append("materials", std::move(described));
    }
}

std::vector<glm::vec3> changes(std::vector<glm::vec3> values, const std::vector<glm::vec3>& from) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] -= from[k];
    return values;
}

// One target at a time, the first frame none.
std::vector<float> weights_of(std::size_t frames) {
    const std::size_t targets = frames - 1;
    std::vector<float> weights(frames * targets);
    for (std::size_t f = 1; f < frames; ++f) weights[f * targets + f - 1] = 1.0f;
    return weights;
}

}  // namespace

GltfFile::GltfFile(std::filesystem::path file, const Model& model, AnimationSettings settings)
    : file_(std::move(file)), settings_(std::move(settings)), surface_(make_animated_surface(model)) {}

void GltfFile::write(const HostFrame& frame) {
    times_.push_back(frame.time);
    points_.push_back(carry_skin(surface_.points, std::span(frame.positions)));
}

void GltfFile::finish() {
    GltfContent content;
    add_materials(surface_.look, content);
    std::vector<float> seconds;
    for (const double time : times_) seconds.push_back(static_cast<float>(time - times_.front()));
    std::optional<int> input, output;  // of the animation
    Json channels = Json::array(), samplers = Json::array(), roots = Json::array();
    for (std::size_t o = 0; o < surface_.objects.size(); ++o) {
        const AnimatedSurface::Object& object = surface_.objects[o];
        const std::vector<glm::vec3> positions = vertex_positions(object, points_.front()),
                                     normals = vertex_normals(object, points_.front());
        Json attributes{{"POSITION", content.add_positions(positions)},
                        {"NORMAL", content.add(normals, "VEC3", kFloat, kArrayBuffer)}};
        if (object.has_uvs) {
            std::vector<glm::vec2> uvs;  // glTF's (0, 0) is the upper left
            for (const auto& vertex : object.vertices) uvs.emplace_back(vertex.uv.x, 1.0f - vertex.uv.y);
            attributes["TEXCOORD_0"] = content.add(uvs, "VEC2", kFloat, kArrayBuffer);
        }
        const bool moves = std::any_of(points_.begin() + 1, points_.end(), [&](const auto& points) {
            return vertex_positions(object, points) != positions;
        });
        Json targets = Json::array();
        for (std::size_t f = 1; moves && f < points_.size(); ++f)
            targets.push_back({{"POSITION", content.add_positions(
                                                changes(vertex_positions(object, points_[f]), positions))},
                               {"NORMAL", content.add(changes(vertex_normals(object, points_[f]), normals),
                                                      "VEC3", kFloat, kArrayBuffer)}});
        Json primitives = Json::array();
        std::optional<int> plain;
        for (const AnimatedSurface::Part& part : object.parts) {
            if (part.material == SurfaceLook::kNone && !plain)
                plain = content.append("materials", material_of(settings_.colors[o]));
            Json primitive{
                {"attributes", attributes},
                {"indices", content.add(part.corners, "SCALAR", kUnsigned, kElementBuffer)},
                {"material", part.material == SurfaceLook::kNone ? *plain : static_cast<int>(part.material)}};
            if (moves) primitive["targets"] = targets;
            primitives.push_back(std::move(primitive));
        }
        if (primitives.empty()) continue;
        Json mesh{{"name", object.name}, {"primitives", primitives}};
        if (moves) mesh["weights"] = std::vector<float>(points_.size() - 1);
        const int node = content.append(
            "nodes", {{"name", object.name}, {"mesh", content.append("meshes", std::move(mesh))}});
        roots.push_back(node);
        if (!moves) continue;
        if (!input) {
            input = content.add(seconds, "SCALAR", kFloat);
            Json& described = content.json["accessors"][static_cast<std::size_t>(*input)];
            described["min"] = {seconds.front()};
            described["max"] = {seconds.back()};
            output = content.add(weights_of(points_.size()), "SCALAR", kFloat);
        }
        samplers.push_back({{"input", *input}, {"output", *output}, {"interpolation", "LINEAR"}});
        channels.push_back(
            {{"sampler", samplers.size() - 1}, {"target", {{"node", node}, {"path", "weights"}}}});
    }
    content.json["scenes"] = {{{"nodes", roots}}};
    if (!channels.empty())
        content.json["animations"] = {
            {{"name", "simulation"}, {"channels", channels}, {"samplers", samplers}}};
    write_file(file_, content.finished(file_));
}

}  // namespace gelatin
