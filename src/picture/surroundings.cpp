#include "picture/surroundings.h"

#include <utility>

#include "model/assembly/collider_surface.h"
#include "model/model.h"
#include "render/collider_props.h"
#include "sim/simulator_internals.h"

namespace gelatin {

render::Surroundings describe_surroundings(const Simulator& simulator, const Shown& shown) {
    render::Surroundings surroundings;
    const Model& model = model_of(simulator);
    const Scene& scene = simulator.scene();
    surroundings.up = scene.up;
    surroundings.bounds = shown.bodies();
    render::ColliderProps colliders =
        render::make_collider_props(solid_colliders(scene), surroundings.bounds, scene.up);
    surroundings.floor_height = colliders.floor_height;
    surroundings.props = std::move(colliders.props);
    for (std::size_t o = 0; o < model.objects.size(); ++o)
        surroundings.colors.push_back(model.is_body(o) ? model.objects[o].color : render::kPropColor);
    return surroundings;
}

render::Camera camera_of(const CameraDescription& description) {
    return {glm::vec3(description.eye), glm::vec3(description.target),
            static_cast<float>(description.field_of_view)};
}

}  // namespace gelatin
