#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "map/live/live_map.hpp"
#include "map/store/care/retention.hpp"
#include "map/store/store.hpp"

/// What people do with a store beside using it: `lapwing store`. These wait for the disk, on the thread that calls
/// them.
namespace lapwing::map::care {

struct Summary {
  int version = 0;
  std::uint64_t bytes = 0;  ///< of the database and the pictures
  std::map<LayerKind, std::uint64_t> features = {};
  std::uint64_t removed = 0;
  std::vector<std::string> sites = {};
  std::map<GridKey, std::uint64_t> grid_tiles = {};
  std::uint64_t tile_shades = 0;  ///< ways in which tiles of grids have looked
  std::uint64_t pictures = 0;
  std::uint64_t picture_bytes = 0;
  std::vector<Store::Session> sessions = {};
};

/// What is in it. Reads only, also while a station writes.
[[nodiscard]] base::Result<Summary> summary(std::string const& address);

struct Verdict {
  std::uint64_t looked_at = 0;           ///< features, tiles, pieces of the past and pictures
  std::vector<std::string> faults = {};  ///< empty: all is well
  std::uint64_t stray_pictures = 0;  ///< files of which the database does not tell: left by an interruption, no fault
};

/// Reads everything: the database's own checks, each feature, tile and picture, whether the index finds what is there.
[[nodiscard]] base::Result<Verdict> verify(std::string const& address);

struct Compacted {
  std::uint64_t bytes_before = 0;
  std::uint64_t bytes_after = 0;
  std::uint64_t stray_pictures = 0;
};

/// Takes away what is beyond the limits, and gives the disk all the space that nobody uses. Errors: refused while a
/// station writes to the folder.
[[nodiscard]] base::Result<Compacted> compact(std::string const& address, Limits const& limits);

struct Copied {
  std::uint64_t rows = 0;
  std::uint64_t pictures = 0;
  std::vector<std::string> faults = {};  ///< pictures that could not be read, and are missing from the copy
};

/// All that is kept, from a folder or a server to another one. Whole or not at all; errors: refused when there is
/// something in the other one.
[[nodiscard]] base::Result<Copied> copy(std::string const& from, std::string const& to);

}  // namespace lapwing::map::care
