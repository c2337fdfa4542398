#include "core/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <system_error>

#include "core/limits.h"

namespace pstrips::inline core {
namespace {

tl::unexpected<Error> io_error(const std::filesystem::path& path, const char* doing) {
  const std::string why = std::error_code(errno, std::generic_category()).message();
  return fail(ErrorCode::io, std::string(doing) + ": " + why, kNoOffset, path.string());
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ > 2) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

Result<Bytes> read_to_end(int fd, const std::filesystem::path& path, std::uint64_t max_bytes) {
  Bytes out;
  constexpr std::size_t kStep = 1 << 20;
  for (;;) {
    const std::size_t size = out.size();
    if (size > max_bytes)
      return fail(ErrorCode::over_limit, "larger than the limit", size, path.string());
    out.resize(size + kStep);
    const ssize_t got = ::read(fd, out.data() + size, kStep);
    if (got < 0 && errno != EINTR) return io_error(path, "cannot read");
    out.resize(size + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return out;
  }
}

Result<void> write_all(int fd, ByteView bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(fd, bytes.data(), std::min<std::size_t>(bytes.size(), 1 << 28));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return io_error(path, "cannot write");
    bytes = bytes.subspan(static_cast<std::size_t>(put));
  }
  return {};
}

class DescriptorSink final : public ByteSink {
 public:
  DescriptorSink(int fd, const std::filesystem::path& path) : fd_(fd), path_(path) {}
  Result<void> write(ByteView bytes) override { return write_all(fd_, bytes, path_); }

 private:
  int fd_;
  const std::filesystem::path& path_;
};

Result<void> write_to(int fd, const OutputFile& file, const std::filesystem::path& path) {
  if (!file.write) return write_all(fd, file.bytes, path);
  DescriptorSink sink(fd, path);
  return file.write(sink);
}

// Names of temporary files under way, where a signal handler can reach them.
constexpr std::size_t kMaxNamed = 64;
std::array<std::array<char, PATH_MAX>, kMaxNamed> temporary_names;
std::array<std::atomic<bool>, kMaxNamed> temporary_used;

// Signals wait while a file exists that a handler would not know of.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
  ~SignalsHeld() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

class TemporaryFile {
 public:
  static Result<TemporaryFile> create(const std::filesystem::path& target) {
    std::string name = target.string() + ".XXXXXX";
    if (name.size() >= PATH_MAX)
      return fail(ErrorCode::io, "path too long", kNoOffset, target.string());
    const SignalsHeld held;
    const int fd = ::mkstemp(name.data());
    if (fd < 0) return io_error(target, "cannot create");
    TemporaryFile file;
    file.name_ = std::move(name);
    file.fd_ = fd;
    for (std::size_t slot = 0; slot < kMaxNamed; ++slot) {
      if (temporary_used[slot]) continue;
      std::memcpy(temporary_names[slot].data(), file.name_.c_str(), file.name_.size() + 1);
      temporary_used[slot] = true;
      file.slot_ = slot;
      break;
    }
    return file;
  }
  TemporaryFile(TemporaryFile&& other) noexcept { *this = std::move(other); }
  TemporaryFile& operator=(TemporaryFile&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(fd_, other.fd_);
    std::swap(slot_, other.slot_);
    return *this;
  }
  ~TemporaryFile() {
    close();
    if (!name_.empty()) ::unlink(name_.c_str());
    release();
  }

  int fd() const { return fd_; }
  bool close() {
    const int fd = std::exchange(fd_, -1);
    return fd < 0 || ::close(fd) == 0;
  }
  bool rename_to(const std::filesystem::path& target) {
    if (::rename(name_.c_str(), target.c_str()) != 0) return false;
    name_.clear();
    release();
    return true;
  }

