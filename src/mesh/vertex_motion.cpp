#include "mesh/vertex_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace gelatin {
namespace {

// Where a time is between the keys of a track.
struct Between {
    std::size_t key;  // and the next one
    double share;     // in [0, 1]
    double seconds;   // from key to key
};

Between find_between(const std::vector<double>& times, double time) {
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    if (next == times.begin()) return {0, 0.0, 0.0};
    const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
    if (next == times.end()) return {key, 0.0, 0.0};
    const double seconds = *next - times[key];
    return {key, (time - times[key]) / seconds, seconds};
}

glm::dquat quaternion(const double* v) {
    return {v[3], v[0], v[1], v[2]};
}

// glTF 2.0, appendix C.
std::vector<double> value_of(const Track& track, double time) {
    const auto [key, s, seconds] = find_between(track.times, time);
    const std::size_t n = track.components;
    const bool is_cubic = track.interpolation == Track::Interpolation::cubic;
    // The parts of a cubic key: the tangent before it, its value, the tangent after it.
    const auto part = [&](std::size_t k, std::size_t which) {
        return &track.values[(is_cubic ? 3 * k + which : k) * n];
    };
    const double* const from = part(key, 1);
    std::vector<double> value(from, from + n);
    if (s == 0.0 || track.interpolation == Track::Interpolation::step) return value;
    const double* const to = part(key + 1, 1);
    if (is_cubic) {
        const double s2 = s * s, s3 = s2 * s;
        const double *const out = part(key, 2), *const in = part(key + 1, 0);
        for (std::size_t c = 0; c < n; ++c)
            value[c] = (2.0 * s3 - 3.0 * s2 + 1.0) * from[c] + seconds * (s3 - 2.0 * s2 + s) * out[c] +
                       (3.0 * s2 - 2.0 * s3) * to[c] + seconds * (s3 - s2) * in[c];
    } else if (track.property == Track::Property::turn) {
        const glm::dquat turn = glm::slerp(quaternion(from), quaternion(to), s);
        value = {turn.x, turn.y, turn.z, turn.w};
    } else {
        for (std::size_t c = 0; c < n; ++c) value[c] += s * (to[c] - from[c]);
    }
    return value;
}

// What a clip changes of the nodes.
struct Changes {
    std::vector<NodePlace> places;
    std::vector<std::vector<double>> morph_weights;
};

Changes changes_at(const SkinnedVertices& of, double time) {
    Changes changes;
    for (const TreeNodePose& node : of.nodes) {
        changes.places.push_back(node.place);
        changes.morph_weights.push_back(node.morph_weights);
    }
    for (const Track& track : of.clip.tracks) {
        const std::vector<double> value = value_of(track, time);
        NodePlace& place = changes.places[track.node];
        switch (track.property) {
            case Track::Property::move:
                place.move = {value[0], value[1], value[2]};
                break;
            case Track::Property::turn:
                place.turn = glm::normalize(quaternion(value.data()));
                break;
            case Track::Property::scale:
                place.scale = {value[0], value[1], value[2]};
                break;
            case Track::Property::morph_weights:
                changes.morph_weights[track.node] = value;
                break;
        }
    }
    return changes;
}

NodePlace between(const NodePlace& a, const NodePlace& b, double share) {
    return {glm::mix(a.move, b.move, share), glm::slerp(a.turn, b.turn, share),
            glm::mix(a.scale, b.scale, share)};
}

glm::dmat4 matrix_of(const NodePlace& place) {
    const glm::dmat3 turn = glm::mat3_cast(place.turn);
    glm::dmat4 matrix(1.0);
    for (int k = 0; k < 3; ++k) matrix[k] = glm::dvec4(turn[k] * place.scale[k], 0.0);
    matrix[3] = glm::dvec4(place.move, 1.0);
    return matrix;
}

std::vector<glm::dmat4> place_nodes(const SkinnedVertices& of, const Changes& changes, double share) {
    std::vector<glm::dmat4> places;
    for (std::size_t n = 0; n < of.nodes.size(); ++n) {
        const TreeNodePose& node = of.nodes[n];
        glm::dmat4 matrix =
            node.matrix ? *node.matrix : matrix_of(between(node.place, changes.places[n], share));
        if (node.parent != TreeNodePose::kRoot) matrix = places[node.parent] * matrix;
        places.push_back(matrix);
    }
    return places;
}

std::vector<glm::dvec3> morphed(const SkinnedVertices& of, const Changes& changes, double share) {
    std::vector<glm::dvec3> points = of.points;
    for (const SkinnedVertices::MorphTarget& target : of.morph_targets) {
        const double weight = glm::mix(of.nodes[target.node].morph_weights[target.index],
                                       changes.morph_weights[target.node][target.index], share);
        if (weight == 0.0) continue;
        for (std::size_t v = 0; v < target.moves.size(); ++v)
            points[target.first + v] += weight * target.moves[v];
    }
    return points;
}

std::vector<glm::dvec3> vertices_at(const VertexFrames& frames, double time) {
    const double last = static_cast<double>(frames.frames.size() - 1);
    const double place = std::clamp(time * frames.rate, 0.0, last);
    const auto before = static_cast<std::size_t>(place);
    std::vector<glm::dvec3> vertices = frames.frames[before];
    const double share = place - static_cast<double>(before);
    if (share == 0.0) return vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v)
        vertices[v] = glm::mix(vertices[v], frames.frames[before + 1][v], share);
    return vertices;
}

