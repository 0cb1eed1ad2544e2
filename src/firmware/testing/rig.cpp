#include "firmware/testing/rig.hpp"

#include <algorithm>

namespace lapwing::firmware::testing {

using namespace std::chrono_literals;

Description office_robot() {
  Description body{.wheel_base_m = 0.24F,
                   .pulses_per_m = 5'000,
                   .top_speed_m_s = 0.3F,
                   .braking_m_s2 = 0.5F,
                   .hull = {.front_m = 0.15F, .back_m = 0.15F, .half_width_m = 0.14F},
                   .sonar_count = 5,
                   .sonars = {},
                   .laser = {}};
  float constexpr half_cone = 0.25F;
  body.sonars[0] = {.x_m = 0.15F, .y_m = 0, .angle_rad = 0, .half_cone_rad = half_cone, .longest_m = 7.5F};
  body.sonars[1] = {.x_m = 0.12F, .y_m = 0.08F, .angle_rad = 0.5236F, .half_cone_rad = half_cone, .longest_m = 5};
  body.sonars[2] = {.x_m = 0.12F, .y_m = -0.08F, .angle_rad = -0.5236F, .half_cone_rad = half_cone, .longest_m = 5};
  body.sonars[3] = {.x_m = 0, .y_m = 0.14F, .angle_rad = 1.5708F, .half_cone_rad = half_cone, .longest_m = 5};
  body.sonars[4] = {.x_m = 0, .y_m = -0.14F, .angle_rad = -1.5708F, .half_cone_rad = half_cone, .longest_m = 5};
  return body;
}

Rig::Rig(Description const& description, Tuning const& tuning)
    : body(description, tuning), program_(body, description, tuning) {}

void Rig::tell(FromHost const& record) {
  auto const frame = write(record, sequence_++);
  body.to_board.insert(body.to_board.end(), frame.view().begin(), frame.view().end());
}

void Rig::run(Time span) {
  for (Time const end = now_ + span; now_ < end;) {
    now_ += step;
    body.advance(step);
    if (is_host_alive && (!alive_ || now_ - *alive_ >= 200ms)) {
      alive_ = now_;
      tell(Alive{});
    }
    program_.step(now_);
    listen();
  }
}

void Rig::listen() {
  for (auto const byte : body.from_board) {
    if (!reader_.push(byte)) continue;
    auto const record = read_from_board(reader_.packet());
    if (!record) continue;
    if (auto const* const readings = std::get_if<Readings>(&*record)) readings_.push_back(*readings);
    if (auto const* const completed = std::get_if<Completed>(&*record)) completed_.push_back(completed->number);
    if (auto const* const hello = std::get_if<Hello>(&*record)) hellos_.push_back(*hello);
    if (auto const* const piece = std::get_if<LaserPiece>(&*record)) pieces_.push_back(*piece);
    if (auto const* const log = std::get_if<Log>(&*record)) logs_.push_back(*log);
  }
  body.from_board.clear();
}

int Rig::count(LogCode code) const {
  return static_cast<int>(std::ranges::count(logs_, code, &Log::code));
}

}  // namespace lapwing::firmware::testing
