#include "sim/building/robot/robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::sim::building {

namespace {

/// A board's buffers: two seconds of its line.
constexpr std::size_t most_bytes_waiting = 23'040;
constexpr double free_for_s = 0.5;
/// Times are sums of steps: without this a tenth of a second would come a step late now and then.
constexpr double tolerance_s = 1e-6;

firmware::Vector3 vector_of(std::array<double, 3> const& numbers) {
  return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
}

}  // namespace

Robot::Robot(RobotSettings const& settings, Pose const& start, std::uint64_t seed, std::uint32_t number)
    : settings_(settings),
      seed_(seed),
      number_(number),
      body_(settings.drive, start, seed, number),
      laser_(settings.laser, seed, number),
      imu_(settings.imu, seed, number),
      sonar_noise_(seed, "sonar", number),
      program_(std::make_unique<firmware::Program>(*this, description_of(settings))),
      echoes_(description_of(settings).sonar_count, 0),
      told_echoes_(echoes_) {}

firmware::Time Robot::board_time(double time_s) const {
  return firmware::Time(std::llround((time_s - board_began_s_) * 1e6));
}

std::vector<Collision> Robot::step(double now_s, double seconds, Surroundings const& around) {
  now_s_ = now_s;
  auto const contacts = body_.step(seconds, left_voltage_, right_voltage_, around);
  count_pulses();
  sense(now_s, seconds, around);
  if (!has(Fault::Kind::halted, 0)) program_->step(board_time(now_s));
  return news_of(now_s, contacts);
}

void Robot::sense(double now_s, double seconds, Surroundings const& around) {
  if (now_s + tolerance_s >= imu_sensed_s_ + imu_.settings().period_s) {
    auto const sample = imu_.sense(std::max(now_s - imu_sensed_s_, seconds), body_);
    imu_sensed_s_ = now_s;
    auto const part = [&](std::size_t i) { return static_cast<float>(sample.orientation[i]); };
    imu_sample_ = firmware::ImuSample{.orientation = {.w = part(0), .x = part(1), .y = part(2), .z = part(3)},
                                      .rate_rad_s = vector_of(sample.rate_rad_s),
                                      .acceleration_m_s2 = vector_of(sample.acceleration_m_s2)};
  }
  if (!echoes_.empty() && now_s + tolerance_s >= sonar_fires_s_) {
    sonar_fires_s_ = now_s + settings_.sonar_period_s;
    fire_sonar(around);
  }
  if (laser_.sense(now_s, body_.pose(), around)) {
    told_scan_ = laser_.scan();
    has_scan_ = true;
  }
}

void Robot::fire_sonar(Surroundings const& around) {
  auto const number = next_sonar_;
  next_sonar_ = (next_sonar_ + 1) % echoes_.size();
  auto const& sonar = settings_.sonars[number];
  auto const& pose = body_.pose();
  Shift const ahead(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad));
  Shift const aside(-ahead.y(), ahead.x());
  auto const from = pose.position + sonar.x_m * ahead + sonar.y_m * aside;
  echoes_[number] = echo_us(sonar, from, pose.yaw_rad + sonar.angle_rad, around, sonar_noise_);
  int const which = static_cast<int>(number);
  if (has(Fault::Kind::sonar_stuck, which)) return;
  told_echoes_[number] = echoes_[number];
  if (has(Fault::Kind::sonar_silent, which)) told_echoes_[number] = 0;
  if (has(Fault::Kind::sonar_jumps, which))
    told_echoes_[number] = static_cast<std::uint16_t>(
        sonar_noise_.uniform(0.0, sonar.range_m * static_cast<double>(firmware::echo_us_per_m)));
}

std::vector<Collision> Robot::news_of(double now_s, std::vector<Contact> const& contacts) {
  std::vector<Collision> news;
  for (auto const& contact : contacts) {
    auto const same = std::ranges::find_if(touches_, [&](Touch const& touch) {
      return touch.contact.thing == contact.thing && touch.contact.number == contact.number;
    });
    if (same != touches_.end()) {
      same->last_s = now_s;
      continue;
    }
    touches_.push_back({contact, now_s});
    news.push_back({.time_s = now_s, .robot = number_, .contact = contact});
  }
  std::erase_if(touches_, [&](Touch const& touch) { return now_s - touch.last_s > free_for_s; });
  return news;
}

