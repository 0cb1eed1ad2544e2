#include "missions/internal/mission_commands.hpp"

namespace lapwing::missions::internal {
namespace {

using tasks::Argument;
using tasks::Dimension;
using tasks::Parameter;
using tasks::Type;

using base::Result;
using plan::MissionBuilder;
using Arguments = std::span<Argument const>;

Result<> name(MissionBuilder& builder, std::size_t, Arguments arguments) {
  builder.name(text(arguments[0]));
  return {};
}
Result<> speed(MissionBuilder& builder, std::size_t, Arguments arguments) {
  return builder.change_speed(number(arguments[0]), integer(arguments[1]));
}
Result<> altitude(MissionBuilder& builder, std::size_t, Arguments arguments) {
  return builder.change_altitude(number(arguments[0]));
}
Result<> delay(MissionBuilder& builder, std::size_t, Arguments arguments) {
  return builder.delay(number(arguments[0]));
}
Result<> capture_photo(MissionBuilder& builder, std::size_t, Arguments) {
  return builder.capture_photo();
}
Result<> capture_several(MissionBuilder& builder, std::size_t, Arguments arguments) {
  int const count = integer(arguments[0]);
  if (count < 1) return base::fail(base::ErrorKind::invalid_input, "the number of photos must be 1 or more");
  return builder.capture_photos(count, number(arguments[1]));
}
Result<> capture_until_stop(MissionBuilder& builder, std::size_t, Arguments arguments) {
  return builder.capture_photos(0, number(arguments[0]));
}
Result<> stop_capturing(MissionBuilder& builder, std::size_t, Arguments) {
  return builder.stop_capture();
}
Result<> jump(MissionBuilder& builder, std::size_t, Arguments arguments) {
  return builder.jump(integer(arguments[0]), integer(arguments[1]));
}

Parameter whole(std::string_view name, std::string_view doc, std::optional<Argument> fallback = std::nullopt,
                Dimension dimension = Dimension::none) {
  return {.name = name, .type = Type::integer, .dimension = dimension, .fallback = std::move(fallback), .doc = doc};
}
Argument whole_number(std::int64_t value) {
  return value;
}

}  // namespace

std::vector<MissionCommand> other_commands() {
  auto const interval = whole("t", "from one photo to the next", whole_number(2), Dimension::time);
  return {
      {{"name",
        {{{{.name = "s", .type = Type::text, .doc = "what views and plans call the mission"}}}},
        "Names the mission."},
       name},
      {{"speed",
        {{{{.name = "v", .type = Type::number, .dimension = Dimension::speed, .doc = "how fast"},
           whole("type", "0 air speed, 1 ground speed, 2 climb, 3 descent", whole_number(0))}}},
        "Flies at this speed from here on. MAV_CMD_DO_CHANGE_SPEED (178)."},
       speed},
      {{"altitude",
        {{{{.name = "a", .type = Type::number, .dimension = Dimension::length, .doc = "above mean sea level"}}}},
        "Climbs or descends to this altitude. ArduPilot's planes: MAV_CMD_NAV_CONTINUE_AND_CHANGE_ALT (30); others: "
        "a way point at that altitude.",
        {"UAV", "UUV"}},
       altitude},
      {{"delay",
        {{{whole("secs", "how long", std::nullopt, Dimension::time)}}},
        "Waits before the next command. MAV_CMD_NAV_DELAY (93)."},
       delay},
      {{"capturePhoto", {{}}, "Takes one photo. MAV_CMD_IMAGE_START_CAPTURE (2000)."}, capture_photo},
      {{"captureSeveralPhotos",
        {{{whole("n", "how many, 1 or more"), interval}}},
        "Takes photos at an interval. MAV_CMD_IMAGE_START_CAPTURE (2000)."},
       capture_several},
      {{"captureUntilStop",
        {{{interval}}},
        "Takes photos at an interval until stopCapturing. MAV_CMD_IMAGE_START_CAPTURE (2000)."},
       capture_until_stop},
      {{"stopCapturing", {{}}, "Ends captureUntilStop. MAV_CMD_IMAGE_STOP_CAPTURE (2001)."}, stop_capturing},
      {{"jumpToItem",
        {{{whole("item", "its number in the mission; home is 0, the first command 1"),
           whole("reps", "how many times; -1 for ever", whole_number(1))}}},
        "Goes on at another item of the mission. MAV_CMD_DO_JUMP (177)."},
       jump},
  };
}

}  // namespace lapwing::missions::internal
