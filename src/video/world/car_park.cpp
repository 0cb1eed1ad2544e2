#include "video/world/car_park.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::video {

namespace {

/// What chance is drawn for: so that more of one changes nothing of another.
enum Subject : std::uint64_t { first_car = 1, count_of_events, time_of_event, event, lane_start, lane_car };

constexpr std::uint64_t bits_of(std::int64_t number) {
  return static_cast<std::uint64_t>(number);
}

/// The last event of a slot's process at or before a time: which one it is, and nothing else, decides what stands
/// there.
struct SlotEvent {
  std::int64_t cell = 0;
  std::uint64_t number = 0;
};

std::uint64_t key_of(std::size_t slot, std::int64_t cell) {
  constexpr unsigned half = 32;
  return (static_cast<std::uint64_t>(slot) << half) ^ bits_of(cell);
}

/// How many events there are in a stretch of the mean length: Poisson's distribution of mean 1, inverted.
std::uint64_t events_in(CarPark const& park, std::size_t slot, std::int64_t cell) {
  double left = Dice(park.seed, count_of_events, key_of(slot, cell)).uniform();
  double chance = std::exp(-1.0);
  constexpr std::uint64_t most = 12;
  std::uint64_t count = 0;
  while (left >= chance && count < most) {
    left -= chance;
    chance /= static_cast<double>(++count);
  }
  return count;
}

std::optional<SlotEvent> last_event(CarPark const& park, std::size_t slot, double time_in_stays) {
  double const cell = std::floor(time_in_stays);
  constexpr int most_cells = 40;  // without an event in so many: a chance of e^-40
  for (int back = 0; back < most_cells; ++back) {
    auto const at = static_cast<std::int64_t>(cell) - back;
    std::optional<SlotEvent> last;
    double latest = -1.0;
    std::uint64_t const count = events_in(park, slot, at);
    for (std::uint64_t i = 0; i < count; ++i) {
      double const when = Dice(park.seed, time_of_event, key_of(slot, at), i).uniform();
      if (when <= latest || (back == 0 && when > time_in_stays - cell)) continue;
      latest = when;
      last = SlotEvent{at, i};
    }
    if (last) return last;
  }
  return std::nullopt;
}

Dice dice_of(CarPark const& park, std::size_t slot, double seconds) {
  if (park.stay_s <= 0.0 || park.slots[slot].habit == Slot::Habit::taken) return Dice(park.seed, first_car, slot);
  auto const last = last_event(park, slot, seconds / park.stay_s);
  return last ? Dice(park.seed, event, key_of(slot, last->cell), last->number) : Dice(park.seed, first_car, slot);
}

std::optional<Vehicle> vehicle_in(CarPark const& park, std::size_t number, double seconds) {
  auto const& slot = park.slots[number];
  if (slot.habit == Slot::Habit::free || slot.habit == Slot::Habit::left_to_listed) return std::nullopt;
  auto dice = dice_of(park, number, seconds);
  bool const is_taken = dice.happens(slot.share) || slot.habit == Slot::Habit::taken;
  if (!is_taken) return std::nullopt;
  Vehicle vehicle{.at = slot.middle(), .slot = number};
  constexpr double longer_than_slot_m = 0.3;
  vehicle.look = drawn_vehicle(dice, slot.longer_side_m() + longer_than_slot_m);
  double const heading = slot.heading_rad();
  // Along the slot a car may stand some way off; aside it leaves room to get out.
  double const most = 2.0;
  double const along = park.slip_m * std::clamp(dice.gaussian(), -most, most);
  double const aside = 0.5 * park.slip_m * std::clamp(dice.gaussian(), -most, most);
  vehicle.at = vehicle.at + geo::Vector<geo::SiteFrame>(along * std::cos(heading) - aside * std::sin(heading),
                                                        along * std::sin(heading) + aside * std::cos(heading));
  constexpr double backwards = 0.35;
  constexpr double askew_rad = 0.02;
  vehicle.heading_rad = heading + (dice.happens(backwards) ? std::numbers::pi : 0.0) +
                        askew_rad * std::clamp(dice.gaussian(), -most, most);
  return vehicle;
}

/// A place on a line, so far from its begin, and the way that it goes there; nothing beyond its end.
std::optional<Spot> along_line(std::vector<Spot> const& points, double metres) {
  if (metres < 0.0) return std::nullopt;
  for (std::size_t i = 1; i < points.size(); ++i) {
    double const piece = geo::distance_m(points[i - 1], points[i]);
    if (metres <= piece && piece > 0.0) return points[i - 1] + (points[i] - points[i - 1]) * (metres / piece);
    metres -= piece;
  }
  return std::nullopt;
}

void add_drivers(CarPark const& park, std::size_t number, double seconds, std::vector<Vehicle>& vehicles) {
  auto const& lane = park.lanes[number];
  double length_m = 0.0;
  for (std::size_t i = 1; i < lane.points.size(); ++i) length_m += geo::distance_m(lane.points[i - 1], lane.points[i]);
  auto const newest = static_cast<std::int64_t>(std::floor(seconds / lane.every_s));
  auto const still_there = static_cast<std::int64_t>(std::ceil(length_m / lane.speed_m_s / lane.every_s)) + 1;
  for (std::int64_t k = newest - still_there; k <= newest; ++k) {
    constexpr double spread = 2.0 / 3.0;
    double const start =
        (static_cast<double>(k) + spread * Dice(park.seed, lane_start, number, bits_of(k)).uniform()) * lane.every_s;
    double const along = (seconds - start) * lane.speed_m_s;
    constexpr double half_base_m = 1.4;  // a car turns over its two axles
    auto const front = along_line(lane.points, along + half_base_m);
    auto const rear = along_line(lane.points, along - half_base_m);
    if (!front || !rear) continue;
    Dice dice(park.seed, lane_car, number, bits_of(k));
    auto const way = *front - *rear;
    vehicles.push_back({.at = *rear + way * 0.5,
                        .heading_rad = std::atan2(way.y(), way.x()),
                        .look = drawn_vehicle(dice, 6.0),
                        .is_driving = true});
  }
}

}  // namespace

