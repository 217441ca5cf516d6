#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/animation/animation_file.h"
#include "sim/animation/frame_store.h"

namespace gelatin {

/// Point caches: the points of the OBJ files of `gelatin export`, in the same order, and nothing else.
/// PC2 is Autodesk's PointCache2, MDD LightWave's Motion Designer; both are read by Blender and Maya.
class PointCacheFile : public AnimationFile {
public:
    enum class Kind { pc2, mdd };
    PointCacheFile(std::filesystem::path file, Kind kind, const Model& model, double frame_rate);

    void write(const HostFrame& frame) override;
    void finish() override;

private:
    std::string head() const;
    std::string bytes_of(const std::vector<float>& values) const;

    std::filesystem::path file_;
    Kind kind_;
    double frame_rate_;
    std::vector<SkinPoint> points_;
    std::vector<int> frames_;
    std::vector<double> times_;  // [s]
    FrameStore points_of_frames_;
};

}  // namespace gelatin
