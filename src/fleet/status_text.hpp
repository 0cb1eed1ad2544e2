#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::fleet {

/// One STATUSTEXT as it travels: up to 50 characters, longer texts in chunks of one id.
struct TextChunk {
  int severity = 6;
  std::string text;         ///< without padding
  std::uint16_t id = 0;     ///< 0: a whole text by itself
  std::uint8_t number = 0;  ///< position of this chunk in its text
};

/// Puts texts together from their chunks (MAVLink guide, STATUSTEXT). A text with a lost chunk is still given out, with
/// "..." for what is missing: half a reason is better than none.
class StatusTexts {
 public:
  /// The text that this chunk made whole, if it did.
  [[nodiscard]] std::vector<vehicle::StatusText> add(TextChunk const& chunk, base::TimePoint now);
  /// The texts whose missing chunks are not coming any more.
  [[nodiscard]] std::vector<vehicle::StatusText> overdue(base::TimePoint now);

 private:
  struct Partial {
    int severity = 6;
    base::TimePoint last{};
    std::map<std::uint8_t, std::string> chunks;
    [[nodiscard]] bool whole() const;
    [[nodiscard]] vehicle::StatusText joined() const;
  };
  std::map<std::uint16_t, Partial> partial_;
};

}  // namespace lapwing::fleet
