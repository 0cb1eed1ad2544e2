#pragma once

#include <string_view>

namespace lapwing::station {

/// docs/reference/openapi.yaml as it was when the program was built.
[[nodiscard]] std::string_view openapi_description();

}  // namespace lapwing::station
