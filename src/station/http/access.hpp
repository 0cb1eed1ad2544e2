#pragma once

#include <optional>
#include <string>
#include <vector>

#include "station/http/http.hpp"

namespace lapwing::station {

/// Who may talk to the server. The web's own dangers are met here: DNS rebinding (a foreign page reaches loopback under
/// its own name), cross-site WebSockets and form posts (a foreign page uses the operator's browser), and a network that
/// is not trusted.
struct AccessPolicy {
  bool loopback_only = true;            ///< bound to loopback: only loopback names may stand in Host
  std::vector<std::string> host_names;  ///< further names under which browsers may reach the server
  std::string token;                    ///< every request for the API or metrics must carry it; empty: none needed
};

/// The answer that refuses the request, or nothing when it may go on.
[[nodiscard]] std::optional<HttpResponse> refusal(AccessPolicy const& policy, HttpRequest const& request);

/// Whether a request that is not refused shows that its sender may command: it carries the token, or none is set.
[[nodiscard]] bool is_trusted(AccessPolicy const& policy, HttpRequest const& request);

/// True for 127.0.0.0/8, ::1 and localhost, without a port.
[[nodiscard]] bool is_loopback_name(std::string_view host);

}  // namespace lapwing::station
