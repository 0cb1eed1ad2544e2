#include "lsp/translate.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lapwing::lsp {

namespace {

using dolphin::CompletionKind;
using dolphin::SymbolKind;

Json position_json(Position position) {
  return {{"line", position.line}, {"character", position.character}};
}

int severity(base::Severity severity) {
  switch (severity) {
    case base::Severity::error: return 1;
    case base::Severity::warning: return 2;
    case base::Severity::note: return 3;
  }
  return 1;
}

/// CompletionItemKind
int completion_kind(CompletionKind kind) {
  switch (kind) {
    case CompletionKind::variable: return 6;
    case CompletionKind::function:
    case CompletionKind::instruction: return 3;
    case CompletionKind::block: return 9;
    case CompletionKind::command:
    case CompletionKind::method: return 2;
    case CompletionKind::keyword: return 14;
    case CompletionKind::property: return 10;
    case CompletionKind::unit: return 11;
    case CompletionKind::constant: return 21;
    case CompletionKind::type: return 7;
    case CompletionKind::value: return 12;
  }
  return 1;
}

Json markdown(std::string const& text) {
  return {{"kind", "markdown"}, {"value", text}};
}

Json completion_item(dolphin::CompletionItem const& item, Json const& range, bool with_snippets) {
  bool const is_snippet = with_snippets && !item.snippet.empty();
  auto const& plain = item.insert.empty() ? item.label : item.insert;
  Json out{{"label", item.label},
           {"kind", completion_kind(item.kind)},
           {"sortText", fmt::format("{}{}", item.rank, item.label)},
           {"insertTextFormat", is_snippet ? 2 : 1},
           {"textEdit", {{"range", range}, {"newText", is_snippet ? item.snippet : plain}}}};
  if (!item.detail.empty()) out["detail"] = item.detail;
  if (!item.markdown.empty()) out["documentation"] = markdown(item.markdown);
  return out;
}

/// One edit that puts `now` in the place of `part`, without what both have in common at begin and end.
Json edit_of(base::SourceFile const& source, base::Span part, std::string_view now) {
  auto const old = source.text(part);
  if (old == now) return Json::array();
  auto const is_inside_character = [](std::string_view text, std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0u) == 0x80u;
  };
  auto const shorter = std::min(old.size(), now.size());
  std::size_t begin = 0;
  while (begin < shorter && old[begin] == now[begin]) ++begin;
  while (begin > 0 && (is_inside_character(old, begin) || old[begin - 1] == '\r')) --begin;
  std::size_t tail = 0;
  while (tail < shorter - begin && old[old.size() - tail - 1] == now[now.size() - tail - 1]) ++tail;
  while (tail > 0 && (is_inside_character(old, old.size() - tail) || old[old.size() - tail] == '\n')) --tail;
  base::Span const changed{part.begin + static_cast<std::uint32_t>(begin), part.end - static_cast<std::uint32_t>(tail)};
  Positions positions(source);
  return {{{"range", range(changed, positions)}, {"newText", now.substr(begin, now.size() - tail - begin)}}};
}

/// The lines that hold something.
std::vector<base::Span> written_lines(base::SourceFile const& source) {
  std::vector<base::Span> out;
  for (std::uint32_t line = 1; line <= source.line_count(); ++line) {
    auto const span = source.line_span(line);
    if (source.text(span).find_first_not_of(" \t\f\v") != std::string_view::npos) out.push_back(span);
  }
  return out;
}

