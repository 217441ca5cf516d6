#include "mesh/gltf_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/matrix.hpp>
#include <iterator>
#include <string_view>
#include <utility>

namespace gelatin {
namespace {

glm::dmat4 matrix_from(const double* values) {
    glm::dmat4 matrix(1.0);
    for (int k = 0; k < 16; ++k) matrix[k / 4][k % 4] = values[k];
    return matrix;
}

}  // namespace

struct GltfScene::Open {
    std::size_t node;
    std::uint32_t parent;
};

GltfScene::GltfScene(GltfDocument& document, Ignored& ignored)
    : document_(document), ignored_(ignored), skin_joints_(document.list("skins").size()) {
    read_nodes();
    node_joints_.resize(made_.nodes.size());
    places_ = place_nodes(made_, 0.0, 0.0);
}

void GltfScene::read_nodes() {
    const std::size_t node_count = document_.list("nodes").size();
    nodes_.assign(node_count, kNotThere);
    if (node_count == 0) {  // then all meshes, where they are
        for (std::size_t m = 0; m < document_.list("meshes").size(); ++m) {
            TreeNodePose& node = made_.nodes.emplace_back();
            node.morph_weights = morph_weights(Json::object(), m, "nodes");
            meshes_.push_back({static_cast<std::uint32_t>(m), m, {}});
        }
        return;
    }
    std::vector<Open> open;
    if (!document_.list("scenes").empty()) {
        const std::size_t scene = document_.optional_number(document_.json(), "scene", "file").value_or(0);
        add_nodes(document_.item("scenes", scene), "nodes", TreeNodePose::kRoot, open);
    } else {
        open = roots();
    }
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        read_node(next, open);
    }
}

void GltfScene::add_nodes(const Json& object, const char* key, std::uint32_t parent,
                          std::vector<Open>& open) const {
    const auto nodes = object.find(key);
    if (nodes == object.end()) return;
    for (const Json& node : *nodes) {
        if (!node.is_number_unsigned()) document_.fail(key, node.dump(), "must be a whole number");
        open.push_back({node.get<std::size_t>(), parent});
    }
}

std::vector<GltfScene::Open> GltfScene::roots() const {
    std::vector<Open> children;
    for (std::size_t n = 0; n < nodes_.size(); ++n)
        add_nodes(document_.item("nodes", n), "children", TreeNodePose::kRoot, children);
    std::vector<bool> is_child(nodes_.size(), false);
    for (const Open& child : children) {
        if (child.node < is_child.size()) is_child[child.node] = true;
    }
    std::vector<Open> roots;
    for (std::size_t n = 0; n < is_child.size(); ++n) {
        if (!is_child[n]) roots.push_back({n, TreeNodePose::kRoot});
    }
    return roots;
}

void GltfScene::read_node(const Open& from, std::vector<Open>& open) {
    const Json& json = document_.item("nodes", from.node);
    const std::string what = fmt::format("nodes[{}]", from.node);
    if (nodes_[from.node] != kNotThere) document_.fail(what, {}, "occurs twice in the scene");
    const auto index = static_cast<std::uint32_t>(made_.nodes.size());
    nodes_[from.node] = index;
    TreeNodePose& node = made_.nodes.emplace_back();
    node.parent = from.parent;
    if (const auto name = json.find("name"); name != json.end() && name->is_string())
        node.name = name->get<std::string>();
    read_place(json, what, node);
    if (const auto mesh = document_.optional_number(json, "mesh", what)) {
        node.morph_weights = morph_weights(json, *mesh, what);
        meshes_.push_back({index, *mesh, document_.optional_number(json, "skin", what)});
    }
    const auto extensions = json.find("extensions");
    if (extensions != json.end() && extensions->contains("EXT_mesh_gpu_instancing"))
        ignored_.add("copies of meshes (EXT_mesh_gpu_instancing)");
    const std::size_t first = open.size();
    add_nodes(json, "children", index, open);
    std::reverse(open.begin() + static_cast<std::ptrdiff_t>(first), open.end());
}

