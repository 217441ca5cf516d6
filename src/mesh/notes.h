#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gelatin {

/// One line for the user about an input: a repair, or a warning. `--quiet` hides repairs alone.
struct Note {
    std::string text;
    bool is_warning = false;

    // NOLINTNEXTLINE(google-explicit-constructor): most notes are their text
    Note(std::string line, bool warns = false) : text(std::move(line)), is_warning(warns) {}
    Note(const char* line, bool warns = false) : text(line), is_warning(warns) {}  // NOLINT
    operator const std::string&() const { return text; }                           // NOLINT

    friend bool operator==(const Note&, const Note&) = default;
};
using Notes = std::vector<Note>;

/// A note of something that may not be what was meant, as a part of the body that is lost.
inline Note warning(std::string line) {
    return {std::move(line), true};
}

/// "a; b; c".
inline std::string joined(std::span<const Note> notes) {
    std::string text;
    for (const Note& note : notes) text += (text.empty() ? "" : "; ") + note.text;
    return text;
}

}  // namespace gelatin
