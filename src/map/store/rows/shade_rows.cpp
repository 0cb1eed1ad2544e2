#include "map/store/rows/shade_rows.hpp"

#include <utility>

#include <fmt/format.h>

#include "map/store/past/grid_list.hpp"
#include "map/store/rows/shown_rows.hpp"

namespace lapwing::map::rows {

namespace {

using sql::Row;

/// Far more than any has: what hangs on itself is a fault, and must not be read for ever.
constexpr int most_steps = 1000;

base::Error unreadable(std::string const& name) {
  return {base::ErrorKind::io, fmt::format("the look of a grid's tile in the store, \"{}\", cannot be read", name), ""};
}

/// Null: it is not there any more.
base::Result<std::shared_ptr<TileShades const>> read_one(sql::Database& database, std::string const& name) {
  std::vector<std::string> steps;
  std::string next = name;
  while (!next.empty()) {
    auto const found = sql::rows_of(database, "SELECT base, shades FROM tile_shades WHERE name = $1", {next});
    if (!found) return std::unexpected(found.error());
    if (found->empty()) return nullptr;
    if (steps.size() >= most_steps) return std::unexpected(unreadable(name));
    steps.push_back(sql::as_bytes(found->front()[1]));
    next = sql::as_text(found->front()[0]);
  }
  std::shared_ptr<TileShades const> shades;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    shades = past::unpacked(*step, shades.get());
    if (!shades) return std::unexpected(unreadable(name));
  }
  return shades;
}

}  // namespace

base::Result<> write_shades(sql::Database& database, std::vector<past::PackedShades> const& all, base::UtcTime now) {
  std::vector<Row> added, made_whole;
  std::vector<std::string> names;
  for (auto const& one : all) {
    added.push_back({one.name, one.base, sql::nanoseconds(now), sql::Bytes{one.bytes}});
    if (one.base.empty()) made_whole.push_back({one.name, sql::Bytes{one.bytes}});
    names.push_back(one.name);
  }
  auto done =
      database.change_each("UPDATE tile_shades SET base = '', shades = $2 WHERE name = $1 AND base <> ''", made_whole);
  if (done)
    done = database.change_each(
        "INSERT INTO tile_shades (name, base, last_ns, shades) SELECT $1, $2, $3, $4 WHERE NOT EXISTS (SELECT 1 FROM "
        "tile_shades WHERE name = $1)",
        added);
  // One that was there already may be about to go, with what it hangs on.
  return done ? touch_shades(database, names, now) : done;
}

base::Result<> touch_shades(sql::Database& database, std::vector<std::string> const& names, base::UtcTime now) {
  std::vector<Row> rows;
  for (auto const& name : names) rows.push_back({name, sql::nanoseconds(now)});
  return database.change_each(
      "WITH RECURSIVE chain(name) AS (SELECT $1 UNION SELECT tile_shades.base FROM tile_shades JOIN chain ON "
      "tile_shades.name = chain.name WHERE tile_shades.base <> '') UPDATE tile_shades SET last_ns = $2 WHERE last_ns < "
      "$2 AND name IN (SELECT name FROM chain)",
      rows);
}

base::Result<PastShades> read_shades(sql::Database& database, std::vector<std::string> const& names) {
  PastShades all;
  for (auto const& name : names) {
    auto shades = read_one(database, name);
    if (!shades) return std::unexpected(shades.error());
    if (*shades) all.emplace(name, *std::move(shades));
  }
  return all;
}

base::Result<PastGrids> grids_at(sql::Database& database, std::string const& session, base::UtcTime at) {
  auto const frames = state_at(database, session, at, std::string(past::list_feed));
  if (!frames) return std::unexpected(frames.error());
  PastGrids grids;
  for (auto const& frame : *frames) {
    auto list = past::unpacked_list(frame.content);
    if (!list)
      return base::fail(base::ErrorKind::io,
                        fmt::format("session \"{}\" in the store: a list of grids cannot be read", session));
    past::apply(*std::move(list), grids);
  }
  return grids;
}

}  // namespace lapwing::map::rows