void GltfScene::read_place(const Json& json, const std::string& what, TreeNodePose& node) const {
    if (const auto matrix = document_.numbers(json, "matrix", 16, what)) {
        node.matrix = matrix_from(matrix->data());
        return;
    }
    if (const auto move = document_.numbers(json, "translation", 3, what))
        node.place.move = {(*move)[0], (*move)[1], (*move)[2]};
    if (const auto turn = document_.numbers(json, "rotation", 4, what))
        node.place.turn = glm::normalize(glm::dquat((*turn)[3], (*turn)[0], (*turn)[1], (*turn)[2]));
    if (const auto scale = document_.numbers(json, "scale", 3, what))
        node.place.scale = {(*scale)[0], (*scale)[1], (*scale)[2]};
}

// One for each morph target of the first primitive; all others have as many.
std::vector<double> GltfScene::morph_weights(const Json& node, std::size_t mesh,
                                             const std::string& what) const {
    const Json& of = document_.item("meshes", mesh);
    const auto primitives = of.find("primitives");
    if (primitives == of.end() || primitives->empty()) return {};
    const Json& first = primitives->at(0);
    const std::size_t count = first.contains("targets") ? first.at("targets").size() : 0;
    if (count == 0) return {};
    if (auto own = document_.numbers(node, "weights", count, what)) return *own;
    return document_.numbers(of, "weights", count, fmt::format("meshes[{}]", mesh))
        .value_or(std::vector<double>(count, 0.0));
}

std::uint32_t GltfScene::node_of(std::size_t index, const std::string& what) const {
    if (index >= nodes_.size() || nodes_[index] == kNotThere)
        document_.fail(what, fmt::format("{}", index), "names a node that is not in the scene");
    return nodes_[index];
}

GltfArray GltfScene::read_vectors(const Json& attributes, const char* key, std::size_t components,
                                  const std::string& what) {
    GltfArray array = document_.read_accessor(document_.whole_number(attributes, key, what));
    if (array.components != components)
        document_.fail(what + "." + key, {}, fmt::format("must be of type VEC{}", components));
    return array;
}

std::vector<glm::dmat4> GltfScene::binds_of(std::size_t skin, std::size_t count) {
    std::vector<glm::dmat4> binds(count, glm::dmat4(1.0));
    const std::string what = fmt::format("skins[{}]", skin);
    const auto accessor =
        document_.optional_number(document_.item("skins", skin), "inverseBindMatrices", what);
    if (!accessor) return binds;
    const GltfArray array = document_.read_accessor(*accessor);
    if (array.components != 16 || array.count < count)
        document_.fail(what + ".inverseBindMatrices", fmt::format("{}", array.count),
                       fmt::format("must be {} of type MAT4", count));
    for (std::size_t j = 0; j < count; ++j) binds[j] = matrix_from(&array.values[16 * j]);
    return binds;
}

// A node that moves vertices by itself is a joint without a bind matrix.
const std::vector<std::uint32_t>& GltfScene::joints_of(const Mesh& mesh) {
    std::vector<std::uint32_t> joints;
    const auto add = [&](std::uint32_t node, const glm::dmat4& bind) {
        joints.push_back(static_cast<std::uint32_t>(made_.joints.size()));
        made_.joints.push_back({node, bind});
    };
    if (mesh.skin) document_.item("skins", *mesh.skin);  // it is there
    std::vector<std::uint32_t>& known = mesh.skin ? skin_joints_[*mesh.skin] : node_joints_[mesh.node];
    if (!known.empty()) return known;
    if (!mesh.skin) {
        add(mesh.node, glm::dmat4(1.0));
        return known = joints;
    }
    const Json& skin = document_.item("skins", *mesh.skin);
    const std::string what = fmt::format("skins[{}].joints", *mesh.skin);
    if (!skin.contains("joints") || !skin.at("joints").is_array()) document_.fail(what, {}, "is missing");
    const Json& nodes = skin.at("joints");
    if (nodes.empty()) document_.fail(what, {}, "must name at least one node");
    const std::vector<glm::dmat4> binds = binds_of(*mesh.skin, nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j) {
        if (!nodes[j].is_number_unsigned()) document_.fail(what, nodes[j].dump(), "must be a whole number");
        add(node_of(nodes[j].get<std::size_t>(), what), binds[j]);
    }
    return known = joints;
}

