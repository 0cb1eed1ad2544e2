#include "scans/storage/unpack.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

namespace lapwing::scans {

namespace {

constexpr std::size_t least_room = std::size_t{64} << 10;

/// Grows as it is filled: how much a frame holds is not known before, and what a file says of it may be wrong.
class Room {
 public:
  explicit Room(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  /// False: it must not grow any more.
  bool make_room() {
    if (used_ < bytes_.size()) return true;
    if (used_ == most_bytes_) return false;
    bytes_.resize(std::min(most_bytes_, std::max(least_room, 2 * bytes_.size())));
    return true;
  }
  [[nodiscard]] char* free() { return bytes_.data() + used_; }
  [[nodiscard]] std::size_t free_bytes() const { return bytes_.size() - used_; }
  void use(std::size_t bytes) { used_ += bytes; }
  [[nodiscard]] std::string filled() && {
    bytes_.resize(used_);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
  std::size_t used_ = 0;
  std::size_t most_bytes_;
};

std::string unpack_lz4(std::string_view packed, std::size_t most_bytes) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0U) return {};
  std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> const context(made,
                                                                                     LZ4F_freeDecompressionContext);
  Room room(most_bytes);
  std::size_t wanted = 1;
  while (wanted != 0 && room.make_room()) {
    auto out = room.free_bytes();
    auto in = packed.size();
    wanted = LZ4F_decompress(context.get(), room.free(), &out, packed.data(), &in, nullptr);
    if (LZ4F_isError(wanted) != 0U) break;
    room.use(out);
    packed.remove_prefix(in);
    if (in == 0 && out == 0) break;
  }
  return std::move(room).filled();
}

std::string unpack_zstd(std::string_view packed, std::size_t most_bytes) {
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> const context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  Room room(most_bytes);
  ZSTD_inBuffer in{.src = packed.data(), .size = packed.size(), .pos = 0};
  std::size_t wanted = 1;
  while (wanted != 0 && room.make_room()) {
    ZSTD_outBuffer out{.dst = room.free(), .size = room.free_bytes(), .pos = 0};
    auto const before = in.pos;
    wanted = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(wanted) != 0U) break;
    room.use(out.pos);
    if (out.pos == 0 && in.pos == before) break;
  }
  return std::move(room).filled();
}

}  // namespace

std::string unpack(Packing packing, std::string_view packed, std::size_t most_bytes) {
  switch (packing) {
    case Packing::lz4: return unpack_lz4(packed, most_bytes);
    case Packing::zstd: return unpack_zstd(packed, most_bytes);
    case Packing::none: break;
  }
  return std::string(packed.substr(0, most_bytes));
}

bool is_zstd(std::string_view bytes) {
  return bytes.starts_with("\x28\xb5\x2f\xfd");
}

}  // namespace lapwing::scans
