#include "host/car_park/lot_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "geo/site.hpp"

namespace lapwing::host {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration look_period = 200ms;
/// Lower than that a drone starts or lands.
constexpr double lowest_m = 8.0;
/// Of the shorter side of the ground in a picture: at a third of it each slot is in about three pictures of a lane.
constexpr double step_share = 0.35;
/// Round the slots: parking ends there, and a slot at the edge is to be seen whole.
constexpr double margin_m = 6.0;
constexpr auto writer = "cameras";
constexpr auto id_prefix = "car-park";

geo::Polygon<geo::SiteFrame> area_round(CarParkTruth const& truth) {
  constexpr double far_m = std::numeric_limits<double>::infinity();
  Eigen::Vector2d least(far_m, far_m);
  Eigen::Vector2d most(-far_m, -far_m);
  for (auto const& slot : truth.slots) {
    for (auto const& corner : slot.outline) {
      least = least.cwiseMin(corner.v);
      most = most.cwiseMax(corner.v);
    }
  }
  least.array() -= margin_m;
  most.array() += margin_m;
  return {{{{least.x(), least.y()}, {most.x(), least.y()}, {most.x(), most.y()}, {least.x(), most.y()}}}};
}

/// Counterclockwise from east of clockwise from north.
double yaw_of(double heading_rad) {
  return geo::wrap_pi(0.5 * std::numbers::pi - heading_rad);
}

}  // namespace

LotWatch::LotWatch(base::Loop& loop, ::lapwing::map::LiveMap& live_map, Setup setup, base::Logger log)
    : loop_(loop), live_map_(live_map), setup_(std::move(setup)), log_(std::move(log)), scope_(loop) {
  scope_.spawn(watch());
}

base::Task<> LotWatch::watch() {
  auto finding = find_car_park();
  if (!co_await std::move(finding)) co_return;
  for (;;) {
    co_await loop_.sleep(look_period);
    for (auto const& drone : setup_.drones()) {
      auto view = view_from(drone);
      if (!view || !is_worth_a_picture(*view)) continue;
      auto looking = look(*std::move(view));
      co_await std::move(looking);
    }
  }
}

base::Task<base::Result<CarParkTruth>> LotWatch::ask_for_truth(base::UtcTime at) {
  CarParkPlace place{.world = setup_.world};
  if (auto const* const site = live_map_.site(setup_.site)) place.anchor = site->anchor();
  auto asking = setup_.ask(truth_request(place, at));
  auto const answer = co_await std::move(asking);
  if (!answer) co_return std::unexpected(answer.error());
  co_return truth_in(*answer);
}

base::Task<bool> LotWatch::find_car_park() {
  auto asking = ask_for_truth(loop_.utc_now());
  auto const truth = co_await std::move(asking);
  if (!truth) {
    log_.warn(fmt::format("the car park is not watched: {}", truth.error().message));
    co_return false;
  }
  if (truth->slots.empty()) {
    log_.warn(fmt::format("the car park is not watched: {} has no slots", setup_.world.string()));
    co_return false;
  }
  if (!live_map_.site(setup_.site)) {
    auto site = geo::Site::make(setup_.site, truth->anchor);
    if (site) live_map_.put_site(*std::move(site));
  }
  explore::LotSettings settings;
  settings.id_prefix = id_prefix;
  auto lot = explore::LotMap::make(area_round(*truth), settings);
  if (!lot) {
    log_.warn(fmt::format("the car park is not watched: {}", lot.error().message));
    co_return false;
  }
  lot_.emplace(*std::move(lot));
  ground_m_ = truth->ground_m;
  co_return true;
}

std::optional<LotWatch::View> LotWatch::view_from(DroneInTheAir const& drone) const {
  auto const* const site = live_map_.site(setup_.site);
  if (!site) return std::nullopt;
  return View{.vehicle = drone.vehicle,
              .look = {.place = {.world = setup_.world, .anchor = site->anchor()},
                       .lens = setup_.lens,
                       .at = loop_.utc_now(),
                       .pose = {site->point_of(drone.place), yaw_of(drone.heading_rad)}}};
}

bool LotWatch::is_worth_a_picture(View const& view) const {
  auto const& pose = view.look.pose;
  double const height_m = pose.position.z() - ground_m_;
  if (height_m < lowest_m) return false;
  auto const& lens = setup_.lens;
  double const shorter_m = height_m * std::min(lens.width_px / lens.focal_x_px, lens.height_px / lens.focal_y_px);
  auto const last = taken_at_.find(view.vehicle);
  if (last != taken_at_.end() && (pose.position - last->second).length() < step_share * shorter_m) return false;
  auto const seen = explore::well_seen_ground(view_of(lens, pose, ground_m_), lot_->settings());
  return !seen.rings.empty() && geo::bounds(seen).meets(geo::bounds(lot_->area()));
}

base::Task<> LotWatch::look(View view) {
  taken_at_.insert_or_assign(view.vehicle, view.look.pose.position);
  auto asking = setup_.ask(look_request(view.look));
  auto const answer = co_await std::move(asking);
  if (!answer) co_return;  // who looks has said why
  auto sight = sight_in(*answer, view.look, ground_m_);
  if (!sight) {
    log_.warn(fmt::format("a picture of the car park tells nothing: {}", sight.error().message));
    co_return;
  }
  ++pictures_;
  last_taken_ = view.look.at;
  if (!*sight) co_return;
  (*sight)->vehicle = view.vehicle.text;
  if (lot_->add(**sight)) write();
}

void LotWatch::write() {
  auto news = lot_->take_news({.site = setup_.site, .writer = writer});
  if (auto put = live_map_.put_all(std::move(news.slots)); !put)
    log_.warn(fmt::format("slots are not shown: {}", put.error().message));
  for (auto const& id : news.gone)
    (void)live_map_.remove(::lapwing::map::LayerKind::slots, id, {.writer = writer, .at = loop_.utc_now()});
}

std::vector<::lapwing::map::Slot> LotWatch::on_the_map() const {
  std::vector<::lapwing::map::Slot> slots;
  constexpr auto most = std::numeric_limits<std::size_t>::max();
  for (auto const* const record : live_map_.within(::lapwing::map::LayerKind::slots, setup_.site, std::nullopt, most))
    if (record->feature.account.writer == writer)
      slots.push_back(std::get<::lapwing::map::Slot>(record->feature.content));
  return slots;
}

base::Task<base::Result<LotScore>> LotWatch::judge() {
  auto asking = ask_for_truth(pictures_ > 0 ? last_taken_ : loop_.utc_now());
  auto const truth = co_await std::move(asking);
  if (!truth) co_return std::unexpected(truth.error());
  co_return score_of(on_the_map(), *truth);
}

}  // namespace lapwing::host
