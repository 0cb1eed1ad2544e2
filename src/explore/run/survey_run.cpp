#include "explore/run/survey_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "explore/lot/belief.hpp"

namespace lapwing::explore {

namespace {

constexpr double step_s = 0.1;
constexpr double plan_every_s = 1.0;
constexpr base::UtcTime begin_of_run = base::UtcTime(std::chrono::sys_days(std::chrono::year(2026) / 1 / 1));

base::UtcTime time_at(double seconds) {
  return begin_of_run + std::chrono::duration_cast<base::UtcTime::duration>(std::chrono::duration<double>(seconds));
}

/// A point with inertia that turns as it flies.
class FlyingCamera {
 public:
  FlyingCamera(AirPlace place, double yaw_rad, SurveySettings const& settings)
      : place_(std::move(place)), yaw_rad_(yaw_rad), settings_(settings) {}

  [[nodiscard]] AirPlace const& place() const { return place_; }
  [[nodiscard]] double yaw_rad() const { return yaw_rad_; }
  [[nodiscard]] double flown_m() const { return flown_m_; }
  [[nodiscard]] bool is_at(AirPlace const& goal, double yaw_rad) const {
    constexpr double slow_m_s = 0.5;
    constexpr double turned_rad = 0.05;
    return geo::distance_m(place_, goal) <= settings_.arrived_m && velocity_.norm() < slow_m_s &&
           std::abs(geo::wrap_pi(yaw_rad - yaw_rad_)) < turned_rad;
  }
  [[nodiscard]] geo::GroundView view() const {
    return {.lens = settings_.camera,
            .site_from_camera = geo::camera_at(place_, yaw_rad_, settings_.tilt_rad),
            .ground_up_m = settings_.ground_up_m};
  }

  void fly(AirPlace const& goal, double yaw_rad) {
    auto const& limits = settings_.flight;
    Eigen::Vector2d const way = goal.v.head<2>() - place_.v.head<2>();
    double const far_m = way.norm();
    // As fast as it can still stop, a little later than now.
    double const speed = std::min(limits.speed_m_s, std::sqrt(2.0 * 0.8 * limits.acceleration_m_s2 * far_m));
    Eigen::Vector2d const wanted =
        far_m > 1e-9 ? Eigen::Vector2d(way / far_m * std::min(speed, far_m / step_s)) : Eigen::Vector2d::Zero();
    Eigen::Vector2d const change = wanted - velocity_;
    double const most = limits.acceleration_m_s2 * step_s;
    velocity_ += change.norm() > most ? Eigen::Vector2d(change.normalized() * most) : change;
    double const up = std::clamp(goal.z() - place_.z(), -limits.sink_m_s * step_s, limits.climb_m_s * step_s);
    place_ = AirPlace(place_.x() + velocity_.x() * step_s, place_.y() + velocity_.y() * step_s, place_.z() + up);
    flown_m_ += velocity_.norm() * step_s;
    double const turn =
        std::clamp(geo::wrap_pi(yaw_rad - yaw_rad_), -limits.turn_rad_s * step_s, limits.turn_rad_s * step_s);
    yaw_rad_ = geo::wrap_pi(yaw_rad_ + turn);
  }

 private:
  AirPlace place_;
  double yaw_rad_;
  SurveySettings settings_;
  Eigen::Vector2d velocity_ = Eigen::Vector2d::Zero();
  double flown_m_ = 0.0;
};

/// What the map says beside what is so.
class Judge {
 public:
  explicit Judge(CarPark const& park) : park_(park) {}

  /// The map's slot that is this one; null when there is none.
  [[nodiscard]] static KnownSlot const* slot_near(LotMap const& lot, CarPark::TrueSlot const& slot) {
    constexpr double same_m = 1.0;
    auto const middle = middle_of(slot.outline);
    for (auto const& known : lot.slots().slots())
      if (known.is_confirmed && geo::distance_m(middle_of(known.outline), middle) < same_m) return &known;
    return nullptr;
  }

  /// Share of what there is to know: of each slot whether it is taken, of each slot's size of ground whether it is for
  /// parking. As of the last looks.
  [[nodiscard]] double information(LotMap const& lot) const {
    auto const& cells = lot.cells();
    auto const& grid = cells.grid();
    double const share = lot.settings().cell_m * lot.settings().cell_m / slot_ground_m2;
    double unknown = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      auto const& cell = grid.at_index(i);
      if (!cell.is_wanted) continue;
      all += share;
      unknown += share * (cell.is_seen ? entropy_bits(cells.parking_chance(cell, cells.seen_at(cell))) : 1.0);
    }
    for (auto const& slot : park_.slots()) {
      all += 1.0;
      auto const* known = slot_near(lot, slot);
      auto const* newest = known ? known->looks.newest() : nullptr;
      unknown += newest ? entropy_bits(lot.slots().taken_chance(*known, newest->at)) : 1.0;
    }
    return 1.0 - unknown / all;
  }