void Robot::to_board(std::span<std::uint8_t const> bytes) {
  if (has(Fault::Kind::unplugged, 0)) return;
  auto const room = most_bytes_waiting - std::min(to_board_.size(), most_bytes_waiting);
  auto const taken = bytes.first(std::min(room, bytes.size()));
  to_board_.insert(to_board_.end(), taken.begin(), taken.end());
}

std::vector<std::uint8_t> Robot::from_board() {
  return std::exchange(from_board_, {});
}

bool Robot::has(Fault::Kind kind, int which) const {
  return std::ranges::any_of(faults_, [&](Fault const& one) { return one.kind == kind && one.which == which; });
}

Fault const* Robot::fault(Fault::Kind kind) const {
  auto const found = std::ranges::find(faults_, kind, &Fault::kind);
  return found == faults_.end() ? nullptr : &*found;
}

void Robot::set(Fault const& fault) {
  std::erase_if(faults_, [&](Fault const& one) { return one.kind == fault.kind && one.which == fault.which; });
  faults_.push_back(fault);
  if (fault.kind == Fault::Kind::wheel_slips)
    body_.set_grip(fault.which == 0 ? Side::left : Side::right, fault.amount.value_or(1.0));
}

void Robot::mend(Fault::Kind kind) {
  std::erase_if(faults_, [&](Fault const& one) { return one.kind == kind; });
  if (kind != Fault::Kind::wheel_slips) return;
  for (auto const side : {Side::left, Side::right}) body_.set_grip(side, 1.0);
}

void Robot::mend_all() {
  while (!faults_.empty()) mend(faults_.back().kind);
}

void Robot::restart_board() {
  board_began_s_ = now_s_;
  left_voltage_ = 0.0;
  right_voltage_ = 0.0;
  to_board_.clear();
  program_ = std::make_unique<firmware::Program>(*this, description_of(settings_));
}

Post Robot::post() const {
  return {.middle = body_.pose().position,
          .radius_m = settings_.drive.radius_m,
          .material = Material::wood,
          .thing = Thing::robot,
          .number = number_};
}

firmware::Pulses Robot::pulses() {
  return {.left = counters_[0].told, .right = counters_[1].told};
}

/// A dead encoder stays at what it had counted, and misses what passes.
void Robot::count_pulses() {
  for (int which = 0; which < 2; ++which) {
    auto& counter = counters_[static_cast<std::size_t>(which)];
    auto const now = body_.pulses(which == 0 ? Side::left : Side::right);
    if (!has(Fault::Kind::encoder_dead, which)) counter.told += now - counter.seen;
    counter.seen = now;
  }
}

std::optional<firmware::ImuSample> Robot::imu() {
  auto sample = std::exchange(imu_sample_, std::nullopt);
  return has(Fault::Kind::imu_silent, 0) ? std::nullopt : sample;
}

std::span<std::uint16_t const> Robot::echoes_us() {
  return told_echoes_;
}

std::optional<firmware::LaserScan> Robot::laser() {
  bool const is_new = std::exchange(has_scan_, false);
  if (!is_new || has(Fault::Kind::laser_silent, 0)) return std::nullopt;
  return firmware::LaserScan{.time = board_time(told_scan_.time_s), .ranges_mm = told_scan_.ranges_mm};
}

firmware::Battery Robot::battery() {
  auto const* const low = fault(Fault::Kind::battery_low);
  double const left = low ? low->amount.value_or(0.1) : std::max(0.0, 1.0 - now_s_ / settings_.battery_lasts_s);
  double const volts = settings_.battery_empty_v + left * (settings_.battery_full_v - settings_.battery_empty_v);
  return {.mv = static_cast<std::uint16_t>(std::lround(volts * 1e3)),
          .percent = static_cast<std::uint8_t>(std::lround(left * 100.0))};
}

void Robot::drive_wheels(float left, float right) {
  left_voltage_ = static_cast<double>(left);
  right_voltage_ = static_cast<double>(right);
}

std::size_t Robot::receive(std::span<std::uint8_t> into) {
  auto const count = std::min(into.size(), to_board_.size());
  std::copy_n(to_board_.begin(), count, into.begin());
  to_board_.erase(to_board_.begin(), to_board_.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

bool Robot::send(std::span<std::uint8_t const> frame) {
  // A line that nobody plugged in takes what is written to it.
  if (has(Fault::Kind::unplugged, 0)) return true;
  if (from_board_.size() + frame.size() > most_bytes_waiting) return false;
  from_board_.insert(from_board_.end(), frame.begin(), frame.end());
  return true;
}

}  // namespace lapwing::sim::building
