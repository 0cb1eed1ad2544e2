#include "map/basemaps/pmtiles.hpp"

#include "map/basemaps/vector_layers.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace lapwing::map {

namespace {

using base::ErrorKind;
using base::fail;

constexpr std::size_t header_bytes = 127;
constexpr std::size_t most_directory_bytes = std::size_t{16} * 1024 * 1024;
constexpr std::size_t most_tile_bytes = std::size_t{8} * 1024 * 1024;
constexpr int deepest_leaf = 4;  ///< the specification wants one level, and allows more

std::unexpected<base::Error> damaged(std::string const& why) {
  return fail(ErrorKind::invalid_input, "the PMTiles archive is damaged: " + why);
}

enum class Compression : std::uint8_t { unknown, none, gzip, brotli, zstd };

/// A range of bytes of the archive.
struct Range {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
};

struct Header {
  Range root;
  Range metadata;
  Range leaves;
  Range tiles;
  Compression inner = Compression::none;  ///< of directories and metadata
  Compression outer = Compression::none;  ///< of tiles
  TileArchiveInfo info;
};

template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number value = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    value = static_cast<Number>(
        value | static_cast<Number>(static_cast<Number>(static_cast<unsigned char>(bytes[at + i])) << (8 * i)));
  return value;
}

Range range_at(std::string_view bytes, std::size_t at) {
  return {number_at<std::uint64_t>(bytes, at), number_at<std::uint64_t>(bytes, at + 8)};
}

double degrees_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::int32_t>(number_at<std::uint32_t>(bytes, at)) / 1e7;
}

std::string media_type_of(std::uint8_t type) {
  constexpr std::array<char const*, 6> types = {
      "application/octet-stream", "application/x-protobuf", "image/png", "image/jpeg", "image/webp", "image/avif"};
  return type < types.size() ? types[type] : types[0];
}

base::Result<Header> header_in(std::string_view bytes) {
  if (bytes.size() < header_bytes || bytes.substr(0, 7) != "PMTiles")
    return fail(ErrorKind::invalid_input, "it is no PMTiles archive");
  if (bytes[7] != 3)
    return fail(ErrorKind::invalid_input, fmt::format("it is PMTiles of version {}, not 3", static_cast<int>(bytes[7])),
                "convert it: pmtiles convert");
  Header header;
  header.root = range_at(bytes, 8);
  header.metadata = range_at(bytes, 24);
  header.leaves = range_at(bytes, 40);
  header.tiles = range_at(bytes, 56);
  header.inner = static_cast<Compression>(bytes[97]);
  header.outer = static_cast<Compression>(bytes[98]);
  auto& info = header.info;
  info.media_type = media_type_of(static_cast<std::uint8_t>(bytes[99]));
  info.least_zoom = static_cast<std::uint8_t>(bytes[100]);
  info.greatest_zoom = static_cast<std::uint8_t>(bytes[101]);
  info.bounds_deg = {degrees_at(bytes, 102), degrees_at(bytes, 106), degrees_at(bytes, 110), degrees_at(bytes, 114)};
  if (header.outer == Compression::gzip) info.encoding = "gzip";
  bool const is_readable = (header.inner == Compression::none || header.inner == Compression::gzip) &&
                           (header.outer == Compression::none || header.outer == Compression::gzip);
  if (!is_readable)
    return fail(ErrorKind::invalid_input, "the archive is packed with brotli or zstd, which is not read",
                "write it with gzip");
  if (info.greatest_zoom > TileAddress::deepest_zoom || info.least_zoom > info.greatest_zoom)
    return damaged(fmt::format("it has zooms {} to {}", info.least_zoom, info.greatest_zoom));
  return header;
}

base::Result<std::string> unpacked(std::string const& packed) {
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) return fail(ErrorKind::io, "there is no memory for unpacking");
  std::string bytes;
  std::array<char, 16384> part{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  int state = Z_OK;
  while (state == Z_OK && bytes.size() <= most_directory_bytes) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    bytes.append(part.data(), part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END) return damaged("a packed part does not unpack to less than 16 MiB");
  return bytes;
}

struct Entry {
  std::uint64_t id = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t run = 0;  ///< so many tiles share it; 0: it is a leaf directory
};

/// Reads numbers in groups of seven bits, the lowest first.
class VarintReader {
 public:
  explicit VarintReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t next() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      if (at_ == bytes_.size()) break;
      auto const byte = static_cast<unsigned char>(bytes_[at_++]);
      value |= std::uint64_t{byte & 0x7fU} << shift;
      if (byte < 0x80) return value;
    }
    is_cut_ = true;
    return 0;
  }
  [[nodiscard]] bool is_cut() const { return is_cut_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_cut_ = false;
};

