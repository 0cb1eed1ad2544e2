#pragma once

#include "map/features/properties.hpp"

/// Times and heights of a track's samples beside the line that it is: as texts, so that a line and its properties are
/// the whole track in any format.
namespace lapwing::map::internal {

[[nodiscard]] PropertyValue get_beginning(Content const& content);
[[nodiscard]] base::Result<> set_beginning(Content& content, PropertyValue const& value);
[[nodiscard]] PropertyValue get_times(Content const& content);
[[nodiscard]] base::Result<> set_times(Content& content, PropertyValue const& value);
[[nodiscard]] PropertyValue get_heights(Content const& content);
[[nodiscard]] base::Result<> set_heights(Content& content, PropertyValue const& value);

}  // namespace lapwing::map::internal
