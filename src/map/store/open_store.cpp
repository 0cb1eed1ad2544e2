#include "map/store/open_store.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "map/store/news.hpp"
#include "map/store/rows/shade_rows.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/rows/site_rows.hpp"

namespace lapwing::map {

namespace {

using namespace std::chrono_literals;

/// How much of what changes comes together before it is written, and so how much the loss of the process may cost of
/// what nobody waited for.
constexpr auto quick_interval = 100ms;
constexpr auto frames_interval = 1s;
/// Robots write whole grids several times a second; compressing each would take more than a core.
constexpr auto tiles_interval = 2s;
/// Of a shared store.
constexpr auto news_interval = 250ms;
constexpr auto retry_interval = 1s;
constexpr auto clear_up_interval = 10s;
/// Features of one piece of loading: a few milliseconds on the loop.
constexpr std::size_t page_size = 1000;

}  // namespace

OpenStore::OpenStore(base::Loop& loop, bool is_shared, std::unique_ptr<write::Writer> writer,
                     std::unique_ptr<Reader> reader)
    : loop_(loop),
      is_shared_(is_shared),
      writer_(loop, std::move(writer)),
      reader_(loop, std::move(reader)),
      changed_(loop),
      written_(loop),
      scope_(loop) {
  scope_.spawn(write_always());
}

OpenStore::~OpenStore() {
  scope_.clear();
  following_.reset();
  // What was on its way is written again, but for frames, which would be there twice.
  pending_.give_back({});
  while (!pending_.is_empty()) {
    auto batch = pending_.take(map_, {.tiles = true, .frames = true});
    pending_.committed({});
    writer_.give([batch = std::move(batch)](write::Writer& writer) { (void)writer.write(batch); });
  }
}

void OpenStore::follow(LiveMap& map) {
  map_ = &map;
  // What lies in them cannot be read without.
  for (auto const& [id, site] : map.sites()) pending_.note({.site = id});
  following_ = map.follow([this](MapChange const& change) {
    if (is_applying_) return;
    pending_.note(change);
    changed_.notify_all();
  });
}

base::Task<base::Result<>> OpenStore::flush() {
  auto const wanted = pending_.last();
  auto const failures = failures_;
  for (;;) {
    auto const oldest = pending_.oldest();
    if (!oldest || *oldest > wanted) co_return base::Result<>();
    if (failures_ > failures) {
      auto error = *last_failure_;
      error.message = fmt::format("{} changes are not written: {}", pending_.waiting(), error.message);
      co_return std::unexpected(std::move(error));
    }
    is_urgent_ = true;
    changed_.notify_all();
    co_await written_.wait();
  }
}

base::Task<base::Result<std::string>> OpenStore::keep(std::string bytes, std::string media_type) {
  auto job = [blob = Blob{std::move(bytes), std::move(media_type)}, now = loop_.utc_now()](write::Writer& writer) {
    return writer.keep(blob, now);
  };
  co_return co_await writer_.run(std::move(job));
}

base::Task<base::Result<Store::Blob>> OpenStore::blob(std::string hash) {
  auto job = [hash = std::move(hash)](Reader& reader) { return blobs::read(*reader.database, *reader.bytes, hash); };
  co_return co_await reader_.run(std::move(job));
}

void OpenStore::record(Shown shown) {
  if (!pending_.record(std::move(shown))) ++lost_frames_;
  changed_.notify_all();
}

base::Task<> OpenStore::record_grids(std::string session, base::UtcTime at) {
  if (!map_ || !is_ready_to_record()) co_return;
  auto const work = grids_.take(*map_, session, at);
  if (!work) co_return;
  auto packed = co_await loop_.on_pool(past::GridKeeper::pack, *work);
  auto lists = grids_.done(*work, packed);
  pending_.record(std::move(packed.shades), std::move(lists.names), at);
  bool is_whole = lists.is_whole;
  for (auto& frame : lists.frames) {
    bool const is_kept = pending_.record({.at = at,
                                          .session = session,
                                          .feed = std::string(past::list_feed),
                                          .is_whole = std::exchange(is_whole, false),
                                          .is_binary = true,
                                          .content = std::move(frame)});
    if (is_kept) continue;
    ++lost_frames_;
    grids_.has_lost_lists();
  }
  changed_.notify_all();
}

void OpenStore::name_session(std::string id, std::string name) {
  auto const now = loop_.utc_now();
  pending_.name({.id = std::move(id), .name = std::move(name), .began = now, .ended = now});
  changed_.notify_all();
}

base::Task<base::Result<std::vector<Store::Session>>> OpenStore::sessions() {
  (void)co_await flush();  // what cannot be written yet, cannot be read
  auto job = [](Reader& reader) { return rows::read_sessions(*reader.database); };
  co_return co_await reader_.run(std::move(job));
}

base::Task<base::Result<std::vector<Store::Shown>>> OpenStore::state_at(std::string session, base::UtcTime at) {
  (void)co_await flush();
  auto job = [session = std::move(session), at](Reader& reader) {
    return rows::state_at(*reader.database, session, at);
  };
  co_return co_await reader_.run(std::move(job));
}

base::Task<base::Result<std::vector<Store::Shown>>> OpenStore::shown(std::string session, base::UtcTime from,
                                                                     base::UtcTime to, std::size_t most) {
  (void)co_await flush();
  auto job = [session = std::move(session), from, to, most](Reader& reader) {
    return rows::shown_between(*reader.database, session, from, to, most);
  };
  co_return co_await reader_.run(std::move(job));
}

base::Task<base::Result<PastGrids>> OpenStore::grids_at(std::string session, base::UtcTime at) {
  (void)co_await flush();
  auto job = [session = std::move(session), at](Reader& reader) {
    return rows::grids_at(*reader.database, session, at);
  };
  co_return co_await reader_.run(std::move(job));
}

base::Task<base::Result<PastShades>> OpenStore::shades(std::vector<std::string> names) {
  auto job = [names = std::move(names)](Reader& reader) { return rows::read_shades(*reader.database, names); };
  co_return co_await reader_.run(std::move(job));
}

Store::Health OpenStore::health() const {
  return {.is_writing = trouble_.empty(),
          .trouble = trouble_.empty() ? faults_ : trouble_,
          .bytes = bytes_,
          .waiting = pending_.waiting(),
          .lost_frames = lost_frames_};
}

void OpenStore::note_fault(std::string fault) {
  if (++fault_count_ == 1)
    faults_ = std::move(fault);
  else if (fault_count_ == 2)
    faults_ += "; there is more: `lapwing store verify` tells all";
}

base::Task<base::Result<>> OpenStore::load(LiveMap& into) {
  struct Start {
    Revision revision;
    rows::Sites sites;
    std::vector<rows::Removal> removals;
  };
  // The revision first: what others write meanwhile comes as news.
  auto job = [](Reader& reader) -> base::Result<Start> {
    auto const revision = write::revision_of(*reader.database);
    auto sites = rows::read_sites(*reader.database);
    auto removals = rows::removals_since(*reader.database, 0);
    if (!revision) return std::unexpected(revision.error());
    if (!sites) return std::unexpected(sites.error());
    if (!removals) return std::unexpected(removals.error());
    return Start{*revision, std::move(*sites), std::move(*removals)};
  };
  auto const start = co_await reader_.run(std::move(job));
  if (!start) co_return std::unexpected(start.error());
  for (auto const& [id, site] : start->sites) into.put_site(site);
  std::map<write::FeatureKey, Account> removals;
  for (auto const& removal : start->removals) removals[{removal.layer, removal.id}] = removal.account;
  for (auto const layer : all_layers) {
    auto const loaded = co_await load_features(into, layer, start->sites, removals);
    if (!loaded) co_return loaded;
  }
  // Of those that stand again it has been told with them.
  for (auto const& removal : start->removals)
    if (removals.contains({removal.layer, removal.id}))
      if (auto restored = into.restore(removed_record(removal)); !restored) note_fault(restored.error().message);
  if (auto loaded = co_await load_grids(into); !loaded) co_return loaded;
  writer_.give([revision = start->revision](write::Writer& writer) { writer.has_seen(revision); });
  co_return base::Result<>();
}

base::Task<base::Result<>> OpenStore::load_features(LiveMap& into, LayerKind layer, rows::Sites const& sites,
                                                    std::map<write::FeatureKey, Account>& removals) {
  auto const shared_sites = std::make_shared<rows::Sites const>(sites);
  std::int64_t last_fid = 0;
  for (;;) {
    auto job = [layer, shared_sites, last_fid](Reader& reader) {
      return rows::read_page(*reader.database, layer, *shared_sites, last_fid, page_size);
    };
    auto page = co_await reader_.run(std::move(job));
    if (!page) co_return std::unexpected(page.error());
    for (auto& fault : page->faults) note_fault(std::move(fault));
    for (auto& feature : page->features) {
      FeatureRecord record{.feature = std::move(feature)};
      auto const removal = removals.extract({layer, record.feature.id});
      if (removal) record.removal = removal.mapped();
      if (auto restored = into.restore(std::move(record)); !restored) note_fault(restored.error().message);
    }
    if (page->is_last) co_return base::Result<>();
    last_fid = page->last_fid;
  }
}

base::Task<base::Result<>> OpenStore::load_grids(LiveMap& into) {
  auto all = [](Reader& reader) { return rows::read_grids(*reader.database); };
  auto grids = co_await reader_.run(std::move(all));
  if (!grids) co_return std::unexpected(grids.error());
  for (auto& [key, part] : *grids) {
    auto job = [of = key](Reader& reader) { return rows::read_tiles(*reader.database, of); };
    auto tiles = co_await reader_.run(std::move(job));
    if (!tiles) {
      note_fault(tiles.error().message);
      continue;
    }
    part.tiles = std::move(*tiles);
    if (auto put = put_tiles(into, key, part); !put) note_fault(put.error().message);
  }
  co_return base::Result<>();
}

base::TimePoint OpenStore::next_write() const {
  if (is_urgent_) return base::TimePoint::min();
  auto next = base::TimePoint::max();
  if (pending_.has_quick()) next = std::min(next, quick_from_);
  if (pending_.has_tiles()) next = std::min(next, tiles_from_);
  if (pending_.has_frames()) next = std::min(next, frames_from_);
  if (pending_.fills_a_batch()) next = base::TimePoint::min();
  if (is_shared_ && map_) next = std::min(next, news_from_);
  return trouble_.empty() ? next : std::max(next, retry_from_);
}

base::TimePoint OpenStore::next_turn() const {
  return std::min(next_write(), clear_up_from_);
}

base::Task<> OpenStore::write_always() {
  for (;;) {
    while (loop_.now() < next_turn()) co_await changed_.wait_until(next_turn());
    if (loop_.now() >= next_write()) co_await write_once();
    if (loop_.now() >= clear_up_from_) co_await clear_up();
  }
}

base::Task<> OpenStore::write_once() {
  auto const now = loop_.now();
  bool const is_urgent = std::exchange(is_urgent_, false);
  bool const with_tiles = is_urgent || now >= tiles_from_;
  bool const with_frames = is_urgent || now >= frames_from_ || pending_.fills_a_batch();
  auto const batch = std::make_shared<write::Batch>(pending_.take(map_, {.tiles = with_tiles, .frames = with_frames}));
  auto job = [batch](write::Writer& writer) { return batch->is_empty() ? writer.read_news() : writer.write(*batch); };
  auto const written = co_await writer_.run(std::move(job));
  auto const then = loop_.now();
  quick_from_ = then + quick_interval;
  news_from_ = then + news_interval;
  if (with_tiles && !pending_.has_tiles()) tiles_from_ = then + tiles_interval;
  if (with_frames) frames_from_ = then + frames_interval;
  if (written) {
    pending_.committed(written->passed_over);
    trouble_.clear();
    if (written->news) apply(*written->news);
  } else {
    pending_.give_back(std::move(*batch));
    has_failed(written.error());
  }
  written_.notify_all();
}

void OpenStore::apply(write::News const& news) {
  is_applying_ = true;
  for (auto& fault : apply_news(*map_, news, pending_)) note_fault(std::move(fault));
  is_applying_ = false;
}

void OpenStore::has_failed(base::Error const& error) {
  ++failures_;
  last_failure_ = error;
  retry_from_ = loop_.now() + retry_interval;
  trouble_ = error.hint.empty() ? error.message : fmt::format("{}: {}", error.message, error.hint);
}

base::Task<> OpenStore::clear_up() {
  struct Cleared {
    bool is_more;
    std::uint64_t bytes;
  };
  auto job = [now = loop_.utc_now()](write::Writer& writer) {
    // What cannot be taken away now is taken away another time; whether the store can be written, writing tells.
    bool const is_more = writer.retain(now).value_or(false);
    return Cleared{is_more, writer.bytes()};
  };
  auto const cleared = co_await writer_.run(std::move(job));
  bytes_ = cleared.bytes;
  clear_up_from_ = cleared.is_more ? loop_.now() : loop_.now() + clear_up_interval;
}

base::Result<std::unique_ptr<Store>> Store::open(base::Loop& loop, Options options) {
  place::Address const address(options.address);
  auto writer = write::Writer::open(options);
  if (!writer) return std::unexpected(writer.error());
  auto reader = Reader::open(address);
  if (!reader) return std::unexpected(reader.error());
  return std::make_unique<OpenStore>(loop, address.is_server(), std::move(*writer), std::move(*reader));
}

}  // namespace lapwing::map
