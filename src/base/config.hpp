#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/text/diagnostic.hpp"
#include "base/text/source.hpp"

/// Configuration files: TOML as a plain tree with places, and a reader that lets no mistake pass. Everything wrong goes
/// to `Diagnostics` with its place, so that one run shows all of it.
namespace lapwing::base {

/// Kinds of mistakes in a configuration file.
namespace config_kinds {
inline constexpr DiagnosticKind not_toml{"not-toml", Severity::error, "The file breaks the grammar of TOML."};
inline constexpr DiagnosticKind unknown_setting{"unknown-setting", Severity::error, "No setting has this name."};
inline constexpr DiagnosticKind wrong_type{"wrong-type", Severity::error, "The setting takes another type of value."};
inline constexpr DiagnosticKind invalid_value{"invalid-value", Severity::error, "The setting cannot have this value."};
inline constexpr DiagnosticKind misplaced{"misplaced-setting", Severity::error, "The setting belongs elsewhere."};
}  // namespace config_kinds

struct ConfigEntry;

/// One value and where it stands.
struct ConfigValue {
  struct Date {};  ///< TOML has dates; no setting is one
  using Array = std::vector<ConfigValue>;
  using Table = std::vector<ConfigEntry>;

  Span span;
  std::variant<bool, std::int64_t, double, std::string, Date, Array, Table> content;
};

struct ConfigEntry {
  std::string key;
  Span key_span;
  ConfigValue value;
};

/// The file's root table. A file that is no TOML gives an empty one and one error: TOML cannot be read on past it.
[[nodiscard]] ConfigValue::Table parse_config(SourceFile const& source, Diagnostics& diagnostics);

template <class T>
struct Placed {
  T value;
  Span span;
};

/// Reads one table key by key. Each query gives nothing when the key is not there, or has the wrong type or value; the
/// latter is reported. In the end `refuse_unknown` reports every key that nobody asked for. The table and the sink
/// outlive the reader.
class ConfigReader {
 public:
  ConfigReader(ConfigValue::Table const& table, Diagnostics& diagnostics) : table_(table), diagnostics_(diagnostics) {}
  [[nodiscard]] Diagnostics& diagnostics() const { return diagnostics_; }

  [[nodiscard]] std::optional<Placed<bool>> flag(std::string_view key);
  [[nodiscard]] std::optional<Placed<std::int64_t>> integer(std::string_view key, std::int64_t low, std::int64_t high);
  /// Whole numbers are numbers, too.
  [[nodiscard]] std::optional<Placed<double>> number(std::string_view key, double low, double high);
  [[nodiscard]] std::optional<Placed<std::string>> text(std::string_view key);
  /// Every text of an array; elements of another type are reported and left out.
  [[nodiscard]] std::optional<std::vector<Placed<std::string>>> texts(std::string_view key);
  /// Every whole number of an array; others are reported and left out.
  [[nodiscard]] std::vector<Placed<std::int64_t>> integers(std::string_view key, std::int64_t low, std::int64_t high);
  /// An array of exactly `count` numbers, such as a place.
  [[nodiscard]] std::optional<Placed<std::vector<double>>> numbers(std::string_view key, std::size_t count, double low,
                                                                   double high);
  /// Every such array of an array of them: [[1, 2], [3, 4]]; others are reported and left out.
  [[nodiscard]] std::vector<Placed<std::vector<double>>> number_lists(std::string_view key, std::size_t count,
                                                                      double low, double high);
  [[nodiscard]] std::optional<ConfigReader> table(std::string_view key);
  /// Every table of an array of them: [[key]] ... [[key]] ...
  [[nodiscard]] std::vector<Placed<ConfigReader>> tables(std::string_view key);

  /// Whether somebody wrote the key.
  [[nodiscard]] bool has(std::string_view key) const;
  /// Reports the key, when somebody wrote it, with what to do instead.
  void refuse(std::string_view key, std::string_view advice);
  void refuse_unknown();

 private:
  [[nodiscard]] ConfigEntry const* find(std::string_view key);
  void wrong_type(ConfigEntry const& entry, std::string_view wanted);
  [[nodiscard]] std::optional<Placed<std::vector<double>>> numbers_of(std::string_view key, ConfigValue const& value,
                                                                      std::size_t count, double low, double high);

  ConfigValue::Table const& table_;
  Diagnostics& diagnostics_;
  std::set<std::string, std::less<>> known_;    ///< asked for
  std::set<std::string, std::less<>> refused_;  ///< reported already
};

}  // namespace lapwing::base
