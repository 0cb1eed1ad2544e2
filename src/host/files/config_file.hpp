#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/text/diagnostic.hpp"
#include "base/text/source.hpp"
#include "host/files/files.hpp"

namespace lapwing::host {

/// The file's settings as `read(source, diagnostics)` gives them; an error when it has mistakes, all of which have been
/// shown. `reference` is the document that lists the settings.
template <class Read>
[[nodiscard]] auto load_config(std::string const& path, Read read, std::string_view reference)
    -> base::Result<decltype(read(std::declval<base::SourceFile const&>(), std::declval<base::Diagnostics&>()))> {
  auto text = read_script(path);
  if (!text) return std::unexpected(text.error());
  base::SourceFile const source(path, *std::move(text));
  base::Diagnostics diagnostics(source);
  auto config = read(source, diagnostics);
  fmt::print(stderr, "{}", base::render(diagnostics));
  if (!diagnostics.has_errors()) return config;
  return base::fail(
      base::ErrorKind::invalid_input,
      fmt::format("{} has {} mistake{}", path, diagnostics.error_count(), diagnostics.error_count() == 1 ? "" : "s"),
      fmt::format("{} lists every setting", reference));
}

}  // namespace lapwing::host
