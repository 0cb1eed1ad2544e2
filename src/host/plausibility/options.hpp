#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/error.hpp"
#include "plan/plausibility/settings.hpp"

namespace lapwing::host {

/// `--allow RULE=REASON` and `--limit NAME=VALUE` as they were given.
struct PlausibilityArguments {
  std::vector<std::string> allow;
  std::vector<std::string> limits;
};

void add_plausibility_options(CLI::App& verb, PlausibilityArguments& arguments);

/// What was given, over `settings`. Error: invalid_input.
[[nodiscard]] base::Result<plan::plausibility::Settings> plausibility_of(PlausibilityArguments const& arguments,
                                                                         plan::plausibility::Settings settings = {});

}  // namespace lapwing::host
