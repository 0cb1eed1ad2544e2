#include "explore/simulated/car_park.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "explore/lot/belief.hpp"

namespace lapwing::explore {

namespace {

constexpr double slot_width_m = 2.5;
constexpr double slot_length_m = 5.0;
constexpr double lane_m = 6.0;
constexpr double border_m = 3.0;
constexpr double tree_up_m = 5.0;
/// How far the fence is out from the area.
constexpr double fence_out_m = 6.0;

std::uint64_t mixed(std::uint64_t x) {  // splitmix64 (Steele, Lea & Flood 2014)
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

std::uint64_t whole(double value, double part) {
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / part)));
}

/// Half of the squared distance between the two cases in their own noise, such that so many are wrong.
double strength_of(double wrong_share) {
  // The share is the normal distribution below -sqrt(m / 2); found by halving.
  double low = 0.0;
  double high = 60.0;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    double const middle = 0.5 * (low + high);
    (0.5 * std::erfc(std::sqrt(middle) / 2.0) > wrong_share ? low : high) = middle;
  }
  return low;
}

}  // namespace

double CarPark::chance(std::uint64_t what, std::uint64_t a, std::uint64_t b, std::uint64_t c) const {
  auto const bits = mixed(mixed(mixed(mixed(seed_ ^ (what << 48U)) ^ a) ^ b) ^ c);
  return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53;
}

double CarPark::noise(std::uint64_t what, std::uint64_t a, std::uint64_t b, std::uint64_t c) const {
  constexpr std::uint64_t second = 0x8000;
  return std::sqrt(-2.0 * std::log(chance(what, a, b, c))) *
         std::cos(2.0 * std::numbers::pi * chance(what | second, a, b, c));
}

/// A rectangle, of which a corner may be cut out, with or without a house in it; in metres of its own, which `place`
/// turns into those of the site.
struct CarPark::Plan {
  double width_m;
  double height_m;
  geo::Transform<geo::SiteFrame, geo::SiteFrame> turned;
  bool has_cut;
  bool has_building;

  [[nodiscard]] map::SitePoint place(double x, double y) const { return turned * map::SitePoint(x, y); }
  [[nodiscard]] double cut_x() const { return 0.6 * width_m; }
  [[nodiscard]] double cut_y() const { return 0.55 * height_m; }
  [[nodiscard]] double house_x() const { return 0.3 * width_m; }
  [[nodiscard]] double house_y() const { return 0.4 * height_m; }
  static constexpr double house_m = 12.0;
  [[nodiscard]] bool is_built(double x, double y, double more) const {
    return has_building && x > house_x() - more && x < house_x() + house_m + more && y > house_y() - more &&
           y < house_y() + house_m + more;
  }
};

CarPark::CarPark(std::uint64_t seed, DetectorFaults faults) : seed_(seed), faults_(faults) {
  std::mt19937_64 random(mixed(seed));
  auto const between = [&](double least, double most) {
    return least + (most - least) * (static_cast<double>(random() >> 11U) * 0x1p-53);
  };
  double const width_m = between(80.0, 140.0);
  double const height_m = between(50.0, 90.0);
  double const turned_rad = between(0.0, std::numbers::pi);
  Plan const plan{.width_m = width_m,
                  .height_m = height_m,
                  .turned = {map::SitePoint(20.0, 10.0), turned_rad},
                  .has_cut = seed % 3 == 1,
                  .has_building = seed % 4 == 2};
  draw_outline(plan);
  draw_rows(plan);
}

