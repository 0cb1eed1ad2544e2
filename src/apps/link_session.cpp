#include "apps/link_session.hpp"

#include <optional>
#include <utility>

#include "apps/ground.hpp"
#include "apps/signals.hpp"
#include "apps/verb.hpp"
#include "link/byte_link.hpp"
#include "link/url.hpp"

namespace lapwing::apps {

namespace {

base::Task<> finish(base::Task<int> job, std::optional<int>& code, base::Loop& loop) {
  code = co_await job;
  loop.stop();
}

}  // namespace

LinkSession::LinkSession(SigningSetup const& signing, std::string const& source)
    : log(hub, source),
      connection(loop, {.keys = signing.ring, .signed_until = signing.signed_until}, log.named("link")),
      keeper_(connection, signing.time_file, log.named("signing")) {
  hub.add_sink(base::standard_error_sink(base::LogLevel::warn));
}

base::Result<> LinkSession::open(std::vector<std::string> const& urls) {
  for (auto const& text : urls.empty() ? std::vector<std::string>{default_link} : urls) {
    auto const url = link::parse_url(text);
    if (!url) return std::unexpected(url.error());
    auto link = link::open(loop, *url);
    if (!link) return std::unexpected(link.error());
    connection.add_link(std::move(*link));
  }
  return {};
}

int LinkSession::run(base::Task<int> job) {
  std::optional<int> code;
  base::Scope scope(loop);
  StopSignals const signals(loop, [this] { loop.stop(); });
  scope.spawn(finish(std::move(job), code, loop));
  if (!code) loop.run();
  return code.value_or(exit_interrupted);
}

}  // namespace lapwing::apps
