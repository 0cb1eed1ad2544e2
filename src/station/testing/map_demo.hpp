#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "station/http/router.hpp"

/// A map with little on it, and how a test asks a router about it.
namespace lapwing::station::testing {

inline geo::Wgs84 const yard_anchor = geo::Wgs84::from_degrees(47.0, 8.0, 400.0);

inline geo::Site yard(geo::Wgs84 anchor = yard_anchor) {
  return geo::Site::make("yard", anchor, {{.id = "0"}, {.id = "1", .name = "First floor", .up_m = 3.5}}).value();
}

/// A parking slot of 2 by 4 m whose lower left corner is there.
inline map::Feature slot(std::string id, double x_m, double y_m, base::UtcTime at,
                         map::SlotState state = map::SlotState::free) {
  map::SitePolygon outline{{{{x_m, y_m}, {x_m + 2.0, y_m}, {x_m + 2.0, y_m + 4.0}, {x_m, y_m + 4.0}}}};
  return {.id = std::move(id),
          .site = "yard",
          .account = {.writer = "drone 1", .at = at},
          .content = map::Slot{.outline = std::move(outline), .state = state, .seen_at = at, .seen_by = "1"}};
}

inline map::Feature door(std::string id, double x_m, double y_m, base::UtcTime at, std::string name = "221") {
  return {.id = std::move(id),
          .site = "yard",
          .floor = "1",
          .account = {.writer = "robot 1", .at = at},
          .content = map::PointOfInterest{.position = {x_m, y_m}, .kind = "door", .name = std::move(name)}};
}

/// A map on a loop of its own, with the yard.
struct MapDemo {
  MapDemo() { live.put_site(yard()); }

  [[nodiscard]] base::UtcTime now() const { return loop.utc_now(); }
  void put(map::Feature feature) {
    auto const done = live.put(std::move(feature));
    if (!done) throw std::runtime_error(done.error().message);
  }

  base::Loop loop;
  map::LiveMap live{[this] { return loop.utc_now(); }};
};

/// What a router answers, also where that takes its time.
inline HttpResponse ask(base::Loop& loop, Router const& router, std::string_view method, std::string_view target,
                        std::string body = {}, std::vector<HttpHeader> headers = {}) {
  auto request = request_for(method, target).value();
  request.body = std::move(body);
  request.headers = std::move(headers);
  request.headers.push_back({"Host", "station:8080"});
  auto reply = router.answer(request);
  if (auto* const response = std::get_if<HttpResponse>(&reply)) return std::move(*response);
  return loop.run_until_done(std::get<base::Task<HttpResponse>>(std::move(reply)));
}

inline std::string header(HttpResponse const& response, std::string_view name) {
  for (auto const& one : response.headers)
    if (one.name == name) return one.value;
  return "";
}

}  // namespace lapwing::station::testing
