#include "sim/safety/fence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/core.h>

namespace lapwing::sim {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration recovery_time = 10s;
constexpr base::Duration margin_text_period = 1s;  // FENCE_NTF_FREQ
constexpr std::array all_limits{FenceWatch::height, FenceWatch::circle, FenceWatch::areas, FenceWatch::floor};

}  // namespace

std::string fence_names(unsigned limits) {
  constexpr std::array<std::string_view, 4> names{"Max Alt", "Circle", "Polygon", "Min Alt"};
  std::string text;
  int count = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if ((limits >> i & 1U) == 0) continue;
    bool const is_last = limits >> (i + 1) == 0;
    if (count > 0) text += is_last ? " and " : ", ";
    text += names[i];
    ++count;
  }
  return text + (count > 1 ? " fences" : " fence");
}

FenceWatch::News FenceWatch::update(View const& view) {
  News news;
  if (!std::ranges::equal(view.plan, read_, same_item)) read(view.plan, view.site);
  if (!enabled(view.settings) || !view.position_ok) {
    breached_ = near_ = 0;
    return news;
  }
  watch_floor(view, news);
  auto now = crossed(view.body.position_m, view.home, view.settings, 0.0);
  if (!watches_floor_) now &= ~static_cast<unsigned>(floor);
  news.breached = (now & ~breached_) | farther_out(now, view);
  news.is_first = news.breached != 0 && breached_ == 0;
  news.is_over = now == 0 && breached_ != 0;
  if (news.is_first) breached_at_ = view.now;
  for (auto const limit : all_limits) count_ += (news.breached & limit) != 0 ? 1 : 0;
  breached_ = now;
  watch_margin(now, view, news);
  news.calls_for_action = news.breached != 0 && view.now >= recovers_until_;
  return news;
}

void FenceWatch::watch_floor(View const& view, News& news) {
  if ((view.settings.watched & floor) == 0) return;
  double const up_m = view.home.down - view.body.position_m.down;
  bool const begins = !watches_floor_ && up_m >= view.settings.lowest_m + view.settings.margin_m;
  if (view.body.on_ground && watches_floor_) {
    watches_floor_ = false;
    news.floor_on = false;
  } else if (begins && !view.body.on_ground) {
    watches_floor_ = true;
    news.floor_on = true;
  }
}

/// The circle and the greatest height are set up again beyond where the vehicle is when they are breached.
unsigned FenceWatch::farther_out(unsigned now, View const& view) {
  unsigned anew = 0;
  auto const look = [&](Limit limit, std::optional<double>& again_at_m) {
    if ((now & limit) == 0) return again_at_m.reset();
    double const depth_m = depth_of(limit, view.body.position_m, view.home, view.settings);
    if (again_at_m && depth_m < *again_at_m) return;
    if (again_at_m && view.settings.again_after_m > 0.0) anew |= limit;
    bool const is_height = limit == height;
    again_at_m = depth_m + (is_height ? std::min(20.0, view.settings.again_after_m) : view.settings.again_after_m);
  };
  look(height, again_at_height_m_);
  look(circle, again_at_circle_m_);
  return anew;
}

void FenceWatch::watch_margin(unsigned now, View const& view, News& news) {
  auto const& settings = view.settings;
  auto close = crossed(view.body.position_m, view.home, settings, settings.margin_m);
  if (!watches_floor_) close &= ~static_cast<unsigned>(floor);
  news.left_margin = settings.tells_margin ? near_ & ~close & ~now : 0U;
  bool const is_new = (close & ~near_ & ~now) != 0;
  near_ = close;
  close &= ~now;
  if (close == 0 || !settings.tells_margin) return;
  if (!is_new && told_near_ && view.now - *told_near_ < margin_text_period) return;
  told_near_ = view.now;
  news.near_m = std::abs(depth_m(close, view.body.position_m, view.home, settings));
}

void FenceWatch::begin_recovery(base::Duration now) {
  recovers_until_ = now + recovery_time;
}

bool FenceWatch::present(FenceSettings const& settings) const {
  auto const limits = settings.watched & ~(areas_.empty() ? static_cast<unsigned>(areas) : 0U);
  return limits != 0;
}

std::string FenceWatch::objection(FenceSettings const& settings) const {
  if (breached_ != 0) return "Vehicle breaching " + fence_names(breached_);
  if (!enabled(settings)) return {};
  if (settings.margin_m < 0.0) return "Invalid FENCE_MARGIN value";
  bool const has_heights = (settings.watched & (height | floor)) != 0 && settings.highest_m > 0.0;
  if (has_heights && settings.highest_m - settings.lowest_m <= 2.0 * settings.margin_m) return "FENCE_MARGIN too big";
  return {};
}

void FenceWatch::read(MissionPlan const& plan, Site const& site) {
  read_ = plan;
  areas_ = fence_areas(plan, site);
}

bool FenceWatch::allows(geo::Ned point, geo::Ned home, FenceSettings const& settings) const {
  return !enabled(settings) || (crossed(point, home, settings, 0.0) & ~static_cast<unsigned>(floor)) == 0;
}

double FenceWatch::depth_of(Limit limit, geo::Ned point, geo::Ned home, FenceSettings const& settings) const {
  double const up_m = home.down - point.down;
  if (limit == height) return up_m - settings.highest_m;
  if (limit == floor) return settings.lowest_m - up_m;
  if (limit == circle) return std::hypot(point.north - home.north, point.east - home.east) - settings.radius_m;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (auto const& area : areas_) nearest_m = std::min(nearest_m, distance_to_edge_m(area, point));
  return in_the_areas(point, settings.any_inclusion) ? -nearest_m : nearest_m;
}

double FenceWatch::depth_m(unsigned limits, geo::Ned point, geo::Ned home, FenceSettings const& settings) const {
  double deepest_m = -std::numeric_limits<double>::infinity();
  for (auto const limit : all_limits)
    if ((limits & limit) != 0) deepest_m = std::max(deepest_m, depth_of(limit, point, home, settings));
  return deepest_m;
}

unsigned FenceWatch::crossed(geo::Ned point, geo::Ned home, FenceSettings const& settings, double margin_m) const {
  auto const beyond = [&](Limit limit) { return depth_of(limit, point, home, settings) >= -margin_m; };
  unsigned found = 0;
  if (settings.highest_m > 0.0 && beyond(height)) found |= height;
  if (beyond(floor)) found |= floor;
  if (settings.radius_m > 0.0 && beyond(circle)) found |= circle;
  bool const outside = !in_the_areas(point, settings.any_inclusion);
  if (outside || (margin_m > 0.0 && !areas_.empty() && beyond(areas))) found |= areas;
  return found & settings.watched;
}

bool FenceWatch::in_the_areas(geo::Ned point, bool any_inclusion) const {
  int inclusions = 0;
  int inside = 0;
  for (auto const& area : areas_) {
    bool const holds = contains(area, point);
    if (!area.includes && holds) return false;
    inclusions += area.includes ? 1 : 0;
    inside += area.includes && holds ? 1 : 0;
  }
  return any_inclusion ? inclusions == 0 || inside > 0 : inside == inclusions;
}

}  // namespace lapwing::sim
