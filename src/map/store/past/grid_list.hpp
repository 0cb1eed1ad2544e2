#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "map/store/past_grid.hpp"

namespace lapwing::map::past {

/// Under which name lists are kept among the frames of a session; no feed is called so.
inline constexpr std::string_view list_feed = "map.grids/tiles";

/// What is new of one grid at one moment.
struct GridList {
  GridKey key = {};
  GridPlace place = {};
  bool is_anew = false;                       ///< its tiles of before do not count
  std::map<TileKey, std::string> tiles = {};  ///< the names of how they look; empty: nothing is known there any more
};

/// As bytes: three texts with 16 bits of length, seven numbers of 64 bits (resolution, origin and turn of the cells,
/// latitude, longitude and altitude of the anchor), 8 bits (1: anew), 32 bits: how many tiles, and for each two numbers
/// of 32 bits and 16 bytes of its name.
[[nodiscard]] std::string packed(GridList const& list);
/// Nothing for what is none.
[[nodiscard]] std::optional<GridList> unpacked_list(std::string_view bytes);

/// What grids are like once the list has come.
void apply(GridList&& list, PastGrids& grids);

}  // namespace lapwing::map::past
