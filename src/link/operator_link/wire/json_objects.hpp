#pragma once

#include <cstdint>
#include <deque>
#include <expected>
#include <optional>
#include <string>

#include "link/byte_link.hpp"
#include "link/operator_link/message.hpp"

namespace lapwing::link::operator_link {

/// JSON objects out of a stream of bytes in which they may be split and joined anywhere, with line ends or blanks
/// between them or with nothing: what old parts send.
///
/// It looks at brackets and quotes only; whether an object is JSON throughout its reader sees. What cannot be one is
/// told as a fault, once, and reading goes on at the next beginning: a raw line end within a text, a bracket that does
/// not match, an object where none can stand (the one before was cut off there), whatever stands between objects.
/// Nothing is dropped without a word. Memory: one object's, and what a call of `feed` completes.
class JsonObjects {
 public:
  /// An object as it came, without what stood around it, or what was wrong.
  using Item = std::expected<std::string, std::string>;

  explicit JsonObjects(std::size_t longest = longest_text) : longest_(longest) {}

  void feed(Bytes bytes);
  [[nodiscard]] std::optional<Item> next();

 private:
  void between(char c);
  void within(char c);
  void within_text(char c);
  void open(char c);
  void close(char c);
  void begin();
  void keep(char c);
  void finish();
  void give_up(std::string why);
  [[nodiscard]] bool may_open_object() const;

  std::size_t longest_;
  std::deque<Item> items_;
  std::string object_;
  std::string brackets_;  ///< those that are open
  char before_ = '\0';    ///< the last that was no blank
  bool in_text_ = false;
  bool is_escaped_ = false;
  bool is_too_long_ = false;  ///< told already; what follows of it is left out
  bool in_garbage_ = false;   ///< told already
};

}  // namespace lapwing::link::operator_link
