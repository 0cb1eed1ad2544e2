#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "station/fields/field_visitor.hpp"

namespace lapwing::station::internal {

/// Remembers what there is to tell, line by line, and since when: values as they are told, rounded, and the times at
/// which they were heard. Values are compared as bytes; nothing is written for that.
class FieldChanges : private FieldVisitor {
 public:
  struct News {
    bool value = false;
    bool age = false;
  };

  /// Looks at a table again: `show` shows it to the visitor that it is given. What has changed since the last look has
  /// done so at `revision`, which grows from look to look. True when there is news.
  template <class Show>
  bool look(Show const& show, std::uint64_t revision) {
    begin(revision);
    show(static_cast<FieldVisitor&>(*this));
    forget_unseen();
    return has_news_;
  }
  /// What of the line changed after revision `since`.
  [[nodiscard]] News news_of(std::string_view key, std::uint64_t since) const;

 private:
  struct Line {
    std::string key;
    std::string value = {};  ///< as bytes
    std::optional<base::TimePoint> heard = {};
    std::uint64_t changed = 0;  ///< at which revision the value became as it is; 0: it was never told
    std::uint64_t told = 0;     ///< the same of the value or of when it was heard
    std::uint64_t seen = 0;     ///< in which look
  };

  bool wants(Member const& member) override;
  void number(Member const& member, std::optional<double> value, Unit const& unit) override;
  void flag(Member const& member, bool value) override;
  void text(Member const& member, std::string_view value) override;
  void word(Member const& member, std::string_view value, Words const& words) override;
  void begin_object(Member const& member, Type const& type) override;
  void begin_list(Member const& member, Unique unique) override;
  void end() override;

  void begin(std::uint64_t revision);
  void forget_unseen();
  void add(void const* bytes, std::size_t size);
  void add_text(std::string_view text);
  void end_value();
  [[nodiscard]] std::size_t place_of(std::string_view key) const;

  std::vector<Line> lines_;
  mutable std::size_t line_ = 0;  ///< that was looked for last
  std::uint64_t revision_ = 0;
  std::uint64_t looks_ = 0;
  std::optional<base::TimePoint> heard_;
  std::string value_;
  int depth_ = 0;
  bool has_news_ = false;
};

}  // namespace lapwing::station::internal
