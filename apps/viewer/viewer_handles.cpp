// ViewerApp: dragging, setting and removing pins and handles.
#include <algorithm>
#include <utility>

#include "dragged_scene.h"
#include "model/region.h"
#include "viewer_app.h"

namespace gelatin::viewer {
namespace {

constexpr float kReach = 12.0f;  // of the pointer [pixels of a usual screen]

// True if something holds a node of the region already.
bool is_taken(const Model& model, std::size_t object, const Region& region) {
    const Range& nodes = model.objects[object].handle_nodes;
    for (std::uint32_t h = nodes.first; h < nodes.end(); ++h) {
        const glm::vec4& start = model.positions[model.handle_nodes[h].node];
        if (holds(region, glm::dvec3(start))) return true;
    }
    return false;
}

std::size_t object_of(const Model& model, std::uint32_t node) {
    const auto found = std::find_if(model.objects.begin(), model.objects.end(),
                                    [&](const ModelObject& object) { return node < object.nodes.end(); });
    return static_cast<std::size_t>(found - model.objects.begin());
}

}  // namespace

std::vector<Marker> ViewerApp::markers() const {
    if (!session_ || !panels_.shows_markers) return {};
    return make_markers(session_->held_nodes(), session_->scene(), camera_);
}

const Marker* ViewerApp::pointed(const std::vector<Marker>& markers) const {
    if (handle_drag_) {
        const auto dragged = std::find_if(markers.begin(), markers.end(), [&](const Marker& marker) {
            return marker.held == handle_drag_->held();
        });
        return dragged == markers.end() ? nullptr : &*dragged;
    }
    if (dragging_ || window_.is_over_panel()) return nullptr;
    return find_marker(markers, pointer_,
                       kReach * window_.scale() / static_cast<float>(std::max(window_.pixels().y, 1)));
}

bool ViewerApp::take_handle(bool turns) {
    const std::vector<Marker> all = markers();
    const Marker* marker = pointed(all);
    if (marker == nullptr) return false;
    const auto kind = turns ? HandleDrag::Kind::turn : HandleDrag::Kind::move;
    handle_drag_.emplace(marker->held, session_->held_nodes()[marker->held], kind, camera_, pointer_);
    return true;
}

// A body that the user holds is pinned there: the pull continues until the simulation with the pin takes
// over. A pin or handle at the pointer is removed. While a scene is being built none is changed, so that
// their order stays the same.
void ViewerApp::pin() {
    if (loader_.is_busy()) return notify("the scene is still being built");
    const std::vector<Marker> all = markers();
    if (const Marker* marker = pointed(all)) {
        panels_.edited = released_scene(std::move(panels_.edited), session_->held_nodes()[marker->held]);
    } else if (hand_depth_) {
        const SphereRegion region = session_->held_region();
        const std::size_t object = object_of(session_->model(), session_->held_node());
        if (session_->model().objects[object].is_rigid)
            return notify("a rigid body has no pins: an attachment holds it");
        if (is_taken(session_->model(), object, region)) return notify("there is a pin already");
        HandleDescription handle;
        handle.region = region;
        panels_.edited.objects[object].handles.push_back(handle);
        hand_depth_.reset();
        dragging_.reset();
    } else {
        return notify("drag a body and press P to pin it, or point at a pin to remove it");
    }
    loader_.rebuild(panels_.edited);
}

}  // namespace gelatin::viewer
