#pragma once

#include <expected>
#include <string>
#include <utility>

#include "dolphin/value/value.hpp"

namespace lapwing::dolphin {

/// How an exception ends the program.
enum class Ending {
  error,                ///< as a script error, unless caught
  halts_unless_caught,  ///< as `halt` would: what keeps the mission from being flown as written, such as no vehicle in
                        ///< time
  halts,                ///< by `halt`: nothing catches it, only `finally` runs on its way
};

/// Something went wrong in a running script: what `catch` sees. `type` is the class name that scripts catch by.
struct Fault {
  std::string type;
  std::string message;
  Ending ending = Ending::error;
  Value thrown = {};  ///< when the script's own exception goes on: that, instead of the above
};

/// The result of one operation of the language, or the exception that it throws.
template <class T>
using Checked = std::expected<T, Fault>;

[[nodiscard]] inline std::unexpected<Fault> fault(std::string message, std::string type = "RuntimeException") {
  return std::unexpected<Fault>(Fault{std::move(type), std::move(message)});
}

[[nodiscard]] inline std::unexpected<Fault> halting(std::string message, std::string type = "VehicleError") {
  return std::unexpected<Fault>(Fault{std::move(type), std::move(message), Ending::halts_unless_caught});
}

}  // namespace lapwing::dolphin
