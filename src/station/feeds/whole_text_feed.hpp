#pragma once

#include <string>

#include "station/feeds/feed.hpp"

namespace lapwing::station {

/// A feed of one message that is told whole each time, when its text is another.
class WholeTextFeed : public Feed {
 public:
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) final;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const final;

 private:
  /// The message as it is now.
  [[nodiscard]] virtual std::string text() const = 0;

  std::string message_;
  std::uint64_t revision_ = 0;
};

}  // namespace lapwing::station
