#include "fleet/plausibility/doubts.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::fleet {

base::Result<> Doubts::heed(plan::plausibility::Findings const& findings, std::string_view subject,
                            base::Logger const& log) {
  auto const* refused = refusal(findings);
  refused_by_ = refused ? std::optional(refused->rule) : std::nullopt;
  for (auto const& finding : findings) {
    if (&finding == refused || !said_.insert(finding.rule).second) continue;
    auto const text = fmt::format("{}: {}", subject, to_text(finding));
    log.warn(finding.allowed_because ? fmt::format("{}: allowed: {}", text, *finding.allowed_because) : text);
  }
  if (!refused) return {};
  auto hint = fmt::format("if it is meant, allow {} by name and with a reason", to_string(refused->rule));
  log.info(fmt::format("{}: {}", subject, hint));
  return base::fail(base::ErrorKind::invalid_input, to_text(*refused), std::move(hint));
}

}  // namespace lapwing::fleet
