#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lapwing::lsp {

/// The longest message that is read: a script of the greatest size, with room for escapes.
inline constexpr std::size_t max_message_size = std::size_t{32} << 20u;
inline constexpr std::size_t max_header_line = 1024;

/// Cuts a stream of bytes into the messages of the base protocol (LSP 3.17, "Header Part"): lines of `Name: value`, an
/// empty line, and as many bytes as Content-Length says. Survives whatever comes: lines that are no header are skipped,
/// and messages that are too long are read over without being kept. Holds at most one message and what follows it.
class MessageReader {
 public:
  struct Message {
    std::string body;
    std::string mistake;  ///< what is wrong with it; the body is then empty
  };

  explicit MessageReader(std::size_t max_size = max_message_size) : max_size_(max_size) {}

  void feed(std::string_view bytes) { pending_ += bytes; }
  /// The next whole message, or nothing until more bytes are fed.
  [[nodiscard]] std::optional<Message> next();

 private:
  [[nodiscard]] std::optional<std::string_view> take_line();
  void read_header(std::string_view line);
  [[nodiscard]] std::optional<Message> take_body();
  void compact();

  std::size_t max_size_;
  std::string pending_;
  std::size_t at_ = 0;  ///< of `pending_`: what stands before has been read
  std::optional<std::size_t> length_;
  bool in_body_ = false;
  std::size_t to_skip_ = 0;  ///< bytes of a message that is too long
  std::string mistake_;
};

/// The message with its header.
[[nodiscard]] std::string with_header(std::string_view body);

}  // namespace lapwing::lsp