/// "Change to takeOff", "Insert .percent": what a click will do to the text.
std::string title_of(base::Diagnostic const& one, base::SourceFile const& source) {
  auto const trimmed = [](std::string_view text) {
    auto const begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return std::string_view();
    return text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
  };
  auto const changed = base::Span{one.fix.front().span.begin, one.fix.back().span.end};
  auto const result = base::applied(source.text(), one.fix, changed);
  constexpr std::size_t longest = 60;
  if (trimmed(result).empty()) return fmt::format("Remove {}", trimmed(source.text(changed)));
  if (changed.size() == 0) return fmt::format("Insert {}", trimmed(result));
  if (result.size() <= longest && !result.contains('\n')) return fmt::format("Change to {}", trimmed(result));
  auto words = one.hint.empty() ? one.message : one.hint;
  if (words[0] >= 'a' && words[0] <= 'z') words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

constexpr std::uint32_t definition_bit = 1;
constexpr std::uint32_t built_in_bit = 2;

/// Appends tokens relative to the one before, as LSP wants them.
class TokenEncoder {
 public:
  explicit TokenEncoder(base::SourceFile const& source) : source_(source), positions_(source) {}

  void add(dolphin::SemanticToken const& token) {
    auto const first = source_.line(token.span.begin);
    auto const last = source_.line(token.span.end);
    for (auto line = first; line <= last; ++line) {
      auto const whole = source_.line_span(line);
      add(token, {std::max(whole.begin, token.span.begin), std::min(whole.end, token.span.end)});
    }
  }
  [[nodiscard]] Json take() { return std::move(data_); }

 private:
  void add(dolphin::SemanticToken const& token, base::Span part) {
    if (part.end <= part.begin) return;
    auto const begin = positions_.of(part.begin);
    auto const end = positions_.of(part.end);
    data_.push_back(begin.line - last_.line);
    data_.push_back(begin.line == last_.line ? begin.character - last_.character : begin.character);
    data_.push_back(end.character - begin.character);
    data_.push_back(static_cast<int>(token.type));
    data_.push_back((token.is_definition ? definition_bit : 0u) | (token.is_built_in ? built_in_bit : 0u));
    last_ = begin;
  }

  base::SourceFile const& source_;
  Positions positions_;
  Position last_;
  Json data_ = Json::array();
};

}  // namespace

Json range(base::Span span, Positions& positions) {
  auto const begin = positions.of(span.begin);
  return {{"start", position_json(begin)}, {"end", position_json(positions.of(span.end))}};
}

Json location(std::string const& uri, base::Span span, Positions& positions) {
  return {{"uri", uri}, {"range", range(span, positions)}};
}

Json quick_fix(base::Diagnostic const& one, std::string const& uri, base::SourceFile const& source) {
  Positions positions(source);
  auto edits = Json::array();
  for (auto const& edit : one.fix) {
    edits.push_back({{"range", range(edit.span, positions)}, {"newText", edit.replacement}});
  }
  Json changes;
  changes[uri] = std::move(edits);
  return {{"title", title_of(one, source)},
          {"kind", "quickfix"},
          {"isPreferred", true},
          {"diagnostics", {diagnostic(one, uri, positions)}},
          {"edit", {{"changes", std::move(changes)}}}};
}

Json diagnostic(base::Diagnostic const& one, std::string const& uri, Positions& positions) {
  Json out{{"range", range(one.span, positions)},
           {"severity", severity(one.severity)},
           {"source", "lapwing"},
           {"message", one.hint.empty() ? one.message : fmt::format("{}\n{}", one.message, one.hint)}};
  if (!one.code.empty()) out["code"] = one.code;
  if (one.code == "unreachable-code") out["tags"] = {1};
  if (one.code == "legacy-spelling") out["tags"] = {2};
  for (auto const& note : one.notes) {
    out["relatedInformation"].push_back({{"location", location(uri, note.span, positions)}, {"message", note.message}});
  }
  return out;
}

Json hover_result(dolphin::Hover const& hover, Positions& positions) {
  return {{"contents", markdown(hover.markdown)}, {"range", range(hover.span, positions)}};
}

