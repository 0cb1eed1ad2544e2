#include "sim/building/building_run.hpp"

#include <algorithm>

#include "base/assert.hpp"

namespace lapwing::sim::building {

namespace {

/// A machine that cannot keep up lets the building fall behind, rather than nobody else have a turn.
constexpr int most_steps_a_turn = 20;

}  // namespace

BuildingRun::BuildingRun(base::Loop& loop, Building& building)
    : loop_(loop),
      building_(building),
      began_(loop.now()),
      began_s_(building.time_s()),
      hubs_(building.robot_count()),
      scope_(loop) {
  scope_.spawn(live());
}

std::unique_ptr<link::ByteLink> BuildingRun::connect(std::size_t robot) {
  LAPWING_ASSERT(robot < building_.robot_count(), robot);
  auto& hub = hubs_[robot];
  if (!hub) {
    hub = std::make_unique<link::PipeHub>(loop_);
    serve(robot, hub->take_server());
  }
  return hub->connect();
}

void BuildingRun::serve(std::size_t robot, std::unique_ptr<link::ByteLink> link) {
  LAPWING_ASSERT(robot < building_.robot_count(), robot);
  auto& line = *lines_.emplace_back(std::make_unique<Line>(Line{robot, std::move(link), {}}));
  line.link->start([this, &line](link::Peer peer, link::Bytes bytes) {
    if (std::ranges::find(line.heard, peer) == line.heard.end()) line.heard.push_back(peer);
    building_.robot(line.robot).to_board(bytes);
  });
}

base::Result<> BuildingRun::serve(std::size_t robot, link::Url const& url) {
  auto link = link::open(loop_, url);
  if (!link) return std::unexpected(link.error());
  serve(robot, *std::move(link));
  return {};
}

void BuildingRun::speak() {
  for (std::size_t robot = 0; robot < building_.robot_count(); ++robot) {
    auto const bytes = building_.robot(robot).from_board();
    if (bytes.empty()) continue;
    for (auto const& line : lines_) {
      if (line->robot != robot) continue;
      // Who has gone away is refused by the link, and forgotten.
      std::erase_if(line->heard, [&](link::Peer peer) { return !line->link->send(peer, bytes); });
      for (auto const peer : line->link->standing_peers()) {
        if (std::ranges::find(line->heard, peer) == line->heard.end()) (void)line->link->send(peer, bytes);
      }
    }
  }
}

base::Task<void> BuildingRun::live() {
  while (true) {
    auto const due = began_ + base::from_seconds(building_.time_s() - began_s_ + Building::step_s);
    co_await loop_.sleep_until(due);
    for (int i = 0; i < most_steps_a_turn; ++i) {
      building_.step();
      if (began_ + base::from_seconds(building_.time_s() - began_s_ + Building::step_s) > loop_.now()) break;
    }
    speak();
  }
}

}  // namespace lapwing::sim::building
