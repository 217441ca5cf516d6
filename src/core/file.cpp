#include "core/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

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

void write_file(const fs::path& file, const std::string& content) {
    const fs::path partial = partial_name(file);
    const auto fail = [&](int reason) {
        ::unlink(partial.c_str());
        throw SystemError(file.string() + ": cannot be written: " + std::strerror(reason));
    };
    const int descriptor = ::open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(errno);
    std::size_t written = 0;
    while (written < content.size()) {
        const ssize_t n = ::write(descriptor, content.data() + written, content.size() - written);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            const int reason = errno;
            ::close(descriptor);
            fail(reason);
        }
        written += static_cast<std::size_t>(n);
    }
    const bool flushed = ::fsync(descriptor) == 0 || errno == EINVAL;
    const int flush_error = errno;
    if (::close(descriptor) != 0) fail(errno);
    if (!flushed) fail(flush_error);
    if (::rename(partial.c_str(), file.c_str()) != 0) fail(errno);
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
