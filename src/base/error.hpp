#pragma once

#include <expected>
#include <string>
#include <utility>

namespace lapwing::base {

/// What a caller can do about a failure. Callers branch on the kind, people read the message.
enum class ErrorKind {
  invalid_input,  ///< the request itself is wrong: do not retry
  not_found,      ///< the named thing does not exist
  refused,        ///< the other side understood and said no
  timed_out,      ///< no answer in time: may be retried
  lost,           ///< the vehicle or link went away
  cancelled,      ///< stopped on request
  io,             ///< the operating system said no
};

/// An expected failure. `message` says what went wrong and where, `hint` what to do about it (may be empty).
struct Error {
  ErrorKind kind;
  std::string message;
  std::string hint = {};
};

/// Failures that a caller can meet in normal operation are values, never exceptions.
template <class T = void>
using Result = std::expected<T, Error>;

[[nodiscard]] inline std::unexpected<Error> fail(ErrorKind kind, std::string message, std::string hint = {}) {
  return std::unexpected<Error>(Error{kind, std::move(message), std::move(hint)});
}

}  // namespace lapwing::base
