#include "robot/old_parts/text_port.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "robot/seed_text/payload.hpp"

namespace lapwing::robot {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration log_period = 100ms;  ///< the seed's ten times a second
constexpr base::Duration complaint_period = 10s;
constexpr int most_orders_a_second = 10;  ///< besides kills: each is noted for everybody to see
constexpr std::size_t most_points_a_turn = 20;
/// As which commander it is shown.
constexpr auto commander = "the old command centre";

}  // namespace

TextPort::TextPort(Surroundings around, std::unique_ptr<link::ByteLink> link, base::Logger log)
    : around_(around), log_(std::move(log)), link_(std::move(link)), began_(around_.loop.now()), scope_(around_.loop) {
  link_->start([this](link::Peer peer, link::Bytes bytes) { hear(peer, bytes); });
  scope_.spawn(keep_speaking());
}

// ---- what is told

base::Task<> TextPort::keep_speaking() {
  for (;;) {
    co_await around_.loop.sleep(log_period);
    meet_listeners();
    if (listeners_.empty()) continue;
    auto const text = states();
    auto const layer = map::LayerKind::points_of_interest;
    points_.update(around_.robot, around_.live_map.within(layer, around_.robot.spec().site, std::nullopt,
                                                          std::numeric_limits<std::size_t>::max()));
    for (auto& [peer, listener] : listeners_) {
      (void)send(peer, text, link::Urgency::perishable);
      tell_points(peer, listener);
    }
  }
}

void TextPort::meet_listeners() {
  auto const there = link_->standing_peers();
  bool const was_any = has_listener();
  std::erase_if(listeners_, [&](auto const& entry) { return std::ranges::find(there, entry.first) == there.end(); });
  for (auto const peer : there) (void)listener_at(peer);
  if (!was_any || has_listener()) return;
  log_.warn("no old part is connected any more; the robot goes on");
  around_.control.forget(commander);
}

TextPort::Listener& TextPort::listener_at(link::Peer peer) {
  auto const [found, is_new] = listeners_.try_emplace(peer);
  if (is_new) log_.info(fmt::format("an old part is at {}", link_->peer_name(peer)));
  return found->second;
}

std::string TextPort::states() const {
  std::string text;
  auto const now = around_.loop.now();
  bool has_communication = false;
  for (auto const& health : around_.robot.watch().health(now)) {
    if (!health.was_heard || health.is_silent) continue;
    has_communication |= health.module == Module::communication;
    seed_text::LogEntry const entry{.state = health.report.state,
                                    .error_code = health.report.error_code,
                                    .memory_bytes = health.report.memory_bytes.value_or(0)};
    add_line(text, health.module, Module::command_centre, seed_text::write(entry).value_or(""));
  }
  // Who hears this hears it over the communication module.
  if (!has_communication)
    add_line(text, Module::communication, Module::command_centre,
             seed_text::write(seed_text::LogEntry{.state = ModuleState::ready}).value_or(""));
  if (!around_.robot.has_been_heard()) return text;
  if (auto const& at = around_.robot.state().motion.site_pose.value) {
    auto const place = around_.robot.on_map({at->position.x(), at->position.y()});
    auto const pose = seed_text::write(seed_text::Pose{
        .x_m = place.x(), .y_m = place.y(), .yaw_rad = at->yaw_rad - around_.robot.spec().start.yaw_rad});
    if (pose) add_line(text, Module::mapping, Module::visualizer, *pose);
  }
  return text;
}

void TextPort::tell_points(link::Peer peer, Listener& listener) {
  for (auto& [number, message] : points_.after(listener.last_point, most_points_a_turn)) {
    std::string text;
    add_line(text, Module::points_of_interest, Module::visualizer, std::move(message));
    if (!send(peer, text, link::Urgency::prompt)) return;  // again with the next turn
    listener.last_point = number;
  }
}

void TextPort::add_line(std::string& text, Module from, Module to, std::string message) const {
  auto const since = std::chrono::duration_cast<std::chrono::milliseconds>(around_.loop.now() - began_);
  text += seed_text::write(seed_text::Line{.from = from, .to = to, .stamp = since, .message = std::move(message)})
              .value_or("");
}

bool TextPort::send(link::Peer peer, std::string const& text, link::Urgency urgency) {
  std::vector<std::uint8_t> const bytes(text.begin(), text.end());
  return link_->send(peer, bytes, urgency);
}

// ---- what is heard

void TextPort::hear(link::Peer peer, link::Bytes bytes) {
  auto& reader = listener_at(peer).reader;
  auto const too_long = reader.too_long();
  reader.feed(bytes, [&](std::string_view line) { take(peer, line); });
  if (reader.too_long() > too_long) complain(peer, "a line is longer than 1024 characters");
}

void TextPort::take(link::Peer peer, std::string_view line) {
  auto const heard = heard_in(line);
  if (!heard) return complain(peer, heard.error().message);
  if (auto const* const report = std::get_if<OldPartReport>(&*heard))
    return around_.robot.hear_module(report->module, report->report);
  carry_out(std::get<Order>(*heard));
}

void TextPort::carry_out(Order order) {
  if (order == Order::kill) {
    // Once it is killed here its carrier is told so until it shows it, without being asked again.
    if (!around_.robot.watch().is_killed()) command(vehicle::Action::disarm);
    return;
  }
  if (!may_order_now()) return;
  if (order == Order::stand) return command(vehicle::Action::hold);
  go_on();
}

/// Two words for a robot that was killed: the first lets it go, the second has it drive.
void TextPort::go_on() {
  auto& robot = around_.robot;
  if (robot.needs_restart()) return command(vehicle::Action::arm);
  if (robot.is_driving()) return;
  if (!robot.is_connected()) return log_.warn(fmt::format("{} is not heard and cannot start", robot.spec().name));
  if (auto const claimed = around_.authority.claim(robot.id(), commander); !claimed)
    return log_.warn(fmt::format("{} may not start it: {}", commander, claimed.error().message));
  (void)robot.start(fmt::format("normal run by {}", commander), {ExploreStep{"nearest"}, ReturnStep{}});
}

void TextPort::command(vehicle::Action action) {
  std::array const ids{around_.robot.id()};
  auto const number = around_.control.command({.action = action}, ids, commander, false);
  if (!number) return log_.warn(number.error().message);
  auto const& records = around_.control.commands();
  auto const record = std::ranges::find(records, *number, &vehicle::CommandRecord::number);
  if (record == records.end() || record->outcomes.empty()) return;
  auto const& outcome = record->outcomes.front();
  if (outcome.state == vehicle::CommandState::refused)
    log_.warn(fmt::format("{} of {} is refused: {}", to_string(action), commander, outcome.reason));
}

bool TextPort::may_order_now() {
  auto const now = around_.loop.now();
  if (now - orders_since_ >= 1s) {
    orders_since_ = now;
    orders_ = 0;
  }
  return ++orders_ <= most_orders_a_second;
}

void TextPort::complain(link::Peer peer, std::string const& why) {
  ++wrong_lines_;
  auto const now = around_.loop.now();
  if (complained_at_ && now - *complained_at_ < complaint_period) return;
  complained_at_ = now;
  log_.warn(fmt::format("{} line{} of {} not taken: {}", wrong_lines_, wrong_lines_ == 1 ? " is" : "s are",
                        link_->peer_name(peer), why));
  wrong_lines_ = 0;
}

}  // namespace lapwing::robot
