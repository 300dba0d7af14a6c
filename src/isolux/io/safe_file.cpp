#include "isolux/io/safe_file.h"

#include <atomic>
#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

namespace isolux {

namespace {

namespace fs = std::filesystem;

std::string_view suggestion_for(std::error_code why) {
    if (why == std::errc::no_space_on_device || why == std::errc::file_too_large)
        return "Free some space, or write to another disk?";
    if (why == std::errc::permission_denied || why == std::errc::read_only_file_system
        || why == std::errc::operation_not_permitted)
        return "Write to a folder of your own?";
    if (why == std::errc::no_such_file_or_directory || why == std::errc::not_a_directory)
        return "Does the folder exist?";
    if (why == std::errc::is_a_directory)
        return "Is a folder of this name in the way?";
    return "Is the disk all right?";
}

std::error_code last_error() { return {errno, std::generic_category()}; }

/// An open file descriptor; closed at the end of its life.
class Descriptor {
public:
    explicit Descriptor(int fd) noexcept : fd_(fd) {}

    ~Descriptor() {
        if (fd_ >= 0)
            ::close(fd_);
    }

    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] bool is_open() const noexcept { return fd_ >= 0; }

    [[nodiscard]] int get() const noexcept { return fd_; }

    /// Closes and says whether the last bytes arrived (network file systems tell only now).
    [[nodiscard]] bool close() noexcept {
        const int fd = fd_;
        fd_ = -1;
        return ::close(fd) == 0;
    }

private:
    int fd_;
};

/// Removes the temporary file unless it has got its final name.
class Leftover {
public:
    explicit Leftover(const fs::path& path) : path_(path) {}

    ~Leftover() {
        if (is_left_)
            ::unlink(path_.c_str());
    }

    Leftover(const Leftover&) = delete;
    Leftover& operator=(const Leftover&) = delete;

    void keep() noexcept { is_left_ = false; }

private:
    fs::path path_;
    bool is_left_ = true;
};

fs::path temporary_name(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    // 255 bytes are the longest name file systems take.
    std::string name(".");
    name += path.filename().string().substr(0, 200);
    name += '.';
    name += std::to_string(::getpid());
    name += '-';
    name += std::to_string(counter++);
    name += ".tmp";
    return path.parent_path() / name;
}

bool write_all(int fd, std::string_view bytes) noexcept {
    while (!bytes.empty()) {
        const ::ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR)
            return false;
        if (written > 0)
            bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

/// Makes the renaming itself survive a power cut. File systems that cannot do it are many and
/// lose nothing but that.
void flush_folder(const fs::path& folder) noexcept {
    const Descriptor fd(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC));
    if (fd.is_open())
        static_cast<void>(::fsync(fd.get()));
}

} // namespace

WriteError::WriteError(const fs::path& path, std::error_code why)
    : std::system_error(why), text_(path.string() + ": cannot be written (" + why.message()
                                    + "). " + std::string(suggestion_for(why))) {}

void write_file_safely(const fs::path& path, std::string_view bytes) {
    const fs::path temporary = temporary_name(path);
    Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file.is_open())
        throw WriteError(path, last_error());
    Leftover leftover(temporary);
    if (!write_all(file.get(), bytes) || ::fsync(file.get()) != 0 || !file.close())
        throw WriteError(path, last_error());
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error)
        throw WriteError(path, error);
    leftover.keep();
    flush_folder(path.parent_path());
}

void remove_file(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
        throw WriteError(path, error);
}

void make_folder(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!error && !fs::is_directory(path, error))
        error = std::make_error_code(std::errc::not_a_directory);
    if (error)
        throw WriteError(path, error);
}

} // namespace isolux
