#include "base/text/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text/spelling.hpp"

namespace lapwing::base {

namespace {

constexpr std::size_t tab_width = 4;

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
}

/// A source line as it is printed: tabs widened, control characters made visible; knows the printed column of each
/// byte.
struct PrintedLine {
  std::string text;
  std::vector<std::size_t> columns;  ///< one for each byte, and one for the end
};

PrintedLine printed(std::string_view line) {
  PrintedLine out;
  std::size_t column = 0;
  for (char const c : line) {
    if (continues_character(c)) {
      out.columns.push_back(column == 0 ? 0 : column - 1);
      out.text += c;
      continue;
    }
    out.columns.push_back(column);
    auto const width = c == '\t' ? tab_width - column % tab_width : 1;
    if (c == '\t') {
      out.text.append(width, ' ');
    } else {
      out.text += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    }
    column += width;
  }
  out.columns.push_back(column);
  return out;
}

/// Long lines (generated or hostile ones) are shown as the part round the mistake.
constexpr std::uint32_t max_bytes_before = 100;
constexpr std::uint32_t max_bytes_shown = 160;

Span shown_part(SourceFile const& source, Span line, std::uint32_t at) {
  if (line.size() <= max_bytes_shown) return line;
  auto begin = at > line.begin + max_bytes_before ? at - max_bytes_before : line.begin;
  auto end = std::min(line.end, begin + max_bytes_shown);
  auto const text = source.text();
  while (begin < at && continues_character(text[begin])) ++begin;
  while (end < line.end && continues_character(text[end])) ++end;
  return {begin, end};
}

std::string underlined(SourceFile const& source, Span span, std::string_view remark) {
  auto const place = source.place(span.begin);
  auto const line = source.line_span(place.line);
  auto const begin = std::clamp(span.begin, line.begin, line.end);
  auto const part = shown_part(source, line, begin);
  auto const end = std::clamp(span.end, begin, part.end);
  auto const shown = printed(source.text(part));
  auto const from = shown.columns[begin - part.begin];
  auto const to = std::max(shown.columns[end - part.begin], from + 1);
  auto caret = std::string(from, ' ') + '^' + std::string(to - from - 1, '~');
  if (!remark.empty()) caret += fmt::format(" {}", remark);
  return fmt::format("{:5} | {}\n      | {}\n", place.line, shown.text, caret);
}

std::string headline(SourceFile const& source, Span span, std::string_view severity, std::string_view message) {
  auto const place = source.place(span.begin);
  return fmt::format("{}:{}:{}: {}: {}\n", source.name(), place.line, place.column, severity, message);
}

DiagnosticRecord record(SourceFile const& source, Span span, Severity severity, std::string message) {
  DiagnosticRecord out;
  out.file = source.name();
  out.begin = source.place(span.begin);
  out.end = source.place(span.end);
  out.severity = to_string(severity);
  out.message = std::move(message);
  return out;
}

}  // namespace

std::string_view to_string(Severity severity) {
  switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
  }
  return "error";
}

Hint did_you_mean(Span place, std::string_view word, std::span<std::string_view const> candidates) {
  auto found = closest(word, candidates);
  if (!found) return {};
  return {fmt::format("did you mean {}?", *found), {{place, *std::move(found)}}};
}

void Diagnostics::report(Diagnostic diagnostic) {
  auto& count = diagnostic.severity == Severity::error     ? errors_
                : diagnostic.severity == Severity::warning ? warnings_
                                                           : others_;
  if (++count <= limit_) kept_.push_back(std::move(diagnostic));
}

void Diagnostics::report(DiagnosticKind const& kind, Span span, std::string message, Hint hint,
                         std::vector<DiagnosticNote> notes) {
  report({kind.severity, kind.code, span, std::move(message), std::move(hint.words), std::move(notes),
          std::move(hint.fix)});
}

bool Diagnostics::has_error_within(Span span) const {
  return std::ranges::any_of(kept_, [span](Diagnostic const& diagnostic) {
    return diagnostic.severity == Severity::error && span.contains(diagnostic.span.begin);
  });
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::vector<std::size_t> order(kept_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(kept_[i].span.begin, i); });
  std::vector<Diagnostic> out;
  for (auto const i : order) out.push_back(kept_[i]);
  return out;
}

std::string render(Diagnostic const& diagnostic, SourceFile const& source) {
  auto const code = diagnostic.code.empty() ? "" : fmt::format(" [{}]", diagnostic.code);
  auto out = headline(source, diagnostic.span, to_string(diagnostic.severity), diagnostic.message + code) +
             underlined(source, diagnostic.span, diagnostic.hint);
  for (auto const& note : diagnostic.notes) {
    out += headline(source, note.span, "note", note.message) + underlined(source, note.span, {});
  }
  return out;
}

std::string render(Diagnostics const& diagnostics) {
  std::string out;
  auto const kept = diagnostics.sorted();
  for (auto const& diagnostic : kept) out += render(diagnostic, diagnostics.source());
  if (auto const dropped = diagnostics.dropped_count(); dropped > 0) out += fmt::format("... and {} more\n", dropped);
  return out;
}

std::vector<DiagnosticRecord> to_records(Diagnostics const& diagnostics) {
  std::vector<DiagnosticRecord> out;
  auto const& source = diagnostics.source();
  for (auto const& diagnostic : diagnostics.sorted()) {
    auto& made = out.emplace_back(record(source, diagnostic.span, diagnostic.severity, diagnostic.message));
    made.hint = diagnostic.hint;
    made.code = diagnostic.code;
    for (auto const& note : diagnostic.notes) {
      made.notes.push_back(record(source, note.span, Severity::note, note.message));
    }
  }
  return out;
}

}  // namespace lapwing::base
