#include "perceive/surveyor.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "map/features/feature_json.hpp"

namespace lapwing::perceive {

using namespace std::chrono_literals;

namespace {

constexpr double round_m = 12.0;  ///< of a fence that nobody has named
constexpr base::Duration plan_period = 1s;
/// A process that was away for longer than that finds another survey.
constexpr base::Duration longest_away = 1min;
/// Sights farther apart are two visits: what lay between them does not count as looking.
constexpr base::Duration one_visit = 3s;
constexpr double most_percent = 100.0;

std::vector<map::SitePoint> places_to_fence(geo::Polygon<geo::SiteFrame> const& area, SurveyGround const& ground) {
  auto places = area.rings.front();
  places.emplace_back(ground.home.x(), ground.home.y());
  return places;
}

/// How far a survey is, for other programs.
map::Json json_of(SurveyFigures const& told) {
  using map::Json;
  return {{"coverage", told.coverage},
          {"begun", told.begun ? Json(base::utc_text(*told.begun)) : Json()},
          {"is_over", !told.ending.empty()},
          {"ending", told.ending.empty() ? Json() : Json(told.ending)},
          {"slots", told.slots},
          {"free", told.free},
          {"taken", told.taken},
          {"pictures", told.sights}};
}

}  // namespace

base::Result<Surveyor> Surveyor::make(SurveyOrder order, SurveyGround const& ground, HoverHeights const& heights) {
  auto site = geo::Site::make(order.name, ground.anchor);
  if (!site) return std::unexpected(site.error());
  auto lot = explore::LotMap::make(outline_of(order.area, *site), order.lot);
  if (!lot) return std::unexpected(lot.error());
  Surveyor surveyor(std::move(order), ground, heights, *std::move(site), *std::move(lot));
  auto planner = surveyor.make_planner();
  if (!planner) return std::unexpected(planner.error());
  surveyor.planner_ = *std::move(planner);
  return surveyor;
}

Surveyor::Surveyor(SurveyOrder order, SurveyGround const& ground, HoverHeights const& heights, geo::Site site,
                   explore::LotMap lot)
    : order_(std::move(order)), ground_(ground), site_(std::move(site)), lot_(std::move(lot)), heights_(heights) {}

base::Result<> Surveyor::adapt(geo::Point3<geo::SiteFrame> const& home, HoverHeights const& heights) {
  if (home == ground_.home && heights == heights_) return {};
  auto const before = std::pair(std::exchange(ground_.home, home), std::exchange(heights_, heights));
  auto planner = make_planner();
  if (!planner) {
    std::tie(ground_.home, heights_) = before;
    return std::unexpected(planner.error());
  }
  planner_ = *std::move(planner);
  goal_.reset();
  return {};
}

/// The planner counts heights from the ground of the car park, the operator from home.
base::Result<explore::SurveyPlanner> Surveyor::make_planner() const {
  auto fence = order_.fence.empty() ? fence_round(places_to_fence(lot_.area(), ground_), round_m)
                                    : outline_of(order_.fence, site_);
  auto settings = order_.planner;
  settings.ground_up_m = ground_.home.z() + order_.ground_m;
  // Who decides refuses what is beyond them by a rounded digit.
  constexpr double within_m = 0.02;
  settings.lowest_m = heights_.lowest_m + within_m - order_.ground_m;
  settings.desired_m = heights_.desired_m - order_.ground_m;
  settings.highest_m = heights_.highest_m - within_m - order_.ground_m;
  return explore::SurveyPlanner::make(std::move(fence), settings, order_.lot);
}

Conclusion Surveyor::think(News news) {
  Conclusion conclusion;
  if (news.sight) take(*news.sight);
  conclusion.sees_lot = sees_lot();
  if (news.wanted) conclusion.is_in_lot = planner_->is_in_bounds(lot_, *news.wanted, news.now);
  lead(news, conclusion);
  if (news.wants_map) conclusion.map = lot_.occupancy(news.now);
  conclusion.figures = figures();
  return conclusion;
}

/// The sights are added as they were when they came, so that the ground and the age of everything are the same again;
/// what they tell of slots was told better by all pictures together, and stays.
void Surveyor::recall(SurveyMemory memory, base::UtcTime now) {
  lives_ = memory.lives + 1;
  order_.lot.id_prefix = fmt::format("{}.{}", order_.lot.id_prefix, lives_);
  auto lot = explore::LotMap::make(lot_.area(), order_.lot);
  if (!lot) return;
  lot_ = *std::move(lot);
  for (auto& slot : memory.slots) know(std::move(slot));
  for (auto const& sight : memory.sights) {
    if (!lot_.add(sight)) continue;
    if (!sight.slots.empty()) found_at_ = sight.at;
    kept_.add(sight, true);
  }
  auto const& writer = memory.sights.empty() ? site_.id() : memory.sights.back().vehicle;
  auto news = lot_.take_news({.site = site_.id(), .writer = writer});
  for (auto& slot : news.slots) slots_.try_emplace(slot.id, std::move(slot));
  for (auto const& id : news.gone) slots_.erase(id);
  sights_ = memory.pictures;
  begun_ = memory.begun;
  ending_ = std::move(memory.ending);
  if (memory.explores && now - memory.at < longest_away) explores_since_ = begun_;
}

void Surveyor::know(map::Feature slot) {
  auto const& ring = std::get<map::Slot>(slot.content).outline.rings.front();
  explore::Corners outline;
  if (ring.size() != outline.size()) return;
  std::ranges::copy(ring, outline.begin());
  if (!geo::contains(lot_.area(), explore::middle_of(outline))) return;
  lot_.know(slot.id, outline);
  auto id = slot.id;
  slots_.insert_or_assign(std::move(id), std::move(slot));
}

std::string Surveyor::memory(base::UtcTime now, base::UtcTime since) {
  kept_.forget_before(since);
  SurveyMemory memory{.at = now,
                      .lives = lives_,
                      .begun = begun_,
                      .explores = explores_since_.has_value(),
                      .ending = ending_,
                      .pictures = sights_};
  for (auto const& [id, feature] : slots_) memory.slots.push_back(feature);
  return memory_text(memory, site_, kept_.lines());
}

void Surveyor::take(explore::LotSight const& sight) {
  auto const seen_before = lot_.cells().seen();
  if (!lot_.add(sight)) return;
  kept_.add(sight, lot_.cells().seen() > seen_before);
  ++sights_;
  if (!sight.slots.empty()) {
    found_at_ = sight.at;
    without_ = {};
  } else if (looked_at_ && sight.at > *looked_at_ && sight.at - *looked_at_ < one_visit) {
    without_ += sight.at - *looked_at_;
  }
  looked_at_ = sight.at;
  auto news = lot_.take_news({.site = site_.id(), .writer = sight.vehicle});
  for (auto& slot : news.slots) slots_.insert_or_assign(slot.id, std::move(slot));
  for (auto const& id : news.gone) slots_.erase(id);
}

std::optional<bool> Surveyor::sees_lot() const {
  if (without_ >= order_.lot_lost) return false;
  if (found_at_) return true;
  return std::nullopt;
}

double Surveyor::camera_yaw(video::BodyPlace const& drone) const {
  return geo::wrap_pi(drone.yaw_rad() + order_.camera_yaw_rad);
}

bool Surveyor::is_there(video::BodyPlace const& drone, double speed_m_s) const {
  constexpr double slow_m_s = 0.6;
  constexpr double turned_rad = 0.1;
  return goal_ && speed_m_s < slow_m_s && geo::distance_m(drone.origin(), goal_->place) <= order_.planner.arrived_m &&
         std::abs(geo::wrap_pi(goal_->yaw_rad - camera_yaw(drone))) < turned_rad;
}

explore::SurveyBudget Surveyor::budget(News const& news) const {
  return {.home = {ground_.home.x(), ground_.home.y()},
          .flying_s = news.flying_s,
          .time_s = order_.most_s - base::to_seconds(news.now - *explores_since_)};
}

explore::SurveyStep Surveyor::next_step(News const& news) const {
  explore::SurveyDrone const drone{news.drone->origin(), camera_yaw(*news.drone)};
  return planner_->next(lot_, drone, budget(news), goal_, {}, news.now);
}

std::string Surveyor::end(std::string_view reason) {
  goal_.reset();
  ending_ = reason;
  auto const told = figures();
  auto const begun =
      fmt::format("the survey is over: {}; {:.0f} % of the area seen, ", reason, most_percent * told.coverage);
  // An area without slots, most of which was seen, is a survey that went wrong.
  constexpr double most_of_it = 0.5;
  if (told.slots == 0 && told.coverage > most_of_it)
    return begun +
           "no slot found: fly higher, where a picture shows more of a row, or check the area and the camera's lens";
  return begun + fmt::format("{} slots on the map, {} free, {} taken", told.slots, told.free, told.taken);
}

void Surveyor::lead(News const& news, Conclusion& conclusion) {
  if (!news.explores) {
    explores_since_.reset();
    goal_.reset();
    return;
  }
  if (!explores_since_) {
    explores_since_ = begun_ = news.now;
    planned_at_ = {};
    ending_.clear();
    turned_home_.reset();
  }
  if (!news.drone) return;
  if (turned_home_) conclusion.goal = way_home(news);
  if (!ending_.empty()) return;
  bool const is_at_goal = is_there(*news.drone, news.speed_m_s);
  if (is_at_goal) goal_.reset();
  if (!goal_ || news.now - planned_at_ >= plan_period) {
    planned_at_ = news.now;
    if (lot_.coverage() >= order_.enough_coverage) {
      conclusion.report = end("as much is covered as was wanted");
      return;
    }
    auto const step = next_step(news);
    if (auto const* const over = std::get_if<explore::SurveyEnd>(&step)) {
      conclusion.report = end(to_string(over->reason));
      if (over->reason == explore::SurveyEnding::energy) turned_home_ = news.drone;
      return;
    }
    auto const* const to = std::get_if<explore::SurveyGoal>(&step);
    goal_ = to != nullptr ? std::optional(*to) : std::nullopt;
  }
  if (!goal_) return;
  conclusion.goal = goal_;
  conclusion.goal->yaw_rad = geo::wrap_pi(goal_->yaw_rad - order_.camera_yaw_rad);
}

/// As high and looking as where it turned. It waits there for who commands it, or for the battery to be as low as it
/// may be for landing.
explore::SurveyGoal Surveyor::way_home(News const& news) const {
  auto const next = planner_->toward_home(news.drone->origin(), budget(news));
  return {.place = {next.x(), next.y(), turned_home_->origin().z()}, .yaw_rad = turned_home_->yaw_rad()};
}

SurveyFigures Surveyor::figures() const {
  SurveyFigures told{
      .coverage = lot_.coverage(), .slots = slots_.size(), .sights = sights_, .begun = begun_, .ending = ending_};
  for (auto const& [id, feature] : slots_) {
    auto const state = std::get<map::Slot>(feature.content).state;
    if (state == map::SlotState::taken) ++told.taken;
    if (state == map::SlotState::free) ++told.free;
  }
  return told;
}

std::vector<map::Slot> Surveyor::slots() const {
  std::vector<map::Slot> slots;
  for (auto const& [id, feature] : slots_) slots.push_back(std::get<map::Slot>(feature.content));
  return slots;
}

std::string Surveyor::slots_line() const {
  auto features = map::Json::array();
  for (auto const& [id, feature] : slots_) features.push_back(map::feature_json(feature, site_));
  return map::Json{{"type", "FeatureCollection"}, {"survey", json_of(figures())}, {"features", std::move(features)}}
      .dump();
}

std::string Surveyor::slots_text(base::UtcTime now) {
  using map::Json;
  auto features = Json::array();
  for (auto const& [id, feature] : slots_) {
    auto json = map::feature_json(feature, site_);
    constexpr double decimals = 10.0;
    if (auto const& seen_at = std::get<map::Slot>(feature.content).seen_at)
      json["properties"]["age_s"] = std::round(decimals * base::to_seconds(now - *seen_at)) / decimals;
    features.push_back(std::move(json));
  }
  auto survey = json_of(figures());
  survey["at"] = base::utc_text(now);
  return Json{{"type", "FeatureCollection"}, {"survey", std::move(survey)}, {"features", std::move(features)}}.dump(1) +
         "\n";
}

}  // namespace lapwing::perceive
