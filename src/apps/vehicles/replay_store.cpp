#include "apps/vehicles/replay_store.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "host/exit_code.hpp"
#include "host/session/session.hpp"
#include "host/session/signals.hpp"
#include "map/store/place/address.hpp"
#include "map/store/read_store.hpp"

namespace lapwing::apps {

namespace {

using map::Store;

/// Of several with that name the newest.
base::Result<Store::Session> chosen(std::vector<Store::Session> const& sessions, StoreReplay const& options) {
  auto const place = map::place::Address(options.address).name();
  if (sessions.empty())
    return base::fail(base::ErrorKind::not_found, fmt::format("{}: no session is kept in it", place),
                      "`lapwing station --store STORE` keeps what it shows");
  Store::Session const* found = nullptr;
  for (auto const& session : sessions) {
    bool const fits = options.session.empty() || session.id == options.session || session.name == options.session;
    if (fits && (!found || found->began <= session.began)) found = &session;
  }
  if (found) return *found;
  std::string known;
  for (auto const& session : sessions)
    known +=
        fmt::format("{}{}{} ({})", known.empty() ? "" : ", ", session.id,
                    session.name.empty() ? "" : fmt::format(" \"{}\"", session.name), base::to_iso8601(session.began));
  return base::fail(base::ErrorKind::not_found,
                    fmt::format("{}: there is no session \"{}\" in it", place, options.session),
                    fmt::format("there are: {}", known));
}

/// There is nobody to start a script with.
class NoScript final : public station::ScriptControl {
 public:
  [[nodiscard]] station::ScriptStatus status() const override { return {}; }
  [[nodiscard]] std::vector<tasks::TaskView> task_trees() const override { return {}; }
  [[nodiscard]] std::expected<void, station::StartFailure> start(std::string, std::string) override {
    return std::unexpected(station::StartFailure{
        {base::ErrorKind::refused, "the past is shown: no vehicle is there to fly a script", "use run or station"},
        {}});
  }
  void stop(std::string) override {}
};

}  // namespace

int replay_store(StoreReplay const& options) {
  NoScript script;
  host::Session session({.listens_only = true});
  auto const store = map::open_to_read(session.loop, options.address);
  if (!store) return host::refuse(store.error());
  auto const sessions = session.loop.run_until_done((*store)->sessions());
  if (!sessions) return host::refuse(sessions.error());
  auto const shown = chosen(*sessions, options);
  if (!shown) return host::refuse(shown.error());
  host::WebAccess access;
  host::apply(options.web, access);
  host::MapContent content{.site_name = shown->name};
  content.past = host::MapContent::Past{store->get(), shown->id};
  if (auto opened = session.open_map(access, content, &script); !opened) return host::refuse(opened.error());
  fmt::print(stderr, "the map shows what was from {} to {}; Ctrl-C ends\n", base::to_iso8601(shown->began),
             base::to_iso8601(shown->ended));
  {
    host::StopSignals const signals(session.loop, [&session] { session.loop.stop(); });
    session.loop.run();
  }
  session.map.reset();  // it reads the store
  return host::exit_done;
}

}  // namespace lapwing::apps
