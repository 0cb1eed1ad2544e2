#include "autonomy/settings/heights_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "autonomy/settings/heights_text.hpp"

namespace lapwing::autonomy {
namespace {

namespace fs = std::filesystem;

HoverHeights constexpr old_heights{8, 12, 16};
HoverHeights constexpr new_heights{9, 13.5, 18};

/// A folder whose power goes after so many steps; a byte written is one. Names that were not synced survive or not,
/// each on its own, and of content that was not synced there may be zeros in place of any byte.
class PoweredFolder final : public Folder {
 public:
  struct File {
    std::string content;
    std::size_t synced = 0;  ///< of its bytes
  };
  using Names = std::map<std::string, std::shared_ptr<File>>;

  Names names;  ///< on the disk
  int steps_left = std::numeric_limits<int>::max();

  [[nodiscard]] bool is_cut() const { return steps_left <= 0; }

  base::Result<std::optional<std::string>> read(std::string const& name, std::size_t most) override {
    auto const now = with(~0U);
    auto const found = now.find(name);
    if (found == now.end()) return std::nullopt;
    return found->second->content.substr(0, most);
  }
  base::Result<> write_through(std::string const& name, std::string_view content) override {
    auto const file = std::make_shared<File>();
    if (!step()) return cut();
    changes_.push_back({name, file, ""});
    for (char const c : content) {
      if (!step()) return cut();
      file->content += c;
    }
    if (!step()) return cut();
    file->synced = file->content.size();
    return {};
  }
  base::Result<> rename(std::string const& from, std::string const& to) override {
    if (!step()) return cut();
    changes_.push_back({to, with(~0U).at(from), from});
    return {};
  }
  base::Result<> sync_names() override {
    if (!step()) return cut();
    names = with(~0U);
    changes_.clear();
    return {};
  }

  /// What a boot may find after the power went: each combination of changes of names that came through.
  [[nodiscard]] std::vector<Names> boots() const {
    std::vector<Names> all;
    for (unsigned which = 0; which < (1U << changes_.size()); ++which) {
      auto found = with(which);
      for (auto& [name, file] : found) {
        auto const survivor = std::make_shared<File>(*file);
        for (auto i = survivor->synced; i < survivor->content.size(); ++i) survivor->content[i] = '\0';
        file = survivor;
      }
      all.push_back(found);
    }
    return all;
  }

 private:
  struct Change {
    std::string name;
    std::shared_ptr<File> file;
    std::string instead_of;  ///< a name that ends by it
  };

  [[nodiscard]] bool step() { return --steps_left > 0; }
  static std::unexpected<base::Error> cut() { return base::fail(base::ErrorKind::io, "the power went"); }
  [[nodiscard]] Names with(unsigned which) const {
    auto result = names;
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      if ((which >> i & 1U) == 0) continue;
      result[changes_[i].name] = changes_[i].file;
      if (!changes_[i].instead_of.empty()) result.erase(changes_[i].instead_of);
    }
    return result;
  }

