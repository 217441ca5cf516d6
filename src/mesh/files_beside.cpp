#include "mesh/files_beside.h"

#include <assimp/MemoryIOWrapper.h>
#include <algorithm>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"

namespace gelatin {
namespace {

std::string with_slashes(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

}  // namespace

FilesBeside::FilesBeside(const std::filesystem::path& file, const std::string& content)
    : folder_(file.parent_path()), name_(file.stem().string() + lower_case_ending(file)), content_(content) {}

bool FilesBeside::Exists(const char* name) const {
    return name == name_ || std::filesystem::is_regular_file(folder_ / with_slashes(name));
}

// Assimp tries names of its own where a file is missing; only those that the file names are reported.
Assimp::IOStream* FilesBeside::Open(const char* name, const char* /*mode*/) {
    const std::string* content = &content_;
    if (name != name_) {
        const std::string path = with_slashes(name);
        try {
            content = &others_.try_emplace(path, read_file(folder_ / path)).first->second;
        } catch (const Error&) {
            const bool is_known = std::find(missing_.begin(), missing_.end(), name) != missing_.end();
            if (!is_known && content_.find(name) != std::string::npos) missing_.emplace_back(name);
            return nullptr;
        }
        if (lower_case_ending(path) == ".mtl") has_materials_ = true;
    }
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(content->data()),
                                      content->size());
}

void FilesBeside::Close(Assimp::IOStream* stream) {
    delete stream;
}

}  // namespace gelatin
