#include "core/file_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <utility>

#include "core/file.h"

namespace gelatin {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 20;

// The system's reason why not all was written; 0: all was.
int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
        if (n < 0 && errno != EINTR) return errno;
        if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return 0;
}

}  // namespace

FileWriter::FileWriter(fs::path file) : file_(std::move(file)) {
    if (is_stream(file_)) {
        descriptor_ = open_stream(file_);
    } else {
        target_ = link_target(file_);
        partial_ = partial_name(target_);
        descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    }
    if (descriptor_ < 0) fail(errno);
}

FileWriter::~FileWriter() {
    discard();
}

void FileWriter::append(std::string_view bytes) {
    buffer_ += bytes;
    if (buffer_.size() >= kBuffer) flush();
}

void FileWriter::flush() {
    if (const int reason = write_all(descriptor_, buffer_); reason != 0) fail(reason);
    buffer_.clear();
}

void FileWriter::finish() {
    flush();
    if (!partial_.empty() && ::fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
    if (!partial_.empty() && ::rename(partial_.c_str(), target_.c_str()) != 0) fail(errno);
    partial_.clear();
}

void FileWriter::discard() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    if (!partial_.empty()) ::unlink(partial_.c_str());
    partial_.clear();
}

void FileWriter::fail(int reason) {
    discard();
    fail_to_write(file_, reason);
}

ScratchFile::ScratchFile(fs::path folder) : folder_(std::move(folder)) {
    std::string name = (folder_ / ".gelatin-XXXXXX").string();
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) fail_to_write(folder_, errno);
    ::unlink(name.c_str());
}

ScratchFile::~ScratchFile() {
    ::close(descriptor_);
}

void ScratchFile::append(const void* data, std::size_t size) {
    const int reason = write_all(descriptor_, {static_cast<const char*>(data), size});
    if (reason != 0) fail_to_write(folder_, reason);
    size_ += size;
}

void ScratchFile::read(std::size_t offset, void* data, std::size_t size) const {
    auto* next = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t n = ::pread(descriptor_, next, size, static_cast<off_t>(offset));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) fail_to_write(folder_, n < 0 ? errno : EIO);
        next += n;
        offset += static_cast<std::size_t>(n);
        size -= static_cast<std::size_t>(n);
    }
}

fs::path scratch_folder(const fs::path& file) {
    if (is_stream(file)) return fs::temp_directory_path();
    const fs::path folder = link_target(file).parent_path();
    return folder.empty() ? "." : folder;
}

}  // namespace gelatin
