#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "autonomy/settings/folder.hpp"
#include "base/descriptor.hpp"

namespace lapwing::autonomy {

namespace {

namespace fs = std::filesystem;
using base::Descriptor;

std::unexpected<base::Error> failed(std::string const& what, int error) {
  bool const is_full = error == ENOSPC || error == EDQUOT;
  return base::fail(base::ErrorKind::io, fmt::format("{}: {}", what, std::strerror(error)),
                    is_full ? "make room on that disk" : "look at that disk and its rights");
}

class DiskFolder final : public Folder {
 public:
  DiskFolder(fs::path path, Descriptor folder) : path_(std::move(path)), folder_(std::move(folder)) {}

  base::Result<std::optional<std::string>> read(std::string const& name, std::size_t most) override {
    Descriptor const file(::openat(folder_.get(), name.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0 && errno == ENOENT) return std::nullopt;
    if (file.get() < 0) return failed(fmt::format("cannot open {}", place_of(name)), errno);
    std::string text(most, '\0');
    std::size_t filled = 0;
    while (filled < most) {
      auto const got = ::read(file.get(), text.data() + filled, most - filled);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return failed(fmt::format("cannot read {}", place_of(name)), errno);
      if (got == 0) break;
      filled += static_cast<std::size_t>(got);
    }
    text.resize(filled);
    return text;
  }

  base::Result<> write_through(std::string const& name, std::string_view content) override {
    Descriptor const file(::openat(folder_.get(), name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (file.get() < 0) return failed(fmt::format("cannot make {}", place_of(name)), errno);
    if (!file.write_all(content) || ::fsync(file.get()) != 0)
      return failed(fmt::format("cannot write {}", place_of(name)), errno);
    return {};
  }

  base::Result<> rename(std::string const& from, std::string const& to) override {
    if (::renameat(folder_.get(), from.c_str(), folder_.get(), to.c_str()) != 0)
      return failed(fmt::format("cannot rename {} to {}", place_of(from), to), errno);
    return {};
  }

  base::Result<> sync_names() override {
    if (::fsync(folder_.get()) != 0) return failed(fmt::format("cannot write the folder {}", path_.string()), errno);
    return {};
  }

 private:
  [[nodiscard]] std::string place_of(std::string const& name) const { return (path_ / name).string(); }

  fs::path path_;
  Descriptor folder_;
};

}  // namespace

base::Result<std::unique_ptr<Folder>> open_folder(std::filesystem::path const& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return failed(fmt::format("cannot make the folder {}", path.string()), error.value());
  Descriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() < 0) return failed(fmt::format("cannot open the folder {}", path.string()), errno);
  return std::make_unique<DiskFolder>(path, std::move(folder));
}

}  // namespace lapwing::autonomy
