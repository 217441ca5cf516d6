#include "sim/animation/gltf_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "core/file_writer.h"
#include "gelatin/error.h"
#include "gelatin/version.h"
#include "model/transform.h"

namespace gelatin {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

// Constants of glTF, as of OpenGL.
constexpr int kFloat = 5126, kUnsigned = 5125, kArrayBuffer = 34962, kElementBuffer = 34963, kRepeat = 10497;

static_assert(std::endian::native == std::endian::little, "glTF has this order");

std::string padded(std::string text, char with) {
    text.resize((text.size() + 3) / 4 * 4, with);
    return text;
}

}  // namespace

/// The file's one buffer, and what is in it.
class GltfContent {
public:
    /// @param file that it will be
    explicit GltfContent(fs::path file) : file_(std::move(file)), bytes_(scratch_folder(file_)) {}

    Json json = {{"asset", {{"version", "2.0"}, {"generator", std::string("Gelatin ") + version()}}},
                 {"scene", 0},
                 {"accessors", Json::array()},
                 {"bufferViews", Json::array()}};

    int add_view(const void* data, std::size_t size, std::optional<int> target = {}) {
        const int view = begin_view(size, target);
        bytes_.append(data, size);
        return view;
    }

    template <class T>
    int add(const std::vector<T>& values, const char* type, int component, std::optional<int> target = {}) {
        const int view = add_view(values.data(), values.size() * sizeof(T), target);
        return add_accessor(view, values.size(), type, component);
    }

