#include "mavlink/exchange/signing_setup.hpp"

#include <utility>

#include <fmt/format.h>

#include "mavlink/connection/inbox.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;

namespace {

/// Sends the key until the vehicle's frames are signed as `wanted` says (empty: not at all).
base::Task<bool> tell(Connection& connection, Address target, SigningKey key, SigningTime begin, std::string wanted,
                      SigningSetupOptions options, base::Result<>& sent) {
  auto& loop = connection.loop();
  Inbox heard(connection, target, [](Message const&) { return true; });
  for (int attempt = 0; attempt < options.tries; ++attempt) {
    heard.clear();
    Message const message = SetupSigning{.key = key, .initial_timestamp = begin};
    sent = connection.send(target, message);
    if (!sent) co_return false;
    auto const deadline = loop.now() + options.wait;
    while (co_await heard.next(deadline))
      if (connection.signing()->key_of(target) == wanted) co_return true;
  }
  co_return false;
}

}  // namespace

base::Task<base::Result<>> give_key(Connection& connection, Address target, std::string name,
                                    SigningSetupOptions options) {
  auto const* guard = connection.signing();
  auto const known = guard ? guard->ring().keys.find(name) : std::map<std::string, SigningKey>::const_iterator{};
  if (!guard || known == guard->ring().keys.end())
    co_return fail(ErrorKind::invalid_input, fmt::format("there is no key {}", name));
  SigningKey const key = known->second;
  SigningTime const begin = std::max(guard->signed_until(), signing_time(connection.loop().utc_now()));
  base::Result<> sent;
  bool const is_done = co_await tell(connection, target, key, begin, name, options, sent);
  if (!sent) co_return sent;
  if (is_done) co_return base::Result<>{};
  co_return fail(ErrorKind::timed_out, fmt::format("vehicle {} does not sign with the key {}", target.system, name),
                 "ArduPilot takes no key while it is armed; until the vehicle signs with it, both keys are heard");
}

base::Task<base::Result<>> take_key_away(Connection& connection, Address target, SigningSetupOptions options) {
  if (!connection.signing()) co_return fail(ErrorKind::invalid_input, "nothing is signed here");
  SigningKey const zeros{};
  std::string const unsigned_now;
  base::Result<> sent;
  bool const is_done = co_await tell(connection, target, zeros, 0, unsigned_now, options, sent);
  if (!sent) co_return sent;
  if (is_done) co_return base::Result<>{};
  co_return fail(ErrorKind::timed_out, fmt::format("vehicle {} still signs what it sends", target.system),
                 "ArduPilot takes no key while it is armed");
}

}  // namespace lapwing::mavlink
