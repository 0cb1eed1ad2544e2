#include "formats/archive.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <memory>
#include <set>

#include <cpl_conv.h>

#include "formats/internal/gdal.hpp"

namespace lapwing::formats {

namespace {

namespace files = std::filesystem;

constexpr std::size_t piece_bytes = std::size_t{64} * 1024;

bool pack(void* archive, files::path const& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || CPLCreateFileInZip(archive, file.filename().c_str(), nullptr) != CE_None) return false;
  auto const piece = std::make_unique<std::array<char, piece_bytes>>();
  bool is_written = true;
  while (is_written && in) {
    in.read(piece->data(), static_cast<std::streamsize>(piece->size()));
    auto const count = static_cast<int>(in.gcount());
    if (count > 0) is_written = CPLWriteFileInZip(archive, piece->data(), count) == CE_None;
  }
  return CPLCloseFileInZip(archive) == CE_None && is_written && in.eof();
}

}  // namespace

base::Result<> write_archive(files::path const& folder, files::path const& archive) {
  std::error_code error;
  std::set<files::path> sorted;  // in one order, whatever the disk's is
  for (auto const& entry : files::directory_iterator(folder, error))
    if (entry.is_regular_file()) sorted.insert(entry.path());
  if (error) return base::fail(base::ErrorKind::io, fmt::format("{}: {}", folder.string(), error.message()));
  files::remove(archive, error);
  return internal::with_gdal(fmt::format("{} cannot be written", archive.string()), [&] {
    auto* const zip = CPLCreateZip(archive.c_str(), nullptr);
    if (!zip) return false;
    bool is_written = true;
    for (auto const& file : sorted) is_written = is_written && pack(zip, file);
    return CPLCloseZip(zip) == CE_None && is_written;
  });
}

}  // namespace lapwing::formats
