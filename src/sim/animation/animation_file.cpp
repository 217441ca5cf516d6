#include "sim/animation/animation_file.h"

#include "gelatin/error.h"
#include "sim/animation/gltf_file.h"
#include "sim/animation/point_cache.h"
#include "sim/animation/usd_file.h"

namespace gelatin {

const std::vector<std::string>& animation_endings() {
    static const std::vector<std::string> endings{".glb", ".usda", ".pc2", ".mdd"};
    return endings;
}

std::unique_ptr<AnimationFile> make_animation_file(const std::filesystem::path& file, const Model& model,
                                                   const AnimationSettings& settings) {
    const std::string ending = file.extension().string();
    if (ending == ".glb") return std::make_unique<GltfFile>(file, model, settings);
    if (ending == ".usda") return std::make_unique<UsdFile>(file, model, settings);
    using Kind = PointCacheFile::Kind;
    if (ending == ".pc2" || ending == ".mdd")
        return std::make_unique<PointCacheFile>(file, ending == ".pc2" ? Kind::pc2 : Kind::mdd, model,
                                                settings.frame_rate);
    throw InvalidInput({file.string(), 0, {}, {}, "must end with .glb, .usda, .pc2 or .mdd"});
}

}  // namespace gelatin
