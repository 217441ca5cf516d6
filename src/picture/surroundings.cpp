#include "picture/surroundings.h"

#include <utility>

#include "model/build/collider_surface.h"
#include "model/model.h"
#include "render/collider_props.h"
#include "sim/simulator_internals.h"

namespace gelatin {

render::Surroundings describe_surroundings(const Simulator& simulator) {
    render::Surroundings surroundings;
    const Model& model = model_of(simulator);
    std::vector<float> positions = simulator.read_frame().positions;
    positions.resize(3 * std::size_t{model.body_node_count()});
    surroundings.bounds = render::bounds_of(positions);
    render::ColliderProps colliders =
        render::make_collider_props(solid_colliders(simulator.scene()), surroundings.bounds);
    surroundings.floor_height = colliders.floor_height;
    surroundings.props = std::move(colliders.props);
    if (surroundings.floor_height) {  // falling bodies end there
        glm::vec3 below = surroundings.bounds.center();
        below.y = *surroundings.floor_height;
        surroundings.bounds.add(below);
    }
    for (std::size_t o = 0; o < model.objects.size(); ++o)
        surroundings.colors.push_back(model.is_body(o) ? model.objects[o].color : render::kPropColor);
    return surroundings;
}

render::Camera camera_of(const CameraDescription& description) {
    return {glm::vec3(description.eye), glm::vec3(description.target),
            static_cast<float>(description.field_of_view)};
}

render::Camera choose_camera(const Scene& scene, const render::Surroundings& surroundings, float aspect) {
    if (scene.camera) return camera_of(*scene.camera);
    render::Bounds bounds = surroundings.bounds;
    for (const SurfaceMesh& prop : surroundings.props) {
        for (const glm::dvec3& p : prop.positions) bounds.add(glm::vec3(p));
    }
    return render::frame_bounds(bounds, aspect);
}

}  // namespace gelatin
