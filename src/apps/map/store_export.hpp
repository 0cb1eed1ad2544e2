#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "base/error.hpp"
#include "map/features/layer_kind.hpp"

namespace lapwing::apps {

/// Parts of `lapwing store`: a store as files of other programs, and which these can be.
void add_export(CLI::App& store, int& exit_code);
void add_formats(CLI::App& store, int& exit_code);

/// Error: invalid_input, with the names that there are.
[[nodiscard]] base::Result<map::LayerKind> layer_called(std::string const& name);

}  // namespace lapwing::apps
