#include "sim/animation/usd_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <utility>

#include "core/file.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

// USD's names have letters, digits and underscores.
std::string identifier(const std::string& name, std::set<std::string>& taken) {
    std::string result;
    for (const char c : name)
        result += std::isalnum(static_cast<unsigned char>(c)) != 0 && (c & 0x80) == 0 ? c : '_';
    if (result.empty() || std::isdigit(static_cast<unsigned char>(result[0])) != 0) result = "_" + result;
    std::string unique = result;
    for (int k = 2; !taken.insert(unique).second; ++k) unique = fmt::format("{}_{}", result, k);
    return unique;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (c == '\n') {
            result += "\\n";
        } else {
            result += c;
        }
    }
    return result + "\"";
}

template <class Vectors>
void append_vectors(const Vectors& values, std::string& text) {
    auto out = std::back_inserter(text);
    text += '[';
    for (std::size_t k = 0; k < values.size(); ++k)
        fmt::format_to(out, "{}({}, {}, {})", k == 0 ? "" : ", ", values[k].x, values[k].y, values[k].z);
    text += ']';
}

template <class Vectors>
std::string sample(int frame, const Vectors& values) {
    std::string text = fmt::format("            {}: ", frame);
    append_vectors(values, text);
    return text + ",\n";
}

std::vector<glm::vec3> range_of(const std::vector<float>& values, const Range& range) {
    std::vector<glm::vec3> result;
    for (std::size_t n = range.first; n < range.end(); ++n)
        result.emplace_back(values[3 * n], values[3 * n + 1], values[3 * n + 2]);
    return result;
}

std::string joined(const std::vector<std::uint32_t>& numbers) {
    return fmt::format("[{}]", fmt::join(numbers, ", "));
}

const char* ending_of(const std::string& image) {
    return image.starts_with("\x89PNG") ? ".png" : ".jpg";
}

}  // namespace

UsdFile::UsdFile(std::filesystem::path file, const Model& model, AnimationSettings settings)
    : file_(std::move(file)),
      model_(model),
      settings_(std::move(settings)),
      surface_(make_animated_surface(model)),
      points_(model.objects.size()),
      velocities_(model.objects.size()),
      nodes_(model.objects.size()) {}

void UsdFile::write(const HostFrame& frame) {
    frames_.push_back(frame.frame);
    const std::vector<float> points = carry_skin(surface_.points, std::span(frame.positions)),
                             velocities = carry_skin(surface_.points, std::span(frame.velocities));
    for (std::size_t o = 0; o < surface_.objects.size(); ++o) {
        const AnimatedSurface::Object& object = surface_.objects[o];
        points_[o] += sample(frame.frame, vertex_positions(object, points));
        velocities_[o] += sample(frame.frame, vertex_positions(object, velocities));
        if (model_.is_body(o))
            nodes_[o] += sample(frame.frame, range_of(frame.positions, model_.objects[o].nodes));
    }
}

std::string UsdFile::object_text(std::size_t o, const std::string& name,
                                 const std::vector<std::string>& materials) const {
    const AnimatedSurface::Object& object = surface_.objects[o];
    std::vector<std::uint32_t> corners;
    for (const AnimatedSurface::Part& part : object.parts)
        corners.insert(corners.end(), part.corners.begin(), part.corners.end());
    const glm::vec3& color = settings_.colors[o];
    const bool has_material = object.parts.size() == 1 && object.parts[0].material != SurfaceLook::kNone;
    std::string text =
        fmt::format("    def Mesh {} (\n        displayName = {}\n", quoted(name), quoted(object.name));
    if (!surface_.look.is_empty()) text += "        prepend apiSchemas = [\"MaterialBindingAPI\"]\n";
    text += "    )\n    {\n        uniform token subdivisionScheme = \"none\"\n";
    text += fmt::format("        int[] faceVertexCounts = {}\n",
                        joined(std::vector<std::uint32_t>(corners.size() / 3, 3)));
    text += fmt::format("        int[] faceVertexIndices = {}\n", joined(corners));
    text +=
        fmt::format("        color3f[] primvars:displayColor = [({}, {}, {})]\n", color.r, color.g, color.b);
    if (object.has_uvs) {
        text += "        texCoord2f[] primvars:st = [";
        for (std::size_t v = 0; v < object.vertices.size(); ++v)
            text += fmt::format("{}({}, {})", v == 0 ? "" : ", ", object.vertices[v].uv.x,
                                object.vertices[v].uv.y);
        text += "] (\n            interpolation = \"vertex\"\n        )\n";
    }
    text += "        point3f[] points.timeSamples = {\n" + points_[o] + "        }\n";
    text += "        vector3f[] velocities.timeSamples = {\n" + velocities_[o] + "        }\n";
    if (has_material)
        text += fmt::format("        rel material:binding = </simulation/materials/{}>\n",
                            materials[object.parts[0].material]);
    std::uint32_t first = 0;
    for (const AnimatedSurface::Part& part : object.parts) {
        const auto faces = static_cast<std::uint32_t>(part.corners.size() / 3);
        if (!has_material && part.material != SurfaceLook::kNone) {
            std::vector<std::uint32_t> indices;
            for (std::uint32_t f = 0; f < faces; ++f) indices.push_back(first + f);
            text += fmt::format(
                "        def GeomSubset \"part_{}\" (\n            prepend apiSchemas = "
                "[\"MaterialBindingAPI\"]\n        )\n"
                "        {{\n            uniform token elementType = \"face\"\n            uniform token "
                "familyName = "
                "\"materialBind\"\n            int[] indices = {}\n            rel material:binding = "
                "</simulation/materials/{}>\n        }}\n",
                part.material, joined(indices), materials[part.material]);
        }
        first += faces;
    }
    return text + "    }\n";
}

