#pragma once

#include "station/feeds/whole_text_feed.hpp"
#include "station/messages/survey_messages.hpp"

namespace lapwing::station {

/// What survey drones tell of themselves.
class SurveyFeed final : public WholeTextFeed {
 public:
  /// They outlive it.
  explicit SurveyFeed(vehicle::SurveyDrones const& drones) : drones_(drones) {}

  [[nodiscard]] std::string_view name() const override { return "survey"; }

 private:
  [[nodiscard]] std::string text() const override { return survey_message(drones_.drones()); }

  vehicle::SurveyDrones const& drones_;
};

}  // namespace lapwing::station
