#include <set>

#include <fmt/format.h>

#include "map/store/care/care.hpp"
#include "map/store/reader.hpp"
#include "map/store/rows/feature_rows.hpp"
#include "map/store/rows/grid_rows.hpp"
#include "map/store/rows/shade_rows.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/rows/site_rows.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/schema/tables.hpp"

namespace lapwing::map::care {

namespace {

/// Goes through a store and notes what is wrong; an error is only what keeps it from looking at all.
class Inspection {
 public:
  explicit Inspection(Reader& reader) : database_(*reader.database), bytes_(*reader.bytes) {}

  base::Result<Verdict> all() {
    if (database_.dialect() == sql::Dialect::geopackage) {
      for (auto const check : {&Inspection::file, &Inspection::indices})
        if (auto looked = (this->*check)(); !looked) return std::unexpected(looked.error());
    }
    for (auto const check :
         {&Inspection::features, &Inspection::tiles, &Inspection::past, &Inspection::shades, &Inspection::pictures})
      if (auto looked = (this->*check)(); !looked) return std::unexpected(looked.error());
    return std::move(verdict_);
  }

 private:
  void fault(std::string text) { verdict_.faults.push_back(std::move(text)); }

  base::Result<> file() {
    auto looked = database_.query("PRAGMA integrity_check", {}, [&](sql::Row const& row) -> base::Result<> {
      if (auto text = sql::as_text(row[0]); text != "ok") fault("the database: " + std::move(text));
      return {};
    });
    if (!looked) return looked;
    return database_.query("PRAGMA foreign_key_check", {}, [&](sql::Row const& row) -> base::Result<> {
      fault(fmt::format("a row of {} belongs to one of {} that is not there", sql::as_text(row[0]),
                        sql::as_text(row[2])));
      return {};
    });
  }

  /// The R-trees: sound, with each feature in them, in a box round it.
  base::Result<> indices() {
    for (auto const layer : all_layers) {
      auto const name = name_of(layer);
      auto const state = sql::value_of(database_, fmt::format("SELECT rtreecheck('rtree_{}_geom')", name));
      if (!state) return std::unexpected(state.error());
      if (sql::as_text(*state) != "ok") fault(fmt::format("the index of {}: {}", name, sql::as_text(*state)));
      auto const wrong = sql::value_of(
          database_,
          fmt::format(
              "SELECT count(*) FROM {0} LEFT JOIN rtree_{0}_geom box ON box.id = fid WHERE box.id IS NULL OR minx > "
              "ST_MinX(geom) OR maxx < ST_MaxX(geom) OR miny > ST_MinY(geom) OR maxy < ST_MaxY(geom)",
              name));
      if (!wrong) return std::unexpected(wrong.error());
      if (auto const count = sql::as_integer(*wrong).value_or(0); count != 0)
        fault(fmt::format("{} of {} are not where the index has them", count, name));
      auto const surplus = sql::value_of(
          database_, fmt::format("SELECT count(*) FROM rtree_{0}_geom WHERE id NOT IN (SELECT fid FROM {0})", name));
      if (!surplus) return std::unexpected(surplus.error());
      if (auto const count = sql::as_integer(*surplus).value_or(0); count != 0)
        fault(fmt::format("the index of {} has {} that are not there", name, count));
    }
    return {};
  }

  base::Result<> features() {
    auto const sites = rows::read_sites(database_);
    if (!sites) {
      fault(sites.error().message);
      return {};
    }
    constexpr std::size_t page_size = 2000;
    for (auto const layer : all_layers) {
      std::int64_t last = 0;
      for (bool is_last = false; !is_last;) {
        auto page = rows::read_page(database_, layer, *sites, last, page_size);
        if (!page) return std::unexpected(page.error());
        verdict_.looked_at += page->features.size() + page->faults.size();
        for (auto& wrong : page->faults) fault(std::move(wrong));
        is_last = page->is_last;
        last = page->last_fid;
      }
    }
    return {};
  }