void GltfScene::add_influences(const Mesh& mesh, const Json& attributes, const GltfArray& positions,
                               const std::string& what) {
    const std::vector<std::uint32_t>& joints = joints_of(mesh);
    std::vector<std::vector<SkinnedVertices::Influence>> by(positions.count);
    for (std::size_t set = 0; mesh.skin && attributes.contains(fmt::format("JOINTS_{}", set)); ++set) {
        const GltfArray indices = read_vectors(attributes, fmt::format("JOINTS_{}", set).c_str(), 4, what),
                        weights = read_vectors(attributes, fmt::format("WEIGHTS_{}", set).c_str(), 4, what);
        if (indices.count < positions.count || weights.count < positions.count)
            document_.fail(what, fmt::format("{}", std::min(indices.count, weights.count)),
                           fmt::format("joints and weights must be {}", positions.count));
        for (std::size_t k = 0; k < 4 * positions.count; ++k) {
            if (weights.values[k] == 0.0) continue;
            if (!(indices.values[k] < static_cast<double>(joints.size())))
                document_.fail(what + ".JOINTS", fmt::format("{}", indices.values[k]),
                               fmt::format("must be below {}", joints.size()));
            by[k / 4].push_back({joints[static_cast<std::size_t>(indices.values[k])], weights.values[k]});
        }
    }
    for (std::size_t v = 0; v < positions.count; ++v) {
        double sum = 0.0;
        for (const SkinnedVertices::Influence& influence : by[v]) sum += influence.weight;
        if (!(sum > 0.0)) {
            by[v] = {{joints[0], 1.0}};
            sum = 1.0;
        }
        for (SkinnedVertices::Influence& influence : by[v]) influence.weight /= sum;  // they are rounded
        const double* const p = &positions.values[3 * v];
        made_.add({p[0], p[1], p[2]}, by[v]);
    }
}

void GltfScene::add_morph_targets(const Mesh& mesh, const Json& primitive, std::size_t count,
                                  const std::string& what) {
    const auto targets = primitive.find("targets");
    if (targets == primitive.end()) return;
    const std::size_t weights = made_.nodes[mesh.node].morph_weights.size();
    for (std::size_t t = 0; t < targets->size(); ++t) {
        const Json& target = targets->at(t);
        if (t >= weights) document_.fail(what + ".targets", {}, "are more than those of the mesh's first");
        if (!target.contains("POSITION")) continue;  // of normals or colours
        const GltfArray moves = read_vectors(target, "POSITION", 3, what + ".targets");
        if (moves.count != count)
            document_.fail(what + ".targets", fmt::format("{}", moves.count),
                           fmt::format("must have {} vertices", count));
        SkinnedVertices::MorphTarget& added = made_.morph_targets.emplace_back();
        added.node = mesh.node;
        added.index = static_cast<std::uint32_t>(t);
        added.first = static_cast<std::uint32_t>(made_.points.size() - count);
        for (std::size_t v = 0; v < count; ++v) {
            const double* const d = &moves.values[3 * v];
            added.moves.emplace_back(d[0], d[1], d[2]);
        }
    }
}

GltfScene::Added GltfScene::add_vertices(const Mesh& mesh, const Json& primitive, const std::string& what) {
    const Json& attributes = primitive.at("attributes");
    const GltfArray positions = read_vectors(attributes, "POSITION", 3, what + ".attributes");
    add_influences(mesh, attributes, positions, what);
    add_morph_targets(mesh, primitive, positions.count, what);
    const SkinnedVertices::Joint& joint = made_.joints[joints_of(mesh)[0]];
    return {positions.count, determinant(glm::dmat3(places_[joint.node] * joint.bind)) < 0.0};
}

