#include "link/operator_link/wire/protocol.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "link/operator_link/wire/byte_order.hpp"

namespace lapwing::link::operator_link {

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

std::unexpected<base::Error> fault(std::string what) {
  return base::fail(base::ErrorKind::invalid_input, std::move(what), "Both ends must be of one version.");
}

/// Bytes of bodies.
class Writer {
 public:
  Writer() : writer_(body_) {}

  void operator()(Hello const& hello) {
    type_ = FrameType::hello;
    hello_body(hello);
  }
  void operator()(Welcome const& welcome) {
    type_ = FrameType::welcome;
    hello_body(welcome);
  }
  void operator()(Refused const& refused) {
    type_ = FrameType::refused;
    writer_.number(static_cast<std::uint16_t>(refused.code));
    writer_.text<std::uint16_t>(refused.reason);
  }
  void operator()(Data const& data) {
    type_ = FrameType::data;
    writer_.number(static_cast<std::uint8_t>(data.kind));
    writer_.number(data.number);
    writer_.number(static_cast<std::uint32_t>(data.left.count()));
    writer_.number(static_cast<std::uint64_t>(data.sent.count()));
    writer_.text<std::uint8_t>(data.key);
    writer_.bytes(data.text);
  }
  void operator()(Ack const& ack) {
    type_ = FrameType::ack;
    writer_.number(static_cast<std::uint8_t>(ack.kind));
    writer_.number(ack.number);
  }
  void operator()(Returned const& returned) {
    type_ = FrameType::returned;
    writer_.number(static_cast<std::uint8_t>(returned.kind));
    writer_.number(returned.number);
    writer_.number(static_cast<std::uint8_t>(returned.why));
  }
  void operator()(Ping const& ping) {
    type_ = FrameType::ping;
    writer_.number(static_cast<std::uint64_t>(ping.sent.count()));
  }
  void operator()(Pong const& pong) {
    type_ = FrameType::pong;
    writer_.number(static_cast<std::uint64_t>(pong.sent.count()));
  }
  void operator()(Bye const& bye) {
    type_ = FrameType::bye;
    writer_.text<std::uint16_t>(bye.reason);
  }

  void finish(std::vector<std::uint8_t>& to) const { write_frame(to, type_, body_); }

 private:
  void hello_body(Hello const& hello) {
    writer_.number(hello.version);
    writer_.number(hello.instance);
    for (auto const& lane : hello.lanes)
      for (auto const number : {lane.stream, lane.oldest, lane.heard_stream, lane.heard}) writer_.number(number);
    writer_.number(hello.window.messages);
    writer_.number(hello.window.bytes);
    writer_.number(static_cast<std::uint32_t>(hello.silence.count()));
    writer_.text<std::uint8_t>(hello.name);
    writer_.text<std::uint16_t>(hello.token);
  }

