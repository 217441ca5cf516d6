#include "sim/recording/recorded_meshes.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <variant>

#include "core/packed_arrays.h"
#include "gelatin/error.h"
#include "mesh/mesh_in_memory.h"
#include "model/scene/named_meshes.h"
#include "model/scene/parse_scene.h"
#include "model/scene/scene_writer.h"
#include "sim/recording/compression.h"

namespace gelatin {
namespace {

static_assert(std::endian::native == std::endian::little, "recordings have this order");

constexpr int kMeshLevel = 3;
constexpr std::size_t kMostBytes = std::size_t{1} << 36;

// Where a mesh's shape and mesher are in the scene.
enum class Of : std::uint32_t { object, collider, nothing };
struct Place {
    Of of;
    std::uint32_t index;
};

// Colliders and rigid bodies are surfaces.
Place place_of(const ShapeMesh& mesh, const Scene& scene) {
    const bool has_tets = !mesh.tets.tets.empty();
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const ObjectDescription& object = scene.objects[o];
        if (object.shape == mesh.shape && object.mesher == mesh.mesher && has_tets == !object.rigid)
            return {Of::object, static_cast<std::uint32_t>(o)};
    }
    for (std::size_t c = 0; !has_tets && c < scene.colliders.size(); ++c)
        if (const auto* shape = std::get_if<Shape>(&scene.colliders[c].shape); shape && *shape == mesh.shape)
            return {Of::collider, static_cast<std::uint32_t>(c)};
    return {Of::nothing, 0};
}

std::vector<char> letters(const std::string& text) {
    return {text.begin(), text.end()};
}

void add(const SurfaceLook& look, ArrayWriter& out) {
    out.add(look.face_materials);
    out.add(look.corner_uvs);
    out.add(std::vector<std::uint64_t>{look.materials.size()});
    for (const SurfaceMaterial& material : look.materials) {
        out.add(letters(material.name));
        out.add(std::vector<glm::vec3>{material.color});
        out.add(letters(material.image_name));
        out.add(material.image ? letters(*material.image) : std::vector<char>());
    }
}

void add(const ShapeMesh& mesh, ArrayWriter& out) {
    out.add(mesh.surface.positions);
    out.add(mesh.surface.faces);
    add(mesh.surface.look, out);
    out.add(mesh.tets.positions);
    out.add(mesh.tets.tets);
    out.add(mesh.tets.faces);
    out.add(mesh.tets.attributes);
}

// Takes arrays; what is damaged is refused.
class Reader {
public:
    explicit Reader(const std::string& bytes) : arrays_(bytes) {}

    template <class T>
    void take(std::vector<T>& values) {
        require(arrays_.take(values));
    }
    template <class T>
    T take_one() {
        std::vector<T> values;
        take(values);
        require(values.size() == 1);
        return values.front();
    }
    std::string take_text() {
        std::vector<char> letters;
        take(letters);
        return {letters.begin(), letters.end()};
    }
    void finish() const { require(arrays_.at_end()); }

