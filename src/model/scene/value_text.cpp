#include "model/scene/value_text.h"

#include <fmt/format.h>

namespace gelatin {
namespace {

template <class Vector>
std::string list_of(const Vector& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

std::string escaped(char c) {
    switch (c) {
        case '"':
        case '\\':
            return std::string("\\") + c;
        case '\n':
            return "\\n";
        case '\r':
            return "\\r";
        case '\t':
            return "\\t";
        default:
            break;
    }
    const auto code = static_cast<unsigned char>(c);
    return code < 0x20 || code == 0x7F ? fmt::format("\\u{:04x}", unsigned{code}) : std::string(1, c);
}

}  // namespace

std::string text_of(double value) {
    return fmt::format("{}", value);
}
std::string text_of(int value) {
    return fmt::format("{}", value);
}
std::string text_of(bool value) {
    return value ? "true" : "false";
}
std::string text_of(const glm::dvec2& v) {
    return fmt::format("[{}, {}]", v.x, v.y);
}
std::string text_of(const glm::dvec3& v) {
    return list_of(v);
}
std::string text_of(const glm::ivec3& v) {
    return list_of(v);
}
std::string text_of(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) quoted += escaped(c);
    return quoted + "\"";
}
std::string text_of(const char* text) {
    return text_of(std::string_view(text));
}

}  // namespace gelatin
