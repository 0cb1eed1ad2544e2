// KMZ: KML in a ZIP archive. By libzip.
#include <zip.h>

#include <memory>

#include <fmt/format.h>

#include "plan/files/internal/plan_reader.hpp"

namespace lapwing::plan::internal {
namespace {

using base::Result;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Archive = std::unique_ptr<zip_t, Discard>;
using Entry = std::unique_ptr<zip_file_t, Discard>;

/// An archive that is `source`, which it owns. Null for what is none.
Archive open_archive(zip_source_t* source, int flags) {
  zip_error_t error;
  zip_error_init(&error);
  Archive archive(source ? zip_open_from_source(source, flags, &error) : nullptr);
  if (!archive && source) zip_source_free(source);
  zip_error_fini(&error);
  return archive;
}

/// The first KML file is the one, whatever its name.
std::optional<zip_uint64_t> find_kml(zip_t* archive) {
  auto const count = zip_get_num_entries(archive, 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    auto const index = static_cast<zip_uint64_t>(i);
    char const* name = zip_get_name(archive, index, ZIP_FL_ENC_GUESS);
    if (name && std::string_view(name).ends_with(".kml")) return index;
  }
  return std::nullopt;
}

}  // namespace

Result<std::string> unzip_kml(std::string_view file, std::string_view bytes) {
  auto* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr);
  auto const archive = open_archive(source, ZIP_RDONLY);
  if (!archive) return wrong(file, "this is no ZIP archive");
  auto const index = find_kml(archive.get());
  if (!index) return wrong(file, "there is no .kml file in the archive");
  Entry const entry(zip_fopen_index(archive.get(), *index, 0));
  if (!entry) return wrong(file, "the KML in the archive cannot be unpacked");
  std::string text;
  constexpr std::size_t chunk = std::size_t{64} << 10U;
  for (;;) {
    auto const size = text.size();
    text.resize(size + chunk);
    auto const got = zip_fread(entry.get(), text.data() + size, chunk);
    if (got < 0) return wrong(file, "the KML in the archive is damaged");
    text.resize(size + static_cast<std::size_t>(got));
    if (got == 0) return text;
    if (text.size() > max_plan_bytes)
      return wrong(file, fmt::format("the KML in the archive is too large (limit {} MB)", max_plan_bytes >> 20U));
  }
}

Result<std::string> zip_kml(std::string_view kml) {
  auto const failed = [] { return base::fail(base::ErrorKind::io, "the KMZ archive could not be made"); };
  auto* const source = zip_source_buffer_create(nullptr, 0, 0, nullptr);
  if (!source) return failed();
  zip_source_keep(source);  // outlives the archive, which closes it
  std::unique_ptr<zip_source_t, decltype(&zip_source_free)> const kept(source, &zip_source_free);
  auto archive = open_archive(source, ZIP_TRUNCATE);
  if (!archive) return failed();
  auto* const entry = zip_source_buffer(archive.get(), kml.data(), kml.size(), 0);
  if (!entry || zip_file_add(archive.get(), "doc.kml", entry, ZIP_FL_ENC_UTF_8) < 0) return failed();
  if (zip_close(archive.get()) < 0) return failed();
  (void)archive.release();
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_open(source) < 0 || zip_source_stat(source, &stat) < 0) return failed();
  std::string bytes(static_cast<std::size_t>(stat.size), '\0');
  auto const got = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (got != static_cast<zip_int64_t>(bytes.size())) return failed();
  return bytes;
}

}  // namespace lapwing::plan::internal
