#include <utility>

#include "dolphin/services/view/folding.hpp"
#include "dolphin/services/view/inlay_hints.hpp"
#include "dolphin/services/view/selection.hpp"
#include "lsp/server.hpp"
#include "lsp/translate.hpp"

/// What an editor draws: colours, folds, words between the words, lists of symbols.
namespace lapwing::lsp {

using base::Result;

namespace {

/// Whether the letters of `wanted` stand in `name` in this order, large or small: what symbols are found by.
bool is_in_order(std::string_view wanted, std::string_view name) {
  auto const lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  for (char const c : name) {
    if (!wanted.empty() && lower(c) == lower(wanted.front())) wanted.remove_prefix(1);
  }
  return wanted.empty();
}

}  // namespace

Result<Json> Server::semantic_tokens(Json const& parameters) {
  auto const document = document_of(parameters);
  if (!document) return std::unexpected(document.error());
  return semantic_result(dolphin::semantic_tokens(**document), (*document)->source());
}

Result<Json> Server::folding_ranges(Json const& parameters) {
  auto const document = document_of(parameters);
  if (!document) return std::unexpected(document.error());
  auto out = Json::array();
  for (auto const& one : dolphin::folds(**document)) out.push_back(fold_result(one));
  return out;
}

Result<Json> Server::selection_ranges(Json const& parameters) {
  auto const document = document_of(parameters);
  if (!document) return std::unexpected(document.error());
  Positions positions((*document)->source());
  auto out = Json::array();
  for (auto const& one : member(parameters, "positions")) {
    auto const where = position(one);
    if (!where) return base::fail(base::ErrorKind::invalid_input, "a position is missing");
    Json made;
    auto const all = dolphin::selections(**document, positions.offset(*where));
    for (auto span = all.rbegin(); span != all.rend(); ++span) {
      Json inner{{"range", range(*span, positions)}};
      if (!made.is_null()) inner["parent"] = std::move(made);
      made = std::move(inner);
    }
    out.push_back(std::move(made));
  }
  return out;
}

Result<Json> Server::inlay_hints(Json const& parameters) {
  auto const document = document_of(parameters);
  if (!document) return std::unexpected(document.error());
  auto const part = span_of(member(parameters, "range"), (*document)->source());
  if (!part) return std::unexpected(part.error());
  Positions positions((*document)->source());
  auto out = Json::array();
  for (auto const& one : dolphin::inlay_hints(**document, *part)) out.push_back(inlay_hint_result(one, positions));
  return out;
}

/// Those of all open scripts: no file is read.
Result<Json> Server::workspace_symbols(Json const& parameters) {
  auto const wanted = text(member(parameters, "query"));
  auto out = Json::array();
  for (auto& [uri, script] : scripts_) {
    auto const& document = document_of(uri, script);
    Positions positions(document.source());
    for (auto const& one : dolphin::symbols(document)) {
      if (!is_in_order(wanted, one.name)) continue;
      out.push_back(
          {{"name", one.name}, {"kind", symbol_kind(one.kind)}, {"location", location(uri, one.name_span, positions)}});
    }
  }
  return out;
}

}  // namespace lapwing::lsp
