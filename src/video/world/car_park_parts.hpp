#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"
#include "video/world/car_park_file.hpp"

/// What the parts of a world file have in common. For car_park_file.cpp.
namespace lapwing::video {

class WorldParts {
 public:
  explicit WorldParts(base::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void wrong(base::DiagnosticKind const& kind, base::Span span, std::string message, base::Hint hint = {}) {
    diagnostics_.report(kind, span, std::move(message), std::move(hint));
  }
  void missing(base::Span span, std::string_view what, std::string_view key);

  void number(base::ConfigReader& reader, std::string_view key, double low, double high, double& into);
  /// In degrees; kept in radians.
  void angle(base::ConfigReader& reader, std::string_view key, double low_deg, double high_deg, double& into_rad);
  void whole(base::ConfigReader& reader, std::string_view key, int low, int high, int& into);
  [[nodiscard]] std::optional<Spot> spot(base::Placed<base::ConfigReader>& part, std::string_view what);
  [[nodiscard]] std::vector<Spot> spots(base::Placed<base::ConfigReader>& part, std::string_view key,
                                        std::string_view what, std::size_t fewest);
  /// Spots that are the corners of an area.
  [[nodiscard]] std::optional<std::vector<Spot>> corners(base::Placed<base::ConfigReader>& part, std::string_view what);
  void colour(base::ConfigReader& reader, std::string_view key, Colour& into);
  [[nodiscard]] std::string name(base::ConfigReader& reader, std::string_view key, std::string otherwise);
  void numbers_of_slots(base::ConfigReader& reader, std::string_view key, std::set<int>& into);

  /// Calls `read` for each part, and reports what it did not ask for.
  template <class Read>
  void each(base::ConfigReader& reader, std::string_view key, Read const& read) {
    auto found = reader.tables(key);
    if (found.size() > most_parts)
      wrong(car_park_kinds::too_large, found[most_parts].span,
            "there are more than " + std::to_string(most_parts) + " [[" + std::string(key) + "]]");
    for (std::size_t i = 0; i < std::min(found.size(), most_parts); ++i) {
      read(found[i]);
      found[i].value.refuse_unknown();
    }
  }

 private:
  base::Diagnostics& diagnostics_;
};

}  // namespace lapwing::video