  std::vector<Change> changes_;
};

/// What a boot from these names has.
LoadedHeights loaded(PoweredFolder::Names const& names) {
  PoweredFolder folder;
  folder.names = names;
  return load_heights(folder);
}

PoweredFolder::Names saved(std::vector<HoverHeights> const& one_after_the_other) {
  PoweredFolder folder;
  for (auto const& heights : one_after_the_other) EXPECT_TRUE(save_heights(folder, heights));
  return folder.names;
}

TEST(HeightsFile, GivesTheDefaultsBeforeTheFirstTime) {
  PoweredFolder folder;
  auto const first = load_heights(folder);
  EXPECT_EQ(first.heights, HoverHeights{});
  EXPECT_EQ(first.warning, "");
}

TEST(HeightsFile, KeepsWhatWasSaved) {
  EXPECT_EQ(loaded(saved({old_heights, new_heights})).heights, new_heights);
}

TEST(HeightsFile, HasTheOldOrTheNewOnesWheneverThePowerGoes) {
  auto const before = saved({HoverHeights{}, old_heights});
  bool was_whole = false;
  int cuts = 0;
  for (int steps = 1; !was_whole; ++steps) {
    PoweredFolder folder;
    folder.names = before;
    folder.steps_left = steps;
    was_whole = save_heights(folder, new_heights).has_value();
    for (auto const& boot : folder.boots()) {
      auto const found = loaded(boot);
      bool const is_new = found.heights == new_heights;
      ASSERT_TRUE(is_new || (found.heights == old_heights && !was_whole)) << "after " << steps << " steps";
      EXPECT_EQ(found.warning, "") << "after " << steps << " steps";
    }
    ++cuts;
  }
  EXPECT_GT(cuts, static_cast<int>(to_text(new_heights).size()));
}

TEST(HeightsFile, HasTheDefaultsOrTheNewOnesWhenThePowerGoesTheFirstTime) {
  bool was_whole = false;
  for (int steps = 1; !was_whole; ++steps) {
    PoweredFolder folder;
    folder.steps_left = steps;
    was_whole = save_heights(folder, new_heights).has_value();
    for (auto const& boot : folder.boots()) {
      auto const found = loaded(boot);
      ASSERT_TRUE(found.heights == new_heights || (found.heights == HoverHeights{} && !was_whole));
    }
  }
}

TEST(HeightsFile, FallsBackToTheOneBeforeWhenItIsDamagedAnywhere) {
  auto const names = saved({old_heights, new_heights});
  auto const whole = names.at(std::string(heights_file))->content;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (auto const& damaged :
         {whole.substr(0, i), std::string(whole).replace(i, 1, 1, static_cast<char>(whole[i] ^ 4))}) {
      auto changed = names;
      changed[std::string(heights_file)] = std::make_shared<PoweredFolder::File>(damaged, damaged.size());
      auto const found = loaded(changed);
      ASSERT_EQ(found.heights, old_heights) << i;
      EXPECT_EQ(
          found.warning,
          "hover-heights.toml: it is cut off or was changed: its checksum is wrong; the heights before are in force");
    }
  }
}

TEST(HeightsFile, DoesNotKeepADamagedOneInPlaceOfASoundOne) {
  PoweredFolder folder;
  folder.names = saved({old_heights, new_heights});
  folder.names[std::string(heights_file)] = std::make_shared<PoweredFolder::File>("rubbish", 7);
  ASSERT_TRUE(save_heights(folder, new_heights));
  EXPECT_EQ(folder.names.at(std::string(heights_file_before))->content, to_text(old_heights));
}

TEST(HeightsFile, WarnsWhenNothingIsSound) {
  PoweredFolder::Names names;
  names[std::string(heights_file)] = std::make_shared<PoweredFolder::File>("x", 1);
  auto const found = loaded(names);
  EXPECT_EQ(found.heights, HoverHeights{});
  EXPECT_TRUE(found.warning.ends_with("; the heights are the usual ones"));
}

TEST(HeightsText, RefusesWhatIsSealedButNotSound) {
  for (auto const& heights : {HoverHeights{1, 2, 3}, HoverHeights{9, 9, 9}}) {
    auto const parsed = parse_heights("f", to_text(heights));
    ASSERT_FALSE(parsed);
    EXPECT_TRUE(parsed.error().message.starts_with("f: the lowest hover height"));
  }
  EXPECT_EQ(parse_heights("f", std::string(5000, 'a')).error().message, "f: it is too long for hover heights");
}

TEST(HeightsText, KeepsEveryDigit) {
  HoverHeights const exact{7.1, 10.0 / 1.3, 1.0 / 3.0 + 20};
  EXPECT_EQ(*parse_heights("f", to_text(exact)), exact);
}

TEST(DiskFolder, KeepsHeightsInFiles) {
  auto const path = fs::temp_directory_path() / fmt::format("lapwing-heights-{}", ::getpid());
  fs::remove_all(path);
  {
    auto const folder = open_folder(path / "settings");
    ASSERT_TRUE(folder);
    EXPECT_EQ(load_heights(**folder).heights, HoverHeights{});
    ASSERT_TRUE(save_heights(**folder, old_heights));
    ASSERT_TRUE(save_heights(**folder, new_heights));
  }
  auto const folder = open_folder(path / "settings");
  ASSERT_TRUE(folder);
  EXPECT_EQ(load_heights(**folder).heights, new_heights);
  std::ofstream(path / "settings" / heights_file, std::ios::app) << "1";
  EXPECT_EQ(load_heights(**folder).heights, old_heights);
  fs::remove_all(path);
}

TEST(DiskFolder, SaysWhatItCannotOpen) {
  auto const folder = open_folder("/proc/nowhere/settings");
  ASSERT_FALSE(folder);
  EXPECT_TRUE(folder.error().message.starts_with("cannot make the folder /proc/nowhere/settings: "));
}

}  // namespace
}  // namespace lapwing::autonomy
