#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text/diagnostic.hpp"
#include "dolphin/services/completion.hpp"
#include "dolphin/services/hover.hpp"
#include "dolphin/services/navigation.hpp"
#include "dolphin/services/semantic_tokens.hpp"
#include "dolphin/services/signature_help.hpp"
#include "dolphin/services/view/folding.hpp"
#include "dolphin/services/view/inlay_hints.hpp"
#include "lsp/message_json.hpp"

/// What the language services say, in the words of LSP 3.17.
namespace lapwing::lsp {

[[nodiscard]] Json range(base::Span span, Positions& positions);
[[nodiscard]] Json location(std::string const& uri, base::Span span, Positions& positions);
[[nodiscard]] Json diagnostic(base::Diagnostic const& one, std::string const& uri, Positions& positions);
/// A code action that carries out the fix of a diagnostic.
[[nodiscard]] Json quick_fix(base::Diagnostic const& one, std::string const& uri, base::SourceFile const& source);
[[nodiscard]] Json hover_result(dolphin::Hover const& hover, Positions& positions);
[[nodiscard]] Json completion_result(dolphin::Completion const& completion, Positions& positions, bool with_snippets);
[[nodiscard]] Json signature_result(dolphin::SignatureHelp const& help);
[[nodiscard]] Json symbol_result(dolphin::Symbol const& symbol, Positions& positions);
[[nodiscard]] int symbol_kind(dolphin::SymbolKind kind);
[[nodiscard]] Json fold_result(dolphin::Fold const& fold);
[[nodiscard]] Json inlay_hint_result(dolphin::InlayHint const& hint, Positions& positions);
/// Numbers of LSP's relative encoding; tokens over several lines are cut at their ends.
[[nodiscard]] Json semantic_result(std::vector<dolphin::SemanticToken> const& tokens, base::SourceFile const& source);
/// One edit that turns `before` into `after`: what both texts have in common at begin and end is left alone.
[[nodiscard]] Json edits_between(base::SourceFile const& before, std::string const& after);
/// The same for the lines of `part` alone. Of a text that has been formatted, whose lines are the author's.
[[nodiscard]] Json edits_of_lines(base::SourceFile const& before, std::string const& after, base::Span part);
/// The part of the text that a range of LSP means.
[[nodiscard]] base::Result<base::Span> span_of(Json const& range, base::SourceFile const& source);
/// What `initialize` says about this server.
[[nodiscard]] Json server_capabilities();

}  // namespace lapwing::lsp
