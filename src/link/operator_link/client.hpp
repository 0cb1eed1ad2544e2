#pragma once

#include <memory>
#include <optional>
#include <string>

#include "link/operator_link/carrier/byte_stream.hpp"
#include "link/operator_link/settings.hpp"

namespace lapwing::link::operator_link {

/// The end that connects, and connects again for as long as it lives. Its session is there from the start: what is said
/// before the first connection waits like what is said during an outage.
///
/// Thread-bound to its loop, which outlives it. Must not be destroyed from within its own callbacks.
class Client {
 public:
  struct Options {
    EndSettings end{};
    std::string server{};  ///< the server's name, if it is known: another one is refused; also the name of its queue
    BackOff::Limits back_off{};
  };
  /// Error: invalid_input (a name), io or refused (the queue's folder).
  [[nodiscard]] static base::Result<std::unique_ptr<Client>> open(base::Loop& loop, std::unique_ptr<Dialler> dialler,
                                                                  Options options, PeerSession::Events events);
  Client(Client const&) = delete;
  Client& operator=(Client const&) = delete;
  ~Client();

  [[nodiscard]] PeerSession& session() { return session_; }
  /// Says good-bye and connects no more. Not from within its own callbacks.
  void close();
  [[nodiscard]] bool is_connected() const { return session_.is_connected(); }
  /// Why the last attempt failed; empty while connected.
  [[nodiscard]] std::string const& last_error() const { return last_error_; }
  /// For people: where it connects to.
  [[nodiscard]] std::string name() const { return dialler_->name(); }

 private:
  Client(base::Loop& loop, std::unique_ptr<Dialler> dialler, Options options, std::uint64_t instance,
         std::unique_ptr<DurableQueue> queue, PeerSession::Events events);
  base::Task<> keep_connected();
  base::Task<bool> connect();
  base::Task<bool> greet(std::unique_ptr<ByteStream> stream);
  void answered(Speech speech);
  void fail(EventKind kind, std::string why);

  base::Loop& loop_;
  std::unique_ptr<Dialler> dialler_;
  Options options_;
  std::function<void(Event)> event_;
  BackOff back_off_;
  std::string last_error_;
  std::unique_ptr<Channel> greeting_;  ///< from hello to welcome
  bool is_answered_ = false;
  PeerSession session_;
  base::Scope scope_;
};

}  // namespace lapwing::link::operator_link