  FrameType type_ = FrameType::bye;
  std::vector<std::uint8_t> body_;
  ByteWriter writer_;
};

/// Each of the readers leaves it to `ByteReader::is_whole` to say that something was missing.
base::Result<Hello> read_hello(ByteReader& reader) {
  Hello hello;
  hello.version = reader.number<std::uint16_t>();
  hello.instance = reader.number<std::uint64_t>();
  for (auto& lane : hello.lanes)
    for (auto* number : {&lane.stream, &lane.oldest, &lane.heard_stream, &lane.heard})
      *number = reader.number<std::uint64_t>();
  hello.window.messages = reader.number<std::uint32_t>();
  hello.window.bytes = reader.number<std::uint32_t>();
  hello.silence = milliseconds(reader.number<std::uint32_t>());
  hello.name = reader.text<std::uint8_t>();
  hello.token = reader.text<std::uint16_t>();
  for (auto const& lane : hello.lanes)
    if (lane.oldest >= number_limit || lane.heard >= number_limit) return fault("a hello with numbers that cannot be");
  return hello;
}

base::Result<Kind> read_kind(ByteReader& reader) {
  auto const kind = reader.number<std::uint8_t>();
  if (kind >= kinds) return fault(fmt::format("there is no lane {}", kind));
  return static_cast<Kind>(kind);
}

/// Microseconds beyond what a clock can count to are as wrong as missing ones, and must not overflow.
base::Result<microseconds> read_time(ByteReader& reader) {
  constexpr std::uint64_t most = 1'000'000'000'000'000;  // thirty years
  auto const time = reader.number<std::uint64_t>();
  if (time > most) return fault(fmt::format("a time of {} us", time));
  return microseconds(static_cast<std::int64_t>(time));
}

base::Result<Speech> read_data(ByteReader& reader) {
  Data data;
  auto const kind = read_kind(reader);
  if (!kind) return std::unexpected(kind.error());
  data.kind = *kind;
  data.number = reader.number<std::uint64_t>();
  data.left = milliseconds(reader.number<std::uint32_t>());
  auto const sent = read_time(reader);
  if (!sent) return std::unexpected(sent.error());
  data.sent = *sent;
  data.key = reader.text<std::uint8_t>();
  data.text = reader.rest();
  if (data.number == 0 || data.number >= number_limit)
    return fault(fmt::format("a message with number {}", data.number));
  if (data.text.size() > longest_text) return fault(fmt::format("a message of {} bytes", data.text.size()));
  return data;
}

base::Result<Speech> read_ack(ByteReader& reader) {
  auto const kind = read_kind(reader);
  if (!kind) return std::unexpected(kind.error());
  return Ack{*kind, reader.number<std::uint64_t>()};
}

base::Result<Speech> read_returned(ByteReader& reader) {
  auto const kind = read_kind(reader);
  if (!kind) return std::unexpected(kind.error());
  auto const number = reader.number<std::uint64_t>();
  auto const why = reader.number<std::uint8_t>();
  if (why != static_cast<std::uint8_t>(Outcome::overtaken) && why != static_cast<std::uint8_t>(Outcome::expired))
    return fault(fmt::format("a message came back for reason {}, which there is not", why));
  return Returned{*kind, number, static_cast<Outcome>(why)};
}

template <class T>
base::Result<Speech> read_stamp(ByteReader& reader) {
  auto const sent = read_time(reader);
  if (!sent) return std::unexpected(sent.error());
  return T{*sent};
}

base::Result<Speech> read_known(FrameType type, ByteReader& reader) {
  switch (type) {
    case FrameType::hello: {
      auto hello = read_hello(reader);
      if (!hello) return std::unexpected(std::move(hello).error());
      return *std::move(hello);
    }
    case FrameType::welcome: {
      auto hello = read_hello(reader);
      if (!hello) return std::unexpected(std::move(hello).error());
      return Welcome{*std::move(hello)};
    }
    case FrameType::refused: {
      auto const code = static_cast<RefusedCode>(reader.number<std::uint16_t>());
      return Refused{code, reader.text<std::uint16_t>()};
    }
    case FrameType::data: return read_data(reader);
    case FrameType::ack: return read_ack(reader);
    case FrameType::returned: return read_returned(reader);
    case FrameType::ping: return read_stamp<Ping>(reader);
    case FrameType::pong: return read_stamp<Pong>(reader);
    case FrameType::bye: return Bye{reader.text<std::uint16_t>()};
  }
  return fault("no frame");
}

}  // namespace

void write(std::vector<std::uint8_t>& to, Speech const& speech) {
  Writer writer;
  std::visit(writer, speech);
  writer.finish(to);
}

base::Result<std::optional<Speech>> read(Frame const& frame) {
  if (frame.type < FrameType::hello || frame.type > FrameType::bye) return std::optional<Speech>();
  ByteReader reader(frame.body);
  auto speech = read_known(frame.type, reader);
  if (!speech) return std::unexpected(std::move(speech).error());
  // A hello of another version may be longer; who reads it looks at the version first.
  auto const* hello = std::get_if<Hello>(&*speech);
  bool const is_other = hello != nullptr && hello->version > protocol_version;
  if (!is_other && !reader.is_whole())
    return fault(fmt::format("a frame of type {} has {} bytes, which is not what belongs into it",
                             static_cast<int>(frame.type), frame.body.size()));
  return std::optional<Speech>(*std::move(speech));
}

}  // namespace lapwing::link::operator_link
