#include "mesh/surface_import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <assimp/IOStream.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>

#include "gelatin/error.h"
#include "mesh/files_beside.h"
#include "mesh/import_look.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

struct Part {
    const aiMesh& mesh;
    aiMatrix4x4 transform;
};

void list_parts(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above,
                std::vector<Part>& parts) {
    const aiMatrix4x4 transform = above * node.mTransformation;
    for (unsigned int m = 0; m < node.mNumMeshes; ++m)
        parts.push_back({*scene.mMeshes[node.mMeshes[m]], transform});
    for (unsigned int c = 0; c < node.mNumChildren; ++c)
        list_parts(scene, *node.mChildren[c], transform, parts);
}

// Only glTF has nodes of its own.
std::vector<Part> parts_of(const aiScene& scene, bool has_nodes) {
    std::vector<Part> parts;
    if (has_nodes && scene.mRootNode != nullptr) {
        list_parts(scene, *scene.mRootNode, aiMatrix4x4(), parts);
        return parts;
    }
    for (unsigned int m = 0; m < scene.mNumMeshes; ++m) parts.push_back({*scene.mMeshes[m], aiMatrix4x4()});
    return parts;
}

void append_vertices(const fs::path& file, const Part& part, SurfaceMesh& mesh) {
    for (unsigned int v = 0; v < part.mesh.mNumVertices; ++v) {
        const aiVector3D p = part.transform * part.mesh.mVertices[v];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            throw InvalidInput({file.string(), 0,
                                fmt::format("vertex {} of part '{}'", v + 1, part.mesh.mName.C_Str()),
                                fmt::format("({}, {}, {})", p.x, p.y, p.z), "coordinates must be finite"});
        }
        mesh.positions.emplace_back(p.x, p.y, p.z);
    }
}

glm::vec2 finite_uv(const aiVector3D& uv) {
    return std::isfinite(uv.x) && std::isfinite(uv.y) ? glm::vec2(uv.x, uv.y) : glm::vec2(0.0f);
}

void append_part(const fs::path& file, const Part& part, SurfaceMesh& mesh) {
    const std::size_t first = mesh.positions.size();
    append_vertices(file, part, mesh);
    const aiVector3D* uvs = part.mesh.mTextureCoords[0];
    for (unsigned int f = 0; f < part.mesh.mNumFaces; ++f) {
        const aiFace& face = part.mesh.mFaces[f];
        if (face.mNumIndices != 3) continue;  // points and lines
        glm::uvec3 corners;
        std::array<glm::vec2, 3> corner_uvs{};
        for (unsigned int k = 0; k < 3; ++k) {
            const unsigned int vertex = face.mIndices[k];
            if (vertex >= part.mesh.mNumVertices) {
                throw InvalidInput({file.string(),
                                    0,
                                    fmt::format("face {}", f + 1),
                                    {},
                                    "names a vertex that is not there"});
            }
            corners[static_cast<int>(k)] = static_cast<std::uint32_t>(first + vertex);
            if (uvs != nullptr) corner_uvs[k] = finite_uv(uvs[vertex]);
        }
        mesh.faces.push_back(corners);
        mesh.look.corner_uvs.push_back(corner_uvs);
        mesh.look.face_materials.push_back(part.mesh.mMaterialIndex);
    }
}

bool has_uvs(const std::vector<Part>& parts) {
    for (const Part& part : parts) {
        if (part.mesh.mTextureCoords[0] != nullptr) return true;
    }
    return false;
}

}  // namespace

SurfaceMesh import_surface(const fs::path& file, const std::string& ending, const std::string& content,
                           Notes& notes) {
    Assimp::Importer importer;
    auto* files = new FilesBeside(file, content);
    importer.SetIOHandler(files);  // which owns it
    const aiScene* scene = nullptr;
    std::string reason;
    try {
        // Validation comes first, because triangulation trusts the indices.
        scene = importer.ReadFile(files->name(), aiProcess_ValidateDataStructure | aiProcess_Triangulate);
        reason = importer.GetErrorString();
    } catch (const std::exception& error) {
        reason = error.what();
    }
    if (scene == nullptr) throw InvalidInput({file.string(), 0, {}, {}, "cannot be read: " + reason});

    const bool is_gltf = ending == ".gltf" || ending == ".glb", is_obj = ending == ".obj";
    const std::vector<Part> parts = parts_of(*scene, is_gltf);
    SurfaceMesh mesh;
    for (const Part& part : parts) append_part(file, part, mesh);
    if (!(is_gltf || is_obj) || !has_uvs(parts)) mesh.look.corner_uvs.clear();
    for (const std::string& name : files->missing())
        notes.push_back(fmt::format("'{}' cannot be read, and what it says of materials is left out", name));
    const bool has_materials = is_gltf || (is_obj && files->has_materials());
    if (has_materials) {
        import_materials(*scene, file, is_gltf, mesh.look, notes);
    } else {
        mesh.look.face_materials.clear();
    }
    return mesh;
}

}  // namespace gelatin
