#include "map/store/rows/feature_rows.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/assert.hpp"
#include "map/features/properties.hpp"
#include "map/store/rows/shapes.hpp"
#include "map/store/schema/geopackage.hpp"
#include "map/store/schema/tables.hpp"
#include "map/store/sql/wkb.hpp"

namespace lapwing::map::rows {

namespace {

using nlohmann::json;
using sql::Row;
using sql::Value;

/// The columns that all layers have, in their order (`schema/tables.cpp`): what comes behind them are properties.
enum Common : std::size_t { geom, id, site, floor, writer, at, at_ns, held_over, revision_column, common_columns };

void add_time(Row& row, base::UtcTime time) {
  row.emplace_back(time);
  row.emplace_back(sql::nanoseconds(time));
}

/// The exact one where both are of the same millisecond: whoever edits the file sets the one that is for people.
std::optional<base::UtcTime> time_of(Value const& for_people, Value const& exact_ns) {
  using namespace std::chrono_literals;
  auto const shown = sql::as_time(for_people);
  auto const exact = sql::as_integer(exact_ns);
  if (!shown || !exact) return shown;
  auto const time = sql::time_of_nanoseconds(*exact);
  return std::chrono::abs(time - *shown) < 1ms ? time : *shown;
}

Value value_of(PropertyValue const& property) {
  return std::visit([](auto const& value) { return Value(value); }, property);
}

PropertyValue property_of(PropertyKind kind, Value const& value) {
  auto const given = [](auto const& found) { return found ? PropertyValue(*found) : PropertyValue(); };
  if (sql::is_null(value)) return {};
  switch (kind) {
    case PropertyKind::boolean: return given(sql::as_bool(value));
    case PropertyKind::integer: return given(sql::as_integer(value));
    case PropertyKind::real: return given(sql::as_real(value));
    case PropertyKind::text: return sql::as_text(value);
    case PropertyKind::time: return given(sql::as_time(value));
  }
  std::unreachable();
}

Value held_over_text(std::vector<HeldOver> const& held) {
  if (held.empty()) return {};
  auto list = json::array();
  for (auto const& one : held) list.push_back({one.property, one.account.writer, sql::nanoseconds(one.account.at)});
  return list.dump();
}

std::optional<std::vector<HeldOver>> held_over_of(Value const& value) {
  std::vector<HeldOver> held;
  auto const text = sql::as_text(value);
  if (text.empty()) return held;
  auto const list = json::parse(text, nullptr, false);
  if (!list.is_array()) return std::nullopt;
  for (auto const& one : list) {
    bool const is_sound =
        one.is_array() && one.size() == 3 && one[0].is_string() && one[1].is_string() && one[2].is_number_integer();
    if (!is_sound) return std::nullopt;
    held.push_back({one[0], {one[1], sql::time_of_nanoseconds(one[2].get<std::int64_t>())}});
  }
  return held;
}

base::Result<> set_properties(Content& content, LayerKind layer, Row const& row) {
  std::size_t column = common_columns;
  for (auto const& property : properties_of(layer)) {
    auto value = property_of(property.kind, row[column]);
    if (property.kind == PropertyKind::time)
      if (auto const time = time_of(row[column], row[column + 1])) value = *time;
    column += property.kind == PropertyKind::time ? 2 : 1;
    if (std::holds_alternative<std::monostate>(value)) continue;
    if (auto const set = property.set(content, value); !set)
      return base::fail(set.error().kind, fmt::format("{} {}", property.name, set.error().message));
  }
  return {};
}

base::Result<Feature> read_feature(LayerKind layer, Row const& row, Sites const& sites) {
  using base::ErrorKind;
  auto const found = sites.find(sql::as_text(row[site]));
  if (found == sites.end())
    return base::fail(ErrorKind::io, fmt::format("its site \"{}\" is not there", sql::as_text(row[site])));
  auto const shape = sql::unwrap(sql::as_bytes(row[geom]));
  auto const geometry = shape ? sql::read_wkb(shape->wkb) : std::nullopt;
  if (!geometry) return base::fail(ErrorKind::io, "its geometry is none");
  auto content = content_at(layer, on_site(*geometry, found->second));
  if (!content) return std::unexpected(content.error());
  if (auto set = set_properties(*content, layer, row); !set) return std::unexpected(set.error());
  auto const time = time_of(row[at], row[at_ns]);
  auto held = held_over_of(row[held_over]);
  if (!time || !held) return base::fail(ErrorKind::io, "its account is none");
  Feature feature{.id = sql::as_text(row[id]),
                  .site = sql::as_text(row[site]),
                  .floor = sql::as_text(row[floor]),
                  .account = {sql::as_text(row[writer]), *time},
                  .content = std::move(*content),
                  .held_over = std::move(*held)};
  if (auto const fault = feature_fault(feature)) return base::fail(ErrorKind::io, *fault);
  return feature;
}

/// "SELECT geom, id, ... FROM slots"
std::string select(LayerKind layer) {
  return fmt::format("SELECT {} FROM {}", sql::comma_separated(feature_columns(layer)), name_of(layer));
}

base::Result<> write_layer(sql::Database& database, LayerKind layer, std::vector<Row> const& rows) {
  if (rows.empty()) return {};
  auto const& table = schema::layer_table(layer);
  if (auto put = database.put(table, feature_columns(layer), rows); !put) return put;
  if (database.dialect() != sql::Dialect::geopackage) return {};
  auto const touched = database.change(schema::touch_statement(), {table.name});
  return touched ? base::Result<>() : std::unexpected(touched.error());
}

/// Features that are not there any more, and what is remembered of those that were taken away.
base::Result<> write_removals(sql::Database& database, std::vector<FeatureRecord> const& records, Revision revision) {
  std::map<std::string, std::vector<Row>> gone;  // by layer
  std::vector<Row> remembered, forgotten;
  for (auto const& record : records) {
    auto const& feature = record.feature;
    auto const layer = std::string(name_of(layer_of(feature.content)));
    if (record.is_removed) gone[layer].push_back({feature.id});
    if (!record.removal) {
      forgotten.push_back({layer, feature.id});
      continue;
    }
    remembered.push_back({layer, feature.id, feature.site, feature.floor, record.removal->writer,
                          sql::nanoseconds(record.removal->at), static_cast<std::int64_t>(revision)});
  }
  for (auto const& [layer, ids] : gone)
    if (auto deleted = database.change_each(fmt::format("DELETE FROM {} WHERE id = $1", layer), ids); !deleted)
      return deleted;
  // Mostly nothing was ever taken away, and asking once is less than asking for each.
  auto const any = sql::value_of(database, "SELECT EXISTS (SELECT 1 FROM removed)");
  if (!any) return std::unexpected(any.error());
  if (sql::as_bool(*any).value_or(true))
    if (auto done = database.change_each("DELETE FROM removed WHERE layer = $1 AND id = $2", forgotten); !done)
      return done;
  return database.put(schema::table::removed, {"layer", "id", "site", "floor", "writer", "at_ns", "revision"},
                      remembered);
}

}  // namespace

std::vector<std::string> feature_columns(LayerKind layer) {
  std::vector<std::string> names;
  for (auto const& column : schema::layer_table(layer).columns)
    if (column.kind != sql::ColumnKind::key) names.push_back(column.name);
  return names;
}

Row row_of(Feature const& feature, geo::Site const& place, Revision revision) {
  auto const layer = layer_of(feature.content);
  Row row = {sql::shape_of(on_globe(geometry_of(feature.content), place)), feature.id, feature.site, feature.floor,
             feature.account.writer};
  add_time(row, feature.account.at);
  row.push_back(held_over_text(feature.held_over));
  row.emplace_back(static_cast<std::int64_t>(revision));
  for (auto const& property : properties_of(layer)) {
    auto const value = property.get(feature.content);
    if (property.kind != PropertyKind::time) {
      row.push_back(value_of(value));
    } else if (auto const* time = std::get_if<base::UtcTime>(&value)) {
      add_time(row, *time);
    } else {
      row.insert(row.end(), 2, Value());
    }
  }
  return row;
}

base::Result<Feature> feature_of(LayerKind layer, Row const& row, Sites const& sites) {
  auto feature = read_feature(layer, row, sites);
  if (!feature)
    return base::fail(feature.error().kind, fmt::format("{} \"{}\" in the store: {}", name_of(layer),
                                                        sql::as_text(row[id]), feature.error().message));
  return feature;
}

base::Result<> write_features(sql::Database& database, std::vector<FeatureRecord> const& records, Sites const& sites,
                              Revision revision) {
  if (auto done = write_removals(database, records, revision); !done) return done;
  std::map<LayerKind, std::vector<Row>> by_layer;
  for (auto const& record : records) {
    if (record.is_removed) continue;
    auto const place = sites.find(record.feature.site);
    LAPWING_ASSERT(place != sites.end());  // the live map takes none without
    by_layer[layer_of(record.feature.content)].push_back(row_of(record.feature, place->second, revision));
  }
  for (auto const& [layer, rows] : by_layer)
    if (auto written = write_layer(database, layer, rows); !written) return written;
  return {};
}

base::Result<std::vector<Feature>> features_within(sql::Database& database, LayerKind layer, Sites const& sites,
                                                   LonLatBox const& box, std::size_t most) {
  std::vector<Feature> features;
  auto const statement =
      fmt::format("{} WHERE {} LIMIT $5", select(layer), sql::in_box(database.dialect(), schema::layer_table(layer)));
  Row const values = {box.least_lon_deg, box.most_lon_deg, box.least_lat_deg, box.most_lat_deg,
                      static_cast<std::int64_t>(most)};
  auto const read = database.query(statement, values, [&](Row const& row) -> base::Result<> {
    auto feature = feature_of(layer, row, sites);
    if (!feature) return std::unexpected(feature.error());
    features.push_back(std::move(*feature));
    return {};
  });
  if (!read) return std::unexpected(read.error());
  return features;
}

base::Result<FeaturePage> read_page(sql::Database& database, LayerKind layer, Sites const& sites,
                                    std::int64_t behind_fid, std::size_t most) {
  FeaturePage page;
  auto const statement = fmt::format("SELECT {}, fid FROM {} WHERE fid > $1 ORDER BY fid LIMIT $2",
                                     sql::comma_separated(feature_columns(layer)), name_of(layer));
  std::size_t rows = 0;
  auto const read =
      database.query(statement, {behind_fid, static_cast<std::int64_t>(most)}, [&](Row const& row) -> base::Result<> {
        ++rows;
        page.last_fid = sql::as_integer(row.back()).value_or(0);
        auto feature = feature_of(layer, row, sites);
        if (feature) {
          page.features.push_back(std::move(*feature));
        } else {
          page.faults.push_back(feature.error().message);
        }
        return {};
      });
  if (!read) return std::unexpected(read.error());
  page.is_last = rows < most;
  return page;
}

base::Result<std::vector<Removal>> removals_since(sql::Database& database, Revision since) {
  std::vector<Removal> all;
  auto const read = database.query("SELECT layer, id, site, floor, writer, at_ns FROM removed WHERE revision > $1",
                                   {static_cast<std::int64_t>(since)}, [&](Row const& row) -> base::Result<> {
                                     auto const layer = layer_named(sql::as_text(row[0]));
                                     auto const time = sql::as_integer(row[5]);
                                     if (layer && time)
                                       all.push_back({*layer,
                                                      sql::as_text(row[1]),
                                                      sql::as_text(row[2]),
                                                      sql::as_text(row[3]),
                                                      {sql::as_text(row[4]), sql::time_of_nanoseconds(*time)}});
                                     return {};
                                   });
  if (!read) return std::unexpected(read.error());
  return all;
}

base::Result<Changes> changes_since(sql::Database& database, Sites const& sites, Revision since) {
  Changes changes;
  for (auto const layer : all_layers) {
    auto const read = database.query(fmt::format("{} WHERE revision > $1", select(layer)),
                                     {static_cast<std::int64_t>(since)}, [&](Row const& row) -> base::Result<> {
                                       auto feature = feature_of(layer, row, sites);
                                       if (feature) {
                                         changes.features.push_back(std::move(*feature));
                                       } else {
                                         changes.faults.push_back(feature.error().message);
                                       }
                                       return {};
                                     });
    if (!read) return std::unexpected(read.error());
  }
  auto removals = removals_since(database, since);
  if (!removals) return std::unexpected(removals.error());
  changes.removals = std::move(*removals);
  return changes;
}

}  // namespace lapwing::map::rows
