#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/async/notifier.hpp"
#include "base/log.hpp"
#include "mavlink/connection/connection.hpp"
#include "mavlink/exchange/param_list.hpp"
#include "parameters/cache.hpp"
#include "vehicle/parameters.hpp"

namespace lapwing::parameters {

using vehicle::Confirmed;

struct Snapshot {
  std::vector<Parameter> parameters;
  base::UtcTime taken{};
  Confirmed confirmed = Confirmed::by_vehicle;
  Identity identity = {};
};

/// Which values do.
enum class Wanted {
  confirmed,   ///< the vehicle's own: asked for, but for PX4 with an unchanged hash
  cached_too,  ///< older ones if there are any, marked as such
};

/// Parameters of every vehicle on a connection. Nothing is asked of a vehicle until somebody asks here; a single read
/// is a single read.
///
/// Keeps shared links usable: one list at a time on each link, the others wait in turn; a list's requests wait while
/// single parameters are read or set there, and while a mission is transferred. Values that vehicles send unasked
/// correct what is cached; a cache whose number of parameters is not the vehicle's any more is forgotten. Thread-bound;
/// outlives its tasks.
class ParameterService {
 public:
  ParameterService(mavlink::Connection& connection, Cache cache, base::Logger log);
  ParameterService(ParameterService const&) = delete;
  ParameterService& operator=(ParameterService const&) = delete;
  ~ParameterService();

  /// One vehicle of those that have been heard.
  struct VehicleInfo {
    mavlink::Address address{};
    mavlink::MavType type{};
    mavlink::MavAutopilot autopilot{};
  };
  [[nodiscard]] std::vector<VehicleInfo> vehicles() const;

  // Errors of all: lost (no such vehicle heard), and those of mavlink/param.hpp and param_list.hpp.
  [[nodiscard]] base::Task<base::Result<Parameter>> read(std::uint8_t system_id, std::string name);
  [[nodiscard]] base::Task<base::Result<mavlink::ParamChange>> change(std::uint8_t system_id, std::string name,
                                                                      double value);
  [[nodiscard]] base::Task<base::Result<Snapshot>> all(std::uint8_t system_id, Wanted wanted = Wanted::confirmed,
                                                       mavlink::ParamProgress progress = {});

 private:
  struct Vehicle {
    VehicleInfo info;
    std::size_t link = 0;
    base::TimePoint heard{};
    std::optional<Identity> identity;
    bool may_be_another = false;  ///< since `identity` was asked for
    std::optional<CachedParameters> cached;
    bool cache_changed = false;
    bool is_listing = false;
  };
  struct LinkUse {
    int singles = 0;  ///< reads and sets under way
    bool has_list = false;
    base::TimePoint mission_until{};
  };
  class Single;
  class List;

  void receive(mavlink::Received const& received);
  void note_mission(mavlink::Received const& received);
  void correct_cache(Vehicle& vehicle, mavlink::ParamValue const& value);
  void keep(Vehicle& vehicle);
  [[nodiscard]] base::Result<Vehicle*> find(std::uint8_t system_id);
  base::Task<> identify(Vehicle& vehicle);
  base::Task<bool> hash_is(Vehicle& vehicle, std::uint32_t hash);
  [[nodiscard]] mavlink::ParamOptions options_for(Vehicle const& vehicle) const;

  mavlink::Connection& connection_;
  Cache cache_;
  base::Logger log_;
  std::map<std::uint8_t, Vehicle> vehicles_;  // a map: references to vehicles stay good
  std::map<std::size_t, LinkUse> links_;
  base::Notifier list_ended_;
  mavlink::Subscription subscription_;
};

/// "4.6.0" of AutopilotVersion::flight_sw_version.
[[nodiscard]] std::string firmware_text(std::uint32_t version);

}  // namespace lapwing::parameters
