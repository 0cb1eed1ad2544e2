#include "onboard/decide/operator_desk.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "autonomy/operator/command_text.hpp"
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

void OperatorDesk::heartbeat(std::string text) {
  (void)server_->send_to_all({.kind = wire::Kind::latest, .text = std::move(text), .key = "heartbeat"});
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