std::string UsdFile::tets_text(std::size_t o) const {
    const ModelObject& object = model_.objects[o];
    std::string tets = "[";
    for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t) {
        const glm::uvec4 corners = model_.tets[t] - glm::uvec4(object.nodes.first);
        tets += fmt::format("{}({}, {}, {}, {})", t == object.tets.first ? "" : ", ", corners.x, corners.y,
                            corners.z, corners.w);
    }
    return fmt::format(
        "        uniform token purpose = \"guide\"\n        int4[] tetVertexIndices = {}]\n        point3f[] "
        "points.timeSamples = {{\n{}        }}\n",
        tets, nodes_[o]);
}

std::string UsdFile::image_name(std::size_t material, const std::string& name) const {
    return file_.stem().string() + "_" + name + ending_of(*surface_.look.materials[material].image);
}

std::string UsdFile::materials_text(const std::vector<std::string>& names) const {
    if (names.empty()) return "";
    std::string text = "    def Scope \"materials\"\n    {\n";
    for (std::size_t m = 0; m < names.size(); ++m) {
        const SurfaceMaterial& material = surface_.look.materials[m];
        const std::string path = "/simulation/materials/" + names[m];
        const std::string color =
            material.image ? fmt::format("color3f inputs:diffuseColor.connect = <{}/image.outputs:rgb>", path)
                           : fmt::format("color3f inputs:diffuseColor = ({}, {}, {})", material.color.r,
                                         material.color.g, material.color.b);
        text += fmt::format(
            "        def Material {0}\n        {{\n            token outputs:surface.connect = "
            "<{1}/surface.outputs:surface>\n            def Shader \"surface\"\n            {{\n             "
            "   uniform "
            "token info:id = \"UsdPreviewSurface\"\n                {2}\n                float "
            "inputs:roughness = "
            "0.6\n                token outputs:surface\n            }}\n",
            quoted(names[m]), path, color);
        if (material.image) {
            text += fmt::format(
                "            def Shader \"image\"\n            {{\n                uniform token info:id = "
                "\"UsdUVTexture\"\n                asset inputs:file = @./{0}@\n                token "
                "inputs:wrapS = "
                "\"repeat\"\n                token inputs:wrapT = \"repeat\"\n                float4 "
                "inputs:scale = ({1}, "
                "{2}, {3}, 1)\n                float2 inputs:st.connect = <{4}/coordinates.outputs:result>\n "
                "         "
                "      float3 outputs:rgb\n            }}\n            def Shader \"coordinates\"\n          "
                "  {{\n     "
                "           uniform token info:id = \"UsdPrimvarReader_float2\"\n                string "
                "inputs:varname = \"st\"\n                float2 outputs:result\n            }}\n",
                image_name(m, names[m]), material.color.r, material.color.g, material.color.b, path);
        }
        text += "        }\n";
    }
    return text + "    }\n";
}

void UsdFile::finish() {
    std::string text = fmt::format(
        "#usda 1.0\n(\n    defaultPrim = \"simulation\"\n    doc = \"Gelatin {}\"\n    startTimeCode = {}\n  "
        "  "
        "endTimeCode = {}\n    timeCodesPerSecond = {}\n    framesPerSecond = {}\n    metersPerUnit = 1\n    "
        "upAxis = "
        "\"Y\"\n)\n\ndef Xform \"simulation\" (\n    kind = \"component\"\n)\n{{\n",
        version(), frames_.front(), frames_.back(), settings_.frame_rate, settings_.frame_rate);
    std::set<std::string> taken{"materials"}, of_materials;
    std::vector<std::string> materials;
    for (const SurfaceMaterial& material : surface_.look.materials)
        materials.push_back(identifier(material.name, of_materials));
    for (std::size_t o = 0; o < surface_.objects.size(); ++o) {
        const std::string name = identifier(surface_.objects[o].name, taken);
        text += object_text(o, name, materials);
        if (!model_.is_body(o)) continue;
        text += fmt::format("    def TetMesh {}\n    {{\n{}    }}\n",
                            quoted(identifier(surface_.objects[o].name + "_tets", taken)), tets_text(o));
    }
    for (std::size_t m = 0; m < materials.size(); ++m)
        if (const auto& image = surface_.look.materials[m].image)
            write_file(file_.parent_path() / image_name(m, materials[m]), *image);
    write_file(file_, text + materials_text(materials) + "}\n");
}

}  // namespace gelatin
