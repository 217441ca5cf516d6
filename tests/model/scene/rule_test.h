#pragma once

#include <functional>
#include <limits>

#include "model/scene/scene_file_fixture.h"

namespace gelatin::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// One rule: how a file breaks it, how a program does, and the error of both.
struct Rule {
    const char* name;
    const char* lines;  ///< of a file, in the place of `section`
    std::function<void(Scene&)> breaks;
    const char* problem;
};

inline std::ostream& operator<<(std::ostream& stream, const Rule& rule) {
    return stream << rule.name;
}

// What the files of all rules begin with, but for what a rule says otherwise: tables are lists, so that
// another one may follow.
inline constexpr const char* kMaterials = "[[material]]\nname = 'jelly'\n";
inline constexpr const char* kObject = "[[object]]\nname = 'ball'\nshape = {sphere = 0.5}\n";

inline Scene scene_of_file() {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].name = "jelly";
    scene.objects.resize(1);
    scene.objects[0].name = "ball";
    scene.objects[0].material = "jelly";
    return scene;
}

inline HandleDescription& add_handle(Scene& scene) {
    HandleDescription& handle = scene.objects[0].handles.emplace_back();
    handle.region = HalfSpaceRegion{{1, 0, 0}, 0.0};
    return handle;
}

inline LoadDescription& add_load(Scene& scene) {
    LoadDescription& load = scene.objects[0].loads.emplace_back();
    load.region = HalfSpaceRegion{{1, 0, 0}, 0.0};
    load.kind = ForceLoad{{1, 0, 0}};
    return load;
}

inline ColliderDescription& add_collider(Scene& scene) {
    scene.colliders.resize(1);
    return scene.colliders[0];
}

inline void add_part(Scene& scene, const std::string& material) {
    scene.objects[0].parts.push_back({Region(HalfSpaceRegion{{1, 0, 0}, 0.0}), material});
}

#define BREAKS(...) [](Scene& s) { __VA_ARGS__; }

/// A test of one rule by both.
class RuleTest : public SceneFile, public testing::WithParamInterface<Rule> {
protected:
    static std::string code_error(const Rule& rule) {
        Scene scene = scene_of_file();
        rule.breaks(scene);
        try {
            validate(scene);
        } catch (const InvalidInput& problem) {
            return problem.what();
        }
        return "no error";
    }

    // "scene.toml:7: what is wrong" without the place.
    std::string file_error(const std::string& text) {
        const std::string message = error(text);
        EXPECT_THAT(message, testing::MatchesRegex("scene\\.toml(:[0-9]+)?: .*"));
        return message.substr(message.find(": ") + 2);
    }
};

inline std::string rule_name(const testing::TestParamInfo<Rule>& rule) {
    return rule.param.name;
}

}  // namespace gelatin::test