double duration_of(const VertexMotion& motion) {
    if (const auto* skinned = std::get_if<SkinnedVertices>(&motion.of)) return skinned->clip.duration();
    const auto& frames = std::get<VertexFrames>(motion.of);
    return static_cast<double>(frames.frames.size() - 1) / frames.rate;
}

}  // namespace

double Clip::duration() const {
    double duration = 0.0;
    for (const Track& track : tracks) duration = std::max(duration, track.times.back());
    return duration;
}

void SkinnedVertices::add(const glm::dvec3& point, std::span<const Influence> by) {
    points.push_back(point);
    influences.insert(influences.end(), by.begin(), by.end());
    starts.push_back(static_cast<std::uint32_t>(influences.size()));
}

std::vector<glm::dmat4> place_nodes(const SkinnedVertices& of, double clip_time, double share) {
    return place_nodes(of, changes_at(of, clip_time), share);
}

std::vector<glm::dvec3> place_vertices(const SkinnedVertices& of, double clip_time, double share) {
    const Changes changes = changes_at(of, clip_time);
    const std::vector<glm::dmat4> nodes = place_nodes(of, changes, share);
    std::vector<glm::dmat4> joints;
    for (const SkinnedVertices::Joint& joint : of.joints) joints.push_back(nodes[joint.node] * joint.bind);
    std::vector<glm::dvec3> vertices = morphed(of, changes, share);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const glm::dvec4 point(vertices[v], 1.0);
        glm::dvec4 sum(0.0);
        for (std::uint32_t k = of.starts[v]; k < of.starts[v + 1]; ++k)
            sum += of.influences[k].weight * (joints[of.influences[k].joint] * point);
        vertices[v] = glm::dvec3(sum);
    }
    return vertices;
}

std::size_t VertexMotion::count() const {
    if (const auto* skinned = std::get_if<SkinnedVertices>(&of)) return skinned->points.size();
    return std::get<VertexFrames>(of).frames.front().size();
}

VertexMotion::ClipTime VertexMotion::clip_time(double time) const {
    const double duration = duration_of(*this);
    double since = std::max(0.0, speed * (time - start));
    if (loop && duration > 0.0) since = std::fmod(since, duration);
    const double begun = start > 0.0 ? std::clamp(time / start, 0.0, 1.0) : 1.0;
    return {since, begun * begun * (3.0 - 2.0 * begun)};
}

std::vector<glm::dvec3> VertexMotion::at(double time) const {
    const auto [since, share] = clip_time(time);
    if (const auto* frames = std::get_if<VertexFrames>(&of)) return vertices_at(*frames, since);
    return place_vertices(std::get<SkinnedVertices>(of), since, share);
}

std::vector<glm::dmat4> VertexMotion::nodes_at(double time) const {
    const auto [since, share] = clip_time(time);
    return place_nodes(std::get<SkinnedVertices>(of), since, share);
}

double VertexMotion::end() const {
    const double duration = duration_of(*this);
    if (loop && duration > 0.0) return std::numeric_limits<double>::infinity();
    return start + duration / speed;
}

}  // namespace gelatin
