#include "model/scene/scene_file_drives.h"

#include "model/scene/field_path.h"
#include "model/scene/scene_file_animation.h"
#include "model/scene/scene_file_region.h"

namespace gelatin {
namespace {

Keyframe read_keyframe(TableReader reader) {
    Keyframe keyframe;
    reader.require({"time"});
    reader.read("time", keyframe.time);
    reader.read("move", keyframe.move);
    reader.read("turn", keyframe.turn);
    reader.read("scale", keyframe.scale);
    reader.finish();
    return keyframe;
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

AttachedUniversal read_universal(TableReader reader) {
    AttachedUniversal universal{};
    reader.require({"point", "own", "of_other"});
    reader.read("point", universal.at);
    reader.read("own", universal.own);
    reader.read("of_other", universal.of_other);
    reader.finish();
    return universal;
}

JointSpring read_joint_spring(TableReader reader) {
    JointSpring spring;
    reader.read("stiffness", spring.stiffness);
    reader.read("damping", spring.damping);
    reader.read("rest", spring.rest);
    reader.finish();
    return spring;
}

MotorKeyframe read_motor_keyframe(TableReader reader) {
    MotorKeyframe keyframe;
    reader.require({"time"});
    reader.read("time", keyframe.time);
    reader.read("speed", keyframe.speed);
    reader.read("position", keyframe.position);
    reader.read("force", keyframe.force);
    reader.finish();
    return keyframe;
}

JointMotor read_motor(TableReader reader) {
    JointMotor motor;
    reader.read("speed", motor.speed);
    reader.read("position", motor.position);
    reader.read("force", motor.force);
    for (const TableReader& keyframe : reader.tables("keyframes"))
        motor.keyframes.push_back(read_motor_keyframe(keyframe));
    reader.finish();
    return motor;
}

// Which points it keeps.
void read_where(TableReader& reader, AttachmentDescription& attachment) {
    const std::string where =
        reader.at_most_one_of({"region", "point", "line", "rail", "universal", "distance"});
    if (where == "region") {
        attachment.where = read_region(*reader.table("region"));
    } else if (where == "point") {
        reader.read("point", attachment.where.emplace<AttachedPoint>().at);
    } else if (where == "line") {
        const auto [from, to] = reader.read_two_points("line", "points");
        attachment.where = AttachedLine{from, to};
    } else if (where == "rail") {
        const auto [from, to] = reader.read_two_points("rail", "points");
        attachment.where = AttachedRail{from, to};
    } else if (where == "universal") {
        attachment.where = read_universal(*reader.table("universal"));
    } else if (where == "distance") {
        const auto [from, to] = reader.read_two_points("distance", "points");
        attachment.where = AttachedDistance{from, to};
    }
}

AttachmentDescription read_attachment(TableReader& reader) {
    AttachmentDescription attachment;
    attachment.line = reader.line();
    reader.read_name("name", attachment.name);
    if (is_plain_name(attachment.name)) reader.set_path("attachment." + attachment.name);
    reader.require({"object"});
    reader.read("object", attachment.object);
    reader.read("to", attachment.to);
    read_where(reader, attachment);
    reader.read("compliance", attachment.compliance);
    reader.read("break_force", attachment.break_force);
    if (reader.has("limits")) reader.read("limits", attachment.limits.emplace());
    if (auto spring = reader.table("spring")) attachment.spring = read_joint_spring(std::move(*spring));
    if (auto motor = reader.table("motor")) attachment.motor = read_motor(std::move(*motor));
    reader.finish();
    return attachment;
}

}  // namespace

Interpolation read_interpolation(TableReader& reader) {
    Interpolation interpolation = Interpolation::linear;
    reader.read("interpolation", interpolation,
                {{"linear", Interpolation::linear}, {"smooth", Interpolation::smooth}});
    return interpolation;
}

WhenBlocked read_when_blocked(TableReader& reader) {
    WhenBlocked when_blocked = WhenBlocked::goes_on;
    reader.read("when_blocked", when_blocked,
                {{"goes_on", WhenBlocked::goes_on}, {"stops", WhenBlocked::stops}});
    return when_blocked;
}

std::vector<Keyframe> read_keyframes(TableReader& reader) {
    std::vector<Keyframe> keyframes;
    for (const TableReader& keyframe : reader.tables("keyframes"))
        keyframes.push_back(read_keyframe(keyframe));
    return keyframes;
}

HandleDescription read_handle(TableReader reader, const std::filesystem::path& folder) {
    HandleDescription handle;
    handle.line = reader.line();
    if (reader.require_one_of({"region", "skeleton"}) == "region") {
        handle.region = read_region(*reader.table("region"));
    } else {
        handle.skeleton = read_skeleton(*reader.table("skeleton"), folder);
    }
    if (reader.has("pivot")) reader.read("pivot", handle.pivot.emplace(0.0));
    handle.interpolation = read_interpolation(reader);
    reader.read("release", handle.release);
    handle.keyframes = read_keyframes(reader);
    handle.when_blocked = read_when_blocked(reader);
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
    reader.read("from", load.from);
    reader.read("until", load.until);
    reader.finish();
    return load;
}

std::vector<AttachmentDescription> read_attachments(std::vector<TableReader> tables) {
    std::vector<AttachmentDescription> attachments;
    for (TableReader& reader : tables) attachments.push_back(read_attachment(reader));
    return attachments;
}

}  // namespace gelatin
