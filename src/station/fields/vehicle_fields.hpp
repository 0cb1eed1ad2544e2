#pragma once

#include "station/fields/field_visitor.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::station::internal {

/// Shows every field of a vehicle that the station tells: the one table of them. Types and parsers of the web app and
/// the table in docs/reference/station-messages.md are made of it (`station_fields write`), so that a new field is a
/// line here, and its panel there.
void vehicle_fields(FieldVisitor& visitor, vehicle::VehicleState const& state);

}  // namespace lapwing::station::internal
