#include "scans/storage/mcap.hpp"

#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/crc32.hpp"
#include "scans/storage/record_fields.hpp"
#include "scans/storage/unpack.hpp"

namespace lapwing::scans {

namespace {

using base::ErrorKind;
using base::fail;

constexpr std::string_view magic("\x89MCAP0\r\n", 8);

enum class Opcode : std::uint8_t {
  none = 0x00,  ///< never written: zeros, as a file system leaves them when the power fails
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  data_end = 0x0f,
};

struct Head {
  Opcode opcode{};
  std::uint64_t size = 0;
};
constexpr std::size_t head_bytes = 9;

Head head_of(std::string_view bytes) {
  RecordFields fields(bytes);
  auto const opcode = static_cast<Opcode>(fields.number<std::uint8_t>());
  return {.opcode = opcode, .size = fields.number<std::uint64_t>()};
}

std::optional<Packing> packing_of(std::string_view name) {
  if (name.empty()) return Packing::none;
  if (name == "lz4") return Packing::lz4;
  if (name == "zstd") return Packing::zstd;
  return std::nullopt;
}

class McapReader {
 public:
  McapReader(std::istream& file, BagListener& listener) : file_(file), listener_(listener) {}

  base::Result<BagRemark> run() {
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(file_.tellg());
    file_.seekg(0);
    if (!read(magic.size()) || record_ != magic)
      return fail(ErrorKind::invalid_input, "it does not begin as an MCAP file does");
    at_ = magic.size();
    while (!is_ended_ && !cut_at_) {
      if (auto done = next(); !done) return std::unexpected(done.error());
    }
    return remark();
  }

 private:
  struct Channel {
    BagTopic topic;
    bool is_wanted = false;
  };

  [[nodiscard]] BagRemark remark() const {
    BagRemark said;
    if (cut_at_)
      said = fmt::format("the file is cut off or damaged {} bytes after its beginning; what lies before was read",
                         *cut_at_);
    if (damaged_chunks_ > 0)
      said += fmt::format("{}{} chunks are damaged, and what could not be read of them was left out",
                          said.empty() ? "" : "; ", damaged_chunks_);
    return said;
  }

  bool read(std::uint64_t size) {
    record_.resize(static_cast<std::size_t>(size));
    return static_cast<bool>(file_.read(record_.data(), static_cast<std::streamsize>(size)));
  }

  /// One record of the file itself.
  base::Result<> next() {
    if (size_ - at_ < head_bytes || !read(head_bytes)) {
      cut_at_ = at_;
      return {};
    }
    auto const head = head_of(record_);
    auto const left = size_ - at_ - head_bytes;
    bool const is_cut = head.size > left;
    if (is_cut || head.opcode == Opcode::none) cut_at_ = at_;
    if (head.opcode == Opcode::none) return {};
    auto const size = std::min(head.size, left);
    // Of a chunk that is cut off there is something to be had; of anything else nothing.
    auto done = head.opcode == Opcode::chunk || !is_cut ? content(head.opcode, size) : base::Result<>();
    at_ += head_bytes + size;
    file_.seekg(static_cast<std::streamoff>(at_));
    return done;
  }

  base::Result<> content(Opcode opcode, std::uint64_t size) {
    switch (opcode) {
      case Opcode::footer:
      case Opcode::data_end: is_ended_ = true; return {};
      case Opcode::schema:
      case Opcode::channel:
      case Opcode::message:
      case Opcode::chunk: break;
      default: return {};  // attachments, metadata, indexes, and what later versions may have
    }
    if (size > most_packed_together + head_bytes)
      return fail(ErrorKind::invalid_input,
                  fmt::format("a record of {} MB; the limit is {}", size >> 20, most_packed_together >> 20));
    if (!read(size)) {
      cut_at_ = at_;
      return {};
    }
    if (opcode == Opcode::chunk) return chunk(record_);
    if (auto done = record(opcode, record_); !done) return std::unexpected(done.error());
    return {};
  }

