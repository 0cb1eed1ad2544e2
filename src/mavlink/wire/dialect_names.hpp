#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// The names of the dialect (ardupilotmega, with all of common), for those who write messages by hand. Generated at
/// build time from the same XML as the codec's headers.
namespace lapwing::mavlink {

enum class WireType { char_, uint8_, int8_, uint16_, int16_, uint32_, int32_, uint64_, int64_, float_, double_ };

struct FieldName {
  std::string_view name;
  WireType type;
  std::uint16_t offset;  ///< in the payload
  std::uint8_t length;   ///< of an array; 0: a single value
};

struct MessageName {
  std::string_view name;  ///< "COMMAND_LONG"
  std::uint32_t id;
  std::span<FieldName const> fields;
};

/// Nothing for a message that the dialect lacks. Names are in capitals.
[[nodiscard]] std::optional<MessageName> find_message(std::string_view name);
[[nodiscard]] std::vector<std::string_view> message_names();
/// "COMMAND_LONG" for 76; empty for a number that the dialect lacks. Looks through the whole table.
[[nodiscard]] std::string_view message_name(std::uint32_t id);
/// The number of an enumeration's entry: "MAV_CMD_COMPONENT_ARM_DISARM" is 400.
[[nodiscard]] std::optional<std::int64_t> find_enum_entry(std::string_view name);
[[nodiscard]] std::vector<std::string_view> enum_entry_names();

}  // namespace lapwing::mavlink
