#pragma once

#include <vector>

#include "map/features/layer_kind.hpp"
#include "map/store/sql/table.hpp"

/// What a store is made of, the same in both databases. docs/reference/store.md says it for people.
namespace lapwing::map::schema {

/// Of the tables below. Whoever changes them writes the step from the version before (`migrate.cpp`).
inline constexpr int version = 3;

/// The features of a layer: its columns are those that all have, and the layer's properties.
[[nodiscard]] sql::Table const& layer_table(LayerKind layer);

namespace table {
extern sql::Table const about;     ///< what is known of the store itself: its version
extern sql::Table const revision;  ///< one row: how many batches have been written
extern sql::Table const sites;
extern sql::Table const floors;
extern sql::Table const removed;  ///< when features were taken away
extern sql::Table const grids;
extern sql::Table const grid_tiles;
extern sql::Table const blobs;  ///< pictures by their hash; the bytes lie in files, or in `blob_bytes`
extern sql::Table const blob_bytes;
extern sql::Table const sessions;
extern sql::Table const shown_chunks;  ///< what viewers were shown
extern sql::Table const tile_shades;   ///< how tiles of grids looked then
}  // namespace table

/// In an order in which they can be made, and filled: owners first.
[[nodiscard]] std::vector<sql::Table const*> const& all_tables();

}  // namespace lapwing::map::schema
