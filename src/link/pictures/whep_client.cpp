#include "link/pictures/whep_client.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "link/pictures/answer_reader.hpp"
#include "link/pictures/http_head.hpp"

namespace lapwing::link::pictures {

using namespace std::chrono_literals;
using base::ErrorKind;

namespace {

/// A drone finds its addresses at once, and makes a certificate in tenths of a second.
constexpr base::Duration patience = 8s;
constexpr base::Duration look_again = 20ms;
constexpr int created = 201;
constexpr int least_refusal = 400;
constexpr std::string_view sessions = "/api/v1/whep/sessions/";

std::unexpected<base::Error> lost(std::string_view why) {
  return base::fail(ErrorKind::lost, fmt::format("FailedToSend: {}", why));
}

/// One request on a connection of its own.
class Exchange {
 public:
  [[nodiscard]] base::Task<base::Result<HttpAnswer>> run(base::Loop& loop, Source source, std::string request) {
    auto opened = link::open(loop, {.transport = Transport::tcp_out, .host = source.host, .port_or_baud = source.port});
    if (!opened) co_return std::unexpected(opened.error());
    auto const link = *std::move(opened);
    link->start([this](Peer, Bytes bytes) { take(bytes); });
    auto const deadline = loop.now() + patience;
    while (link->state() != LinkState::open && link->last_error().empty() && loop.now() < deadline)
      co_await loop.sleep(look_again);
    if (link->state() != LinkState::open)
      co_return lost(fmt::format("nobody answers at {}:{}, where its video is asked for ({})", source.host, source.port,
                                 link->last_error().empty() ? "it takes too long" : link->last_error()));
    (void)link->send(Peer{}, {reinterpret_cast<std::uint8_t const*>(request.data()), request.size()});
    while (!read_ && link->state() == LinkState::open && loop.now() < deadline) co_await loop.sleep(look_again);
    if (!read_) co_return lost("the drone gives no answer");
    if (!*read_) co_return lost(read_->error().message);
    co_return **std::move(read_);
  }

 private:
  void take(Bytes bytes) {
    if (read_) return;
    auto read = reader_.take({reinterpret_cast<char const*>(bytes.data()), bytes.size()});
    if (!read) read_ = std::unexpected(read.error());
    if (read && *read) read_ = **std::move(read);
  }

  AnswerReader reader_;
  std::optional<base::Result<HttpAnswer>> read_;
};

std::string authorization(Source const& source) {
  return source.token.empty() ? "" : fmt::format("Authorization: Bearer {}\r\n", source.token);
}

base::Error refusal(HttpAnswer const& answer) {
  auto const told = nlohmann::json::parse(answer.body, nullptr, false);
  bool const has_words = told.is_object() && told.contains("detail") && told.at("detail").is_string();
  auto const why = has_words ? told.at("detail").get<std::string>() : std::string();
  return {.kind = ErrorKind::refused,
          .message = fmt::format("the drone's video: {}",
                                 why.empty() ? fmt::format("HTTP {}", answer.status) : printable(why))};
}

/// As names of sessions are here: they become a part of other addresses.
bool is_name(std::string_view session) {
  constexpr std::size_t longest = 64;
  return !session.empty() && session.size() <= longest && std::ranges::all_of(session, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  });
}

}  // namespace

base::Task<base::Result<VideoSession>> begin_video(base::Loop& loop, Source source, View view, std::string offer) {
  std::string_view const mjpeg = path_of(view);
  auto request = fmt::format(
      "POST /api/v1/whep{} HTTP/1.1\r\nHost: localhost\r\n{}Content-Type: application/sdp\r\nContent-Length: {}\r\n"
      "Connection: close\r\n\r\n{}",
      mjpeg.substr(0, mjpeg.find('.')), authorization(source), offer.size(), offer);
  Exchange exchange;
  auto asking = exchange.run(loop, std::move(source), std::move(request));
  auto answer = co_await asking;
  if (!answer) co_return std::unexpected(answer.error());
  if (answer->status >= least_refusal) co_return std::unexpected(refusal(*answer));
  auto const session = std::string_view(answer->location).substr(std::min(sessions.size(), answer->location.size()));
  if (answer->status != created || !answer->content_type.starts_with("application/sdp") ||
      !answer->location.starts_with(sessions) || !is_name(session))
    co_return lost("what answers at the address of the drone's video speaks no WHEP");
  co_return VideoSession{.answer = std::move(answer->body), .session = std::string(session)};
}

base::Task<base::Result<>> end_video(base::Loop& loop, Source source, std::string session) {
  if (!is_name(session)) co_return base::fail(ErrorKind::not_found, "there is no such session");
  auto request = fmt::format("DELETE {}{} HTTP/1.1\r\nHost: localhost\r\n{}Connection: close\r\n\r\n", sessions,
                             session, authorization(source));
  Exchange exchange;
  auto asking = exchange.run(loop, std::move(source), std::move(request));
  auto const answer = co_await asking;
  if (!answer) co_return std::unexpected(answer.error());
  if (answer->status >= least_refusal) co_return std::unexpected(refusal(*answer));
  co_return base::Result<>();
}

}  // namespace lapwing::link::pictures
