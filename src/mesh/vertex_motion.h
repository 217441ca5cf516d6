#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace gelatin {

/// How a node is placed relative to its parent: scaled, rotated, moved.
struct NodePlace {
    glm::dvec3 move{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

/// A node of a tree, parents before children. Bones of a skeleton are such nodes.
struct TreeNodePose {
    static constexpr std::uint32_t kRoot = ~0u;

    std::string name;
    std::uint32_t parent = kRoot;
    NodePlace place;                    ///< where no clip moves it
    std::optional<glm::dmat4> matrix;   ///< in place of it; no clip moves such a node
    std::vector<double> morph_weights;  ///< of its mesh, where no clip changes them
};

/// Values of one property of a node over time.
struct Track {
    enum class Property { move, turn, scale, morph_weights };
    /// Between two keys: the value of the first, in between, or by cubic Hermite splines, where each key has
    /// the tangent before it, its value, and the tangent after it.
    enum class Interpolation { step, linear, cubic };

    std::uint32_t node = 0;
    Property property = Property::move;
    Interpolation interpolation = Interpolation::linear;
    std::size_t components = 3;
    std::vector<double> times;   ///< ascending [s]
    std::vector<double> values;  ///< shape [times, components], of cubic [times, 3, components]
};

struct Clip {
    std::string name;
    std::vector<Track> tracks;

    double duration() const;  ///< [s]
};

/// Vertices that nodes move: sums over joints,
///   x = sum_j w_j G_j B_j (p + sum_m a_m d_m),
/// with the place G of a joint's node, its bind matrix B, and morph targets d with weights a.
struct SkinnedVertices {
    struct Joint {
        std::uint32_t node;
        glm::dmat4 bind;
    };
    struct Influence {
        std::uint32_t joint;
        double weight;
    };
    struct MorphTarget {
        std::uint32_t node, index;  ///< its weight is this one of this node
        std::uint32_t first;        ///< vertex
        std::vector<glm::dvec3> moves;
    };

    std::vector<TreeNodePose> nodes;
    std::vector<Joint> joints;
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> starts = {0};  ///< of each vertex in `influences`, and the end
    std::vector<Influence> influences;
    std::vector<MorphTarget> morph_targets;
    Clip clip;

    /// Adds a vertex that one joint moves, or several.
    void add(const glm::dvec3& point, std::span<const Influence> by);
};

/// The place of each node. @param clip_time [s] @param share how far from where no clip moves them to where
/// the clip has them, in [0, 1]
std::vector<glm::dmat4> place_nodes(const SkinnedVertices& of, double clip_time, double share);
/// Where all vertices are.
std::vector<glm::dvec3> place_vertices(const SkinnedVertices& of, double clip_time, double share);

/// Vertices at even times, linear in between.
struct VertexFrames {
    std::vector<std::vector<glm::dvec3>> frames;  ///< at least one, all of one size
    double rate = 24.0;                           ///< [1/s]
};

/// A movement of vertices in the coordinates of their shape.
struct VertexMotion {
    std::variant<SkinnedVertices, VertexFrames> of;
    double start = 0.0;  ///< when it begins [s]; before, nodes go from where no clip moves them to its start
    double speed = 1.0;
    bool loop = false;

    std::size_t count() const;                      ///< of vertices
    std::vector<glm::dvec3> at(double time) const;  ///< [m]
    /// Where nodes are. @pre of SkinnedVertices
    std::vector<glm::dmat4> nodes_at(double time) const;
    double end() const;  ///< from then on nothing moves [s]

private:
    struct ClipTime {
        double since;  // it began [s]
        double share;  // of the way to the clip, in [0, 1]
    };
    ClipTime clip_time(double time) const;
};

}  // namespace gelatin
