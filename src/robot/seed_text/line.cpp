#include "robot/seed_text/line.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace lapwing::robot::seed_text {

namespace {

bool is_encoded(unsigned char byte) {
  return byte == '_' || byte == '%' || byte < 0x20 || byte == 0x7F;
}

std::string encoded(std::string_view message) {
  std::string text;
  for (auto const character : message) {
    auto const byte = static_cast<unsigned char>(character);
    if (is_encoded(byte))
      text += fmt::format("%{:02X}", byte);
    else
      text += character;
  }
  return text;
}

std::optional<unsigned> hexadecimal(char digit) {
  if (digit >= '0' && digit <= '9') return static_cast<unsigned>(digit - '0');
  if (digit >= 'A' && digit <= 'F') return static_cast<unsigned>(digit - 'A' + 10);
  if (digit >= 'a' && digit <= 'f') return static_cast<unsigned>(digit - 'a' + 10);
  return std::nullopt;
}

base::Result<std::string> decoded(std::string_view text) {
  std::string message;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      message += text[i];
      continue;
    }
    auto const high = i + 1 < text.size() ? hexadecimal(text[i + 1]) : std::nullopt;
    auto const low = i + 2 < text.size() ? hexadecimal(text[i + 2]) : std::nullopt;
    if (!high || !low)
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("column {} of the message: % without two digits", i + 1), "write % itself as %25");
    message += static_cast<char>(*high * 16 + *low);
    i += 2;
  }
  return message;
}

/// Up to the next `_`, which is taken, too.
std::optional<std::string_view> field(std::string_view& text) {
  auto const end = text.find('_');
  if (end == std::string_view::npos) return std::nullopt;
  auto const found = text.substr(0, end);
  text.remove_prefix(end + 1);
  return found;
}

base::Result<Module> module_named(std::string_view name, std::string_view what) {
  if (auto const module = module_of(name)) return *module;
  return base::fail(base::ErrorKind::invalid_input, fmt::format("the {} is none of the modules", what),
                    "they are SIM, CAR, MMU, PLN, POI, CM, VSL and CC");
}

base::Result<std::chrono::milliseconds> stamp(std::string_view text) {
  std::int64_t value = -1;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > latest_stamp.count())
    return base::fail(base::ErrorKind::invalid_input, "the time stamp is no number of milliseconds since the start");
  return std::chrono::milliseconds(value);
}

}  // namespace

base::Result<std::string> write(Line const& line) {
  auto const message = encoded(line.message);
  if (line.stamp.count() < 0 || line.stamp > latest_stamp)
    return base::fail(base::ErrorKind::invalid_input, "the time stamp cannot be");
  if (message.size() > longest_message)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("the message takes {} characters; {} is the most", message.size(), longest_message));
  return fmt::format("{}_{}_{}_{}\n", name_of(line.from).short_name, name_of(line.to).short_name, line.stamp.count(),
                     message);
}

base::Result<Line> read(std::string_view text) {
  if (text.size() > longest_line)
    return base::fail(base::ErrorKind::invalid_input, fmt::format("longer than {} characters", longest_line));
  auto const sender = field(text);
  auto const receiver = field(text);
  auto const time = field(text);
  if (!sender || !receiver || !time)
    return base::fail(base::ErrorKind::invalid_input, "not Sender_Receiver_TimeStamp_Message: three _ are needed");
  auto const from = module_named(*sender, "sender");
  if (!from) return std::unexpected(from.error());
  auto const to = module_named(*receiver, "receiver");
  if (!to) return std::unexpected(to.error());
  auto const when = stamp(*time);
  if (!when) return std::unexpected(when.error());
  auto message = decoded(text);
  if (!message) return std::unexpected(message.error());
  return Line{.from = *from, .to = *to, .stamp = *when, .message = *std::move(message)};
}

void LineReader::feed(std::span<std::uint8_t const> bytes, std::function<void(std::string_view)> const& each) {
  for (auto const byte : bytes) {
    if (byte == '\n' || byte == '\r') {
      // Two line ends in a row are one, whichever they are.
      if (is_too_long_) ++too_long_;
      if (!is_too_long_ && !rest_.empty()) each(rest_);
      rest_.clear();
      is_too_long_ = false;
    } else if (rest_.size() == longest_line) {
      is_too_long_ = true;
    } else {
      rest_ += static_cast<char>(byte);
    }
  }
}

}  // namespace lapwing::robot::seed_text
