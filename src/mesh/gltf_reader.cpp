#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <limits>

#include "gelatin/error.h"
#include "mesh/gltf_document.h"
#include "mesh/gltf_materials.h"
#include "mesh/ignored.h"
#include "mesh/surface_readers.h"

namespace gelatin {
namespace {

using Json = GltfDocument::Json;

// Extensions that a reader of triangles, colours and images may leave out although a file requires them.
bool is_harmless(std::string_view extension) {
    constexpr std::array kHarmless = {"KHR_mesh_quantization", "KHR_technique_webgl", "KHR_techniques_webgl",
                                      "KHR_texture_transform", "KHR_lights_punctual", "KHR_xmp_json_ld",
                                      "KHR_texture_basisu",    "EXT_texture_webp"};
    return extension.starts_with("KHR_materials_") ||
           std::find(kHarmless.begin(), kHarmless.end(), extension) != kHarmless.end();
}

class GltfReader {
public:
    GltfReader(const std::filesystem::path& file, std::string_view content, Notes& notes)
        : document_(file, content), materials_(document_), notes_(notes) {}

    SurfacePolygons read() {
        refuse_extensions();
        read_scene();
        if (!polygons_.corner_uvs.empty()) polygons_.corner_uvs.resize(polygons_.corners.size());
        materials_.finish(polygons_, notes_, ignored_);
        for (const char* list : {"animations", "skins"}) ignored_.add(list, document_.list(list).size());
        ignored_.report(notes_);
        return std::move(polygons_);
    }

private:
    void refuse_extensions() const {
        for (const Json& extension : document_.list("extensionsRequired")) {
            const std::string name = extension.get<std::string>();
            if (!is_harmless(name)) {
                document_.fail("extensionsRequired", name,
                               "is not read: export the file without it, for instance without compression");
            }
        }
    }

    void read_scene() {
        const std::size_t node_count = document_.list("nodes").size();
        if (node_count == 0) {  // then all meshes, where they are
            for (std::size_t m = 0; m < document_.list("meshes").size(); ++m) read_mesh(m, glm::dmat4(1.0));
            return;
        }
        is_visited_.assign(node_count, false);
        std::vector<Placed> open;
        if (!document_.list("scenes").empty()) {
            const std::size_t scene =
                document_.optional_number(document_.json(), "scene", "file").value_or(0);
            add_nodes(document_.item("scenes", scene), "nodes", glm::dmat4(1.0), open);
        } else {
            for (const std::size_t root : roots()) open.push_back({root, glm::dmat4(1.0)});
        }
        std::reverse(open.begin(), open.end());
        while (!open.empty()) {
            const Placed placed = open.back();
            open.pop_back();
            read_node(placed, open);
        }
    }

    struct Placed {
        std::size_t node;
        glm::dmat4 above;  // the transform of its parents
    };

    void add_nodes(const Json& object, const char* key, const glm::dmat4& above,
                   std::vector<Placed>& open) const {
        const auto nodes = object.find(key);
        if (nodes == object.end()) return;
        for (const Json& node : *nodes) {
            if (!node.is_number_unsigned()) document_.fail(key, node.dump(), "must be a whole number");
            open.push_back({node.get<std::size_t>(), above});
        }
    }

    std::vector<std::size_t> roots() const {
        std::vector<Placed> children;
        for (std::size_t n = 0; n < document_.list("nodes").size(); ++n)
            add_nodes(document_.item("nodes", n), "children", glm::dmat4(1.0), children);
        std::vector<bool> is_child(document_.list("nodes").size(), false);
        for (const Placed& child : children) {
            if (child.node < is_child.size()) is_child[child.node] = true;
        }
        std::vector<std::size_t> roots;
        for (std::size_t n = 0; n < is_child.size(); ++n) {
            if (!is_child[n]) roots.push_back(n);
        }
        return roots;
    }

