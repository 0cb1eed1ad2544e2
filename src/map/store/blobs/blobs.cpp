#include "map/store/blobs/blobs.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "map/store/blobs/sha256.hpp"
#include "map/store/schema/tables.hpp"

namespace lapwing::map::blobs {

namespace {

using base::ErrorKind;

class TableBytes final : public Bytes {
 public:
  explicit TableBytes(sql::Database& database) : database_(database) {}

  base::Result<> write(std::string const& hash, std::string const& bytes) override {
    return database_.put(schema::table::blob_bytes, {"hash", "content"}, {{hash, sql::Bytes{bytes}}});
  }
  base::Result<std::string> read(std::string const& hash) override {
    auto const content = sql::value_of(database_, "SELECT content FROM blob_bytes WHERE hash = $1", {hash});
    if (!content) return std::unexpected(content.error());
    if (sql::is_null(*content)) return base::fail(ErrorKind::not_found, "the bytes of " + hash + " are not there");
    return sql::as_bytes(*content);
  }
  // With its row in `blobs`, to which it belongs.
  void remove(std::string const&) override {}
  base::Result<std::vector<std::string>> all_hashes() override {
    auto const rows = sql::rows_of(database_, "SELECT hash FROM blob_bytes");
    if (!rows) return std::unexpected(rows.error());
    std::vector<std::string> hashes;
    for (auto const& row : *rows) hashes.push_back(sql::as_text(row.front()));
    return hashes;
  }
  std::size_t remove_leftovers() override { return 0; }

 private:
  sql::Database& database_;
};

bool is_hash(std::string const& text) {
  return text.size() == 64 &&
         std::ranges::all_of(text, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

}  // namespace

std::unique_ptr<Bytes> in_table(sql::Database& database) {
  return std::make_unique<TableBytes>(database);
}

base::Result<std::string> keep(sql::Database& database, Bytes& bytes, Store::Blob const& blob, base::UtcTime now) {
  if (blob.bytes.size() > most_bytes)
    return base::fail(ErrorKind::invalid_input,
                      fmt::format("{} bytes in one piece; the store takes at most {}", blob.bytes.size(), most_bytes));
  auto hash = sha256(blob.bytes);
  auto const known = sql::value_of(database, "SELECT count(*) FROM blobs WHERE hash = $1", {hash});
  if (!known) return std::unexpected(known.error());
  if (sql::as_integer(*known) != 0) return hash;
  bool const is_in_table = database.dialect() == sql::Dialect::postgis;
  if (!is_in_table)
    if (auto written = bytes.write(hash, blob.bytes); !written) return std::unexpected(written.error());
  auto transaction = sql::Transaction::begin(database);
  if (!transaction) return std::unexpected(transaction.error());
  auto const put =
      database.put(schema::table::blobs, {"hash", "bytes", "at_ns", "media_type"},
                   {{hash, static_cast<std::int64_t>(blob.bytes.size()), sql::nanoseconds(now), blob.media_type}});
  if (!put) return std::unexpected(put.error());
  // There the row owns the bytes, and both come with the commit.
  if (is_in_table)
    if (auto written = bytes.write(hash, blob.bytes); !written) return std::unexpected(written.error());
  if (auto committed = transaction->commit(); !committed) return std::unexpected(committed.error());
  return hash;
}

base::Result<Store::Blob> read(sql::Database& database, Bytes& bytes, std::string const& hash) {
  // Whatever else is asked for must not become the name of a file.
  if (!is_hash(hash)) return base::fail(ErrorKind::not_found, "that is no hash: 64 digits of SHA-256 are");
  auto const row = sql::rows_of(database, "SELECT media_type FROM blobs WHERE hash = $1", {hash});
  if (!row) return std::unexpected(row.error());
  if (row->empty()) return base::fail(ErrorKind::not_found, "the store has nothing with the hash " + hash);
  auto content = bytes.read(hash);
  if (!content)
    return base::fail(ErrorKind::io, content.error().message, "`lapwing store verify` tells what else is missing");
  if (sha256(*content) != hash)
    return base::fail(ErrorKind::io, "the bytes kept as " + hash + " are damaged",
                      "bring the store's pictures back from a backup");
  return Store::Blob{std::move(*content), sql::as_text(row->front().front())};
}

}  // namespace lapwing::map::blobs
