#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "mavlink/exchange/mission_transfer.hpp"

/// Putting a plan in place of the one that a vehicle holds. No autopilot does that in one step: ArduPilot cuts its
/// mission to the new length and writes over it item by item, so whatever goes wrong leaves a mixture. So the old plan
/// is kept here until the new one was read back.
namespace lapwing::mavlink {

struct ReplaceOptions {
  TransferOptions transfer = {};
  MavAutopilot autopilot{};
  bool verifies = true;   ///< reads back and compares
  bool keeps_old = true;  ///< fetches what the vehicle holds first, to put it back if need be
  int attempts = 4;       ///< at an upload that reads back different
  HeldPlan known = {};    ///< of this vehicle, from before: saves fetching it where opaque ids match
  /// What goes on, for people ("uploading"), and how far it is.
  std::function<void(std::string_view phase, std::size_t done, std::size_t total)> progress = {};
};

/// What the vehicle holds when a replacement has ended, or was given up by destroying its task.
enum class PlanLeft {
  old_one,  ///< nothing was written, or it was put back
  new_one,  ///< and nothing else: it was read back, or need not be
  none,     ///< cleared
  unknown,  ///< perhaps a mixture of both: do not fly it
};
/// "the vehicle still holds its old plan" ...
[[nodiscard]] std::string_view to_string(PlanLeft left);

/// Written while the replacement goes on, so that whoever gives it up knows where it stood.
struct Replacement {
  PlanLeft left = PlanLeft::old_one;
  std::optional<HeldPlan> before;  ///< what the vehicle held
  HeldPlan held;                   ///< what it holds, if `left` is new_one and it was read back
  std::size_t written = 0;         ///< items that went over in the last attempt; 0: the vehicle held the plan already
  base::Duration upload_time{};    ///< of the last attempt
};

/// Uploads `items` (all of them, or where the vehicle can do that the part that changes), reads them back and compares.
/// On failure the old plan is put back if it is known, else the vehicle's is cleared, else `record.left` says that
/// neither was possible; the error tells all of that. Errors: refused, timed_out, lost.
base::Task<base::Result<>> replace_plan(Connection& connection, Address target, std::vector<MissionItem> items,
                                        MissionType type, ReplaceOptions options, Replacement& record);

/// What `replace_plan` does after a failure, for one that was given up in the middle.
base::Task<> undo_replacement(Connection& connection, Address target, MissionType type, ReplaceOptions options,
                              Replacement& record);

}  // namespace lapwing::mavlink
