#pragma once

#include <string>

#include <ogr_feature.h>

#include "base/error.hpp"
#include "base/time.hpp"
#include "map/features/properties.hpp"

/// Property values as fields of GIS files.
namespace lapwing::formats::internal {

/// Whether a format keeps times as times, or as text (ISO 8601, UTC).
enum class Times { as_times, as_text };

/// Adds a field of that name and kind.
void define(OGRFeatureDefn& definition, std::string const& name, map::PropertyKind kind, Times times);
/// Precondition: the field was defined for this kind. Nothing stays null.
void write_field(OGRFeature& feature, int field, map::PropertyValue const& value, Times times);
/// Nothing for a null field or empty text of another kind. Files from elsewhere keep numbers and times as text: these
/// are read as what they shall be. Error, invalid_input: "`height_m` is \"tall\", not a number".
[[nodiscard]] base::Result<map::PropertyValue> read_field(OGRFeature const& feature, int field, map::PropertyKind kind);

/// "2026-11-22T20:49:57.123Z", to the millisecond, which is what these files keep.
[[nodiscard]] std::string time_text(base::UtcTime time);
/// Error, invalid_input: no such time.
[[nodiscard]] base::Result<base::UtcTime> time_from(std::string const& text);

}  // namespace lapwing::formats::internal
