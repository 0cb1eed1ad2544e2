#pragma once

#include <optional>
#include <vector>

#include "base/config.hpp"
#include "route/router.hpp"

namespace lapwing::route {

/// A router as its file describes it: docs/reference/router-config.md.
struct RouterConfig {
  Router::Options options = {};
  std::optional<int> metrics_port = std::nullopt;
  std::vector<EndpointOptions> endpoints = {};
};

/// Reads the file's text. Everything wrong is reported; the result is to be used only when nothing was.
[[nodiscard]] RouterConfig read_router_config(base::SourceFile const& source, base::Diagnostics& diagnostics);

/// One endpoint's table, which stands at `span`. Other keys than an endpoint has are reported.
[[nodiscard]] EndpointOptions read_endpoint(base::Placed<base::ConfigReader> table);

}  // namespace lapwing::route
