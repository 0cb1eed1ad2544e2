#include "link/operator_link/client.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::link::operator_link {

base::Result<std::unique_ptr<Client>> Client::open(base::Loop& loop, std::unique_ptr<Dialler> dialler, Options options,
                                                   PeerSession::Events events) {
  if (options.server.empty()) options.server = "server";
  for (auto const& name : {options.end.name, options.server})
    if (auto const fine = check_name(name); !fine) return std::unexpected(fine.error());
  if (options.end.token.size() > longest_token)
    return base::fail(base::ErrorKind::invalid_input, fmt::format("a token of more than {} bytes", longest_token));
  auto const instance = random_id(options.end.seed);
  auto queue = open_queue(loop, options.end.queues, options.server, instance);
  if (!queue) return std::unexpected(queue.error());
  return std::unique_ptr<Client>(
      new Client(loop, std::move(dialler), std::move(options), instance, *std::move(queue), std::move(events)));
}

Client::Client(base::Loop& loop, std::unique_ptr<Dialler> dialler, Options options, std::uint64_t instance,
               std::unique_ptr<DurableQueue> queue, PeerSession::Events events)
    : loop_(loop),
      dialler_(std::move(dialler)),
      options_(std::move(options)),
      event_(events.event),
      back_off_(options_.back_off, instance),
      session_(loop, options_.server, instance, std::move(queue), options_.end.session, std::move(events)),
      scope_(loop) {
  scope_.spawn(keep_connected());
}

Client::~Client() {
  close();
}

void Client::close() {
  scope_.clear();
  session_.detach("the program closed the link");
}

base::Task<> Client::keep_connected() {
  for (;;) {
    auto attempt = connect();
    if (co_await attempt) {
      back_off_.reset();
      last_error_.clear();
      while (session_.is_connected()) co_await session_.changed().wait();
    }
    co_await loop_.sleep(back_off_.wait());
  }
}

base::Task<bool> Client::connect() {
  auto dial = dialler_->dial();
  auto stream = co_await dial;
  if (!stream) {
    fail(EventKind::lost, stream.error().message);
    co_return false;
  }
  if (options_.end.mode == Mode::json) {
    session_.attach_plain(*std::move(stream));
    co_return session_.is_connected();
  }
  auto greeting = greet(*std::move(stream));
  co_return co_await greeting;
}

base::Task<bool> Client::greet(std::unique_ptr<ByteStream> stream) {
  auto const deadline = loop_.now() + options_.end.hello_timeout;
  is_answered_ = false;
  greeting_ = std::make_unique<Channel>(std::move(stream));
  greeting_->start({.heard = [this](Speech speech) { answered(std::move(speech)); },
                    .drained = {},
                    .ended =
                        [this](std::string why) {
                          if (!std::exchange(is_answered_, true)) fail(EventKind::lost, std::move(why));
                        }});
  auto hello = session_.hello();
  hello.name = options_.end.name;
  hello.token = options_.end.token;
  greeting_->say(hello);
  greeting_->flush();
  while (!is_answered_ && loop_.now() < deadline) co_await session_.changed().wait_until(deadline);
  if (!is_answered_) fail(EventKind::lost, "the far end takes connections and says nothing");
  greeting_.reset();  // unless the session has it
  co_return session_.is_connected();
}

/// The session takes the channel over at once: messages may stand right behind the welcome.
void Client::answered(Speech speech) {
  if (std::exchange(is_answered_, true)) return;
  session_.changed().notify_all();
  if (auto const* const refused = std::get_if<Refused>(&speech)) return fail(EventKind::refused, refused->reason);
  auto const* const welcome = std::get_if<Welcome>(&speech);
  if (welcome == nullptr) return fail(EventKind::malformed, "the far end answers a hello with something else");
  if (welcome->version != protocol_version)
    return fail(EventKind::refused,
                fmt::format("the server speaks version {}, this program {}", welcome->version, protocol_version));
  if (options_.server != "server" && welcome->name != options_.server)
    return fail(EventKind::refused, fmt::format("this is '{}', not '{}'", welcome->name, options_.server));
  session_.attach(std::move(greeting_), *welcome);
}

void Client::fail(EventKind kind, std::string why) {
  // Each reason once: an hour of attempts is no news.
  bool const is_news = last_error_ != why;
  last_error_ = std::move(why);
  session_.changed().notify_all();
  if (is_news && event_) event_({kind, dialler_->name(), last_error_});
}

}  // namespace lapwing::link::operator_link
