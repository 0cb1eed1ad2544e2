#include "video/webrtc/offer.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace lapwing::video {

using base::ErrorKind;
using base::fail;

namespace {

constexpr std::size_t most_sections = 8;
constexpr std::size_t longest_line = 4096;
constexpr std::size_t longest_word = 64;
constexpr std::string_view end_of_line = "\r\n";

bool is_alphanumeric(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Printable, without blanks.
bool is_word(std::string_view text) {
  return !text.empty() && text.size() <= longest_word &&
         std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
}

/// RFC 8839: ice-char.
bool is_ice_word(std::string_view text, std::size_t shortest) {
  constexpr std::size_t longest = 256;
  return text.size() >= shortest && text.size() <= longest &&
         std::ranges::all_of(text, [](char c) { return is_alphanumeric(c) || c == '+' || c == '/'; });
}

bool is_fingerprint(std::string_view text) {
  constexpr std::string_view hash = "sha-256 ";
  constexpr std::size_t bytes = 32;
  constexpr std::size_t characters_a_byte = 3;  // "0A:"
  if (!text.starts_with(hash) || text.size() != hash.size() + bytes * characters_a_byte - 1) return false;
  text.remove_prefix(hash.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    bool const is_colon = i % characters_a_byte == characters_a_byte - 1;
    if (is_colon ? text[i] != ':' : !std::string_view("0123456789ABCDEFabcdef").contains(text[i])) return false;
  }
  return true;
}

/// What follows the blank behind the first word; that word is left in `text`.
std::string_view take_rest(std::string_view& text) {
  auto const blank = text.find(' ');
  auto const rest = blank == std::string_view::npos ? std::string_view() : text.substr(blank + 1);
  text = text.substr(0, blank);
  return rest;
}

std::optional<unsigned> number_of(std::string_view text) {
  unsigned number = 0;
  auto const [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// The value of `key` among "a=1;b=2", with or without blanks behind the semicolons.
std::string_view parameter(std::string_view list, std::string_view key) {
  while (!list.empty()) {
    auto const end = std::min(list.find(';'), list.size());
    auto one = list.substr(0, end);
    list.remove_prefix(std::min(list.size(), end + 1));
    one.remove_prefix(std::min(one.size(), one.find_first_not_of(' ')));
    if (one.starts_with(key) && one.substr(key.size()).starts_with('=')) return one.substr(key.size() + 1);
  }
  return {};
}

/// The profile's bytes are the baseline's with all that the constrained one leaves out; the level may be any.
bool is_constrained_baseline(std::string_view profile_level) {
  constexpr std::size_t length = 6;
  constexpr std::size_t profile = 4;
  if (profile_level.size() != length) return false;
  auto const of = profile_level.substr(0, profile);
  return of == "42e0" || of == "42E0" || of == "42c0" || of == "42C0";
}

/// Reads the lines of an offer, and notes what counts of those of its video.
class Reader {
 public:
  base::Result<Offer> read(std::string_view sdp) {
    if (sdp.size() > largest_offer) return malformed("it is too long");
    if (!sdp.starts_with("v=0\r\n") && !sdp.starts_with("v=0\n")) return malformed("it does not begin with v=0");
    while (!sdp.empty()) {
      auto const end = std::min(sdp.find('\n'), sdp.size());
      auto line = sdp.substr(0, end);
      sdp.remove_prefix(std::min(sdp.size(), end + 1));
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (auto const taken = take(line); !taken) return std::unexpected(taken.error());
    }
    return complete();
  }

 private:
  /// Of the session and of its video, where a line of the latter counts before one of the former.
  struct Transport {
    std::string_view user, password, fingerprint;
  };

  static std::unexpected<base::Error> malformed(std::string_view why) {
    return fail(ErrorKind::invalid_input, fmt::format("this is no offer of a viewer: {}", why),
                "send what RTCPeerConnection.createOffer() gives, as application/sdp");
  }
  static std::unexpected<base::Error> unsuitable(std::string_view why) {
    return fail(ErrorKind::refused, fmt::format("what is shown here cannot be sent as that offer asks: {}", why),
                "offer to receive one video of H.264, constrained baseline");
  }

  base::Result<> take(std::string_view line) {
    if (line.size() > longest_line) return malformed("a line of it is too long");
    if (line.starts_with("m=")) return begin_section(line.substr(2));
    if (!line.starts_with("a=")) return {};
    auto name = line.substr(2);
    auto const colon = std::min(name.find(':'), name.size());
    auto const value = name.substr(std::min(name.size(), colon + 1));
    name = name.substr(0, colon);
    if (name == "mid" && !offer_.sections.empty()) {
      if (!is_word(value)) return malformed("a section's mid is no word");
      offer_.sections.back().mid = value;
    }
    if (offer_.sections.empty() || is_video_) take_attribute(name, value);
    return {};
  }

  base::Result<> begin_section(std::string_view kind) {
    if (offer_.sections.size() == most_sections) return malformed("it has too many sections");
    auto port = take_rest(kind);
    auto protocol = take_rest(port);
    auto formats = take_rest(protocol);
    take_rest(formats);
    for (auto const word : {kind, protocol, formats})
      if (!is_word(word)) return malformed("a section of it is none");
    is_video_ = kind == "video";
    if (is_video_ && has_video_) return unsuitable("it has several videos");
    if (is_video_) {
      has_video_ = true;
      offer_.video = offer_.sections.size();
      if (protocol != "UDP/TLS/RTP/SAVPF") return unsuitable("it wants none over DTLS and SRTP");
    }
    offer_.sections.push_back(
        {.kind = std::string(kind), .protocol = std::string(protocol), .format = std::string(formats)});
    return {};
  }

  void take_attribute(std::string_view name, std::string_view value) {
    auto& transport = is_video_ ? of_video_ : of_session_;
    if (name == "ice-ufrag") transport.user = value;
    if (name == "ice-pwd") transport.password = value;
    if (name == "fingerprint") transport.fingerprint = value;
    if (!is_video_) return;
    is_sender_ = is_sender_ || name == "sendonly" || name == "inactive";
    auto const settings = take_rest(value);
    auto const type = number_of(value);
    constexpr unsigned most = 127;
    if (!type || *type > most) return;
    if (name == "rtpmap" && (settings == "H264/90000" || settings == "h264/90000")) h264_.push_back(*type);
    bool const suits = parameter(settings, "packetization-mode") == "1" &&
                       is_constrained_baseline(parameter(settings, "profile-level-id"));
    if (name == "fmtp" && suits) suitable_.push_back(*type);
  }

  base::Result<Offer> complete() {
    if (!has_video_) return unsuitable("it has no video");
    if (is_sender_) return unsuitable("it does not receive the video");
    for (auto const& section : offer_.sections)
      if (section.mid.empty()) return malformed("a section has no mid");
    auto const either = [](std::string_view first, std::string_view second) { return first.empty() ? second : first; };
    offer_.ice_user = either(of_video_.user, of_session_.user);
    offer_.ice_password = either(of_video_.password, of_session_.password);
    offer_.fingerprint = either(of_video_.fingerprint, of_session_.fingerprint);
    constexpr std::size_t shortest_user = 4;
    constexpr std::size_t shortest_password = 22;
    if (!is_ice_word(offer_.ice_user, shortest_user) || !is_ice_word(offer_.ice_password, shortest_password))
      return malformed("its ice-ufrag or ice-pwd is missing or none");
    if (!is_fingerprint(offer_.fingerprint)) return malformed("its fingerprint is no SHA-256");
    for (auto const type : suitable_)
      if (std::ranges::find(h264_, type) != h264_.end()) {
        offer_.payload_type = static_cast<std::uint8_t>(type);
        return std::move(offer_);
      }
    return unsuitable("it has no H.264, constrained baseline, packetization mode 1");
  }

  Offer offer_;
  bool has_video_ = false;
  bool is_video_ = false;
  bool is_sender_ = false;
  Transport of_session_;
  Transport of_video_;
  std::vector<unsigned> h264_;
  std::vector<unsigned> suitable_;
};

}  // namespace

base::Result<Offer> read_offer(std::string_view sdp) {
  return Reader().read(sdp);
}

std::string text_of(Offer const& offer) {
  auto const& mid = offer.sections.at(offer.video).mid;
  return fmt::format(
      "v=0\r\no=- 0 0 IN IP4 0.0.0.0\r\ns=-\r\nt=0 0\r\na=group:BUNDLE {0}\r\n"
      "m=video 9 UDP/TLS/RTP/SAVPF {1}\r\nc=IN IP4 0.0.0.0\r\na=ice-ufrag:{2}\r\na=ice-pwd:{3}\r\na=fingerprint:{4}\r\n"
      "a=setup:actpass\r\na=mid:{0}\r\na=recvonly\r\na=rtcp-mux\r\na=rtcp-rsize\r\na=rtpmap:{1} H264/90000\r\n"
      "a=rtcp-fb:{1} ccm fir\r\na=rtcp-fb:{1} nack pli\r\n"
      "a=fmtp:{1} level-asymmetry-allowed=1;packetization-mode=1;profile-level-id=42e01f\r\n",
      mid, offer.payload_type, offer.ice_user, offer.ice_password, offer.fingerprint);
}

std::string answer_to(Offer const& offer, std::string_view video_answer) {
  auto const video = std::min(video_answer.find("m=video "), video_answer.size());
  std::string answer(video_answer.substr(0, video));
  for (std::size_t i = 0; i < offer.sections.size(); ++i) {
    auto const& [kind, protocol, format, mid] = offer.sections.at(i);
    if (i == offer.video)
      answer += video_answer.substr(video);
    else
      fmt::format_to(std::back_inserter(answer), "m={} 0 {} {}{}c=IN IP4 0.0.0.0{}a=inactive{}a=mid:{}{}", kind,
                     protocol, format, end_of_line, end_of_line, end_of_line, mid, end_of_line);
  }
  return answer;
}

}  // namespace lapwing::video
