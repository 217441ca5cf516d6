#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesh/gltf_document.h"
#include "mesh/ignored.h"
#include "mesh/vertex_motion.h"

namespace gelatin {

/// The nodes of a glTF file's default scene, its clips, and vertices as nodes, skins and morph targets move
/// them. All of its functions throw InvalidInput, as those of GltfDocument.
class GltfScene {
public:
    /// A mesh that the scene shows, by indices in the file. `node` is one of SkinnedVertices.
    struct Mesh {
        std::uint32_t node;
        std::size_t mesh;
        std::optional<std::size_t> skin;
    };

    /// Keeps references.
    GltfScene(GltfDocument& document, Ignored& ignored);

    /// In the order of the tree.
    const std::vector<Mesh>& meshes() const { return meshes_; }
    struct Added {
        std::size_t count;
        bool is_mirrored;  ///< by where its nodes are
    };
    /// Adds a primitive's vertices.
    Added add_vertices(const Mesh& mesh, const GltfDocument::Json& primitive, const std::string& what);
    /// The vertices added, without a clip.
    const SkinnedVertices& vertices() const { return made_; }
    /// The nodes, a joint for each that is a bone, and no vertices: those of skins, or all where there are
    /// none.
    SkinnedVertices bones() const;

    /// @param name empty: the first one
    Clip read_clip(const std::string& name) const;

private:
    using Json = GltfDocument::Json;
    struct Open;

    void read_nodes();
    void add_nodes(const Json& object, const char* key, std::uint32_t parent, std::vector<Open>& open) const;
    std::vector<Open> roots() const;
    void read_node(const Open& from, std::vector<Open>& open);
    void read_place(const Json& json, const std::string& what, TreeNodePose& node) const;
    std::vector<double> morph_weights(const Json& node, std::size_t mesh, const std::string& what) const;
    std::uint32_t node_of(std::size_t index, const std::string& what) const;
    const std::vector<std::uint32_t>& joints_of(const Mesh& mesh);
    std::vector<glm::dmat4> binds_of(std::size_t skin, std::size_t count);
    GltfArray read_vectors(const Json& attributes, const char* key, std::size_t components,
                           const std::string& what);
    void add_influences(const Mesh& mesh, const Json& attributes, const GltfArray& positions,
                        const std::string& what);
    void add_morph_targets(const Mesh& mesh, const Json& primitive, std::size_t count,
                           const std::string& what);
    std::optional<Track> read_track(const Json& animation, const Json& channel,
                                    const std::string& what) const;

    static constexpr std::uint32_t kNotThere = ~0u;
    GltfDocument& document_;
    Ignored& ignored_;
    SkinnedVertices made_;
    std::vector<glm::dmat4> places_;  // of nodes
    std::vector<Mesh> meshes_;
    std::vector<std::uint32_t> nodes_;  // of each in the file, in made_
    // In made_, of each skin, and of each node of made_ that moves a mesh by itself; empty: not needed yet.
    std::vector<std::vector<std::uint32_t>> skin_joints_, node_joints_;
};

}  // namespace gelatin