    void read_node(const Placed& placed, std::vector<Placed>& open) {
        const Json& node = document_.item("nodes", placed.node);
        const std::string what = fmt::format("nodes[{}]", placed.node);
        if (is_visited_[placed.node]) document_.fail(what, {}, "occurs twice in the scene");
        is_visited_[placed.node] = true;
        const glm::dmat4 transform = placed.above * transform_of(node, what);
        if (const auto mesh = document_.optional_number(node, "mesh", what)) read_mesh(*mesh, transform);
        const auto extensions = node.find("extensions");
        if (extensions != node.end() && extensions->contains("EXT_mesh_gpu_instancing"))
            ignored_.add("copies of meshes (EXT_mesh_gpu_instancing)");
        const std::size_t first = open.size();
        add_nodes(node, "children", transform, open);
        std::reverse(open.begin() + static_cast<std::ptrdiff_t>(first), open.end());
    }

    glm::dmat4 transform_of(const Json& node, const std::string& what) const {
        glm::dmat4 transform(1.0);
        if (const auto matrix = document_.numbers(node, "matrix", 16, what)) {
            for (int k = 0; k < 16; ++k) transform[k / 4][k % 4] = (*matrix)[static_cast<std::size_t>(k)];
            return transform;
        }
        const auto values = [&](const char* key, const std::vector<double>& otherwise) {
            return document_.numbers(node, key, otherwise.size(), what).value_or(otherwise);
        };
        const auto move = values("translation", {0, 0, 0}), turn = values("rotation", {0, 0, 0, 1}),
                   scale = values("scale", {1, 1, 1});
        const glm::dmat3 rotation = glm::mat3_cast(normalize(glm::dquat(turn[3], turn[0], turn[1], turn[2])));
        for (int k = 0; k < 3; ++k) {
            transform[k] = glm::dvec4(rotation[k] * scale[static_cast<std::size_t>(k)], 0.0);
            transform[3][k] = move[static_cast<std::size_t>(k)];
        }
        return transform;
    }

    void read_mesh(std::size_t index, const glm::dmat4& transform) {
        const Json& mesh = document_.item("meshes", index);
        const auto primitives = mesh.find("primitives");
        if (primitives == mesh.end()) return;
        for (std::size_t p = 0; p < primitives->size(); ++p)
            read_primitive(primitives->at(p), fmt::format("meshes[{}].primitives[{}]", index, p), transform);
    }

    void read_primitive(const Json& primitive, const std::string& what, const glm::dmat4& transform) {
        constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;
        const std::size_t mode = document_.optional_number(primitive, "mode", what).value_or(kTriangles);
        if (mode == 0) return ignored_.add("groups of points");
        if (mode < kTriangles) return ignored_.add("groups of lines");
        if (mode > kFan) document_.fail(what + ".mode", fmt::format("{}", mode), "must be from 0 to 6");
        if (primitive.contains("targets")) ignored_.add("morph targets", primitive.at("targets").size());

        const Json& attributes = primitive.at("attributes");
        const std::size_t first = polygons_.positions.size();
        const std::size_t count = read_positions(attributes, what, transform);
        if (attributes.contains("COLOR_0")) ignored_.add("colours of vertices", count);
        const std::vector<std::size_t> vertices = read_indices(primitive, what, count);

        const std::uint32_t material = materials_.index_of(primitive, what);
        const std::vector<glm::vec2> uvs = read_uvs(attributes, material, count);
        if (!uvs.empty()) polygons_.corner_uvs.resize(polygons_.corners.size());  // of parts without
        const bool is_mirrored = determinant(glm::dmat3(transform)) < 0.0;
        const std::size_t step = mode == kTriangles ? 3 : 1;
        for (std::size_t k = 0; k + 2 < vertices.size(); k += step) {
            std::array<std::size_t, 3> corners = {vertices[k], vertices[k + 1], vertices[k + 2]};
            if (mode == kFan) corners[0] = vertices[0];
            const bool is_swapped = is_mirrored != (mode == kStrip && k % 2 == 1);
            if (is_swapped) std::swap(corners[1], corners[2]);
            for (const std::size_t vertex : corners) {
                polygons_.corners.push_back(static_cast<std::uint32_t>(first + vertex));
                if (!uvs.empty()) polygons_.corner_uvs.push_back(uvs[vertex]);
            }
            polygons_.sizes.push_back(3);
            polygons_.polygon_materials.push_back(material);
        }
    }

