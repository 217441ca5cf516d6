#pragma once

#include <filesystem>
#include <vector>

namespace gelatin::viewer {

/// What was opened last, the newest first: each a scene, or meshes that were opened together. Kept in a file
/// of one line for each, the paths divided by tabs. Lines that make no sense are ignored; a file that cannot
/// be written causes a warning.
class RecentFiles {
public:
    using Files = std::vector<std::filesystem::path>;  ///< absolute

    static constexpr std::size_t kMost = 12;

    /// XDG_STATE_HOME/gelatin/recent, else ~/.local/state/gelatin/recent.
    static std::filesystem::path default_file();

    /// @param file empty: nothing is kept
    explicit RecentFiles(std::filesystem::path file = default_file());

    const std::vector<Files>& all() const { return all_; }

    /// Makes it the newest. Pipes and devices are not remembered, nor names with control characters.
    void add(const Files& files);

private:
    std::filesystem::path file_;
    std::vector<Files> all_;
};

}  // namespace gelatin::viewer
