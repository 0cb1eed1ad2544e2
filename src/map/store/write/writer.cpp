#include "map/store/write/writer.hpp"

#include <utility>

#include <fmt/format.h>

#include "map/store/care/retention.hpp"
#include "map/store/schema/migrate.hpp"

namespace lapwing::map::write {

namespace {

constexpr std::uint64_t mebibyte = 1024 * 1024;

}  // namespace

base::Result<std::unique_ptr<Writer>> Writer::open(Store::Options const& options) {
  place::Address address(options.address);
  std::optional<place::FolderLock> lock;
  if (!address.is_server()) {
    auto taken = place::FolderLock::take(address);
    if (!taken) return std::unexpected(taken.error());
    lock.emplace(std::move(*taken));
  }
  auto database = place::open_database(address, sql::Access::write);
  if (!database) return std::unexpected(database.error());
  if (auto prepared = schema::prepare(**database, address.name()); !prepared) return std::unexpected(prepared.error());
  auto const revision = revision_of(**database);
  if (!revision) return std::unexpected(revision.error());
  std::unique_ptr<Writer> writer(new Writer(options, address, std::move(lock), std::move(*database)));
  writer->has_seen(*revision);
  writer->bytes_->remove_leftovers();
  return writer;
}

Writer::Writer(Store::Options options, place::Address address, std::optional<place::FolderLock> lock,
               std::unique_ptr<sql::Database> database)
    : options_(std::move(options)),
      address_(std::move(address)),
      lock_(std::move(lock)),
      database_(std::move(database)),
      bytes_(place::open_bytes(address_, *database_)) {}

base::Result<> Writer::room_for(std::uint64_t bytes) const {
  auto const free = place::free_bytes(address_);
  if (!free || *free >= options_.least_free_bytes + bytes) return {};
  return base::fail(base::ErrorKind::io,
                    fmt::format("the disk of {} has {} MiB left, and {} MiB shall stay free: nothing is written to the "
                                "store",
                                address_.name(), *free / mebibyte, options_.least_free_bytes / mebibyte),
                    "make room: it goes on by itself");
}

base::Result<Written> Writer::write(Batch const& batch) {
  if (auto room = room_for(0); !room) return std::unexpected(room.error());
  auto written = write_batch(*database_, batch, seen_);
  if (written) seen_ = written->seen;
  return written;
}

base::Result<Written> Writer::read_news() {
  auto read = write::read_news(*database_, seen_);
  if (read) seen_ = read->seen;
  return read;
}

base::Result<std::string> Writer::keep(Store::Blob const& blob, base::UtcTime now) {
  if (auto room = room_for(blob.bytes.size()); !room) return std::unexpected(room.error());
  return blobs::keep(*database_, *bytes_, blob, now);
}

base::Result<bool> Writer::retain(base::UtcTime now) {
  return care::retain(*database_, *bytes_, {.most_bytes = options_.most_bytes, .longest = options_.longest}, now);
}

std::uint64_t Writer::bytes() {
  return care::bytes_in_use(*database_).value_or(0);
}

}  // namespace lapwing::map::write
