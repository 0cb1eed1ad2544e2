#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "autonomy/operator/occupancy_map.hpp"
#include "link/operator_link/delivery/peer_session.hpp"

namespace lapwing::onboard {

/// Tells those operators that have asked for it the occupancy map as numbered changes: the whole one first, then what
/// is another one each time. Nothing that an operator has not taken yet piles up: whoever is slow is told less often,
/// and more at once.
class MapPost {
 public:
  using Session = link::operator_link::PeerSession;

  /// From now on, for as long as this connection lasts; the whole map comes next. To be asked again when something was
  /// missed.
  void follow(Session const& session);
  void leave(Session const& session) { readers_.erase(session.peer()); }
  [[nodiscard]] bool is_followed_by(Session const& session) const;

  /// The map as it is now; nothing where there is none.
  void put(std::optional<autonomy::OccupancyMap> const& map);
  /// Tells whoever follows what he does not know yet.
  void tell(Session& session);

  /// Messages that may wait for an operator while he is told of more.
  static constexpr std::uint64_t most_waiting = 4;

 private:
  struct Version {
    autonomy::OccupancyMap map;
    std::uint64_t revision = 0;
  };
  struct Reader {
    std::uint64_t connection = 0;                   ///< the count of them when he asked
    std::shared_ptr<Version const> told = nullptr;  ///< null: not even a whole one
  };

  std::shared_ptr<Version const> newest_ = nullptr;
  std::map<std::string, Reader, std::less<>> readers_;  ///< by the operators' names
};

}  // namespace lapwing::onboard
