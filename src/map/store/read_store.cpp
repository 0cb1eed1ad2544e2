#include "map/store/read_store.hpp"

#include <filesystem>
#include <utility>

#include "base/async/side_thread.hpp"
#include "map/store/reader.hpp"
#include "map/store/rows/shade_rows.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/schema/migrate.hpp"

namespace lapwing::map {

namespace {

class ReadStore final : public Store {
 public:
  ReadStore(base::Loop& loop, std::unique_ptr<Reader> reader) : reader_(loop, std::move(reader)) {}

  base::Task<base::Result<std::string>> keep(std::string, std::string) override {
    co_return base::fail(base::ErrorKind::refused, "this store is only read", "a station keeps pictures");
  }
  base::Task<base::Result<Blob>> blob(std::string hash) override {
    return read(
        [hash = std::move(hash)](Reader& reader) { return blobs::read(*reader.database, *reader.bytes, hash); });
  }
  base::Task<base::Result<>> load(LiveMap&) override { co_return base::Result<>(); }
  void follow(LiveMap&) override {}
  base::Task<base::Result<>> flush() override { co_return base::Result<>(); }

  void record(Shown) override {}
  [[nodiscard]] bool is_ready_to_record() const override { return false; }
  base::Task<> record_grids(std::string, base::UtcTime) override { co_return; }
  void name_session(std::string, std::string) override {}

  base::Task<base::Result<std::vector<Session>>> sessions() override {
    return read([](Reader& reader) { return rows::read_sessions(*reader.database); });
  }
  base::Task<base::Result<std::vector<Shown>>> state_at(std::string session, base::UtcTime at) override {
    return read(
        [session = std::move(session), at](Reader& reader) { return rows::state_at(*reader.database, session, at); });
  }
  base::Task<base::Result<std::vector<Shown>>> shown(std::string session, base::UtcTime from, base::UtcTime to,
                                                     std::size_t most) override {
    return read([session = std::move(session), from, to, most](Reader& reader) {
      return rows::shown_between(*reader.database, session, from, to, most);
    });
  }
  base::Task<base::Result<PastGrids>> grids_at(std::string session, base::UtcTime at) override {
    return read(
        [session = std::move(session), at](Reader& reader) { return rows::grids_at(*reader.database, session, at); });
  }
  base::Task<base::Result<PastShades>> shades(std::vector<std::string> names) override {
    return read([names = std::move(names)](Reader& reader) { return rows::read_shades(*reader.database, names); });
  }
  [[nodiscard]] Health health() const override { return {.is_writing = false}; }

 private:
  template <class Job>
  base::Task<std::invoke_result_t<Job&, Reader&>> read(Job job) {
    co_return co_await reader_.run(std::move(job));
  }

  base::SideThread<Reader> reader_;
};

}  // namespace

base::Result<std::unique_ptr<Store>> open_to_read(base::Loop& loop, std::string const& address) {
  place::Address const place(address);
  auto reader = Reader::open(place);
  if (!reader) return std::unexpected(reader.error());
  if (auto checked = schema::check(*(*reader)->database, place.name()); !checked)
    return std::unexpected(checked.error());
  return std::make_unique<ReadStore>(loop, *std::move(reader));
}

bool is_store(std::string const& address) {
  place::Address const place(address);
  return place.is_server() || std::filesystem::exists(place.database());
}

}  // namespace lapwing::map
