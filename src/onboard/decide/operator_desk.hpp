#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/interface/command.hpp"
#include "autonomy/interface/said.hpp"
#include "autonomy/interface/told.hpp"
#include "autonomy/operator/occupancy_map.hpp"
#include "base/async/loop.hpp"
#include "base/log.hpp"
#include "link/operator_link/endpoints.hpp"
#include "onboard/decide/map_post.hpp"

namespace lapwing::onboard {

/// Where operators connect: their commands come in, heartbeats and messages go out (docs/reference/operation-states.md
/// has what, docs/reference/operator-link.md how). Several may be connected; each hears everything, and the commands of
/// all count.
class OperatorDesk {
 public:
  /// Errors: those of `operator_link::serve`.
  [[nodiscard]] static base::Result<std::unique_ptr<OperatorDesk>> open(base::Loop& loop,
                                                                        link::operator_link::ServeSettings settings,
                                                                        base::Logger log);
  OperatorDesk(OperatorDesk const&) = delete;
  OperatorDesk& operator=(OperatorDesk const&) = delete;

  /// All that came since the last call, in order. Who sent what is no command is told so.
  [[nodiscard]] std::vector<autonomy::Command> take_commands();
  /// Silence counts from the start of this on, so that an operator has time to connect again to a process that was
  /// started anew in flight.
  [[nodiscard]] autonomy::OperatorLink link() const;

  /// With the map to everybody but those that are told of its changes.
  void heartbeat(autonomy::Said const& said, autonomy::Told const& told,
                 std::optional<autonomy::OccupancyMap> const& map);
  /// To everybody, and to who connects later; not in JSON mode, whose old programs know two kinds of messages.
  void slots(std::string text);
  /// An ErrorLog to everybody; waits for those who are away.
  void tell(std::string const& words);
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }

 private:
  OperatorDesk(base::Loop& loop, base::Logger log, bool is_plain)
      : loop_(loop), log_(std::move(log)), is_plain_(is_plain), began_(loop.now()) {}
  void note(link::operator_link::Event const& event);
  /// Whether it was about how the operator wants the map.
  [[nodiscard]] bool is_map_request(link::operator_link::PeerSession& session, std::string const& text);

  base::Loop& loop_;
  base::Logger log_;
  bool is_plain_;
  base::TimePoint began_;
  MapPost map_post_;
  std::string slots_;                   ///< as they were told last
  std::vector<std::string> malformed_;  ///< in JSON mode: to be answered
  std::unique_ptr<link::operator_link::Server> server_;
};

}  // namespace lapwing::onboard
