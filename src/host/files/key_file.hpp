#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/async/scope.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::host {

/// How this program signs MAVLink: what --signing-key names.
struct SigningSetup {
  std::optional<mavlink::KeyRing> ring = std::nullopt;  ///< nothing: nothing is signed
  mavlink::SigningTime signed_until = 0;                ///< by an earlier run
  std::string time_file = {};                           ///< where the next run learns it
};
/// Of the file `path`, which nobody but its owner may read: 64 hexadecimal digits are a key, a text with the table
/// [keys] is a key store, anything else a pass phrase. Without a path nothing is signed. Errors never hold any of it.
[[nodiscard]] base::Result<SigningSetup> read_signing(std::string const& path);

/// A key store; not_found when there is none.
[[nodiscard]] base::Result<mavlink::KeyRing> read_key_store(std::string const& path);
/// Replaces it as a whole, mode 0600. It is on the disk when this returns.
[[nodiscard]] base::Result<> write_key_store(std::string const& path, mavlink::KeyRing const& ring);
/// From the operating system's random numbers.
[[nodiscard]] base::Result<mavlink::SigningKey> random_key();

/// Keeps on disk up to which time a program has signed, so that the next run goes on after it, even if the clock was
/// set back or this run is killed: what is written during a run lies one period ahead, what is written at its end is
/// exact.
class SigningTimeKeeper {
 public:
  /// `signed_until` tells it, 0 while nothing is signed; asked until the end. Without a file nothing is kept.
  SigningTimeKeeper(base::Loop& loop, std::function<mavlink::SigningTime()> signed_until, std::string file,
                    base::Logger log);
  SigningTimeKeeper(SigningTimeKeeper const&) = delete;
  SigningTimeKeeper& operator=(SigningTimeKeeper const&) = delete;
  ~SigningTimeKeeper();

 private:
  base::Task<> keep();
  void write(mavlink::SigningTime time);

  base::Loop& loop_;
  std::function<mavlink::SigningTime()> signed_until_;
  std::string file_;
  base::Logger log_;
  mavlink::SigningTime written_ = 0;  ///< by this keeper
  bool has_warned_ = false;
  base::Scope scope_;
};

/// Of the option --signing-key.
inline constexpr auto signing_key_help =
    "File with a key or a key store (lapwing signing): all MAVLink is signed, and what is not signed is not listened "
    "to";

}  // namespace lapwing::host
