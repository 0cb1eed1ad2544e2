#include "map/store/care/contents.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "map/store/reader.hpp"
#include "map/store/rows/feature_rows.hpp"
#include "map/store/rows/grid_rows.hpp"
#include "map/store/rows/site_rows.hpp"
#include "map/store/schema/migrate.hpp"

namespace lapwing::map::care {

namespace {

constexpr std::size_t page_size = 10'000;

base::Result<std::unique_ptr<Reader>> open_to_read(std::string const& address) {
  place::Address const place(address);
  auto reader = Reader::open(place);
  if (!reader) return reader;
  if (auto const checked = schema::check(*(*reader)->database, place.name()); !checked)
    return std::unexpected(checked.error());
  return reader;
}

base::Result<> read_layer(sql::Database& database, LayerKind layer, Contents& contents) {
  std::int64_t behind = 0;
  for (bool is_last = false; !is_last;) {
    auto page = rows::read_page(database, layer, contents.sites, behind, page_size);
    if (!page) return std::unexpected(page.error());
    if (!page->faults.empty())
      return base::fail(base::ErrorKind::io, page->faults.front(), "lapwing store verify lists all that is wrong");
    std::ranges::move(page->features, std::back_inserter(contents.features));
    behind = page->last_fid;
    is_last = page->is_last;
  }
  return {};
}

base::Result<> read_grids(sql::Database& database, Contents& contents) {
  auto const parts = rows::read_grids(database);
  if (!parts) return std::unexpected(parts.error());
  for (auto const& [key, part] : *parts) {
    auto tiles = rows::read_tiles(database, key);
    if (!tiles) return std::unexpected(tiles.error());
    OccupancyGrid grid(part.resolution_m, part.site_from_grid);
    for (auto& [at, kept] : *tiles) grid.set_tile(at, std::move(kept.tile));
    contents.grids.emplace(key, std::move(grid));
  }
  return {};
}

}  // namespace

base::Result<Contents> read_contents(std::string const& address) {
  auto reader = open_to_read(address);
  if (!reader) return std::unexpected(reader.error());
  Contents contents;
  auto sites = rows::read_sites(*(*reader)->database);
  if (!sites) return std::unexpected(sites.error());
  contents.sites = *std::move(sites);
  for (auto const layer : all_layers) {
    if (auto const read = read_layer(*(*reader)->database, layer, contents); !read)
      return std::unexpected(read.error());
  }
  if (auto const read = read_grids(*(*reader)->database, contents); !read) return std::unexpected(read.error());
  return contents;
}

base::Result<std::string> read_picture(std::string const& address, std::string const& hash) {
  auto reader = open_to_read(address);
  if (!reader) return std::unexpected(reader.error());
  auto blob = blobs::read(*(*reader)->database, *(*reader)->bytes, hash);
  if (!blob) return std::unexpected(blob.error());
  return std::move(blob->bytes);
}

}  // namespace lapwing::map::care
