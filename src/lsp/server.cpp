#include "lsp/server.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text/json.hpp"
#include "lsp/translate.hpp"

namespace lapwing::lsp {

namespace {

// JSON-RPC and LSP error codes.
constexpr int parse_error = -32700;
constexpr int invalid_request = -32600;
constexpr int method_not_found = -32601;
constexpr int invalid_parameters = -32602;
constexpr int not_initialized = -32002;
constexpr int request_cancelled = -32800;
constexpr int content_modified = -32801;
constexpr int request_failed = -32803;

int error_code(base::ErrorKind kind) {
  bool const is_ours = kind == base::ErrorKind::refused;
  return is_ours ? request_failed : invalid_parameters;
}

bool is_id(Json const& id) {
  return id.is_string() || id.is_number_integer();
}

/// Questions that editors ask by themselves about a whole text, and ask again when it has changed.
bool is_about_whole_text(std::string_view method) {
  constexpr auto methods = std::to_array<std::string_view>(
      {"textDocument/semanticTokens/full", "textDocument/inlayHint", "textDocument/foldingRange",
       "textDocument/documentSymbol", "textDocument/documentHighlight"});
  return std::ranges::find(methods, method) != methods.end();
}

std::string uri_of(Json const& parameters) {
  return text(member(member(parameters, "textDocument"), "uri"));
}

}  // namespace

Server::Server(tasks::Vocabulary const& added, std::string version)
    : vocabulary_(added), version_(std::move(version)) {}

// ---- the queue ----------------------------------------------------------------------------------

void Server::receive(std::string_view message) {
  auto json = Json::parse(message, nullptr, false);
  if (json.is_discarded()) return receive_mistake("this is not JSON");
  if (text(member(json, "method")) == "$/cancelRequest") {
    auto const& id = member(member(json, "params"), "id");
    for (auto& waiting : queue_) {
      if (is_id(id) && member(waiting.message, "id") == id) waiting.is_cancelled = true;
    }
    return;
  }
  queue_.push_back({std::move(json)});
}

void Server::receive_mistake(std::string_view what) {
  queue_.push_back({Json(), std::string(what)});
}

std::optional<base::TimePoint> Server::next_due() const {
  std::optional<base::TimePoint> out;
  for (auto const& [uri, script] : scripts_) {
    if (script.check_at && (!out || *script.check_at < *out)) out = script.check_at;
  }
  return out;
}

bool Server::has_work(base::TimePoint now) const {
  auto const due = next_due();
  return !queue_.empty() || (due && *due <= now);
}

std::vector<std::string> Server::work(base::TimePoint now) {
  now_ = now;
  if (!queue_.empty()) {
    carry_out_next();
  } else {
    auto const is_due = [&](auto const& one) { return one.second.check_at && *one.second.check_at <= now; };
    auto const found = std::ranges::find_if(scripts_, is_due);
    if (found != scripts_.end()) publish(found->first, found->second);
  }
  return std::exchange(outgoing_, {});
}

void Server::carry_out_next() {
  auto const [message, mistake, is_cancelled] = std::move(queue_.front());
  queue_.pop_front();
  auto const& id = member(message, "id");
  auto const method = text(member(message, "method"));
  bool const is_request = message.is_object() && message.contains("id");
  if (!mistake.empty()) {
    fail(nullptr, parse_error, mistake);
  } else if (is_request && method.empty() && (message.contains("result") || message.contains("error"))) {
    // An answer: this server asks nothing.
  } else if (method.empty() || (is_request && !is_id(id))) {
    fail(is_id(id) ? id : Json(), invalid_request, "a message needs a method, and a request an id");
  } else if (is_cancelled) {
    fail(id, request_cancelled, "cancelled");
  } else if (is_request && is_about_whole_text(method) && changes_later(uri_of(member(message, "params")))) {
    fail(id, content_modified, "the text has changed");
  } else if (is_request) {
    answer(id, method, member(message, "params"));
  } else {
    notice(method, member(message, "params"));
  }
}

bool Server::changes_later(std::string const& uri) const {
  return std::ranges::any_of(queue_, [&](Pending const& waiting) {
    return text(member(waiting.message, "method")) == "textDocument/didChange" &&
           uri_of(member(waiting.message, "params")) == uri;
  });
}

void Server::send(Json message) {
  message["jsonrpc"] = "2.0";
  outgoing_.push_back(base::to_text(message));
}

void Server::fail(Json const& id, int code, std::string const& message) {
  send({{"id", id}, {"error", {{"code", code}, {"message", message}}}});
}

void Server::answer(Json const& id, std::string const& method, Json const& parameters) {
  if (phase_ == Phase::new_born && method != "initialize") return fail(id, not_initialized, "initialize comes first");
  if (phase_ == Phase::shut_down) return fail(id, invalid_request, "the server is shut down");
  auto const handler = request(method);
  if (!handler) return fail(id, method_not_found, "there is no method " + method);
  auto result = (this->*handler)(parameters);
  if (!result) {
    auto const& error = result.error();
    return fail(id, error_code(error.kind), error.hint.empty() ? error.message : error.message + ": " + error.hint);
  }
  send({{"id", id}, {"result", *std::move(result)}});
}

void Server::notice(std::string const& method, Json const& parameters) {
  if (method == "exit") return exit(parameters);
  if (phase_ != Phase::running) return;
  if (auto const handler = notification(method)) (this->*handler)(parameters);
}

Server::Request Server::request(std::string_view method) {
  constexpr auto table = std::to_array<std::pair<std::string_view, Request>>({
      {"initialize", &Server::initialize},
      {"shutdown", &Server::shut_down},
      {"textDocument/hover", &Server::hover},
      {"textDocument/completion", &Server::completion},
      {"textDocument/signatureHelp", &Server::signature_help},
      {"textDocument/definition", &Server::definition},
      {"textDocument/references", &Server::references},
      {"textDocument/documentHighlight", &Server::highlights},
      {"textDocument/documentSymbol", &Server::symbols},
      {"textDocument/prepareRename", &Server::prepare_rename},
      {"textDocument/rename", &Server::rename},
      {"textDocument/formatting", &Server::formatting},
      {"textDocument/rangeFormatting", &Server::range_formatting},
      {"textDocument/foldingRange", &Server::folding_ranges},
      {"textDocument/selectionRange", &Server::selection_ranges},
      {"textDocument/inlayHint", &Server::inlay_hints},
      {"workspace/symbol", &Server::workspace_symbols},
      {"textDocument/semanticTokens/full", &Server::semantic_tokens},
      {"textDocument/codeAction", &Server::code_actions},
  });
  auto const found = std::ranges::find(table, method, &std::pair<std::string_view, Request>::first);
  return found == table.end() ? nullptr : found->second;
}

Server::Notification Server::notification(std::string_view method) {
  if (method == "textDocument/didOpen") return &Server::open;
  if (method == "textDocument/didChange") return &Server::change;
  if (method == "textDocument/didClose") return &Server::close;
  return nullptr;
}

// ---- life ---------------------------------------------------------------------------------------

base::Result<Json> Server::initialize(Json const& parameters) {
  if (phase_ != Phase::new_born) return base::fail(base::ErrorKind::refused, "the server is initialized already");
  phase_ = Phase::running;
  auto const& completion = member(member(member(parameters, "capabilities"), "textDocument"), "completion");
  takes_snippets_ = member(member(completion, "completionItem"), "snippetSupport") == Json(true);
  return Json{{"capabilities", server_capabilities()}, {"serverInfo", {{"name", "lapwing"}, {"version", version_}}}};
}

base::Result<Json> Server::shut_down(Json const&) {
  phase_ = Phase::shut_down;
  return Json();
}

void Server::exit(Json const&) {
  exit_code_ = phase_ == Phase::shut_down ? 0 : 1;
}

// ---- texts --------------------------------------------------------------------------------------

void Server::open(Json const& parameters) {
  auto const uri = uri_of(parameters);
  if (uri.empty()) return;
  auto const& document = member(parameters, "textDocument");
  auto& script = scripts_[uri];
  script.version = natural(member(document, "version"));
  script.text = EditedText(text(member(document, "text")));
  has_changed(script, base::Duration::zero());
}

void Server::change(Json const& parameters) {
  auto const found = scripts_.find(uri_of(parameters));
  if (found == scripts_.end()) return;
  auto& script = found->second;
  script.version = natural(member(member(parameters, "textDocument"), "version"));
  for (auto const& one : member(parameters, "contentChanges")) {
    auto const begin = position(member(member(one, "range"), "start"));
    auto const end = position(member(member(one, "range"), "end"));
    auto replacement = text(member(one, "text"));
    if (begin && end) {
      script.text.replace(*begin, *end, replacement);
    } else {
      script.text = EditedText(std::move(replacement));
    }
  }
  has_changed(script, pause);
}

void Server::close(Json const& parameters) {
  auto const uri = uri_of(parameters);
  if (scripts_.erase(uri) == 0) return;
  send({{"method", "textDocument/publishDiagnostics"}, {"params", {{"uri", uri}, {"diagnostics", Json::array()}}}});
}

void Server::has_changed(OpenScript& script, base::Duration wait) {
  script.document.reset();
  script.diagnostics.reset();
  script.check_at = now_ + wait;
}

dolphin::Document const& Server::document_of(std::string const& uri, OpenScript& script) {
  if (!script.document) {
    script.document = std::make_unique<dolphin::Document>(uri, script.text.text(), vocabulary_);
    ++effort_.readings;
  }
  return *script.document;
}

std::vector<base::Diagnostic> const& Server::diagnostics_of(std::string const& uri, OpenScript& script) {
  if (!script.diagnostics) {
    script.diagnostics = document_of(uri, script).diagnostics();
    ++effort_.checks;
  }
  return *script.diagnostics;
}

void Server::publish(std::string const& uri, OpenScript& script) {
  script.check_at.reset();
  auto const& diagnostics = diagnostics_of(uri, script);
  Positions positions(script.document->source());
  auto all = Json::array();
  for (auto const& one : diagnostics) all.push_back(diagnostic(one, uri, positions));
  send({{"method", "textDocument/publishDiagnostics"},
        {"params", {{"uri", uri}, {"version", script.version}, {"diagnostics", std::move(all)}}}});
}

}  // namespace lapwing::lsp
