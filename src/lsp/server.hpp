#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/error.hpp"
#include "dolphin/services/document.hpp"
#include "lsp/json.hpp"

namespace lapwing::lsp {

/// A language server (LSP 3.17) for mission scripts, without a transport: messages go in, messages come out. Knows
/// nothing but the texts that editors have opened; reads no file.
///
/// Messages wait in a queue, so that a request can be cancelled before its turn, and so that diagnostics are worked out
/// once for a burst of changes.
class Server {
 public:
  /// `builders`: the block words of the platform; they outlive the server.
  explicit Server(std::span<tasks::BuilderSpec const> builders, std::string version);

  /// Takes in one message (the JSON text); what cannot be read is answered in its turn.
  void receive(std::string_view message);
  /// Something that is no message arrived.
  void receive_mistake(std::string_view what);
  [[nodiscard]] bool has_work() const { return !queue_.empty(); }
  /// Carries out the message whose turn it is: what is to be sent.
  [[nodiscard]] std::vector<std::string> work();

  /// After `exit`: 0 when it was shut down before, else 1.
  [[nodiscard]] std::optional<int> exit_code() const { return exit_code_; }

 private:
  struct Pending {
    Json message;
    std::string mistake = {};  ///< why it cannot be read
    bool is_cancelled = false;
  };
  struct OpenScript {
    std::int64_t version = 0;
    std::unique_ptr<dolphin::Document> document;
    std::vector<base::Diagnostic> diagnostics;
  };
  /// The script and the place that a request is about.
  struct Place {
    OpenScript const& script;
    std::string uri;
    std::uint32_t offset;
  };
  enum class Phase { new_born, running, shut_down };
  using Request = base::Result<Json> (Server::*)(Json const& parameters);
  using Notification = void (Server::*)(Json const& parameters);

  void send(Json message);
  void fail(Json const& id, int code, std::string const& message);
  void answer(Json const& id, std::string const& method, Json const& parameters);
  void notice(std::string const& method, Json const& parameters);
  [[nodiscard]] static Request request(std::string_view method);
  [[nodiscard]] static Notification notification(std::string_view method);

  // ---- life
  base::Result<Json> initialize(Json const& parameters);
  base::Result<Json> shut_down(Json const& parameters);
  void exit(Json const& parameters);

  // ---- texts
  void open(Json const& parameters);
  void change(Json const& parameters);
  void close(Json const& parameters);
  void read_again(std::string const& uri, std::string text);
  void publish(std::string const& uri);
  [[nodiscard]] bool changes_again(std::string const& uri) const;

  // ---- questions (requests.cpp)
  base::Result<OpenScript const*> script_of(Json const& parameters) const;
  base::Result<Place> place_of(Json const& parameters) const;
  base::Result<Json> hover(Json const& parameters);
  base::Result<Json> completion(Json const& parameters);
  base::Result<Json> signature_help(Json const& parameters);
  base::Result<Json> definition(Json const& parameters);
  base::Result<Json> references(Json const& parameters);
  base::Result<Json> highlights(Json const& parameters);
  base::Result<Json> symbols(Json const& parameters);
  base::Result<Json> prepare_rename(Json const& parameters);
  base::Result<Json> rename(Json const& parameters);
  base::Result<Json> formatting(Json const& parameters);
  base::Result<Json> semantic_tokens(Json const& parameters);
  base::Result<Json> code_actions(Json const& parameters);

  dolphin::Vocabulary vocabulary_;
  std::string version_;
  Phase phase_ = Phase::new_born;
  bool takes_snippets_ = false;
  std::optional<int> exit_code_;
  std::deque<Pending> queue_;
  std::map<std::string, OpenScript> scripts_;  ///< by URI
  std::vector<std::string> outgoing_;
};

}  // namespace lapwing::lsp
