#include "model/scene/scene_file_drives.h"

#include <fmt/core.h>

#include "model/scene/scene_file_region.h"

namespace gelatin {
namespace {

Keyframe read_keyframe(TableReader reader) {
    Keyframe keyframe;
    reader.require({"time"});
    reader.read("time", keyframe.time, kNotNegative);
    reader.read("move", keyframe.move);
    reader.read("turn", keyframe.turn);
    reader.read("scale", keyframe.scale, kPositive);
    reader.finish();
    return keyframe;
}

std::vector<Keyframe> read_keyframes(const std::vector<TableReader>& tables) {
    std::vector<Keyframe> keyframes;
    for (const TableReader& reader : tables) {
        const Keyframe keyframe = read_keyframe(reader);
        const bool rests =
            keyframe.move == glm::dvec3(0.0) && keyframe.turn == glm::dvec3(0.0) && keyframe.scale == 1.0;
        if (keyframes.empty() && !rests)
            reader.fail("",
                        "the first keyframe is where the body starts: it must not move, turn or scale it");
        if (!keyframes.empty() && keyframe.time <= keyframes.back().time) {
            reader.fail("time", fmt::format("must be greater than that of the keyframe before, {}",
                                            keyframes.back().time));
        }
        keyframes.push_back(keyframe);
    }
    return keyframes;
}

DragDescription read_drag(TableReader reader) {
    DragDescription drag;
    reader.read("move", drag.move);
    reader.read("turn", drag.turn);
    reader.finish();
    return drag;
}

Region require_region(TableReader& reader) {
    reader.require({"region"});
    return read_region(*reader.table("region"));
}

}  // namespace

HandleDescription read_handle(TableReader reader) {
    HandleDescription handle;
    handle.line = reader.line();
    handle.region = require_region(reader);
    if (reader.has("pivot")) reader.read("pivot", handle.pivot.emplace(0.0));
    reader.read("interpolation", handle.interpolation,
                {{"linear", Interpolation::linear}, {"smooth", Interpolation::smooth}});
    reader.read("release", handle.release, kPositive);
    handle.keyframes = read_keyframes(reader.tables("keyframes"));
    if (auto drag = reader.table("drag")) handle.drag = read_drag(std::move(*drag));
    reader.finish();
    return handle;
}

LoadDescription read_load(TableReader reader) {
    LoadDescription load;
    load.line = reader.line();
    load.region = require_region(reader);
    const std::string kind = reader.require_one_of({"force", "traction", "pressure"});
    if (kind == "force") {
        reader.read("force", load.kind.emplace<ForceLoad>().sum);
    } else if (kind == "traction") {
        reader.read("traction", load.kind.emplace<TractionLoad>().stress);
    } else {
        reader.read("pressure", load.kind.emplace<PressureLoad>().pressure);
    }
    reader.read("from", load.from, kNotNegative);
    reader.read("until", load.until, kPositive);
    if (load.until && *load.until <= load.from.value_or(0.0))
        reader.fail("until", fmt::format("must be greater than from, {}", load.from.value_or(0.0)));
    reader.finish();
    return load;
}

}  // namespace gelatin
