#include "onboard/decide/operator_desk.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "autonomy/operator/command_text.hpp"
#include "autonomy/operator/map_request.hpp"
#include "autonomy/operator/report_text.hpp"

namespace lapwing::onboard {

namespace wire = link::operator_link;

base::Result<std::unique_ptr<OperatorDesk>> OperatorDesk::open(base::Loop& loop, wire::ServeSettings settings,
                                                               base::Logger log) {
  std::unique_ptr<OperatorDesk> desk(
      new OperatorDesk(loop, std::move(log), settings.server.end.mode == wire::Mode::json));
  auto server = wire::serve(loop, std::move(settings),
                            {.arrived = {}, .event = [raw = desk.get()](wire::Event event) { raw->note(event); }});
  if (!server) return std::unexpected(server.error());
  desk->server_ = *std::move(server);
  return desk;
}

void OperatorDesk::note(wire::Event const& event) {
  auto const text = fmt::format("operator {}: {}{}{}", event.peer, wire::to_string(event.kind),
                                event.text.empty() ? "" : ", ", event.text);
  if (event.kind == wire::EventKind::connected)
    log_.info(text);
  else
    log_.warn(text);
  if (event.kind == wire::EventKind::connected && !slots_.empty()) loop_.post([this] { slots(slots_); });
  if (event.kind == wire::EventKind::malformed && is_plain_) malformed_.push_back(event.text);
}

std::vector<autonomy::Command> OperatorDesk::take_commands() {
  std::vector<autonomy::Command> commands;
  for (auto const& fault : std::exchange(malformed_, {})) tell(fmt::format("what came is no message: {}", fault));
  for (auto* const session : server_->sessions()) {
    while (auto const message = session->take()) {
      if (is_map_request(*session, message->text)) continue;
      auto command = autonomy::parse_command(message->text);
      if (command) {
        log_.info(fmt::format("{} commands {}", session->peer(), autonomy::name_of(*command)));
        commands.push_back(*std::move(command));
        continue;
      }
      log_.warn(fmt::format("{} sent no command: {}", session->peer(), command.error().message));
      (void)session->send({.text = autonomy::error_log_text(command.error())});
    }
  }
  return commands;
}

autonomy::OperatorLink OperatorDesk::link() const {
  auto const now = loop_.now();
  autonomy::OperatorLink link;
  auto heard = began_;
  for (auto const* const session : server_->sessions()) {
    link.is_up = link.is_up || session->is_connected();
    // JSON mode has no pings: TCP finds out who has gone.
    auto const of_plain = session->is_connected() ? now : session->last_connected();
    heard = std::max(heard, is_plain_ ? of_plain : session->last_heard());
  }
  link.silence = now - heard;
  return link;
}

bool OperatorDesk::is_map_request(wire::PeerSession& session, std::string const& text) {
  auto const request = autonomy::parse_map_request(text);
  if (!request) return false;
  if (!*request) {
    log_.warn(fmt::format("{} sent no request: {}", session.peer(), request->error().message));
    (void)session.send({.text = autonomy::error_log_text(request->error())});
  } else if (**request == autonomy::MapRequest::as_changes) {
    map_post_.follow(session);
  } else {
    map_post_.leave(session);
  }
  return true;
}

void OperatorDesk::heartbeat(autonomy::Said const& said, autonomy::Told const& told,
                             std::optional<autonomy::OccupancyMap> const& map) {
  map_post_.put(map);
  // A map of a whole lot is many times as long as the rest: it is written for those alone that want it.
  std::optional<std::string> with_map;
  std::optional<std::string> without_map;
  for (auto* const session : server_->sessions()) {
    bool const follows = map_post_.is_followed_by(*session);
    auto& text = follows ? without_map : with_map;
    if (!text) {
      auto made = autonomy::heartbeat_text(said, told, follows ? std::nullopt : map);
      if (!made) continue;
      text = *std::move(made);
    }
    (void)session->send({.kind = wire::Kind::latest, .text = *text, .key = "heartbeat"});
    if (follows) map_post_.tell(*session);
  }
}

void OperatorDesk::slots(std::string text) {
  if (is_plain_) return;
  slots_ = std::move(text);
  (void)server_->send_to_all({.kind = wire::Kind::latest, .text = slots_, .key = "slots"});
}

void OperatorDesk::tell(std::string const& words) {
  auto const unsent = server_->send_to_all({.text = autonomy::error_log_text(words)});
  if (unsent > 0) log_.warn(fmt::format("{} operators could not be told: {}", unsent, words));
}

}  // namespace lapwing::onboard
