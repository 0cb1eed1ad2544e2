#include "host/survey/survey_stop.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using vehicle::StopAction;

struct Case {
  std::string_view state;
  StopAction action;
  std::string_view command;  ///< empty: none is needed
};

TEST(SurveyStop, SaysWhatTheDroneTakesInItsState) {
  auto constexpr land = R"({"Type":"Land"})";
  auto constexpr stay = R"({"Type":"Compulsive Move","X":3.5,"Y":-4})";
  for (auto const& [state, action, command] :
       std::initializer_list<Case>{{"AutonomousExplore", StopAction::hold, stay},
                                   {"AutonomousMove", StopAction::hold, stay},
                                   {"CompulsiveMove", StopAction::hold, stay},
                                   {"Hover", StopAction::hold, ""},
                                   {"NoParkingLotDetected", StopAction::hold, ""},
                                   {"Takeoff", StopAction::hold, land},
                                   {"Land", StopAction::hold, ""},
                                   {"Malfunction", StopAction::hold, ""},
                                   {"Arm", StopAction::hold, R"({"Type":"Disarm"})"},
                                   {"Idle", StopAction::land, R"({"Type":"Disarm"})"},
                                   {"Hover", StopAction::land, land},
                                   {"AutonomousExplore", StopAction::return_home, land},
                                   {"CommunicationLost", StopAction::land, ""},
                                   {"Hover", StopAction::terminate, R"({"Type":"Kill"})"},
                                   {"Land", StopAction::terminate, R"({"Type":"Kill"})"}}) {
    autonomy::report::Heartbeat const heartbeat{
        .state = std::string(state), .is_armed = true, .local = geo::Point<autonomy::ArmingFrame>(3.5, -4)};
    auto const stop = survey_stop(action, heartbeat);
    EXPECT_EQ(stop.command.value_or(""), command) << state;
    EXPECT_EQ(stop.is_done, command.empty()) << state;
    EXPECT_FALSE(stop.detail.empty());
  }
}

TEST(SurveyStop, LeavesADroneThatIsDisarmedAlone) {
  for (auto const action : {StopAction::hold, StopAction::terminate}) {
    auto const stop = survey_stop(action, autonomy::report::Heartbeat{.state = "Idle"});
    EXPECT_FALSE(stop.command);
    EXPECT_TRUE(stop.is_done);
  }
}

TEST(SurveyStop, BringsHomeWhatDoesNotSayWhereItIs) {
  EXPECT_EQ(survey_stop(StopAction::hold, std::nullopt).command, R"({"Type":"Land"})");
  autonomy::report::Heartbeat const blind{.state = "AutonomousExplore", .is_armed = true};
  EXPECT_EQ(survey_stop(StopAction::hold, blind).command, R"({"Type":"Land"})");
}

}  // namespace
}  // namespace lapwing::host
