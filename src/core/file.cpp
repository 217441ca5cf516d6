#include "core/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/file_writer.h"
#include "gelatin/error.h"

namespace gelatin {
namespace fs = std::filesystem;

std::string read_file(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) throw InvalidInput({file.string(), 0, {}, {}, "no such file"});
    if (fs::is_directory(status)) throw InvalidInput({file.string(), 0, {}, {}, "is a folder, not a file"});
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    if (stream.peek() != std::ifstream::traits_type::eof()) content << stream.rdbuf();
    if (!stream.is_open() || stream.bad() || content.fail()) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, std::string("cannot be read: ") + std::strerror(errno)});
    }
    return std::move(content).str();
}

fs::path partial_name(const fs::path& file) {
    const std::string name = "." + file.stem().string() + "." + std::to_string(::getpid()) + ".partial" +
                             file.extension().string();
    return file.parent_path() / name;
}

namespace {

constexpr int kMostLinks = 40;  // as Linux allows in a row
constexpr const char* kStandardOutputName = "-";

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// What `file` is a link to; empty: it is none.
std::optional<fs::path> read_link(const fs::path& file) {
    std::error_code error;
    const fs::path target = fs::read_symlink(file, error);
    if (error) return {};
    return target.is_absolute() ? target : file.parent_path() / target;
}

// The open descriptor of this process that `file` is a name of, as /dev/stdout is. Such a name cannot be
// resolved further: what it links to may be no path.
std::optional<int> descriptor_of(fs::path file) {
    if (file == kStandardOutputName) return STDOUT_FILENO;
    const fs::path descriptors = "/proc/" + std::to_string(::getpid()) + "/fd";
    for (int links = 0; links < kMostLinks; ++links) {
        std::error_code error;
        if (fs::canonical(folder_of(file), error) == descriptors) {
            const std::string name = file.filename().string();
            const bool is_number = !name.empty() && name.find_first_not_of("0123456789") == name.npos;
            return is_number && name.size() < 8 ? std::optional(std::stoi(name)) : std::nullopt;
        }
        const std::optional<fs::path> target = read_link(file);
        if (!target) return {};
        file = *target;
    }
    return {};
}

}  // namespace

void fail_to_write(const fs::path& file, int reason) {
    const std::string name = file == kStandardOutputName ? "standard output" : file.string();
    throw SystemError(name + ": cannot be written: " + std::strerror(reason));
}

int open_stream(const fs::path& file) {
    std::fflush(stdout);  // what was printed before comes before
    const std::optional<int> open = descriptor_of(file);
    return open ? ::dup(*open) : ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
}

bool is_stream(const fs::path& file) {
    if (descriptor_of(file)) return true;
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool is_standard_output(const fs::path& file) {
    return descriptor_of(file) == STDOUT_FILENO;
}

fs::path link_target(const fs::path& file) {
    fs::path target = file;
    for (int links = 0; links < kMostLinks; ++links) {
        const std::optional<fs::path> next = read_link(target);
        if (!next) return target;
        target = *next;
    }
    fail_to_write(file, ELOOP);
}

void write_file(const fs::path& file, const std::string& content) {
    FileWriter writer(file);
    writer.append(content);
    writer.finish();
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "gelatin-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw SystemError(name + ": cannot make a temporary folder: " + std::strerror(errno));
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;  // a destructor cannot report an error
    fs::remove_all(path_, ignored);
}

}  // namespace gelatin
