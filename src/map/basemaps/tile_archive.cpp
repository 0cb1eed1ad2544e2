#include "map/basemaps/tile_archive.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "map/basemaps/mbtiles.hpp"
#include "map/basemaps/pmtiles.hpp"

namespace lapwing::map {

namespace {

/// A file that several threads read at places of their own.
class OpenFile {
 public:
  explicit OpenFile(std::filesystem::path const& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(OpenFile const&) = delete;
  OpenFile& operator=(OpenFile const&) = delete;

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] std::string read(std::uint64_t offset, std::size_t length) const {
    std::string bytes(length, '\0');
    std::size_t have = 0;
    while (have < length) {
      auto const count = ::pread(descriptor_, bytes.data() + have, length - have, static_cast<off_t>(offset + have));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      have += static_cast<std::size_t>(count);
    }
    bytes.resize(have);
    return bytes;
  }

 private:
  int descriptor_;
};

}  // namespace

base::Result<std::shared_ptr<TileArchive const>> TileArchive::open(std::filesystem::path const& path) {
  auto file = std::make_shared<OpenFile const>(path);
  if (!file->is_open())
    return base::fail(base::ErrorKind::io, fmt::format("{} cannot be opened: {}", path.string(), std::strerror(errno)));
  auto const beginning = file->read(0, 16);
  if (beginning.starts_with("SQLite format 3")) return open_mbtiles(path);
  if (!beginning.starts_with("PMTiles"))
    return base::fail(base::ErrorKind::invalid_input, fmt::format("{} is neither MBTiles nor PMTiles", path.string()),
                      "make map tiles of a GeoTIFF with: lapwing basemap FILE.tif");
  auto archive = open_pmtiles(
      [file = std::move(file)](std::uint64_t offset, std::size_t length) { return file->read(offset, length); });
  if (!archive) archive.error().message = fmt::format("{}: {}", path.string(), archive.error().message);
  return archive;
}

}  // namespace lapwing::map