  base::Result<> chunk(std::string_view bytes) {
    RecordFields fields(bytes);
    (void)fields.take(2 * sizeof(std::uint64_t));  // when its messages begin and end
    auto const unpacked_size = fields.number<std::uint64_t>();
    auto const crc = fields.number<std::uint32_t>();
    auto const name = fields.text();
    auto const packed_size = fields.number<std::uint64_t>();
    if (!fields.is_good()) {
      ++damaged_chunks_;
      return {};
    }
    auto const packing = packing_of(name);
    if (!packing)
      return fail(ErrorKind::invalid_input, fmt::format("chunks packed by {:?}; only lz4 and zstd can be read", name));
    if (unpacked_size > most_packed_together)
      return fail(ErrorKind::invalid_input,
                  fmt::format("a chunk of {} MB; the limit is {}", unpacked_size >> 20, most_packed_together >> 20),
                  "record with smaller chunks, or write it anew by `mcap recover`");
    auto const packed =
        fields.rest().substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(packed_size, fields.rest().size())));
    auto const unpacked = unpack(*packing, packed, static_cast<std::size_t>(unpacked_size));
    bool const is_whole = unpacked.size() == unpacked_size;
    if (is_whole && crc != 0 && base::crc32(unpacked) != crc) {
      ++damaged_chunks_;
      return {};
    }
    auto const ends_well = records(unpacked);
    if (!ends_well) return std::unexpected(ends_well.error());
    // Of one that is cut off is told already.
    if ((!is_whole || !*ends_well) && !cut_at_) ++damaged_chunks_;
    return {};
  }

  /// Those of a chunk. False: the last one is not whole.
  base::Result<bool> records(std::string_view bytes) {
    while (!bytes.empty()) {
      if (bytes.size() < head_bytes) return false;
      auto const head = head_of(bytes);
      bytes.remove_prefix(head_bytes);
      if (head.size > bytes.size() || head.opcode == Opcode::none) return false;
      auto const size = static_cast<std::size_t>(head.size);
      auto const is_whole = record(head.opcode, bytes.substr(0, size));
      if (!is_whole || !*is_whole) return is_whole;
      bytes.remove_prefix(size);
    }
    return true;
  }

  base::Result<bool> record(Opcode opcode, std::string_view bytes) {
    RecordFields fields(bytes);
    if (opcode == Opcode::schema) {
      auto const id = fields.number<std::uint16_t>();
      auto const name = fields.text();
      if (fields.is_good()) schemas_.try_emplace(id, name.substr(0, longest_name));
      return fields.is_good();
    }
    if (opcode == Opcode::channel) return channel(fields);
    if (opcode == Opcode::message) return message(fields);
    return true;
  }

  base::Result<bool> channel(RecordFields fields) {
    auto const id = fields.number<std::uint16_t>();
    auto const schema = schemas_.find(fields.number<std::uint16_t>());
    auto const name = fields.text();
    auto const encoding = fields.text();
    if (!fields.is_good()) return false;
    if (channels_.contains(id)) return true;  // each chunk may say it again
    if (channels_.size() == most_topics)
      return fail(ErrorKind::invalid_input, fmt::format("more than {} topics", most_topics));
    BagTopic topic{.name = std::string(name.substr(0, longest_name)),
                   .type = schema == schemas_.end() ? "" : schema->second,
                   .encoding = std::string(encoding.substr(0, longest_name))};
    bool const is_wanted = listener_.wants(topic);
    channels_.emplace(id, Channel{.topic = std::move(topic), .is_wanted = is_wanted});
    return true;
  }

  base::Result<bool> message(RecordFields fields) {
    auto const channel = channels_.find(fields.number<std::uint16_t>());
    (void)fields.number<std::uint32_t>();  // how many the sender sent before
    auto const logged = std::chrono::nanoseconds(static_cast<std::int64_t>(fields.number<std::uint64_t>()));
    (void)fields.number<std::uint64_t>();  // when it was sent
    if (!fields.is_good() || channel == channels_.end()) return false;
    if (!channel->second.is_wanted) return true;
    auto done = listener_.take(channel->second.topic, logged, fields.rest());
    return done ? base::Result<bool>(true) : std::unexpected(done.error());
  }

  static constexpr std::size_t longest_name = 1000;

  std::istream& file_;
  BagListener& listener_;
  std::uint64_t size_ = 0;
  std::uint64_t at_ = 0;  ///< where the next record begins
  std::string record_;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::size_t damaged_chunks_ = 0;
  std::optional<std::uint64_t> cut_at_;
  bool is_ended_ = false;
};

}  // namespace

bool is_mcap(std::string_view beginning) {
  return beginning.starts_with(magic);
}

base::Result<BagRemark> read_mcap(std::istream& file, BagListener& listener) {
  return McapReader(file, listener).run();
}

}  // namespace lapwing::scans
