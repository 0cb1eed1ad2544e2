#pragma once

#include <string>
#include <vector>

#include "map/live/live_map.hpp"
#include "map/store/write/batch.hpp"
#include "map/store/write/pending.hpp"

namespace lapwing::map {

/// Puts what others have written into the map, by its rules. Where the map then knows more than they did, that is noted
/// to be written. What the map does not take is told.
[[nodiscard]] std::vector<std::string> apply_news(LiveMap& map, write::News const& news, write::Pending& pending);

/// The tiles of a grid as they were kept, each with the time that it is of. Error: the map does not take them.
[[nodiscard]] base::Result<> put_tiles(LiveMap& map, GridKey const& key, rows::GridPart const& part);
/// For `LiveMap::restore`: something that is there no more.
[[nodiscard]] FeatureRecord removed_record(rows::Removal const& removal);

}  // namespace lapwing::map
