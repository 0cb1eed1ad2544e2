#include "mavlink/wire/raw_message.hpp"

#include <gtest/gtest.h>

#include "mavlink/codec/codec.hpp"
#include "mavlink/wire/dialect_names.hpp"

namespace lapwing::mavlink {
namespace {

constexpr Address self{255, 190};
constexpr Address vehicle{7, 1};

base::Result<Frame> raw(std::string_view name, std::vector<RawField> const& fields) {
  return raw_message(name, fields, self, vehicle);
}
std::string message_of(std::string_view name, std::vector<RawField> const& fields) {
  auto const frame = raw(name, fields);
  if (frame) return "it is made";
  return frame.error().hint.empty() ? frame.error().message : frame.error().message + ": " + frame.error().hint;
}

TEST(RawMessage, IsWhatTheCodecReads) {
  auto const frame = raw("COMMAND_LONG", {{"command", 400}, {"param1", 1}, {"param2", 21196.0}});
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->source, self);
  std::optional<Message> message;
  FrameParser parser;
  parser.feed(serialize(*frame).bytes(), [&message](Frame const& heard) { message = decode(heard); });
  ASSERT_TRUE(message);
  auto const& command = std::get<CommandLong>(*message);
  EXPECT_EQ(command.target, vehicle);
  EXPECT_EQ(command.command, MavCmd::component_arm_disarm);
  EXPECT_EQ(command.params[0], 1.0F);
  EXPECT_EQ(command.params[1], 21196.0F);
  EXPECT_EQ(command.params[2], 0.0F);
}

TEST(RawMessage, TakesNamesOfEntriesForNumbersAndTextsForTexts) {
  auto const command = raw("COMMAND_LONG", {{"command", "MAV_CMD_NAV_LAND"}, {"target_component", 25}});
  ASSERT_TRUE(command);
  EXPECT_EQ(std::get<CommandLong>(*decode(*command)).command, MavCmd::nav_land);
  EXPECT_EQ(std::get<CommandLong>(*decode(*command)).target, (Address{7, 25}));
  auto const set = raw("PARAM_SET", {{"param_id", "RTL_ALT"}, {"param_value", 15}});
  ASSERT_TRUE(set);
  EXPECT_EQ(std::get<ParamSet>(*decode(*set)).name, "RTL_ALT");
}

TEST(RawMessage, ThatIsWrongSaysWhatWasMeant) {
  EXPECT_EQ(message_of("COMAND_LONG", {}), "MAVLink has no message COMAND_LONG: did you mean COMMAND_LONG?");
  EXPECT_EQ(message_of("COMMAND_LONG", {{"comand", 1}}), "COMMAND_LONG has no field comand: did you mean command?");
  EXPECT_EQ(message_of("COMMAND_LONG", {{"command", "MAV_CMD_NAV_LNAD"}}),
            "COMMAND_LONG: MAVLink has no MAV_CMD_NAV_LNAD: did you mean MAV_CMD_NAV_LAND?");
  EXPECT_EQ(message_of("COMMAND_LONG", {{"command", 70000}}), "COMMAND_LONG: 70000 is not what command holds");
  EXPECT_EQ(message_of("COMMAND_LONG", {{"command", 1.5}}), "COMMAND_LONG: 1.5 is not what command holds");
  EXPECT_EQ(message_of("COMMAND_LONG", {{"param1", 1e300}}), "COMMAND_LONG: 1e+300 is not what param1 holds");
  EXPECT_EQ(message_of("COMMAND_LONG", {{"target_system", 1}}), "target_system is the vehicle's: leave it out");
  EXPECT_EQ(message_of("PARAM_SET", {{"param_id", "SEVENTEEN_LETTERS"}}),
            "PARAM_SET: 'SEVENTEEN_LETTERS' is longer than param_id holds (16)");
  EXPECT_EQ(message_of("GPS_INJECT_DATA", {{"data", 1}}),
            "GPS_INJECT_DATA: data is a list of 110 numbers, which cannot be sent");
}

TEST(DialectNames, FitTheTableOfMessages) {
  EXPECT_GT(enum_entry_names().size(), 1000u);
  for (auto const name : message_names()) {
    auto const message = find_message(name);
    ASSERT_TRUE(message);
    auto const* traits = find_traits(message->id);
    ASSERT_TRUE(traits) << name;
    for (auto const& field : message->fields) EXPECT_LT(field.offset, traits->max_size) << name << "." << field.name;
  }
  EXPECT_EQ(find_enum_entry("PRECISION_LAND_MODE_REQUIRED"), 2);
}

}  // namespace
}  // namespace lapwing::mavlink
