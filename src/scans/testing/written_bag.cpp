#include "scans/testing/written_bag.hpp"

#include <lz4frame.h>
#include <sqlite3.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

namespace lapwing::scans::testing {

namespace {

std::string packed(std::string const& bytes, Packing packing) {
  if (packing == Packing::none) return bytes;
  bool const is_zstd = packing == Packing::zstd;
  std::string out(is_zstd ? ZSTD_compressBound(bytes.size()) : LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  out.resize(is_zstd ? ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3)
                     : LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  return out;
}

std::string name_of(Packing packing) {
  if (packing == Packing::none) return "";
  return packing == Packing::zstd ? "zstd" : "lz4";
}

void run(sqlite3* database, std::string const& sql) {
  if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    throw std::runtime_error(sqlite3_errmsg(database));
}

}  // namespace

std::string const WrittenBag::magic("\x89MCAP0\r\n", 8);

void WrittenBag::add(std::string const& topic, std::string const& type, std::chrono::nanoseconds logged,
                     std::string bytes, std::string const& encoding) {
  auto const known = std::ranges::find(topics_, topic, &Topic::name);
  auto const number = static_cast<std::size_t>(known - topics_.begin());
  if (known == topics_.end()) topics_.push_back({topic, type, encoding});
  messages_.push_back({number, logged, std::move(bytes)});
}

std::string WrittenBag::record(int opcode, std::string const& content) {
  return static_cast<char>(opcode) + number(static_cast<std::uint64_t>(content.size())) + content;
}

std::string WrittenBag::text(std::string const& value) {
  return number(static_cast<std::uint32_t>(value.size())) + value;
}

std::string WrittenBag::chunk(std::string const& records, Packing packing, std::uint32_t crc) {
  auto const bytes = packed(records, packing);
  return record(6, number(std::uint64_t{0}) + number(std::uint64_t{0}) +
                       number(static_cast<std::uint64_t>(records.size())) + number(crc) + text(name_of(packing)) +
                       number(static_cast<std::uint64_t>(bytes.size())) + bytes);
}

std::string WrittenBag::mcap(Packing packing, std::size_t messages_a_chunk) const {
  std::string file = magic + record(1, text("ros2") + text("a test"));
  std::string records;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    auto const id = number(static_cast<std::uint16_t>(i + 1));
    records += record(3, id + text(topics_[i].type) + text("ros2msg") + text(""));
    records += record(4, id + id + text(topics_[i].name) + text(topics_[i].encoding) + number(std::uint32_t{0}));
  }
  auto const end_chunk = [&] {
    if (messages_a_chunk == 0) {
      file += records;
    } else {
      auto const* bytes = reinterpret_cast<Bytef const*>(records.data());
      file += chunk(records, packing, static_cast<std::uint32_t>(::crc32_z(0, bytes, records.size())));
      file += record(7, number(std::uint16_t{1}) + number(std::uint32_t{0}));
    }
    records.clear();
  };
  for (std::size_t i = 0; i < messages_.size(); ++i) {
    auto const& message = messages_[i];
    auto const time = number(static_cast<std::uint64_t>(message.logged.count()));
    auto body = number(static_cast<std::uint16_t>(message.topic + 1));
    body += number(static_cast<std::uint32_t>(i));
    body += time;
    body += time;
    body += message.bytes;
    records += record(5, body);
    if (messages_a_chunk > 0 && (i + 1) % messages_a_chunk == 0) end_chunk();
  }
  if (!records.empty()) end_chunk();
  return file + record(15, number(std::uint32_t{0})) + record(2, std::string(20, '\0')) + magic;
}

void WrittenBag::write_sqlite(std::filesystem::path const& file) const {
  sqlite3* database = nullptr;
  sqlite3_open(file.c_str(), &database);
  run(database,
      "PRAGMA synchronous=OFF;PRAGMA journal_mode=OFF;"
      "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,serialization_format TEXT NOT "
      "NULL,offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, data BLOB "
      "NOT "
      "NULL);CREATE INDEX timestamp_idx ON messages (timestamp ASC);BEGIN");
  for (std::size_t i = 0; i < topics_.size(); ++i)
    run(database, "INSERT INTO topics VALUES(" + std::to_string(i + 1) + ",'" + topics_[i].name + "','" +
                      topics_[i].type + "','" + topics_[i].encoding + "','')");
  for (auto const& message : messages_) {
    sqlite3_stmt* row = nullptr;
    sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)", -1, &row, nullptr);
    sqlite3_bind_int64(row, 1, static_cast<sqlite3_int64>(message.topic) + 1);
    sqlite3_bind_int64(row, 2, message.logged.count());
    sqlite3_bind_blob(row, 3, message.bytes.data(), static_cast<int>(message.bytes.size()), SQLITE_STATIC);
    sqlite3_step(row);
    sqlite3_finalize(row);
  }
  run(database, "COMMIT");
  sqlite3_close(database);
}

}  // namespace lapwing::scans::testing
