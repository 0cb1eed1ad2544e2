#include "link/operator_link/journal/journal.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "base/assert.hpp"
#include "link/operator_link/message.hpp"
#include "link/operator_link/wire/byte_order.hpp"
#include "link/operator_link/wire/protocol.hpp"

namespace lapwing::link::operator_link {

namespace {

constexpr std::string_view file_magic = "LWjrnl1\n";
constexpr std::string_view file_ending = ".segment";
constexpr std::size_t record_header_bytes = 8;
/// A message's text, its key and its number.
constexpr std::size_t longest_record = longest_text + longest_key + 16;

enum class RecordType : std::uint8_t { state = 1, message = 2, acknowledged = 3, taken = 4 };

/// A record's length and CRC stand before it.
void write_record(std::vector<std::uint8_t>& to, Bytes body) {
  ByteWriter writer(to);
  writer.number(static_cast<std::uint32_t>(body.size()));
  writer.number(crc32(body));
  to.insert(to.end(), body.begin(), body.end());
}

std::vector<std::uint8_t> numbers_record(RecordType type, std::initializer_list<std::uint64_t> numbers) {
  std::vector<std::uint8_t> body;
  ByteWriter writer(body);
  writer.number(static_cast<std::uint8_t>(type));
  for (auto const number : numbers) writer.number(number);
  std::vector<std::uint8_t> record;
  write_record(record, body);
  return record;
}

/// The body of the record at `offset`; nothing when there is no whole one.
std::optional<Bytes> record_at(Bytes content, std::size_t offset) {
  if (content.size() < offset + record_header_bytes) return std::nullopt;
  ByteReader header(content.subspan(offset, record_header_bytes));
  auto const length = header.number<std::uint32_t>();
  auto const crc = header.number<std::uint32_t>();
  if (length == 0 || length > longest_record || content.size() < offset + record_header_bytes + length)
    return std::nullopt;
  auto const body = content.subspan(offset + record_header_bytes, length);
  if (crc32(body) != crc) return std::nullopt;
  return body;
}

/// Nothing for a record of another type.
std::optional<DurableQueue::Entry> entry_of(Bytes body) {
  ByteReader reader(body);
  if (reader.number<std::uint8_t>() != static_cast<std::uint8_t>(RecordType::message)) return std::nullopt;
  DurableQueue::Entry entry;
  entry.number = reader.number<std::uint64_t>() % number_limit;
  entry.key = reader.text<std::uint8_t>();
  entry.text = reader.rest();
  return entry;
}

}  // namespace

base::Result<std::unique_ptr<Journal>> Journal::open(std::unique_ptr<Disk> disk, JournalLimits limits,
                                                     std::uint64_t fresh_stream) {
  std::unique_ptr<Journal> journal(new Journal(std::move(disk), limits, fresh_stream));
  if (auto const recovered = journal->recover(); !recovered) return std::unexpected(recovered.error());
  return journal;
}

void Journal::listen(Events events) {
  events_ = std::move(events);
  begin_sync();  // what an earlier process left may be no further than with the operating system
}

std::size_t Journal::bytes() const {
  std::size_t sum = 0;
  for (auto const& segment : segments_) sum += static_cast<std::size_t>(segment.size);
  return sum;
}

base::Result<> Journal::recover() {
  auto files = disk_->list();
  if (!files) return std::unexpected(files.error());
  std::erase_if(*files, [](auto const& file) { return !file.name.ends_with(file_ending); });
  std::ranges::sort(*files, {}, &Disk::File::name);
  for (auto const& file : *files)
    if (auto const done = recover_segment(file, &file == &files->back()); !done) return done;
  // What was acknowledged is never said again under the same number, even where nobody could have written so.
  next_ = std::max(next_, first_);
  drop_segments();
  return {};
}

base::Result<> Journal::recover_segment(Disk::File const& file, bool is_last) {
  std::uint64_t number = 0;
  std::from_chars(file.name.data(), file.name.data() + file.name.size(), number, 16);
  next_segment_ = std::max(next_segment_, number + 1);
  auto const content = disk_->read(file.name, 0, static_cast<std::size_t>(file.size));
  if (!content) return std::unexpected(content.error());
  std::size_t offset = file_magic.size();
  bool const is_ours = content->size() >= offset && std::ranges::equal(Bytes(*content).first(offset), file_magic);
  auto const state = is_ours ? record_at(*content, offset) : std::nullopt;
  if (!state || !replay(*state)) {
    // Cut off while it was begun: nothing had been accepted in it. Another one is not ours to remove.
    bool const begins_as_ours = is_ours || std::ranges::equal(*content, file_magic.substr(0, content->size()));
    if (is_last && begins_as_ours) return disk_->remove(file.name);
    damaged_bytes_ += file.size;
    return {};
  }
  Segment segment{.name = file.name, .first = next_};
  while (auto const body = record_at(*content, offset)) {
    replay(*body);
    offset += record_header_bytes + body->size();
  }
  segment.size = offset;
  segment.is_damaged = !is_last && offset < content->size();
  segments_.push_back(std::move(segment));
  if (offset == content->size()) return {};
  if (!is_last) {
    damaged_bytes_ += content->size() - offset;
    return {};
  }
  return disk_->cut(file.name, offset);
}

/// Takes a record into account; false when it is none of the first of a file.
bool Journal::replay(Bytes body) {
  ByteReader reader(body);
  switch (static_cast<RecordType>(reader.number<std::uint8_t>())) {
    case RecordType::state:
      stream_ = reader.number<std::uint64_t>();
      first_ = std::max(first_, reader.number<std::uint64_t>() % number_limit);
      next_ = std::max(next_, reader.number<std::uint64_t>() % number_limit);
      taken_.stream = reader.number<std::uint64_t>();
      taken_.number = reader.number<std::uint64_t>();
      return reader.is_whole();
    case RecordType::message: next_ = std::max(next_, reader.number<std::uint64_t>() % number_limit + 1); return false;
    case RecordType::acknowledged:
      first_ = std::max(first_, reader.number<std::uint64_t>() % number_limit + 1);
      return false;
    case RecordType::taken:
      taken_.stream = reader.number<std::uint64_t>();
      taken_.number = reader.number<std::uint64_t>();
      return false;
  }
  return false;
}

base::Result<> Journal::begin_segment() {
  std::vector<std::uint8_t> head(file_magic.begin(), file_magic.end());
  auto const state = numbers_record(RecordType::state, {stream_, first_, next_, taken_.stream, taken_.number});
  head.insert(head.end(), state.begin(), state.end());
  auto name = fmt::format("{:016x}{}", next_segment_, file_ending);
  if (auto const done = disk_->append(name, head); !done) {
    // An empty file may have stayed, which recovery would take for one that was just begun.
    (void)disk_->remove(name);
    return done;
  }
  ++next_segment_;
  segments_.push_back({.name = std::move(name), .first = next_, .size = head.size()});
  return {};
}

base::Result<> Journal::write(Bytes records) {
  if (segments_.empty() || segments_.back().is_damaged || segments_.back().size >= limits_.segment_bytes)
    if (auto const begun = begin_segment(); !begun) return begun;
  auto& active = segments_.back();
  if (auto const done = disk_->append(active.name, records); !done) return done;
  active.size += records.size();
  return {};
}

base::Result<std::uint64_t> Journal::append(std::string_view key, std::string_view text) {
  LAPWING_ASSERT(key.size() <= longest_key && text.size() <= longest_text, key.size(), text.size());
  if (next_ >= number_limit)
    return base::fail(base::ErrorKind::refused, fmt::format("{} has no numbers left", disk_->name()),
                      "Its files are damaged: move them away and begin anew.");
  if (bytes() + text.size() > limits_.bytes)
    return base::fail(
        base::ErrorKind::refused,
        fmt::format("{} messages wait in {}, which has its {} bytes", next_ - first_, disk_->name(), limits_.bytes),
        "Say less until the far end is back, or let the queue be longer.");
  std::vector<std::uint8_t> body;
  ByteWriter writer(body);
  writer.number(static_cast<std::uint8_t>(RecordType::message));
  writer.number(next_);
  writer.text<std::uint8_t>(key);
  writer.bytes(text);
  std::vector<std::uint8_t> record;
  write_record(record, body);
  if (auto const written = write(record); !written) return std::unexpected(written.error());
  auto const number = next_++;
  begin_sync();
  return number;
}

/// What only saves work after a crash: when it cannot be written now, that costs this work and nothing else.
void Journal::note(Bytes record) {
  if (auto const written = write(record); !written) complain(written.error());
}

void Journal::acknowledge(std::uint64_t number) {
  number = std::min(number, next_ - 1);
  if (number < first_) return;
  first_ = number + 1;
  drop_segments();
  note(numbers_record(RecordType::acknowledged, {number}));
}

void Journal::note_taken(Mark mark) {
  if (mark == taken_) return;
  taken_ = mark;
  note(numbers_record(RecordType::taken, {mark.stream, mark.number}));
  drop_segments();
}

void Journal::skip_to(std::uint64_t number) {
  if (number <= next_) return;
  next_ = number;
  // The head of a file is where the next number is written down.
  if (auto const begun = begin_segment(); !begun) complain(begun.error());
}

void Journal::drop_segments() {
  while (segments_.size() > 1 && segments_[1].first <= first_) {
    if (auto const removed = disk_->remove(segments_.front().name); !removed) return complain(removed.error());
    segments_.pop_front();
    if (cursor_ && cursor_->segment-- == 0) cursor_.reset();
  }
}

/// One at a time; what is appended meanwhile goes with the next, so that many share one wait for the disk.
void Journal::begin_sync() {
  if (is_syncing_ || !events_.ready) return;
  is_syncing_ = true;
  disk_->sync([this, up_to = next_ - 1](base::Result<> result) { synced(up_to, std::move(result)); });
}

void Journal::synced(std::uint64_t up_to, base::Result<> result) {
  is_syncing_ = false;
  if (!result) return complain(result.error());
  if (up_to > ready_) {
    ready_ = up_to;
    events_.ready();
  }
  if (ready_ + 1 < next_) begin_sync();
}

void Journal::complain(base::Error const& error) const {
  if (events_.fault) events_.fault(fmt::format("{}. {}", error.message, error.hint));
}

void Journal::rewind(std::uint64_t number) {
  std::size_t segment = segments_.size() - 1;
  while (segment > 0 && segments_[segment].first > number) --segment;
  cursor_ = Cursor{.segment = segment};
}

/// True when there is more to look at: the rest of a file that has grown, or the next file.
base::Result<bool> Journal::load_more() {
  auto& cursor = *cursor_;
  auto const& segment = segments_[cursor.segment];
  if (cursor.content.size() < segment.size) {
    auto const more = disk_->read(segment.name, cursor.content.size(),
                                  static_cast<std::size_t>(segment.size) - cursor.content.size());
    if (!more) return std::unexpected(more.error());
    if (more->empty()) return base::fail(base::ErrorKind::io, fmt::format("{} has become shorter", segment.name));
    cursor.content.insert(cursor.content.end(), more->begin(), more->end());
    if (cursor.offset == 0) cursor.offset = file_magic.size();
    return true;
  }
  if (cursor.offset < cursor.content.size())
    return base::fail(base::ErrorKind::io, fmt::format("{} has become unreadable", segment.name));
  if (cursor.segment + 1 == segments_.size()) return false;
  cursor_ = Cursor{.segment = cursor.segment + 1, .number = cursor.number};
  return true;
}

base::Result<std::optional<DurableQueue::Entry>> Journal::read(std::uint64_t number) {
  number = std::max(number, first_);
  if (number >= next_ || segments_.empty()) return std::optional<Entry>();
  if (!cursor_ || number <= cursor_->number) rewind(number);
  for (;;) {
    auto const body = record_at(cursor_->content, cursor_->offset);
    if (!body) {
      auto const more = load_more();
      if (!more) return std::unexpected(more.error());
      if (!*more) return std::optional<Entry>();
      continue;
    }
    cursor_->offset += record_header_bytes + body->size();
    auto entry = entry_of(*body);
    if (!entry) continue;
    cursor_->number = entry->number;
    if (entry->number >= number) return entry;
  }
}

}  // namespace lapwing::link::operator_link
