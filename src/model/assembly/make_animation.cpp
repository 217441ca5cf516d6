#include "model/assembly/make_animation.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "mesh/surface_file.h"
#include "mesh/surface_readers.h"
#include "mesh/tet_file.h"
#include "model/transform.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

// Digits count as one number: wave_9 is before wave_10.
bool is_before(const std::string& a, const std::string& b) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (!is_digit(a[i]) || !is_digit(b[j])) {
            if (a[i] != b[j]) return a[i] < b[j];
            ++i, ++j;
            continue;
        }
        const auto number = [&](const std::string& text, std::size_t& at) {
            while (at < text.size() && text[at] == '0') ++at;
            const std::size_t first = at;
            while (at < text.size() && is_digit(text[at])) ++at;
            return text.substr(first, at - first);
        };
        const std::string x = number(a, i), y = number(b, j);
        if (x != y) return std::pair(x.size(), x) < std::pair(y.size(), y);
    }
    return std::pair(a.size() - i, a) < std::pair(b.size() - j, b);
}

std::vector<fs::path> find_files(const fs::path& pattern) {
    const std::string name = pattern.filename().string();
    const std::size_t star = name.find('*');
    const std::string head = name.substr(0, star),
                      tail = star == std::string::npos ? "" : name.substr(star + 1);
    const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : ".";
    const auto fail = [&](const char* problem) {
        throw InvalidInput({pattern.string(), 0, {}, {}, problem});
    };
    if (star == std::string::npos || tail.find('*') != std::string::npos)
        fail("must have one * in the name of the files");
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string each = entry.path().filename().string();
        if (each.size() >= head.size() + tail.size() && each.starts_with(head) && each.ends_with(tail))
            files.push_back(entry.path());
    }
    if (files.empty()) fail("there is no such file");
    std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
        return is_before(a.filename().string(), b.filename().string());
    });
    return files;
}

VertexFrames read_frames(const AnimationFiles& of) {
    VertexFrames frames{{}, of.rate};
    for (const fs::path& file : find_files(of.pattern)) {
        frames.frames.push_back(read_vertices(file));
        const std::size_t count = frames.frames.back().size(), wanted = frames.frames.front().size();
        if (count != wanted)
            throw InvalidInput({file.string(), 0, "vertices", fmt::format("{}", count),
                                fmt::format("must be {}, as in the first file", wanted)});
    }
    return frames;
}

// As the shape has them, before repairs.
std::vector<glm::dvec3> vertices_of(const Shape& shape, const SurfaceMesh& surface) {
    if (const auto* mesh = std::get_if<MeshShape>(&shape)) return mesh->mesh->vertices;
    if (const auto* file = std::get_if<FileShape>(&shape); file && !is_tet_file(file->file))
        return read_vertices(file->file);
    return surface.positions;
}

// Repairs merge and discard vertices, but move none.
std::vector<std::uint32_t> find_sources(const SurfaceMesh& surface, const std::vector<glm::dvec3>& vertices,
                                        const std::string& name) {
    const auto key = [](const glm::dvec3& p) { return std::tuple(p.x, p.y, p.z); };
    std::map<std::tuple<double, double, double>, std::uint32_t> places;
    for (std::uint32_t v = 0; v < vertices.size(); ++v) places.try_emplace(key(vertices[v]), v);
    std::vector<std::uint32_t> sources;
    for (const glm::dvec3& p : surface.positions) {
        const auto found = places.find(key(p));
        if (found == places.end())
            throw InvalidInput(
                {name,
                 0,
                 {},
                 {},
                 "is so far from the origin that it was moved there: a moving surface must not be"});
        sources.push_back(found->second);
    }
    return sources;
}

std::string name_of(const Shape& shape) {
    const auto* file = std::get_if<FileShape>(&shape);
    return file != nullptr ? file->file.string() : "a mesh in memory";
}

double distance_to(const glm::dvec3& p, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 along = to - from;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? std::clamp(glm::dot(p - from, along) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, from + share * along);
}

}  // namespace

HandleAnimation make_animation(const AnimationDescription& description, const Shape& shape,
                               const SurfaceMesh& surface) {
    const std::vector<glm::dvec3> vertices = vertices_of(shape, surface);
    HandleAnimation animation;
    animation.sources = find_sources(surface, vertices, name_of(shape));
    animation.vertex_count = vertices.size();
    if (std::holds_alternative<AnimationByProgram>(description.source)) return animation;
    VertexMotion& motion = animation.motion.emplace();
    if (const auto* clip = std::get_if<AnimationClip>(&description.source)) {
        motion.of = read_gltf_vertices(std::get<FileShape>(shape).file, clip->name);
    } else if (const auto* files = std::get_if<AnimationFiles>(&description.source)) {
        motion.of = read_frames(*files);
    } else {
        const auto& frames = std::get<AnimationFrames>(description.source);
        motion.of = VertexFrames{*frames.frames, frames.rate};
    }
    motion.start = description.start;
    motion.speed = description.speed;
    motion.loop = description.loop;
    if (motion.count() != vertices.size())
        throw InvalidInput({name_of(shape), 0, "vertices", fmt::format("{}", vertices.size()),
                            fmt::format("its animation has {}", motion.count())});
    return animation;
}

