#include "model/scene/validate_animation.h"

#include <fmt/core.h>

#include <cmath>

#include "core/counted.h"
#include "mesh/file_ending.h"

namespace gelatin {
namespace {

bool is_gltf(const std::filesystem::path& file) {
    const std::string ending = lower_case_ending(file);
    return ending == ".gltf" || ending == ".glb";
}

void check_timing(const ValueChecks& checks, const FieldPath& field, double start, double speed) {
    checks.check(field / "start", start, kNotNegative);
    checks.check(field / "speed", speed, kPositive);
}

void check_frames(const ValueChecks& checks, const FieldPath& field, const AnimationFrames& of) {
    checks.check(field / "rate", of.rate, kPositive);
    if (!of.frames || of.frames->empty()) return checks.fail(field / "frames", "", "must be one or more");
    const std::size_t count = of.frames->front().size();
    for (std::size_t f = 0; f < of.frames->size(); ++f) {
        const std::vector<glm::dvec3>& frame = (*of.frames)[f];
        if (frame.size() != count)
            return checks.fail((field / "frames")[f], counted(frame.size(), "vertex", "vertices"),
                               fmt::format("must be {}, as in the first frame", count));
        for (std::size_t v = 0; v < count; ++v) {
            const glm::dvec3& p = frame[v];
            if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
            return checks.fail((field / "frames")[f], text_of(p), fmt::format("vertex {} must be finite", v));
        }
    }
}

}  // namespace

void check_animation(const ValueChecks& checks, const FieldPath& field, const AnimationDescription& animation,
                     const Shape& shape) {
    check_timing(checks, field, animation.start, animation.speed);
    const auto* file = std::get_if<FileShape>(&shape);
    if (const auto* clip = std::get_if<AnimationClip>(&animation.source);
        clip && !(file && is_gltf(file->file)))
        checks.fail(field / "clip", text_of(clip->name), "needs a shape from a .gltf or .glb file");
    if (const auto* files = std::get_if<AnimationFiles>(&animation.source)) {
        const std::string pattern = files->pattern.filename().string();
        checks.check_text(field / "files", pattern);
        if (!file)
            checks.fail(field / "files", text_of(pattern),
                        "needs a shape from a file with the same vertices");
        checks.check(field / "rate", files->rate, kPositive);
    }
    if (const auto* frames = std::get_if<AnimationFrames>(&animation.source))
        check_frames(checks, field, *frames);
}

void check_skeleton(const ValueChecks& checks, const FieldPath& field, const SkeletonDescription& skeleton) {
    if (!is_gltf(skeleton.file))
        checks.fail(field / "file", text_of(skeleton.file.filename().string()), "must end in .gltf or .glb");
    checks.check(field / "radius", skeleton.radius, kPositive);
    check_timing(checks, field, skeleton.start, skeleton.speed);
}

}  // namespace gelatin
