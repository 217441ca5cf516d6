#pragma once

#include "fields.h"
#include "gelatin/scene.h"

namespace gelatin::python {

template <>
struct Fields<SphereShape> {
    static constexpr const char* kClass = "Sphere";
    static void visit(SphereShape& s, auto&& field) {
        auto& [radius, frequency] = s;
        field("radius", radius);
        field("frequency", frequency);
    }
};

template <>
struct Fields<BoxShape> {
    static constexpr const char* kClass = "Box";
    static void visit(BoxShape& b, auto&& field) {
        auto& [size, segments] = b;
        field("size", size);
        field("segments", segments);
    }
};

template <>
struct Fields<CapsuleShape> {
    static constexpr const char* kClass = "Capsule";
    static void visit(CapsuleShape& c, auto&& field) {
        auto& [radius, length, frequency] = c;
        field("radius", radius);
        field("length", length);
        field("frequency", frequency);
    }
};

template <>
struct Fields<TextShape> {
    static constexpr const char* kClass = "Text";
    static void visit(TextShape& t, auto&& field) {
        auto& [text, depth, size, font] = t;
        field("text", text);
        field("depth", depth);
        field("size", size);
        field("font", font);
    }
};

template <>
struct Fields<FileShape> {
    static constexpr const char* kClass = "File";
    static void visit(FileShape& f, auto&& field) {
        auto& [file] = f;
        field("file", file);
    }
};

/// Converted by mesh_conversion.cpp, from and to arrays.
template <>
struct Fields<MeshShape> {
    static constexpr const char* kClass = "Mesh";
};

template <>
struct Fields<BoxRegion> {
    static constexpr const char* kClass = "BoxRegion";
    static void visit(BoxRegion& r, auto&& field) {
        auto& [min, max] = r;
        field("min", min);
        field("max", max);
    }
};

template <>
struct Fields<SphereRegion> {
    static constexpr const char* kClass = "SphereRegion";
    static void visit(SphereRegion& r, auto&& field) {
        auto& [center, radius] = r;
        field("center", center);
        field("radius", radius);
    }
};

template <>
struct Fields<HalfSpaceRegion> {
    static constexpr const char* kClass = "HalfSpaceRegion";
    static void visit(HalfSpaceRegion& r, auto&& field) {
        auto& [normal, offset] = r;
        field("normal", normal);
        field("offset", offset);
    }
};

template <>
struct Fields<PlaneCollider> {
    static constexpr const char* kClass = "Plane";
    static void visit(PlaneCollider& p, auto&& field) {
        auto& [normal, offset] = p;
        field("normal", normal);
        field("offset", offset);
    }
};

}  // namespace gelatin::python
