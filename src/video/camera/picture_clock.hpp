#pragma once

#include <optional>

#include "base/time.hpp"

namespace lapwing::video {

/// When pictures were taken, by what their source says of it: how far each lies in the stream. Where the stream begins
/// on the clock on the wall is not said; it is told from the picture that came the soonest, so that those that waited
/// on the way are not taken for younger than they are. What all of them wait, nobody can tell.
class PictureClock {
 public:
  /// Of the next picture. A source that does not tell (its positions do not grow), and one that jumped or stood still,
  /// has the time of arrival.
  [[nodiscard]] base::UtcTime taken(base::Duration position, base::UtcTime arrived);

 private:
  std::optional<base::Duration> position_;  ///< of the picture before
  base::UtcTime begin_;                     ///< of the stream
};

}  // namespace lapwing::video
