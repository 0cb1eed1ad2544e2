#include "robot/old_parts/order.hpp"

#include <optional>

#include <fmt/format.h>

#include "robot/seed_text/line.hpp"
#include "robot/seed_text/payload.hpp"

namespace lapwing::robot {

namespace {

std::optional<Order> order_of(seed_text::Override what) {
  switch (what) {
    case seed_text::Override::stop: return Order::stand;
    case seed_text::Override::go_on: return Order::go_on;
    case seed_text::Override::reverse: break;
  }
  return std::nullopt;
}

/// The parts that a robot of ours has itself speak for themselves.
bool may_be_old(Module module) {
  return module == Module::points_of_interest || module == Module::visualizer || module == Module::command_centre;
}

std::optional<Heard> meaning_of(seed_text::Line const& line, seed_text::Payload const& payload) {
  if (std::holds_alternative<seed_text::Kill>(payload)) return Order::kill;
  if (auto const* const what = std::get_if<seed_text::Override>(&payload);
      what != nullptr && line.from == Module::command_centre)
    if (auto const order = order_of(*what)) return *order;
  if (auto const* const entry = std::get_if<seed_text::LogEntry>(&payload); entry != nullptr && may_be_old(line.from))
    return OldPartReport{
        .module = line.from,
        .report = {.state = entry->state, .error_code = entry->error_code, .memory_bytes = entry->memory_bytes}};
  return std::nullopt;
}

}  // namespace

base::Result<Heard> heard_in(std::string_view text) {
  auto const line = seed_text::read(text);
  if (!line) return std::unexpected(line.error());
  auto const payload = seed_text::read_payload(*line);
  if (!payload) return std::unexpected(payload.error());
  if (auto const meaning = meaning_of(*line, *payload)) return *meaning;
  return base::fail(base::ErrorKind::invalid_input,
                    fmt::format("the robot takes nothing of that kind from {} to {}", name_of(line->from).short_name,
                                name_of(line->to).short_name),
                    "docs/reference/robot-serial.md has what it takes");
}

}  // namespace lapwing::robot