void CarPark::draw_outline(Plan const& plan) {
  auto const ring = [&](double out) {
    auto const right = plan.width_m + out;
    auto const top = plan.height_m + out;
    geo::Ring<geo::SiteFrame> corners = {plan.place(-out, -out), plan.place(right, -out)};
    if (plan.has_cut) {
      corners.push_back(plan.place(right, plan.cut_y() + out));
      corners.push_back(plan.place(plan.cut_x() + out, plan.cut_y() + out));
      corners.push_back(plan.place(plan.cut_x() + out, top));
    } else {
      corners.push_back(plan.place(right, top));
    }
    corners.push_back(plan.place(-out, top));
    return corners;
  };
  area_ = {{ring(0.0)}};
  fence_ = {{ring(fence_out_m)}};
  if (plan.has_building) {
    auto const x = plan.house_x();
    auto const y = plan.house_y();
    geo::Ring<geo::SiteFrame> const house = {plan.place(x, y), plan.place(x + Plan::house_m, y),
                                             plan.place(x + Plan::house_m, y + Plan::house_m),
                                             plan.place(x, y + Plan::house_m)};
    area_.rings.push_back(house);
    fence_.rings.push_back(house);
  }
  home_ = plan.place(2.0, 2.0);
}

void CarPark::draw_rows(Plan const& plan) {
  std::uint64_t number = 0;
  double y = border_m;
  for (int row = 0; y + slot_length_m <= plan.height_m - border_m; ++row) {
    for (double x = border_m; x + slot_width_m <= plan.width_m - border_m; x += slot_width_m) {
      ++number;
      bool const is_out =
          plan.has_cut && x + slot_width_m > plan.cut_x() - border_m && y + slot_length_m > plan.cut_y() - border_m;
      constexpr double island_share = 0.06;
      if (is_out || plan.is_built(x + slot_width_m / 2, y + slot_length_m / 2, 4.0)) continue;
      if (chance(1, number) < island_share) {
        constexpr double with_tree = 0.5;
        if (chance(2, number) < with_tree)
          trees_.push_back({plan.place(x + 1.25, y + 2.5), 1.2 + 1.6 * chance(3, number)});
        continue;
      }
      constexpr double taken_share = 0.55;
      constexpr double painted_share = 0.85;
      slots_.push_back({.outline = {plan.place(x, y), plan.place(x + slot_width_m, y),
                                    plan.place(x + slot_width_m, y + slot_length_m), plan.place(x, y + slot_length_m)},
                        .is_taken = chance(4, number) < taken_share,
                        .is_painted = chance(5, number) < painted_share});
    }
    // Two rows head to head, and a lane.
    y += slot_length_m + (row % 2 == 0 ? lane_m : 0.0);
    if (row % 2 == 0 && row < 6) {
      double const lane_y = y - lane_m / 2.0;
      auto const from = plan.place(border_m, lane_y);
      auto const to = plan.place(
          plan.has_cut && lane_y > plan.cut_y() - border_m ? plan.cut_x() - border_m : plan.width_m - border_m, lane_y);
      drivers_.push_back({from, (to - from) * (2.5 / geo::distance_m(from, to)), geo::distance_m(from, to)});
    }
  }
}

double CarPark::seen_share(TrueSlot const& slot, geo::GroundView const& view) const {
  constexpr int tries = 4;
  auto const camera = view.site_from_camera.origin();
  double const share_up = tree_up_m / camera.z();
  int seen = 0;
  for (int i = 0; i < tries; ++i) {
    for (int k = 0; k < tries; ++k) {
      double const u = (i + 0.5) / tries;
      double const v = (k + 0.5) / tries;
      auto const along = slot.outline[0] + u * (slot.outline[1] - slot.outline[0]);
      auto const at = along + v * (slot.outline[3] - slot.outline[0]);
      if (!geo::seen_at(view, at)) continue;
      map::SitePoint const in_crowns(at.x() + share_up * (camera.x() - at.x()),
                                     at.y() + share_up * (camera.y() - at.y()));
      if (std::ranges::any_of(
              trees_, [&](Tree const& tree) { return geo::distance_m(tree.middle, in_crowns) < tree.radius_m; }))
        continue;
      ++seen;
    }
  }
  return static_cast<double>(seen) / (tries * tries);
}

