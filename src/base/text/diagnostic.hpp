#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/edit.hpp"
#include "base/text/source.hpp"

/// Messages about texts that people wrote. Readers append to a sink and recover, so that one run shows every mistake.
namespace lapwing::base {

enum class Severity { note, warning, error };

[[nodiscard]] std::string_view to_string(Severity severity);

/// A kind of mistake: programs tell mistakes apart by the code, people look it up by it. A code keeps its meaning.
struct DiagnosticKind {
  std::string_view code;  ///< "unknown-name"
  Severity severity;
  std::string_view meaning;  ///< a sentence for the reference
};

/// A second place that explains the first: "first defined here".
struct DiagnosticNote {
  Span span;
  std::string message;
};

/// What to write instead: the words for people, and the changes that carry them out, so that an editor can: in order of
/// place, without overlap. `fix` is empty where the words leave a choice. A text alone is a hint without a fix.
struct Hint {
  Hint() = default;
  Hint(std::string text) : words(std::move(text)) {}
  Hint(char const* text) : words(text) {}
  Hint(std::string text, std::vector<Edit> edits) : words(std::move(text)), fix(std::move(edits)) {}
  [[nodiscard]] bool empty() const { return words.empty(); }

  std::string words;
  std::vector<Edit> fix;
};

/// "did you mean takeOff?", with the fix that puts the candidate in the place of `word`; or nothing.
[[nodiscard]] Hint did_you_mean(Span place, std::string_view word, std::span<std::string_view const> candidates);

struct Diagnostic {
  Severity severity = Severity::error;
  std::string_view code = {};              ///< of its DiagnosticKind
  Span span;                               ///< what the caret underlines
  std::string message;                     ///< what is wrong, lower case, no full stop
  std::string hint = {};                   ///< what to write instead: "did you mean takeOff?" (may be empty)
  std::vector<DiagnosticNote> notes = {};  ///< further places
  std::vector<Edit> fix = {};              ///< the hint as changes of the text (may be empty)
};

/// One diagnostic with its places worked out, for `--json` and editors. Lines and columns count from 1; the end is
/// exclusive.
struct DiagnosticRecord {
  std::string file;
  LineColumn begin;
  LineColumn end;
  std::string severity;
  std::string message;
  std::string hint;
  std::vector<DiagnosticRecord> notes;
  std::string code;
};

/// Collects what is wrong with one source text. Keeps at most `limit` errors and as many warnings and notes, and counts
/// the rest, so that a hostile input cannot fill memory with complaints. The source must outlive the sink.
class Diagnostics {
 public:
  static constexpr std::size_t default_limit = 100;

  explicit Diagnostics(SourceFile const& source, std::size_t limit = default_limit) : source_(source), limit_(limit) {}

  void report(Diagnostic diagnostic);
  void report(DiagnosticKind const& kind, Span span, std::string message, Hint hint = {},
              std::vector<DiagnosticNote> notes = {});

  [[nodiscard]] SourceFile const& source() const { return source_; }
  [[nodiscard]] std::size_t error_count() const { return errors_; }
  [[nodiscard]] std::size_t warning_count() const { return warnings_; }
  [[nodiscard]] bool has_errors() const { return errors_ > 0; }
  /// Whether an error that was kept begins within `span`.
  [[nodiscard]] bool has_error_within(Span span) const;
  /// How many were counted but not kept.
  [[nodiscard]] std::size_t dropped_count() const { return errors_ + warnings_ + others_ - kept_.size(); }
  /// What was kept, in order of place.
  [[nodiscard]] std::vector<Diagnostic> sorted() const;

 private:
  SourceFile const& source_;
  std::size_t limit_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
  std::size_t others_ = 0;
  std::vector<Diagnostic> kept_;
};

/// One diagnostic as people read it:
///
///     survey.dolphin:35:17: error: surveyAreaNorth is not defined [unknown-name]
///       35 |            then ((surveyAreaNorth / {battery(v1) < 0.3})
///          |                   ^~~~~~~~~~~~~~~ did you mean surveyNorth?
///
/// Tabs widen to multiples of 4; wide characters count one column. A span over several lines is underlined to the end
/// of its first.
[[nodiscard]] std::string render(Diagnostic const& diagnostic, SourceFile const& source);
/// Everything kept, in order of place, and a last line when something was left out.
[[nodiscard]] std::string render(Diagnostics const& diagnostics);

[[nodiscard]] std::vector<DiagnosticRecord> to_records(Diagnostics const& diagnostics);

}  // namespace lapwing::base
