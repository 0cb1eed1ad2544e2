#include "host/map/track_writer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "geo/position.hpp"

namespace lapwing::host {

using lapwing::map::LayerKind;

TrackWriter::TrackWriter(base::Loop& loop, vehicle::Registry const& vehicles, lapwing::map::LiveMap& map,
                         Options options)
    : loop_(loop), vehicles_(vehicles), map_(map), options_(options), work_(go_on()) {
  work_.start();
}

base::Task<> TrackWriter::go_on() {
  auto written = loop_.now();
  for (;;) {
    co_await loop_.sleep(options_.period);
    look();
    if (loop_.now() - written < options_.pause) continue;
    written = loop_.now();
    write();
  }
}

base::UtcTime TrackWriter::utc_of(base::TimePoint heard) const {
  return loop_.utc_now() - std::chrono::duration_cast<base::UtcTime::duration>(loop_.now() - heard);
}

geo::Site const* TrackWriter::site_near(geo::Wgs84 const& position, std::optional<geo::Wgs84> const& home) {
  geo::Site const* nearest = nullptr;
  double nearest_m = lapwing::map::farthest_m / 2.0;  // beyond that the plane of a site is no map for it
  for (auto const& [id, site] : map_.sites()) {
    double const far_m = geo::surface_distance_m(site.anchor(), position);
    if (far_m >= nearest_m) continue;
    nearest = &site;
    nearest_m = far_m;
  }
  if (nearest) return nearest;
  // Whoever flew elsewhere yesterday has that site in the store.
  std::string id = "default";
  for (int i = 2; map_.site(id); ++i) id = fmt::format("default {}", i);
  auto site = geo::Site::make(id, home.value_or(position));
  if (!site) return nullptr;
  map_.put_site(*std::move(site));
  return map_.site(id);
}

std::optional<TrackWriter::Spot> TrackWriter::spot_of(vehicle::VehicleState const& state) {
  auto const& motion = state.motion;
  if (motion.site_pose.known() && (!motion.position.known() || motion.site_pose.heard >= motion.position.heard)) {
    auto const& pose = *motion.site_pose.value;
    if (!map_.site(pose.site)) return std::nullopt;
    auto const& at = pose.position;
    return Spot{
        pose.site, pose.floor, {{at.x(), at.y()}, at.z(), utc_of(motion.site_pose.heard)}, motion.site_pose.heard};
  }
  if (!motion.position.known()) return std::nullopt;
  auto const& position = *motion.position.value;
  auto const* const site = site_near(position, motion.home.value);
  if (!site) return std::nullopt;
  auto const at = site->point_of(position);
  return Spot{site->id(), "", {{at.x(), at.y()}, at.z(), utc_of(motion.position.heard)}, motion.position.heard};
}

void TrackWriter::look() {
  for (auto const* state : vehicles_.all()) {
    auto const spot = spot_of(*state);
    if (!spot) continue;
    auto& trail = trails_[state->id];
    if (trail.heard == spot->heard && !trail.noted.empty()) continue;
    bool const is_elsewhere = trail.site != spot->site || trail.floor != spot->floor;
    if (trail.noted.empty() || is_elsewhere) {
      write();  // what was noted belongs to the leg before
      trail.noted.clear();
      begin_leg(state->id.text, trail, *spot);
      continue;
    }
    auto const& last = trail.noted.back();
    auto const& now = spot->sample;
    double const moved_m = std::hypot(geo::distance_m(last.position, now.position), now.up_m - last.up_m);
    if (now.at <= last.at || moved_m < options_.least_m) continue;
    trail.heard = spot->heard;
    trail.noted.push_back(now);
  }
}

void TrackWriter::begin_leg(std::string const& vehicle, Trail& trail, Spot const& spot) {
  trail.site = spot.site;
  trail.floor = spot.floor;
  trail.heard = spot.heard;
  trail.points = 1;
  trail.noted = {spot.sample};
  trail.legs.push_back(fmt::format("{} {}", vehicle, base::utc_text(spot.sample.at)));
}

void TrackWriter::write() {
  for (auto& [id, trail] : trails_) {
    if (trail.noted.size() < 2) continue;
    // What the map refuses, a place beyond its edge, is lost, and nothing else.
    (void)map_.put({.id = trail.legs.back(),
                    .site = trail.site,
                    .floor = trail.floor,
                    .account = {.writer = id.text, .at = trail.noted.back().at},
                    .content = lapwing::map::Track{.vehicle = id.text, .samples = trail.noted}});
    trail.points += trail.noted.size() - 1;
    trail.noted.erase(trail.noted.begin(), std::prev(trail.noted.end()));
    if (trail.points >= options_.points_a_leg) {
      trail.legs.push_back(fmt::format("{} {}", id.text, base::utc_text(trail.noted.back().at)));
      trail.points = 1;
    }
    for (; trail.legs.size() > options_.legs; trail.legs.erase(trail.legs.begin()))
      (void)map_.remove(LayerKind::tracks, trail.legs.front(), {.writer = id.text, .at = loop_.utc_now()});
  }
}

}  // namespace lapwing::host
