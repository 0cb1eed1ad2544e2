#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/text/diagnostic.hpp"
#include "missions/vocabulary.hpp"
#include "require.hpp"

/// What the targets that read scripts share.
namespace lapwing::fuzz {

inline std::string text_of(std::uint8_t const* data, std::size_t size) {
  return {data, data + size};
}

inline tasks::Vocabulary const& vocabulary() {
  static tasks::Vocabulary const words = missions::vocabulary();
  return words;
}

/// Diagnostics can be shown to people and programs, and speak of places that are in the script.
inline void require_presentable(base::Diagnostics const& diagnostics) {
  auto const length = diagnostics.source().text().size();
  for (auto const& one : diagnostics.sorted()) {
    require(one.span.begin <= one.span.end && one.span.end <= length && !one.message.empty());
    for (auto const& note : one.notes) require(note.span.begin <= note.span.end && note.span.end <= length);
  }
  for (auto const& record : base::to_records(diagnostics)) {
    require(record.begin.line >= 1 && record.begin.column >= 1 && record.end.line >= record.begin.line);
  }
  require(base::render(diagnostics).empty() != diagnostics.has_errors() || !diagnostics.has_errors());
}

}  // namespace lapwing::fuzz
