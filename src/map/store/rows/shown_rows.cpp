#include "map/store/rows/shown_rows.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "map/store/past/bytes.hpp"
#include "map/store/rows/zlib.hpp"
#include "map/store/schema/tables.hpp"

namespace lapwing::map::rows {

namespace {

using sql::Row;
using Shown = Store::Shown;
using past::append;
using past::take;

constexpr std::uint8_t whole_flag = 1;
constexpr std::uint8_t binary_flag = 2;
/// No answer has more, whatever is asked for.
constexpr std::size_t most_frames = 10'000'000;
/// Far more than a batch brings of one feed.
constexpr std::size_t most_chunk_bytes = 512 * 1024 * 1024;

base::Result<> write_session(sql::Database& database, std::string const& id, base::UtcTime first, base::UtcTime last) {
  auto const known = database.change("UPDATE sessions SET ended_ns = $2 WHERE id = $1 AND ended_ns < $2",
                                     {id, sql::nanoseconds(last)});
  if (!known) return std::unexpected(known.error());
  if (*known > 0) return {};
  auto const made = database.change(
      "INSERT INTO sessions (id, name, began_ns, ended_ns) SELECT $1, '', $2, $3 WHERE NOT EXISTS (SELECT 1 FROM "
      "sessions WHERE id = $1)",
      {id, sql::nanoseconds(first), sql::nanoseconds(last)});
  return made ? base::Result<>() : std::unexpected(made.error());
}

base::Result<> write_chunk(sql::Database& database, std::vector<Shown const*> const& frames) {
  auto const& first = *frames.front();
  auto const by_time = [](Shown const* frame) { return frame->at; };
  auto const [earliest, latest] = std::ranges::minmax(frames, {}, by_time);
  std::optional<base::UtcTime> whole;
  for (auto const* frame : frames)
    if (frame->is_whole && (!whole || frame->at < *whole)) whole = frame->at;
  if (auto known = write_session(database, first.session, earliest->at, latest->at); !known) return known;
  auto const written = database.change(
      "INSERT INTO shown_chunks (session, feed, number, first_ns, last_ns, whole_ns, frames, content) SELECT $1, $2, "
      "coalesce(max(number), 0) + 1, $3, $4, $5, $6, $7 FROM shown_chunks WHERE session = $1 AND feed = $2",
      {first.session, first.feed, sql::nanoseconds(earliest->at), sql::nanoseconds(latest->at),
       whole ? sql::Value(sql::nanoseconds(*whole)) : sql::Value(), static_cast<std::int64_t>(frames.size()),
       sql::Bytes{packed(frames)}});
  return written ? base::Result<>() : std::unexpected(written.error());
}

base::Result<> append_chunk(std::vector<Shown>& to, Row const& row, std::string const& session) {
  auto frames = unpacked(sql::as_bytes(row[1]), session, sql::as_text(row[0]));
  if (!frames)
    return base::fail(base::ErrorKind::io, fmt::format("session \"{}\" in the store: a piece of what \"{}\" showed "
                                                       "cannot be read",
                                                       session, sql::as_text(row[0])));
  std::ranges::move(*frames, std::back_inserter(to));
  return {};
}

void sort_by_time(std::vector<Shown>& frames) {
  std::ranges::stable_sort(frames, {}, &Shown::at);
}

}  // namespace

std::string packed(std::vector<Shown const*> const& frames) {
  std::string bytes;
  for (auto const* frame : frames) {
    append(bytes, sql::nanoseconds(frame->at));
    append(bytes, static_cast<std::uint8_t>((frame->is_whole ? whole_flag : 0) | (frame->is_binary ? binary_flag : 0)));
    append(bytes, static_cast<std::uint32_t>(frame->content.size()));
    bytes += frame->content;
  }
  return deflated(bytes);
}

std::optional<std::vector<Shown>> unpacked(std::string_view content, std::string const& session,
                                           std::string const& feed) {
  auto const bytes = inflated(content, most_chunk_bytes);
  if (!bytes) return std::nullopt;
  std::vector<Shown> frames;
  for (std::string_view rest = *bytes; !rest.empty();) {
    auto const at = take<std::int64_t>(rest);
    auto const flags = take<std::uint8_t>(rest);
    auto const size = take<std::uint32_t>(rest);
    if (!at || !flags || !size || *size > rest.size()) return std::nullopt;
    frames.push_back({.at = sql::time_of_nanoseconds(*at),
                      .session = session,
                      .feed = feed,
                      .is_whole = (*flags & whole_flag) != 0,
                      .is_binary = (*flags & binary_flag) != 0,
                      .content = std::string(rest.substr(0, *size))});
    rest.remove_prefix(*size);
  }
  return frames;
}

base::Result<> write_shown(sql::Database& database, std::vector<Shown> const& frames) {
  std::map<std::pair<std::string, std::string>, std::vector<Shown const*>> by_feed;
  for (auto const& frame : frames) by_feed[{frame.session, frame.feed}].push_back(&frame);
  for (auto const& [feed, chunk] : by_feed)
    if (auto written = write_chunk(database, chunk); !written) return written;
  return {};
}

base::Result<> name_session(sql::Database& database, Store::Session const& session) {
  return database.put(schema::table::sessions, {"id", "name", "began_ns", "ended_ns"},
                      {{session.id, session.name, sql::nanoseconds(session.began), sql::nanoseconds(session.ended)}});
}

base::Result<std::vector<Store::Session>> read_sessions(sql::Database& database) {
  auto const rows = sql::rows_of(database, "SELECT id, name, began_ns, ended_ns FROM sessions ORDER BY began_ns, id");
  if (!rows) return std::unexpected(rows.error());
  std::vector<Store::Session> sessions;
  for (auto const& row : *rows) {
    auto const time = [&](std::size_t i) { return sql::time_of_nanoseconds(sql::as_integer(row[i]).value_or(0)); };
    sessions.push_back({.id = sql::as_text(row[0]), .name = sql::as_text(row[1]), .began = time(2), .ended = time(3)});
  }
  return sessions;
}

base::Result<std::vector<Shown>> state_at(sql::Database& database, std::string const& session, base::UtcTime at,
                                          std::string const& of_feed) {
  // For each feed the last chunk with a whole frame that is early enough, and what came behind it.
  auto const wanted = sql::nanoseconds(at);
  std::vector<Shown> frames;
  auto const read = database.query(
      "SELECT chunk.feed, chunk.content FROM shown_chunks chunk JOIN (SELECT feed, max(number) AS number FROM "
      "shown_chunks WHERE session = $1 AND whole_ns <= $2 AND ($3 = '' OR feed = $3) GROUP BY feed) last ON chunk.feed "
      "= "
      "last.feed AND "
      "chunk.number >= last.number WHERE chunk.session = $1 AND chunk.first_ns <= $2 ORDER BY chunk.feed, chunk.number",
      {session, wanted, of_feed}, [&](Row const& row) { return append_chunk(frames, row, session); });
  if (!read) return std::unexpected(read.error());
  std::erase_if(frames, [&](Shown const& frame) { return frame.at > at; });
  sort_by_time(frames);
  // Of the first chunk what stands before its last whole frame goes, too.
  std::map<std::string, std::size_t> last_whole;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (frames[i].is_whole) last_whole[frames[i].feed] = i;
  std::vector<Shown> state;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (auto const whole = last_whole.find(frames[i].feed); whole != last_whole.end() && i >= whole->second)
      state.push_back(std::move(frames[i]));
  return state;
}

base::Result<std::vector<Shown>> shown_between(sql::Database& database, std::string const& session, base::UtcTime from,
                                               base::UtcTime to, std::size_t most) {
  // Chunks with a frame in the interval give one at least; of each feed two may overlap it with none.
  constexpr std::size_t margin = 1000;
  auto const heads =
      sql::rows_of(database,
                   "SELECT feed, number, first_ns FROM shown_chunks WHERE session = $1 AND first_ns < $3 "
                   "AND last_ns >= $2 ORDER BY first_ns LIMIT $4",
                   {session, sql::nanoseconds(from), sql::nanoseconds(to),
                    static_cast<std::int64_t>(std::min(most, most_frames) + margin)});
  if (!heads) return std::unexpected(heads.error());
  std::vector<Shown> frames;
  auto const take_wanted = [&](Row const& row) -> base::Result<> {
    std::vector<Shown> chunk;
    if (auto taken = append_chunk(chunk, row, session); !taken) return taken;
    for (auto& frame : chunk)
      if (frame.at >= from && frame.at < to) frames.push_back(std::move(frame));
    return {};
  };
  for (auto const& head : *heads) {
    // What this chunk and those behind it have comes after the wanted number of frames.
    auto const begins = sql::time_of_nanoseconds(sql::as_integer(head[2]).value_or(0));
    auto const is_before = [&](Shown const& frame) { return frame.at < begins; };
    if (frames.size() >= most && static_cast<std::size_t>(std::ranges::count_if(frames, is_before)) >= most) break;
    auto const read =
        database.query("SELECT feed, content FROM shown_chunks WHERE session = $1 AND feed = $2 AND number = $3",
                       {session, head[0], head[1]}, take_wanted);
    if (!read) return std::unexpected(read.error());
  }
  sort_by_time(frames);
  if (frames.size() > most) frames.resize(most);
  return frames;
}

}  // namespace lapwing::map::rows
