#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fleet/state/mavlink_vehicle.hpp"
#include "mavlink/exchange/plan_replacement.hpp"
#include "plan/files/plan_file.hpp"

/// The plans of one vehicle, for `lapwing mission`.
namespace lapwing::apps {

/// "mission", "fence", "rally"; "all" are the three.
[[nodiscard]] base::Result<std::vector<mavlink::MissionType>> parse_types(std::string const& text);
[[nodiscard]] std::string_view to_string(mavlink::MissionType type);

/// What became of one of the three lists.
struct ListReport {
  mavlink::MissionType type{};
  std::size_t items = 0;  ///< that the vehicle holds of it
  std::string outcome;    ///< "uploaded", "unchanged", "downloaded", "cleared", "not supported", "failed"
  std::string error = {};
  mavlink::Replacement replacement = {};  ///< of an upload
};

/// "uploading mission 3/20"; the same words while a phase lasts.
using ShowProgress = std::function<void(std::string_view phase, std::size_t done, std::size_t total)>;

/// The lists to upload of a plan, made ready for the vehicle. `lost`: what it cannot be told.
struct UploadList {
  mavlink::MissionType type{};
  std::vector<mavlink::MissionItem> items;
};
struct Uploads {
  std::vector<UploadList> lists;
  std::vector<std::string> lost;
};
/// Only of the types asked for, and of those only what the plan has. Fence and rally points come first, so that they
/// are there before the mission is. Errors: invalid_input when there is nothing, or the vehicle would not fly an item.
[[nodiscard]] base::Result<Uploads> uploads_for(std::string_view file, plan::Plan const& plan,
                                                std::vector<mavlink::MissionType> const& types,
                                                fleet::MavlinkVehicle const& craft);

/// How patient transfers are for a person at a terminal: a link that is gone for up to a minute is waited for.
inline constexpr mavlink::TransferOptions patient_transfer{.tries = 12, .outage_limit = std::chrono::seconds(60)};

/// Uploads one list after the other; the first failure ends it. `reports` grows as they are begun.
base::Task<base::Result<>> upload_lists(fleet::MavlinkVehicle const& craft, std::vector<UploadList> lists,
                                        ShowProgress show, std::vector<ListReport>& reports);
/// Into `plan`. A list that the vehicle does not support is reported, not an error, unless it was the only one wanted.
base::Task<base::Result<>> download_lists(fleet::MavlinkVehicle const& craft, std::vector<mavlink::MissionType> types,
                                          ShowProgress show, plan::Plan& plan, std::vector<ListReport>& reports);
base::Task<base::Result<>> clear_lists(fleet::MavlinkVehicle const& craft, std::vector<mavlink::MissionType> types,
                                       std::vector<ListReport>& reports);

}  // namespace lapwing::apps
