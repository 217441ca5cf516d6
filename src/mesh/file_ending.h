#pragma once

#include <filesystem>
#include <string>

namespace gelatin {

/// The extension in lower case: ".obj" for "Bunny.OBJ".
inline std::string lower_case_ending(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    for (char& c : ending) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return ending;
}

}  // namespace gelatin
