#include "sim/animation/usd_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "core/file.h"
#include "core/file_writer.h"
#include "gelatin/version.h"
#include "sim/animation/usd_joints.h"

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

std::vector<glm::vec3> vectors_of(const std::vector<float>& values) {
    std::vector<glm::vec3> result;
    for (std::size_t n = 0; n < values.size(); n += 3)
        result.emplace_back(values[n], values[n + 1], values[n + 2]);
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
      points_(file_, 3 * surface_.points.size()),
      velocities_(file_, 3 * surface_.points.size()),
      nodes_(file_, 3 * std::size_t{model.node_count()}) {
    give_plain_objects_materials();
}

// Of their colour: not every program shows displayColor.
void UsdFile::give_plain_objects_materials() {
    for (std::size_t o = 0; o < surface_.objects.size(); ++o) {
        for (AnimatedSurface::Part& part : surface_.objects[o].parts) {
            if (part.material != SurfaceLook::kNone) continue;
            part.material = static_cast<std::uint32_t>(surface_.look.materials.size());
            surface_.look.materials.push_back({surface_.objects[o].name, settings_.colors[o], "", nullptr});
        }
    }
}

void UsdFile::write(const HostFrame& frame) {
    frames_.push_back(frame.frame);
    points_.add(carry_skin(surface_.points, std::span(frame.positions)));
    velocities_.add(carry_skin(surface_.points, std::span(frame.velocities)));
    nodes_.add(frame.positions);
}

void UsdFile::append_samples(const char* name, const FrameStore& store, const Range& range,
                             const AnimatedSurface::Object* object, FileWriter& out) const {
    out.append(fmt::format("        {}.timeSamples = {{\n", name));
    for (std::size_t f = 0; f < frames_.size(); ++f) {
        const std::vector<float> values =
            store.read(f, 3 * std::size_t{range.first}, 3 * std::size_t{range.count});
        out.append(sample(frames_[f], object ? vertex_positions(*object, values) : vectors_of(values)));
    }
    out.append("        }\n");
}

void UsdFile::append_object(std::size_t o, const std::string& name, const std::vector<std::string>& materials,
                            FileWriter& out) const {
    const AnimatedSurface::Object& object = surface_.objects[o];
    std::vector<std::uint32_t> corners;
    for (const AnimatedSurface::Part& part : object.parts)
        corners.insert(corners.end(), part.corners.begin(), part.corners.end());
    const glm::vec3& color = settings_.colors[o];
    const bool has_material = object.parts.size() == 1 && object.parts[0].material != SurfaceLook::kNone;
    std::string text =
        fmt::format("    def Mesh {} (\n        displayName = {}\n", quoted(name), quoted(object.name));
    std::vector<std::string> schemas;
    if (!surface_.look.is_empty()) schemas.emplace_back("\"MaterialBindingAPI\"");
    if (model_.objects[o].is_rigid) {
        schemas.emplace_back("\"PhysicsRigidBodyAPI\"");
        schemas.emplace_back("\"PhysicsMassAPI\"");
    }
    if (!schemas.empty())
        text += fmt::format("        prepend apiSchemas = [{}]\n", fmt::join(schemas, ", "));
    text += "    )\n    {\n        uniform token subdivisionScheme = \"none\"\n";
    // Frames move it.
    if (model_.objects[o].is_rigid)
        text += fmt::format("        bool physics:kinematicEnabled = true\n        float physics:mass = {}\n",
                            model_.objects[o].mass);
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
    out.append(text);
    append_samples("point3f[] points", points_, object.points, &object, out);
    append_samples("vector3f[] velocities", velocities_, object.points, &object, out);
    text.clear();
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
    out.append(text + "    }\n");
}

void UsdFile::append_tets(std::size_t o, const std::string& name, FileWriter& out) const {
    const ModelObject& object = model_.objects[o];
    std::string tets;
    for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t) {
        const glm::uvec4 corners = model_.tets[t] - glm::uvec4(object.nodes.first);
        tets += fmt::format("{}({}, {}, {}, {})", t == object.tets.first ? "" : ", ", corners.x, corners.y,
                            corners.z, corners.w);
    }
    out.append(
        fmt::format("    def TetMesh {}\n    {{\n        uniform token purpose = \"guide\"\n"
                    "        int4[] tetVertexIndices = [{}]\n",
                    quoted(name), tets));
    append_samples("point3f[] points", nodes_, object.nodes, nullptr, out);
    out.append("    }\n");
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

std::string UsdFile::head() const {
    return fmt::format(
        "#usda 1.0\n(\n    defaultPrim = \"simulation\"\n    doc = \"Gelatin {}\"\n    startTimeCode = {}\n"
        "    endTimeCode = {}\n    timeCodesPerSecond = {}\n    framesPerSecond = {}\n    metersPerUnit = 1\n"
        "    upAxis = \"{}\"\n)\n\ndef Xform \"simulation\" (\n    kind = \"component\"\n)\n{{\n",
        version(), frames_.front(), frames_.back(), settings_.frame_rate, settings_.frame_rate,
        settings_.up == Axis::z ? "Z" : "Y");
}

void UsdFile::finish() {
    FileWriter out(file_);
    out.append(head());
    std::set<std::string> taken{"materials", "joints"}, of_materials;
    std::vector<std::string> materials;
    for (const SurfaceMaterial& material : surface_.look.materials)
        materials.push_back(identifier(material.name, of_materials));
    std::map<std::string, std::string> rigid;  // paths by name
    for (std::size_t o = 0; o < surface_.objects.size(); ++o) {
        const std::string name = identifier(surface_.objects[o].name, taken);
        append_object(o, name, materials, out);
        if (model_.objects[o].is_rigid || !model_.is_body(static_cast<std::uint32_t>(o)))
            rigid.emplace(surface_.objects[o].name, "/simulation/" + name);
        if (model_.objects[o].tets.count > 0)
            append_tets(o, identifier(surface_.objects[o].name + "_tets", taken), out);
    }
    out.append(usd_joints(settings_.attachments, rigid) + materials_text(materials) + "}\n");
    for (std::size_t m = 0; m < materials.size(); ++m)
        if (const auto& image = surface_.look.materials[m].image)
            write_file(file_.parent_path() / image_name(m, materials[m]), *image);
    out.finish();
}

}  // namespace gelatin
