#include "model/scene/scene_file_animation.h"

namespace gelatin {
namespace {

std::filesystem::path placed(const std::string& path, const std::filesystem::path& folder) {
    return path.empty() ? std::filesystem::path() : folder / path;
}

void read_timing(TableReader& reader, double& start, double& speed, bool& loop) {
    reader.read("start", start);
    reader.read("speed", speed);
    reader.read("loop", loop);
}

}  // namespace

AnimationDescription read_animation(TableReader reader, const std::filesystem::path& folder) {
    AnimationDescription animation;
    const std::string source = reader.at_most_one_of({"clip", "files", "by_program"});
    if (source == "files") {
        std::string pattern;
        reader.read("files", pattern);
        AnimationFiles files{placed(pattern, folder)};
        reader.read("rate", files.rate);
        animation.source = files;
    } else if (source == "by_program") {
        bool is_so = true;
        reader.read("by_program", is_so);
        if (!is_so) reader.fail("by_program", "must be true, or left out");
        animation.source = AnimationByProgram();
    } else {
        reader.read("clip", animation.source.emplace<AnimationClip>().name);
    }
    if (source != "by_program") read_timing(reader, animation.start, animation.speed, animation.loop);
    reader.finish();
    return animation;
}

SkeletonDescription read_skeleton(TableReader reader, const std::filesystem::path& folder) {
    SkeletonDescription skeleton;
    reader.require({"file", "radius"});
    std::string file;
    reader.read("file", file);
    skeleton.file = placed(file, folder);
    reader.read("radius", skeleton.radius);
    reader.read("clip", skeleton.clip);
    read_timing(reader, skeleton.start, skeleton.speed, skeleton.loop);
    reader.finish();
    return skeleton;
}

}  // namespace gelatin
