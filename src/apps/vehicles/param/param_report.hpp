#pragma once

#include <string>
#include <vector>

#include "mavlink/wire/system_name.hpp"
#include "parameters/comparison.hpp"
#include "parameters/service.hpp"

/// What `lapwing param` tells, for people and as JSON.
namespace lapwing::apps {

/// The parameters of one vehicle, or some of them.
struct ParamListing {
  mavlink::SystemName vehicle = {};
  std::string firmware = {};  ///< "4.6.0"; empty: not asked for
  parameters::Confirmed confirmed = parameters::Confirmed::by_vehicle;
  base::UtcTime taken{};
  std::vector<parameters::Parameter> parameters = {};
  std::vector<std::string> errors = {};  ///< of parameters that could not be read
};

/// What became of values that were to be set on one vehicle.
struct ParamChanges {
  struct Failure {
    std::string name;
    std::string message;
  };
  mavlink::SystemName vehicle = {};
  std::vector<mavlink::ParamChange> changed = {};
  std::size_t unchanged = 0;              ///< had the value already
  std::vector<std::string> skipped = {};  ///< belong to one vehicle
  std::vector<Failure> failed = {};
};

[[nodiscard]] std::string listing_text(std::vector<ParamListing> const& listings);
[[nodiscard]] std::string listing_json(std::vector<ParamListing> const& listings);
[[nodiscard]] std::string changes_text(std::vector<ParamChanges> const& changes);
[[nodiscard]] std::string changes_json(std::vector<ParamChanges> const& changes);
/// `first` and `second` name what was compared.
[[nodiscard]] std::string differences_text(std::string const& first, std::string const& second,
                                           std::vector<parameters::Difference> const& differences);
[[nodiscard]] std::string differences_json(std::string const& first, std::string const& second,
                                           std::vector<parameters::Difference> const& differences);

}  // namespace lapwing::apps
