#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "mavlink/exchange/param.hpp"

namespace lapwing::parameters {

using mavlink::Parameter;

/// Which autopilot it is, as far as it says: system ids are given and taken, this stays.
struct Identity {
  std::string uid = {};  ///< hexadecimal; empty: the autopilot tells none, nothing of it is cached
  std::uint32_t firmware = 0;
  std::string custom_version = {};  ///< of its source, hexadecimal
  mavlink::ParamEncoding encoding = mavlink::ParamEncoding::c_cast;
  friend bool operator==(Identity const&, Identity const&) = default;
};

/// What a vehicle's parameters were at one time.
struct CachedParameters {
  std::vector<Parameter> parameters;
  base::UtcTime taken{};  ///< when the vehicle was asked for all of them
  /// PX4's hash of exactly these values; without one nothing tells whether they are still the vehicle's.
  std::optional<std::uint32_t> hash = std::nullopt;
};

/// One file a vehicle and firmware in one folder: QGroundControl's format with two lines of ours above.
class Cache {
 public:
  /// Without a folder nothing is kept.
  explicit Cache(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  /// Nothing when there is none, or none that can be read.
  [[nodiscard]] std::optional<CachedParameters> find(Identity const& identity) const;
  /// Replaces the file as a whole. Error: io. A vehicle without uid is not kept.
  base::Result<> store(Identity const& identity, CachedParameters const& cached) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(Identity const& identity) const;
  std::filesystem::path folder_;
};

/// The text of a cache file, and back. Nothing for a text that is none.
[[nodiscard]] std::string to_text(CachedParameters const& cached);
[[nodiscard]] std::optional<CachedParameters> parse_cached(std::string_view text);

/// $XDG_CACHE_HOME/lapwing/parameters, or below ~/.cache; empty when neither is known.
[[nodiscard]] std::filesystem::path cache_folder(char const* xdg_cache_home, char const* home);

}  // namespace lapwing::parameters
