#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace lapwing::host {

/// What goes between a program and the one that looks at pictures for it, both ways: a line of JSON, an object, and as
/// many bytes after it as its `bytes` says, none where it does not. Requests name what is looked for in `look`, answers
/// to one that could not be met have an `error`. The words of one request are in a file of their own: sign_look.hpp.
struct LookFrame {
  nlohmann::json head = nlohmann::json::object();
  std::string body = {};
};

inline constexpr std::size_t most_head_bytes = std::size_t{1} << 20U;
inline constexpr std::size_t most_body_bytes = std::size_t{128} << 20U;

/// With `bytes` set to the body's size.
[[nodiscard]] std::string to_bytes(LookFrame frame);

/// Finds frames in what comes in piece by piece.
class LookFrameReader {
 public:
  void take(std::string_view bytes) { text_.append(bytes); }
  /// The next whole one; nothing until there is one. Errors, invalid_input, after which nothing is to be read any more:
  /// no object, a head or a body that is too long.
  [[nodiscard]] base::Result<std::optional<LookFrame>> next();
  /// There is none, not even the beginning of one.
  [[nodiscard]] bool is_empty() const { return text_.empty() && !head_; }

 private:
  [[nodiscard]] base::Result<bool> read_head();

  std::string text_;
  std::optional<nlohmann::json> head_;  ///< of the frame whose body is still coming
  std::size_t body_bytes_ = 0;
};

/// A number of pixels or bytes in a head, from 0 to `most_body_bytes`; nothing where there is none.
[[nodiscard]] std::optional<std::int64_t> count_in(nlohmann::json const& head, std::string_view key);

/// The answer to a request that cannot be met.
[[nodiscard]] LookFrame refusal(std::string_view message);
/// What such an answer says; nothing of another.
[[nodiscard]] std::optional<std::string> refusal_in(LookFrame const& answer);

}  // namespace lapwing::host