base::Result<std::vector<Entry>> entries_in(std::string_view bytes) {
  VarintReader reader(bytes);
  auto const count = reader.next();
  if (reader.is_cut() || count > bytes.size() / 4) return damaged("a directory names more tiles than it has room for");
  std::vector<Entry> entries(count);
  std::uint64_t id = 0;
  for (auto& entry : entries) entry.id = id += reader.next();
  for (auto& entry : entries) entry.run = reader.next();
  for (auto& entry : entries) entry.length = reader.next();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    auto const offset = reader.next();
    entries[i].offset = offset > 0 ? offset - 1 : i > 0 ? entries[i - 1].offset + entries[i - 1].length : 0;
  }
  if (reader.is_cut()) return damaged("a directory ends too early");
  if (!std::ranges::is_sorted(entries, {}, &Entry::id)) return damaged("a directory is not in order");
  return entries;
}

class PmTiles final : public TileArchive {
 public:
  PmTiles(ReadBytes read, Header header, std::vector<Entry> root)
      : read_(std::move(read)), header_(std::move(header)), root_(std::move(root)) {}

  [[nodiscard]] TileArchiveInfo const& info() const override { return header_.info; }

  [[nodiscard]] base::Result<std::optional<std::string>> tile(TileAddress const& address) const override {
    if (!address.is_valid()) return std::optional<std::string>();
    auto const id = pmtiles_id(address);
    auto const* directory = &root_;
    // Leaves are read anew each time: the operating system keeps them, and nothing here has to be locked.
    std::vector<Entry> leaf;
    for (int depth = 0; depth < deepest_leaf; ++depth) {
      auto const after = std::ranges::upper_bound(*directory, id, {}, &Entry::id);
      if (after == directory->begin()) return std::optional<std::string>();
      auto const entry = *std::prev(after);
      if (entry.run > 0) return id - entry.id < entry.run ? tile_at(entry) : std::optional<std::string>();
      auto found = directory_at(read_, {header_.leaves.offset + entry.offset, entry.length}, header_.inner);
      if (!found) return std::unexpected(found.error());
      leaf = std::move(*found);
      directory = &leaf;
    }
    return damaged("its directories are nested too deep");
  }

  [[nodiscard]] static base::Result<std::string> part_at(ReadBytes const& read, Range const& range,
                                                         Compression compression) {
    if (range.length > most_directory_bytes) return damaged("a directory is larger than 16 MiB");
    auto bytes = read(range.offset, range.length);
    if (bytes.size() != range.length) return damaged("it ends too early");
    return compression == Compression::gzip ? unpacked(bytes) : base::Result<std::string>(std::move(bytes));
  }
  [[nodiscard]] static base::Result<std::vector<Entry>> directory_at(ReadBytes const& read, Range const& range,
                                                                     Compression compression) {
    auto const bytes = part_at(read, range, compression);
    if (!bytes) return std::unexpected(bytes.error());
    return entries_in(*bytes);
  }

 private:
  [[nodiscard]] base::Result<std::optional<std::string>> tile_at(Entry const& entry) const {
    if (entry.length > most_tile_bytes) return damaged("a tile is larger than 8 MiB");
    auto bytes = read_(header_.tiles.offset + entry.offset, entry.length);
    if (bytes.size() != entry.length) return damaged("it ends within a tile");
    return std::optional(std::move(bytes));
  }

  ReadBytes read_;
  Header header_;
  std::vector<Entry> root_;
};

/// What people wrote of the archive; one without is read all the same.
void read_metadata(TileArchiveInfo& info, std::string const& text) {
  auto const json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return;
  auto const word = [&](char const* key) {
    auto const found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  info.name = word("name");
  info.attribution = word("attribution");
  info.vector_layers = vector_layers_of(text);
}

}  // namespace

std::uint64_t pmtiles_id(TileAddress const& address) {
  std::uint64_t const before = ((std::uint64_t{1} << (2 * address.zoom)) - 1) / 3;
  std::uint64_t along = 0;
  std::uint64_t x = address.x;
  std::uint64_t y = address.y;
  for (std::uint64_t side = (std::uint64_t{1} << address.zoom) / 2; side > 0; side /= 2) {
    std::uint64_t const right = (x & side) > 0 ? 1 : 0;
    std::uint64_t const low = (y & side) > 0 ? 1 : 0;
    along += side * side * ((3 * right) ^ low);
    if (low != 0) continue;
    if (right != 0) {
      x = side - 1 - (x & (side - 1));
      y = side - 1 - (y & (side - 1));
    }
    std::swap(x, y);
  }
  return before + along;
}

base::Result<std::shared_ptr<TileArchive const>> open_pmtiles(ReadBytes read) {
  auto header = header_in(read(0, header_bytes));
  if (!header) return std::unexpected(header.error());
  auto root = PmTiles::directory_at(read, header->root, header->inner);
  if (!root) return std::unexpected(root.error());
  if (auto const metadata = PmTiles::part_at(read, header->metadata, header->inner))
    read_metadata(header->info, *metadata);
  return std::make_shared<PmTiles const>(std::move(read), std::move(*header), std::move(*root));
}

}  // namespace lapwing::map
