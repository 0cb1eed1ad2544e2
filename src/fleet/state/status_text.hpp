#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "vehicle/status_text.hpp"

namespace lapwing::fleet {

/// One STATUSTEXT as it travels: up to 50 characters, longer texts in chunks of one id.
struct TextChunk {
  int severity = 6;
  std::string text;         ///< without padding
  std::uint16_t id = 0;     ///< 0: a whole text by itself
  std::uint8_t number = 0;  ///< position of this chunk in its text
  int component = 1;        ///< who says it: components number their texts independently
};

/// Puts texts together from their chunks (MAVLink guide, STATUSTEXT). A text with a lost chunk is still given out, with
/// "..." for what is missing: half a reason is better than none. Chunks that arrive twice make no second text.
class StatusTexts {
 public:
  /// The text that this chunk made whole, if it did.
  [[nodiscard]] std::vector<vehicle::StatusText> add(TextChunk const& chunk, base::TimePoint now);
  /// The texts whose missing chunks are not coming any more.
  [[nodiscard]] std::vector<vehicle::StatusText> overdue(base::TimePoint now);

 private:
  struct Partial {
    int severity = 6;
    int component = 1;
    bool is_given_out = false;  ///< kept for a while all the same: copies of its chunks may come late
    base::TimePoint last{};
    std::map<std::uint8_t, std::string> chunks;
    [[nodiscard]] bool whole() const;
    [[nodiscard]] vehicle::StatusText joined() const;
  };
  using Key = std::pair<int, std::uint16_t>;  ///< component, id
  std::map<Key, Partial> partial_;
};

}  // namespace lapwing::fleet
