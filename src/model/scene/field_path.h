#pragma once

#include <cassert>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gelatin {

/// One step of a FieldPath: a key, and which element of the list that is there.
struct FieldStep {
    const char* key = "";  ///< of static storage
    std::optional<std::size_t> index;
};

/// Where in a scene a value is, by the keys of scene files: object[3].shape.box[1]. Made without allocating,
/// so that checks that hold cost little.
class FieldPath {
public:
    FieldPath() = default;
    FieldPath(const char* key, std::size_t index) { steps_[count_++] = {key, index}; }
    explicit FieldPath(const char* key) { steps_[count_++] = {key, {}}; }

    FieldPath operator/(const char* key) const { return joined({key, {}}); }
    /// An element of the list at this path. @pre the path has a last step without an index
    FieldPath operator[](std::size_t index) const {
        FieldPath path = *this;
        path.steps_[count_ - 1].index = index;
        return path;
    }

    std::span<const FieldStep> steps() const { return {steps_, count_}; }

private:
    FieldPath joined(const FieldStep& step) const {
        assert(count_ < kMostSteps);
        FieldPath path = *this;
        path.steps_[path.count_++] = step;
        return path;
    }

    static constexpr std::size_t kMostSteps = 6;
    FieldStep steps_[kMostSteps];
    std::size_t count_ = 0;
};

/// True if `name` can stand in a message of one line and in exported files: neither empty nor with control
/// characters.
bool is_plain_name(std::string_view name);

/// "object.ball.shape.box[1]". The first step's element goes by `name` if it is a plain one.
std::string describe(const FieldPath& path, std::string_view name);

}  // namespace gelatin