 private:
  TemporaryFile() = default;
  void release() {
    if (slot_ < kMaxNamed) temporary_used[slot_] = false;
    slot_ = kMaxNamed;
  }
  std::string name_;
  int fd_ = -1;
  std::size_t slot_ = kMaxNamed;
};

// mkstemp makes private files; an output gets what creat() would have given, or what it replaces.
void set_usual_mode(int fd, const std::filesystem::path& target) {
  struct stat old {};
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const mode_t mode = ::stat(target.c_str(), &old) == 0 ? old.st_mode & 07777 : 0666 & ~mask;
  (void)::fchmod(fd, mode);
}

}  // namespace

FileBytes::FileBytes(FileBytes&& other) noexcept { *this = std::move(other); }

FileBytes& FileBytes::operator=(FileBytes&& other) noexcept {
  std::swap(mapping_, other.mapping_);
  std::swap(owned_, other.owned_);  // a vector's buffer stays where it is
  std::swap(view_, other.view_);
  return *this;
}

void FileBytes::release(std::size_t size) const {
  if (!mapping_) return;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  // Only pages of the mapping itself: beyond it stand others'.
  (void)::madvise(mapping_, std::min(size, view_.size()) / page * page, MADV_DONTNEED);
}

FileBytes::~FileBytes() {
  if (mapping_) ::munmap(mapping_, view_.size());
}

Result<FileBytes> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
  const Descriptor file(path == "-" ? 0 : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return io_error(path, "cannot open");
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) return io_error(path, "cannot open");
  if (S_ISDIR(info.st_mode)) return fail(ErrorCode::io, "is a folder", kNoOffset, path.string());
  FileBytes out;
  const auto size = static_cast<std::size_t>(info.st_size);
  if (S_ISREG(info.st_mode) && path != "-" && size > 0) {
    if (size > max_bytes)
      return fail(ErrorCode::over_limit, over_limit_message(size, "bytes", max_bytes), kNoOffset,
                  path.string());
    void* mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
    if (mapping != MAP_FAILED) {
      out.mapping_ = mapping;
      out.view_ = {static_cast<const std::byte*>(mapping), size};
      return out;
    }
  }
  auto bytes = read_to_end(file.get(), path, max_bytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return FileBytes(std::move(bytes).value());
}

Result<void> write_files(const std::vector<OutputFile>& files) {
  std::vector<std::pair<TemporaryFile, const OutputFile*>> written;
  for (const OutputFile& file : files) {
    if (file.path == "-") continue;
    // Devices and pipes cannot be replaced by a rename.
    struct stat info {};
    if (::stat(file.path.c_str(), &info) == 0 && !S_ISREG(info.st_mode)) {
      if (S_ISDIR(info.st_mode))
        return fail(ErrorCode::io, "is a folder", kNoOffset, file.path.string());
      const Descriptor device(::open(file.path.c_str(), O_WRONLY | O_CLOEXEC));
      if (device.get() < 0) return io_error(file.path, "cannot open");
      if (auto done = write_to(device.get(), file, file.path); !done) return done;
      continue;
    }
    auto temporary = TemporaryFile::create(file.path);
    if (!temporary) return tl::unexpected(temporary.error());
    if (auto done = write_to(temporary->fd(), file, file.path); !done) return done;
    set_usual_mode(temporary->fd(), file.path);
    if (!temporary->close()) return io_error(file.path, "cannot write");
    written.emplace_back(std::move(temporary).value(), &file);
  }
  for (auto& [temporary, file] : written)
    if (!temporary.rename_to(file->path)) return io_error(file->path, "cannot rename");
  for (const OutputFile& file : files)
    if (file.path == "-")
      if (auto done = write_to(1, file, "standard output"); !done) return done;
  return {};
}

Result<void> check_writable(const std::filesystem::path& path) {
  struct stat info {};
  if (path == "-") return {};
  if (::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode)) {
    if (S_ISDIR(info.st_mode)) return fail(ErrorCode::io, "is a folder", kNoOffset, path.string());
    if (::access(path.c_str(), W_OK) != 0) return io_error(path, "cannot open");
    return {};
  }
  if (const auto temporary = TemporaryFile::create(path); !temporary)
    return tl::unexpected(temporary.error());
  return {};
}

void remove_temporary_files() noexcept {
  for (std::size_t slot = 0; slot < kMaxNamed; ++slot)
    if (temporary_used[slot]) ::unlink(temporary_names[slot].data());
}

}  // namespace pstrips::inline core