  base::Result<> tiles() {
    return database_.query("SELECT site, floor, name, x, y, cells FROM grid_tiles WHERE cells IS NOT NULL", {},
                           [&](sql::Row const& row) -> base::Result<> {
                             ++verdict_.looked_at;
                             if (!rows::unpacked(sql::as_bytes(row[5])))
                               fault(fmt::format("the cells of tile ({}, {}) of grid \"{}\" cannot be read",
                                                 sql::as_integer(row[3]).value_or(0),
                                                 sql::as_integer(row[4]).value_or(0), sql::as_text(row[2])));
                             return {};
                           });
  }

  base::Result<> past() {
    auto const heads = sql::rows_of(database_, "SELECT session, feed, number, frames FROM shown_chunks");
    if (!heads) return std::unexpected(heads.error());
    for (auto const& head : *heads) {
      ++verdict_.looked_at;
      auto const content =
          sql::value_of(database_, "SELECT content FROM shown_chunks WHERE session = $1 AND feed = $2 AND number = $3",
                        {head[0], head[1], head[2]});
      if (!content) return std::unexpected(content.error());
      if (sql::is_null(*content)) continue;  // it has gone in the meantime
      auto const frames = rows::unpacked(sql::as_bytes(*content), "", "");
      if (!frames || static_cast<std::int64_t>(frames->size()) != sql::as_integer(head[3]))
        fault(fmt::format("session \"{}\": a piece of what \"{}\" showed cannot be read", sql::as_text(head[0]),
                          sql::as_text(head[1])));
    }
    return {};
  }

  base::Result<> shades() {
    auto const names = sql::rows_of(database_, "SELECT name FROM tile_shades");
    if (!names) return std::unexpected(names.error());
    for (auto const& row : *names) {
      ++verdict_.looked_at;
      auto const name = sql::as_text(row[0]);
      auto const found = rows::read_shades(database_, {name});
      if (!found) {
        fault(found.error().message);
      } else if (auto const shades = found->find(name); shades == found->end()) {
        // It may have gone in the meantime, but not what it hangs on alone.
        auto const is_there = sql::rows_of(database_, "SELECT 1 FROM tile_shades WHERE name = $1", {name});
        if (!is_there) return std::unexpected(is_there.error());
        if (!is_there->empty())
          fault(fmt::format("the look of a grid's tile, \"{}\", hangs on one that is gone", name));
      } else if (past::name_of(*shades->second) != name) {
        fault(fmt::format("the look of a grid's tile, \"{}\", is not what its name says", name));
      }
    }
    return {};
  }

  base::Result<> pictures() {
    auto const told = sql::rows_of(database_, "SELECT hash FROM blobs");
    if (!told) return std::unexpected(told.error());
    std::set<std::string> known;
    for (auto const& row : *told) {
      ++verdict_.looked_at;
      auto const hash = sql::as_text(row[0]);
      known.insert(hash);
      auto const found = blobs::read(database_, bytes_, hash);
      if (!found && found.error().kind != base::ErrorKind::not_found) fault("pictures: " + found.error().message);
    }
    auto const present = bytes_.all_hashes();
    if (!present) return std::unexpected(present.error());
    for (auto const& hash : *present)
      if (!known.contains(hash)) ++verdict_.stray_pictures;
    return {};
  }

  sql::Database& database_;
  blobs::Bytes& bytes_;
  Verdict verdict_;
};

}  // namespace

base::Result<Verdict> verify(std::string const& address) {
  place::Address const place(address);
  auto const reader = Reader::open(place);
  if (!reader) return std::unexpected(reader.error());
  if (auto checked = schema::check(*(*reader)->database, place.name()); !checked)
    return std::unexpected(checked.error());
  return Inspection(**reader).all();
}

}  // namespace lapwing::map::care
