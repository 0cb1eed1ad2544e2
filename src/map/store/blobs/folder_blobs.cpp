#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "base/descriptor.hpp"
#include "map/store/blobs/blobs.hpp"

namespace lapwing::map::blobs {

namespace {

namespace fs = std::filesystem;
using base::Descriptor;

constexpr auto unfinished = ".part";

std::unexpected<base::Error> system_fault(fs::path const& path) {
  auto const* const hint = errno == ENOSPC || errno == EDQUOT ? "make room on its disk" : "";
  return base::fail(base::ErrorKind::io, fmt::format("{}: {}", path.string(), std::strerror(errno)), hint);
}

Descriptor open_file(fs::path const& path, int flags) {
  return Descriptor(::open(path.c_str(), flags | O_CLOEXEC, 0644));
}

bool sync(Descriptor const& file) {
  return ::fsync(file.get()) == 0;
}

base::Result<std::string> read_all(Descriptor const& file, fs::path const& path) {
  std::string bytes;
  constexpr std::size_t piece = 1024 * 1024;
  for (;;) {
    auto const filled = bytes.size();
    bytes.resize(filled + piece);
    auto const read = ::read(file.get(), bytes.data() + filled, piece);
    if (read < 0 && errno != EINTR) return system_fault(path);
    bytes.resize(filled + static_cast<std::size_t>(read < 0 ? 0 : read));
    if (read == 0) return bytes;
  }
}

bool sync_folder(fs::path const& folder) {
  auto const opened = open_file(folder, O_RDONLY | O_DIRECTORY);
  return opened.is_open() && sync(opened);
}

class FolderBytes final : public Bytes {
 public:
  explicit FolderBytes(fs::path folder) : folder_(std::move(folder)) {}

  base::Result<> write(std::string const& hash, std::string const& bytes) override {
    auto const place = place_of(hash);
    auto const folder = place.parent_path();
    std::error_code fault;
    bool const is_new = fs::create_directories(folder, fault);
    if (fault) return base::fail(base::ErrorKind::io, fmt::format("{}: {}", folder.string(), fault.message()));
    auto part = place;
    part += unfinished;
    auto written = write_whole(part, bytes);
    if (written && ::rename(part.c_str(), place.c_str()) != 0) written = system_fault(place);
    if (!written) {
      ::unlink(part.c_str());
      return written;
    }
    // The names, too, must be on the disk.
    if (!sync_folder(folder) || (is_new && !(sync_folder(folder_) && sync_folder(folder_.parent_path()))))
      return system_fault(folder);
    return {};
  }

  base::Result<std::string> read(std::string const& hash) override {
    auto const place = place_of(hash);
    auto const file = open_file(place, O_RDONLY);
    if (!file.is_open())
      return base::fail(errno == ENOENT ? base::ErrorKind::not_found : base::ErrorKind::io,
                        fmt::format("{}: {}", place.string(), std::strerror(errno)));
    return read_all(file, place);
  }

  void remove(std::string const& hash) override { ::unlink(place_of(hash).c_str()); }

  base::Result<std::vector<std::string>> all_hashes() override {
    std::vector<std::string> hashes;
    each_file([&](fs::path const& file) {
      if (file.extension() != unfinished)
        hashes.push_back(file.parent_path().filename().string() + file.filename().string());
    });
    return hashes;
  }

  std::size_t remove_leftovers() override {
    std::size_t count = 0;
    each_file([&](fs::path const& file) {
      if (file.extension() == unfinished && ::unlink(file.c_str()) == 0) ++count;
    });
    return count;
  }

 private:
  [[nodiscard]] fs::path place_of(std::string const& hash) const {
    return folder_ / hash.substr(0, 2) / hash.substr(2);
  }

  static base::Result<> write_whole(fs::path const& part, std::string const& bytes) {
    auto const file = open_file(part, O_WRONLY | O_CREAT | O_TRUNC);
    if (!file.is_open() || !file.write_all(bytes) || !sync(file)) return system_fault(part);
    return {};
  }

  void each_file(std::function<void(fs::path const&)> const& call) const {
    std::error_code fault;
    for (auto at = fs::recursive_directory_iterator(folder_, fault); !fault && at != fs::end(at); at.increment(fault))
      if (at->is_regular_file(fault)) call(at->path());
  }

  fs::path folder_;
};

}  // namespace

std::unique_ptr<Bytes> in_folder(fs::path folder) {
  return std::make_unique<FolderBytes>(std::move(folder));
}

}  // namespace lapwing::map::blobs
