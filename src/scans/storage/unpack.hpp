#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lapwing::scans {

enum class Packing { none, lz4, zstd };

/// What an LZ4 frame (lz4_Frame_format.md) or a Zstandard frame (RFC 8878) holds, as far as it goes: of one that is cut
/// off or damaged what came out before, and never more than `most_bytes`.
[[nodiscard]] std::string unpack(Packing packing, std::string_view packed, std::size_t most_bytes);

/// Whether it begins as a Zstandard frame does.
[[nodiscard]] bool is_zstd(std::string_view bytes);

}  // namespace lapwing::scans
