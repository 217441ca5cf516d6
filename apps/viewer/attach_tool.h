#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>

#include "gelatin/scene.h"
#include "gelatin/simulator.h"
#include "model/drive/attachment.h"
#include "model/model.h"
#include "picking.h"
#include "ray.h"

namespace gelatin::viewer {

/// Attaches a body by two clicks. The first is on a body. The second is on another body, a collider, or
/// nothing: then the body is attached to space.
class AttachTool {
public:
    /// Waits for the first click.
    void begin() {
        cancel();
        waits_ = true;
    }
    void cancel() { *this = AttachTool(); }
    bool is_active() const { return waits_; }

    /// @param is_rope the points that are clicked may come nearer to each other
    void click(const Ray& ray, bool is_rope) { click_ = {ray, is_rope}; }

    /// Carries out the click, and follows the point of the first one.
    /// @return what it has made; empty: nothing yet
    /// @throws InvalidInput as Simulator::attach. Then, and when something is made, it is not active any more
    std::optional<std::string> follow(Simulator& simulator);

    /// Where the first click was on its body, at present [m]; empty before it.
    const std::optional<glm::vec3>& first_point() const { return first_point_; }
    /// What the user is to do next.
    const char* hint() const;

private:
    struct Click {
        Ray ray;
        bool is_rope = false;
    };
    bool waits_ = false;
    std::optional<Click> click_;
    std::optional<FacePoint> first_;
    std::optional<glm::vec3> first_point_;
};

/// The same attachment of a point or a distance, with its points where they are at these positions of all
/// nodes [m]. A joint whose sides are apart there becomes a distance.
AttachmentDescription moved_attachment(const AttachmentDescription& description, const Attachment& made,
                                       const Model& model, std::span<const glm::vec4> positions);

}  // namespace gelatin::viewer
