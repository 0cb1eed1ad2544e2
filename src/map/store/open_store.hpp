#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/async/side_thread.hpp"
#include "map/store/past/grid_keeper.hpp"
#include "map/store/reader.hpp"
#include "map/store/store.hpp"
#include "map/store/write/pending.hpp"
#include "map/store/write/writer.hpp"

namespace lapwing::map {

/// The store on the loop: what has changed, when it is written, and what became of it. The databases are on two threads
/// beside it, one to write and one to read.
class OpenStore final : public Store {
 public:
  OpenStore(base::Loop& loop, bool is_shared, std::unique_ptr<write::Writer> writer, std::unique_ptr<Reader> reader);
  OpenStore(OpenStore const&) = delete;
  OpenStore& operator=(OpenStore const&) = delete;
  ~OpenStore() override;

  base::Task<base::Result<>> load(LiveMap& into) override;
  void follow(LiveMap& map) override;
  base::Task<base::Result<>> flush() override;
  base::Task<base::Result<std::string>> keep(std::string bytes, std::string media_type) override;
  base::Task<base::Result<Blob>> blob(std::string hash) override;
  void record(Shown shown) override;
  [[nodiscard]] bool is_ready_to_record() const override { return pending_.is_ready_to_record(); }
  base::Task<> record_grids(std::string session, base::UtcTime at) override;
  void name_session(std::string id, std::string name) override;
  base::Task<base::Result<std::vector<Session>>> sessions() override;
  base::Task<base::Result<std::vector<Shown>>> state_at(std::string session, base::UtcTime at) override;
  base::Task<base::Result<std::vector<Shown>>> shown(std::string session, base::UtcTime from, base::UtcTime to,
                                                     std::size_t most) override;
  base::Task<base::Result<PastGrids>> grids_at(std::string session, base::UtcTime at) override;
  base::Task<base::Result<PastShades>> shades(std::vector<std::string> names) override;
  [[nodiscard]] Health health() const override;

 private:
  base::Task<base::Result<>> load_features(LiveMap& into, LayerKind layer, rows::Sites const& sites,
                                           std::map<write::FeatureKey, Account>& removals);
  base::Task<base::Result<>> load_grids(LiveMap& into);
  base::Task<> write_always();
  base::Task<> write_once();
  base::Task<> clear_up();
  void apply(write::News const& news);
  [[nodiscard]] base::TimePoint next_write() const;
  [[nodiscard]] base::TimePoint next_turn() const;
  void has_failed(base::Error const& error);
  void note_fault(std::string fault);

  base::Loop& loop_;
  bool is_shared_;
  LiveMap* map_ = nullptr;
  std::shared_ptr<void> following_;
  bool is_applying_ = false;  ///< what changes on the map now is what others have written
  write::Pending pending_;
  past::GridKeeper grids_;
  base::SideThread<write::Writer> writer_;
  base::SideThread<Reader> reader_;

  std::string trouble_;
  std::string faults_;  ///< the first thing that could not be read, and how many there are
  std::uint64_t fault_count_ = 0;
  std::uint64_t lost_frames_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t failures_ = 0;
  std::optional<base::Error> last_failure_;
  bool is_urgent_ = false;  ///< somebody waits for what has not been written
  base::TimePoint quick_from_{};
  base::TimePoint tiles_from_{};
  base::TimePoint frames_from_{};
  base::TimePoint news_from_{};
  base::TimePoint retry_from_{};
  base::TimePoint clear_up_from_{};
  base::Notifier changed_;
  base::Notifier written_;
  base::Scope scope_;  // last: its tasks use what stands above
};

}  // namespace lapwing::map