Json completion_result(dolphin::Completion const& completion, Positions& positions, bool with_snippets) {
  auto const replaced = range(completion.replaced, positions);
  auto items = Json::array();
  for (auto const& item : completion.items) items.push_back(completion_item(item, replaced, with_snippets));
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

Json signature_result(dolphin::SignatureHelp const& help) {
  auto signatures = Json::array();
  for (auto const& one : help.signatures) {
    auto parameters = Json::array();
    for (std::size_t i = 0; i < one.call.parameters.size(); ++i) {
      auto const span = one.call.parameters[i];
      Json parameter{{"label", one.call.text.substr(span.begin, span.size())}};
      if (i < one.parameter_docs.size() && !one.parameter_docs[i].empty())
        parameter["documentation"] = one.parameter_docs[i];
      parameters.push_back(std::move(parameter));
    }
    Json signature{{"label", one.call.text}, {"parameters", std::move(parameters)}};
    if (!one.doc.empty()) signature["documentation"] = markdown(one.doc);
    signatures.push_back(std::move(signature));
  }
  return {{"signatures", std::move(signatures)},
          {"activeSignature", help.active_signature},
          {"activeParameter", help.active_parameter}};
}

Json symbol_result(dolphin::Symbol const& symbol, Positions& positions) {
  return {{"name", symbol.name},
          {"detail", symbol.detail},
          {"kind", symbol_kind(symbol.kind)},
          {"range", range(symbol.span, positions)},
          {"selectionRange", range(symbol.name_span, positions)}};
}

Json semantic_result(std::vector<dolphin::SemanticToken> const& tokens, base::SourceFile const& source) {
  TokenEncoder encoder(source);
  for (auto const& token : tokens) encoder.add(token);
  return {{"data", encoder.take()}};
}

/// LSP's SymbolKind
int symbol_kind(SymbolKind kind) {
  switch (kind) {
    case SymbolKind::function: return 12;
    case SymbolKind::mission: return 5;
    case SymbolKind::vehicles: return 18;
    case SymbolKind::task: return 24;
    case SymbolKind::variable: return 13;
  }
  return 13;
}

Json fold_result(dolphin::Fold const& fold) {
  Json out{{"startLine", fold.first}, {"endLine", fold.last}};
  if (fold.kind == dolphin::FoldKind::comment) out["kind"] = "comment";
  if (fold.kind == dolphin::FoldKind::region) out["kind"] = "region";
  return out;
}

Json inlay_hint_result(dolphin::InlayHint const& hint, Positions& positions) {
  constexpr int parameter = 2;
  bool const is_name = hint.kind == dolphin::InlayHint::Kind::parameter;
  Json out{{"position", position_json(positions.of(hint.offset))}, {"label", hint.text}, {"paddingRight", is_name}};
  if (is_name) out["kind"] = parameter;
  return out;
}

base::Result<base::Span> span_of(Json const& range, base::SourceFile const& source) {
  auto const begin = position(member(range, "start"));
  auto const end = position(member(range, "end"));
  if (!begin || !end) return base::fail(base::ErrorKind::invalid_input, "a range is missing");
  Positions const positions(source);
  auto const from = positions.offset(*begin);
  return base::Span{from, std::max(from, positions.offset(*end))};
}

Json edits_between(base::SourceFile const& before, std::string const& after) {
  return edit_of(before, {0, static_cast<std::uint32_t>(before.text().size())}, after);
}

Json edits_of_lines(base::SourceFile const& before, std::string const& after, base::Span part) {
  base::SourceFile const formatted(before.name(), after);
  auto const old_lines = written_lines(before);
  auto const new_lines = written_lines(formatted);
  if (old_lines.size() != new_lines.size()) return Json::array();
  auto const first = std::ranges::partition_point(old_lines, [&](base::Span line) { return line.end < part.begin; });
  auto const behind = std::ranges::partition_point(old_lines, [&](base::Span line) { return line.begin < part.end; });
  if (first >= behind) return Json::array();
  auto const i = static_cast<std::size_t>(first - old_lines.begin());
  auto const j = static_cast<std::size_t>(behind - old_lines.begin()) - 1;
  return edit_of(before, cover(old_lines[i], old_lines[j]), formatted.text(cover(new_lines[i], new_lines[j])));
}

Json server_capabilities() {
  Json const legend{
      {"tokenTypes",
       {"variable", "parameter", "function", "method", "property", "keyword", "type", "string", "number", "comment"}},
      {"tokenModifiers", {"definition", "defaultLibrary"}}};
  return {{"positionEncoding", "utf-16"},
          {"textDocumentSync", {{"openClose", true}, {"change", 2}}},
          {"hoverProvider", true},
          {"completionProvider", {{"triggerCharacters", {".", "'", "\"", "$", "("}}}},
          {"signatureHelpProvider", {{"triggerCharacters", {" ", "(", ","}}}},
          {"definitionProvider", true},
          {"referencesProvider", true},
          {"documentHighlightProvider", true},
          {"documentSymbolProvider", true},
          {"renameProvider", {{"prepareProvider", true}}},
          {"documentFormattingProvider", true},
          {"documentRangeFormattingProvider", true},
          {"foldingRangeProvider", true},
          {"selectionRangeProvider", true},
          {"inlayHintProvider", true},
          {"workspaceSymbolProvider", true},
          {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
          {"semanticTokensProvider", {{"legend", legend}, {"full", true}}}};
}

}  // namespace lapwing::lsp