    /// So many rows of as many floats each, which `row` gives one after the other.
    template <class Row>
    int add_rows(std::size_t rows, std::size_t columns, const Row& row) {
        const int view = begin_view(rows * columns * sizeof(float), {});
        for (std::size_t r = 0; r < rows; ++r) bytes_.append(row(r).data(), columns * sizeof(float));
        return add_accessor(view, rows * columns, "SCALAR", kFloat);
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

    void write() {
        align();
        json["buffers"] = {{{"byteLength", bytes_.size()}}};
        const std::string text = padded(json.dump(), ' ');
        const std::size_t size = 12 + 8 + text.size() + 8 + bytes_.size();
        if (size > std::numeric_limits<std::uint32_t>::max())
            throw InvalidInput(
                {file_.string(),
                 0,
                 {},
                 {},
                 fmt::format("would have {} bytes, glTF has at most 4 GiB: export fewer frames (--every)",
                             size)});
        FileWriter out(file_);
        out.append("glTF" + number(2) + number(size) + number(text.size()) + "JSON" + text);
        out.append(number(bytes_.size()) + std::string("BIN\0", 4));
        constexpr std::size_t kPiece = std::size_t{1} << 20;
        for (std::size_t at = 0; at < bytes_.size(); at += kPiece) {
            std::string piece(std::min(kPiece, bytes_.size() - at), '\0');
            bytes_.read(at, piece.data(), piece.size());
            out.append(piece);
        }
        out.finish();
    }

private:
    static std::string number(std::size_t number) {
        const auto value = static_cast<std::uint32_t>(number);
        return {reinterpret_cast<const char*>(&value), sizeof(value)};
    }

    void align() { bytes_.append("\0\0\0", (4 - bytes_.size() % 4) % 4); }

    int begin_view(std::size_t size, std::optional<int> target) {
        align();
        Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
        if (target) view["target"] = *target;
        return append("bufferViews", std::move(view));
    }

    int add_accessor(int view, std::size_t count, const char* type, int component) {
        return append("accessors",
                      {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    }

    fs::path file_;
    ScratchFile bytes_;
};

namespace {

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

// At a frame, each target's: one at a time, in the first frame none.
std::vector<float> weights_at(std::size_t frame, std::size_t targets) {
    std::vector<float> weights(targets);
    if (frame > 0) weights[frame - 1] = 1.0f;
    return weights;
}

}  // namespace

GltfFile::GltfFile(std::filesystem::path file, const Model& model, AnimationSettings settings)
    : file_(std::move(file)),
      settings_(std::move(settings)),
      surface_(make_animated_surface(model)),
      frames_(file_, 3 * surface_.points.size()) {}

void GltfFile::write(const HostFrame& frame) {
    times_.push_back(frame.time);
    frames_.add(carry_skin(surface_.points, std::span(frame.positions)));
}

std::vector<float> GltfFile::points(const AnimatedSurface::Object& object, std::size_t frame) const {
    return frames_.read(frame, 3 * std::size_t{object.points.first}, 3 * std::size_t{object.points.count});
}

bool GltfFile::moves(const AnimatedSurface::Object& object) const {
    const std::vector<float> first = points(object, 0);
    for (std::size_t f = 1; f < times_.size(); ++f)
        if (points(object, f) != first) return true;
    return false;
}

// One mesh an object, one primitive a material, all with the same vertices. Empty: there are no faces.
std::optional<int> GltfFile::add_mesh(std::size_t o, bool moves, GltfContent& content) const {
    const AnimatedSurface::Object& object = surface_.objects[o];
    if (object.parts.empty()) return {};
    const std::vector<float> first = points(object, 0);
    const std::vector<glm::vec3> positions = vertex_positions(object, first),
                                 normals = vertex_normals(object, first);
    Json attributes{{"POSITION", content.add_positions(positions)},
                    {"NORMAL", content.add(normals, "VEC3", kFloat, kArrayBuffer)}};
    if (object.has_uvs) {
        std::vector<glm::vec2> uvs;  // glTF's (0, 0) is the upper left
        for (const auto& vertex : object.vertices) uvs.emplace_back(vertex.uv.x, 1.0f - vertex.uv.y);
        attributes["TEXCOORD_0"] = content.add(uvs, "VEC2", kFloat, kArrayBuffer);
    }
    Json targets = Json::array();
    for (std::size_t f = 1; moves && f < times_.size(); ++f) {
        const std::vector<float> now = points(object, f);
        targets.push_back(
            {{"POSITION", content.add_positions(changes(vertex_positions(object, now), positions))},
             {"NORMAL",
              content.add(changes(vertex_normals(object, now), normals), "VEC3", kFloat, kArrayBuffer)}});
    }
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
    Json mesh{{"name", object.name}, {"primitives", std::move(primitives)}};
    if (moves) mesh["weights"] = std::vector<float>(times_.size() - 1);
    return content.append("meshes", std::move(mesh));
}

// One channel for each node that moves; they share their keys.
void GltfFile::add_animation(const std::vector<int>& moving, GltfContent& content) const {
    if (moving.empty()) return;
    std::vector<float> seconds;
    for (const double time : times_) seconds.push_back(static_cast<float>(time - times_.front()));
    const int input = content.add(seconds, "SCALAR", kFloat);
    Json& described = content.json["accessors"][static_cast<std::size_t>(input)];
    described["min"] = {seconds.front()};
    described["max"] = {seconds.back()};
    const std::size_t targets = times_.size() - 1;
    const int output = content.add_rows(times_.size(), targets,
                                        [&](std::size_t frame) { return weights_at(frame, targets); });
    Json channels = Json::array();
    for (const int node : moving)
        channels.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
    content.json["animations"] = {
        {{"name", "simulation"},
         {"channels", channels},
         {"samplers", {{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}}}}};
}

void GltfFile::finish() {
    GltfContent content(file_);
    add_materials(surface_.look, content);
    const glm::dquat turn = upright(settings_.up, Axis::y);  // glTF is y-up
    std::vector<int> nodes, moving;
    for (std::size_t o = 0; o < surface_.objects.size(); ++o) {
        const bool moves = this->moves(surface_.objects[o]);
        const std::optional<int> mesh = add_mesh(o, moves, content);
        if (!mesh) continue;
        Json node{{"name", surface_.objects[o].name}, {"mesh", *mesh}};
        if (settings_.up != Axis::y) node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
        nodes.push_back(content.append("nodes", std::move(node)));
        if (moves) moving.push_back(nodes.back());
    }
    content.json["scenes"] = {{{"nodes", nodes}}};
    add_animation(moving, content);
    content.write();
}

}  // namespace gelatin
