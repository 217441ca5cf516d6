#include "bench/contact_cases.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <variant>

#include "bench/scene_file.h"
#include "gelatin/error.h"
#include "model/assembly/build_model.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

// Between copies: nothing moves as far in a window [m].
constexpr double kMargin = 4.0;

Scene load_contact_scene(const ContactScene& of, const std::filesystem::path& folder) {
    const std::filesystem::path file =
        folder.empty() ? find_bench_scene({}, std::string(of.folder) + of.file) : folder / of.file;
    Scene scene = load_scene(file.lexically_normal());
    if (!scene.has_contact() || scene.simulation.substeps)
        throw InvalidInput({scene.file.string(),
                            0,
                            "simulation",
                            {},
                            "must make implicit steps with contact, with substeps = \"auto\""});
    return scene;
}

// Across the direction up, a square grid about the origin.
std::vector<glm::dvec3> grid_places(const glm::dvec3& spacing, Axis up, int count) {
    const int across = (static_cast<int>(up) + 1) % 3, along = (static_cast<int>(up) + 2) % 3;
    const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
    const double middle = 0.5 * (columns - 1);
    std::vector<glm::dvec3> places;
    for (int c = 0; c < count; ++c) {
        const int column = c % columns, row = c / columns;
        glm::dvec3 place(0.0);
        place[across] = (column - middle) * spacing[across];
        place[along] = (row - middle) * spacing[along];
        places.push_back(place);
    }
    return places;
}

Scene repeated(const Scene& scene, const std::vector<glm::dvec3>& places) {
    Scene all = scene;
    all.objects.clear();
    all.colliders.clear();
    for (std::size_t c = 0; c < places.size(); ++c) {
        for (ObjectDescription object : scene.objects) {
            object.name += fmt::format(" of copy {}", c);
            object.position += places[c];
            all.objects.push_back(std::move(object));
        }
        for (ColliderDescription collider : scene.colliders) {
            if (std::holds_alternative<PlaneCollider>(collider.shape)) {
                if (c == 0) all.colliders.push_back(collider);
                continue;
            }
            if (!collider.name.empty()) collider.name += fmt::format(" of copy {}", c);
            collider.position += places[c];
            all.colliders.push_back(std::move(collider));
        }
    }
    return all;
}

// A model has the bodies of all copies first, then the surfaces of colliders.
State repeated(const State& state, const Model& one, const Model& all,
               const std::vector<glm::dvec3>& places) {
    const std::size_t bodies = one.body_count(), surfaces = one.objects.size() - bodies;
    State repeated;
    for (std::size_t o = 0; o < all.objects.size(); ++o) {
        const bool is_body = all.is_body(o);
        const std::size_t place = is_body ? o : o - all.body_count(), count = is_body ? bodies : surfaces;
        const Range from = one.objects[(is_body ? 0 : bodies) + place % count].nodes;
        assert(all.objects[o].nodes.count == from.count);
        const glm::vec4 offset(glm::vec3(places[place / count]), 0.0f);
        for (std::uint32_t n = from.first; n < from.end(); ++n) {
            repeated.positions.push_back(state.positions[n] + offset);
            repeated.velocities.push_back(state.velocities[n]);
            if (!state.earlier_velocities.empty())
                repeated.earlier_velocities.push_back(state.earlier_velocities[n]);
        }
    }
    return repeated;
}

}  // namespace

const std::array<ContactScene, 4>& contact_scenes() {
    static const std::array<ContactScene, 4> scenes{{{"A", "../bench/peers/", "scene_a.toml", 25, 45},
                                                     {"B", "../bench/peers/", "scene_b.toml", 4, 14},
                                                     {"pile", "", "pile.toml", 60, 75},
                                                     {"rain", "", "rain.toml", 55, 60}}};
    return scenes;
}

ContactLeadIn::ContactLeadIn(const ContactScene& scene, const std::filesystem::path& folder)
    : scene_(load_contact_scene(scene, folder)), model_(std::make_shared<const Model>(build_model(scene_))) {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator = SimulatorInternals::make(scene_, model_, options);
    while (simulator.frame() < scene.first - kContactWarmUp) simulator.advance_frame();
    state_ = SimulatorInternals::recorded_frame(simulator).moment.state;
    state_.memory.clear();  // the device's solver cannot read it
}

ContactCase ContactLeadIn::copies(int scale) const {
    glm::vec3 least = state_.positions.front(), most = least;
    for (const std::vector<glm::vec4>* positions : {&model_->positions, &state_.positions}) {
        for (const glm::vec4& position : *positions) {
            least = glm::min(least, glm::vec3(position));
            most = glm::max(most, glm::vec3(position));
        }
    }
    const std::vector<glm::dvec3> places = grid_places(glm::dvec3(most - least) + kMargin, scene_.up, scale);
    Scene scene = repeated(scene_, places);
    scene.meshes = model_->meshes;
    ContactCase made;
    made.model = std::make_shared<const Model>(build_model(scene));
    made.start = repeated(state_, *model_, *made.model, places);
    made.collision = scene.collision;
    made.collision.response = CollisionResponse::contact;
    made.implicit = {scene.simulation.iterations, true, false};
    made.frame_time = scene.simulation.frame_time();
    return made;
}

std::string contact_label(const ContactScene& scene, int scale, const StageSystem& system) {
    return fmt::format("{}, {}x, {}", scene.name, scale, system.name);
}

}  // namespace gelatin
