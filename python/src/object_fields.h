#pragma once

#include "fields.h"
#include "gelatin/scene.h"

namespace gelatin::python {

template <>
struct Fields<MesherSettings> {
    static constexpr const char* kClass = "Mesher";
    static void visit(MesherSettings& m, auto&& field) {
        auto& [kind, quality, time_limit, nodes, max_volume, cell_size] = m;
        field("kind", kind);
        field("quality", quality);
        field("time_limit", time_limit);
        field("nodes", nodes);
        field("max_volume", max_volume);
        field("cell_size", cell_size);
    }
};

template <>
struct Fields<Keyframe> {
    static constexpr const char* kClass = "Keyframe";
    static void visit(Keyframe& k, auto&& field) {
        auto& [time, move, turn, scale] = k;
        field("time", time);
        field("move", move);
        field("turn", turn);
        field("scale", scale);
    }
};

template <>
struct Fields<DragDescription> {
    static constexpr const char* kClass = "Drag";
    static void visit(DragDescription& d, auto&& field) {
        auto& [move, turn] = d;
        field("move", move);
        field("turn", turn);
    }
};

template <>
struct Fields<SkeletonDescription> {
    static constexpr const char* kClass = "Skeleton";
    static void visit(SkeletonDescription& s, auto&& field) {
        auto& [file, radius, clip, start, speed, loop] = s;
        field("file", file);
        field("radius", radius);
        field("clip", clip);
        field("start", start);
        field("speed", speed);
        field("loop", loop);
    }
};

/// Read by animation_conversion.cpp, which sees to it that there is a region or a skeleton.
template <>
struct Fields<HandleDescription> {
    static constexpr const char* kClass = "Handle";
    static void visit(HandleDescription& h, auto&& field) {
        auto& [region, pivot, interpolation, release, keyframes, line, drag, when_blocked, skeleton] = h;
        std::optional<Region> place;  // of a skeleton: none
        if (!skeleton) place = region;
        field("region", place);
        if (place) region = *place;
        field("pivot", pivot);
        field("interpolation", interpolation);
        field("release", release);
        field("keyframes", keyframes);
        field("drag", drag);
        field("when_blocked", when_blocked);
        field("line", line);
        field("skeleton", skeleton);
    }
};

template <>
struct Fields<ForceLoad> {
    static constexpr const char* kClass = "Force";
    static void visit(ForceLoad& f, auto&& field) {
        auto& [sum] = f;
        field("sum", sum);
    }
};

template <>
struct Fields<TractionLoad> {
    static constexpr const char* kClass = "Traction";
    static void visit(TractionLoad& t, auto&& field) {
        auto& [stress] = t;
        field("stress", stress);
    }
};

template <>
struct Fields<PressureLoad> {
    static constexpr const char* kClass = "Pressure";
    static void visit(PressureLoad& p, auto&& field) {
        auto& [pressure] = p;
        field("pressure", pressure);
    }
};

template <>
struct Fields<LoadDescription> {
    static constexpr const char* kClass = "Load";
    static void visit(LoadDescription& l, auto&& field) {
        auto& [region, kind, from, until, line] = l;
        field("region", region);
        field("kind", kind);
        field("start", from);  // `from` is a word of Python's own
        field("until", until);
        field("line", line);
    }
};

template <>
struct Fields<TetAttribute> {
    static constexpr const char* kClass = "TetAttribute";
    static void visit(TetAttribute& a, auto&& field) {
        auto& [number] = a;
        field("number", number);
    }
};

template <>
struct Fields<PartDescription> {
    static constexpr const char* kClass = "Part";
    static void visit(PartDescription& p, auto&& field) {
        auto& [where, material, line] = p;
        field("where", where);
        field("material", material);
        field("line", line);
    }
};

template <>
struct Fields<StartDescription> {
    static constexpr const char* kClass = "Start";
    static void visit(StartDescription& s, auto&& field) {
        auto& [scale, scatter] = s;
        field("scale", scale);
        field("scatter", scatter);
    }
};

template <>
struct Fields<RigidDescription> {
    static constexpr const char* kClass = "Rigid";
    static void visit(RigidDescription& r, auto&& field) {
        auto& [mass, inertia] = r;
        field("mass", mass);
        field("inertia", inertia);
    }
};

template <>
struct Fields<CavityKeyframe> {
    static constexpr const char* kClass = "CavityKeyframe";
    static void visit(CavityKeyframe& k, auto&& field) {
        auto& [time, pressure, amount] = k;
        field("time", time);
        field("pressure", pressure);
        field("amount", amount);
    }
};

template <>
struct Fields<CavityDescription> {
    static constexpr const char* kClass = "Cavity";
    static void visit(CavityDescription& c, auto&& field) {
        auto& [name, region, law, pressure, amount, ambient, keyframes, line] = c;
        field("name", name);
        field("region", region);
        field("law", law);
        field("pressure", pressure);
        field("amount", amount);
        field("ambient", ambient);
        field("keyframes", keyframes);
        field("line", line);
    }
};

template <>
struct Fields<ObjectDescription> {
    static constexpr const char* kClass = "Object";
    static void visit(ObjectDescription& o, auto&& field) {
        auto& [name, shape, mesher, material, position, rotation, scale, velocity, spin, start, pins, handles,
               loads, color, line, parts, skin, up, pins_line, rigid, cavities] = o;
        field("name", name);
        field("shape", shape);
        field("mesher", mesher);
        field("material", material);
        field("position", position);
        field("rotation", rotation);
        field("scale", scale);
        field("velocity", velocity);
        field("spin", spin);
        field("start", start);
        field("pins", pins);
        field("handles", handles);
        field("loads", loads);
        field("color", color);
        field("parts", parts);
        field("skin", skin);
        field("up", up);
        field("line", line);
        field("pins_line", pins_line);
        field("rigid", rigid);
        field("cavities", cavities);
    }
};

template <>
struct Fields<AnimationClip> {
    static constexpr const char* kClass = "AnimationClip";
    static void visit(AnimationClip& c, auto&& field) {
        auto& [name] = c;
        field("name", name);
    }
};

template <>
struct Fields<AnimationFiles> {
    static constexpr const char* kClass = "AnimationFiles";
    static void visit(AnimationFiles& f, auto&& field) {
        auto& [pattern, rate] = f;
        field("pattern", pattern);
        field("rate", rate);
    }
};

/// The frames are converted by animation_conversion.cpp, from and to an array.
template <>
struct Fields<AnimationFrames> {
    static constexpr const char* kClass = "AnimationFrames";
    static void visit(AnimationFrames& f, auto&& field) {
        auto& [frames, rate] = f;
        field("frames", frames);
        field("rate", rate);
    }
};

template <>
struct Fields<AnimationByProgram> {
    static constexpr const char* kClass = "AnimationByProgram";
    static void visit(AnimationByProgram& /*p*/, auto&& /*field*/) {}
};

template <>
struct Fields<AnimationDescription> {
    static constexpr const char* kClass = "Animation";
    static void visit(AnimationDescription& a, auto&& field) {
        auto& [source, start, speed, loop] = a;
        field("source", source);
        field("start", start);
        field("speed", speed);
        field("loop", loop);
    }
};

template <>
struct Fields<ColliderDescription> {
    static constexpr const char* kClass = "Collider";
    static void visit(ColliderDescription& c, auto&& field) {
        auto& [shape, position, rotation, friction, restitution, keyframes, interpolation, pivot,
               surface_velocity, name, scale, when_blocked, up, animation, line] = c;
        field("shape", shape);
        field("position", position);
        field("rotation", rotation);
        field("friction", friction);
        field("restitution", restitution);
        field("keyframes", keyframes);
        field("interpolation", interpolation);
        field("pivot", pivot);
        field("surface_velocity", surface_velocity);
        field("name", name);
        field("scale", scale);
        field("when_blocked", when_blocked);
        field("up", up);
        field("animation", animation);
        field("line", line);
    }
};

template <>
struct Fields<AttachedPoint> {
    static constexpr const char* kClass = "AttachedPoint";
    static void visit(AttachedPoint& p, auto&& field) {
        auto& [at] = p;
        field("at", at);
    }
};

template <>
struct Fields<AttachedLine> {
    static constexpr const char* kClass = "AttachedLine";
    static void visit(AttachedLine& l, auto&& field) {
        auto& [from, to] = l;
        field("start", from);  // `from` is a word of Python's own
        field("end", to);
    }
};

template <>
struct Fields<AttachedRail> {
    static constexpr const char* kClass = "AttachedRail";
    static void visit(AttachedRail& r, auto&& field) {
        auto& [from, to] = r;
        field("start", from);
        field("end", to);
    }
};

template <>
struct Fields<AttachedUniversal> {
    static constexpr const char* kClass = "AttachedUniversal";
    static void visit(AttachedUniversal& u, auto&& field) {
        auto& [at, own, of_other] = u;
        field("at", at);
        field("own", own);
        field("of_other", of_other);
    }
};

template <>
struct Fields<AttachedDistance> {
    static constexpr const char* kClass = "AttachedDistance";
    static void visit(AttachedDistance& d, auto&& field) {
        auto& [from, to] = d;
        field("start", from);
        field("end", to);
    }
};

template <>
struct Fields<JointSpring> {
    static constexpr const char* kClass = "JointSpring";
    static void visit(JointSpring& s, auto&& field) {
        auto& [stiffness, damping, rest] = s;
        field("stiffness", stiffness);
        field("damping", damping);
        field("rest", rest);
    }
};

template <>
struct Fields<MotorKeyframe> {
    static constexpr const char* kClass = "MotorKeyframe";
    static void visit(MotorKeyframe& k, auto&& field) {
        auto& [time, speed, position, force] = k;
        field("time", time);
        field("speed", speed);
        field("position", position);
        field("force", force);
    }
};

template <>
struct Fields<JointMotor> {
    static constexpr const char* kClass = "JointMotor";
    static void visit(JointMotor& m, auto&& field) {
        auto& [speed, position, force, keyframes] = m;
        field("speed", speed);
        field("position", position);
        field("force", force);
        field("keyframes", keyframes);
    }
};

template <>
struct Fields<AttachmentDescription> {
    static constexpr const char* kClass = "Attachment";
    static void visit(AttachmentDescription& a, auto&& field) {
        auto& [name, object, to, where, compliance, break_force, limits, spring, motor, line] = a;
        field("name", name);
        field("object", object);
        field("to", to);
        field("where", where);
        field("compliance", compliance);
        field("break_force", break_force);
        field("limits", limits);
        field("spring", spring);
        field("motor", motor);
        field("line", line);
    }
};

template <>
struct Fields<CameraDescription> {
    static constexpr const char* kClass = "Camera";
    static void visit(CameraDescription& c, auto&& field) {
        auto& [eye, target, field_of_view] = c;
        field("eye", eye);
        field("target", target);
        field("field_of_view", field_of_view);
    }
};

}  // namespace gelatin::python
