#include "host/plausibility/options.hpp"

#include <utility>

namespace lapwing::host {

void add_plausibility_options(CLI::App& verb, PlausibilityArguments& arguments) {
  verb.add_option(
          "--allow", arguments.allow,
          "RULE=REASON: let pass what a rule of plausibility refuses, e.g. ceiling='permission 17/2026' (may be "
          "repeated)")
      ->allow_extra_args(false);
  verb.add_option("--limit", arguments.limits,
                  "NAME=VALUE: from where on something is implausible, e.g. ceiling=150 (may be repeated)")
      ->allow_extra_args(false);
}

base::Result<plan::plausibility::Settings> plausibility_of(PlausibilityArguments const& arguments,
                                                           plan::plausibility::Settings settings) {
  for (auto const& text : arguments.allow) {
    if (auto added = add_allowance(settings, text); !added) return std::unexpected(added.error());
  }
  for (auto const& text : arguments.limits) {
    if (auto added = add_limit(settings, text); !added) return std::unexpected(added.error());
  }
  return settings;
}

}  // namespace lapwing::host