  void conclude(LotMap const& lot, SurveyReport& report) const {
    std::size_t found = 0;
    std::size_t told = 0;
    std::size_t right = 0;
    double off2_m2 = 0.0;
    for (auto const& slot : park_.slots()) {
      auto const* known = slot_near(lot, slot);
      if (!known) continue;
      ++found;
      double const off_m = geo::distance_m(middle_of(known->outline), middle_of(slot.outline));
      off2_m2 += off_m * off_m;
      auto const* newest = known->looks.newest();
      if (!newest) continue;
      ++told;
      if ((lot.slots().taken_chance(*known, newest->at) > 0.5) == slot.is_taken) ++right;
    }
    auto const confirmed = std::ranges::count_if(lot.slots().slots(), &KnownSlot::is_confirmed);
    report.wrong_slots =
        static_cast<std::size_t>(confirmed) - std::min<std::size_t>(found, static_cast<std::size_t>(confirmed));
    report.off_m = found == 0 ? 0.0 : std::sqrt(off2_m2 / static_cast<double>(found));
    report.slots_found = static_cast<double>(found) / static_cast<double>(park_.slots().size());
    report.occupancy_right = told == 0 ? 0.0 : static_cast<double>(right) / static_cast<double>(told);
    report.coverage = lot.coverage();
    report.information = information(lot);
  }

 private:
  CarPark const& park_;
};

/// The loop that both share: fly to goals, take pictures, map them.
class Flight {
 public:
  Flight(CarPark const& park, SurveyRunSettings const& settings, LotMap lot, double height_m)
      : park_(park),
        settings_(settings),
        judge_(park),
        lot_(std::move(lot)),
        camera_({park.home().x(), park.home().y(), settings.survey.ground_up_m + height_m}, 0.0, settings.survey) {}

  /// `goal`: nothing ends it.
  template <class NextGoal>
  SurveyReport fly(NextGoal&& next) {
    std::optional<SurveyGoal> goal;
    double plan_at_s = 0.0;
    double picture_at_s = 0.0;
    int const most_steps = static_cast<int>(settings_.most_s / step_s);
    int steps = 0;
    for (; steps < most_steps; ++steps) {
      double const now_s = steps * step_s;
      if (now_s >= picture_at_s) {
        take_picture(now_s);
        picture_at_s = now_s + settings_.picture_s;
      }
      bool const is_there = goal && camera_.is_at(goal->place, goal->yaw_rad);
      if (!goal || is_there || now_s >= plan_at_s) {
        goal = next(lot_, camera_, goal, is_there, now_s);
        plan_at_s = now_s + plan_every_s;
        if (!goal) break;
      }
      camera_.fly(goal->place, goal->yaw_rad);
    }
    report_.took_s = steps * step_s;
    report_.flown_m = camera_.flown_m();
    judge_.conclude(lot_, report_);
    return std::move(report_);
  }

 private:
  void take_picture(double now_s) {
    (void)lot_.add(park_.look(camera_.view(), time_at(now_s), now_s));
    if (settings_.keeps_track) report_.track.push_back(camera_.place());
    constexpr double nine_tenths = 0.9;
    if (!report_.to_90_s && judge_.information(lot_) >= nine_tenths) report_.to_90_s = now_s;
  }

