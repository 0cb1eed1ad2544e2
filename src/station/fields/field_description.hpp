#pragma once

#include <string>
#include <string_view>

/// What is made of the table of a vehicle's fields for others: types and parsers of the web app, a table of the
/// reference, schemas of the API's description.
namespace lapwing::station::internal {

/// `web/src/lib/wire/vehicle_fields.ts`.
[[nodiscard]] std::string vehicle_types();
/// `web/src/lib/wire/vehicle_parsers.ts`: for each field what reads it, so that what cannot be stays out.
[[nodiscard]] std::string vehicle_parsers();
/// The lines of the table in docs/reference/station-messages.md.
[[nodiscard]] std::string vehicle_table();
/// Schemas of docs/reference/openapi.yaml: of each object among the fields, and `VehicleFields`.
[[nodiscard]] std::string vehicle_schemas();

}  // namespace lapwing::station::internal
