#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/async/scope.hpp"
#include "base/async/side_thread.hpp"
#include "base/descriptor.hpp"
#include "link/operator_link/journal/disk.hpp"

namespace lapwing::link::operator_link {

namespace {

namespace fs = std::filesystem;
using base::Descriptor;

std::unexpected<base::Error> failed(std::string const& what, int error) {
  bool const is_full = error == ENOSPC || error == EDQUOT;
  return base::fail(base::ErrorKind::io, fmt::format("{}: {}", what, std::strerror(error)),
                    is_full ? "Make room on that disk; it goes on by itself." : "Look at that disk and its rights.");
}

class FolderDisk final : public Disk {
 public:
  FolderDisk(base::Loop& loop, fs::path path, Descriptor folder)
      : path_(std::move(path)), folder_(std::move(folder)), thread_(loop, std::make_unique<int>(0)), scope_(loop) {}

  [[nodiscard]] std::string name() const override { return path_.string(); }

  base::Result<std::vector<File>> list() override {
    std::vector<File> files;
    std::error_code error;
    for (auto at = fs::directory_iterator(path_, error); !error && at != fs::directory_iterator(); at.increment(error))
      if (at->is_regular_file(error)) files.push_back({at->path().filename().string(), at->file_size(error)});
    if (error) return failed(fmt::format("cannot read {}", name()), error.value());
    return files;
  }

  base::Result<std::vector<std::uint8_t>> read(std::string const& file, std::uint64_t offset,
                                               std::size_t most) override {
    auto const descriptor = opened(file, O_RDWR);
    if (!descriptor) return std::unexpected(descriptor.error());
    std::vector<std::uint8_t> bytes(most);
    auto const got = ::pread(*descriptor, bytes.data(), most, static_cast<off_t>(offset));
    if (got < 0) return failed(fmt::format("cannot read {}", (path_ / file).string()), errno);
    bytes.resize(static_cast<std::size_t>(got));
    return bytes;
  }

  base::Result<> append(std::string const& file, Bytes bytes) override {
    bool const is_new = !open_.contains(file);
    auto const descriptor = opened(file, O_RDWR | O_CREAT);
    if (!descriptor) return std::unexpected(descriptor.error());
    folder_changed_ = folder_changed_ || is_new;
    auto const before = ::lseek(*descriptor, 0, SEEK_END);
    std::size_t written = 0;
    while (written < bytes.size()) {
      auto const more = ::write(*descriptor, bytes.data() + written, bytes.size() - written);
      if (more < 0 && errno == EINTR) continue;
      if (more <= 0) {
        int const error = more < 0 ? errno : ENOSPC;
        // What stays would be taken for the beginning of what comes next.
        if (::ftruncate(*descriptor, before) != 0) return failed("cannot take back half a record", errno);
        return failed(fmt::format("cannot write {}", (path_ / file).string()), error);
      }
      written += static_cast<std::size_t>(more);
    }
    open_.at(file).is_dirty = true;
    return {};
  }

  base::Result<> cut(std::string const& file, std::uint64_t size) override {
    auto const descriptor = opened(file, O_RDWR);
    if (!descriptor) return std::unexpected(descriptor.error());
    if (::ftruncate(*descriptor, static_cast<off_t>(size)) != 0)
      return failed(fmt::format("cannot shorten {}", (path_ / file).string()), errno);
    open_.at(file).is_dirty = true;
    return {};
  }

  base::Result<> remove(std::string const& file) override {
    open_.erase(file);
    if (::unlinkat(folder_.get(), file.c_str(), 0) != 0)
      return failed(fmt::format("cannot remove {}", (path_ / file).string()), errno);
    return {};
  }

  void sync(Synced done) override { scope_.spawn(sync_files(std::move(done))); }

 private:
  struct Open {
    Descriptor descriptor;
    bool is_dirty = false;
  };

  base::Result<int> opened(std::string const& file, int flags) {
    if (auto const found = open_.find(file); found != open_.end()) return found->second.descriptor.get();
    int const number = ::openat(folder_.get(), file.c_str(), flags | O_CLOEXEC, 0600);
    if (number < 0) return failed(fmt::format("cannot open {}", (path_ / file).string()), errno);
    open_.emplace(file, Open{Descriptor(number)});
    return number;
  }

  /// Of copies of the descriptors: files may be removed meanwhile.
  base::Task<> sync_files(Synced done) {
    auto const copies = std::make_shared<std::vector<Descriptor>>();
    for (auto& [file, open] : open_)
      if (std::exchange(open.is_dirty, false)) copies->emplace_back(::dup(open.descriptor.get()));
    if (std::exchange(folder_changed_, false)) copies->emplace_back(::dup(folder_.get()));
    auto wait = thread_.run([copies](int&) {
      for (auto const& copy : *copies)
        if (::fsync(copy.get()) != 0) return errno;
      return 0;
    });
    int const error = co_await wait;
    base::Result<> result;
    if (error != 0) result = failed(fmt::format("cannot write through to the disk of {}", name()), error);
    done(std::move(result));
  }

  fs::path path_;
  Descriptor folder_;
  std::map<std::string, Open, std::less<>> open_;
  bool folder_changed_ = false;
  base::SideThread<int> thread_;
  base::Scope scope_;
};

}  // namespace

base::Result<std::unique_ptr<Disk>> open_folder(base::Loop& loop, std::filesystem::path const& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return failed(fmt::format("cannot make the folder {}", path.string()), error.value());
  Descriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() < 0) return failed(fmt::format("cannot open the folder {}", path.string()), errno);
  if (::flock(folder.get(), LOCK_EX | LOCK_NB) != 0)
    return base::fail(base::ErrorKind::refused, fmt::format("another program uses {}", path.string()),
                      "End that program, or give this one a folder of its own.");
  return std::make_unique<FolderDisk>(loop, path, std::move(folder));
}

}  // namespace lapwing::link::operator_link
