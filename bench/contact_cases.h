#pragma once

#include <array>
#include <memory>
#include <string>

#include "bench/contact.h"
#include "bench/stages.h"
#include "gelatin/scene.h"
#include "model/solver.h"

namespace gelatin {

/// A scene, and a window of frames in which its bodies press each other: `contact_forces` of `gelatin run
/// --stats` have many points there, or as many as ever.
struct ContactScene {
    const char* name;
    const char* folder;  ///< in the folder of scenes, where --scenes names no other
    const char* file;
    int first, last;  ///< frames that are timed: from the end of `first` to that of `last`
};
const std::array<ContactScene, 4>& contact_scenes();

/// Frames that are made before those that are timed: they find pairs and room for them, and how many tries a
/// step takes.
inline constexpr int kContactWarmUp = 2;

/// Copies of a scene's bodies side by side, and where they are when a window begins.
struct ContactCase {
    std::shared_ptr<const Model> model;
    State start;  ///< kContactWarmUp frames before the window
    CollisionSettings collision;
    ImplicitSettings implicit;
    double frame_time;  ///< [s]
};

/// The lead-in of a scene: the CPU makes it, once.
class ContactLeadIn {
public:
    /// @throws InvalidInput for a scene that cannot be loaded, has a fixed number of substeps, or makes no
    ///   implicit steps with contact
    ContactLeadIn(const ContactScene& scene, const std::filesystem::path& folder);

    /// So far apart that copies never meet, on the same planes; colliders with faces are copied, too.
    /// @pre planes face up; nothing in the scene is held or driven
    ContactCase copies(int scale) const;

private:
    Scene scene_;
    std::shared_ptr<const Model> model_;
    State state_;
};

/// "A, 10x, CPU, 1 thread": the text that `--only` searches.
std::string contact_label(const ContactScene& scene, int scale, const StageSystem& system);

}  // namespace gelatin