  CarPark const& park_;
  SurveyRunSettings settings_;
  Judge judge_;
  LotMap lot_;
  FlyingCamera camera_;
  SurveyReport report_;
};

/// Both ends of each leg, every second one the other way round.
std::vector<map::SitePoint> legs_of(geo::Polygon<geo::SiteFrame> const& area, double axis_rad, double spacing_m,
                                    double end_m) {
  Eigen::Vector2d const along(std::cos(axis_rad), std::sin(axis_rad));
  Eigen::Vector2d const across(-along.y(), along.x());
  double low = 1e18;
  double high = -1e18;
  for (auto const& corner : area.rings.front()) {
    low = std::min(low, across.dot(corner.v));
    high = std::max(high, across.dot(corner.v));
  }
  auto const count = static_cast<int>(std::max(1.0, std::ceil((high - low) / spacing_m - 1e-9)));
  std::vector<map::SitePoint> places;
  for (int leg = 0; leg < count; ++leg) {
    double const v = low + (leg + 0.5) * (high - low) / count;
    double from = 1e18;
    double to = -1e18;
    geo::detail::for_each_edge(area.rings.front(), [&](auto const& a, auto const& b) {
      double const va = across.dot(a.v);
      double const vb = across.dot(b.v);
      // Of the strip, not of its middle line alone.
      double const reach = 0.5 * spacing_m;
      for (double const w : {v - reach, v, v + reach}) {
        if ((va > w) == (vb > w)) continue;
        double const u = along.dot(a.v) + (w - va) / (vb - va) * along.dot(b.v - a.v);
        from = std::min(from, u);
        to = std::max(to, u);
      }
    });
    if (to < from) continue;
    double const in = std::min(end_m, 0.5 * (to - from));
    auto const at = [&](double u) { return map::SitePoint(Eigen::Vector2d(u * along + v * across)); };
    auto const first = at(from + in);
    auto const last = at(to - in);
    places.push_back(leg % 2 == 0 ? first : last);
    places.push_back(leg % 2 == 0 ? last : first);
  }
  return places;
}

}  // namespace

base::Result<SurveyReport> fly_survey(CarPark const& park, SurveyRunSettings const& settings) {
  auto lot = LotMap::make(park.area(), settings.lot);
  if (!lot) return std::unexpected(lot.error());
  auto const planner = SurveyPlanner::make(park.fence(), settings.survey, settings.lot);
  if (!planner) return std::unexpected(planner.error());
  std::string_view ending = "most time";
  Flight flight(park, settings, std::move(*lot), settings.survey.desired_m);
  auto report = flight.fly([&](LotMap const& known, FlyingCamera const& camera, std::optional<SurveyGoal> const& goal,
                               bool is_there, double now_s) -> std::optional<SurveyGoal> {
    SurveyBudget const budget{.home = park.home(), .flying_s = settings.flying_s - now_s};
    auto const step = planner->next(known, {camera.place(), camera.yaw_rad()}, budget, is_there ? std::nullopt : goal,
                                    {}, time_at(now_s));
    if (auto const* end = std::get_if<SurveyEnd>(&step)) {
      ending = to_string(end->reason);
      return std::nullopt;
    }
    if (auto const* to = std::get_if<SurveyGoal>(&step)) return *to;
    return SurveyGoal{.place = camera.place(), .yaw_rad = camera.yaw_rad()};
  });
  report.ending = ending;
  return report;
}

base::Result<SurveyReport> fly_lawn_mower(CarPark const& park, SurveyRunSettings const& settings,
                                          LawnMower const& mower) {
  auto lot = LotMap::make(park.area(), settings.lot);
  if (!lot) return std::unexpected(lot.error());
  double const axis_rad = narrowest_axis(park.area());
  geo::GroundView const view{.lens = settings.survey.camera,
                             .site_from_camera = geo::camera_at({0.0, 0.0, mower.height_m}, 0.0, 0.0)};
  auto const corners = geo::footprint_corners(view);
  if (!corners) return base::fail(base::ErrorKind::invalid_input, "the camera sees the horizon");
  auto const [high_m, wide_m] = sides_of(*corners);
  auto const legs = legs_of(park.area(), axis_rad, wide_m * (1.0 - mower.sidelap), 0.5 * high_m - settings.lot.edge_m);
  auto const fence = FenceRoutes::make(park.fence(), settings.survey.fence_margin_m);
  if (!fence) return std::unexpected(fence.error());
  std::size_t leg = 0;
  std::vector<map::SitePoint> route;
  Flight flight(park, settings, std::move(*lot), mower.height_m);
  double const up_m = settings.survey.ground_up_m + mower.height_m;
  auto report = flight.fly([&](LotMap const&, FlyingCamera const& camera, std::optional<SurveyGoal> const& goal,
                               bool is_there, double) -> std::optional<SurveyGoal> {
    if (goal && !is_there) return goal;
    map::SitePoint const below(camera.place().x(), camera.place().y());
    while (route.empty()) {
      if (leg == legs.size()) return std::nullopt;
      route = fence->route(below, legs[leg++]);
    }
    auto const to = route.front();
    route.erase(route.begin());
    return SurveyGoal{.place = {to.x(), to.y(), up_m}, .yaw_rad = axis_rad};
  });
  report.ending = "legs flown";
  return report;
}

}  // namespace lapwing::explore
