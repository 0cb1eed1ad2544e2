#include "fleet/watch/waiting.hpp"

#include <fmt/format.h>

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::Task;

namespace {

constexpr base::Duration first_word = 3s;
constexpr base::Duration next_word = 10s;
constexpr base::Duration look_again = 500ms;

/// Why nothing goes on, as far as that can be told.
std::string cause(RunContext const& context, RunRecord const& run) {
  auto const& craft = context.craft;
  if (auto silence = silence_text(context.connection, craft); !silence.empty()) return silence;
  if (run.progress.starts_with("waiting")) return why_not_ready(craft);
  if (run.progress.starts_with("uploading")) return "it asks for no more items";
  if (run.progress.starts_with("reading")) return "it tells no more items";
  return {};
}

}  // namespace

std::string silence_text(mavlink::Connection const& connection, MavlinkVehicle const& craft) {
  constexpr base::Duration heartbeat_is_due = 2500ms;
  auto const heard = connection.last_heard(craft.address);
  auto const silent_for = heard ? connection.loop().now() - *heard : base::Duration{};
  if (silent_for < heartbeat_is_due) return {};
  auto const where = connection.whereabouts(craft.address.system).value_or(craft.state.links.used);
  return fmt::format("nothing heard from it for {:.0f} s on {}", base::to_seconds(silent_for), where);
}

Task<> tell_waiting(RunContext context, std::shared_ptr<RunRecord const> run) {
  auto& loop = context.connection.loop();
  std::string seen;
  auto since = loop.now();
  auto next = since + first_word;
  while (run->outcome == RunRecord::Outcome::running && !run->has_begun) {
    co_await loop.sleep(look_again);
    if (run->progress != seen) {
      seen = run->progress;
      since = loop.now();
      next = since + first_word;
    }
    if (loop.now() < next || run->outcome != RunRecord::Outcome::running || run->has_begun) continue;
    next += next_word;
    auto const why = cause(context, *run);
    context.log.info(fmt::format("{}: '{}': {} for {:.0f} s{}{}", context.craft.state.name, run->mission, seen,
                                 base::to_seconds(loop.now() - since), why.empty() ? "" : ": ", why));
  }
}

Task<> tell_stopping(RunContext context) {
  auto& loop = context.connection.loop();
  auto const since = loop.now();
  for (auto wait = first_word;; wait = next_word) {
    co_await loop.sleep(wait);
    auto const silence = silence_text(context.connection, context.craft);
    context.log.warn(fmt::format("{} has not stopped yet, asked again and again for {:.0f} s{}{}",
                                 context.craft.state.name, base::to_seconds(loop.now() - since),
                                 silence.empty() ? "" : ": ", silence));
  }
}

}  // namespace lapwing::fleet
