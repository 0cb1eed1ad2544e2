#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mavlink/connection/connection.hpp"

/// The mission protocol (https://mavlink.io/en/services/mission.html) from the ground's side: missions, fences and
/// rally points.
///
/// A link that loses much is met with patience; a vehicle that is heard well and has answered nothing for ten seconds
/// is not waited for any longer (timed_out).
namespace lapwing::mavlink {

struct TransferOptions {
  /// Until COUNT or a request is repeated for the first time, at most; later by the measured round trip, longer each
  /// time.
  base::Duration reply_timeout = std::chrono::milliseconds(500);
  int tries = 5;  ///< of one message
  base::Duration silence_limit =
      std::chrono::seconds(8);  ///< an upload in which nothing comes for this long has failed
  int restarts = 2;  ///< how often a transfer that timed out begins anew; the vehicle forgets an upload it gave up
  /// How long altogether a transfer waits for a vehicle that is not heard at all. Once it is heard again an upload
  /// begins anew and a download goes on at the first item that is missing.
  base::Duration outage_limit{};
};

/// What a vehicle holds of one type.
struct HeldPlan {
  std::vector<MissionItem> items;
  /// The vehicle's name for it, changed with every change; 0: it gives none (ArduPilot before 4.7, PX4 before 1.15).
  std::uint32_t opaque_id = 0;
};

/// Called after each step with the number of items that have gone over, and the total.
using TransferProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Replaces what the vehicle holds. Item numbers are set to 0, 1, 2 ... and `type` by the function; on ArduPilot item 0
/// of a mission is the home position. Errors: refused (names the item and the reason), timed_out, those of
/// Connection::send. After an error the vehicle may hold a mixture of old and new items: upload again or clear.
/// Destroying the task before its end sends OPERATION_CANCELLED.
base::Task<base::Result<>> upload_mission(Connection& connection, Address target, std::vector<MissionItem> items,
                                          MissionType type = MissionType::mission, TransferOptions options = {},
                                          TransferProgress progress = {});

/// Some items of a mission, by their numbers: from `first` up to before `end`.
struct ItemRange {
  std::size_t first = 0;
  std::size_t end = 0;
  [[nodiscard]] std::size_t size() const { return end - first; }
};

/// Writes a part of `items` over those that the vehicle holds there; the others, and their number, have to be the same
/// (MISSION_WRITE_PARTIAL_LIST). Not every autopilot can: PX4 stays silent. Errors as above.
base::Task<base::Result<>> upload_part(Connection& connection, Address target, std::vector<MissionItem> items,
                                       ItemRange range, MissionType type = MissionType::mission,
                                       TransferOptions options = {}, TransferProgress progress = {});

/// What the vehicle holds. Only its number is asked for where the vehicle still names it as it named `known`.
/// Errors: refused (also by vehicles without plans of this type), timed_out, those of Connection::send.
base::Task<base::Result<HeldPlan>> download_mission(Connection& connection, Address target,
                                                    MissionType type = MissionType::mission,
                                                    TransferOptions options = {}, TransferProgress progress = {},
                                                    HeldPlan known = {});

base::Task<base::Result<>> clear_mission(Connection& connection, Address target,
                                         MissionType type = MissionType::mission, TransferOptions options = {});

/// One thing in which the vehicle's copy differs from what was sent, for people: "item 3: altitude 40.00 m, sent 35.00
/// m".
using Difference = std::string;

/// Compares a read-back with what was sent, forgiving what ArduPilot normalises when it stores items (item 0 is home;
/// frames 5, 6, 11 become 0, 3, 10; commands without a place get frame 0; altitudes are cut to centimetres; hold times,
/// turns and yaw are rounded or dropped; autocontinue and current are its own). Empty: the vehicle holds the mission.
[[nodiscard]] std::vector<Difference> compare_readback(std::span<MissionItem const> sent,
                                                       std::span<MissionItem const> got, MavAutopilot autopilot);

/// The same for one item, number `index`.
[[nodiscard]] std::vector<Difference> compare_item(std::size_t index, MissionItem const& sent, MissionItem const& got,
                                                   MavAutopilot autopilot);

}  // namespace lapwing::mavlink
