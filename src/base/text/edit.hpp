#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/text/source.hpp"

namespace lapwing::base {

/// One change of a text: `replacement` in the place of `span`. An empty span inserts.
struct Edit {
  Span span;
  std::string replacement;
  friend bool operator==(Edit const&, Edit const&) = default;
};

/// The part `within` of the text after all edits in it; they stand in order of place and do not overlap.
[[nodiscard]] std::string applied(std::string_view text, std::span<Edit const> edits, Span within);
/// The whole text after the edits.
[[nodiscard]] std::string applied(std::string_view text, std::span<Edit const> edits);

}  // namespace lapwing::base