Spot Slot::middle() const {
  return outline[0] + (outline[2] - outline[0]) * 0.5;
}

double Slot::heading_rad() const {
  auto const along = outline[3] - outline[0];
  auto const across = outline[1] - outline[0];
  auto const way = along.length() >= across.length() ? along : across;
  return std::atan2(way.y(), way.x());
}

double Slot::longer_side_m() const {
  return std::max((outline[3] - outline[0]).length(), (outline[1] - outline[0]).length());
}

bool Slot::contains(Spot const& place) const {
  bool is_left = true;
  bool is_right = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    double const side = (outline[(i + 1) % outline.size()] - outline[i]).cross(place - outline[i]);
    is_left = is_left && side >= 0.0;
    is_right = is_right && side <= 0.0;
  }
  return is_left || is_right;
}

Occupation occupation_at(CarPark const& park, base::UtcTime at) {
  Occupation now{.taken = std::vector<bool>(park.slots.size(), false), .vehicles = {}};
  double const seconds = std::chrono::duration<double>(at.time_since_epoch()).count();
  for (std::size_t i = 0; i < park.slots.size(); ++i)
    if (auto vehicle = vehicle_in(park, i, seconds)) now.vehicles.push_back(*vehicle);
  for (auto const& car : park.cars)
    now.vehicles.push_back({.at = car.at, .heading_rad = car.heading_rad, .look = car.look, .slot = car.slot});
  for (auto const& vehicle : now.vehicles)
    if (vehicle.slot) now.taken[*vehicle.slot] = true;
  for (std::size_t i = 0; i < park.lanes.size(); ++i) add_drivers(park, i, seconds, now.vehicles);
  return now;
}

std::array<Spot, 4> outline_of(Vehicle const& vehicle) {
  geo::Vector<geo::SiteFrame> const ahead(std::cos(vehicle.heading_rad), std::sin(vehicle.heading_rad));
  geo::Vector<geo::SiteFrame> const left(-ahead.y(), ahead.x());
  auto const l = ahead * (0.5 * vehicle.look.length_m);
  auto const w = left * (0.5 * vehicle.look.width_m);
  return {vehicle.at + l + w, vehicle.at - l + w, vehicle.at - l - w, vehicle.at + l - w};
}

}  // namespace lapwing::video