double CarPark::taken_chance(std::size_t slot, geo::GroundView const& view, double seconds) const {
  auto const camera = view.site_from_camera.origin();
  double const sampling_m = camera.z() / view.lens.focal_x_px;
  double const coarse = sampling_m / faults_.coarse_m;
  double const strength = strength_of(std::min(0.45, faults_.wrong_share * (1.0 + coarse * coarse)));
  double const part = faults_.same_place_m;
  auto const cell = mixed(whole(camera.x(), part) ^ mixed(whole(camera.y(), part) ^ mixed(whole(camera.z(), part))));
  double const error = std::sqrt(faults_.of_slot) * noise(10, slot) +
                       std::sqrt(faults_.of_place) * noise(11, slot, cell) +
                       std::sqrt(1.0 - faults_.of_slot - faults_.of_place) * noise(12, slot, whole(seconds, 0.01));
  double const side = slots_[slot].is_taken ? 1.0 : -1.0;
  // Logits that are normal with this mean and variance are calibrated: what they say is what they are worth.
  return chance_of(side * strength + std::sqrt(2.0 * strength) * error);
}

Corners CarPark::driver_at(Driver const& driver, double seconds) const {
  double const speed = driver.way_m_s.length();
  double const along = std::fmod(seconds * speed, 2.0 * driver.lane_m);
  double const at_m = along < driver.lane_m ? along : 2.0 * driver.lane_m - along;
  auto const way = driver.way_m_s * (1.0 / speed);
  geo::Vector<geo::SiteFrame> const aside(-way.y(), way.x());
  auto const middle = driver.from + way * at_m;
  return {middle - way * 2.3 - aside * 0.95, middle + way * 2.3 - aside * 0.95, middle + way * 2.3 + aside * 0.95,
          middle - way * 2.3 + aside * 0.95};
}

LotSight CarPark::look(geo::GroundView const& view, base::UtcTime at, double seconds) const {
  LotSight sight{.vehicle = "drone 1", .at = at, .view = view, .doubt = {.position_m = faults_.camera_off_m}};
  auto const camera = view.site_from_camera.origin();
  auto const picture = whole(seconds, 0.01);
  auto const spell = whole(seconds, 3.0);
  geo::Vector<geo::SiteFrame> const off(faults_.camera_off_m * noise(20, spell),
                                        faults_.camera_off_m * noise(21, spell));
  auto const told = [&](Corners corners, std::uint64_t number) {
    for (std::size_t i = 0; i < corners.size(); ++i)
      corners[i] = corners[i] + off +
                   geo::Vector<geo::SiteFrame>(faults_.outline_m * noise(22, number, picture, i),
                                               faults_.outline_m * noise(23, number, picture, i));
    return corners;
  };
  auto const place = mixed(whole(camera.x(), faults_.same_place_m) ^ mixed(whole(camera.y(), faults_.same_place_m)));
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    auto const& slot = slots_[i];
    if (!std::ranges::all_of(slot.outline, [&](auto const& corner) { return geo::seen_at(view, corner).has_value(); }))
      continue;
    double const share = seen_share(slot, view);
    constexpr double least_share = 0.7;
    if (share < least_share || chance(24, i, place) < faults_.missed_share) continue;
    constexpr double painted = 0.95;
    constexpr double half_painted = 0.8;
    sight.slots.push_back({.outline = told(slot.outline, i),
                           .surety = slot.is_painted ? painted : half_painted,
                           .taken_chance = taken_chance(i, view, seconds)});
  }
  for (std::size_t i = 0; i < drivers_.size(); ++i) {
    auto const car = driver_at(drivers_[i], seconds);
    if (geo::seen_at(view, middle_of(car))) sight.cars.push_back({.outline = told(car, 100'000 + i), .chance = 0.95});
  }
  if (chance(25, picture) < faults_.false_a_picture) {
    auto const u = view.lens.width_px * chance(26, picture);
    auto const v = view.lens.height_px * chance(27, picture);
    if (auto const ground = geo::ground_at(view, {u, v})) {
      auto const at_x = ground->x();
      auto const at_y = ground->y();
      sight.slots.push_back(
          {.outline = {{{at_x, at_y}, {at_x + 2.5, at_y}, {at_x + 2.5, at_y + 5.0}, {at_x, at_y + 5.0}}},
           .surety = 0.6,
           .taken_chance = 0.9});
    }
  }
  return sight;
}

}  // namespace lapwing::explore
