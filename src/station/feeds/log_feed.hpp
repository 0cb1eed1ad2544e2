#pragma once

#include <memory>
#include <utility>

#include "station/feeds/feed.hpp"
#include "station/messages/log_history.hpp"

namespace lapwing::station {

/// The log, as `log` messages: a viewer that missed lines is sent those that the history still has.
class LogFeed final : public Feed {
 public:
  explicit LogFeed(std::shared_ptr<LogHistory const> history) : history_(std::move(history)) {}

  [[nodiscard]] std::string_view name() const override { return "log"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  std::shared_ptr<LogHistory const> history_;
  std::uint64_t revision_ = 1;  ///< one more than the last line's number
};

}  // namespace lapwing::station