SkinnedVertices GltfScene::bones() const {
    std::vector<bool> are(made_.nodes.size(), skin_joints_.empty());
    for (std::size_t s = 0; s < skin_joints_.size(); ++s) {
        const Json& skin = document_.item("skins", s);
        const auto joints = skin.find("joints");
        if (joints == skin.end()) continue;
        const std::string what = fmt::format("skins[{}].joints", s);
        for (const Json& joint : *joints) {
            if (!joint.is_number_unsigned()) document_.fail(what, joint.dump(), "must be a whole number");
            are[node_of(joint.get<std::size_t>(), what)] = true;
        }
    }
    SkinnedVertices bones;
    bones.nodes = made_.nodes;
    for (std::uint32_t n = 0; n < are.size(); ++n)
        if (are[n]) bones.joints.push_back({n, inverse(places_[n])});
    return bones;
}

Clip GltfScene::read_clip(const std::string& name) const {
    const Json& animations = document_.list("animations");
    if (animations.empty()) document_.fail("animations", {}, "it has none");
    std::vector<std::string> names;
    std::optional<std::size_t> found;
    for (std::size_t a = 0; a < animations.size(); ++a) {
        const Json& animation = document_.item("animations", a);
        names.push_back(animation.value("name", ""));
        if (!found && (name.empty() || names.back() == name)) found = a;
    }
    if (!found) {
        std::string all;
        for (const std::string& each : names) all += (all.empty() ? "'" : ", '") + each + "'";
        document_.fail("animations", name, "is not there: it has " + all);
    }
    Clip clip{names[*found], {}};
    const Json& animation = document_.item("animations", *found);
    const std::string what = fmt::format("animations[{}]", *found);
    for (const Json& channel : animation.at("channels"))
        if (std::optional<Track> track = read_track(animation, channel, what)) clip.tracks.push_back(*track);
    if (clip.tracks.empty()) document_.fail(what, name, "moves no node of the scene");
    return clip;
}

// Of what moves nodes of the scene; nothing otherwise.
std::optional<Track> GltfScene::read_track(const Json& animation, const Json& channel,
                                           const std::string& what) const {
    const Json& target = channel.at("target");
    const auto node = document_.optional_number(target, "node", what);
    const std::string path = target.value("path", "");
    if (!node || *node >= nodes_.size() || nodes_[*node] == kNotThere) return {};
    Track track;
    track.node = nodes_[*node];
    const TreeNodePose& moved = made_.nodes[track.node];
    if (path == "translation") {
        track.property = Track::Property::move;
    } else if (path == "rotation") {
        track.property = Track::Property::turn;
        track.components = 4;
    } else if (path == "scale") {
        track.property = Track::Property::scale;
    } else if (path == "weights" && !moved.morph_weights.empty()) {
        track.property = Track::Property::morph_weights;
        track.components = moved.morph_weights.size();
    } else {
        return {};
    }
    const Json& sampler = animation.at("samplers").at(document_.whole_number(channel, "sampler", what));
    const std::string interpolation = sampler.value("interpolation", "LINEAR");
    if (interpolation == "STEP") track.interpolation = Track::Interpolation::step;
    if (interpolation == "CUBICSPLINE") track.interpolation = Track::Interpolation::cubic;
    track.times = document_.read_accessor(document_.whole_number(sampler, "input", what)).values;
    track.values = document_.read_accessor(document_.whole_number(sampler, "output", what)).values;
    const std::size_t parts = track.interpolation == Track::Interpolation::cubic ? 3 : 1;
    if (track.times.empty() || track.values.size() != track.times.size() * parts * track.components)
        document_.fail(what + ".samplers", fmt::format("{} numbers", track.values.size()),
                       fmt::format("must be {}", track.times.size() * parts * track.components));
    const auto is_finite = [](double value) { return std::isfinite(value); };
    if (!std::all_of(track.values.begin(), track.values.end(), is_finite) ||
        !std::all_of(track.times.begin(), track.times.end(), is_finite) || track.times.front() < 0.0 ||
        std::adjacent_find(track.times.begin(), track.times.end(), std::greater_equal<>()) !=
            track.times.end())
        document_.fail(what + ".samplers", {},
                       "times must be finite, at least 0 and ascending, values finite");
    return track;
}

}  // namespace gelatin
