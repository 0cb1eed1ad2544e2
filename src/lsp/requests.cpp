#include <fmt/format.h>

#include <utility>

#include "dolphin/services/format/formatting.hpp"
#include "dolphin/services/rename.hpp"
#include "lsp/server.hpp"
#include "lsp/translate.hpp"

/// The questions that an editor asks about an open script.
namespace lapwing::lsp {

using base::Result;

Result<Server::OpenScript*> Server::script_of(Json const& parameters) {
  auto const uri = text(member(member(parameters, "textDocument"), "uri"));
  auto const found = scripts_.find(uri);
  if (found != scripts_.end()) return &found->second;
  return base::fail(base::ErrorKind::not_found, fmt::format("'{}' is not open", uri));
}

Result<dolphin::Document const*> Server::document_of(Json const& parameters) {
  auto const script = script_of(parameters);
  if (!script) return std::unexpected(script.error());
  return &document_of(text(member(member(parameters, "textDocument"), "uri")), **script);
}

Result<Server::Place> Server::place_of(Json const& parameters) {
  auto const script = script_of(parameters);
  if (!script) return std::unexpected(script.error());
  auto const where = position(member(parameters, "position"));
  if (!where) return base::fail(base::ErrorKind::invalid_input, "a position is missing");
  auto const uri = text(member(member(parameters, "textDocument"), "uri"));
  return Place{document_of(uri, **script), uri, (*script)->text.offset(*where)};
}

Result<Json> Server::hover(Json const& parameters) {
  auto const place = place_of(parameters);
  if (!place) return std::unexpected(place.error());
  auto const& document = place->document;
  auto const found = dolphin::hover(document, place->offset);
  Positions positions(document.source());
  return found ? hover_result(*found, positions) : Json();
}

Result<Json> Server::completion(Json const& parameters) {
  auto const place = place_of(parameters);
  if (!place) return std::unexpected(place.error());
  auto const& document = place->document;
  Positions positions(document.source());
  auto found = dolphin::complete(document, place->offset);
  // A parenthesis opens the list of errors behind catch, and no other.
  bool const is_parenthesis = text(member(member(parameters, "context"), "triggerCharacter")) == "(";
  auto const is_no_type = [](dolphin::CompletionItem const& one) { return one.kind != dolphin::CompletionKind::type; };
  if (is_parenthesis) std::erase_if(found.items, is_no_type);
  return completion_result(found, positions, takes_snippets_);
}

Result<Json> Server::signature_help(Json const& parameters) {
  auto const place = place_of(parameters);
  if (!place) return std::unexpected(place.error());
  auto const help = dolphin::signature_help(place->document, place->offset);
  return help ? signature_result(*help) : Json();
}

Result<Json> Server::definition(Json const& parameters) {
  auto const place = place_of(parameters);
  if (!place) return std::unexpected(place.error());
  auto const& document = place->document;
  Positions positions(document.source());
  auto out = Json::array();
  for (auto const span : dolphin::definition(document, place->offset))
    out.push_back(location(place->uri, span, positions));
  return out;
}

Result<Json> Server::references(Json const& parameters) {
  auto const place = place_of(parameters);
  if (!place) return std::unexpected(place.error());
  bool const with_definitions = member(member(parameters, "context"), "includeDeclaration") == Json(true);
  Positions positions(place->document.source());
  auto out = Json::array();
  for (auto const& one : dolphin::references(place->document, place->offset)) {
    if (with_definitions || !one.is_definition) out.push_back(location(place->uri, one.span, positions));
  }
  return out;
}

Result<Json> Server::highlights(Json const& parameters) {
  constexpr int read = 2;
  constexpr int write = 3;
  auto const place = place_of(parameters);
  if (!place) return std::unexpected(place.error());
  Positions positions(place->document.source());
  auto out = Json::array();
  for (auto const& one : dolphin::references(place->document, place->offset)) {
    out.push_back({{"range", range(one.span, positions)}, {"kind", one.is_definition ? write : read}});
  }
  return out;
}

Result<Json> Server::symbols(Json const& parameters) {
  auto const document = document_of(parameters);
  if (!document) return std::unexpected(document.error());
  Positions positions((*document)->source());
  auto out = Json::array();
  for (auto const& one : dolphin::symbols(**document)) out.push_back(symbol_result(one, positions));
  return out;
}

Result<Json> Server::prepare_rename(Json const& parameters) {
  auto const place = place_of(parameters);
  if (!place) return std::unexpected(place.error());
  auto const& document = place->document;
  auto const word = dolphin::renamable(document, place->offset);
  if (!word) return std::unexpected(word.error());
  Positions positions(document.source());
  return Json{{"range", range(*word, positions)}, {"placeholder", document.text(*word)}};
}

Result<Json> Server::rename(Json const& parameters) {
  auto const place = place_of(parameters);
  if (!place) return std::unexpected(place.error());
  auto const new_name = text(member(parameters, "newName"));
  auto const places = dolphin::rename(place->document, place->offset, new_name);
  if (!places) return std::unexpected(places.error());
  Positions positions(place->document.source());
  auto edits = Json::array();
  for (auto const span : *places) edits.push_back({{"range", range(span, positions)}, {"newText", new_name}});
  Json changes;
  changes[place->uri] = std::move(edits);
  return Json{{"changes", std::move(changes)}};
}

/// A script that does not parse is left as it is.
Result<Json> Server::formatting(Json const& parameters) {
  auto const document = document_of(parameters);
  if (!document) return std::unexpected(document.error());
  auto const& source = (*document)->source();
  base::Diagnostics mistakes(source);
  auto const formatted = dolphin::format(mistakes);
  return formatted ? edits_between(source, *formatted) : Json::array();
}

Result<Json> Server::range_formatting(Json const& parameters) {
  auto const document = document_of(parameters);
  if (!document) return std::unexpected(document.error());
  auto const part = span_of(member(parameters, "range"), (*document)->source());
  if (!part) return std::unexpected(part.error());
  auto const& source = (*document)->source();
  base::Diagnostics mistakes(source);
  auto const formatted = dolphin::format(mistakes);
  return formatted ? edits_of_lines(source, *formatted, *part) : Json::array();
}

/// The fixes of what is wrong in the range, as something to click.
Result<Json> Server::code_actions(Json const& parameters) {
  auto const script = script_of(parameters);
  if (!script) return std::unexpected(script.error());
  auto const uri = text(member(member(parameters, "textDocument"), "uri"));
  auto out = Json::array();
  // Editors ask by themselves after every key; they ask again when the diagnostics come.
  constexpr auto by_itself = 2;
  bool const is_asked_by_itself = member(member(parameters, "context"), "triggerKind") == Json(by_itself);
  if (is_asked_by_itself && !(*script)->diagnostics) return out;
  auto const& diagnostics = diagnostics_of(uri, **script);
  auto const& source = (*script)->document->source();
  auto const part = span_of(member(parameters, "range"), source);
  if (!part) return std::unexpected(part.error());
  for (auto const& one : diagnostics) {
    bool const is_here = one.span.begin <= part->end && part->begin <= one.span.end;
    if (is_here && !one.fix.empty()) out.push_back(quick_fix(one, uri, source));
  }
  return out;
}

}  // namespace lapwing::lsp