    std::size_t read_positions(const Json& attributes, const std::string& what, const glm::dmat4& transform) {
        const GltfArray array =
            document_.read_accessor(document_.whole_number(attributes, "POSITION", what + ".attributes"));
        if (array.components != 3) document_.fail(what + ".attributes.POSITION", {}, "must be of type VEC3");
        if (polygons_.positions.size() + array.count > std::numeric_limits<std::uint32_t>::max())
            document_.fail(what, {}, "the file has more than 4 billion vertices");
        for (std::size_t v = 0; v < array.count; ++v) {
            const double* const p = &array.values[3 * v];
            const glm::dvec3 position(transform * glm::dvec4(p[0], p[1], p[2], 1.0));
            for (int axis = 0; axis < 3; ++axis) {
                if (std::abs(position[axis]) <= std::numeric_limits<float>::max()) continue;
                document_.fail(fmt::format("{}, vertex {}", what, v), fmt::format("{}", position[axis]),
                               "coordinates must be finite, and no larger than 3.4e38");
            }
            polygons_.positions.push_back(position);
        }
        return array.count;
    }

    std::vector<std::size_t> read_indices(const Json& primitive, const std::string& what, std::size_t count) {
        std::vector<std::size_t> vertices;
        const auto indices = document_.optional_number(primitive, "indices", what);
        if (!indices) {
            for (std::size_t v = 0; v < count; ++v) vertices.push_back(v);
            return vertices;
        }
        const GltfArray array = document_.read_accessor(*indices);
        vertices.reserve(array.values.size());
        for (const double index : array.values) {
            if (!(index >= 0.0 && index < static_cast<double>(count)))
                document_.fail(what + ".indices", fmt::format("{}", index),
                               fmt::format("must be below {}", count));
            vertices.push_back(static_cast<std::size_t>(index));
        }
        return vertices;
    }

    std::vector<glm::vec2> read_uvs(const Json& attributes, std::uint32_t material, std::size_t count) {
        const std::string key = fmt::format("TEXCOORD_{}", materials_.uv_set(material));
        const auto accessor = document_.optional_number(attributes, key.c_str(), "attributes");
        if (!accessor) return {};
        const GltfArray array = document_.read_accessor(*accessor);
        if (array.components != 2 || array.count < count)
            document_.fail("TEXCOORD", fmt::format("{}", array.count),
                           fmt::format("must be {} of type VEC2", count));
        std::vector<glm::vec2> uvs;
        const auto finite = [](double value) {
            return std::abs(value) <= std::numeric_limits<float>::max() ? static_cast<float>(value) : 0.0f;
        };
        for (std::size_t v = 0; v < count; ++v)  // glTF's v points down
            uvs.emplace_back(finite(array.values[2 * v]), finite(1.0 - array.values[2 * v + 1]));
        return uvs;
    }

    GltfDocument document_;
    GltfMaterials materials_;
    Notes& notes_;
    Ignored ignored_;
    SurfacePolygons polygons_;
    std::vector<bool> is_visited_;  // of each node
};

}  // namespace

SurfacePolygons read_gltf(const std::filesystem::path& file, std::string_view content, Notes& notes) {
    try {
        return GltfReader(file, content, notes).read();
    } catch (const Json::exception& error) {
        throw InvalidInput({file.string(), 0, {}, {}, std::string("cannot be read: ") + error.what()});
    }
}

}  // namespace gelatin
