#pragma once

#include <filesystem>

#include "station/http/http.hpp"

namespace lapwing::station {

/// The file below `root` that `request.path` names ("/" means index.html), with its content type and cache headers; 304
/// when the browser has it already. Never leaves `root`: no "..", no hidden names, no links to the outside. 404
/// otherwise.
///
/// Files below /assets/ have a hash in their names (Vite), so browsers may keep them for good; all others are asked for
/// anew.
[[nodiscard]] HttpResponse static_file(std::filesystem::path const& root, HttpRequest const& request);

}  // namespace lapwing::station
