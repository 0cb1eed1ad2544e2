#include "lsp/server.hpp"

#include <algorithm>
#include <array>
#include <utility>

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
constexpr int request_failed = -32803;

int error_code(base::ErrorKind kind) {
  bool const is_ours = kind == base::ErrorKind::refused;
  return is_ours ? request_failed : invalid_parameters;
}

bool is_id(Json const& id) {
  return id.is_string() || id.is_number_integer();
}

std::string uri_of(Json const& parameters) {
  return text(member(member(parameters, "textDocument"), "uri"));
}

}  // namespace

Server::Server(std::span<tasks::BuilderSpec const> builders, std::string version)
    : vocabulary_(builders), version_(std::move(version)) {}

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

std::vector<std::string> Server::work() {
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
  } else if (is_request) {
    answer(id, method, member(message, "params"));
  } else {
    notice(method, member(message, "params"));
  }
  return std::exchange(outgoing_, {});
}

void Server::send(Json message) {
  message["jsonrpc"] = "2.0";
  outgoing_.push_back(to_line(message));
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
  scripts_[uri].version = natural(member(document, "version"));
  read_again(uri, text(member(document, "text")));
}

void Server::change(Json const& parameters) {
  auto const found = scripts_.find(uri_of(parameters));
  if (found == scripts_.end()) return;
  auto& [uri, script] = *found;
  script.version = natural(member(member(parameters, "textDocument"), "version"));
  std::string now(script.document->source().text());
  for (auto const& one : member(parameters, "contentChanges")) {
    auto const begin = position(member(member(one, "range"), "start"));
    auto const end = position(member(member(one, "range"), "end"));
    auto replacement = text(member(one, "text"));
    if (begin && end) {
      now = edited(base::SourceFile(uri, std::move(now)), *begin, *end, replacement);
    } else {
      now = std::move(replacement);
    }
  }
  read_again(uri, std::move(now));
}

void Server::close(Json const& parameters) {
  auto const uri = uri_of(parameters);
  if (scripts_.erase(uri) == 0) return;
  send({{"method", "textDocument/publishDiagnostics"}, {"params", {{"uri", uri}, {"diagnostics", Json::array()}}}});
}

void Server::read_again(std::string const& uri, std::string text) {
  auto& script = scripts_[uri];
  script.document = std::make_unique<dolphin::Document>(uri, std::move(text), vocabulary_);
  script.diagnostics.clear();
  if (!changes_again(uri)) publish(uri);
}

bool Server::changes_again(std::string const& uri) const {
  return std::ranges::any_of(queue_, [&](Pending const& waiting) {
    return text(member(waiting.message, "method")) == "textDocument/didChange" &&
           uri_of(member(waiting.message, "params")) == uri;
  });
}

void Server::publish(std::string const& uri) {
  auto& script = scripts_.at(uri);
  script.diagnostics = script.document->diagnostics();
  Positions positions(script.document->source());
  auto all = Json::array();
  for (auto const& one : script.diagnostics) all.push_back(diagnostic(one, uri, positions));
  send({{"method", "textDocument/publishDiagnostics"},
        {"params", {{"uri", uri}, {"version", script.version}, {"diagnostics", std::move(all)}}}});
}

}  // namespace lapwing::lsp
