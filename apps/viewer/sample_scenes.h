#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gelatin::viewer {

/// A scene that comes with Gelatin.
struct SampleScene {
    std::filesystem::path file;
    std::string line;               ///< what happens in it
    std::filesystem::path picture;  ///< made by scripts/make_gallery; may not exist
};

/// By name: those of the folder `scenes` here, otherwise those of the sources.
std::vector<SampleScene> sample_scenes();

/// The first sentence of the comment at the top of a scene file; empty if it has none.
std::string first_sentence(std::string_view scene);

}  // namespace gelatin::viewer
