#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::link::pictures {

/// One whole HTTP answer.
struct HttpAnswer {
  int status = 0;
  std::string content_type = {};
  std::string location = {};
  std::string body = {};
};

/// Reads one HTTP answer that says its length. Pure: knows no socket.
class AnswerReader {
 public:
  static constexpr std::size_t largest_head = 8192;
  static constexpr std::size_t largest_body = std::size_t{64} * 1024;

  /// The answer, once all of it is there. Error: invalid_input: it is none, or longer than an answer to an offer could
  /// be. After either nothing more is to be taken.
  [[nodiscard]] base::Result<std::optional<HttpAnswer>> take(std::string_view bytes);

 private:
  [[nodiscard]] base::Result<> read_head(std::string_view head);

  std::string buffer_;
  std::optional<HttpAnswer> answer_;  ///< without its body
  std::size_t length_ = 0;
};

}  // namespace lapwing::link::pictures
