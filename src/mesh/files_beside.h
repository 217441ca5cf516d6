#pragma once

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gelatin {

/// The files that Assimp may read: one whose content is in memory, and those that it names, from its folder.
class FilesBeside : public Assimp::IOSystem {
public:
    /// @param content as long-lived as this
    FilesBeside(const std::filesystem::path& file, const std::string& content);

    /// Of the file in memory, for Assimp.
    const std::string& name() const { return name_; }

    /// Files that it names and that could not be read.
    const std::vector<std::string>& missing() const { return missing_; }
    /// True if a file of materials was read.
    bool has_materials() const { return has_materials_; }

    bool Exists(const char* name) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

private:
    std::filesystem::path folder_;
    std::string name_;
    const std::string& content_;
    std::map<std::string, std::string> others_;  // their contents, by name
    std::vector<std::string> missing_;
    bool has_materials_ = false;
};

}  // namespace gelatin
