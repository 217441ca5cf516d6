#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/gltf_document.h"
#include "mesh/gltf_materials.h"
#include "mesh/gltf_scene.h"
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
        : document_(file, content), materials_(document_), notes_(notes), scene_(document_, ignored_) {}

    SurfacePolygons read() {
        refuse_extensions();
        read_scene();
        place_vertices();
        if (!polygons_.corner_uvs.empty()) polygons_.corner_uvs.resize(polygons_.corners.size());
        materials_.finish(polygons_, notes_, ignored_);
        ignored_.report(notes_);
        return std::move(polygons_);
    }

    SkinnedVertices read_vertices(const std::string& clip) {
        read();
        vertices_.clip = scene_.read_clip(clip);
        return std::move(vertices_);
    }

    SkinnedVertices read_bones(const std::string& clip) {
        refuse_extensions();
        SkinnedVertices bones = scene_.bones();
        bones.clip = scene_.read_clip(clip);
        return bones;
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
        for (const GltfScene::Mesh& mesh : scene_.meshes()) {
            const Json& json = document_.item("meshes", mesh.mesh);
            const auto primitives = json.find("primitives");
            if (primitives == json.end()) continue;
            for (std::size_t p = 0; p < primitives->size(); ++p)
                read_primitive(mesh, primitives->at(p),
                               fmt::format("meshes[{}].primitives[{}]", mesh.mesh, p));
        }
        vertices_ = scene_.vertices();
    }

    void read_primitive(const GltfScene::Mesh& mesh, const Json& primitive, const std::string& what) {
        constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;
        const std::size_t mode = document_.optional_number(primitive, "mode", what).value_or(kTriangles);
        if (mode == 0) return ignored_.add("groups of points");
        if (mode < kTriangles) return ignored_.add("groups of lines");
        if (mode > kFan) document_.fail(what + ".mode", fmt::format("{}", mode), "must be from 0 to 6");

        const Json& attributes = primitive.at("attributes");
        const std::size_t first = parts_.empty() ? 0 : parts_.back().first + parts_.back().count;
        const auto [count, is_mirrored] = scene_.add_vertices(mesh, primitive, what);
        parts_.push_back({first, count, what});
        if (attributes.contains("COLOR_0")) ignored_.add("colours of vertices", count);
        const std::vector<std::size_t> vertices = read_indices(primitive, what, count);

        const std::uint32_t material = materials_.index_of(primitive, what);
        const std::vector<glm::vec2> uvs = read_uvs(attributes, material, count);
        if (!uvs.empty()) polygons_.corner_uvs.resize(polygons_.corners.size());  // of parts without
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

    // As the file's own pose places them.
    void place_vertices() {
        polygons_.positions = gelatin::place_vertices(vertices_, 0.0, 0.0);
        if (polygons_.positions.size() > std::numeric_limits<std::uint32_t>::max())
            document_.fail({}, {}, "the file has more than 4 billion vertices");
        for (std::size_t v = 0; v < polygons_.positions.size(); ++v) {
            for (int axis = 0; axis < 3; ++axis) {
                const double coordinate = polygons_.positions[v][axis];
                if (std::abs(coordinate) <= std::numeric_limits<float>::max()) continue;
                const auto part =
                    std::prev(std::upper_bound(parts_.begin(), parts_.end(), v,
                                               [](std::size_t of, const Part& p) { return of < p.first; }));
                document_.fail(fmt::format("{}, vertex {}", part->what, v - part->first),
                               fmt::format("{}", coordinate),
                               "coordinates must be finite, and no larger than 3.4e38");
            }
        }
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

    // A primitive's vertices.
    struct Part {
        std::size_t first, count;
        std::string what;
    };

    GltfDocument document_;
    GltfMaterials materials_;
    Notes& notes_;
    Ignored ignored_;
    GltfScene scene_;
    SurfacePolygons polygons_;
    SkinnedVertices vertices_;
    std::vector<Part> parts_;
};

// Calls it with a reader of the file.
template <class Read>
auto with_reader(const std::filesystem::path& file, std::string_view content, Notes& notes,
                 const Read& read) {
    try {
        GltfReader reader(file, content, notes);
        return read(reader);
    } catch (const Json::exception& error) {
        throw InvalidInput({file.string(), 0, {}, {}, std::string("cannot be read: ") + error.what()});
    }
}

}  // namespace

SurfacePolygons read_gltf(const std::filesystem::path& file, std::string_view content, Notes& notes) {
    return with_reader(file, content, notes, [](GltfReader& reader) { return reader.read(); });
}

SkinnedVertices read_gltf_vertices(const std::filesystem::path& file, const std::string& clip) {
    Notes notes;
    return with_reader(file, read_file(file), notes,
                       [&](GltfReader& reader) { return reader.read_vertices(clip); });
}

SkinnedVertices read_gltf_bones(const std::filesystem::path& file, const std::string& clip) {
    Notes notes;
    return with_reader(file, read_file(file), notes,
                       [&](GltfReader& reader) { return reader.read_bones(clip); });
}

}  // namespace gelatin