InvalidInput said_of(const fs::path& scene, int line, const std::string& field, const InvalidInput& error) {
    InputProblem problem = error.problem();
    const std::string file = std::exchange(problem.file, {});
    return InvalidInput({scene.string(), line, field, file, InvalidInput(problem).what()});
}

// Some formats have a second file.
InvalidInput said_of_shape(const fs::path& scene, int line, const std::string& field, const Shape& shape,
                           const InvalidInput& error) {
    const InputProblem& problem = error.problem();
    if (std::holds_alternative<TextShape>(shape) && problem.file.empty() && !problem.field.empty())
        return InvalidInput(
            {scene.string(), line, field + "." + problem.field, problem.value, problem.problem});
    const auto* of = std::get_if<FileShape>(&shape);
    const fs::path missing = problem.file;
    if (of == nullptr || missing.empty() || fs::is_regular_file(missing)) return error;
    const bool is_same = missing == of->file;
    return InvalidInput(
        {scene.string(), line, field + ".file", of->file.string(), is_same ? problem.problem : error.what()});
}

BodySkeleton::BodySkeleton(const SkeletonDescription& skeleton, const ObjectDescription& object,
                           Axis scene_up)
    : radius_(skeleton.radius / object.scale) {
    motion_.of = read_gltf_bones(skeleton.file, skeleton.clip);
    motion_.start = skeleton.start;
    motion_.speed = skeleton.speed;
    motion_.loop = skeleton.loop;
    ObjectDescription placed = object;
    placed.shape = FileShape{skeleton.file};
    placed.up.reset();
    map_ = object.scale * glm::mat3_cast(orientation_of(placed, scene_up));
    offset_ = object.position;
    find_bones();
}

void BodySkeleton::find_bones() {
    const auto& of = std::get<SkinnedVertices>(motion_.of);
    const std::vector<glm::dmat4> places = place_nodes(of, 0.0, 0.0);
    std::vector<std::uint32_t> joints(of.nodes.size(), TreeNodePose::kRoot);  // of each node
    for (std::uint32_t j = 0; j < of.joints.size(); ++j) joints[of.joints[j].node] = j;
    std::vector<bool> has_bone(of.joints.size(), false);
    for (std::uint32_t j = 0; j < of.joints.size(); ++j) {
        std::uint32_t above = of.nodes[of.joints[j].node].parent;
        while (above != TreeNodePose::kRoot && joints[above] == TreeNodePose::kRoot)
            above = of.nodes[above].parent;
        if (above == TreeNodePose::kRoot) continue;
        bones_.push_back(
            {joints[above], j, glm::dvec3(places[above][3]), glm::dvec3(places[of.joints[j].node][3])});
        has_bone[joints[above]] = true;
    }
    for (std::uint32_t j = 0; j < of.joints.size(); ++j) {
        const glm::dvec3 end(places[of.joints[j].node][3]);
        if (!has_bone[j]) bones_.push_back({j, j, end, end});
    }
}

BodySkeleton::Held BodySkeleton::hold(const std::vector<glm::dvec3>& positions) const {
    Held held;
    VertexMotion& motion = held.animation.motion.emplace(motion_);
    auto& of = std::get<SkinnedVertices>(motion.of);
    for (const Bone& bone : bones_)
        held.animation.bones.push_back({of.joints[bone.joint].node, of.joints[bone.next].node});
    const glm::dmat3 to_file = glm::inverse(map_);
    for (std::uint32_t n = 0; n < positions.size(); ++n) {
        const glm::dvec3 p = to_file * (positions[n] - offset_);
        double least = radius_;
        const Bone* nearest = nullptr;
        for (const Bone& bone : bones_) {
            const double distance = distance_to(p, bone.from, bone.to);
            if (distance > least || (nearest != nullptr && distance == least)) continue;
            least = distance;
            nearest = &bone;
        }
        if (nearest == nullptr) continue;
        const SkinnedVertices::Influence by{nearest->joint, 1.0};
        of.add(p, {&by, 1});
        held.animation.sources.push_back(static_cast<std::uint32_t>(held.nodes.size()));
        held.nodes.push_back(n);
    }
    held.animation.vertex_count = held.nodes.size();
    held.animation.map = map_;
    held.animation.offset = offset_;
    return held;
}

}  // namespace gelatin
