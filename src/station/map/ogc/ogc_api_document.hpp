#pragma once

#include <string>

#include "station/messages/feed_json.hpp"

namespace lapwing::station {

/// What is under /ogc, as OpenAPI 3.0 for GIS programs, with the filters of each layer from the table of properties.
/// The whole API is described in docs/reference/openapi.yaml. For .cpp files.
[[nodiscard]] Json ogc_api_document(std::string const& origin);

}  // namespace lapwing::station
