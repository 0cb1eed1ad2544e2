#include "mavlink/param.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mavlink/inbox.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;

namespace {

/// Sends `request` until a value of that name comes. Vehicles also send values unasked, which serve as well.
base::Task<base::Result<ParamValue>> ask(Connection& connection, Address target, std::string name, Message request,
                                         ParamOptions options) {
  Inbox values(connection, target.system,
               wanting<ParamValue>([name](ParamValue const& value) { return value.name == name; }));
  for (int attempt = 0; attempt < options.tries; ++attempt) {
    if (auto sent = connection.send(target, request); !sent) co_return std::unexpected(sent.error());
    auto const got = co_await values.next(connection.loop().now() + options.reply_timeout);
    if (got) co_return std::get<ParamValue>(*got);
  }
  co_return fail(ErrorKind::timed_out, fmt::format("vehicle {} did not answer about parameter {}", target.system, name),
                 "check the name: ArduPilot is silent about parameters that it does not have");
}

}  // namespace

base::Task<base::Result<ParamValue>> read_param(Connection& connection, Address target, std::string name,
                                                ParamOptions options) {
  Message const request = ParamRequestRead{.name = name};
  co_return co_await ask(connection, target, name, request, options);
}

base::Task<base::Result<>> set_param(Connection& connection, Address target, std::string name, float value,
                                     ParamOptions options) {
  Message const request = ParamSet{.name = name, .value = value};
  auto const stored = co_await ask(connection, target, name, request, options);
  if (!stored) co_return std::unexpected(stored.error());
  auto const tolerance = 1e-6F * std::fmax(1.0F, std::fabs(value));
  if (std::fabs(stored->value - value) <= tolerance) co_return base::Result<>{};
  // It may have been sent for another reason just before the vehicle took the new value: ask once more.
  auto const now_stored = co_await read_param(connection, target, name, options);
  if (!now_stored) co_return std::unexpected(now_stored.error());
  if (std::fabs(now_stored->value - value) <= tolerance) co_return base::Result<>{};
  co_return fail(ErrorKind::refused,
                 fmt::format("vehicle {} stored {} = {}, not {}", target.system, name, now_stored->value, value));
}

}  // namespace lapwing::mavlink
