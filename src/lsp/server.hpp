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

#include "base/error.hpp"
#include "base/text/diagnostic.hpp"
#include "base/time.hpp"
#include "dolphin/services/document.hpp"
#include "lsp/edited_text.hpp"
#include "lsp/message_json.hpp"

namespace lapwing::lsp {

/// A language server (LSP 3.17) for mission scripts, without a transport: messages go in, messages come out. Knows
/// nothing but the texts that editors have opened; reads no file.
///
/// Messages wait in a queue, so that a request can be cancelled before its turn. A change of a text is cheap: the
/// script is read when the first question about the new text comes, and checked when nobody has typed for a moment.
///
/// Whoever owns the server tells it the time: each call of `work` gets the loop's `now`, and `next_due` says when there
/// will be work without a message.
class Server {
 public:
  /// How long nobody must have typed before a script is checked: shorter than one looks up, longer than between two
  /// keys.
  static constexpr base::Duration pause = std::chrono::milliseconds(150);

  /// `added`: what the platform adds to the language; it outlives the server.
  explicit Server(tasks::Vocabulary const& added, std::string version);

  /// Takes in one message (the JSON text); what cannot be read is answered in its turn.
  void receive(std::string_view message);
  /// Something that is no message arrived.
  void receive_mistake(std::string_view what);
  [[nodiscard]] bool has_work(base::TimePoint now) const;
  /// When the next check begins unless a change puts it off; nothing while all scripts are checked.
  [[nodiscard]] std::optional<base::TimePoint> next_due() const;
  /// Carries out the message whose turn it is, or else the check that is due: what is to be sent.
  [[nodiscard]] std::vector<std::string> work(base::TimePoint now);

  /// How much has been done so far, whatever it was for.
  struct Effort {
    std::size_t readings = 0;  ///< of a whole script
    std::size_t checks = 0;    ///< of a script that has been read
  };
  [[nodiscard]] Effort effort() const { return effort_; }

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
    EditedText text;
    std::unique_ptr<dolphin::Document> document;               ///< null while nobody has asked about this text
    std::optional<std::vector<base::Diagnostic>> diagnostics;  ///< nothing while this text is not checked
    std::optional<base::TimePoint> check_at;                   ///< when they are to be told
  };
  /// The script and the place that a request is about.
  struct Place {
    dolphin::Document const& document;
    std::string uri;
    std::uint32_t offset;
  };
  enum class Phase { new_born, running, shut_down };
  using Request = base::Result<Json> (Server::*)(Json const& parameters);
  using Notification = void (Server::*)(Json const& parameters);

  void carry_out_next();
  /// Whether a change of the script waits in the queue.
  [[nodiscard]] bool changes_later(std::string const& uri) const;
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
  void has_changed(OpenScript& script, base::Duration wait);
  dolphin::Document const& document_of(std::string const& uri, OpenScript& script);
  std::vector<base::Diagnostic> const& diagnostics_of(std::string const& uri, OpenScript& script);
  void publish(std::string const& uri, OpenScript& script);

  // ---- questions (requests.cpp)
  base::Result<OpenScript*> script_of(Json const& parameters);
  base::Result<dolphin::Document const*> document_of(Json const& parameters);
  base::Result<Place> place_of(Json const& parameters);
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
  base::Result<Json> range_formatting(Json const& parameters);
  base::Result<Json> code_actions(Json const& parameters);

  // ---- what an editor draws (views.cpp)
  base::Result<Json> semantic_tokens(Json const& parameters);
  base::Result<Json> folding_ranges(Json const& parameters);
  base::Result<Json> selection_ranges(Json const& parameters);
  base::Result<Json> inlay_hints(Json const& parameters);
  base::Result<Json> workspace_symbols(Json const& parameters);

  dolphin::Vocabulary vocabulary_;
  std::string version_;
  Phase phase_ = Phase::new_born;
  bool takes_snippets_ = false;
  std::optional<int> exit_code_;
  base::TimePoint now_{};
  Effort effort_;
  std::deque<Pending> queue_;
  std::map<std::string, OpenScript> scripts_;  ///< by URI
  std::vector<std::string> outgoing_;
};

}  // namespace lapwing::lsp
