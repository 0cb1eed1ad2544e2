#include "link/operator_link/server.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text/constant_time.hpp"

namespace lapwing::link::operator_link {

base::Result<std::unique_ptr<Server>> Server::open(base::Loop& loop, std::unique_ptr<Listener> listener,
                                                   Options options, Events events) {
  if (auto const fine = check_name(options.end.name); !fine) return std::unexpected(fine.error());
  if (options.end.token.size() > longest_token)
    return base::fail(base::ErrorKind::invalid_input, fmt::format("a token of more than {} bytes", longest_token));
  std::unique_ptr<Server> server(new Server(loop, std::move(listener), std::move(options), std::move(events)));
  if (auto const recalled = server->recall(); !recalled) return std::unexpected(recalled.error());
  server->listener_->start(
      [raw = server.get()](std::unique_ptr<ByteStream> stream) { raw->accept(std::move(stream)); });
  return server;
}

Server::Server(base::Loop& loop, std::unique_ptr<Listener> listener, Options options, Events events)
    : loop_(loop),
      listener_(std::move(listener)),
      name_(listener_->name()),
      port_(listener_->port()),
      options_(std::move(options)),
      events_(std::move(events)),
      instance_(random_id(options_.end.seed)),
      changed_(loop),
      scope_(loop) {}

Server::~Server() {
  close();
}

void Server::close() {
  listener_.reset();
  for (auto& stranger : strangers_)
    if (stranger.channel) stranger.channel->close();
  for (auto const& [name, session] : sessions_) session->detach("the program closed the link");
}

/// Those for whom something waits on the disk are known, too.
base::Result<> Server::recall() {
  auto names = options_.expected;
  if (options_.end.mode == Mode::json) names = {std::string(plain_peer)};
  std::error_code error;
  auto const& folder = options_.end.queues.folder;
  if (!folder.empty() && options_.end.mode == Mode::framed)
    for (auto at = std::filesystem::directory_iterator(folder, error);
         !error && at != std::filesystem::directory_iterator(); at.increment(error))
      if (at->is_directory(error) && check_name(at->path().filename().string()))
        names.push_back(at->path().filename().string());
  for (auto const& name : names)
    if (auto const session = expect(name); !session) return std::unexpected(session.error());
  return {};
}

PeerSession* Server::find(std::string_view peer) {
  auto const found = sessions_.find(peer);
  return found == sessions_.end() ? nullptr : found->second.get();
}

std::vector<PeerSession*> Server::sessions() {
  std::vector<PeerSession*> all;
  for (auto const& [name, session] : sessions_) all.push_back(session.get());
  return all;
}

base::Result<PeerSession*> Server::expect(std::string const& peer) {
  if (auto const fine = check_name(peer); !fine) return std::unexpected(fine.error());
  if (auto* const session = find(peer)) return session;
  return room_for(peer);
}

base::Result<PeerSession*> Server::room_for(std::string const& peer) {
  if (sessions_.size() >= options_.most_peers && !forget_somebody())
    return base::fail(base::ErrorKind::refused,
                      fmt::format("{} far ends are known, and messages wait for each", sessions_.size()),
                      "Let one of them connect and take what waits, or remove its queue's folder.");
  auto queue = open_queue(loop_, options_.end.queues, peer, random_id(options_.end.seed));
  if (!queue) return std::unexpected(queue.error());
  auto session = std::make_unique<PeerSession>(loop_, peer, instance_, *std::move(queue), options_.end.session,
                                               PeerSession::Events{.arrived =
                                                                       [this, peer] {
                                                                         if (events_.arrived)
                                                                           events_.arrived(*find(peer));
                                                                       },
                                                                   .event =
                                                                       [this](Event event) {
                                                                         changed_.notify_all();
                                                                         if (events_.event)
                                                                           events_.event(std::move(event));
                                                                       }});
  return sessions_.emplace(peer, std::move(session)).first->second.get();
}

/// Who is not connected and for whom nothing waits; of several the one that has been away for longest.
bool Server::forget_somebody() {
  auto goes = sessions_.end();
  for (auto at = sessions_.begin(); at != sessions_.end(); ++at) {
    auto const& session = *at->second;
    if (session.is_connected() || session.waiting(Kind::durable) > 0) continue;
    if (goes == sessions_.end() || session.last_connected() < goes->second->last_connected()) goes = at;
  }
  if (goes == sessions_.end()) return false;
  sessions_.erase(goes);
  return true;
}

std::size_t Server::send_to_all(Message const& message) {
  std::size_t failed = 0;
  for (auto const& [name, session] : sessions_)
    if (!session->send(message)) ++failed;
  return failed;
}

void Server::accept(std::unique_ptr<ByteStream> stream) {
  if (options_.end.mode == Mode::json) return find(plain_peer)->attach_plain(std::move(stream));
  auto const waiting = std::ranges::count(strangers_, false, &Stranger::is_done);
  if (std::cmp_greater_equal(waiting, options_.most_strangers)) {
    // Who has had more time to say his name than the newcomer goes.
    auto const oldest = std::ranges::find(strangers_, false, &Stranger::is_done);
    refuse(oldest, RefusedCode::full, "too many connections that say no name");
  }
  auto const stranger =
      strangers_.insert(strangers_.end(), {std::make_unique<Channel>(std::move(stream)), loop_.now()});
  stranger->channel->start({.heard = [this, stranger](Speech speech) { greeted(stranger, std::move(speech)); },
                            .drained = {},
                            .ended = [this, stranger](std::string const&) { dismiss(stranger); }});
  if (!std::exchange(is_hurrying_, true)) scope_.spawn(hurry_strangers());
}

void Server::greeted(Strangers::iterator stranger, Speech speech) {
  if (stranger->is_done) return;
  auto const* const hello = std::get_if<Hello>(&speech);
  if (hello == nullptr) return refuse(stranger, RefusedCode::malformed, "a hello must be the first word");
  if (hello->version != protocol_version)
    return refuse(stranger, RefusedCode::version,
                  fmt::format("version {} is spoken; this server speaks {}", hello->version, protocol_version));
  if (!base::equal_in_constant_time(hello->token, options_.end.token) && !options_.end.token.empty())
    return refuse(stranger, RefusedCode::token,
                  hello->token.empty() ? "this server asks for a token" : "this is not the server's token");
  if (auto const fine = check_name(hello->name); !fine)
    return refuse(stranger, RefusedCode::name, fine.error().message);
  auto const session = expect(hello->name);
  if (!session) return refuse(stranger, RefusedCode::full, session.error().message);
  // The same program comes back before its old connection was found dead; another one of its name does not.
  if ((*session)->is_connected() && (*session)->peer_instance() != hello->instance)
    return refuse(stranger, RefusedCode::name, fmt::format("another program is connected as '{}'", hello->name));
  // The welcome tells how far this hello's streams were heard, so it is said by a session that knows them.
  auto channel = std::move(stranger->channel);
  auto* const raw = channel.get();
  (*session)->attach(std::move(channel), *hello, [&](Hello const& own) {
    Welcome welcome{own};
    welcome.name = options_.end.name;
    raw->say(welcome);
  });
  dismiss(stranger);
}

void Server::refuse(Strangers::iterator stranger, RefusedCode code, std::string reason) {
  if (stranger->is_done) return;
  stranger->channel->say(Refused{code, reason});
  stranger->channel->close();
  if (events_.event) events_.event({EventKind::refused, stranger->channel->peer_name(), std::move(reason)});
  dismiss(stranger);
}

/// On a later turn, as its channel may be on the stack.
void Server::dismiss(Strangers::iterator stranger) {
  if (std::exchange(stranger->is_done, true)) return;
  loop_.post([this, stranger, alive = std::weak_ptr(alive_)] {
    if (alive.expired()) return;
    strangers_.erase(stranger);
    changed_.notify_all();
  });
}

base::Task<> Server::hurry_strangers() {
  while (!strangers_.empty()) {
    co_await loop_.sleep_until(strangers_.front().since + options_.end.hello_timeout);
    for (auto at = strangers_.begin(); at != strangers_.end(); ++at)
      if (!at->is_done && loop_.now() >= at->since + options_.end.hello_timeout)
        refuse(at, RefusedCode::malformed, "no hello came");
    co_await loop_.turn();
  }
  is_hurrying_ = false;
}

}  // namespace lapwing::link::operator_link
