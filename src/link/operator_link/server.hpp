#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "link/operator_link/carrier/byte_stream.hpp"
#include "link/operator_link/settings.hpp"

namespace lapwing::link::operator_link {

/// The end that others connect to. Each of them is known by its name, and has a session that is there as long as the
/// server, whether it is connected or not. In JSON mode there is one session, for whoever connected last.
///
/// Thread-bound to its loop, which outlives it. Must not be destroyed from within its own callbacks.
class Server {
 public:
  struct Options {
    EndSettings end{};
    std::vector<std::string> expected{};  ///< far ends for which messages wait before they have connected once
    std::size_t most_peers = 16;
    std::size_t most_strangers = 16;  ///< connections that have not said who they are
  };
  struct Events {
    std::function<void(PeerSession&)> arrived;  ///< its `take` has something
    std::function<void(Event)> event;
  };
  /// The name of the only session in JSON mode.
  static constexpr std::string_view plain_peer = "plain";

  /// Error: invalid_input (a name), io or refused (a queue's folder).
  [[nodiscard]] static base::Result<std::unique_ptr<Server>> open(base::Loop& loop, std::unique_ptr<Listener> listener,
                                                                  Options options, Events events);
  Server(Server const&) = delete;
  Server& operator=(Server const&) = delete;
  ~Server();

  [[nodiscard]] std::string const& name() const { return name_; }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Says good-bye to everybody and takes no more connections. Not from within its own callbacks.
  void close();
  /// Null: never heard of.
  [[nodiscard]] PeerSession* find(std::string_view peer);
  [[nodiscard]] std::vector<PeerSession*> sessions();
  /// One more for which messages wait from now on. Error: refused (too many), invalid_input, io.
  [[nodiscard]] base::Result<PeerSession*> expect(std::string const& peer);
  /// To everybody who is known. How many could not take it.
  std::size_t send_to_all(Message const& message);
  [[nodiscard]] std::size_t strangers() const { return strangers_.size(); }
  /// Something about sessions or strangers changed.
  [[nodiscard]] base::Notifier& changed() { return changed_; }

 private:
  struct Stranger {
    std::unique_ptr<Channel> channel;
    base::TimePoint since;
    bool is_done = false;
  };
  using Strangers = std::list<Stranger>;

  Server(base::Loop& loop, std::unique_ptr<Listener> listener, Options options, Events events);
  base::Result<> recall();
  void accept(std::unique_ptr<ByteStream> stream);
  void greeted(Strangers::iterator stranger, Speech speech);
  void refuse(Strangers::iterator stranger, RefusedCode code, std::string reason);
  void dismiss(Strangers::iterator stranger);
  base::Result<PeerSession*> room_for(std::string const& peer);
  bool forget_somebody();
  base::Task<> hurry_strangers();

  base::Loop& loop_;
  std::unique_ptr<Listener> listener_;
  std::string name_;
  std::uint16_t port_;
  Options options_;
  Events events_;
  std::uint64_t instance_;
  Strangers strangers_;
  bool is_hurrying_ = false;
  std::map<std::string, std::unique_ptr<PeerSession>, std::less<>> sessions_;
  base::Notifier changed_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
  base::Scope scope_;
};

}  // namespace lapwing::link::operator_link