    static void require(bool holds) {
        if (!holds) throw InvalidInput({{}, 0, {}, {}, "has meshes that are damaged"});
    }

private:
    ArrayReader arrays_;
};

template <class Corners>
void require_corners(const std::vector<Corners>& elements, std::size_t points) {
    for (const Corners& element : elements)
        for (int k = 0; k < Corners::length(); ++k) Reader::require(element[k] < points);
}

SurfaceLook take_look(Reader& in, std::size_t faces) {
    SurfaceLook look;
    in.take(look.face_materials);
    in.take(look.corner_uvs);
    for (auto left = in.take_one<std::uint64_t>(); left > 0; --left) {
        SurfaceMaterial& material = look.materials.emplace_back();
        material.name = in.take_text();
        material.color = in.take_one<glm::vec3>();
        material.image_name = in.take_text();
        if (std::string image = in.take_text(); !image.empty())
            material.image = std::make_shared<const std::string>(std::move(image));
    }
    Reader::require(look.face_materials.empty() || look.face_materials.size() == faces);
    Reader::require(look.corner_uvs.empty() || look.corner_uvs.size() == faces);
    for (const std::uint32_t material : look.face_materials)
        Reader::require(material == SurfaceLook::kNone || material < look.materials.size());
    return look;
}

ShapeMesh take_shape_mesh(Reader& in) {
    ShapeMesh mesh;
    in.take(mesh.surface.positions);
    in.take(mesh.surface.faces);
    mesh.surface.look = take_look(in, mesh.surface.faces.size());
    in.take(mesh.tets.positions);
    in.take(mesh.tets.tets);
    in.take(mesh.tets.faces);
    in.take(mesh.tets.attributes);
    require_corners(mesh.surface.faces, mesh.surface.positions.size());
    require_corners(mesh.tets.tets, mesh.tets.positions.size());
    require_corners(mesh.tets.faces, mesh.tets.positions.size());
    Reader::require(mesh.tets.attributes.empty() || mesh.tets.attributes.size() == mesh.tets.tets.size());
    return mesh;
}

void add(const InMemory& in_memory, ArrayWriter& out) {
    out.add(std::vector<std::uint64_t>{in_memory.meshes.size()});
    for (const auto& mesh : in_memory.meshes) {
        out.add(mesh->vertices);
        out.add(mesh->triangles);
        out.add(mesh->tets);
        out.add(mesh->attributes);
    }
    out.add(std::vector<std::uint64_t>{in_memory.frames.size()});
    for (const InMemory::Frames& frames : in_memory.frames) {
        out.add(std::vector<std::uint64_t>{frames->size()});
        for (const std::vector<glm::dvec3>& frame : *frames) out.add(frame);
    }
}

InMemory take_in_memory(Reader& in) {
    InMemory in_memory;
    for (auto left = in.take_one<std::uint64_t>(); left > 0; --left) {
        Mesh mesh;
        in.take(mesh.vertices);
        in.take(mesh.triangles);
        in.take(mesh.tets);
        in.take(mesh.attributes);
        Reader::require(!find_problem(mesh));
        in_memory.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    }
    for (auto left = in.take_one<std::uint64_t>(); left > 0; --left) {
        std::vector<std::vector<glm::dvec3>> frames;
        for (auto count = in.take_one<std::uint64_t>(); count > 0; --count) in.take(frames.emplace_back());
        in_memory.frames.push_back(
            std::make_shared<const std::vector<std::vector<glm::dvec3>>>(std::move(frames)));
    }
    return in_memory;
}

void set_shape(const Place& place, const Scene& scene, ShapeMesh& mesh) {
    if (place.of == Of::object) {
        Reader::require(place.index < scene.objects.size());
        const ObjectDescription& object = scene.objects[place.index];
        Reader::require(!mesh.tets.tets.empty() == !object.rigid);
        mesh.shape = object.shape;
        mesh.mesher = object.mesher;
    } else {
        Reader::require(place.of == Of::collider && place.index < scene.colliders.size());
        const auto* shape = std::get_if<Shape>(&scene.colliders[place.index].shape);
        Reader::require(shape != nullptr && mesh.tets.tets.empty());
        mesh.shape = *shape;
    }
}

}  // namespace

RecordedScene recorded_scene(const Scene& scene, const SceneMeshes* meshes) {
    RecordedScene recorded;
    recorded.file = std::filesystem::absolute(scene.file.empty() ? "scene.toml" : scene.file);
    Scene named = scene;
    ArrayWriter out;
    add(name_meshes(named, recorded.file.parent_path()), out);
    recorded.text = to_toml(named, recorded.file.parent_path());
    std::vector<Place> places;
    ArrayWriter made;
    for (const auto& mesh : meshes != nullptr ? meshes->all : SceneMeshes().all) {
        const Place place = place_of(*mesh, scene);
        if (place.of == Of::nothing) continue;
        places.push_back(place);
        add(*mesh, made);
    }
    out.add(places);
    recorded.meshes = compressed(out.bytes() + made.bytes(), kMeshLevel, true);
    return recorded;
}

Scene restored_scene(const RecordedScene& recorded) {
    Scene scene = parse_scene(recorded.text, recorded.file);
    const std::string bytes = decompressed(recorded.meshes, kMostBytes);
    Reader in(bytes);
    restore_meshes(scene, take_in_memory(in));
    std::vector<Place> places;
    in.take(places);
    SceneMeshes made;
    for (const Place& place : places) {
        ShapeMesh mesh = take_shape_mesh(in);
        set_shape(place, scene, mesh);
        made.all.push_back(std::make_shared<const ShapeMesh>(std::move(mesh)));
    }
    in.finish();
    scene.meshes = std::make_shared<const SceneMeshes>(std::move(made));
    return scene;
}

}  // namespace gelatin
