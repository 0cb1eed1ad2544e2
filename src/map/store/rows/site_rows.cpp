#include "map/store/rows/site_rows.hpp"

#include <fmt/format.h>

#include "map/store/schema/tables.hpp"

namespace lapwing::map::rows {

namespace {

base::Result<std::vector<geo::Floor>> floors_of(sql::Database& database, std::string const& site) {
  auto const rows = sql::rows_of(
      database, "SELECT id, name, up_m, plan_x_m, plan_y_m, plan_yaw_rad FROM floors WHERE site = $1", {site});
  if (!rows) return std::unexpected(rows.error());
  std::vector<geo::Floor> floors;
  for (auto const& row : *rows) {
    auto const real = [&](std::size_t i) { return sql::as_real(row[i]).value_or(0.0); };
    floors.push_back({.id = sql::as_text(row[0]),
                      .name = sql::as_text(row[1]),
                      .up_m = real(2),
                      .site_from_floor = {geo::Point<geo::SiteFrame>(real(3), real(4)), real(5)}});
  }
  return floors;
}

}  // namespace

base::Result<> write_site(sql::Database& database, geo::Site const& site, Revision revision) {
  auto const anchor = site.anchor();
  auto const put = database.put(
      schema::table::sites, {"id", "latitude_deg", "longitude_deg", "altitude_m", "revision"},
      {{site.id(), anchor.lat_deg(), anchor.lon_deg(), anchor.alt_m, static_cast<std::int64_t>(revision)}});
  if (!put) return put;
  auto const gone = database.change("DELETE FROM floors WHERE site = $1", {site.id()});
  if (!gone) return std::unexpected(gone.error());
  std::vector<sql::Row> floors;
  for (auto const& floor : site.floors()) {
    auto const origin = floor.site_from_floor.origin();
    floors.push_back(
        {site.id(), floor.id, floor.name, floor.up_m, origin.x(), origin.y(), floor.site_from_floor.yaw_rad()});
  }
  return database.put(schema::table::floors, {"site", "id", "name", "up_m", "plan_x_m", "plan_y_m", "plan_yaw_rad"},
                      floors);
}

base::Result<Sites> read_sites(sql::Database& database, Revision since) {
  auto const rows =
      sql::rows_of(database, "SELECT id, latitude_deg, longitude_deg, altitude_m FROM sites WHERE revision > $1",
                   {static_cast<std::int64_t>(since)});
  if (!rows) return std::unexpected(rows.error());
  Sites sites;
  for (auto const& row : *rows) {
    auto const id = sql::as_text(row[0]);
    auto floors = floors_of(database, id);
    if (!floors) return std::unexpected(floors.error());
    auto const real = [&](std::size_t i) { return sql::as_real(row[i]).value_or(0.0); };
    auto site = geo::Site::make(id, geo::Wgs84::from_degrees(real(1), real(2), real(3)), std::move(*floors));
    if (!site)
      return base::fail(base::ErrorKind::io, fmt::format("site \"{}\" in the store: {}", id, site.error().message));
    sites.emplace(id, std::move(*site));
  }
  return sites;
}

}  // namespace lapwing::map::rows
