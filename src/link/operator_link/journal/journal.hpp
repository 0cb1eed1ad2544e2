#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "link/operator_link/journal/disk.hpp"
#include "link/operator_link/journal/durable_queue.hpp"

namespace lapwing::link::operator_link {

struct JournalLimits {
  std::size_t bytes = std::size_t{64} * 1024 * 1024;
  std::size_t segment_bytes = std::size_t{1024} * 1024;
};

/// A queue on a disk, as files to which is only appended; the older are removed when all in them has been taken. Every
/// record has a CRC, each file begins with all that must be known of those before it (the layout:
/// docs/reference/operator-link.md).
///
/// A message that was accepted is with the operating system, so it outlives this process; it is ready to be sent once
/// it is on the disk itself, so the far end never has what loss of power can take from here. What is found half
/// written at the end after a crash is cut off: it had not been accepted. Memory: one segment at most.
class Journal final : public DurableQueue {
 public:
  /// Recovers what is there. `fresh_stream` names the stream of a new journal. Error (io).
  [[nodiscard]] static base::Result<std::unique_ptr<Journal>> open(std::unique_ptr<Disk> disk, JournalLimits limits,
                                                                   std::uint64_t fresh_stream);

  void listen(Events events) override;
  [[nodiscard]] std::uint64_t stream() const override { return stream_; }
  [[nodiscard]] std::uint64_t first() const override { return first_; }
  [[nodiscard]] std::uint64_t next() const override { return next_; }
  [[nodiscard]] std::uint64_t ready() const override { return ready_; }
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t most_bytes() const override { return limits_.bytes; }
  [[nodiscard]] base::Result<std::uint64_t> append(std::string_view key, std::string_view text) override;
  [[nodiscard]] base::Result<std::optional<Entry>> read(std::uint64_t number) override;
  void acknowledge(std::uint64_t number) override;
  void skip_to(std::uint64_t number) override;
  void note_taken(Mark mark) override;
  [[nodiscard]] Mark taken() const override { return taken_; }
  /// What recovery found that nobody can read, in bytes: zero unless the disk failed.
  [[nodiscard]] std::uint64_t damaged_bytes() const { return damaged_bytes_; }

 private:
  struct Segment {
    std::string name;
    std::uint64_t first = 1;  ///< messages in it have this number or greater
    std::uint64_t size = 0;
    bool is_damaged = false;  ///< there is more in the file, which cannot be read: what came behind would be lost
  };
  /// Where the next message that is sent stands; files are read a segment at a time.
  struct Cursor {
    std::size_t segment = 0;
    std::uint64_t number = 0;  ///< what was read last
    std::vector<std::uint8_t> content{};
    std::size_t offset = 0;
  };

  Journal(std::unique_ptr<Disk> disk, JournalLimits limits, std::uint64_t stream)
      : disk_(std::move(disk)), limits_(limits), stream_(stream) {}

  base::Result<> recover();
  base::Result<> recover_segment(Disk::File const& file, bool is_last);
  bool replay(Bytes body);
  base::Result<> begin_segment();
  base::Result<> write(Bytes records);
  void note(Bytes record);
  void drop_segments();
  void begin_sync();
  void synced(std::uint64_t up_to, base::Result<> result);
  base::Result<bool> load_more();
  void rewind(std::uint64_t number);
  void complain(base::Error const& error) const;

  std::unique_ptr<Disk> disk_;
  JournalLimits limits_;
  Events events_;
  std::uint64_t stream_;
  std::uint64_t first_ = 1;
  std::uint64_t next_ = 1;
  std::uint64_t ready_ = 0;
  Mark taken_;
  std::deque<Segment> segments_;
  std::uint64_t next_segment_ = 1;
  std::optional<Cursor> cursor_;
  std::uint64_t damaged_bytes_ = 0;
  bool is_syncing_ = false;
};

}  // namespace lapwing::link::operator_link
