#include "host/plausibility/reading.hpp"

namespace lapwing::host {

plan::plausibility::Settings read_plausibility(base::ConfigReader table) {
  namespace plausibility = plan::plausibility;
  plausibility::Settings settings;
  for (auto const& limit : plausibility::limit_names()) {
    if (auto const value = table.number(limit.name, limit.least, limit.most))
      (void)set_limit(settings.limits, limit.name, value->value);
  }
  if (auto allow = table.table("allow")) {
    for (auto const name : plausibility::rule_names()) {
      auto const reason = allow->text(name);
      if (!reason) continue;
      auto allowed = plausibility::allowance(name, reason->value);
      if (allowed)
        settings.allowed.insert(*std::move(allowed));
      else
        table.diagnostics().report(base::config_kinds::invalid_value, reason->span, allowed.error().message,
                                   "say why: it is written into the log");
    }
    allow->refuse_unknown();
  }
  table.refuse_unknown();
  return settings;
}

}  // namespace lapwing::host
